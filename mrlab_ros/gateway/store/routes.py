"""/api/trajectories: what a person may see and do with trajectories.

The converter alone changes them; these routes call its services for the person.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Annotated, Any, Literal

import orjson
from fastapi import APIRouter, Depends, Path, Query, Response
from fastapi.concurrency import run_in_threadpool
from fastapi.responses import StreamingResponse

from mrlab_ros.adapters.store import keys
from mrlab_ros.app.show import document
from mrlab_ros.app.show.sketch import sketch
from mrlab_ros.core.base.errors import BadInput, Unavailable
from mrlab_ros.core.trajectory.catalogue import Record, Version
from mrlab_ros.gateway.diagnostics import GATEWAY_WITHOUT_LAB
from mrlab_ros.gateway.errors import NotAllowed
from mrlab_ros.gateway.people.person import CurrentPerson, Person
from mrlab_ros.gateway.ports import Ports, ports
from mrlab_ros.gateway.store import answers, downloads
from mrlab_ros.gateway.store.shelf import Shelf, duration, shelf_of, trajectory
from mrlab_ros.gateway.uploads import motions
from mrlab_ros.gateway.uploads.diagnostics import LABS_OWN, NOT_YOURS

TheShelf = Annotated[Shelf, Depends(shelf_of)]
ThePorts = Annotated[Ports, Depends(ports)]
TrajectoryId = Annotated[str, Path(max_length=600, description="such as quintic or anna/pick@3")]

router = APIRouter(prefix="/api/trajectories", tags=["trajectories"])


async def ask(there: Ports, service: str, kind: str, request: Mapping[str, Any]) -> Any:
    """Call a service of the converter; raise Unavailable without a lab, BadInput where it fails.

    kind: the type, such as PublishTrajectory.
    """
    if there.lab is None:
        raise Unavailable(GATEWAY_WITHOUT_LAB())
    answer = await there.lab.call(f"converter/{service}", f"mrlab_msgs/srv/{kind}", request)
    if not answer.success:
        raise BadInput(motions.said(answer))
    return answer


@router.get("", response_model=answers.Trajectories)
async def listing(
    person: CurrentPerson,
    shelf: TheShelf,
    deleted: Annotated[bool, Query(description="those that can be brought back")] = False,
) -> Response:
    """List the person's own trajectories and the shared ones; an instructor's list has all."""
    text = await run_in_threadpool(shelf.listing, person, deleted=deleted)
    return Response(text, media_type="application/json")


@router.post("")
async def publish(
    person: CurrentPerson, shelf: TheShelf, there: ThePorts, publishing: answers.Publishing
) -> answers.Trajectory:
    """Put a draft of one's own into the catalogue, as the next version of its name."""
    user = shelf.user(person)
    request = {
        "draft": keys.draft(user, publishing.draft),
        "id": publishing.id,
        "owner": user,
        "shared": publishing.shared,
    }
    answer = await ask(there, "publish", "PublishTrajectory", request)
    found = await run_in_threadpool(
        shelf.find, person, f"{answer.trajectory.id}@{answer.trajectory.version}"
    )
    return _answer(*found)


@router.get("/{trajectory:path}/motion", response_class=Response)
async def motion(person: CurrentPerson, shelf: TheShelf, trajectory: TrajectoryId) -> Response:
    """Return a trajectory as a MotionDocument, which pages draw."""

    def made() -> bytes:
        record, version = shelf.find(person, trajectory)
        loaded = shelf.files.load(record, version)
        robot = shelf.robots.shown(loaded.robot_model, loaded.end_effector)
        seconds = f"{loaded.duration:.2f} s at {loaded.frame_rate:g} Hz"
        return orjson.dumps(document.motion(loaded, robot, message=f"{loaded.id}: {seconds}"))

    return Response(await run_in_threadpool(made), media_type="application/json")


