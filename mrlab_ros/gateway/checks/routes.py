"""/api/checks: whether a robot of the lab can play a trajectory where everything stands now, and
what a draft makes a robot touch that stands alone."""

from __future__ import annotations

import asyncio
import math
import time
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Annotated, Any

from fastapi import APIRouter, Depends, Path, Query, Request
from fastapi.concurrency import run_in_threadpool

from mrlab_ros.adapters.share import directory
from mrlab_ros.adapters.store.port import Missing
from mrlab_ros.app.check.in_lab import LabScene, Task
from mrlab_ros.core.base.errors import LabError, Unavailable
from mrlab_ros.core.base.geometry import Pose
from mrlab_ros.core.scene.document import RobotEntry, SceneDocument
from mrlab_ros.core.trajectory.catalogue import Record, Version
from mrlab_ros.core.trajectory.trajectory import Trajectory
from mrlab_ros.gateway.checks import desk
from mrlab_ros.gateway.checks.desk import CheckDesk, Key, answer
from mrlab_ros.gateway.checks.scene import SceneWatch
from mrlab_ros.gateway.diagnostics import GATEWAY_WITHOUT_LAB
from mrlab_ros.gateway.errors import NotFound
from mrlab_ros.gateway.people.person import CurrentPerson, Limit, Person, RateLimit
from mrlab_ros.gateway.store.shelf import Shelf, shelf_of
from mrlab_ros.gateway.uploads import motions
from mrlab_ros.gateway.uploads.diagnostics import NO_MOTION

# Of one person; that of everybody is bounded by the queue.
CHECKS = Limit("checks", burst=20, period=3.0)

router = APIRouter(prefix="/api/checks", tags=["checks"])


@dataclass(eq=False)
class Checking:
    """State that the routes share. scenes: None: this gateway has no lab."""

    desk: CheckDesk
    scenes: SceneWatch | None
    limit: RateLimit = field(default_factory=lambda: RateLimit(CHECKS))


def checking_of(request: Request) -> Checking:
    """Return the checks of a gateway, as a dependency."""
    found: Checking = request.app.state.checking
    return found


TheShelf = Annotated[Shelf, Depends(shelf_of)]
TheChecking = Annotated[Checking, Depends(checking_of)]
RobotName = Annotated[str, Query(min_length=1, max_length=100, description="such as ur5e_1")]
Wanted = Annotated[str, Query(min_length=1, max_length=600, description="such as quintic@3")]


async def _key(shelf: Shelf, person: Person, robot: str, text: str) -> tuple[Key, Record, Version]:
    """Return whose check it is; raise NoTrajectory where the person may not see the motion."""
    record, version = await run_in_threadpool(shelf.find, person, text)
    return (robot, f"{record.id}@{version.number}"), record, version


@router.post("", status_code=202)
async def begin(
    person: CurrentPerson, shelf: TheShelf, checking: TheChecking, wanted: desk.CheckWanted
) -> desk.Check:
    """Check a stored trajectory on a robot of the lab, in the scene as it is now.

    Another check of the same robot ends; the same one, of an unchanged scene, is not run again.
    """
    if checking.scenes is None:
        raise Unavailable(GATEWAY_WITHOUT_LAB())
    checking.limit.check(person.id, time.monotonic())
    key, record, version = await _key(shelf, person, wanted.robot, wanted.trajectory)
    scene = await checking.scenes.now()
    file = await run_in_threadpool(shelf.files.path, version)

    def task() -> Task:
        return Task(directory(), file, record.id, wanted.robot, scene)

    return answer(key, checking.desk.ask(key, task, scene, version.key), scene)


@router.get("/drafts/{draft}")
async def of_draft(
    person: CurrentPerson,
    shelf: TheShelf,
    checking: TheChecking,
    draft: Annotated[str, Path(pattern="^[0-9a-f]{32}$")],
) -> list[desk.CheckFinding]:
    """Return what a robot that plays a draft of one's own touches, alone on a floor.

    Answers when the check has ended; that of another draft of the same person ends it.
    """
    checking.limit.check(person.id, time.monotonic())
    user = shelf.user(person)
    try:
        motion = await run_in_threadpool(motions.of_draft, shelf, user, draft)
    except Missing:
        raise NotFound(NO_MOTION()) from None
    alone = RobotEntry("robot", motion.robot_model, motion.end_effector or "", Pose())
    scene = LabScene(SceneDocument((alone,)))

    def task() -> Task:
        return Task(directory(), motion, motion.id, alone.name, scene)

    entry = checking.desk.ask((user, draft), task, scene, draft)
    if entry.work is not None:
        await asyncio.wait((entry.work,))
    if entry.problem is not None:
        raise Unavailable(entry.problem)
    found = entry.report.get("findings", ())
    return [_in_rows(each, motion) for each in found if each.get("other")]


def _in_rows(found: Mapping[str, Any], motion: Trajectory) -> desk.CheckFinding:
    """Return a finding of a check with the rows of its instants, as a converter's has them."""
    row, last = (
        min(math.floor((found.get(at) or 0.0) * motion.frame_rate) + 1, motion.frame_count)
        for at in ("time", "end")
    )
    return desk.CheckFinding.model_validate(
        {**found, "first_row": row, "last_row": max(row, last)}
    )


@router.get("")
async def state(
    person: CurrentPerson,
    shelf: TheShelf,
    checking: TheChecking,
    robot: RobotName,
    trajectory: Wanted,
) -> desk.Check:
    """Return what is known of a check, and what has changed in the lab since."""
    key, _, _ = await _key(shelf, person, robot, trajectory)
    entry = checking.desk.find(key)
    now = None
    if entry is not None and entry.state == "done" and checking.scenes is not None:
        try:
            now = await checking.scenes.now()
        except LabError:
            now = None  # the lab is away: what was found is shown as it was
    return answer(key, entry, now)


@router.delete("", status_code=204)
async def cancel(
    person: CurrentPerson,
    shelf: TheShelf,
    checking: TheChecking,
    robot: RobotName,
    trajectory: Wanted,
) -> None:
    """End a check that waits or runs."""
    key, _, _ = await _key(shelf, person, robot, trajectory)
    checking.desk.cancel(key)
