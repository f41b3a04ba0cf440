"""What `mrlab check` costs: one motion in a scene of ten objects, and where the time goes.

Processor time, of child processes too, stands beside wall time: a machine is seldom one's own. All
is done in one process, as a class is checked: imports and the library are paid once.
"""

from __future__ import annotations

import os
import time
from collections.abc import Callable
from typing import Any, TypeVar

import numpy as np
from lab import ROOT
from size import Size

from mrlab_ros.adapters import share
from mrlab_ros.adapters.robots.library import RobotLibrary
from mrlab_ros.app.check.stage import Stage, first_link
from mrlab_ros.app.convert import convert_file
from mrlab_ros.core.base.geometry import Pose
from mrlab_ros.core.checking import motion
from mrlab_ros.core.checking.rehearsal import Actor
from mrlab_ros.core.conversion.options import Options
from mrlab_ros.core.scene.document import ObjectEntry, SceneDocument

NEEDS = ()
Value = TypeVar("Value")
FILE = ROOT / "examples" / "pick_and_place_ur5e.mat"
KINDS = ("cube", "block", "cylinder", "cup", "can", "bottle", "carton", "pillar", "bin", "table")
PARTS = ("convert", "figures", "physics", "report")


def scene() -> SceneDocument:
    """Return ten objects on a ring that the arm reaches."""
    places = [(0.95 * np.cos(a), 0.95 * np.sin(a)) for a in np.linspace(0.6, 5.6, len(KINDS))]
    return SceneDocument(
        objects=tuple(
            ObjectEntry(f"{kind}_1", kind, Pose((float(x), float(y), 1.0)), automatic=True)
            for kind, (x, y) in zip(KINDS, places, strict=True)
        )
    )


class Times:
    """Processor and wall time of each part, s."""

    def __init__(self) -> None:
        self._cpu: dict[str, list[float]] = {part: [] for part in PARTS}
        self._wall: dict[str, list[float]] = {part: [] for part in PARTS}

    def of(self, part: str, work: Callable[[], Value]) -> Value:
        cpu, wall = sum(os.times()[:4]), time.perf_counter()
        found = work()
        self._cpu[part].append(sum(os.times()[:4]) - cpu)
        self._wall[part].append(time.perf_counter() - wall)
        return found

    def rows(self, total: str) -> list[dict[str, Any]]:
        rows = [
            {
                "part": part,
                "CPU s": float(np.median(self._cpu[part])),
                "wall s": float(np.median(self._wall[part])),
            }
            for part in PARTS
        ]
        sums = {key: sum(row[key] for row in rows) for key in ("CPU s", "wall s")}
        return [*rows, {"part": total, **sums}]


def checks(size: Size) -> list[dict[str, Any]]:
    """Check one motion again and again; the hash of the report has to stay the same."""
    folder = share.directory()
    stage = Stage(folder, RobotLibrary(folder / "robots"))
    robot = stage.robot("ur5e_1", "ur5e", "parallel_gripper", Pose())
    things, times, hashes, length = scene(), Times(), set(), 0.0

    def check() -> None:
        nonlocal length
        result = times.of(
            "convert",
            lambda: convert_file(FILE, robot.model, Options(), "parallel_gripper"),
        )
        trajectory = result.trajectory
        assert trajectory is not None
        length = trajectory.duration
        figures = times.of("figures", lambda: motion.figures_of(trajectory, robot))
        actor = Actor("ur5e_1", robot.model.home, trajectory, first_link=first_link(robot))
        played = times.of("physics", lambda: stage.rehearse([robot], [actor], things, drawn=False))
        document = times.of(
            "report",
            lambda: motion.report_of(
                result, robot, figures, played.recorded, inputs=stage.inputs([robot], things),
                scene="ten objects", graspable=played.graspable,
            ).document(),
        )  # fmt: skip
        hashes.add(document["hash"])

    for _ in range(size.of(1, 3, 20)):
        check()
    return times.rows(f"one check of {length:.1f} s ({len(hashes)} hash)")


TABLES = {"Check": checks}
