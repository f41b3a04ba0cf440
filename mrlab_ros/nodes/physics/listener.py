"""How the physics node follows the graph: robots, their motion and their playback."""

from __future__ import annotations

import functools
import threading
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

from mrlab_msgs import msg
from rclpy.node import Node
from rclpy.subscription import Subscription
from sensor_msgs.msg import JointState
from std_msgs.msg import String

from mrlab_ros.core.base.clock import SECOND
from mrlab_ros.core.base.diagnostic import Diagnostic
from mrlab_ros.core.base.errors import LabError
from mrlab_ros.core.physics.diagnostics import LET_GO
from mrlab_ros.core.physics.engine import LinkPairs
from mrlab_ros.core.physics.grasp.kinds import Gripper
from mrlab_ros.core.physics.grasp.load import Tool
from mrlab_ros.core.physics.simulated_robot import GripperProgram, Playing
from mrlab_ros.core.physics.world import World
from mrlab_ros.core.robots.frames import without_frames
from mrlab_ros.core.runtime.identity import Identity
from mrlab_ros.messages import joint_states, qos
from mrlab_ros.messages import physics as messages
from mrlab_ros.messages.poses import pose_from_message
from mrlab_ros.messages.time import time_from_message
from mrlab_ros.nodes.physics.publishers import WorldPublishers
from mrlab_ros.ros.clock import LabClock
from mrlab_ros.ros.decoding import decoder
from mrlab_ros.ros.node import HiddenNode
from mrlab_ros.ros.raw_streams import WaitSetThread

# Rounds in which messages are taken begin this far apart, ns: half a step of the world.
SPACING_NS = SECOND // 480


@dataclass(eq=False)
class Followed:
    """A robot of /robots and what was received of it.

    let_go: when its last end effector lost what it held, ns, and what is to be said of that.
    """

    robot: msg.Robot
    subscriptions: list[Subscription] = field(default_factory=list)
    description: str = ""
    built: tuple[str, str] = ("", "")
    program: GripperProgram = field(default_factory=GripperProgram)
    playing: Playing = field(default_factory=Playing)
    let_go: tuple[int, Diagnostic | None] = (0, None)


