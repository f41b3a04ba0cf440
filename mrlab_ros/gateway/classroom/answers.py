"""What the routes about a class answer."""

from __future__ import annotations

from pydantic import BaseModel

from mrlab_ros.gateway.checks.desk import CheckFinding


class Mark(BaseModel):
    """What a test of the rubric gave. time: s, where points were lost; null: no instant."""

    name: str
    points: float
    of: float
    passed: bool
    found: CheckFinding
    hint: str
    hidden: bool
    time: float | None


class Submission(BaseModel):
    """One student's submission. motion: there is one to show. found: why there is none, or
    the verdict of its check."""

    key: str
    name: str
    points: float
    of: float
    found: CheckFinding
    duration: float | None
    robot: str
    tool: str
    motion: bool
    marks: list[Mark]


class Class(BaseModel):
    """A graded class. reference: the solution, to compare with; null: there is none."""

    title: str
    robot: str
    submissions: list[Submission]
    reference: Submission | None
