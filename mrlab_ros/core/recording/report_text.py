"""The report of a session as text: one row a run, what was done in it, technical figures last."""

from __future__ import annotations

import math
from collections.abc import Sequence

from mrlab_ros.core.recording.report import Series, SessionReport
from mrlab_ros.core.recording.runs import Deed, Deviation, Run, RunJoint

HEADINGS = ("run", "robot", "trajectory", "began", "took", "result")
# Beyond this a run did not follow its reference, rad or m: rounding is far below.
FOLLOWED = 1e-4
# Below this a figure is rounding, in any unit that is shown.
NOTHING = 1e-9


def report_lines(report: SessionReport) -> list[str]:
    """Return the report as lines of text."""
    lines = [summary(report), *report.troubles, ""]
    lines += _table(report.runs)
    idle = without_runs(report)
    if idle:
        lines += ["", f"without a run: {', '.join(idle)}"]
    technical = technical_lines(report)
    return [*lines, "", "technical", *technical] if technical else lines


def without_runs(report: SessionReport) -> list[str]:
    """Return the names of the robots that played nothing."""
    played = {run.robot for run in report.runs}
    return [name for name in report.robots if name not in played]


def lasting(seconds: float, digits: int = 2) -> str:
    """Return a length of time for a person: 7.60 s, from 100 s on 2:05.3 min or 1:02:05 h."""
    if round(seconds, digits) < 100:
        return f"{seconds:.{digits}f} s"
    tenths = round(seconds * 10)
    if tenths < 36_000:
        return f"{tenths // 600}:{tenths % 600 / 10:04.1f} min"
    whole = round(seconds)
    return f"{whole // 3600}:{whole // 60 % 60:02d}:{whole % 60:02d} h"


def shown(value: float) -> str:
    """Return a figure in three digits; what differs from nothing by rounding alone is 0."""
    return f"{value:.3g}" if abs(value) >= NOTHING else "0"


def summary(report: SessionReport) -> str:
    """Return how long it was, how many played how often, and how that ended, in one line."""
    robots, runs = len(report.robots), len(report.runs)
    parts = [lasting(report.duration, 1), _count(robots, "robot"), _count(runs, "run")]
    done = sum(run.result.name == "COMPLETED" for run in report.runs)
    hits = sum(a.deed is Deed.HIT for run in report.runs for a in run.actions)
    if runs:
        parts.append(f"{done} completed")
    if hits:
        parts.append(_count(hits, "collision"))
    return ", ".join(parts)


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
        run.outcome(),
    )


def deviation_text(deviation: Deviation, joints: Sequence[RunJoint]) -> str:
    """Return how a run followed its reference, for a person."""
    prismatic = any(joint.prismatic for joint in joints if joint.name == deviation.joint)
    tool = "" if deviation.tool is None else f", the tool {deviation.tool * 1e3:.1f} mm"
    if deviation.most < FOLLOWED:
        return f"followed {deviation.reference} exactly"
    most = (
        f"{deviation.most * 1e3:.1f} mm"
        if prismatic
        else f"{math.degrees(deviation.most):.2f} deg"
    )
    return (
        f"up to {most} from {deviation.reference} ({deviation.joint} at "
        f"{lasting(deviation.time)}){tool}"
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
            lines += _figures(f"latency {hop}", series, "ms", 1e3)
    if report.latency:
        lines.append("  latency of all topics")
        for hop, series in report.latency.items():
            lines += _figures(hop, series, "ms", 1e3)
    return lines


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
        lines += [
            f"{indent}{lasting(action.time):>10}  {action.text}"
            + (f", {action.detail}" if action.detail else "")
            for action in run.actions
        ]
        if run.deviation is not None:
            lines.append(f"{indent}{'':10}  {deviation_text(run.deviation, run.joints)}")
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