class GraphListener:
    """Feeds the world from the graph's topics on its own thread, which also steps it.

    Joint states arrive a thousand times a second, so they bypass the executor. turn: advances
    the world and returns how long to wait at most, ns. never_touch: returns the pairs of links
    of a model that never touch. tool: returns what is stated of a model with an end effector.
    lab: the id of this lab. The world gets instants of `clock`, messages have the stamps of it.
    """

    def __init__(
        self,
        node: Node,
        world: World,
        publishers: WorldPublishers,
        lock: threading.Lock,
        turn: Callable[[], int],
        never_touch: Callable[[str], LinkPairs],
        gripper: Callable[[str, str], Gripper],
        tool: Callable[[str, str], Tool],
        lab: str,
        clock: LabClock,
    ) -> None:
        self._world = world
        self._clock = clock
        self._never_touch = never_touch
        self._gripper, self._tool = gripper, tool
        self._publishers = publishers
        self._lock = lock
        self._log = node.get_logger()
        self._identity = Identity(lab, lambda said: self._log.warning(str(said)))
        self.robots: dict[str, Followed] = {}
        # The names in the newest /robots; None before the first one.
        self.known_robots: frozenset[str] | None = None
        self._node = HiddenNode("_physics_listener", node.context, remapped=True)
        self._thread = WaitSetThread(node.context, "physics", turn, self._on_error, SPACING_NS)
        self._subscribe(msg.Robots, "/robots", self._on_robots, qos.LATCHED)

    def start(self) -> None:
        self._thread.start()

    def stop(self) -> None:
        """End the thread; the world no longer steps."""
        self._thread.stop()
        self._node.destroy_node()

    def _subscribe(
        self, kind: Any, topic: str, callback: Callable[[Any], None], quality: Any
    ) -> Subscription:
        subscription = self._node.create_subscription(kind, topic, _unused, quality, raw=True)
        self._thread.add(subscription, decoder(kind, topic, callback, self._node))
        return subscription

    def _subscribe_joints(self, name: str, joints: tuple[str, ...]) -> Subscription:
        subscription = self._node.create_subscription(
            JointState, f"/{name}/joint_states", _unused, qos.STREAM, raw=True
        )
        self._thread.add(subscription, functools.partial(self._on_joint_state, name, joints))
        return subscription

    def _on_error(self, error: Exception) -> None:
        said = error if isinstance(error, LabError) else repr(error)
        self._log.error(f"physics: {said}", throttle_duration_sec=1.0)

    def _on_robots(self, message: msg.Robots) -> None:
        if not self._identity.obeys(message.lab):
            return
        wanted = {robot.name: robot for robot in message.robots}
        self.known_robots = frozenset(wanted)
        for name, known in list(self.robots.items()):
            if name not in wanted or wanted[name].model != known.robot.model:
                self._forget(name)
        for name, robot in wanted.items():
            if name not in self.robots:
                self._follow(robot)
                continue
            known = self.robots[name]
            moved = known.robot.pose != robot.pose
            known.robot = robot
            self._build(name)
            if moved:
                with self._lock:
                    if name in self._world.robots:
                        self._world.place_robot(name, pose_from_message(robot.pose))

    def _follow(self, robot: msg.Robot) -> None:
        name = robot.name

        def subscribe(
            kind: Any, topic: str, callback: Callable[[str, Any], None], quality: Any
        ) -> Any:
            return self._subscribe(
                kind, f"/{name}/{topic}", functools.partial(callback, name), quality
            )

        with self._lock:
            self._publishers.add_robot(name)
        known = Followed(robot)
        self.robots = {**self.robots, name: known}
        known.subscriptions += [
            self._subscribe_joints(name, tuple(robot.joint_names)),
            subscribe(String, "robot_description", self._on_description, qos.LATCHED),
            subscribe(msg.PlaybackState, "playback_state", self._on_playback, qos.LATCHED_EVENTS),
            subscribe(msg.GraspTargets, "targets", self._on_targets, qos.LATCHED),
        ]

    def _forget(self, name: str) -> None:
        known = self.robots[name]
        self.robots = {n: k for n, k in self.robots.items() if n != name}
        for subscription in known.subscriptions:
            self._thread.remove(subscription)
            self._node.destroy_subscription(subscription)
        with self._lock:
            if name in self._world.robots:
                self._world.remove_robot(name)
            self._publishers.remove_robot(name)

    def _on_description(self, name: str, message: String) -> None:
        # A message may arrive after its robot was removed.
        if name in self.robots:
            # Contacts name links as the robot's own URDF does.
            self.robots[name].description = without_frames(message.data, name)
            self._build(name)

    def _build(self, name: str) -> None:
        """Add the robot to the world; rebuild it where description or end effector changed."""
        known = self.robots[name]
        wanted = (known.description, known.robot.end_effector)
        if not known.description or known.built == wanted:
            return
        with self._lock:
            now_ns = self._clock.instant_ns()
            held = self._world.remove_robot(name) if name in self._world.robots else ""
            if held:
                said = LET_GO(object=held, robot=name)
                known.let_go = (now_ns, said)
                self._log.info(str(said))
            # Description and end effector come one after the other.
            since_ns, reason = known.let_go
            try:
                self._world.add_robot(
                    name,
                    known.description,
                    tuple(known.robot.joint_names),
                    pose_from_message(known.robot.pose),
                    self._gripper(known.robot.model, known.robot.end_effector),
                    self._never_touch(known.robot.model),
                    self._tool(known.robot.model, known.robot.end_effector),
                    reason if now_ns - since_ns < SECOND else None,
                )
                self._world.set_program(name, known.program)
                self._world.playback(name, known.playing)
            except LabError as error:
                self._log.error(f"{name} has no physics: {error}")
        known.built = wanted

    def _on_joint_state(self, name: str, joints: tuple[str, ...], data: bytes) -> None:
        stamp_ns, positions, velocities = joint_states.read(data, joints)
        with self._lock:
            if name in self._world.robots:
                instant_ns = self._clock.instant(stamp_ns)
                self._world.joint_state(name, instant_ns, positions, velocities)

    def _on_playback(self, name: str, message: msg.PlaybackState) -> None:
        if name not in self.robots or not self._identity.accepts(message.lab):
            return
        stamp_ns = time_from_message(message.header.stamp)
        shifted_ns = stamp_ns - self._clock.instant(stamp_ns)
        playing = messages.playing_from_message(message, shifted_ns)
        playing = playing.after(self.robots[name].playing)
        self.robots[name].playing = playing
        with self._lock:
            if name in self._world.robots:
                self._world.playback(name, playing)

    def _on_targets(self, name: str, message: msg.GraspTargets) -> None:
        if name not in self.robots:
            return
        program = messages.program_from_message(message)
        self.robots[name].program = program
        with self._lock:
            if name in self._world.robots:
                self._world.set_program(name, program)


def _unused(message: Any) -> None:
    """Required by rclpy; the messages are taken by the thread instead."""
