"""What `mrlab check` costs: one motion in a scene of ten objects, and where the time goes.

CPU time, of child processes too, beside wall time, for a machine is seldom one's own. In one
process, as a class is checked: imports and the library are paid once.
"""

from __future__ import annotations

import os
import time
from pathlib import Path
from typing import Any

import numpy as np
import report

from mrlab_ros.adapters.checking.stage import Stage, first_link
from mrlab_ros.adapters.robots.library import RobotLibrary
from mrlab_ros.adapters.rubrics import files
from mrlab_ros.commands.convert import batch
from mrlab_ros.core.base.geometry import Pose
from mrlab_ros.core.checking import motion
from mrlab_ros.core.checking.rehearsal import Actor
from mrlab_ros.core.conversion.options import Options
from mrlab_ros.core.scene.document import ObjectEntry, SceneDocument
from mrlab_ros.ros import share

ROOT = share.directory()
KINDS = ("cube", "block", "cylinder", "cup", "can", "bottle", "carton", "pillar", "bin", "table")


def scene() -> SceneDocument:
    """Return ten objects on a ring that the arm reaches."""
    places = [(0.95 * np.cos(a), 0.95 * np.sin(a)) for a in np.linspace(0.6, 5.6, len(KINDS))]
    return SceneDocument(
        objects=tuple(
            ObjectEntry(f"{kind}_1", kind, Pose((float(x), float(y), 1.0)), automatic=True)
            for kind, (x, y) in zip(KINDS, places, strict=True)
        )
    )


def checks(count: int) -> list[dict[str, Any]]:
    """Check one motion `count` times; return a row for each part."""
    stage = Stage(ROOT, RobotLibrary(ROOT / "robots"))
    robot = stage.robot("ur5e_1", "ur5e", "parallel_gripper", Pose())
    file = Path(ROOT) / "examples" / "pick_and_place_ur5e.mat"
    if not file.is_file():
        file = Path(__file__).parents[1] / "examples" / "pick_and_place_ur5e.mat"
    things, spent = scene(), {"convert": [], "figures": [], "physics": [], "report": []}
    walls: dict[str, list[float]] = {part: [] for part in spent}
    hashes, length = set(), 0.0

    def timed(part: str, work: Any) -> Any:
        cpu, wall = sum(os.times()[:4]), time.perf_counter()
        found = work()
        spent[part].append(sum(os.times()[:4]) - cpu)
        walls[part].append(time.perf_counter() - wall)
        return found

    for _ in range(count):
        result = timed(
            "convert",
            lambda: batch.convert_file(file, robot.model, Options(), "parallel_gripper"),
        )
        trajectory = result.trajectory
        assert trajectory is not None
        length = trajectory.duration
        figures = timed("figures", lambda t=trajectory: motion.figures_of(t, robot))
        actor = Actor("ur5e_1", robot.model.home, trajectory, first_link=first_link(robot))
        played = timed(
            "physics", lambda a=actor: stage.rehearse([robot], [a], things, drawn=False)
        )
        document = timed(
            "report",
            lambda r=result, f=figures, p=played: motion.report_of(
                r, robot, f, p.recorded, inputs=stage.inputs([robot], things), scene="ten objects",
                graspable=p.graspable,
            ).document(),
        )  # fmt: skip
        hashes.add(document["hash"])
    rows = [
        {
            "part": part,
            "CPU s": float(np.median(spent[part])),
            "wall s": float(np.median(walls[part])),
        }
        for part in spent
    ]
    total = {key: sum(row[key] for row in rows) for key in ("CPU s", "wall s")}
    rows.append({"part": f"one check of {length:.1f} s ({len(hashes)} hash)", **total})
    return rows


def main() -> None:
    parser = report.options(__doc__)
    parser.add_argument("--class", dest="students", action="store_true", help="measure a class")
    parser.add_argument("--count", type=int, default=150, help="submissions of the class")
    parser.add_argument("--jobs", type=int, default=2, help="processes of the class")
    parser.add_argument("--dask", action="store_true", help="and again on a local dask cluster")
    options = parser.parse_args()
    if options.students:
        import class_check  # joblib, which one check does not need

        examples = Path(__file__).parents[1] / "examples"
        rubric = files.read(examples / "rubrics" / "pick_and_place.yaml")
        count = report.scaled(options, 1, min(options.count, 8), options.count)
        found = class_check.rows(
            rubric, scene(), examples / "pick_and_place_ur5e.mat",
            count=count, jobs=options.jobs, dask=options.dask,
        )  # fmt: skip
        report.show("Class", found, options.json)
        return
    report.show("Check", checks(report.scaled(options, 1, 3, 20)), options.json)


if __name__ == "__main__":
    main()
