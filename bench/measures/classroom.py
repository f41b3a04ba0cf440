"""What `mrlab class` takes for submissions of 10 s among ten objects, on two backends.

The digest is of all that was written: it has to be the same.
"""

from __future__ import annotations

import contextlib
import hashlib
import io
import tempfile
import time
from pathlib import Path
from typing import Any

import numpy as np
import scipy.io
from lab import ROOT
from measures.check import FILE, scene
from size import Size

from mrlab_ros.classroom.mark import read_rubric
from mrlab_ros.classroom.run import Request, run
from mrlab_ros.classroom.setup import Setup

NEEDS = ()
FRAMES = 1000  # at 100 Hz
JOBS = 2


def submit(folder: Path, count: int) -> None:
    """Write `count` submissions as Moodle exports them, each a little different."""
    content = scipy.io.loadmat(FILE)
    positions = content["q"]
    at = np.linspace(0, len(positions) - 1, FRAMES)
    known = np.arange(len(positions))
    ten = np.stack([np.interp(at, known, column) for column in positions.T], axis=1)
    ten[:, 6] = ten[:, 6] > 0.5
    share = np.linspace(0, 1, FRAMES)[:, np.newaxis]
    for number in range(count):
        random = np.random.default_rng(number)
        moved = ten.copy()
        moved[:, :6] += np.sin(np.pi * share) * random.normal(0, 0.01, 6)
        place = folder / f"Student {number}_{number}_assignsubmission_file_"
        place.mkdir(parents=True)
        scipy.io.savemat(place / "run.mat", {"q": moved, "fs": content["fs"]})


def digest(folder: Path) -> str:
    content = hashlib.sha256()
    for path in sorted(folder.rglob("*")):
        if path.is_file():
            content.update(path.relative_to(folder).as_posix().encode())
            content.update(path.read_bytes())
    return content.hexdigest()[:12]


def graded(size: Size) -> list[dict[str, Any]]:
    """Check a class with as many processes on each backend."""
    count = size.of(1, 8, 150)
    rubric = read_rubric(ROOT / "examples" / "rubrics" / "pick_and_place.yaml")
    setup = Setup(rubric, scene(), reference=(FILE.name, FILE.read_bytes()))
    rows = []
    with tempfile.TemporaryDirectory() as name:
        submit(Path(name) / "submissions", count)
        for backend in size.some(("loky", "dask")):
            out = Path(name) / backend
            request = Request(Path(name) / "submissions", setup, out, JOBS, backend, as_json=True)
            wall = time.perf_counter()
            with contextlib.redirect_stdout(io.StringIO()):
                run(request)
            rows.append(
                {
                    "backend": backend,
                    "processes": JOBS,
                    "submissions": count,
                    "wall s": time.perf_counter() - wall,
                    "digest": digest(out),
                }
            )
    return rows


TABLES = {"A class": graded}
