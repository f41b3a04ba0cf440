"""Every measure still runs, the least of it."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

BENCH = Path(__file__).parents[2] / "bench"
NAMES = sorted(path.stem for path in (BENCH / "measures").glob("*.py"))


def ran(*arguments: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [sys.executable, *arguments],
        cwd=BENCH,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
    )


@pytest.mark.timeout(240)
@pytest.mark.parametrize("name", NAMES)
def test_a_measure_runs(name: str) -> None:
    done = ran("run.py", "--touch", name)
    assert done.returncode == 0, done.stdout[-4000:]


def test_a_mutant_is_killed_or_lives() -> None:
    done = ran("mutants.py", "--module", "mrlab_ros.core.recording.recorder", "--count", "1")
    assert done.returncode == 0, done.stdout[-4000:]


def test_an_unknown_name_is_refused_with_the_known_ones() -> None:
    done = ran("run.py", "--touch", "nothing")
    assert done.returncode == 2
    assert "kinematics" in done.stdout
