"""A graded class as `mrlab class` leaves it: a solution, a motion that lost points, and none."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
from small_lab import make

from mrlab_ros.adapters.trajectories import formats
from mrlab_ros.classroom.marks.diagnostics import NO_FILE_HANDED_IN, NOT_IN_WORKSHEET
from mrlab_ros.classroom.rubrics import diagnostics
from mrlab_ros.core.base.diagnostic import Severity, plain
from mrlab_ros.core.checking.diagnostics import CHECK_READY, COLLISION

TOUCHES = {"link": "wrist_3_link", "kind": "object", "other": "cube_1", "time": 0.2}
TOUCHED = plain(diagnostics.TOUCHES(**TOUCHES))
SLOW = plain(diagnostics.CYCLE_TIME(value=9.0, limit=8.0, unit="s", severity=Severity.WARNING))
HIT = COLLISION(**TOUCHES, robot="ur5e_1", end=0.3, value=0.01, unit="m", point=(0.4, 0.1, 0.2))


def mark(name: str, points: float, of: float, **more: Any) -> dict[str, Any]:
    """Return a mark as class.json has it."""
    return {
        "name": name, "points": points, "of": of, "passed": points == of,
        "found": plain(diagnostics.NOTHING_TOUCHED()), "hint": "", "hidden": False, "time": None,
        **more,
    }  # fmt: skip


def entry(key: str, *marks: dict[str, Any], motion: bool = True, **more: Any) -> dict[str, Any]:
    """Return what class.json says of one submission."""
    return {
        "key": key, "name": key.title(), "identifier": "", "late": False, "notes": [],
        "outcome": "marked", "found": plain(CHECK_READY()), "marks": list(marks),
        "points": sum(m["points"] for m in marks), "of": sum(m["of"] for m in marks),
        "file": f"{key}.mat", "sha256": "", "verdict": "", "report": "", "robot": "ur5e",
        "tool": "", "duration": 0.5 if motion else None, "hints": [], "findings": [],
        "trajectory": f"trajectories/{key}.json" if motion else None, "page": None, **more,
    }  # fmt: skip


def make_class(folder: Path, frames: int = 50) -> Path:
    """Write a class of three into `folder`; return it."""
    students = [
        entry("anna", mark("no collision", 2, 2), mark("cycle below 8 s", 1, 1)),
        entry(
            "ben",
            mark("no collision", 0, 2, time=0.2, found=TOUCHED, hint="Lift it"),
            mark("cycle below 8 s", 0.5, 1, found=SLOW),
            findings=[plain(HIT)],
        ),
        entry(
            "cleo", mark("no collision", 0, 2), mark("cycle below 8 s", 0, 1), motion=False,
            found=plain(NO_FILE_HANDED_IN(files=["cleo.pdf"])),
        ),
    ]  # fmt: skip
    reference = entry("reference", mark("no collision", 2, 2), mark("cycle below 8 s", 1, 1))
    document = {
        "schema": "mrlab.class.1",
        "title": "Pick and place",
        "form": "folders",
        "rubric": {"name": "Pick and place", "points": 3, "robot": "ur5e"},
        "reference": {k: v for k, v in reference.items() if k not in ("key", "name")},
        "students": students,
        "left_out": [],
        "unmatched": [
            {
                "kind": "student", "what": "ben", "name": "Ben", "proposal": "Participant 2",
                "proposed": "Ben Ott", "why": plain(NOT_IN_WORKSHEET(student="Ben")),
            }
        ],
        "rows": [{"key": "ben-ott-2", "name": "Ben Ott", "identifier": "Participant 2"}],
    }  # fmt: skip
    (folder / "trajectories").mkdir(parents=True, exist_ok=True)
    (folder / "class.json").write_text(json.dumps(document))
    for number, key in enumerate(("reference", "anna", "ben")):
        motion = make("ur5e", key, frames=frames)
        away = number * 0.1 * np.sin(np.linspace(0, 3, frames))[:, None]
        formats.write(
            replace(motion, positions=motion.positions + away),
            folder / "trajectories" / f"{key}.json",
        )
    return folder
