"""Requests and answers of the routes of trajectories."""

from __future__ import annotations

from typing import Annotated, Any, Literal

from pydantic import BaseModel, ConfigDict, Field

Identifier = Annotated[str, Field(pattern="^[0-9a-f]{32}$")]
SeverityWord = Literal["info", "warning", "error"]


class Fix(BaseModel):
    """A remedy of a finding: an option of a conversion with its value, and the same in MATLAB."""

    option: str
    value: str
    matlab: str
    command: str


class Finding(BaseModel):
    """A finding of the converter about a file. Rows count from 1; 0: none."""

    severity: SeverityWord
    code: str
    message: str
    remedy: str
    variable: str
    where: str
    first_row: int
    last_row: int
    joint: str
    value: float | None
    limit: float | None
    unit: str
    values: dict[str, Any]
    fixes: list[Fix]


class Trajectory(BaseModel):
    """A trajectory without its frames: mrlab_msgs/TrajectoryInfo.

    created: s since 1970. deleted: when it was deleted; null: it is there.
    """

    id: str
    robot_model: str
    end_effector: str
    source_file: str
    source_variable: str
    source_sha256: str
    created: float
    frame_rate: float
    frame_count: int
    duration: float
    has_gripper: bool
    owner: str
    version: int
    shared: bool
    deleted: float | None = None
    warnings: list[Finding]


class Trajectories(BaseModel):
    """Trajectories, ordered by id.

    problem: why they are what was last known; null: they are what the store has.
    """

    trajectories: list[Trajectory]
    problem: Finding | None = None


class Sketch(BaseModel):
    """A robot of sticks in poses evenly spaced in time, each x0, y0, x1, y1, ... in 96 x 64 px."""

    poses: list[list[float]]


class Version(BaseModel):
    """One version of a trajectory. created: s since 1970, when its file was converted."""

    version: int
    created: float
    published: float
    source_file: str
    frame_count: int
    duration: float


class Versions(BaseModel):
    """The versions of a trajectory that are kept, newest first."""

    versions: list[Version]


class Strict(BaseModel):
    """A body without fields that nobody reads."""

    model_config = ConfigDict(extra="forbid")


class Publishing(Strict):
    """A draft that becomes a trajectory's next version. id: its name; empty: the draft's own."""

    draft: Identifier
    id: Annotated[str, Field(max_length=400)] = ""
    shared: bool = False


class Sharing(Strict):
    """A request to share a trajectory with everybody, or to end that."""

    shared: bool


class Restoring(Strict):
    """Which version comes back; 0: the newest, of a trajectory that was deleted."""

    version: Annotated[int, Field(ge=0, le=2**32 - 1)] = 0
