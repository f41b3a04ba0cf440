"""/api/uploads, /api/conversions, /api/motions: from a file to a motion that can be published.

What the routes about uploads and conversions take and answer.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import Annotated, Any, Literal

from fastapi import APIRouter, Depends, Header, Path, Request, Response
from fastapi.concurrency import run_in_threadpool
from pydantic import BaseModel, Field
from starlette.requests import ClientDisconnect

from mrlab_ros.adapters.store import keys
from mrlab_ros.core.base.errors import BadInput, Unavailable
from mrlab_ros.gateway.diagnostics import GATEWAY_WITHOUT_LAB
from mrlab_ros.gateway.errors import NotFound, NotTheFile
from mrlab_ros.gateway.patience import in_time
from mrlab_ros.gateway.people.person import CurrentPerson, Limit, Person, RateLimit
from mrlab_ros.gateway.ports import Ports, ports
from mrlab_ros.gateway.store.answers import Finding, Identifier, Strict, Trajectory
from mrlab_ros.gateway.store.shelf import Shelf, finding_fields, of_head, shelf_of
from mrlab_ros.gateway.uploads import motions
from mrlab_ros.gateway.uploads.diagnostics import BROKE_OFF, CAME_AS_FORM, NO_FILE_NAME, NO_UPLOAD
from mrlab_ros.gateway.uploads.receive import Receiver

Words = Annotated[str, Field(max_length=10_000)]


class Upload(BaseModel):
    """A file that was received. upload: names it in conversions."""

    upload: Identifier
    file_name: str
    size: int
    sha256: str


class ConversionOptions(Strict):
    """Options of a conversion: those of mrlab_msgs/ConvertTrajectory."""

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


class Conversion(ConversionOptions):
    """What shall become of an upload of one's own."""

    upload: Identifier


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
    """The outcome for a file. values: of the message's code, as the wire has them.

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


TheShelf = Annotated[Shelf, Depends(shelf_of)]
ThePorts = Annotated[Ports, Depends(ports)]
# A class of fifty sends at once behind one name, too: the local user's.
UPLOADS = Limit("uploads", burst=100, period=2.0)
CONVERSIONS = Limit("conversions", burst=200, period=1.0)

router = APIRouter(prefix="/api", tags=["uploads"])


class Desk:
    """Receives the uploads of one gateway and counts what each person asks for."""

    def __init__(self, receiver: Receiver, steady: Callable[[], float] = time.monotonic) -> None:
        self.receiver, self._steady = receiver, steady
        self._limits = {limit.what: RateLimit(limit) for limit in (UPLOADS, CONVERSIONS)}

    def count(self, person: Person, limit: Limit) -> None:
        """Raise TooMany where a person asks too often."""
        self._limits[limit.what].check(person.id, self._steady())


def desk_of(request: Request) -> Desk:
    """Return the desk of a gateway, as a dependency."""
    found: Desk = request.app.state.desk
    return found


TheDesk = Annotated[Desk, Depends(desk_of)]


# The description of a body that is the file itself.
FILE_BODY: dict[str, Any] = {
    "requestBody": {
        "required": True,
        "content": {"application/octet-stream": {"schema": {"type": "string"}}},
    }
}


@router.put("/uploads/{file_name}", status_code=201, openapi_extra=FILE_BODY)
async def upload(
    request: Request,
    person: CurrentPerson,
    shelf: TheShelf,
    desk: TheDesk,
    file_name: Annotated[str, Path(description="such as traj.mat")],
    content_length: Annotated[int | None, Header(ge=0, include_in_schema=False)] = None,
) -> Upload:
    """Receive a file, the raw body of the request; one that breaks off leaves nothing."""
    desk.count(person, UPLOADS)
    return await received(request, shelf.user(person), desk, file_name, content_length)


async def received(
    request: Request, user: str, desk: Desk, file_name: str, announced: int | None
) -> Upload:
    """Store the body of a request; raise BadInput, TooLarge or StoreFailure."""
    if request.headers.get("content-type", "").startswith("multipart/"):
        raise NotTheFile(CAME_AS_FORM(file=file_name))
    try:
        found = await desk.receiver.receive(
            user, file_name, announced, in_time(request.stream(), file_name)
        )
    except ClientDisconnect:
        raise BadInput(BROKE_OFF(file=file_name)) from None
    return Upload(
        upload=found.number,
        file_name=found.file_name,
        size=found.size,
        sha256=found.sha256,
    )


@router.put("/uploads/", include_in_schema=False)
async def upload_without_name(person: CurrentPerson) -> None:
    """Say that an upload needs a name."""
    raise BadInput(NO_FILE_NAME())


@router.post("/conversions")
async def convert(
    person: CurrentPerson,
    shelf: TheShelf,
    there: ThePorts,
    desk: TheDesk,
    asked: Conversion,
) -> Converted:
    """Convert an upload of one's own into a draft, or say what is wrong with it."""
    desk.count(person, CONVERSIONS)
    return await converted(shelf, there, shelf.user(person), asked.upload, asked)


