"""Scenes of the physics node: saving one, and loading one in whole or not at all."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable
from contextlib import AbstractContextManager
from dataclasses import dataclass
from typing import Any

from mrlab_msgs import msg, srv
from rclpy.client import Client
from rclpy.node import Node

from mrlab_ros.adapters.robots.library import RobotLibrary
from mrlab_ros.adapters.scenes.files import SceneFiles
from mrlab_ros.core.clock import PlaybackClock
from mrlab_ros.core.errors import BadInput, LabError, Misuse
from mrlab_ros.core.geometry import Pose, compose
from mrlab_ros.core.physics.engine import BodyState
from mrlab_ros.core.physics.simulated_robot import COMMANDING
from mrlab_ros.core.physics.world import World
from mrlab_ros.core.playback.states import State
from mrlab_ros.core.scene.document import (
    MemberEntry,
    ObjectEntry,
    RobotEntry,
    SceneDocument,
    SystemEntry,
)
from mrlab_ros.messages.poses import pose_from_message, pose_to_message
from mrlab_ros.messages.time import time_from_message
from mrlab_ros.nodes.physics.listener import GraphListener
from mrlab_ros.ros import share
from mrlab_ros.ros.calls import NoAnswer, call

# A change in the graph has reached physics after this, s, or something is wrong.
ARRIVAL = 10.0
# So long, s, fingers have to close on what they held before it is fixed to them by hand.
CLOSING = 1.0
LOOK = 0.02
LOAD_TIMEOUT = 15.0


@dataclass(frozen=True)
class Shared:
    """What the parts of the physics node share; the lock guards the world.

    limit: objects active at once. rehearsal: makes an empty world beside it, to try things out
    in; the caller closes it.
    """

    world: World
    lock: threading.Lock
    ear: GraphListener
    now_ns: Callable[[], int]
    limit: int
    rehearsal: Callable[[], AbstractContextManager[World]]


def document(shared: Shared) -> SceneDocument:
    """Return the scene as it is; the caller holds the lock."""
    world, now_ns = shared.world, shared.now_ns()
    objects = []
    for thing in world.objects:
        holder = world.robot(thing.held_by) if thing.held_by in world.robots else None
        objects.append(
            ObjectEntry(
                thing.name,
                thing.type.id,
                world.motion(thing.name).pose,
                held_by=holder.name if holder else "",
                in_hand=holder.in_hand if holder else None,
            )
        )
    return SceneDocument(
        robots=tuple(
            RobotEntry(
                known.robot.name,
                known.robot.model,
                known.robot.end_effector,
                pose_from_message(known.robot.pose),
                known.playing.trajectory_id,
                # One that is ready begins at its first frame, wherever it stood before.
                known.playing.position(now_ns) if known.playing.state in COMMANDING else 0.0,
            )
            for known in shared.ear.robots.values()
        ),
        objects=tuple(objects),
        surfaces=world.surfaces,
        systems=tuple(_system_entry(system, now_ns) for system in shared.ear.systems),
    )


def _system_entry(system: msg.RobotSystem, now_ns: int) -> SystemEntry:
    clock = PlaybackClock(
        time_from_message(system.clock.stamp), system.clock.position, system.clock.rate
    )
    standing = State(system.state) in COMMANDING
    return SystemEntry(
        system.name,
        tuple(
            MemberEntry(m.robot, m.trajectory_id, m.dwell, tuple(m.waits)) for m in system.members
        ),
        system.mode,
        system.policy,
        system.loop,
        system.rate,
        min(max(clock.at(now_ns), 0.0), system.duration) if standing else 0.0,
    )


class PendingGrasp:
    """Puts an object back into the hand that held it: fingers close on it, or it is fixed there.

    in_hand: the object's pose in the frame of the hand. The caller of look() holds the lock.
    """

    def __init__(self, name: str, robot: str, in_hand: Pose) -> None:
        self.name = name
        self.robot = robot
        self._in_hand = in_hand
        self._since: float | None = None

    def look(self, world: World) -> bool:
        """Bring the object to the hand, once the robot is there; return whether it is held."""
        if self.robot not in world.robots or world.robot(self.robot).placed is None:
            return False
        if world.robot(self.robot).held == self.name:
            return True
        pose = compose(world.hand(self.robot).pose, self._in_hand)
        still = BodyState(pose)
        world.move(self.name, pose, still.linear, still.angular, held=True)
        now = time.monotonic()
        self._since = self._since or now
        if now - self._since < CLOSING:
            return False
        world.attach(self.robot, self.name)
        return True


class SceneLoader:
    """Brings the graph to what a scene says; a scene that cannot be is refused unchanged.

    caller: the node that is spun beside the one that waits here.
    """

    def __init__(self, caller: Node, shared: Shared, files: SceneFiles) -> None:
        self._caller = caller
        self._shared = shared
        self._files = files
        self._library = RobotLibrary(share.directory() / "robots")
        client = caller.create_client
        self._spawn_robot = client(srv.SpawnRobot, "/lab/spawn_robot")
        self._remove_robot = client(srv.Remove, "/lab/remove_robot")
        self._create_system = client(srv.CreateSystem, "/coordinator/create_system")
        self._dissolve_system = client(srv.Remove, "/coordinator/dissolve_system")
        self._list = client(srv.ListTrajectories, "/converter/list")

    def load(self, name: str) -> str:
        """Load a scene; raise LabError, with nothing changed, where it cannot be loaded."""
        scene = self._files.load(name)
        placed = self._checked(scene)
        try:
            self._clear()
            self._place(scene, placed)
            for robot in scene.robots:
                self._add_robot(robot)
            # A member's trajectory is its system's to load, and its place the system's to seek.
            driven = {member.robot for system in scene.systems for member in system.members}
            for robot in scene.robots:
                if robot.trajectory and robot.name not in driven:
                    self._put(robot)
            for system in scene.systems:
                self._add_system(system)
            _until(lambda: self._heard(scene), "physics to hear of the robots and systems")
            for thing in scene.objects:
                if thing.held_by and thing.in_hand is not None:
                    self._give(thing.name, thing.held_by, thing.in_hand)
        except LabError as error:
            raise Misuse(f"the scene is loaded in part: {error}; load it again") from None
        return (
            f"loaded {name}: {len(scene.robots)} robots, {len(scene.objects)} objects, "
            f"{len(scene.surfaces)} surfaces, {len(scene.systems)} systems"
        )

    # before anything changes ----------------------------------------------------------------

    def _checked(self, scene: SceneDocument) -> list[Pose]:
        """Return where the objects will be; raise LabError where the scene cannot be."""
        for robot in scene.robots:
            self._library.model(robot.model)
            self._library.description(robot.model, robot.end_effector or None)
        if len(scene.objects) > self._shared.limit:
            raise BadInput(
                f"the scene has {len(scene.objects)} objects; expected {self._shared.limit} at "
                "most, max_objects of config/physics.yaml"
            )
        with self._shared.rehearsal() as world:
            world.set_surfaces(scene.surfaces)
            placed = []
            for thing in scene.objects:
                made = world.spawn(thing.type, thing.name, thing.pose, automatic=thing.automatic)
                placed.append(world.motion(made.name).pose)
        self._demand_trajectories(scene)
        needed = [self._spawn_robot, self._remove_robot]
        if scene.systems or self._shared.ear.systems:
            needed += [self._create_system, self._dissolve_system]
        for client in needed:
            if not client.wait_for_service(timeout_sec=ARRIVAL):
                raise NoAnswer(
                    f"nobody offers {client.srv_name}; is that part of the lab running?"
                )
        return placed

    def _demand_trajectories(self, scene: SceneDocument) -> None:
        """Raise LabError where a trajectory of the scene is not there for its robot."""
        wanted: dict[str, list[tuple[str, float]]] = {}
        for robot in scene.robots:
            if robot.trajectory:
                wanted.setdefault(robot.name, []).append((robot.trajectory, robot.at))
        for system in scene.systems:
            for member in system.members:
                wanted[member.robot] = [(member.trajectory, 0.0)]
        robots = {robot.name: robot for robot in scene.robots}
        for name, trajectories in wanted.items():
            robot = robots[name]
            fitting = call(
                self._list,
                srv.ListTrajectories.Request(
                    robot_model=robot.model, end_effector=robot.end_effector
                ),
            ).trajectories
            durations = {info.id: info.duration for info in fitting}
            for trajectory, at in trajectories:
                if trajectory not in durations:
                    known = ", ".join(durations) or "none"
                    raise BadInput(
                        f"the scene wants {name} to play '{trajectory}', which the catalogue does "
                        f"not have for it; there are: {known}. Convert the file, then load again"
                    )
                if at > durations[trajectory] + 1e-6:
                    raise BadInput(
                        f"the scene wants {name} at {at:g} s of '{trajectory}', which lasts "
                        f"{durations[trajectory]:g} s; convert that trajectory's file again"
                    )

    def _heard(self, scene: SceneDocument) -> bool:
        """Return whether physics knows what the lab and the coordinator were asked for."""
        ear = self._shared.ear
        robots, systems = dict(ear.robots), {system.name for system in ear.systems}
        return {system.name for system in scene.systems} <= systems and all(
            robot.name in robots and robots[robot.name].described for robot in scene.robots
        )

    # the changes ----------------------------------------------------------------------------

    def _clear(self) -> None:
        ear = self._shared.ear
        gone: set[str] = set()

        def empty() -> bool:
            """Remove what there is; what came a moment ago is heard of in a later look."""
            for system in [s.name for s in ear.systems if s.name not in gone]:
                _demand(call(self._dissolve_system, srv.Remove.Request(name=system)))
                gone.add(system)
            for name in ear.robots.keys() - gone:
                _demand(call(self._remove_robot, srv.Remove.Request(name=name)))
                gone.add(name)
            return not ear.robots and not ear.systems

        # A robot of the same name must begin anew, in physics and in its playback.
        _until(empty, "physics to let the robots go")
        count = self._caller.count_publishers
        topics = [f"/{name}/playback_state" for name in gone]
        _until(lambda: not any(map(count, topics)), "the playbacks of the robots to end")

    def _place(self, scene: SceneDocument, placed: list[Pose]) -> None:
        still = BodyState(Pose())
        with self._shared.lock:
            world = self._shared.world
            world.clear()
            world.set_surfaces(scene.surfaces)
            for thing, pose in zip(scene.objects, placed, strict=True):
                world.spawn(thing.type, thing.name, pose)
                if thing.held_by:
                    # It stays in the air until its robot is there to hold it.
                    world.move(thing.name, pose, still.linear, still.angular, held=True)

    def _add_robot(self, robot: RobotEntry) -> None:
        wanted = srv.SpawnRobot.Request(
            model=robot.model,
            end_effector=robot.end_effector,
            name=robot.name,
            pose=pose_to_message(robot.pose),
        )
        _demand(call(self._spawn_robot, wanted))

    def _put(self, robot: RobotEntry) -> None:
        """Load the robot's trajectory and go to the place where it stood."""
        load = srv.LoadTrajectory.Request(id=robot.trajectory)
        self._order(srv.LoadTrajectory, f"/{robot.name}/load", load)
        if robot.at > 0:
            self._order(srv.Seek, f"/{robot.name}/seek", srv.Seek.Request(position=robot.at))

    def _add_system(self, entry: SystemEntry) -> None:
        request = srv.CreateSystem.Request(
            name=entry.name,
            members=[
                msg.SystemMember(
                    robot=m.robot, trajectory_id=m.trajectory, dwell=m.dwell, waits=list(m.waits)
                )
                for m in entry.members
            ],
            mode=entry.mode,
            policy=entry.policy,
            loop=entry.loop,
        )
        answer = call(self._create_system, request, LOAD_TIMEOUT)
        _demand(answer)
        if entry.rate != 1.0:
            rate = srv.SetRate.Request(rate=entry.rate)
            self._order(srv.SetRate, f"/{entry.name}/set_rate", rate)
        if entry.at > 0:
            at = min(entry.at, answer.system.duration)
            self._order(srv.Seek, f"/{entry.name}/seek", srv.Seek.Request(position=at))

    def _order(self, kind: Any, service: str, request: Any) -> None:
        client: Client = self._caller.create_client(kind, service)
        try:
            _demand(call(client, request, LOAD_TIMEOUT))
        finally:
            self._caller.destroy_client(client)

    def _give(self, name: str, robot: str, in_hand: Pose) -> None:
        regrip = PendingGrasp(name, robot, in_hand)

        def held() -> bool:
            with self._shared.lock:
                return regrip.look(self._shared.world)

        _until(held, f"{robot} to hold {name}")


def _until(condition: Callable[[], bool], what: str) -> None:
    """Wait until `condition` holds; raise NoAnswer, which says `what` for, after ARRIVAL s."""
    deadline = time.monotonic() + ARRIVAL
    while not condition():
        if time.monotonic() > deadline:
            raise NoAnswer(f"waited {ARRIVAL:g} s for {what}")
        time.sleep(LOOK)


def _demand(answer: Any) -> None:
    """Raise Misuse with the reason where another node refused."""
    if not answer.success:
        raise Misuse(answer.message)
