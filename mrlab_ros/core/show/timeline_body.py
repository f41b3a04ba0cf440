"""The timeline of a session's page: a row a robot, with states, what it held, what it hit."""

from __future__ import annotations

from collections.abc import Sequence

from mrlab_ros.core.foreign_text import for_html as escape
from mrlab_ros.core.recording.report import HOLDING, RobotReport, SessionReport, Span
from mrlab_ros.core.recording.runs import Run
from mrlab_ros.core.show.svg import time_axis_svg

# A row is drawn in units of its own for the width of a page, of a tablet or paper, of a phone.
WIDTHS = {"wide": 1280.0, "middle": 760.0, "narrow": 360.0}
LEFT, RIGHT = 8.0, 12.0
ROW, TOP, BAR = 38.0, 10.0, 20.0  # heights: above the bar stand collisions, below what is held
LETTER, PADDING = 7.4, 12.0  # width of a letter in a bar, and beside the word
# A state that lasts less than this share of the session is not seen.
VISIBLE = 1 / 800
MOVING = ("PLAYING", "ADJUSTING")


def timeline(report: SessionReport) -> str:
    """Return the rows of all robots that said anything, and what the colours mean."""
    shown = [robot for robot in report.robots.values() if robot.states.values]
    silent = [robot.name for robot in report.robots.values() if not robot.states.values]
    if not shown:
        return _others(silent) if silent else ""
    rows = "".join(_robot(robot, report) for robot in shown)
    axes = "".join(
        f'<div class="{kind}">{time_axis_svg(report.duration, width, margins=(LEFT, RIGHT))}</div>'
        for kind, width in WIDTHS.items()
    )
    return (
        f"<details open><summary><h2>Robots</h2></summary>{rows}{axes}{_keys(report, shown)}"
        f"{_others(silent) if silent else ''}</details>"
    )


def _others(names: Sequence[str]) -> str:
    return f'<p class="others"><span>Without a run</span>: {escape(", ".join(names))}</p>'


def _keys(report: SessionReport, robots: Sequence[RobotReport]) -> str:
    """Return what the colours and signs of the rows mean, of those that occur."""
    spans = [span for robot in robots for span in robot.states.spans(report.duration)]
    least = report.duration * VISIBLE
    labels = list(dict.fromkeys(span.label for span in spans if span.end - span.start > least))
    keys = [(f"state {_name(label)}", _words(label)) for label in labels]
    if any(g[1] == HOLDING for robot in robots for g in robot.grasps.values):
        keys.append(("held", "holds an object"))
    if any(robot.collisions for robot in robots):
        keys.append(("hit", "collision"))
    items = "".join(
        f'<span><svg class="key states" viewBox="0 0 12 12" aria-hidden="true">'
        f"{_sign(kind)}</svg> <span>{words}</span></span> "
        for kind, words in keys
    )
    return f'<p class="keys">{items}</p>'


def _sign(kind: str) -> str:
    if kind == "hit":
        return '<path class="hit" d="M1 2h10l-5 9z"/>'
    if kind == "held":
        return '<rect class="held" y="4" width="12" height="5" rx="2"/>'
    return f'<rect class="{kind}" width="12" height="12" rx="2"/>'


def _robot(robot: RobotReport, report: SessionReport) -> str:
    runs = [run for run in report.runs if run.robot == robot.name]
    rows = "".join(
        _row(robot, runs, report.duration, kind, width) for kind, width in WIDTHS.items()
    )
    model = f" <small>{escape(robot.model)}</small>" if robot.model else ""
    return f"<h3>{escape(robot.name)}{model}</h3>{rows}"


def _row(robot: RobotReport, runs: Sequence[Run], duration: float, kind: str, width: float) -> str:
    room = width - LEFT - RIGHT

    def x(time: float) -> float:
        return LEFT + (min(max(time / duration, 0.0), 1.0) if duration else 0) * room

    parts = [
        f'<svg class="strip states {kind}" viewBox="0 0 {width:g} {ROW:g}" role="img" '
        f'data-left="{LEFT:g}" data-width="{room:g}" data-begin="0" '
        f'data-duration="{duration:.3f}" aria-label="States of {escape(robot.name)} over time">'
    ]
    for span in _joined(robot.states.spans(duration)):
        left, wide = x(span.start), max(x(span.end) - x(span.start), 0.8)
        words = _words(span.label)
        parts.append(
            f'<rect class="state {_name(span.label)}" x="{left:.1f}" y="{TOP:g}" '
            f'width="{wide:.1f}" height="{BAR:g}" rx="2"><title>{words}, '
            f"{span.start:.2f}-{span.end:.2f} s</title></rect>"
        )
        text = next((t for t in _texts(span, runs) if wide > LETTER * len(t) + PADDING), "")
        if text:
            parts.append(
                f'<text class="in-bar" x="{left + wide / 2:.1f}" y="{TOP + BAR / 2 + 4:g}">'
                f"{escape(text)}</text>"
            )
    for span in robot.grasps.spans(duration):
        if span.label == HOLDING:
            parts.append(
                f'<rect class="held" x="{x(span.start):.1f}" y="{TOP + BAR + 2:g}" '
                f'width="{max(x(span.end) - x(span.start), 0.8):.1f}" height="5" rx="2">'
                f"<title>holds {escape(span.detail)}</title></rect>"
            )
    for one in robot.collisions:
        at = x(one.time)
        parts.append(
            f'<path class="hit" d="M{at - 5:.1f} 0h10l-5 9z"><title>hit '
            f"{escape(one.other)}, {one.time:.2f} s</title></path>"
        )
    return "".join(parts) + "</svg>"


def _joined(spans: Sequence[Span]) -> list[Span]:
    """Return the states; neighbours at rest that differ in what is loaded alone are one."""
    found: list[Span] = []
    for span in spans:
        before = found[-1] if found else None
        if before is not None and before.label == span.label and span.label not in MOVING:
            found[-1] = Span(before.start, span.end, span.label, span.detail)
        else:
            found.append(span)
    return found


def _texts(span: Span, runs: Sequence[Run]) -> list[str]:
    """Return what a bar may say, the longest first: of a run its number and its trajectory."""
    if span.label not in MOVING:
        return [_words(span.label)]
    middle = (span.start + span.end) / 2
    number = "".join(str(run.number) for run in runs if run.start <= middle <= run.end)
    return [f"{number} · {span.detail}" if number else span.detail, number or _words(span.label)]


def _name(label: str) -> str:
    return label.lower().replace("_", "-")


def _words(label: str) -> str:
    return label.lower().replace("_", " ")