async def converted(
    shelf: Shelf, there: Ports, user: str, upload: str, asked: ConversionOptions
) -> Converted:
    """Convert an upload of a user's; raise BadInput, NotFound or Unavailable."""
    if there.lab is None:
        raise Unavailable(GATEWAY_WITHOUT_LAB())
    key = await run_in_threadpool(_uploaded, shelf, user, upload)
    draft = keys.unique()
    request = asked.model_dump(include=set(ConversionOptions.model_fields))
    request |= {"upload": key, "owner": user, "draft": keys.draft(user, draft)}
    answer = await there.lab.call("converter/convert", "mrlab_msgs/srv/ConvertTrajectory", request)
    if not answer.success and not len(answer.diagnostics):
        raise BadInput(motions.said(answer))
    return await run_in_threadpool(_converted, shelf, user, key, draft, asked, answer)


@router.get("/motions/{motion}", response_class=Response)
async def motion(
    person: CurrentPerson,
    shelf: TheShelf,
    motion: Annotated[str, Path(pattern="^[0-9a-f]{32}$")],
) -> Response:
    """Return the MotionDocument of a conversion of one's own, which pages draw."""
    text = await run_in_threadpool(motions.motion, shelf, shelf.user(person), motion)
    return Response(text, media_type="application/json")


def _uploaded(shelf: Shelf, user: str, number: str) -> str:
    found = shelf.store.list(keys.uploads(user, number))
    if not found:
        raise NotFound(NO_UPLOAD(upload=number))
    return found[0].key


def _converted(
    shelf: Shelf, user: str, key: str, draft: str, asked: ConversionOptions, answer: Any
) -> Converted:
    outcome = motions.OUTCOMES[answer.outcome]
    diagnostics = motions.diagnostics_of(answer)
    found: dict[str, Any] = {"trajectory": None, "draft": None}
    number: str | None = None
    if outcome == "accepted":
        info = answer.trajectory
        own = {"owner": info.owner, "version": int(info.version), "shared": bool(info.shared)}
        found = {"trajectory": of_head(motions.head_of(info), **own), "draft": draft}
        found["trajectory"]["warnings"] = [
            fields for fields in finding_fields(diagnostics) if fields["severity"] == "warning"
        ]
        number = motions.keep_accepted(shelf, user, draft, answer.message, diagnostics)
    else:
        ambiguous = outcome == "ambiguous" and len(answer.candidates)
        shown = answer.candidates[0].preview if ambiguous else answer.preview
        preview = motions.preview_of(shown)
        if preview is not None:
            number = motions.keep_preview(
                shelf,
                user,
                preview,
                model=asked.robot_model,
                end_effector=asked.end_effector,
                file=keys.name_of(key.rsplit("/", 1)[1]),
                message=answer.message,
                verdict="ambiguous" if ambiguous else "refused",
                frame_rate=asked.frame_rate or float(answer.trajectory.frame_rate),
                diagnostics=diagnostics,
            )
    rows = motions.preview_of(answer.preview) is not None
    return Converted.model_validate(
        {
            "outcome": outcome,
            "code": answer.code,
            "message": answer.message,
            "values": dict(motions.said(answer).values),
            "diagnostics": finding_fields(diagnostics),
            "candidates": [motions.candidate_fields(each) for each in answer.candidates],
            "preview": motions.preview_fields(answer.preview) if rows else None,
            "motion": None if number is None else f"/api/motions/{number}",
            **found,
        }
    )
