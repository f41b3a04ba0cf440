"""Marks as other programs read them: Excel, Gradescope, tables of Moodle, Canvas and ILIAS."""

from __future__ import annotations

import csv
import io
import re
from collections.abc import Mapping, Sequence
from typing import Any

from mrlab_ros.classroom.marks import matching
from mrlab_ros.classroom.marks.diagnostics import (
    GRADE_TO_REPEAT,
    MAXIMUM_DIFFERS,
    NO_WORKSHEET,
)
from mrlab_ros.classroom.marks.graded import Student
from mrlab_ros.classroom.marks.matching import Person
from mrlab_ros.classroom.marks.result import MARKED, TO_REPEAT, Result
from mrlab_ros.classroom.rubrics.rubric import Rubric
from mrlab_ros.core.base.diagnostic import Diagnostic, from_plain
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.base.foreign_text import for_table

BOM = "\ufeff"  # by which Excel takes a table for UTF-8
# Columns of Moodle's worksheet in English and German, of Canvas' gradebook, and of ILIAS' file of
# marks (status.csv), where a row counts once it is marked as changed.
IDENTIFIERS = ("identifier", "kennung", "login", "id")
NAMES = ("full name", "vollständiger name", "student", "name")
LAST, FIRST = ("lastname", "nachname", "last name"), ("firstname", "vorname", "first name")
GRADES = ("grade", "bewertung", "mark")
MOST = ("maximum grade", "bestwertung")
COMMENTS = ("feedback comments", "feedback als kommentar", "comment")
CHANGED = ("update",)
ASSIGNMENT = re.compile(r"(?P<name>.+) \(\d+\)")  # a column of Canvas
POSSIBLE = "points possible"  # the row of Canvas with what can be had


def cell(value: Any) -> Any:
    """Return a value that no table program computes."""
    return for_table(value) if isinstance(value, str) else value


def table(rubric: Rubric, students: Sequence[Student]) -> str:
    """Return the marks of a class as CSV, a row a student."""
    written = io.StringIO()
    writer = csv.writer(written, lineterminator="\r\n")
    head = ("key", "name", "identifier", "email", "late", "points", "of", "outcome", "verdict")
    writer.writerow([*head, *(cell(t.name) for t in rubric.tests), "file", "words", "notes"])
    for student in students:
        one, result = student.submission, student.result
        marked = result.outcome != TO_REPEAT
        writer.writerow(
            [
                *map(cell, (one.key, one.name, one.identifier, one.email)),
                "yes" if one.late else "no",
                number(result.points) if marked else "",
                number(result.of),
                result.outcome,
                result.verdict,
                *(number(m["points"]) if marked else "" for m in result.marks["tests"]),
                *map(cell, (result.file, text(result.found), " ".join(map(str, one.notes)))),
            ]
        )
    return BOM + written.getvalue()


def text(found: Mapping[str, Any]) -> str:
    """Return the text of a diagnostic as JSON has it."""
    return str(from_plain(found))


def number(value: float) -> str:
    """Return points without trailing zeros."""
    return f"{value:.6g}"


class Sheet:
    """A platform's table: Moodle's grading worksheet, Canvas' gradebook or ILIAS' marks."""

    def __init__(self, template: str, name: str, title: str = "") -> None:
        """Raise BadInput where it is no such table.

        title: of the rubric, by which a column of Canvas is chosen where there are several.
        """
        self.name = name
        content = template.removeprefix(BOM)
        first = content.partition("\n")[0]
        self._start = BOM if template.startswith(BOM) else ""
        self._delimiter = max(",;\t", key=first.count)
        self._rows = list(csv.reader(io.StringIO(content), delimiter=self._delimiter))
        heads = [head.strip().lower() for head in self._rows[0]] if self._rows else []
        identifier, grade = _column(heads, IDENTIFIERS), _column(heads, GRADES)
        grade = _assignment(heads, title) if grade is None else grade
        if identifier is None or grade is None:
            raise BadInput(NO_WORKSHEET(file=name, count=len(heads), columns=heads))
        self._heads, self._identifier, self._grade = heads, identifier, grade

    @property
    def people(self) -> tuple[Person, ...]:
        """Return who has a row; the identifier is what the row says."""
        one, last, first = (_column(self._heads, names) for names in (NAMES, LAST, FIRST))
        parts = [one] if one is not None else [at for at in (first, last) if at is not None]
        found = []
        for row in self._rows[1:]:
            said, name = self._said(row), " ".join(row[at] for at in parts if at < len(row))
            if said:
                found.append(Person(matching.key_of(name, said), name.strip() or said, said))
        return tuple(found)

    def filled(
        self, students: Sequence[Student], places: Mapping[str, str]
    ) -> tuple[str, list[Diagnostic]]:
        """Return the table with the grades in it, and what did not fit.

        places: identifier of a row, by key of a student. Cells that are not grades or comments
        stay as they are.
        """
        most, comments = _column(self._heads, MOST), _column(self._heads, COMMENTS)
        changed, grade = _column(self._heads, CHANGED), self._grade
        by_row = {places[s.key]: s for s in students if places.get(s.key)}
        maxima, problems = set(), []
        rows = [list(row) for row in self._rows]
        for row in rows[1:]:
            if row and row[0].strip().lower() == POSSIBLE:
                of = students[0].result.of if students else 0.0
                if len(row) > grade and _differs(row[grade], of):
                    maxima.add((row[grade], of))
                continue
            student = by_row.get(self._said(row))
            if not student:
                continue
            if student.result.outcome == TO_REPEAT:
                problems.append(GRADE_TO_REPEAT(student=student.submission.name))
                continue
            row += [""] * (len(self._heads) - len(row))
            points = number(student.result.points)
            row[grade] = points.replace(".", ",") if self._delimiter == ";" else points
            if most is not None and _differs(row[most], student.result.of):
                maxima.add((row[most], student.result.of))
            if changed is not None:
                row[changed] = "1"
            if comments is not None:
                row[comments] = str(cell(comment(student.result)))
        differ = [MAXIMUM_DIFFERS(found=found, points=of) for found, of in sorted(maxima)]
        written = io.StringIO()
        csv.writer(written, delimiter=self._delimiter, lineterminator="\r\n").writerows(rows)
        return self._start + written.getvalue(), [*differ, *problems]

    def _said(self, row: Sequence[str]) -> str:
        return row[self._identifier].strip() if len(row) > self._identifier else ""


