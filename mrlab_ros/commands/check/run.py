"""What `mrlab check` does with one file: check, print, write the page."""

from __future__ import annotations

import csv
import json
from dataclasses import dataclass
from pathlib import Path

from mrlab_ros.adapters.checking.stage import Stage
from mrlab_ros.adapters.robots.library import RobotLibrary
from mrlab_ros.commands.check import words
from mrlab_ros.commands.check.one import CELLS, CheckedFile, Setting, check_file, scene_of
from mrlab_ros.commands.convert import report as conversion_report
from mrlab_ros.core.checking.waypoints import points_from_rows
from mrlab_ros.core.conversion.convert import ConversionResult
from mrlab_ros.core.conversion.options import Options
from mrlab_ros.core.errors import BadInput, Misuse
from mrlab_ros.core.geometry import Vector
from mrlab_ros.ros import share

READY, REFUSED, COULD_NOT = 0, 1, 2
NO_MOTION = "the file holds no motion that could be rehearsed; mrlab show draws what it holds"


@dataclass(frozen=True)
class Request:
    """The arguments of the command; within, closest: m."""

    file: Path
    robot: str
    tool: str
    scene: str
    points: Path | None
    within: float
    closest: float
    out: Path | None
    as_json: bool
    options: Options


def run(request: Request) -> int:
    """Check, print, and return the exit code; raise LabError where nothing can be checked."""
    if request.file.suffix.lower() in CELLS and (request.robot or request.points is not None):
        option = "--robot" if request.robot else "--points"
        raise Misuse(f"{option} is for one motion; {request.file.name} is a cell of several")
    folder = share.directory()
    setting = Setting(
        Stage(folder, RobotLibrary(folder / "robots")), scene_of(request.scene, folder),
        request.scene, request.robot, request.tool, request.options, request.closest,
        _points(request.points), request.within, drawn=request.out is not None,
    )  # fmt: skip
    found = check_file(request.file, setting)
    if not found.holds_motion:
        assert found.result is not None
        _say_refused(request, found.result)
        return COULD_NOT
    return _finish(request, found, setting, folder)


def _points(path: Path | None) -> tuple[Vector, ...]:
    if path is None:
        return ()
    try:
        with path.open(newline="", encoding="utf-8-sig") as file:
            return points_from_rows(list(csv.reader(file)), path.name)
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        reason = error.strerror if isinstance(error, OSError) else error
        raise BadInput(
            f"the points in {path} cannot be read: {reason}; expected a CSV with x, y, z in m"
        ) from None


def _say_refused(request: Request, result: ConversionResult) -> None:
    """Say why nothing could be checked, with the commands that mend it."""
    if request.as_json:
        print(json.dumps(conversion_report.record(str(request.file), result, None)))
        return
    given = ["mrlab", "check", str(request.file), "--robot", request.robot]
    given += ["--tool", request.tool] if request.tool else []
    given += ["--scene", request.scene] if request.scene else []
    conversion_report.show(result, None, given, request.options)


def _finish(request: Request, found: CheckedFile, setting: Setting, folder: Path) -> int:
    """Print the report and write its page; return the exit code."""
    report, document = found.checked.report, found.checked.document
    if request.as_json:
        print(json.dumps(document))
    else:
        words.show(report, document)
    if request.out is not None and found.played is not None:
        size = write_page(request.out, found, setting.stage, folder)
        if not request.as_json:
            print(f"{request.out} ({size / 1e6:.2f} MB)")
    elif request.out is not None and not request.as_json:
        print(f"no page is written: {NO_MOTION}")
    return REFUSED if report.refusing else READY


def write_page(out: Path, found: CheckedFile, stage: Stage, folder: Path) -> int:
    """Write the page of a file that was rehearsed; return how many characters it has.

    Raises BadInput where it cannot be written.
    """
    from mrlab_ros.adapters.pages.check import check_page
    from mrlab_ros.core.show.check import PlayedRobot

    assert found.played is not None
    motions = {m.robot.name: (m.trajectory, m.figures) for m in found.checked.motions}
    shown = [
        PlayedRobot(
            r.name,
            r.model.id,
            r.end_effector,
            stage.library.description(r.model.id, r.end_effector or None),
            (*r.model.joint_names, *found.played.fingers[r.name]),
            (*r.pose.position, *r.pose.orientation),
            *motions.get(r.name, (None, None)),
        )
        for r in found.robots
    ]
    text = check_page(
        found.checked.report, found.checked.document["hash"], found.played.recorded, shown,
        found.played.objects, stage.library, folder,
    )  # fmt: skip
    try:
        out.parent.mkdir(parents=True, exist_ok=True)
        out.write_text(text, encoding="utf-8")
    except OSError as error:
        raise BadInput(f"{out} cannot be written: {error.strerror}") from None
    return len(text)
