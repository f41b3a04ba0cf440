"""What a page about one motion says without a script: verdict, findings, plots, source."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from mrlab_ros.core.foreign_text import for_html as escape
from mrlab_ros.core.show.packed import unpacked
from mrlab_ros.core.show.svg import HATCH, Array, Mark, Strip, strip_svg, time_axis_svg

VERDICTS = {"accepted": "Accepted", "refused": "Not accepted", "ambiguous": "A choice is needed"}
# Paths of 24 x 24: a tick, a cross, a question mark.
ICONS = {
    "accepted": "M9.2 16.6 4.9 12.3l-1.6 1.6 5.9 5.9L21 8l-1.6-1.6z",
    "refused": "M18.4 7 17 5.6l-5 5-5-5L5.6 7l5 5-5 5L7 18.4l5-5 5 5 1.4-1.4-5-5z",
    "ambiguous": "M11 17h2.2v2.2H11zM12 4.5c-2.6 0-4.4 1.7-4.4 4.2h2.2c0-1.3.9-2.2 2.2-2.2s2.2.8 "
    "2.2 2c0 1-.6 1.5-1.5 2.2-1.1.9-1.7 1.7-1.7 3.4v.7h2.2v-.5c0-1.1.5-1.6 1.4-2.3 1.1-.9 1.8-1.9 "
    "1.8-3.5 0-2.4-1.8-4-4.4-4z",
}
SEVERITIES = {"error": "error", "warning": "warning", "info": "note"}


def motion_body(document: Mapping[str, Any], poster: str) -> str:
    """Return the HTML of a MotionDocument. poster: data: URL of a picture of the robot."""
    verdict, robot = document["verdict"], document["robot"]
    tool = f" with {robot['end_effector']}" if robot["end_effector"] else ""
    times = times_of(document)
    grave = any(one["severity"] != "info" for one in document["findings"])
    duration = float(times[-1])
    facts = f"{robot['model']}{tool} · {duration:.2f} s · {document['frame_rate']:g} Hz"
    return "\n".join(
        (
            '<header class="head">',
            f"<h1>{escape(document['title'])}</h1>",
            f'<p class="facts">{escape(facts)}</p>',
            f'<p class="verdict {verdict}"><svg viewBox="0 0 24 24" aria-hidden="true">'
            f'<path d="{ICONS[verdict]}"/></svg><b>{VERDICTS[verdict]}</b> '
            f"<span>{escape(document['message'])}</span></p>",
            "</header>",
            f'<main class="{"with" if grave else "without"}-findings">',
            '<section id="view" aria-label="3D view"></section>',
            f'<figure class="poster"><img src="{poster}" alt="The robot '
            f'{escape(robot["model"])} at the first row"></figure>',
            _findings(document["findings"]),
            _plots(document, times, duration),
            "</main>",
            _foot(document["source"]),
        )
    )


def times_of(document: Mapping[str, Any]) -> Array:
    """Return the time of each frame, (N,) s."""
    if document["times"] is not None:
        return unpacked(document["times"])
    count = document["positions"]["shape"][0]
    return np.arange(count) / float(document["frame_rate"])


def _findings(findings: Sequence[Mapping[str, Any]]) -> str:
    if not findings:
        return ""
    items = []
    for number, one in enumerate(findings, 1):
        rows = ""
        if one["first_row"]:
            last = one["last_row"]
            rows = f"row {one['first_row']}" + (f"-{last}" if last > one["first_row"] else "")
        where = " · ".join(part for part in (rows, one["joint"]) if part)
        code = next((fix["matlab"] for fix in one["fixes"] if fix["matlab"]), "")
        items.append(
            f'<li class="{one["severity"]}"><button type="button" data-finding="{number}">'
            f'<span class="number" aria-hidden="true">{number}</span>'
            f"<span><b>{SEVERITIES[one['severity']]}</b> {escape(where)}</span></button>"
            f"<p>{escape(one['message'])}</p>"
            + (f'<p class="remedy">{escape(one["remedy"])}</p>' if one["remedy"] else "")
            + (f"<pre><code>{escape(code)}</code></pre>" if code else "")
            + "</li>"
        )
    return (
        '<section class="findings" aria-label="Findings"><h2>Findings</h2>'
        f"<ol>{''.join(items)}</ol></section>"
    )


def _plots(document: Mapping[str, Any], times: Array, duration: float) -> str:
    joints = document["robot"]["joints"]
    turning = [joint["kind"] != "prismatic" for joint in joints]
    positions, velocities, proxies = (
        None if document[name] is None else np.asarray(unpacked(document[name]), np.float64)
        for name in ("positions", "velocities", "effort_proxies")
    )
    assert positions is not None
    marks = _marks(document, times)
    groups = [
        (
            "Angles",
            [
                Strip(
                    joint["name"],
                    "deg" if turns else "m",
                    _degrees(positions[:, j], turns),
                    (_limit(joint["lower"], turns), _limit(joint["upper"], turns)),
                    j % 7 + 1,
                    tuple(m for name, m in marks if name in (joint["name"], "")),
                )
                for j, (joint, turns) in enumerate(zip(joints, turning, strict=True))
            ],
        )
    ]
    if velocities is not None:
        strips = []
        for j, (joint, turns) in enumerate(zip(joints, turning, strict=True)):
            most = _limit(joint["velocity"], turns)
            limits = (None if most is None else -most, most)
            unit = "deg/s" if turns else "m/s"
            values = _degrees(velocities[:, j], turns)
            strips.append(Strip(joint["name"], unit, values, limits, j % 7 + 1))
        groups.append(("Velocities", strips))
    if proxies is not None:
        groups.append(
            (
                "Torque proxies (nominal, no torque)",
                [
                    Strip(joint["name"], "proxy N·m", proxies[:, j], colour=j % 7 + 1)
                    for j, joint in enumerate(joints)
                ],
            )
        )
    axis = time_axis_svg(duration)
    parts = []
    for number, (heading, strips) in enumerate(groups):
        rows = "".join(
            f"<div><h3>{escape(s.name)}</h3>{strip_svg(s, times, duration)}{axis}</div>"
            for s in strips
        )
        parts.append(
            f"<details{' open' * (number == 0)}><summary><h2>{heading}</h2></summary>"
            f'{HATCH * (number == 0)}<div class="strips">{rows}</div></details>'
        )
    return f'<section class="plots" aria-label="Plots">{"".join(parts)}</section>'


def _marks(document: Mapping[str, Any], times: Array) -> list[tuple[str, Mark]]:
    """Return the marks with the joint that each belongs to; a finding of no joint: of all."""
    rows = np.arange(1, len(times) + 1) if document["rows"] is None else unpacked(document["rows"])

    def time_of(row: int) -> float:
        return float(times[max(int(np.searchsorted(rows, row, side="right")) - 1, 0)])

    return [
        (
            one["joint"],
            Mark(
                number,
                one["severity"],
                time_of(one["first_row"]),
                time_of(max(one["last_row"], one["first_row"])),
            ),
        )
        for number, one in enumerate(document["findings"], 1)
        if one["first_row"]
    ]


def _degrees(values: Array, turns: bool) -> Array:
    return np.degrees(values) if turns else values


def _limit(value: float | None, turns: bool) -> float | None:
    return float(np.degrees(value)) if turns and value is not None else value


def _foot(source: Mapping[str, str]) -> str:
    parts = [f"{escape(source['variable'])} of {escape(source['file'])}"]
    if source["sha256"]:
        parts.append(f'<span title="{source["sha256"]}">sha256 {source["sha256"][:12]}</span>')
    return f'<footer class="foot">{" · ".join(parts)} · made by MR-Lab</footer>'
