"""/api/class: the submissions of a class with their marks and motions, for its teachers."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache
from typing import Annotated, Any
from urllib.parse import quote

import orjson
from fastapi import APIRouter, Depends, Path, Request, Response
from fastapi.concurrency import run_in_threadpool
from pydantic import BaseModel

from mrlab_ros.adapters.trajectories import formats
from mrlab_ros.app.show import document
from mrlab_ros.classroom.diagnostics import NO_CLASS
from mrlab_ros.classroom.marks.exports import REFERENCE
from mrlab_ros.classroom.shown import ClassFolder, findings
from mrlab_ros.core.base.diagnostic import Fix, from_plain
from mrlab_ros.gateway.checks.desk import CheckFinding
from mrlab_ros.gateway.errors import NotFound
from mrlab_ros.gateway.store.shelf import Shelf, shelf_of


class Mark(BaseModel):
    """The result of a test of the rubric. time: s, where points were lost; null: no instant."""

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


router = APIRouter(prefix="/api/class", tags=["class"])


def class_of(request: Request) -> ClassFolder:
    """Return the class of a gateway, as a dependency; raises NotFound where it shows none."""
    folder = request.app.state.settings.classroom
    if folder is None:
        raise NotFound(NO_CLASS(fixes=(Fix(command="mrlab up --class FOLDER"),)))
    return _folder(folder)


# One of each: it keeps the document that it has read.
_folder = cache(ClassFolder)


TheShelf = Annotated[Shelf, Depends(shelf_of)]
TheClass = Annotated[ClassFolder, Depends(class_of)]
Key = Annotated[str, Path(max_length=300, description="a student's key, or reference")]


@router.get("")
async def overview(graded: TheClass) -> Class:
    """Return all submissions in the order of the class, with their marks."""

    def made() -> Class:
        found = graded.document()
        reference = found.get("reference")
        return Class.model_validate(
            {
                "title": found["title"],
                "robot": found["rubric"]["robot"],
                "submissions": [_submission(each) for each in found["students"]],
                "reference": reference
                and _submission({"key": REFERENCE, "name": REFERENCE, **reference}),
            }
        )

    return await run_in_threadpool(made)


@router.get("/{key}/motion", response_class=Response)
async def motion(graded: TheClass, shelf: TheShelf, key: Key) -> Response:
    """Return a submission as a MotionDocument: lost points come first among its findings."""

    def made() -> bytes:
        entry, loaded = graded.entry(key), graded.trajectory(key)
        robot = shelf.robots.shown(loaded.robot_model, loaded.end_effector)
        shown = document.motion(
            loaded,
            robot,
            message=str(from_plain(entry["found"])),
            diagnostics=findings(entry, loaded),
        )
        return orjson.dumps(shown | {"title": entry["name"]})

    return Response(await run_in_threadpool(made), media_type="application/json")


@router.get("/{key}/file", response_class=Response)
async def file(graded: TheClass, key: Key) -> Response:
    """Return a submission's motion as a trajectory file."""

    def made() -> bytes:
        return b"".join(formats.chunks(graded.trajectory(key)))

    headers = {"Content-Disposition": f'attachment; filename="{quote(key)}.json"'}
    text = await run_in_threadpool(made)
    return Response(text, media_type="application/json", headers=headers)


def _submission(entry: Mapping[str, Any]) -> dict[str, Any]:
    return {**entry, "motion": bool(entry.get("trajectory"))}
