"""A class as `bench/check.py --class` measures it: submissions of 10 s among ten objects."""

from __future__ import annotations

import contextlib
import hashlib
import io
import os
import tempfile
import time
from pathlib import Path
from typing import Any

import numpy as np
import scipy.io

from mrlab_ros.commands.classroom.run import Request, run
from mrlab_ros.commands.classroom.setup import Setup
from mrlab_ros.core.rubrics.rubric import Rubric
from mrlab_ros.core.scene.document import SceneDocument

FRAMES = 1000  # at 100 Hz


def submissions(folder: Path, motion: Path, count: int) -> None:
    """Write `count` submissions as Moodle exports them, each a little different from `motion`."""
    content = scipy.io.loadmat(motion)
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
        place.mkdir()
        scipy.io.savemat(place / "run.mat", {"q": moved, "fs": content["fs"]})


def rows(
    rubric: Rubric, scene: SceneDocument, motion: Path, *, count: int, jobs: int, dask: bool
) -> list[dict[str, Any]]:
    """Check a class with `jobs` processes, and with a dask cluster of so many where asked for;
    return a row for each with a digest of all that was written."""
    found = []
    with tempfile.TemporaryDirectory() as temporary:
        source = Path(temporary) / "submissions"
        source.mkdir()
        submissions(source, motion, count)
        ways = [("loky", jobs), *([("dask", jobs)] if dask else [])]
        for backend, processes in ways:
            out = Path(temporary) / f"{backend}-{processes}"
            setup = Setup(rubric, scene, reference=(motion.name, motion.read_bytes()))
            request = Request(source, setup, out, processes, backend, as_json=True)
            wall = time.perf_counter()
            with contextlib.redirect_stdout(io.StringIO()):
                run(request)
            found.append(
                {
                    "way": f"{backend}, {processes} processes, {count} submissions",
                    "wall s": time.perf_counter() - wall,
                    "load": os.getloadavg()[0],
                    "digest": _digest(out),
                }
            )
    return found


def _digest(folder: Path) -> str:
    content = hashlib.sha256()
    for path in sorted(folder.rglob("*")):
        if path.is_file():
            content.update(path.relative_to(folder).as_posix().encode())
            content.update(path.read_bytes())
    return content.hexdigest()[:12]
