"""How `mrlab check` reports to a person: verdict, findings, conditions, figures, hash."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from rich.console import Console
from rich.table import Table
from rich.text import Text

from mrlab_ros.commands import output
from mrlab_ros.commands.convert.options import command_with
from mrlab_ros.core.base.diagnostic import Diagnostic
from mrlab_ros.core.base.phrase import phrase
from mrlab_ros.core.checking.diagnostics import CLAIM
from mrlab_ros.core.checking.report import CheckReport, RobotReport, State
from mrlab_ros.core.conversion.options import Options
from mrlab_ros.core.runtime.colours import OUTCOME_STYLES, SEVERITY_STYLES

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
