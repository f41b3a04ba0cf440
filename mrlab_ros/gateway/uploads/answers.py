"""What the routes about uploads and conversions take and answer."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import BaseModel, Field

from mrlab_ros.gateway.store.answers import Finding, Identifier, Strict, Trajectory

Words = Annotated[str, Field(max_length=10_000)]


class Upload(BaseModel):
    """A file that was received. upload: names it in conversions."""

    upload: Identifier
    file_name: str
    size: int
    sha256: str


class Conversion(Strict):
    """What a file becomes: the options of mrlab_msgs/ConvertTrajectory."""

    upload: Identifier
    robot_model: Words
    end_effector: Words = ""
    frame_rate: Annotated[float, Field(ge=0, le=1e9, allow_inf_nan=False)] = 0.0
    variable: Words = ""
    columns: Words = ""
    transpose: bool = False
    degrees: bool = False
    unwrap: bool = False
    resample: bool = False
    join: Words = ""
    gripper: Words = ""
    invert: bool = False
    units: Words = ""
    id: Words = ""


class Preview(BaseModel):
    """Some rows of a matrix; values row by row, null where not finite."""

    variable: str
    rows: list[int]
    columns: int
    values: list[float | None]


class Candidate(BaseModel):
    """A matrix that may be the trajectory."""

    variable: str
    rows: int
    columns: int
    minimum: float | None
    maximum: float | None
    score: float
    reasons: list[Finding]
    preview: Preview


class Converted(BaseModel):
    """What became of a file. values: of the message's code, as the wire has them.

    motion: URL of its MotionDocument; null: it holds no motion.
    """

    outcome: Literal["rejected", "accepted", "ambiguous"]
    code: str
    message: str
    values: dict[str, str]
    diagnostics: list[Finding]
    candidates: list[Candidate]
    preview: Preview | None
    trajectory: Trajectory | None
    draft: Identifier | None
    motion: str | None
