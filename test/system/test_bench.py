"""Every benchmark that the docs name still runs, the least of it."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
RUN = ROOT / "bench" / "run.py"
NAMES = [
    path.stem
    for path in sorted((ROOT / "bench").glob("*.*"))
    if path.suffix in (".py", ".mjs") and f'"{path.stem}"' not in RUN.read_text()
]


@pytest.mark.parametrize("name", NAMES)
def test_a_benchmark_runs(name: str) -> None:
    done = subprocess.run(
        [sys.executable, str(RUN), "--touch", name],
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        timeout=120,
    )
    assert done.returncode == 0, done.stdout[-4000:]


def test_the_docs_name_benchmarks_that_there_are() -> None:
    assert len(NAMES) >= 19
    done = subprocess.run(
        [sys.executable, str(RUN), "--touch", "nothing"], capture_output=True, text=True
    )
    assert done.returncode == 2
    assert "kinematics" in done.stderr
