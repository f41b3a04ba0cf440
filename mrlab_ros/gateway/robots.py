"""/api/robots: the robots of the lab, for programs that speak HTTP alone."""

from __future__ import annotations

import asyncio
import time
from collections.abc import Mapping
from typing import Annotated, Any

from fastapi import APIRouter, Path, Response
from fastapi.concurrency import run_in_threadpool
from pydantic import BaseModel, Field, model_validator

from mrlab_ros.core.base.diagnostics import NO_ROBOT_IN_SCENE
from mrlab_ros.core.base.errors import Misuse, Unavailable
from mrlab_ros.core.bridge.assets import SCHEMA
from mrlab_ros.core.playback.diagnostics import DRIVEN_BY_SYSTEM
from mrlab_ros.core.playback.states import MOVING, TABLE, Event, State
from mrlab_ros.gateway.checks.routes import TheChecking
from mrlab_ros.gateway.diagnostics import GATEWAY_WITHOUT_LAB
from mrlab_ros.gateway.errors import NotFound
from mrlab_ros.gateway.lab.connection import LabConnection
from mrlab_ros.gateway.people.person import CurrentPerson
from mrlab_ros.gateway.store.answers import Publishing, Strict
from mrlab_ros.gateway.store.routes import ThePorts, TheShelf, publish
from mrlab_ros.gateway.uploads.motions import said

STATE = "mrlab_msgs/msg/PlaybackState"
TRIGGER = "mrlab_msgs/srv/Trigger"
LOAD = "mrlab_msgs/srv/LoadTrajectory"
RATE = "mrlab_msgs/srv/SetRate"
# An arm that went back to its first frame is confirmed to be clear within this time; how often its
# state is read meanwhile, s.
CLEAR_S = 3.0
LOOK_S = 0.05

router = APIRouter(prefix="/api/robots", tags=["robots"])
schema_router = APIRouter(tags=["robots"])
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
    """Which trajectory shall be played: one of the catalogue, or a draft that is published first.

    A draft is published once the robot may play it, so that a refusal leaves nothing. rate: 1 is
    the declared speed. replace: a robot that moves is paused first, and blends from where it
    stands then; one that a collision halted is stopped first, and begins at its first frame.
    """

    trajectory: Annotated[str, Field(max_length=600)] = ""
    publish: Publishing | None = None
    rate: Annotated[float, Field(ge=-4, le=4, allow_inf_nan=False)] = 1.0
    replace: bool = False

    @model_validator(mode="after")
    def _one_of_both(self) -> Playing:
        if bool(self.trajectory) == (self.publish is not None):
            raise ValueError("name a trajectory, or a draft to publish, and not both")
        return self


class Played(BaseModel):
    """A robot that plays. message: what it says."""

    robot: str
    trajectory: str
    message: str


class Stopped(BaseModel):
    """A robot that was stopped. state: its playback's then; message: what it says of it."""

    robot: str
    state: str
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


@schema_router.get("/api/schema", response_class=Response)
async def schema(there: ThePorts) -> Response:
    """Return the definitions of the lab's messages and services: type name to text."""
    sample = await _connected(there).get(SCHEMA)
    if sample is None:
        raise Unavailable(GATEWAY_WITHOUT_LAB())
    return Response(sample.payload, media_type="application/json")


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
    named = wanted.trajectory
    if named:
        record, version = await run_in_threadpool(shelf.find, person, named)
        named = f"{record.id}@{version.number}"
    state = await _state(lab, robot)
    if state.system:
        raise Misuse(DRIVEN_BY_SYSTEM(system=state.system))
    if wanted.replace and State(state.state) in MOVING:
        await _do(lab, f"{robot}/pause", TRIGGER, {})
    elif wanted.replace and State(state.state) is State.COLLISION_HALT:
        state = await _stopped(lab, robot)
    now = State(state.state)
    if not (wanted.replace and now in MOVING) and (now, Event.LOAD) not in TABLE.rows:
        raise TABLE.refused(now, Event.LOAD, said(state) if state.message else "")
    if wanted.publish is not None:
        made = await publish(person, shelf, there, wanted.publish)
        named = f"{made.id}@{made.version}"
    await _do(lab, f"{robot}/load", LOAD, {"id": named})
    await _do(lab, f"{robot}/set_rate", RATE, {"rate": wanted.rate})
    message = await _do(lab, f"{robot}/play", TRIGGER, {})
    return Played(robot=robot, trajectory=named, message=message)


@router.post("/{robot}/stop")
async def stop(person: CurrentPerson, there: ThePorts, robot: RobotName) -> Stopped:
    """End the run of a robot; one that a collision halted goes back to its first frame."""
    lab = _connected(there)
    await _state(lab, robot)
    state = await _stopped(lab, robot)
    return Stopped(robot=robot, state=state.label, message=state.message)


async def _state(lab: LabConnection, robot: str) -> Any:
    """Return the playback state of a robot; raise NotFound where the scene has no such robot."""
    sample = await lab.get(f"{robot}/playback_state")
    if sample is None:
        raise NotFound(NO_ROBOT_IN_SCENE(robot=robot))
    return lab.definitions.decode(STATE, sample.payload)


async def _stopped(lab: LabConnection, robot: str) -> Any:
    """Stop a robot; return its state once a halt has ended.

    An arm that is not clear at its first frame within CLEAR_S is stopped once more, which takes it
    to its home pose.
    """
    for _ in range(2):
        await _do(lab, f"{robot}/stop", TRIGGER, {})
        deadline = time.monotonic() + CLEAR_S
        while True:
            state = await _state(lab, robot)
            if State(state.state) is not State.COLLISION_HALT:
                return state
            if time.monotonic() > deadline:
                break
            await asyncio.sleep(LOOK_S)
    return state
