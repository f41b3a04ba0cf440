"""The technical end of a session's page: deadlines, tracking and latency of each robot."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from mrlab_ros.core.foreign_text import for_html as escape
from mrlab_ros.core.recording.report import Series, SessionReport
from mrlab_ros.core.recording.report_text import hop_text, shown
from mrlab_ros.core.show.svg import Strip, strip_svg, time_axis_svg

MOST_DRAWN = 16
Row = tuple[str, str, str, Series, float]


def technical(report: SessionReport) -> str:
    """Return a table of figures and a strip for each quantity that was measured."""
    rows = list(_rows(report))
    if not rows and not report.robots:
        return ""
    counts = "".join(
        f"<tr><td>{escape(robot.name)}</td><td>joint states</td>"
        f'<td class="figure" colspan="3">{robot.joint_states} recorded, {robot.frames_lost} left '
        f"out, {len(robot.contacts)} contacts</td></tr>"
        for robot in report.robots.values()
    )
    figures = "".join(map(_figures, rows))
    axis = time_axis_svg(report.duration)
    strips = "".join(
        f"<div><h3>{escape(owner)} {escape(what)}</h3>"
        f"{strip_svg(_strip(row), np.array(series.times), report.duration)}{axis}</div>"
        for row in rows[:MOST_DRAWN]
        for owner, what, _, series, _ in (row,)
    )
    return (
        "<details><summary><h2>Technical</h2> <span>deadlines, latency, tracking</span></summary>"
        '<table class="technical"><thead><tr><th scope="col">Robot</th><th scope="col">Quantity'
        '</th><th scope="col">Median</th><th scope="col">95 %</th><th scope="col">Most</th></tr>'
        f"</thead><tbody>{counts}{figures}</tbody></table>"
        f'<div class="strips">{strips}</div></details>'
    )


def _rows(report: SessionReport) -> Iterator[Row]:
    """Yield owner, quantity, unit, values and the factor to the unit."""
    for robot in report.robots.values():
        yield from (
            row
            for row in (
                (robot.name, "joint states late", "ms", robot.deadline, 1e3),
                (robot.name, "tracking error", "mrad", robot.tracking, 1e3),
                *(
                    (robot.name, hop_text(hop), "ms", values, 1e3)
                    for hop, values in robot.latency.items()
                ),
            )
            if row[3].values
        )
    for hop, values in report.latency.items():
        yield ("all topics", hop_text(hop), "ms", values, 1e3)


def _figures(row: Row) -> str:
    owner, what, unit, series, scale = row
    summary = series.summary()
    cells = "".join(
        f'<td class="figure">{shown(float(summary[name] or 0) * scale)} {unit}</td>'
        for name in ("p50", "p95", "max")
    )
    return f"<tr><td>{escape(owner)}</td><td>{escape(what)}</td>{cells}</tr>"


def _strip(row: Row) -> Strip:
    _, what, unit, series, scale = row
    return Strip(what, unit, np.array(series.values) * scale)
