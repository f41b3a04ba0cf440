"""What is compressed as a whole is inflated within bounds."""

from __future__ import annotations

import gzip
from pathlib import Path

import pytest
import zstandard

from mrlab_ros.adapters.sandbox.inflate import Incomplete, inflate_file


@pytest.mark.parametrize("compress", [gzip.compress, zstandard.compress])
def test_a_file_that_holds_too_much_is_given_up(tmp_path: Path, compress) -> None:
    content = bytes(40 << 20)
    (tmp_path / "packed").write_bytes(compress(content))
    with (tmp_path / "whole").open("wb") as target:
        inflate_file(tmp_path / "packed", target, len(content))
    assert (tmp_path / "whole").stat().st_size == len(content)
    with (tmp_path / "part").open("wb") as target, pytest.raises(Incomplete):
        inflate_file(tmp_path / "packed", target, 1 << 20)
    assert (tmp_path / "part").stat().st_size <= 1 << 20
