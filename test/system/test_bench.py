"""Every measure still runs, the least of it."""

from __future__ import annotations

import json
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


def test_what_got_worse_stands_at_the_top_of_the_page(tmp_path: Path) -> None:
    figures, page = tmp_path / "figures.json", tmp_path / "page.html"
    assert ran("run.py", "--touch", "--json", str(figures), "kinematics").returncode == 0
    kept = json.loads(figures.read_text())
    title, table = next(iter(kept.items()))
    key = "load ms"
    for better in (True, False):
        for row in table["rows"]:
            row[key] *= 1e-3 if better else 1e6
            # Whatever else was measured may be worse today than a moment ago.
            row.update({other: 1e9 for other in row if other.endswith(" ms") and other != key})
        figures.write_text(json.dumps(kept))
        done = ran(
            "run.py", "--touch", "--compare", str(figures), "--page", str(page), "kinematics"
        )
        assert done.returncode == 0, done.stdout[-4000:]
        top = page.read_text().partition("<code")[2][:500]
        assert (f"{title}: " in top and "worse" in top) is better
        assert "load average" in page.read_text()


def test_a_mutant_is_killed_or_lives() -> None:
    done = ran("mutants.py", "--module", "mrlab_ros.core.recording.recorder", "--count", "1")
    assert done.returncode == 0, done.stdout[-4000:]


def test_an_unknown_name_is_refused_with_the_known_ones() -> None:
    done = ran("run.py", "--touch", "nothing")
    assert done.returncode == 2
    assert "kinematics" in done.stdout
