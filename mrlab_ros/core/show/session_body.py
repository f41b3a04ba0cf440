"""What a page about a recorded session says without a script: runs, events, plots, figures."""

from __future__ import annotations

from collections.abc import Mapping
from html import escape
from typing import Any

from mrlab_ros.core.recording.report import HOLDING, RobotReport, SessionReport
from mrlab_ros.core.recording.report_text import summary
from mrlab_ros.core.show.runs_body import run_plots, runs_table
from mrlab_ros.core.show.svg import LEFT, RIGHT, time_axis_svg
from mrlab_ros.core.show.technical_body import technical

WIDTH = 1280.0  # of a row: it is as wide as the page
ROW, BAR = 34.0, 20.0  # heights in the strip's own units
LETTER = 7.0  # width of a letter in a bar
MOST_EVENTS = 200


def session_body(
    title: str, document: Mapping[str, Any], report: SessionReport, began: str
) -> str:
    """Return the HTML of a SessionDocument. began: date and time, for a person."""
    facts = f"{began} · {summary(report)}"
    events = document["events"][:MOST_EVENTS]
    troubles = "".join(f"<p>{escape(trouble)}</p>" for trouble in report.troubles)
    return "\n".join(
        (
            '<header class="head">',
            f'<h1>{escape(title)}</h1><p class="facts">{escape(facts)}</p>{troubles}',
            "</header>",
            f'<main class="{"with" if events else "without"}-findings">',
            runs_table(report),
            '<section id="view" aria-label="3D view"></section>',
            _events(events),
            '<section class="plots" aria-label="Timeline"><details open>'
            "<summary><h2>Robots</h2></summary>",
            *(_row(robot, report.duration) for robot in report.robots.values()),
            time_axis_svg(report.duration, WIDTH),
            "</details>",
            run_plots(report),
            technical(report),
            "</section>",
            "</main>",
            '<footer class="foot">made by MR-Lab</footer>',
        )
    )


def _events(events: list[Mapping[str, Any]]) -> str:
    if not events:
        return ""
    items = [
        f'<li class="{one["severity"]}"><button type="button" data-time="{one["time"]:.3f}">'
        f'<span class="number" aria-hidden="true">{number}</span>'
        f"<span><b>{one['time']:.2f} s</b> {escape(one['robot'])} {escape(one['text'])}</span>"
        "</button></li>"
        for number, one in enumerate(events, 1)
    ]
    return (
        '<section class="findings" aria-label="Events"><h2>Events</h2>'
        f"<ol>{''.join(items)}</ol></section>"
    )


def _row(robot: RobotReport, duration: float) -> str:
    """Return a robot's states as bars, what it held below them, and its collisions."""

    def x(time: float) -> float:
        return LEFT + (time / duration if duration else 0) * (WIDTH - LEFT - RIGHT)

    parts = [
        f"<h3>{escape(robot.name)} ({escape(robot.model or 'model unknown')})</h3>"
        f'<svg class="strip states" viewBox="0 0 {WIDTH:g} {ROW:g}" role="img" '
        f'data-left="{LEFT:g}" data-width="{WIDTH - LEFT - RIGHT:g}" data-begin="0" '
        f'data-duration="{duration:.3f}" aria-label="States of {escape(robot.name)} over time">'
    ]
    for span in robot.states.spans(duration):
        left, width = x(span.start), max(x(span.end) - x(span.start), 0.6)
        name = span.label.lower().replace("_", "-")
        words = span.label.lower().replace("_", " ")
        parts.append(
            f'<rect class="state {name}" x="{left:.1f}" y="2" width="{width:.1f}" '
            f'height="{BAR:g}" rx="2"><title>{words} {span.start:.2f}-{span.end:.2f} s</title>'
            "</rect>"
        )
        if width > LETTER * len(words):
            parts.append(
                f'<text class="in-bar" x="{left + width / 2:.1f}" y="{BAR / 2 + 6:g}">'
                f"{words}</text>"
            )
    for span in robot.grasps.spans(duration):
        if span.label == HOLDING:
            parts.append(
                f'<rect class="held" x="{x(span.start):.1f}" y="{BAR + 5:g}" '
                f'width="{max(x(span.end) - x(span.start), 0.6):.1f}" height="5" rx="2">'
                f"<title>holds {escape(span.detail)}</title></rect>"
            )
    for one in robot.collisions:
        at = x(one.time)
        parts.append(f'<path class="hit" d="M{at - 5:.1f} 2h10l-5 9z"/>')
    return "".join(parts) + "</svg>"
