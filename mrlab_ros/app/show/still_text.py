"""A report as text for where no script runs: verdict, findings and tables, in English.

It is made of the same JSON as the report that `web/src/reports.tsx` draws in its place.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from mrlab_ros.app.show.packed import unpacked
from mrlab_ros.core.recording.report_text import lasting

Json = Mapping[str, Any]
MOST_ROWS = 500
SEVERITIES = {"error": "Error", "warning": "Warning", "info": "Note"}
OUTCOMES = {"accepted": "accepted", "refused": "refused", "ambiguous": "your choice"}
STATES = {"ok": "ok", "not": "not ok", "unknown": "not known"}


@dataclass(frozen=True)
class Table:
    """Texts in rows below a heading. columns: names of the columns, or none."""

    heading: str
    columns: Sequence[str]
    rows: Sequence[Sequence[str]]


def report(facts: Iterable[str], findings: Sequence[Json], tables: Iterable[Table]) -> str:
    """Return the text. findings: as `plain` writes diagnostics."""
    parts = [list(filter(None, facts)), *([_findings(findings)] if findings else [])]
    for table in tables:
        if table.rows:
            heading = f"{table.heading} ({', '.join(table.columns)})"
            rows = (" · ".join(cell or "\u2013" for cell in row) for row in table.rows[:MOST_ROWS])
            parts.append([heading if table.columns else table.heading, *rows])
    return "\n\n".join("\n".join(part) for part in parts)


def dotted(parts: Iterable[Any]) -> str:
    """Return the parts that are there with dots between them."""
    return " · ".join(str(part) for part in parts if part)


def _findings(findings: Sequence[Json]) -> list[str]:
    lines = ["Findings"]
    for number, one in enumerate(findings, 1):
        severity = SEVERITIES[one["severity"]]
        lines.append(f"{number}. {dotted((severity, place(one)))}: {sentence(one)}")
        lines += dict.fromkeys(fix["matlab"] for fix in one["fixes"] if fix["matlab"])
    return lines


def place(found: Json) -> str:
    """Return where a finding applies: robot, time, variable, joint or link, rows."""
    first, last = found["first_row"], found["last_row"]
    rows = f"rows {first} to {last}" if last > first else f"row {first}" if first else ""
    time = found.get("time")
    return dotted(
        (
            found.get("robot"), "" if time is None else f"{time:.2f} s", found["variable"],
            found["joint"] or found.get("link"), rows,
        )
    )  # fmt: skip


def motion(document: Json) -> str:
    """Return a MotionDocument as text."""
    robot, findings, verdict = document["robot"], document["findings"], document["verdict"]
    model = robot["model"] + (f" with {robot['end_effector']}" * bool(robot["end_effector"]))
    positions = unpacked(document["positions"])
    if document["times"] is None:
        duration = (len(positions) - 1) / document["frame_rate"]
    else:
        duration = float(unpacked(document["times"])[-1])
    facts = dotted(
        (
            OUTCOMES[verdict],
            document["source"]["file"],
            model,
            f"{duration:.2f} s, {document['frame_rate']:g} Hz",
        )
    )
    tables = [*_marks(document.get("marks")), _joints(robot["joints"], positions)]
    return report([facts], findings, tables)


def refusal(document: Json) -> str:
    """Return a RefusalDocument as text."""
    return report([document["title"]], document["findings"], _marks(document["marks"]))


def _marks(marks: Json | None) -> list[Table]:
    """Return the table of marks, none without them; of what could not be marked the tests for
    which there are points all the same."""
    if marks is None:
        return []
    rows: list[Sequence[str]] = [
        (f"{test['points']:g} / {test['of']:g}", test["name"], sentence(test["found"]))
        for test in marks["tests"]
        if marks["note"] is None or test["points"]
    ]
    total = f"{marks['points']:g} of {marks['of']:g} points"
    return [Table("Marks", (), [(total,), *rows, *((hint,) for hint in marks["hints"])])]


def _joints(joints: Sequence[Json], positions: np.ndarray) -> Table:
    rows = []
    for joint, values in zip(joints, positions.T, strict=True):
        known = values[np.isfinite(values)]
        ends = (known.min(), known.max()) if len(known) else (None, None)
        shown = (_position(v, joint["kind"]) for v in (*ends, joint["lower"], joint["upper"]))
        rows.append([joint["name"], *shown])
    return Table("Joints", ("joint", "least", "most", "lower limit", "upper limit"), rows)


def _position(value: float | None, kind: str) -> str:
    if value is None:
        return "none"
    return f"{value * 1e3:.1f} mm" if kind == "prismatic" else f"{math.degrees(value):.1f}°"


def session(document: Json) -> str:
    """Return a SessionDocument as text."""
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
    robots = [
        (one["name"], one["model"], str(one["joint_states"]), str(one["contacts"]))
        for one in told["robots"]
    ]
    return report(
        [sentence(told["summary"])],
        told["troubles"],
        (
            Table("Runs", ("run", "robot", "trajectory", "began", "took", "result"), runs),
            Table("Events", (), events),
            Table("Robots", ("robot", "model", "joint states", "contacts"), robots),
        ),
    )


def check(document: Json) -> str:
    """Return the document of a check as text."""
    told, marks = document["check"], document["check"]["marks"]
    tables = _marks(marks) + [
        Table(
            f"Ready for hardware: {robot['name']}",
            (),
            [
                (STATES[one["state"]], one["condition"]["message"], one["found"]["message"])
                for one in robot["hardware"]
            ],
        )
        for robot in told["robots"]
    ]
    facts = (
        sentence(told["summary"]),
        dotted(robot["model"] for robot in told["robots"]),
        told["claim"]["message"],
        f"report {told['hash'][:12]}",
    )
    return report(facts, told["findings"], tables)


def sentence(said: Json) -> str:
    """Return the message of a diagnostic and its remedy."""
    return f"{said['message']} {said['remedy']}".strip()
