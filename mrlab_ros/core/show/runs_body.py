"""The runs of a session on its page: a table, and each run's actions, tool path and joints."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from mrlab_ros.core.foreign_text import for_html as escape
from mrlab_ros.core.recording.report import SessionReport
from mrlab_ros.core.recording.report_text import lasting
from mrlab_ros.core.recording.runs import Action, Course, Result, Run, RunJoint
from mrlab_ros.core.show.run_figures_body import run_figures
from mrlab_ros.core.show.svg import HATCH, Mark, Strip, strip_svg, time_axis_svg
from mrlab_ros.core.show.tool_path import Spot, tool_path_svg

# Of more runs only the first ones are drawn: a page that opens at once is worth more.
MOST_DRAWN = 40
CLASSES = {
    Result.COMPLETED: "completed",
    Result.STOPPED: "stopped",
    Result.HALTED: "halted",
    Result.OPEN: "open",
}
# Paths of 24 x 24: a tick, a square, a cross, a triangle.
ICONS = {
    Result.COMPLETED: "M9.2 16.6 4.9 12.3l-1.6 1.6 5.9 5.9L21 8l-1.6-1.6z",
    Result.STOPPED: "M6.5 6.5h11v11h-11z",
    Result.HALTED: "M18.4 7 17 5.6l-5 5-5-5L5.6 7l5 5-5 5L7 18.4l5-5 5 5 1.4-1.4-5-5z",
    Result.OPEN: "M8 5.5v13l10-6.5z",
}


def runs_table(report: SessionReport, began: str) -> str:
    """Return the table of all runs, one a row, with what was done in each.

    began: the session, as `2026-01-01 08:00:00`.
    """
    if not report.runs:
        return '<section class="runs"><h2>Runs</h2><p class="said">No robot played.</p></section>'
    heads = "".join(
        f'<th scope="col">{head}</th>'
        for head in ("Run", "Robot", "Trajectory", "Began", "Took", "Result", "What it did")
    )
    rows = "".join(_row(run, began) for run in report.runs)
    return (
        f'<section class="runs" aria-label="Runs"><h2>Runs</h2><table><thead><tr>{heads}</tr>'
        f"</thead><tbody>{rows}</tbody></table></section>"
    )


def _row(run: Run, began: str) -> str:
    system = f"<small>{escape(run.system)}</small>" if run.system else ""
    done = "".join(
        f'<li class="{severity(a)}"><button type="button" data-time="{a.time:.3f}">'
        f"{lasting(a.time)}</button> <span>{_words(a)}</span></li>"
        for a in run.actions
    )
    return (
        f'<tr><td class="no"><button type="button" data-time="{run.start:.3f}" '
        f'aria-label="Run {run.number}, go to its beginning">{run.number}</button></td>'
        f'<td class="robot">{breakable(run.robot)}{system}</td>'
        f"<td>{breakable(run.trajectory)}{_speed(run)}</td>"
        f'<td class="figure">{lasting(run.start)}<small>{_of_day(began, run.start)}</small></td>'
        f'<td class="figure"><span class="head-word">Took</span> {lasting(run.duration)}</td>'
        f'<td class="result {CLASSES[run.result]}">{_icon(run)}'
        f'<span class="said">{escape(str(run.outcome))}</span></td>'
        f"<td><ul>{done}</ul>{_followed(run)}</td></tr>"
    )


def _of_day(began: str, seconds: float) -> str:
    """Return the time of the day `seconds` after the session began."""
    hours, minutes, whole = map(int, began[-8:].split(":"))
    at = hours * 3600 + minutes * 60 + int(whole + seconds)
    return f"{at // 3600 % 24:02d}:{at // 60 % 60:02d}:{at % 60:02d}"


def breakable(name: str) -> str:
    """Return a name that may be broken after its underscores, as HTML."""
    return escape(name).replace("_", "_<wbr>")


def _speed(run: Run) -> str:
    return "".join(
        f" <small>{s:g}\N{MULTIPLICATION SIGN}</small>"
        for s in run.speeds[-1:]
        if s not in (0.0, 1.0)
    )


def _words(action: Action) -> str:
    return f'<span class="said">{escape(str(action.said))}</span>'


def severity(action: Action) -> str:
    """Return how grave an action is: error, warning or info."""
    return action.said.severity.name.lower()


def _icon(run: Run) -> str:
    return f'<svg viewBox="0 0 24 24" aria-hidden="true"><path d="{ICONS[run.result]}"/></svg>'


def _followed(run: Run) -> str:
    if run.deviation is None:
        return ""
    return f'<p class="followed said">{escape(str(run.deviation.said))}</p>'


def run_plots(report: SessionReport) -> str:
    """Return tool path and joints of each run, the first one open."""
    drawn = [run for run in report.runs if run.course is not None]
    parts = [
        _plots(run, run.course, opened=number == 0)
        for number, run in enumerate(drawn[:MOST_DRAWN])
        if run.course is not None
    ]
    if len(drawn) > MOST_DRAWN:
        parts.append(
            f'<p class="said">The first {MOST_DRAWN} of {len(drawn)} runs are drawn; '
            "report.json has all.</p>"
        )
    return (HATCH if parts else "") + "".join(parts)


def _plots(run: Run, course: Course, *, opened: bool) -> str:
    duration = max(run.duration, 1e-3)
    marks = tuple(
        Mark(number, severity(action), action.time, action.time)
        for number, action in enumerate(run.actions, 1)
        if action.time <= run.end
    )
    strips = "".join(
        f"<div><h3>{escape(joint.name)}{_range(joint)}</h3>"
        f"{strip_svg(_strip(course, run.joints, j, marks), course.times, duration, run.start)}"
        f"{time_axis_svg(duration, begin=run.start)}</div>"
        for j, joint in enumerate(run.joints)
    )
    return (
        f"<details{' open' * opened}><summary><h2>Run {run.number}</h2> "
        f"<span>{escape(run.robot)} · {escape(run.trajectory)} · "
        f'<span class="said">{escape(str(run.outcome))}</span></span></summary>'
        f"{_motion(run, course)}"
        f'<div class="strips">{strips}</div></details>'
    )


def _strip(course: Course, joints: Sequence[RunJoint], j: int, marks: tuple[Mark, ...]) -> Strip:
    joint = joints[j]
    scale = 1.0 if joint.prismatic else math.degrees(1.0)
    lower, upper = (None if v is None else v * scale for v in (joint.lower, joint.upper))
    known = np.isfinite(course.expected[:, j]).any()
    return Strip(
        joint.name,
        "m" if joint.prismatic else "deg",
        course.joints[:, j] * scale,
        (lower, upper),
        j % 7 + 1,
        marks,
        course.expected[:, j] * scale if known else None,
    )


def _range(joint: RunJoint) -> str:
    """Return the range that a joint may be in; empty where none is known."""
    if joint.lower is None or joint.upper is None:
        return ""
    scale, unit = (1.0, " m") if joint.prismatic else (math.degrees(1.0), "°")
    low, high = (
        f"{value * scale:.4g}".replace("-", "\N{MINUS SIGN}")
        for value in (joint.lower, joint.upper)
    )
    return f" <small>{low} … {high}{unit}</small>"


def _motion(run: Run, course: Course) -> str:
    """Return the tool's way with the places of what was done, beside the run's figures."""
    items = "".join(
        f'<li class="{severity(a)}"><button type="button" data-time="{a.time:.3f}">'
        f'<span class="number" aria-hidden="true">{number}</span>'
        f"<span><b>{lasting(a.time)}</b> {_words(a)}</span></button></li>"
        for number, a in enumerate(run.actions, 1)
    )
    return (
        f'<div class="run-motion">{_way(run, course)}<div class="run-said">'
        f"{run_figures(run, course)}{f'<ol>{items}</ol>' if items else ''}</div></div>"
    )


def _way(run: Run, course: Course) -> str:
    if course.tool is None or not np.isfinite(course.tool).any():
        return ""
    spots = []
    for number, action in enumerate(run.actions, 1):
        row = int(np.argmin(np.abs(course.times - action.time)))
        place = course.tool[row]
        if np.isfinite(place).all():
            x, y, z = (float(v) for v in place)
            spots.append(Spot(number, severity(action), (x, y, z)))
    reference = course.expected_tool
    drawn = None if reference is None or not np.isfinite(reference).any() else reference
    dashed = (
        ' <span><i class="key dashed"></i> <span>reference</span></span>'
        if drawn is not None
        else ""
    )
    return (
        '<div><h3>Way of the tool</h3><p class="keys"><span><i class="key first"></i> '
        '<span>begins</span></span> <span><i class="key last"></i> <span>ends</span></span>'
        f'{dashed}</p><div class="tool-way">{tool_path_svg(course.tool, drawn, spots)}</div></div>'
    )
