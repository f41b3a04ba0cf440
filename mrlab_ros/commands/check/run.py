"""The work of `mrlab check` for one file: check, print, write the page.

How `mrlab check` reports to a person: verdict, findings, conditions, figures, hash.
"""

from __future__ import annotations

import csv
import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from rich.console import Console
from rich.table import Table
from rich.text import Text

from mrlab_ros.adapters import share
from mrlab_ros.adapters.robots.library import RobotLibrary
from mrlab_ros.app.check.file import CELLS, CheckedFile, Setting, check_file, scene_of
from mrlab_ros.app.check.stage import Stage
from mrlab_ros.commands import output
from mrlab_ros.commands.check.diagnostics import (
    FOR_ONE_MOTION,
    NO_PAGE,
    POINTS_NOT_READ,
    TOO_FAR_TO_MEASURE,
)
from mrlab_ros.commands.convert import report as conversion_report
from mrlab_ros.commands.convert.options import command_with
from mrlab_ros.core.base.diagnostic import Diagnostic
from mrlab_ros.core.base.errors import BadInput, WrongUsage
from mrlab_ros.core.base.geometry import Vector
from mrlab_ros.core.base.phrase import phrase
from mrlab_ros.core.checking.diagnostics import CLAIM
from mrlab_ros.core.checking.evidence import CLOSE
from mrlab_ros.core.checking.rehearsal import FARTHEST
from mrlab_ros.core.checking.report import CheckReport, RobotReport, State
from mrlab_ros.core.checking.waypoints import points_from_rows
from mrlab_ros.core.conversion.convert import ConversionResult
from mrlab_ros.core.conversion.options import Options
from mrlab_ros.core.runtime.colours import OUTCOME_STYLES, SEVERITY_STYLES

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


def run(request: Request) -> int:
    """Check, print, and return the exit code; raise LabError where nothing can be checked."""
    if request.file.suffix.lower() in CELLS and (
        request.robot or request.tool or request.points is not None
    ):
        option = "robot" if request.robot else "tool" if request.tool else "points"
        raise WrongUsage(FOR_ONE_MOTION(option=option, file=request.file.name))
    if request.closest is not None and request.closest > FARTHEST:
        raise WrongUsage(TOO_FAR_TO_MEASURE(value=request.closest, most=FARTHEST))
    folder = share.directory()
    setting = Setting(
        Stage(folder, RobotLibrary(folder / "robots")), scene_of(request.scene, folder),
        request.scene, request.robot, request.tool, request.options,
        CLOSE if request.closest is None else request.closest,
        _points(request.points), request.within, drawn=request.out is not None,
    )  # fmt: skip
    return _finish(request, check_file(request.file, setting), setting, folder)


def _finish(
    request: Request,
    found: CheckedFile,
    setting: Setting,
    folder: Path,
) -> int:
    """Print the report and write its page; return the exit code."""
    if not found.holds_motion:
        assert found.result is not None
        _say_refused(request, found.result)
        return COULD_NOT
    report, document = found.checked.report, found.checked.document
    if request.as_json:
        print(json.dumps(document))
    else:
        show(report, document, _given(request), request.options)
    if request.out is not None and found.played is not None:
        from mrlab_ros.app.show.check import write_page  # trimesh is slow to import

        size = write_page(request.out, found, setting.stage, folder)
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
    given += ["--robot", request.robot] if request.robot else []
    given += ["--tool", request.tool] if request.tool else []
    given += ["--scene", request.scene] if request.scene else []
    return given


MARKS = {State.OK: "ok", State.NOT: "NOT", State.UNKNOWN: "unknown"}
STYLES = {
    State.OK: OUTCOME_STYLES["accepted"],
    State.NOT: OUTCOME_STYLES["rejected"],
    State.UNKNOWN: OUTCOME_STYLES["ambiguous"],
}
MOST_FINDINGS, MOST_CLEARANCES, MOST_PAIRS = 40, 8, 10


def show(
    report: CheckReport, document: Mapping[str, Any], given: list[str], options: Options
) -> None:
    """Print the report. given: the words of the command, without its `options`."""
    console = output.console(width=output.REPORT_WIDTH)
    style = OUTCOME_STYLES["rejected" if report.refusing else "accepted"]
    console.print(str(report.summary), style=style, soft_wrap=True)
    if report.findings:
        console.print()
        _findings(console, report)
        for fix in dict.fromkeys(fix for found in report.refusing for fix in found.fixes):
            if fix.option:
                command = command_with(given, options, fix.option, fix.value)
                console.print(f"  try: {command}", soft_wrap=True)
    for robot in report.robots:
        _robot(console, robot, several=len(report.robots) > 1)
    _distances(console, report)
    console.print(f"\n{CLAIM()}")
    console.print(f"report {document['hash']}", soft_wrap=True)


