"""Marks that a teacher gives in place of those of tests: they hold over all later runs.

A change belongs to a student's key and to a test, or to the sum of points; the journal keeps it
apart from the marks that tests give. One that was made in the table is found where the table
differs from what the last run wrote.
"""

from __future__ import annotations

import csv
import hashlib
import io
import math
from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

from mrlab_ros.classroom.marks.diagnostics import (
    CHANGED_MARK,
    CHANGED_MARK_NOT_READ,
    CHANGED_MARK_OUT_OF_RANGE,
)
from mrlab_ros.classroom.marks.gradebook import BOM, cell, number
from mrlab_ros.classroom.marks.graded import Student
from mrlab_ros.core.base.diagnostic import Diagnostic

POINTS = "points"  # the name of the sum; tests have their own names
DELIMITERS = ",;\t"
# The points of a student, by the names of tests and POINTS.
Columns = Mapping[str, float]


def digest(table: bytes) -> str:
    """Return the sha256 by which a table is known that no hand changed."""
    return hashlib.sha256(table).hexdigest()


def columns_of(student: Mapping[str, Any]) -> dict[str, float]:
    """Return the points of a student in class.json, as the table shows them."""
    shown = {m["name"]: float(m["points"]) for m in student["marks"]}
    return {**shown, POINTS: float(student["points"])}


def given_of(student: Mapping[str, Any]) -> dict[str, float]:
    """Return the points of a student in class.json without those that a teacher gave."""
    return columns_of(shown(student, {}))


def shown(student: Mapping[str, Any], columns: Columns) -> dict[str, Any]:
    """Return a student of class.json with the points that a teacher gives now."""
    had = {
        "tests": student["marks"],
        "points": student["points"],
        "given": student.get("given", student["points"]),
    }
    now = marks(had, columns)
    return {**student, "marks": now["tests"], "points": now["points"]}


def found(
    table: str, document: Mapping[str, Any]
) -> tuple[dict[str, dict[str, float]], list[Diagnostic]]:
    """Return the points that differ from class.json, by key and column, and cells that are no
    numbers or out of range. The table may have been written by a program that parts cells with
    semicolons."""
    content = table.removeprefix(BOM)
    first = content.partition("\n")[0]
    delimiter = max(DELIMITERS, key=first.count)
    rows = csv.DictReader(io.StringIO(content), delimiter=delimiter)
    students = {s["key"]: s for s in document["students"]}
    changes: dict[str, dict[str, float]] = {}
    problems = []
    for row in rows:
        key = row.get("key") or ""
        before = columns_of(students[key]) if key in students else {}
        for column, points in before.items():
            text = row.get(column if column == POINTS else str(cell(column)))
            if text is None or not text.strip():
                continue
            value = _number(text)
            if value is None:
                problems.append(
                    CHANGED_MARK_NOT_READ(student=students[key]["name"], test=column, found=text)
                )
            elif number(value) == number(points):
                continue
            elif why := out_of_range(students[key], column, value):
                problems.append(why)
            else:
                changes.setdefault(key, {})[column] = value
    return changes, problems


def out_of_range(student: Mapping[str, Any], column: str, points: float) -> Diagnostic | None:
    """Return why a student of class.json cannot have these points, None: they can be had.

    Bonus tests come on top of the sum; the row of the late, which gives none, can take them all.
    """
    of = {m["name"]: float(m["of"]) for m in student["marks"]}
    all_points = math.fsum(of.values())
    most = {**of, POINTS: all_points}.get(column, math.inf)
    least = 0.0 if most else -all_points
    if least <= points <= most:
        return None
    return CHANGED_MARK_OUT_OF_RANGE(
        student=student["name"], test=column, found=points, least=least, most=most
    )


def _number(text: str) -> float | None:
    try:
        value = float(text.strip().replace(",", "."))
    except ValueError:
        return None
    return value if math.isfinite(value) else None


def marks(given: Mapping[str, Any], columns: Columns, comment: str = "") -> dict[str, Any]:
    """Return marks, as `Marks.plain` has them, with those that a teacher gives.

    `given` is then the number of points without the teacher's; what a cap took stays taken. The
    comment stands before the hints. The marks may have been changed before: that is taken back.
    """
    before = [{k: v for k, v in m.items() if k != "given"} | _given(m) for m in given["tests"]]
    tests = [_changed(m, columns) for m in before]
    total = float(given.get("given", given["points"]))
    own = columns.get(POINTS, round(total + _sum(tests) - _sum(before), 6))
    hints = [*([comment] if comment else []), *given.get("hints", ())]
    found = {**given, "tests": tests, "points": own, "hints": hints}
    found.pop("given", None)
    return found if own == total else {**found, "given": total}


def applied(student: Student, columns: Columns, comment: str = "") -> Student:
    """Return a student with the marks and the comment of a teacher; a note names each mark."""
    if not columns and not comment:
        return student
    result = student.result
    changed = marks(result.marks, columns)
    notes = [
        CHANGED_MARK(test=m["name"], before=m["given"], after=m["points"])
        for m in changed["tests"]
        if "given" in m
    ]
    if POINTS in columns and "given" in changed:
        notes.append(CHANGED_MARK(before=changed["given"], after=changed["points"]))
    public = marks(result.public, columns, comment) | {"points": changed["points"]}
    return Student(
        replace(student.submission, notes=(*student.submission.notes, *notes)),
        replace(result, marks=changed, public=public),
    )


def _given(mark: Mapping[str, Any]) -> dict[str, Any]:
    """Return the points that the test gave, where they were changed."""
    if "given" not in mark:
        return {}
    return {"points": mark["given"], "passed": mark["given"] >= mark["of"]}


def _changed(mark: dict[str, Any], columns: Columns) -> dict[str, Any]:
    points = columns.get(mark["name"], mark["points"])
    if points == mark["points"]:
        return mark
    passed = points >= mark["of"]
    return {**mark, "points": points, "passed": passed, "given": mark["points"]}


def _sum(tests: Sequence[Mapping[str, Any]]) -> float:
    return round(math.fsum(m["points"] for m in tests), 6)
