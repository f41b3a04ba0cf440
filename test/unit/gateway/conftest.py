from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest
from gateway_side import Gateway


@pytest.fixture
def local_lab(tmp_path: Path) -> Iterator[Gateway]:
    """A gateway without keys on its own machine."""
    with Gateway(tmp_path) as gateway:
        yield gateway


@pytest.fixture
def class_lab(tmp_path: Path) -> Iterator[Gateway]:
    """A gateway whose people sign in, over HTTPS."""
    with Gateway(tmp_path, public_url="https://lab.example.org") as gateway:
        yield gateway