def comment(result: Result) -> str:
    """Return what a student reads beside the grade: each public test, and hints; where nothing
    could be marked, why."""
    marked = result.outcome == MARKED
    lines = _lines(result.public["tests"], result.public["hints"], marked=marked)
    return lines if marked else f"{text(result.found)}\n{lines}".strip()


def words_of(student: Mapping[str, Any]) -> str:
    """Return what a student of class.json reads: the sum of points, then as `comment`."""
    found = text(student["found"])
    total = f"{number(student['points'])} of {number(student['of'])} points. {found}"
    public = [m for m in student["marks"] if not m["hidden"]]
    lines = _lines(public, student["hints"], marked=student["outcome"] == MARKED)
    return f"{total}\n\n{lines}".strip() + "\n"


def _lines(tests: Sequence[Mapping[str, Any]], hints: Sequence[str], *, marked: bool) -> str:
    """Return a line for each test, and the hints. marked: False: what a teacher gave alone."""
    lines = [
        f"{m['name']}: {number(m['points'])}"
        + (f" of {number(m['of'])}" if m["of"] else "")
        + (f". {text(m['found'])}" if marked else "")
        + (f" {m['hint']}" if m["hint"] and not m["passed"] else "")
        for m in tests
        if m["points"] or (marked and m["of"])
    ]
    return "\n".join([*lines, *hints])


def gradescope(result: Result) -> dict[str, Any]:
    """Return results.json as Gradescope's autograders write it; tests in the rubric's order.

    Hidden tests stay hidden from students; their hints stand in the output for all.
    """
    tests = [
        {
            "number": str(place),
            "name": m["name"],
            "score": m["points"],
            "max_score": m["of"],
            "status": "passed" if m["passed"] else "failed",
            "output": _output(m),
            "visibility": "hidden" if m["hidden"] else "visible",
        }
        for place, m in enumerate(result.marks["tests"], 1)
    ]
    return {
        "score": result.points,
        "output": "\n".join([text(result.found), *result.public["hints"]]),
        "output_format": "text",
        "visibility": "visible",
        "tests": tests,
        "extra_data": {"file": result.file, "report": result.report, "outcome": result.outcome},
    }


def _output(mark: Any) -> str:
    words = text(mark["found"])
    if mark["time"] is not None:
        words = f"at {mark['time']:.2f} s: {words}"
    return f"{words}\n{mark['hint']}" if mark["hint"] and not mark["passed"] else words


def _column(heads: Sequence[str], names: Sequence[str]) -> int | None:
    return next((heads.index(name) for name in names if name in heads), None)


def _assignment(heads: Sequence[str], title: str) -> int | None:
    """Return the column of a task in Canvas' gradebook; None where it is not clear which."""
    found = {
        number: match["name"].strip()
        for number, head in enumerate(heads)
        if (match := ASSIGNMENT.fullmatch(head))
    }
    named = [number for number, name in found.items() if name == title.strip().lower()]
    chosen = named if len(found) > 1 else list(found)
    return chosen[0] if len(chosen) == 1 else None


def _differs(text: str, points: float) -> bool:
    try:
        return abs(float(text.replace(",", ".")) - points) > 1e-6
    except ValueError:
        return False
