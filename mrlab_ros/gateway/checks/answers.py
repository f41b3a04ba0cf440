"""What the routes about checks take and answer."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import BaseModel, Field

from mrlab_ros.gateway.store.answers import Finding, Strict

Robot = Annotated[str, Field(min_length=1, max_length=100)]
TrajectoryId = Annotated[str, Field(min_length=1, max_length=600)]


class CheckWanted(Strict):
    """Which robot of the lab shall play which trajectory, such as quintic@3."""

    robot: Robot
    trajectory: TrajectoryId


class CheckFinding(Finding):
    """A finding of a check. time, end: s from the first frame; null: it has no instant.

    kind, other: what the robot meets, such as object or robot, and its name; empty: nothing.
    """

    robot: str = ""
    link: str = ""
    time: float | None = None
    end: float | None = None
    kind: str = ""
    other: str = ""


class CheckCondition(BaseModel):
    """One condition of a real controller. state: ok, not or unknown. found: the figure against
    its limit, or why it is not known."""

    condition: CheckFinding
    state: str
    found: CheckFinding


class Check(BaseModel):
    """A check of a robot's motion in the lab.

    state: none where nobody asked. stale: what has changed in the lab since; null: nothing.
    problem: why it failed. verdict, summary, claim, hash: of the report, mrlab.check.1.
    """

    state: Literal["none", "waiting", "running", "done", "failed"]
    robot: str
    trajectory: str
    stale: CheckFinding | None = None
    problem: CheckFinding | None = None
    verdict: str = ""
    summary: CheckFinding | None = None
    claim: CheckFinding | None = None
    hash: str = ""
    duration: float | None = None
    findings: list[CheckFinding] = []
    conditions: list[CheckCondition] = []
