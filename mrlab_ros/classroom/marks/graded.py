"""A class as it was graded: students with their results, and what they have in common."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from statistics import fmean, median
from typing import Any

from mrlab_ros.classroom.marks.exports import REFERENCE, LeftOut, Submission
from mrlab_ros.classroom.marks.matching import Person, Unmatched
from mrlab_ros.classroom.marks.result import TO_REPEAT, Result
from mrlab_ros.classroom.marks.similarity import Similar, similar
from mrlab_ros.classroom.rubrics.rubric import Rubric
from mrlab_ros.core.base.diagnostic import plain

SCHEMA = "mrlab.class.1"
BINS = 10
MOST_MISTAKES = 12


@dataclass(frozen=True)
class Student:
    """One student with the result."""

    submission: Submission
    result: Result

    @property
    def key(self) -> str:
        return self.submission.key


@dataclass(frozen=True)
class LostTest:
    """A test and who lost points at it. points: lost by these on average."""

    name: str
    students: int
    points: float


@dataclass(frozen=True)
class CommonFinding:
    """A finding that several motions have. example: as one of them has it."""

    code: str
    severity: str
    students: int
    example: Mapping[str, Any]


@dataclass(frozen=True)
class Statistics:
    """Figures of a class. bins: students by tenths of the points, the last with full marks."""

    mean: float
    median: float
    full: int
    bins: tuple[int, ...]
    tests: tuple[LostTest, ...]
    findings: tuple[CommonFinding, ...]


@dataclass(frozen=True)
class GradedClass:
    """All that a class' pages and files are made from. left_out: files that are nobody's;
    reference: the result of the solution, None without one. unmatched: what a teacher has to
    decide; rows: of the platform's table that nobody has."""

    rubric: Rubric
    form: str
    students: tuple[Student, ...]
    left_out: tuple[LeftOut, ...] = ()
    reference: Result | None = None
    unmatched: tuple[Unmatched, ...] = ()
    rows: tuple[Person, ...] = ()

    def statistics(self) -> Statistics:
        """Return the figures of the class."""
        results = [s.result for s in self.students if s.result.outcome != TO_REPEAT]
        shares = [r.points / r.of if r.of else 0.0 for r in results]
        bins = [0] * BINS
        for share in shares:
            bins[min(int(share * BINS + 1e-9), BINS - 1)] += 1
        points = [r.points for r in results]
        return Statistics(
            fmean(points) if points else 0.0,
            median(points) if points else 0.0,
            sum(share >= 1.0 for share in shares),
            tuple(bins),
            tuple(self._tests(results)),
            tuple(_common(results)),
        )

    def signatures(self) -> dict[str, Sequence[Sequence[float]]]:
        """Return the signatures of all motions, by student."""
        return {s.key: s.result.signature for s in self.students if s.result.signature}

    def similar(self) -> Similar:
        """Return which motions are nearly the same."""
        signatures = self.signatures()
        digests = {s.key: s.result.sha256 for s in self.students if s.result.sha256}
        return similar(signatures, digests, self.reference.signature if self.reference else ())

    def document(self) -> dict[str, Any]:
        """Return the class as class.json has it; paths are relative to its folder."""
        rubric, reference = self.rubric, self.reference
        common, figures = self.similar(), self.statistics()
        return {
            "schema": SCHEMA,
            "title": rubric.name,
            "form": self.form,
            "rubric": {
                "name": rubric.name,
                "points": rubric.points,
                "robot": rubric.robot,
                "tool": rubric.tool,
                "scene": rubric.scene,
                "tests": [
                    {
                        "name": t.name,
                        "expect": t.expect,
                        "points": t.points,
                        "hidden": t.hidden,
                        "hint": t.hint,
                    }
                    for t in rubric.tests
                ],
            },
            "reference": None if reference is None else self._plain(REFERENCE, reference),
            "students": [
                {
                    "key": s.key,
                    "name": s.submission.name,
                    "identifier": s.submission.identifier,
                    "late": s.submission.late,
                    "folder": s.submission.folder,
                    "sent": s.submission.sent,
                    "notes": [plain(note) for note in s.submission.notes],
                    **self._plain(s.key, s.result),
                }
                for s in self.students
            ],
            "statistics": {
                "mean": round(figures.mean, 6),
                "median": round(figures.median, 6),
                "full": figures.full,
                "bins": list(figures.bins),
                "tests": [_rounded(vars(t)) for t in figures.tests],
                "findings": [vars(f) for f in figures.findings],
            },
            "similar": {
                "threshold_deg": round(common.threshold, 4),
                "usual_deg": None if common.usual is None else round(common.usual, 4),
                "as_reference": list(common.as_reference),
                "groups": [
                    {"students": list(g.keys), "apart_deg": g.apart, "equal": g.equal}
                    for g in common.groups
                ],
            },
            "left_out": [{"path": e.path, "why": plain(e.why)} for e in self.left_out],
            "unmatched": [each.plain() for each in self.unmatched],
            "rows": [
                {"key": row.key, "name": row.name, "identifier": row.identifier}
                for row in self.rows
            ],
        }

    def _tests(self, results: Sequence[Result]) -> list[LostTest]:
        found = []
        for number, test in enumerate(self.rubric.tests):
            marks = [r.marks["tests"][number] for r in results]
            lost = [m["of"] - m["points"] for m in marks if not m["passed"]]
            if lost:
                found.append(LostTest(test.name, len(lost), fmean(lost)))
        return sorted(found, key=lambda t: (-t.students, -t.points, t.name))

    @staticmethod
    def _plain(key: str, result: Result) -> dict[str, Any]:
        return {
            "outcome": result.outcome,
            "found": result.found,
            "points": result.points,
            "given": result.marks.get("given", result.points),
            "of": result.of,
            "file": result.file,
            "sha256": result.sha256,
            "verdict": result.verdict,
            "report": result.report,
            "robot": result.robot,
            "tool": result.tool,
            "duration": result.duration,
            "marks": list(result.marks["tests"]),
            "hints": list(result.public["hints"]),
            "findings": list(result.findings),
            "trajectory": f"trajectories/{key}.json" if result.has_trajectory else None,
            "page": f"pages/{key}.html" if result.has_page else None,
        }


def _common(results: Sequence[Result]) -> list[CommonFinding]:
    """Return the findings that most students have, once a student."""
    counts: Counter[str] = Counter()
    first: dict[str, Mapping[str, Any]] = {}
    for result in results:
        seen = {f["code"]: f for f in reversed(result.findings) if f["severity"] != "info"}
        counts.update(seen.keys())
        for code, found in seen.items():
            first.setdefault(code, found)
    ordered = sorted(counts, key=lambda code: (-counts[code], code))[:MOST_MISTAKES]
    return [
        CommonFinding(code, first[code]["severity"], counts[code], first[code]) for code in ordered
    ]


def _rounded(values: Mapping[str, Any]) -> dict[str, Any]:
    return {
        name: round(value, 6) if isinstance(value, float) and math.isfinite(value) else value
        for name, value in values.items()
    }
