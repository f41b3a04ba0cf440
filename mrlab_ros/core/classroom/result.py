"""What became of one submission: its marks, what was found, and what compares it with others."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from mrlab_ros.core.base.diagnostic import Diagnostic, plain
from mrlab_ros.core.rubrics.marking import Mark, Marks
from mrlab_ros.core.rubrics.rubric import Rubric

MARKED, NO_FILE, FAILED = "marked", "no_file", "failed"
MOST_PATH = 64  # points of the tool's way that a picture has
MOST_FINDINGS = 50


@dataclass(frozen=True)
class Result:
    """The result of a submission, as plain values that JSON holds.

    outcome: MARKED, NO_FILE, or FAILED: the check itself did not come to its end. found: why,
    or the verdict, as `plain` writes a diagnostic. file: the one that was taken, named as it was
    handed in. marks, public: as `Marks.plain`; public is what the student may read. findings:
    as `found`. report: the hash of the check. signature: (K, J) deg, see `similarity`. path:
    (N, 3) m of tool0.
    """

    outcome: str
    found: Mapping[str, Any]
    marks: Mapping[str, Any]
    public: Mapping[str, Any]
    file: str = ""
    sha256: str = ""
    verdict: str = ""
    report: str = ""
    robot: str = ""
    tool: str = ""
    duration: float | None = None
    findings: Sequence[Mapping[str, Any]] = ()
    signature: Sequence[Sequence[float]] = ()
    path: Sequence[Sequence[float]] = ()
    has_trajectory: bool = False
    has_page: bool = False

    @property
    def points(self) -> float:
        return float(self.marks["points"])

    @property
    def of(self) -> float:
        return float(self.marks["of"])

    def plain(self) -> dict[str, Any]:
        """Return the result as a mapping for JSON."""
        return dict(vars(self))


def without_marks(rubric: Rubric, outcome: str, why: Diagnostic, file: str = "") -> Result:
    """Return the result of what could not be checked: no points, and why."""
    marks = Marks(
        tuple(Mark(t.name, 0.0, t.points, False, why, t.hint, t.hidden) for t in rubric.tests),
        note=why,
    )
    return Result(outcome, plain(why), marks.plain(), marks.public().plain(), file)
