"""What the routes about checks take and answer."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import BaseModel, Field

from mrlab_ros.gateway.store.answers import SeverityWord, Strict

Robot = Annotated[str, Field(min_length=1, max_length=100)]
TrajectoryId = Annotated[str, Field(min_length=1, max_length=600)]


class CheckWanted(Strict):
    """Which robot of the lab shall play which trajectory, such as quintic@3."""

    robot: Robot
    trajectory: TrajectoryId


class CheckFinding(BaseModel):
    """A finding of a check. time, end: s from the first frame; null: it has no instant."""

    severity: SeverityWord
    code: str
    message: str
    remedy: str
    robot: str
    link: str
    time: float | None
    end: float | None
    value: float | None
    limit: float | None
    unit: str


class CheckCondition(BaseModel):
    """One condition of a real controller. state: as the report says it."""

    condition: str
    state: str
    words: str


class Check(BaseModel):
    """A check of a robot's motion in the lab.

    state: none where nobody asked. stale: what has changed in the lab since, empty where nothing
    has. message: why it failed. verdict, summary, claim, hash: of the report, mrlab.check.1.
    """

    state: Literal["none", "waiting", "running", "done", "failed"]
    robot: str
    trajectory: str
    stale: str = ""
    message: str = ""
    verdict: str = ""
    summary: str = ""
    claim: str = ""
    hash: str = ""
    duration: float | None = None
    findings: list[CheckFinding] = []
    conditions: list[CheckCondition] = []
