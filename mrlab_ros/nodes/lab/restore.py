"""Runs the steps of a restore: the same for a scene, a restart and the end of a replay."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Collection, Sequence
from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING, Any, Protocol

from mrlab_msgs import msg, srv
from mrlab_msgs.srv import SetLoop
from rclpy.client import Client
from rclpy.node import Node

from mrlab_ros.adapters import threads
from mrlab_ros.core.base.diagnostic import Code, Diagnostic, heard
from mrlab_ros.core.base.errors import LabError, Misuse
from mrlab_ros.core.scene.diagnostics import STEP_FAILED
from mrlab_ros.core.scene.document import (
    ObjectEntry,
    Place,
    RobotEntry,
    SceneDocument,
    SystemEntry,
)
from mrlab_ros.core.scene.restore import (
    AddObjects,
    AwaitGrasps,
    CreateSystem,
    DissolveSystems,
    GoTo,
    Grip,
    LoadTrajectory,
    Present,
    RemoveRobots,
    SetObjects,
    SpawnRobots,
    Step,
    plan_return,
)
from mrlab_ros.core.scene.surfaces import Surface
from mrlab_ros.messages import qos
from mrlab_ros.messages.physics import surface_to_message
from mrlab_ros.messages.poses import pose_to_message
from mrlab_ros.messages.scenes import create_system_request, placement_to_message
from mrlab_ros.nodes.lab.diagnostics import (
    GRASPS_MISSING,
    NOT_AS_BEFORE,
    PLAYBACKS_MISSING,
    ROBOTS_STAY,
)
from mrlab_ros.nodes.lab.observer import Observer
from mrlab_ros.ros.calls import NoAnswer, call
from mrlab_ros.ros.decoding import subscribe
from mrlab_ros.ros.graph import Request, Said

if TYPE_CHECKING:
    from message_bases import Service

# A change reaches the other nodes after this, s, or something is wrong.
ARRIVAL_TIMEOUT_S = 10.0
# Fingers close, or the object is attached, after this, s.
GRASP_TIMEOUT_S = 10.0
CLOSING_S = 1.0
# A coordinator that did not receive /robots yet refuses a system; a refusal counts after this, s.
REFUSAL_TIMEOUT_S = 2.0
RETRY_PERIOD_S = 0.1
# Loading a trajectory, creating a system or setting all objects takes this at most, s.
LOAD_TIMEOUT_S = 15.0
# The other nodes of a lab that is started are there after this, s.
START_TIMEOUT_S = 20.0


class Robots(Protocol):
    """The lab's own robots, and where they stand."""

    def spawn(self, robots: Sequence[RobotEntry]) -> None: ...

    def remove(self, names: Sequence[str]) -> None: ...

    def go_to(self, place: Place) -> None: ...


