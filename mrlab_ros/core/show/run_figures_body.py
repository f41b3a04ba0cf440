"""The figures of a run on a session's page: its way, its speed, its limits, its reference."""

from __future__ import annotations

import math

from mrlab_ros.core.foreign_text import for_html as escape
from mrlab_ros.core.recording.report_text import lasting
from mrlab_ros.core.recording.run_figures import figures_of
from mrlab_ros.core.recording.runs import FOLLOWED, Course, Deviation, Run


def run_figures(run: Run, course: Course) -> str:
    """Return the figures as a list of terms; a moment in it leads there."""
    found = figures_of(course, run.joints)
    rows: list[tuple[str, str, float | None]] = []
    if run.length:
        speeds = (
            ", ".join(f"{speed:g}\N{MULTIPLICATION SIGN}" for speed in run.speeds if speed)
            or "0\N{MULTIPLICATION SIGN}"
        )
        rows.append(("Played", f"{run.position:.2f} / {run.length:.2f} s, {speeds}", None))
    if found.way is not None:
        rows.append(("Way of the tool", f"{found.way:.3f} m", None))
    if found.fastest is not None:
        rows.append(("Fastest", f"{found.fastest:.3f} m/s", found.fastest_at))
    if found.near is not None:
        near = found.near
        room = _amount(near.room, prismatic=near.prismatic)
        rows.append(("Nearest limit", f"{room} ({near.joint})", near.time))
    if run.deviation is not None:
        rows += _compared(run, run.deviation)
    if not rows:
        return ""
    items = "".join(
        f"<div><dt>{term}</dt><dd>{_value(text, time)}</dd></div>" for term, text, time in rows
    )
    return f'<dl class="run-figures">{items}</dl>'


def _compared(run: Run, deviation: Deviation) -> list[tuple[str, str, float | None]]:
    prismatic = any(j.prismatic for j in run.joints if j.name == deviation.joint)
    rows: list[tuple[str, str, float | None]] = [("Reference", deviation.reference, None)]
    if deviation.most < FOLLOWED:
        return [*rows, ("Largest deviation", "0", None)]
    most = f"{_amount(deviation.most, prismatic=prismatic)} ({deviation.joint})"
    rows.append(("Largest deviation", most, deviation.time))
    if deviation.tool is not None:
        rows.append(("Tool, at most", f"{deviation.tool * 1e3:.1f} mm", None))
    return rows


def _value(text: str, time: float | None) -> str:
    words = escape(text).replace("_", "_<wbr>")
    if time is None:
        return words
    return f'{words} <button type="button" data-time="{time:.3f}">{lasting(time)}</button>'


def _amount(value: float, *, prismatic: bool) -> str:
    text = f"{value * 1e3:.1f} mm" if prismatic else f"{math.degrees(value):.2f}°"
    return text.replace("-", "\N{MINUS SIGN}")