def _findings(console: Console, report: CheckReport) -> None:
    several = len(report.robots) > 1
    table = Table("", "time", box=None)
    for name in (*(["robot"] if several else []), "link"):
        table.add_column(name, overflow="fold")
    table.add_column("finding", min_width=24)
    table.add_column("value", justify="right")
    table.add_column("limit", justify="right")
    for found in report.findings[:MOST_FINDINGS]:
        severity = found.severity.name.lower()
        table.add_row(
            Text(severity, SEVERITY_STYLES[severity]),
            _time(found),
            *([found.robot] if several else []),
            found.link or found.joint,
            Text.assemble(found.message, "\n", (found.remedy, "dim")),
            _number(found.value, found.unit),
            _number(found.limit, found.unit),
        )
    console.print(table)
    left = len(report.findings) - MOST_FINDINGS
    if left > 0:
        console.print(f"  and {left} more; --json has all")


def _robot(console: Console, robot: RobotReport, *, several: bool) -> None:
    name = f"{robot.name}: " if several else ""
    console.print(f"\n{name}ready for hardware", style="bold")
    table = Table(box=None, show_header=False)
    for condition in robot.hardware:
        mark = Text(MARKS[condition.state], STYLES[condition.state])
        table.add_row(mark, str(condition.condition), Text(str(condition.found), "dim"))
    console.print(table)
    f = robot.figures
    if f:
        smooth = f["smoothness_sparc"]
        words = [
            f"cycle {f['cycle_time']:.2f} s of {f['duration']:.2f} s",
            f"tool at most {f['tool_speed']:.2f} m/s over {f['path_length']:.2f} m",
            f"conditioning at least {f['least_conditioning']:.2g}",
        ]
        if smooth is not None:
            words.append(f"smoothness (SPARC) {smooth:.2f}")
        console.print("  " + "; ".join(words))


def _distances(console: Console, report: CheckReport) -> None:
    near = [c for c in report.clearances if not c.far][:MOST_CLEARANCES]
    if near:
        console.print("\nleast distances", style="bold")
        table = Table(box=None, show_header=False)
        for one in near:
            who = one.held or one.link
            who = f"{one.robot} {who}" if len(report.robots) > 1 else who
            what = f"{one.other} {one.other_link}".strip()
            table.add_row(_number(max(one.distance, 0.0), "m"), who, what, f"{one.time:.2f} s")
        console.print(table)
    _pairs(console, report.extras.get("pairs", ()))
    held: dict[str, str] = {}
    for grasp in report.grasps:
        before = held.get(grasp.robot, "")
        if grasp.object == before:
            continue
        held[grasp.robot] = grasp.object
        mass = f", {grasp.load.mass:.3g} kg" if grasp.load else ""
        said = f"holds {grasp.object}{mass}" if grasp.object else f"lets go of {before}"
        console.print(f"  {grasp.time:.2f} s {grasp.robot} {said}")


def _pairs(console: Console, pairs: Sequence[Mapping[str, Any]]) -> None:
    """Print each pair of robots of a cell: the nearest, and when they first conflict."""
    if not pairs:
        return
    console.print("\npairs of robots", style="bold")
    table = Table(box=None, show_header=False)
    for pair in pairs[:MOST_PAIRS]:
        if pair["distance"] is None:
            near, when = "over 500 mm", ""
        else:
            near, when = _number(max(pair["distance"], 0.0), "m"), f"{pair['time']:.2f} s"
        conflict = ""
        if pair["conflict"] is not None:
            conflict = (
                f"conflict at {pair['conflict']:.2f} s, closing at {pair['closing']:.2f} m/s"
            )
        table.add_row(near, f"{pair['robot']} and {pair['other']}", when, conflict)
    console.print(table)
    if len(pairs) > MOST_PAIRS:
        console.print(f"  and {len(pairs) - MOST_PAIRS} more pairs; --json has all")


def _time(found: Diagnostic) -> str:
    if found.time is None:
        return ""
    if found.end is None or found.end - found.time < 0.01:
        return f"{found.time:.2f} s"
    return f"{found.time:.2f}-{found.end:.2f} s"


def _number(value: float | None, unit: str) -> str:
    if value is None:
        return ""
    return phrase("{value:measure}").fill({"value": value, "unit": unit})