class LabRestore:
    """Executes one step after another on the graph.

    caller: a node that another thread spins than the one that waits here.
    """

    def __init__(self, caller: Node, observer: Observer, robots: Robots) -> None:
        self._caller = caller
        self._observer = observer
        self._robots = robots

    def execute(self, step: Step) -> None:
        """Execute a step and wait for its effect; raise LabError where it fails."""
        match step:
            case GoTo(place):
                self._robots.go_to(place)
            case DissolveSystems(names):
                for name in names:
                    request = srv.Remove.Request(name=name)
                    self.order(srv.Remove, "/coordinator/dissolve_system", request)
            case RemoveRobots(names):
                self._remove(names)
            case SetObjects(objects, surfaces):
                self.set_objects(objects, surfaces)
            case AddObjects(objects):
                self._add_objects(objects)
            case SpawnRobots(robots):
                self._robots.spawn(robots)
            case LoadTrajectory(robot):
                self._load(robot)
            case CreateSystem(system):
                self._create(system)
            case AwaitGrasps(objects):
                self._await_grasps({thing.name: thing.held_by for thing in objects})
            case Grip(objects):
                for thing in objects:
                    self._grip(thing)

    def order(self, kind: type[Service[Request, Said]], service: str, request: Request) -> Said:
        """Call a service; return its answer, raise Misuse where it refuses."""
        client: Client = self._caller.create_client(kind, service, qos_profile=qos.SERVICES)
        try:
            answer: Said = call(client, request, LOAD_TIMEOUT_S)
        finally:
            self._caller.destroy_client(client)
        if not answer.success:
            raise Misuse(heard(answer))
        return answer

    def set_objects(
        self,
        objects: Sequence[ObjectEntry],
        surfaces: Sequence[Surface],
        *,
        dry_run: bool = False,
    ) -> None:
        """Replace all objects and surfaces; dry_run: only check them, which changes nothing."""
        request = srv.SetObjects.Request(
            objects=list(map(placement_to_message, objects)),
            surfaces=list(map(surface_to_message, surfaces)),
            dry_run=dry_run,
        )
        self.order(srv.SetObjects, "/physics/set_objects", request)

    def _add_objects(self, objects: Sequence[ObjectEntry]) -> None:
        for thing in objects:
            request = srv.SpawnObject.Request(
                type=thing.type, name=thing.name, pose=pose_to_message(thing.pose)
            )
            self.order(srv.SpawnObject, "/physics/spawn_object", request)
            if thing.held_by:
                hold = srv.Attach.Request(robot=thing.held_by, object=thing.name)
                self.order(srv.Attach, "/physics/attach", hold)

    def _grip(self, thing: ObjectEntry) -> None:
        """Hold an object where its robot held it, until that robot has it again."""
        place = srv.MoveObject.Request(
            name=thing.name, pose=pose_to_message(thing.pose), held=True
        )
        hold = srv.Attach.Request(robot=thing.held_by, object=thing.name)
        self.order(srv.MoveObject, "/physics/move_object", place)
        deadline = time.monotonic() + GRASP_TIMEOUT_S
        # Fingers that close on it take it by themselves.
        while not self._observer.wait_for(partial(self._holds, thing), CLOSING_S):
            try:
                self.order(srv.Attach, "/physics/attach", hold)
            except Misuse:
                if time.monotonic() > deadline:
                    place.held = False
                    self.order(srv.MoveObject, "/physics/move_object", place)
                    raise

    def _holds(self, thing: ObjectEntry) -> bool:
        return any(
            each.name == thing.name and each.held_by == thing.held_by
            for each in self._observer.objects
        )

    def _wait_for(
        self, condition: Callable[[], bool], timeout: float, late: Code, **values: Any
    ) -> None:
        if not self._observer.wait_for(condition, timeout):
            raise NoAnswer(late(limit=timeout, **values))

    def _remove(self, names: Sequence[str]) -> None:
        self._robots.remove(names)
        self.await_leaving(names)

    def await_leaving(self, names: Collection[str]) -> None:
        """Wait until playback, physics and systems have let go of robots that were removed.

        A robot of the same name must get a new playback and a new arm in physics.
        """
        topics = [
            f"/{name}/{topic}" for name in names for topic in ("playback_state", "collision")
        ]
        self._wait_for(
            lambda: not self._observer.published(topics) and not self._observer.manned(names),
            ARRIVAL_TIMEOUT_S,
            ROBOTS_STAY,
            robots=[*names],
        )

    def _load(self, robot: RobotEntry) -> None:
        name = robot.name
        load = srv.LoadTrajectory.Request(id=robot.trajectory)
        self.order(srv.LoadTrajectory, f"/{name}/load", load)
        self._set_rate(name, robot.rate)
        if robot.loop:
            self.order(SetLoop, f"/{name}/set_loop", SetLoop.Request(loop=True))
        self._seek(name, robot.at)

    def _set_rate(self, name: str, rate: float) -> None:
        if rate != 1.0:
            self.order(srv.SetRate, f"/{name}/set_rate", srv.SetRate.Request(rate=rate))

    def _seek(self, name: str, position: float) -> None:
        if position > 0:
            self.order(srv.Seek, f"/{name}/seek", srv.Seek.Request(position=position))

    def _create(self, system: SystemEntry) -> None:
        self._wait_for(
            lambda: all(self._observer.state(m.robot) is not None for m in system.members),
            ARRIVAL_TIMEOUT_S,
            PLAYBACKS_MISSING,
            robots=[member.robot for member in system.members],
        )
        service = "/coordinator/create_system"
        request = create_system_request(system)
        deadline = time.monotonic() + REFUSAL_TIMEOUT_S
        while True:
            try:
                made = self.order(srv.CreateSystem, service, request).system
                break
            except Misuse:
                if time.monotonic() > deadline:
                    raise
                time.sleep(RETRY_PERIOD_S)
        self._set_rate(system.name, system.rate)
        self._seek(system.name, min(system.at, made.duration))

    def _await_grasps(self, holders: dict[str, str]) -> None:
        held: dict[str, str] = {}

        def on_objects(message: msg.SceneObjects) -> None:
            held.update({thing.name: thing.held_by for thing in message.objects})

        subscription = subscribe(
            self._caller, msg.SceneObjects, "/objects", on_objects, qos.LATCHED
        )
        try:
            self._wait_for(
                lambda: holders.items() <= held.items(),
                GRASP_TIMEOUT_S,
                GRASPS_MISSING,
                robots=[*holders.values()],
                objects=[*holders],
            )
        finally:
            self._caller.destroy_subscription(subscription)


