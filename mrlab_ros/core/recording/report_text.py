"""The report of a session as text: one row a run, what was done in it, technical figures last."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from mrlab_ros.core.base.diagnostic import Diagnostic
from mrlab_ros.core.base.foreign_text import visible
from mrlab_ros.core.base.phrase import QUANTITIES
from mrlab_ros.core.recording.report import Hop, Series, SessionReport
from mrlab_ros.core.recording.runs import Run

HEADINGS = ("run", "robot", "trajectory", "began", "took", "result")
# Below this a figure is rounding, in any unit that is shown.
NOTHING = 1e-9


def report_lines(report: SessionReport, worded: Callable[[Diagnostic], str] = str) -> list[str]:
    """Return the report as lines of text. worded: returns what is said of a trouble.

    A name in a bag may hold the end of a line: it is shown, and ends none.
    """
    lines = _table(report.runs)
    idle = without_runs(report)
    if idle:
        lines += ["", f"without a run: {', '.join(idle)}"]
    technical = technical_lines(report)
    if technical:
        lines += ["", "technical", *technical]
    head = [visible(str(report.summary)), *map(worded, report.troubles), ""]
    return [*head, *map(visible, lines)]


def without_runs(report: SessionReport) -> list[str]:
    """Return the names of the robots that played nothing."""
    played = {run.robot for run in report.runs}
    return [name for name in report.robots if name not in played]


def lasting(seconds: float) -> str:
    """Return a length of time for a person: 7.60 s, from 100 s on 2:05.3 min or 1:02:05 h."""
    return QUANTITIES["duration"](seconds, ())


def shown(value: float) -> str:
    """Return a figure in three digits; what differs from nothing by rounding alone is 0."""
    return f"{value:.3g}" if abs(value) >= NOTHING else "0"


def row_of(run: Run) -> tuple[str, ...]:
    """Return a run as the words below HEADINGS."""
    speed = "".join(f" at {s:g}x" for s in run.speeds[-1:] if s not in (0.0, 1.0))
    system = f" in {run.system}" if run.system else ""
    return (
        str(run.number),
        f"{run.robot}{system}",
        f"{run.trajectory}{speed}",
        lasting(run.start),
        lasting(run.duration),
        run.outcome.message,
    )


def technical_lines(report: SessionReport) -> list[str]:
    """Return deadlines, latency and counts, robot by robot."""
    lines = []
    for robot in report.robots.values():
        lines.append(
            f"  {robot.name} ({robot.model or 'model unknown'}): "
            f"{_count(robot.joint_states, 'joint state')}, {robot.frames_lost} frames left out, "
            f"{_count(len(robot.contacts), 'contact')}"
        )
        lines += _figures("tracking error", robot.tracking, "rad", 1.0)
        lines += _figures("deadline error", robot.deadline, "ms", 1e3)
        for hop, series in robot.latency.items():
            lines += _figures(f"latency {hop_text(hop)}", series, "ms", 1e3)
    if report.latency:
        lines.append("  latency of all topics")
        for hop, series in report.latency.items():
            lines += _figures(hop_text(hop), series, "ms", 1e3)
    return lines


def hop_text(hop: Hop) -> str:
    """Return the way of a message whose latency was measured, for a person."""
    return hop.ends.replace("_", " ") + (f" by {hop.observer}" if hop.observer else "")


def _table(runs: Sequence[Run]) -> list[str]:
    if not runs:
        return ["no robot played"]
    rows = [HEADINGS, *map(row_of, runs)]
    widths = [max(len(row[column]) for row in rows) for column in range(len(HEADINGS))]
    right = (0, 3, 4)

    def line(row: tuple[str, ...]) -> str:
        cells = [
            cell.rjust(width) if column in right else cell.ljust(width)
            for column, (cell, width) in enumerate(zip(row, widths, strict=True))
        ]
        return "  ".join(cells).rstrip()

    lines = [line(HEADINGS)]
    indent = " " * (widths[0] + 2)
    for run in runs:
        lines.append(line(row_of(run)))
        lines += [f"{indent}{lasting(action.time):>10}  {action.said}" for action in run.actions]
        if run.deviation is not None:
            lines.append(f"{indent}{'':10}  {run.deviation.said}")
    return lines


def _figures(what: str, series: Series, unit: str, scale: float) -> list[str]:
    figures = series.summary()
    if not figures["count"]:
        return []
    values = ", ".join(
        f"{name} {shown(float(figures[name] or 0) * scale)} {unit}"
        for name in ("p50", "p95", "max")
    )
    return [f"    {what}: {values} ({figures['count']})"]


def _count(number: int, what: str) -> str:
    return f"{number} {what}{'s' * (number != 1)}"
