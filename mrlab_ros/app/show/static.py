"""A report as HTML for where no script runs: pictures, findings and tables, in English.

It is made of the same JSON as the report that `web/src/report/` draws in its place.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from mrlab_ros.app.show.packed import unpacked
from mrlab_ros.core.base.foreign_text import for_html as escape
from mrlab_ros.core.recording.report_text import lasting

Json = Mapping[str, Any]
MOST_ROWS = 500
SEVERITIES = {"error": "Error", "warning": "Warning", "info": "Note"}
OUTCOMES = {"accepted": "accepted", "refused": "refused", "ambiguous": "your choice"}
STATES = {"ok": "ok", "not": "not ok", "unknown": "not known"}
CHIPS = {"accepted": "playing", "refused": "collision-halt", "ambiguous": "paused"}


@dataclass(frozen=True)
class Table:
    """Texts in rows below a heading."""

    heading: str
    columns: Sequence[str]
    rows: Sequence[Sequence[str]]


def report(
    title: str,
    facts: Iterable[str],
    *,
    outcome: str = "",
    pictures: Iterable[tuple[str, str]] = (),
    findings: Sequence[Json] = (),
    tables: Iterable[Table] = (),
    foot: Iterable[str] = ("made by MR-Lab",),
) -> str:
    """Return the HTML. outcome: accepted, refused, ambiguous or empty. pictures: (data: URL,
    text). findings: as `plain` writes diagnostics."""
    chip = ""
    if outcome:
        chip = (
            f'<p class="row"><span class="chip chip-{CHIPS[outcome]}">{OUTCOMES[outcome]}'
            "</span></p>"
        )
    images = "".join(f'<img src="{url}" alt="{escape(text)}">' for url, text in pictures)
    return "\n".join(
        (
            f'<header class="report-head">{chip}<h1>{escape(title)}</h1>'
            f'<p class="facts">{escape(" · ".join(filter(None, facts)))}</p></header>',
            '<main class="report-main">',
            f'<figure class="poster">{images}</figure>' if images else "",
            _findings(findings),
            *map(_table, tables),
            "</main>",
            f'<footer class="report-foot">{escape(" · ".join(foot))}</footer>',
        )
    )


def _findings(findings: Sequence[Json]) -> str:
    if not findings:
        return ""
    items = "".join(
        f'<li class="finding finding-{one["severity"]}"><span class="finding-number">{number}'
        '</span><div class="finding-body"><p class="finding-head"><span class="finding-severity">'
        f"{SEVERITIES[one['severity']]}</span> "
        f'<span class="second">{escape(place(one))}</span></p><p>{escape(one["message"])}</p>'
        + (f'<p class="second small">{escape(one["remedy"])}</p>' if one["remedy"] else "")
        + "".join(
            f'<div class="matlab"><code>{escape(line)}</code></div>'
            for line in dict.fromkeys(fix["matlab"] for fix in one["fixes"] if fix["matlab"])
        )
        + "</div></li>"
        for number, one in enumerate(findings, 1)
    )
    return (
        f'<section class="report-findings"><h2>Findings</h2><ol class="findings">{items}</ol>'
        "</section>"
    )


def place(found: Json) -> str:
    """Return where a finding applies: robot, time, variable, joint or link, rows."""
    first, last = found["first_row"], found["last_row"]
    rows = f"rows {first} to {last}" if last > first else f"row {first}" if first else ""
    time = found.get("time")
    parts = (
        found.get("robot"), "" if time is None else f"{time:.2f} s", found["variable"],
        found["joint"] or found.get("link"), rows,
    )  # fmt: skip
    return " · ".join(str(part) for part in parts if part)


def _table(table: Table) -> str:
    if not table.rows:
        return ""
    heads = "".join(f'<th scope="col">{escape(head)}</th>' for head in table.columns)
    rows = "".join(
        f"<tr>{''.join(f'<td>{escape(text)}</td>' for text in row)}</tr>"
        for row in table.rows[:MOST_ROWS]
    )
    return (
        f'<section class="card report-table"><h2>{escape(table.heading)}</h2><table class="table">'
        f"<thead><tr>{heads}</tr></thead><tbody>{rows}</tbody></table></section>"
    )


def motion(document: Json, poster: str) -> str:
    """Return a MotionDocument as HTML. poster: data: URL of a picture of the robot."""
    robot, findings, verdict = document["robot"], document["findings"], document["verdict"]
    model = robot["model"] + (f" with {robot['end_effector']}" * bool(robot["end_effector"]))
    positions = unpacked(document["positions"])
    if document["times"] is None:
        duration = (len(positions) - 1) / document["frame_rate"]
    else:
        duration = float(unpacked(document["times"])[-1])
    grave = next((one for one in findings if one["severity"] == "error"), None)
    title = f"{document['title']} fits the {robot['model']}"
    if verdict != "accepted" and (grave or findings):
        title = (grave or findings[0])["message"]
    return report(
        title,
        (document["source"]["file"], model, f"{duration:.2f} s, {document['frame_rate']:g} Hz"),
        outcome=verdict,
        pictures=[(poster, f"The robot {robot['model']} at the first row")],
        findings=findings,
        tables=[_joints(robot["joints"], positions)],
    )


def _joints(joints: Sequence[Json], positions: np.ndarray) -> Table:
    rows = []
    for joint, values in zip(joints, positions.T, strict=True):
        known = values[np.isfinite(values)]
        ends = (known.min(), known.max()) if len(known) else (None, None)
        shown = (_position(v, joint["kind"]) for v in (*ends, joint["lower"], joint["upper"]))
        rows.append([joint["name"], *shown])
    return Table("Joints", ("Joint", "Least", "Most", "Lower limit", "Upper limit"), rows)


def _position(value: float | None, kind: str) -> str:
    if value is None:
        return ""
    return f"{value * 1e3:.1f} mm" if kind == "prismatic" else f"{math.degrees(value):.1f}°"


def session(document: Json) -> str:
    """Return a SessionDocument as HTML."""
    told = document["report"]
    events = [
        (lasting(one["time"]), one["robot"], sentence(one["said"])) for one in document["events"]
    ]
    runs = [
        (
            str(run["number"]), run["robot"], run["trajectory"], lasting(run["start"]),
            lasting(run["end"] - run["start"]), sentence(run["outcome"]),
        )
        for run in told["runs"]
    ]  # fmt: skip
    heads = ("Run", "Robot", "Trajectory", "Began", "Took", "Result")
    robots = [
        (one["name"], one["model"], str(one["joint_states"]), str(one["contacts"]))
        for one in told["robots"]
    ]
    return report(
        document["title"],
        (sentence(told["summary"]),),
        findings=told["troubles"],
        tables=(
            Table("Runs", heads, runs),
            Table("Events", ("Time", "Robot", "Event"), events),
            Table("Robots", ("Robot", "Model", "Joint states", "Contacts"), robots),
        ),
    )


def check(document: Json, film: Sequence[tuple[float, str]]) -> str:
    """Return the session document of a check as HTML. film: times, s, and pictures at them."""
    told, marks = document["check"], document["check"]["marks"]
    tables = [
        Table(
            f"Ready for hardware: {robot['name']}",
            ("State", "Condition", "Found"),
            [
                (STATES[one["state"]], one["condition"]["message"], one["found"]["message"])
                for one in robot["hardware"]
            ],
        )
        for robot in told["robots"]
    ]
    if marks is not None:
        rows = [
            (f"{test['points']:g} / {test['of']:g}", test["name"], sentence(test["found"]))
            for test in marks["tests"]
        ]
        heading = f"Marks: {marks['points']:g} of {marks['of']:g} points"
        tables.insert(0, Table(heading, ("Points", "Test", "Found"), rows))
    return report(
        document["title"],
        (sentence(told["summary"]), *(robot["model"] for robot in told["robots"])),
        outcome="accepted" if told["verdict"] == "ready" else "refused",
        pictures=[(url, f"The robot at {time:.2f} s") for time, url in film],
        findings=told["findings"],
        tables=tables,
        foot=(told["claim"]["message"], f"report {told['hash'][:12]}"),
    )


def sentence(said: Json) -> str:
    """Return what a diagnostic says, and its remedy."""
    return f"{said['message']} {said['remedy']}".strip()
