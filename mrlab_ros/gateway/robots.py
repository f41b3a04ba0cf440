"""/api/robots: the robots of the lab, for programs that speak HTTP alone."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Annotated, Any

from fastapi import APIRouter, Path
from fastapi.concurrency import run_in_threadpool
from pydantic import BaseModel, Field

from mrlab_ros.core.base.errors import Misuse, Unavailable
from mrlab_ros.core.playback.states import MOVING
from mrlab_ros.gateway.checks.routes import TheChecking
from mrlab_ros.gateway.diagnostics import GATEWAY_WITHOUT_LAB
from mrlab_ros.gateway.lab.connection import LabConnection
from mrlab_ros.gateway.people.person import CurrentPerson
from mrlab_ros.gateway.store.answers import Strict
from mrlab_ros.gateway.store.routes import ThePorts, TheShelf
from mrlab_ros.gateway.uploads.motions import said

STATE = "mrlab_msgs/msg/PlaybackState"
TRIGGER = "mrlab_msgs/srv/Trigger"
LOAD = "mrlab_msgs/srv/LoadTrajectory"
RATE = "mrlab_msgs/srv/SetRate"

router = APIRouter(prefix="/api/robots", tags=["robots"])
RobotName = Annotated[str, Path(pattern="^[A-Za-z][A-Za-z0-9_]*$", description="such as ur5e_1")]


class Robot(BaseModel):
    """A robot of the scene.

    positions: rad or m, in the model's joint order; null: not known. state: of its playback, such
    as PLAYING; empty: not known. trajectory: such as anna/pick@3; empty: none. position: s.
    """

    name: str
    model: str
    end_effector: str
    positions: list[float] | None
    state: str
    message: str
    trajectory: str
    position: float
    duration: float
    rate: float


class Robots(BaseModel):
    """The robots of the scene, as they were set up."""

    robots: list[Robot]


class Playing(Strict):
    """Which trajectory shall be played. rate: 1 is the declared speed.

    replace: where the robot moves it is paused first; it blends from where it stands then.
    """

    trajectory: Annotated[str, Field(min_length=1, max_length=600)]
    rate: Annotated[float, Field(ge=-4, le=4, allow_inf_nan=False)] = 1.0
    replace: bool = False


class Played(BaseModel):
    """A robot that plays. message: what it says."""

    robot: str
    trajectory: str
    message: str


def _connected(there: ThePorts) -> LabConnection:
    if there.lab is None:
        raise Unavailable(GATEWAY_WITHOUT_LAB())
    return there.lab


async def _do(lab: LabConnection, service: str, kind: str, request: Mapping[str, Any]) -> str:
    """Call a service of a robot; return what it says, raise Misuse where it refuses."""
    answer = await lab.call(service, kind, request)
    if not answer.success:
        raise Misuse(said(answer))
    return str(answer.message)


@router.get("")
async def listing(person: CurrentPerson, there: ThePorts, checking: TheChecking) -> Robots:
    """Return the robots of the scene, where they stand, and what they play."""
    lab = _connected(there)
    if checking.scenes is None:
        raise Unavailable(GATEWAY_WITHOUT_LAB())
    scene = await checking.scenes.now()
    states = {}
    for sample in await lab.get_all("*/playback_state"):
        states[sample.key.split("/")[0]] = lab.definitions.decode(STATE, sample.payload)
    found = []
    for robot in scene.document.robots:
        stands, state = scene.stands.get(robot.name), states.get(robot.name)
        found.append(
            Robot(
                name=robot.name,
                model=robot.model,
                end_effector=robot.end_effector,
                positions=None if stands is None else list(stands),
                state=state.label if state else "",
                message=state.message if state else "",
                trajectory=f"{state.trajectory_id}@{state.trajectory_version}"
                if state and state.trajectory_id
                else "",
                position=float(state.clock.position) if state else 0.0,
                duration=float(state.duration) if state else 0.0,
                rate=float(state.rate) if state else 1.0,
            )
        )
    return Robots(robots=found)


@router.post("/{robot}/play")
async def play(
    person: CurrentPerson,
    shelf: TheShelf,
    there: ThePorts,
    robot: RobotName,
    wanted: Playing,
) -> Played:
    """Load a trajectory that the person may see on a robot, and play it."""
    lab = _connected(there)
    record, version = await run_in_threadpool(shelf.find, person, wanted.trajectory)
    named = f"{record.id}@{version.number}"
    if wanted.replace:
        sample = await lab.get(f"{robot}/playback_state")
        state = sample and lab.definitions.decode(STATE, sample.payload)
        if state and state.state in [each.value for each in MOVING]:
            await _do(lab, f"{robot}/pause", TRIGGER, {})
    await _do(lab, f"{robot}/load", LOAD, {"id": named})
    await _do(lab, f"{robot}/set_rate", RATE, {"rate": wanted.rate})
    message = await _do(lab, f"{robot}/play", TRIGGER, {})
    return Played(robot=robot, trajectory=named, message=message)
