"""Draws what happened in a session: one row a robot, below it errors and latency over time."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from mrlab_ros.adapters.plotting import Figure, FigureCanvasAgg, Line2D, Patch
from mrlab_ros.core.base.foreign_text import visible
from mrlab_ros.core.recording.report import HOLDING, RobotReport, Series, SessionReport, Span
from mrlab_ros.core.recording.report_text import hop_text
from mrlab_ros.core.runtime.colours import COLOURS, JOINTS, STATES

HELD = JOINTS[6]
WIDTH, ROW_HEIGHT, PANEL_HEIGHT, MARGIN = 11.0, 0.42, 1.7, 1.3
# A state that lasts less than this share of the session is not seen.
VISIBLE = 1 / 800
# Width of a letter in a bar, as a share of the session.
LETTER = 1 / 120
# More lines than this have no legend of their own.
NAMED = 8


def draw(report: SessionReport, title: str, path: Path) -> None:
    """Write the picture of a session to `path`, PNG."""
    robots = list(report.robots.values())
    panels = [
        (name, unit, least, lines)
        for name, unit, least, lines in (
            ("tracking error", "mrad", 1.0, _lines(robots, "tracking", 1e3)),
            ("joint states late", "ms", 1.0, _lines(robots, "deadline", 1e3)),
            ("latency, median", "ms", 1.0, _latency(report, robots)),
        )
        if lines
    ]
    rows = max(len(robots), 1)
    heights = [rows * ROW_HEIGHT + 0.2] + [PANEL_HEIGHT] * len(panels)
    figure = Figure(figsize=(WIDTH, sum(heights) + MARGIN), layout="constrained")
    FigureCanvasAgg(figure)
    axes = figure.subplots(
        len(heights), 1, sharex=True, squeeze=False, gridspec_kw={"height_ratios": heights}
    )[:, 0]
    figure.suptitle(visible(title), x=0.01, ha="left", fontsize=11, fontweight="bold")
    _draw_states(axes[0], report, robots)
    for axis, (name, unit, least, lines) in zip(axes[1:], panels, strict=True):
        _draw_lines(axis, f"{name}\n{unit}", least, lines)
    axes[-1].set_xlabel("s from the beginning of the recording", fontsize=9)
    axes[-1].set_xlim(0, max(report.duration, 1e-3))
    figure.savefig(path, dpi=130)


def _draw_states(axis: Any, report: SessionReport, robots: list[RobotReport]) -> None:
    seen: set[str] = set()
    touched = halted = held = False
    for row, robot in enumerate(robots):
        for span in robot.states.spans(report.duration):
            if span.end - span.start > report.duration * VISIBLE:
                seen.add(span.label)
            axis.broken_barh(
                [(span.start, span.end - span.start)],
                (row - 0.38, 0.56),
                facecolors=STATES.get(span.label, COLOURS["border"]),
            )
            if span.label == "PLAYING" and _fits(span, report.duration):
                axis.text(
                    (span.start + span.end) / 2, row - 0.1, span.detail,
                    ha="center", va="center", fontsize=7, color="white", clip_on=True,
                )  # fmt: skip
        for span in robot.grasps.spans(report.duration):
            if span.label == HOLDING:
                held = True
                axis.broken_barh(
                    [(span.start, span.end - span.start)], (row + 0.22, 0.16), facecolors=HELD
                )
        if robot.contacts:
            touched = True
            places = [row - 0.43] * len(robot.contacts)
            axis.plot(robot.contacts, places, ls="", marker="|", color="black", markersize=4)
        for contact in robot.collisions:
            halted = True
            axis.plot(contact.time, row - 0.1, marker="X", color="black", markersize=7, mew=0)
    places = [row - 0.1 for row in range(len(robots))]
    axis.set_yticks(places, [robot.name for robot in robots], fontsize=8)
    axis.set_ylim(max(len(robots), 1) - 0.5, -0.5)
    axis.tick_params(length=0)
    _plain(axis)
    entries: list[Any] = [
        Patch(color=colour, label=label.lower().replace("_", " "))
        for label, colour in STATES.items()
        if label in seen
    ]
    if held:
        entries.append(Patch(color=HELD, label="holds an object"))
    if touched:
        entries.append(Line2D([], [], marker="|", color="black", ls="", label="contact"))
    if halted:
        entries.append(Line2D([], [], marker="X", color="black", ls="", mew=0, label="collision"))
    if entries:
        axis.legend(
            handles=entries, ncols=len(entries), fontsize=8, frameon=False,
            loc="lower left", bbox_to_anchor=(0, 1), borderaxespad=0.2, handlelength=1.2,
        )  # fmt: skip


def _draw_lines(
    axis: Any, name: str, least: float, lines: dict[str, tuple[Series, float]]
) -> None:
    """Draw values as points; the axis reaches to `least` at least: less than that is flat."""
    most = least
    axis.set_prop_cycle(color=JOINTS)
    for label, (series, scale) in lines.items():
        values = [value * scale for value in series.values]
        most = max(most, *values)
        axis.plot(series.times, values, label=label, ls="", marker=".", markersize=5, mew=0)
    axis.set_ylabel(name, fontsize=8)
    axis.tick_params(labelsize=8)
    axis.set_ylim(0, most * 1.08)
    axis.grid(axis="y", color=COLOURS["hairline"])
    axis.set_axisbelow(True)
    _plain(axis)
    if len(lines) <= NAMED:
        axis.legend(
            fontsize=7, frameon=False, ncols=4, loc="lower left", bbox_to_anchor=(0, 1),
            borderaxespad=0.1, markerscale=2, handletextpad=0.2,
        )  # fmt: skip


def _fits(span: Span, duration: float) -> bool:
    """Return whether the span's detail can be read within its bar."""
    return span.end - span.start > duration * LETTER * len(span.detail)


def _plain(axis: Any) -> None:
    for side in ("top", "right", "left"):
        axis.spines[side].set_visible(False)


def _lines(robots: list[RobotReport], field: str, scale: float) -> dict[str, tuple[Series, float]]:
    found = {robot.name: getattr(robot, field) for robot in robots}
    return {name: (series, scale) for name, series in found.items() if series.values}


def _latency(report: SessionReport, robots: list[RobotReport]) -> dict[str, tuple[Series, float]]:
    if report.latency:
        return {hop_text(hop): (series, 1e3) for hop, series in report.latency.items()}
    return {
        f"{robot.name} {hop_text(hop)}": (series, 1e3)
        for robot in robots
        for hop, series in robot.latency.items()
    }