@router.get("/{trajectory:path}/sketch")
async def drawing(
    person: CurrentPerson, shelf: TheShelf, trajectory: TrajectoryId, response: Response
) -> answers.Sketch:
    """Return a small drawing of a trajectory; that of a version never changes."""

    def made() -> answers.Sketch:
        loaded = shelf.files.load(*shelf.find(person, trajectory))
        robot = shelf.robots.shown(loaded.robot_model, None)
        return answers.Sketch(**sketch(loaded, robot))

    response.headers["Cache-Control"] = "private, max-age=86400"
    return await run_in_threadpool(made)


@router.get("/{trajectory:path}/versions")
async def versions(
    person: CurrentPerson, shelf: TheShelf, trajectory: TrajectoryId
) -> answers.Versions:
    """Return the versions of a trajectory that are kept, newest first."""
    record, _ = await run_in_threadpool(shelf.find, person, trajectory, deleted=True)
    return answers.Versions(
        versions=[
            answers.Version(
                version=version.number,
                created=version.head["created_ns"] * 1e-9,
                published=version.published_ns * 1e-9,
                source_file=version.head["source"]["file"],
                frame_count=version.head["frame_count"],
                duration=duration(version.head),
            )
            for version in reversed(record.versions)
        ]
    )


@router.get("/{trajectory:path}/file", response_class=StreamingResponse)
async def file(
    person: CurrentPerson,
    shelf: TheShelf,
    trajectory: TrajectoryId,
    format: Annotated[Literal["json", "mat", "csv"], Query()] = "json",
) -> StreamingResponse:
    """Return a trajectory as a file."""

    def made() -> tuple[Any, int, str]:
        record, version = shelf.find(person, trajectory)
        loaded = shelf.files.load(record, version)
        return *downloads.written(loaded, record.name, format, shelf.work), record.name

    return downloads.sent(*await run_in_threadpool(made), format)


@router.patch("/{trajectory:path}")
async def share(
    person: CurrentPerson,
    shelf: TheShelf,
    there: ThePorts,
    trajectory: TrajectoryId,
    sharing: answers.Sharing,
) -> answers.Trajectory:
    """Let everybody see a trajectory, or its owner and instructors alone."""
    record = await _changeable(shelf, person, trajectory, "share")
    request = {"id": record.id, "shared": sharing.shared}
    await ask(there, "share", "ShareTrajectory", request)
    return _answer(*await run_in_threadpool(shelf.find, person, record.id))


@router.delete("/{trajectory:path}", status_code=204)
async def delete(
    person: CurrentPerson, shelf: TheShelf, there: ThePorts, trajectory: TrajectoryId
) -> None:
    """Delete a trajectory; it can be brought back for some weeks."""
    record = await _changeable(shelf, person, trajectory, "delete")
    await ask(there, "delete", "Remove", {"name": record.id})


@router.post("/{trajectory:path}/restore")
async def restore(
    person: CurrentPerson,
    shelf: TheShelf,
    there: ThePorts,
    trajectory: TrajectoryId,
    restoring: answers.Restoring,
) -> answers.Trajectory:
    """Bring back a trajectory that was deleted, or make an older version the newest."""
    record = await _changeable(shelf, person, trajectory, "restore", deleted=True)
    request = {"id": record.id, "version": restoring.version}
    await ask(there, "restore", "RestoreTrajectory", request)
    return _answer(*await run_in_threadpool(shelf.find, person, record.id))


async def _changeable(
    shelf: Shelf, person: Person, text: str, service: str, *, deleted: bool = False
) -> Record:
    record, _ = await run_in_threadpool(shelf.find, person, text, deleted=deleted)
    if not shelf.may_change(person, record, f"converter/{service}"):
        if not record.owner:
            raise NotAllowed(LABS_OWN(trajectory=record.id, person=person.name))
        raise NotAllowed(NOT_YOURS(trajectory=record.id, owner=record.owner, person=person.name))
    return record


def _answer(record: Record, version: Version) -> answers.Trajectory:
    return answers.Trajectory(**trajectory(record, version))
