"""The TypeScript workspace in web/, with its own tools."""

from __future__ import annotations

import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]


def run_npm(*arguments: str) -> None:
    done = subprocess.run(
        [str(ROOT / "scripts" / "npm"), *arguments],
        capture_output=True,
        text=True,
        timeout=110,
        check=False,
    )
    assert done.returncode == 0, done.stdout[-4000:] + done.stderr[-4000:]


@pytest.mark.slow
def test_types_and_style_are_right() -> None:
    run_npm("run", "check")


@pytest.mark.slow
def test_its_own_tests_pass() -> None:
    run_npm("test")
