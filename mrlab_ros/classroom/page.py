"""The page of a graded class; it reads ClassDocument of web/src/classroom/class_document.ts."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from mrlab_ros.app.show import ingredients, still_text
from mrlab_ros.app.show.page import page
from mrlab_ros.app.show.refusal import refusal_page
from mrlab_ros.classroom.folder import FEEDBACK, PAGES, ResultsFolder
from mrlab_ros.classroom.marks.exports import REFERENCE
from mrlab_ros.classroom.marks.graded import SCHEMA, GradedClass, Student
from mrlab_ros.classroom.marks.result import MARKED, MOST_PATH, REFUSED, TO_REPEAT, Result
from mrlab_ros.classroom.marks.similarity import distances
from mrlab_ros.classroom.marks.ways import drawn
from mrlab_ros.core.base.diagnostic import plain

MOST_FINDINGS, MOST_TESTS = 6, 8
MOST_LEFT_OUT = 200
MOST_PAIRED = 40  # students of the picture of pairs
# Points of the ways of all tools: those of a large class have fewer each, in coarser steps (m).
MOST_POINTS, LEAST_EACH = 40_000, 8
FINE, COARSE = 0.001, 0.01


@dataclass(frozen=True)
class Drawn:
    """How finely the ways are drawn. points: of each, at most; step: m."""

    points: int
    step: float


def class_document(graded: GradedClass) -> dict[str, Any]:
    """Return the class: a row a student, what is common, and who is alike."""
    rubric, figures, common = graded.rubric, graded.statistics(), graded.similar()
    each = max(MOST_POINTS // max(len(graded.students), 1), LEAST_EACH)
    paired = [key for group in common.groups for key in group.keys][:MOST_PAIRED]
    finely = Drawn(min(each, MOST_PATH), FINE if each >= MOST_PATH else COARSE)
    return {
        "schema": SCHEMA,
        "title": rubric.name,
        "form": graded.form,
        "robot": rubric.robot,
        "scene": rubric.scene,
        "points": rubric.points,
        "step": round(finely.step * 1e3),
        "tests": [
            {"name": test.name, "points": test.points, "hidden": test.hidden}
            for test in rubric.tests
        ],
        "statistics": {
            "mean": figures.mean,
            "median": figures.median,
            "full": figures.full,
            "bins": list(figures.bins),
            "tests": [vars(test) for test in figures.tests[:MOST_TESTS]],
            "findings": [
                {"severity": one.severity, "students": one.students, "said": one.example}
                for one in figures.findings[:MOST_FINDINGS]
            ],
        },
        "students": [
            _row(s, replace(finely, points=MOST_PATH) if s.key in paired else finely)
            for s in graded.students
        ],
        "reference": None
        if graded.reference is None
        else _result(REFERENCE, graded.reference, finely),
        "similar": {
            "threshold": common.threshold,
            "usual": common.usual,
            "as_reference": len(common.as_reference),
            "groups": [
                {"keys": list(group.keys), "apart": group.apart, "equal": group.equal}
                for group in common.groups
            ],
            "paired": paired,
            "apart": distances(graded.signatures(), paired),
        },
        "left_out": [
            {"file": each.path, "why": plain(each.why)} for each in graded.left_out[:MOST_LEFT_OUT]
        ],
        "unmatched": [each.plain() for each in graded.unmatched],
        "left_out_count": len(graded.left_out),
    }


def _row(student: Student, finely: Drawn) -> dict[str, Any]:
    one, result = student.submission, student.result
    return {
        **_result(student.key, result, finely),
        "name": one.name,
        "identifier": one.identifier,
        "late": one.late,
        "notes": plain(one.notes),
    }


def _result(key: str, result: Result, finely: Drawn) -> dict[str, Any]:
    """Return what became of a submission; page: relative to the class' own."""
    return {
        "key": key,
        "marked": result.outcome in (MARKED, REFUSED),
        "said": result.found,
        "file": result.file,
        "points": result.points,
        "of": result.of,
        "duration": result.duration,
        "marks": [_mark(mark) for mark in result.marks["tests"]],
        "page": f"pages/{key}.html" if result.has_page else None,
        "path": drawn(result.path, finely.points, finely.step),
    }


def _mark(mark: Mapping[str, Any]) -> dict[str, Any]:
    return {
        "points": mark["points"],
        "passed": mark["passed"],
        "time": mark["time"],
        "found": mark["found"],
    }


def with_page(student: Student, folder: ResultsFolder, share: Path) -> Student:
    """Return a student who has a page: one whose submission could not be checked gets one that
    says why, unless the check is to be repeated."""
    result = student.result
    if result.has_page or result.outcome == TO_REPEAT:
        return student
    for name, marks in ((PAGES, result.marks), (FEEDBACK, result.public)):
        text = refusal_page(student.submission.name, [result.found], marks, share)
        folder.write(f"{name}/{student.key}.html", text.encode())
    return replace(student, result=replace(result, has_page=True))


def text_of(document: Mapping[str, Any]) -> str:
    """Return a ClassDocument as text, which is read without a script."""
    tests, figures = document["tests"], document["statistics"]
    heads = ("student", "points", *(test["name"] for test in tests))
    rows = [
        (
            one["name"], f"{one['points']:g}", *(f"{mark['points']:g}" for mark in one["marks"]),
            *(() if one["duration"] is not None else (still_text.sentence(one["said"]),)),
        )
        for one in document["students"]
    ]  # fmt: skip
    facts = (
        document["robot"],
        document["scene"],
        f"mean {figures['mean']:.3g}, median {figures['median']:.3g} of "
        f"{document['points']:g} points",
    )
    table = still_text.Table("Students", heads, rows)
    return still_text.report([still_text.dotted(facts)], (), [table])


def class_page(graded: GradedClass, share: Path) -> str:
    """Return one HTML file about a class. share: folder with the built pages."""
    document = class_document(graded)
    code = ingredients.code(share, flat=True)
    return page(graded.rubric.name, text_of(document), document, {}, code)
