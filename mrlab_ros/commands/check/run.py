"""What `mrlab check` does with one file: check, print, write the page."""

from __future__ import annotations

import csv
import json
from dataclasses import dataclass, replace
from pathlib import Path

from mrlab_ros.adapters.checking.stage import Stage
from mrlab_ros.adapters.robots.library import RobotLibrary
from mrlab_ros.commands.check import words
from mrlab_ros.commands.check.diagnostics import (
    FOR_ONE_MOTION,
    NO_PAGE,
    PAGE_NOT_WRITTEN,
    POINTS_NOT_READ,
    SAID_BY_RUBRIC,
    TOO_FAR_TO_MEASURE,
)
from mrlab_ros.commands.check.one import CELLS, CheckedFile, Setting, check_file, scene_of
from mrlab_ros.commands.convert import report as conversion_report
from mrlab_ros.core.base.errors import BadInput, Misuse
from mrlab_ros.core.base.geometry import Vector
from mrlab_ros.core.checking.evidence import CLOSE
from mrlab_ros.core.checking.rehearsal import FARTHEST
from mrlab_ros.core.checking.waypoints import points_from_rows
from mrlab_ros.core.conversion.convert import ConversionResult
from mrlab_ros.core.conversion.options import Options
from mrlab_ros.core.rubrics.marking import Marks
from mrlab_ros.ros import share

READY, REFUSED, COULD_NOT = 0, 1, 2


@dataclass(frozen=True)
class Request:
    """The arguments of the command; within, closest: m; closest: None where it is not given."""

    file: Path
    robot: str
    tool: str
    scene: str
    points: Path | None
    within: float
    closest: float | None
    out: Path | None
    as_json: bool
    options: Options
    rubric: Path | None = None


def run(request: Request) -> int:
    """Check, print, and return the exit code; raise LabError where nothing can be checked."""
    if request.file.suffix.lower() in CELLS and (
        request.robot or request.tool or request.points is not None
    ):
        option = "robot" if request.robot else "tool" if request.tool else "points"
        raise Misuse(FOR_ONE_MOTION(option=option, file=request.file.name))
    if request.closest is not None and request.closest > FARTHEST:
        raise Misuse(TOO_FAR_TO_MEASURE(value=request.closest, most=FARTHEST))
    folder = share.directory()
    if request.rubric is not None:
        return _marked(request, request.rubric, folder)
    setting = Setting(
        Stage(folder, RobotLibrary(folder / "robots")), scene_of(request.scene, folder),
        request.scene, request.robot, request.tool, request.options,
        CLOSE if request.closest is None else request.closest,
        _points(request.points), request.within, drawn=request.out is not None,
    )  # fmt: skip
    return _finish(request, check_file(request.file, setting), setting, folder)


def _marked(request: Request, path: Path, folder: Path) -> int:
    """Check in the setting of a rubric, and show its marks beside the report."""
    from mrlab_ros.adapters.rubrics import files
    from mrlab_ros.commands.rubric import words as marks_words
    from mrlab_ros.commands.rubric.marked import compared, mark_file, reference_of, setting_of

    for option in ("robot", "tool", "scene", "closest"):
        if getattr(request, option) not in ("", None):
            raise Misuse(SAID_BY_RUBRIC(option=option))
    rubric = files.read(path)
    stage = Stage(folder, RobotLibrary(folder / "robots"))
    setting = replace(
        setting_of(rubric, stage, folder, request.options),
        points=_points(request.points),
        within=request.within,
    )
    reference = reference_of(rubric, setting) if compared(rubric) else None
    found, marks = mark_file(request.file, rubric, setting, reference)
    code = _finish(request, found, setting, folder, marks)
    if not request.as_json and found.holds_motion:
        print()
        marks_words.marks(request.file, rubric, marks, found.checked)
    return code


def _finish(
    request: Request,
    found: CheckedFile,
    setting: Setting,
    folder: Path,
    marks: Marks | None = None,
) -> int:
    """Print the report and write its page; return the exit code."""
    if not found.holds_motion:
        assert found.result is not None
        _say_refused(request, found.result)
        return COULD_NOT
    report, document = found.checked.report, found.checked.document
    if request.as_json:
        print(json.dumps(document if marks is None else {**document, "marks": marks.plain()}))
    else:
        words.show(report, document, _given(request), request.options)
    if request.out is not None and found.played is not None:
        size = write_page(request.out, found, setting.stage, folder, marks)
        if not request.as_json:
            print(f"{request.out} ({size / 1e6:.2f} MB)")
    elif request.out is not None and not request.as_json:
        print(NO_PAGE())
    return REFUSED if report.refusing else READY


def _points(path: Path | None) -> tuple[Vector, ...]:
    if path is None:
        return ()
    try:
        with path.open(newline="", encoding="utf-8-sig") as file:
            return points_from_rows(list(csv.reader(file)), path.name)
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        why = error.strerror if isinstance(error, OSError) else error
        raise BadInput(POINTS_NOT_READ(file=str(path), why=str(why))) from None


def _say_refused(request: Request, result: ConversionResult) -> None:
    """Say why nothing could be checked, with the commands that mend it."""
    if request.as_json:
        print(json.dumps(conversion_report.record(str(request.file), result, None)))
        return
    conversion_report.show(result, None, _given(request), request.options)


def _given(request: Request) -> list[str]:
    """Return the words of the command, without the options of a conversion."""
    given = ["mrlab", "check", str(request.file)]
    if request.rubric is not None:
        given += ["--rubric", str(request.rubric)]
    given += ["--robot", request.robot] if request.robot else []
    given += ["--tool", request.tool] if request.tool else []
    given += ["--scene", request.scene] if request.scene else []
    return given


def write_page(
    out: Path,
    found: CheckedFile,
    stage: Stage,
    folder: Path,
    marks: Marks | None = None,
    *,
    title: str = "",
    with_film: bool = True,
) -> int:
    """Write the page of a file that was rehearsed; return how many characters it has.

    marks: what it got, with links to the instants of lost points. title: empty: the file's name.
    with_film: see `check_page`. Raises BadInput where it cannot be written.
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
        replace(found.checked.report, title=title or found.checked.report.title),
        found.checked.document["hash"], found.played.recorded, shown, found.played.objects,
        stage.library, folder, marks, with_film=with_film,
    )  # fmt: skip
    try:
        out.parent.mkdir(parents=True, exist_ok=True)
        out.write_text(text, encoding="utf-8")
    except OSError as error:
        raise BadInput(PAGE_NOT_WRITTEN(file=str(out), why=error.strerror)) from None
    return len(text)