class Return:
    """Brings back, in a thread of its own, what robots had loaded and the systems there were.

    The lab's robots are there already; their playbacks and the coordinator may still be starting.
    log: takes what may come back at the next start. lose: takes, once, what cannot be brought
    back, before it is left out of the state file.
    """

    def __init__(
        self,
        wanted: SceneDocument,
        restore: LabRestore,
        observer: Observer,
        log: Callable[[str], None],
        lose: Callable[[Diagnostic], None],
    ) -> None:
        loaded = tuple(r for r in wanted.robots if r.trajectory and r.name not in wanted.driven)
        # The part that is not back yet; a state file written meanwhile must still hold it.
        self.pending = SceneDocument(robots=loaded, systems=wanted.systems)
        self._robots = frozenset(robot.name for robot in wanted.robots)
        self._restore = restore
        self._observer = observer
        self._log = log
        self._lose = lose
        self._cancelled = threading.Event()
        self._thread = threads.task("return", self._run)

    def start(self) -> None:
        if self.pending != SceneDocument():
            self._thread.start()

    def cancel(self) -> None:
        """Begin no further step."""
        self._cancelled.set()

    def finish(self) -> None:
        """Cancel, and wait for the step at hand."""
        self.cancel()
        if self._thread.is_alive():
            self._thread.join(LOAD_TIMEOUT_S)

    def _run(self) -> None:
        pending = self.pending
        awaited = {robot.name for robot in pending.robots} | pending.driven

        def complete() -> bool:
            known = all(self._observer.state(name) is not None for name in awaited)
            systems = not pending.systems or self._observer.systems is not None
            return self._cancelled.is_set() or (known and systems)

        if not self._observer.wait_for(complete, START_TIMEOUT_S):
            missing = sorted(name for name in awaited if self._observer.state(name) is None)
            self._warn(PLAYBACKS_MISSING(limit=START_TIMEOUT_S, robots=missing))
            return
        present = Present(
            robots=self._robots,
            loaded={
                name: state.trajectory_id
                for name in awaited
                if (state := self._observer.state(name)) is not None
            },
            systems=frozenset(system.name for system in self._observer.systems or ()),
        )
        steps = plan_return(pending, present)
        self.pending = SceneDocument(
            robots=tuple(step.robot for step in steps if isinstance(step, LoadTrajectory)),
            systems=tuple(step.system for step in steps if isinstance(step, CreateSystem)),
        )
        lost: list[tuple[Step, LabError]] = []
        for step in steps:
            if self._cancelled.is_set():
                return
            try:
                self._restore.execute(step)
            except NoAnswer as error:
                # It stays pending: the next start tries again.
                self._warn(STEP_FAILED(step=step.said, why=error.diagnostic))
            except LabError as error:
                lost.append((step, error))
            except Exception as error:
                # The graph was left beneath it.
                self._warn(STEP_FAILED(step=step.said, why=repr(error)))
            else:
                self._done(step)
        if lost and not self._cancelled.is_set():
            # The state file still has what is lost: a copy is kept before it is written without.
            reasons = [STEP_FAILED(step=step.said, why=error.diagnostic) for step, error in lost]
            self._lose(NOT_AS_BEFORE(all=reasons))
            for step, _ in lost:
                self._done(step)

    def _done(self, step: Step) -> None:
        if isinstance(step, LoadTrajectory):
            robots = tuple(r for r in self.pending.robots if r.name != step.robot.name)
            self.pending = replace(self.pending, robots=robots)
        elif isinstance(step, CreateSystem):
            systems = tuple(s for s in self.pending.systems if s.name != step.system.name)
            self.pending = replace(self.pending, systems=systems)

    def _warn(self, why: Diagnostic) -> None:
        # A failure while the lab ends is no trouble.
        if not self._cancelled.is_set():
            self._log(str(NOT_AS_BEFORE(all=[why])))
