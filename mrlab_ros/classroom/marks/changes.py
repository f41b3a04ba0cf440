"""Marks that a teacher changed in the table of a class: they hold over all later runs.

A change belongs to a student's key and to a test, or to the sum of points. It is found where the
table differs from what the last run wrote, and kept apart from the marks that tests give.
"""

from __future__ import annotations

import csv
import hashlib
import io
import math
from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

from mrlab_ros.classroom.marks.diagnostics import CHANGED_MARK, CHANGED_MARK_NOT_READ
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


def found(
    table: str, document: Mapping[str, Any]
) -> tuple[dict[str, dict[str, float]], list[Diagnostic]]:
    """Return the points that differ from class.json, by key and column, and cells that are no
    numbers. The table may have been written by a program that parts cells with semicolons."""
    content = table.removeprefix(BOM)
    first = content.partition("\n")[0]
    delimiter = max(DELIMITERS, key=first.count)
    rows = csv.DictReader(io.StringIO(content), delimiter=delimiter)
    before = {s["key"]: columns_of(s) for s in document["students"]}
    changes: dict[str, dict[str, float]] = {}
    problems = []
    for row in rows:
        key = row.get("key") or ""
        for column, points in before.get(key, {}).items():
            text = row.get(column if column == POINTS else str(cell(column)))
            if text is None or not text.strip():
                continue
            value = _number(text)
            if value is None:
                problems.append(CHANGED_MARK_NOT_READ(student=key, test=column, found=text))
            elif number(value) != number(points):
                changes.setdefault(key, {})[column] = value
    return changes, problems


def _number(text: str) -> float | None:
    try:
        value = float(text.strip().replace(",", "."))
    except ValueError:
        return None
    return value if math.isfinite(value) else None


def applied(student: Student, changes: Columns) -> Student:
    """Return a student with changed marks; a note names each."""
    if not changes:
        return student
    result = student.result
    tests = _changed(result.marks["tests"], changes)
    total = changes.get(POINTS, _total(result.marks, tests))
    notes = [
        CHANGED_MARK(test=m["name"], before=m["points"], after=changes[m["name"]])
        for m in result.marks["tests"]
        if m["name"] in changes
    ]
    if POINTS in changes:
        notes.append(CHANGED_MARK(before=result.points, after=total))
    public = _changed(result.public["tests"], changes)
    return Student(
        replace(student.submission, notes=(*student.submission.notes, *notes)),
        replace(
            result,
            marks={**result.marks, "tests": tests, "points": total},
            public={**result.public, "tests": public, "points": total},
        ),
    )


def merged(
    kept: Mapping[str, Columns], new: Mapping[str, Columns], students: Sequence[Student]
) -> dict[str, dict[str, float]]:
    """Return all changes of a class; one that says what the tests say is none."""
    every: dict[str, dict[str, float]] = {}
    for student in students:
        marks = student.result.marks
        given = {m["name"]: m["points"] for m in marks["tests"]}
        own = {**kept.get(student.key, {}), **new.get(student.key, {})}
        own = {name: v for name, v in own.items() if name == POINTS or given.get(name, v) != v}
        if own.get(POINTS) == _total(marks, _changed(marks["tests"], own)):
            own.pop(POINTS)
        if own:
            every[student.key] = own
    return every


def _changed(tests: Sequence[Mapping[str, Any]], changes: Columns) -> list[Mapping[str, Any]]:
    return [
        {**m, "points": changes[m["name"]], "passed": changes[m["name"]] >= m["of"]}
        if m["name"] in changes
        else m
        for m in tests
    ]


def _total(marks: Mapping[str, Any], tests: Sequence[Mapping[str, Any]]) -> float:
    """Return the sum of points with changed tests; what a cap took stays taken."""
    return round(float(marks["points"]) + _sum(tests) - _sum(marks["tests"]), 6)


def _sum(tests: Sequence[Mapping[str, Any]]) -> float:
    return round(math.fsum(m["points"] for m in tests), 6)
