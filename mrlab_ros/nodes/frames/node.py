"""The frames node: /tf, /tf_static, /joint_states, one URDF of all robots, and markers.

The robots whose frames are published, and their newest joint positions.
"""

from __future__ import annotations

import functools
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np
from mrlab_msgs import msg
from rclpy.qos import QoSProfile
from sensor_msgs.msg import JointState
from std_msgs.msg import String
from tf2_msgs.msg import TFMessage

from mrlab_ros.adapters.robots import urdf
from mrlab_ros.adapters.robots.publishing import together
from mrlab_ros.core.base.clock import SECOND, STEP_NS
from mrlab_ros.core.base.errors import LabError
from mrlab_ros.core.base.geometry import Array, Pose
from mrlab_ros.core.robots.frames import WORLD, LinkFrames, joint_name
from mrlab_ros.core.runtime.identity import Identity
from mrlab_ros.messages import joint_states, qos
from mrlab_ros.messages.joint_states import JointStateEncoder
from mrlab_ros.messages.poses import TransformsEncoder, pose_from_message, transforms_to_message
from mrlab_ros.messages.scenes import text_to_message
from mrlab_ros.messages.time import time_from_message
from mrlab_ros.nodes import parameters
from mrlab_ros.nodes.frames.markers import MarkerPublishers
from mrlab_ros.nodes.parameters import FramesParameters
from mrlab_ros.ros.clock import LabClock
from mrlab_ros.ros.decoding import decoder
from mrlab_ros.ros.parameters import NodeArguments, ParameterNode
from mrlab_ros.ros.raw_streams import Received, TopicPoll, raw_publish

if TYPE_CHECKING:
    from typing_extensions import Unpack


# An arm that stands sends two joint states a second; its frames are repeated this often, so that a
# look-up at "now" with tf2's usual patience of 0.1 s succeeds.
REPEATED_NS = SECOND // 20
# An arm that was not heard for this long may be anywhere.
HEARD_NS = 3 * SECOND // 2


@dataclass(eq=False)
class ShownRobot:
    """A robot whose frames are published.

    base: T_world_base. description: its published URDF, empty until it arrived. encoder: writes
    its joint states, joints named as in the URDF of all robots. positions, velocities: rad or m,
    and rad/s or m/s, by joint. placed: whether a joint state of its arm has come. stamp_ns: of the
    newest joint state, or the instant for which it was repeated; heard_ns: of the newest one of
    the arm; sent_ns: of the one that was published last. subscriptions: what is destroyed with it.
    """

    name: str
    joint_names: tuple[str, ...]
    base: Pose
    description: str = ""
    encoder: JointStateEncoder | None = None
    frames: LinkFrames | None = None
    positions: dict[str, float] = field(default_factory=dict)
    velocities: dict[str, float] = field(default_factory=dict)
    placed: bool = False
    stamp_ns: int = 0
    heard_ns: int = 0
    sent_ns: int = 0
    subscriptions: list[Any] = field(default_factory=list)

    def describe(self, text: str) -> None:
        """Take the robot's URDF; raise BadInput where it is none."""
        self.frames = urdf.frames(urdf.parse(text, self.name), self.name)
        names = tuple(joint_name(self.name, joint) for joint in self.frames.joints)
        self.encoder = JointStateEncoder(WORLD, names)
        self.description = text
        self.sent_ns = 0

    def take_arm(self, data: bytes) -> None:
        """Take a joint state of the arm, CDR; raise BadInput where it is none."""
        stamp_ns, positions, velocities = joint_states.read(data, self.joint_names)
        self.stamp_ns, self.heard_ns, self.placed = stamp_ns, stamp_ns, True
        self.positions.update(zip(self.joint_names, positions, strict=True))
        self.velocities.update(zip(self.joint_names, velocities, strict=False))

    def take_fingers(self, stamp_ns: int, positions: Mapping[str, float]) -> None:
        self.stamp_ns = max(self.stamp_ns, stamp_ns)
        self.positions.update(positions)

    def still_there(self, now_ns: int) -> None:
        """Take that an arm that was heard lately stands where it did: tf2 knows it now."""
        if now_ns - self.stamp_ns >= REPEATED_NS and now_ns - self.heard_ns < HEARD_NS:
            self.stamp_ns = now_ns

    def joint_state(self) -> bytes | None:
        """Return the state of all joints, fingers too, as CDR; None before the URDF is there."""
        if self.encoder is None or self.frames is None:
            return None
        joints = self.frames.joints
        return self.encoder.encode(
            self.stamp_ns,
            np.array([self.positions.get(joint, 0.0) for joint in joints]),
            np.array([self.velocities.get(joint, 0.0) for joint in joints]),
        )

    @property
    def moved(self) -> bool:
        """Return whether there is something new to publish. tf2 warns of a repeated stamp."""
        # A stamp from before the last one: the lab's clock was set back, or went back in a loop.
        return self.stamp_ns > self.sent_ns or self.sent_ns - self.stamp_ns >= STEP_NS

    def fixed(self) -> list[tuple[str, str, Pose]]:
        """Return what never moves while the robot stands where it does: (parent, child, pose)."""
        if self.frames is None:
            return []
        return [
            (WORLD, self.frames.root, self.base),
            *((frame.parent, frame.child, frame.pose) for frame in self.frames.fixed),
        ]


class Batch:
    """One message with the frames of several robots."""

    def __init__(self) -> None:
        self._encoders: dict[tuple[tuple[str, str], ...], TransformsEncoder] = {}

    def message(self, robots: Iterable[ShownRobot]) -> bytes | None:
        """Return the frames of the robots as CDR; None: there are none.

        Each robot's frames have the stamp of its joint state.
        """
        pairs: list[tuple[str, str]] = []
        stamps: list[Array] = []
        values: list[Array] = []
        for robot in robots:
            frames = robot.frames
            if frames is None or not frames.moving:
                continue
            pairs.extend(frames.moving)
            stamps.append(np.full(len(frames.moving), robot.stamp_ns, dtype=np.int64))
            values.append(frames.at(robot.positions))
        if not pairs:
            return None
        key = tuple(pairs)
        encoder = self._encoders.get(key)
        if encoder is None:
            # Another set of robots moves now; the last few sets are remembered.
            if len(self._encoders) >= 8:
                self._encoders.clear()
            encoder = self._encoders[key] = TransformsEncoder(pairs)
        return encoder.encode(np.concatenate(stamps), np.concatenate(values))


# As tf2's own broadcasters publish; joint states of all robots too.
TF = QoSProfile(depth=100)
# Between two turns while nobody takes what moves, s: most labs are seen on pages alone.
REST_S = 0.2
# The newest joint state is enough; those before it are not even read.
NEWEST = QoSProfile(depth=1)

Take = Callable[[bytes], None]


class FramesNode(
    ParameterNode[FramesParameters], name="frames", kind=FramesParameters, others=parameters.ALL
):
    """Publishes where each link is, and what else is in the lab, as ROS's own displays take it.

    One thread polls all topics at `rate` and publishes; the node's own executor has nothing to do
    but its parameters.
    """

    def __init__(self, **ros: Unpack[NodeArguments]) -> None:
        super().__init__(**ros)
        self._log = self.get_logger()
        self._identity = Identity(
            self.parameters.lab_id, lambda said: self._log.warning(str(said))
        )
        self._lab_clock = LabClock(self)
        self._robots: dict[str, ShownRobot] = {}
        self._batch = Batch()
        # Takers of a topic's messages.
        self._takers: dict[str, Take] = {}
        # Changes since the last turn: places of robots, and their descriptions.
        self._placed = self._described = False
        self._moving = self.create_publisher(TFMessage, "/tf", TF)
        self._fixed = self.create_publisher(TFMessage, "/tf_static", qos.LATCHED)
        self._joints = self.create_publisher(JointState, "/joint_states", TF)
        self._publish_joints = raw_publish(self._joints)
        self._together = self.create_publisher(String, "/robot_description", qos.LATCHED)
        self._streams = self.hidden_node("streams", remapped=True)
        self._poll = TopicPoll("frames", 1 / self.parameters.rate, self._turn, self._report)
        rate = self.parameters.marker_rate
        self._markers = MarkerPublishers(self, rate, self._identity) if rate else None
        # Publishers of what moves.
        self._moves = [self._moving, self._joints, *(self._markers.moves if self._markers else ())]
        self._subscribe(msg.Robots, "/robots", self._on_robots, qos.LATCHED)
        if self._markers is not None:
            for kind, topic, take, quality in self._markers.topics():
                self._subscribe(kind, topic, take, quality)
        self._poll.start()

    def destroy_node(self) -> None:
        self._poll.stop()
        if self._markers is not None:
            self._markers.close()
        self._streams.destroy_node()
        super().destroy_node()

    def _subscribe(self, kind: Any, topic: str, take: Callable[[Any], None], quality: Any) -> Any:
        """Give the messages of a topic to `take`; CDR where `kind` is taken raw."""
        subscription = self._streams.create_subscription(kind, topic, _unused, quality, raw=True)
        self._takers[topic] = decoder(kind, topic, take, self._streams)
        self._poll.add(subscription, topic)
        return subscription

    def _forget(self, subscription: Any) -> None:
        self._poll.remove(subscription)
        self._takers.pop(subscription.topic_name, None)
        self._streams.destroy_subscription(subscription)

    # the polling thread -----------------------------------------------------------------------

    def _turn(self, received: list[Received]) -> bool:
        """Take what has come, then publish what changed; an error must not end the thread."""
        if not self.context.ok():
            return False
        for message in received:
            take = self._takers.get(message.topic)
            if take is not None:
                self._guarded(functools.partial(take, message.data))
        self._guarded(self._publish)
        if self._markers is not None:
            self._guarded(self._markers.publish_due)
        taken = any(each.get_subscription_count() for each in self._moves)
        self._poll.period = 1 / self.parameters.rate if taken else REST_S
        return True

    def _guarded(self, work: Callable[[], None]) -> None:
        try:
            work()
        except Exception as error:
            self._report(error)

    def _report(self, error: Exception) -> None:
        if self.context.ok():
            said = error if isinstance(error, LabError) else repr(error)
            self._log.error(f"frames: {said}", throttle_duration_sec=1.0)

    def _publish(self) -> None:
        if self._placed:
            self._placed = False
            fixed = [each for robot in self._robots.values() for each in robot.fixed()]
            self._fixed.publish(transforms_to_message(self._lab_clock.now_ns(), fixed))
        if self._described and all(robot.description for robot in self._robots.values()):
            self._described = False
            descriptions = {name: robot.description for name, robot in self._robots.items()}
            self._together.publish(text_to_message(together(descriptions)))
        now_ns = self._lab_clock.now_ns()
        for robot in self._robots.values():
            robot.still_there(now_ns)
        moved = [each for each in self._robots.values() if each.placed and each.moved]
        listened = self._joints.get_subscription_count() if moved else 0
        for robot in moved:
            robot.sent_ns = robot.stamp_ns
            if listened and (state := robot.joint_state()) is not None:
                self._publish_joints(state)
        frames = self._batch.message(moved)
        if frames is not None:
            self._moving.publish(frames)

    def _on_robots(self, message: msg.Robots) -> None:
        if not self._identity.obeys(message.lab):
            return
        wanted = {robot.name: robot for robot in message.robots}
        for name in [name for name in self._robots if name not in wanted]:
            for subscription in self._robots.pop(name).subscriptions:
                self._forget(subscription)
            self._described = True
        for name, robot in wanted.items():
            base, joints = pose_from_message(robot.pose), tuple(robot.joint_names)
            known = self._robots.get(name)
            if known is None:
                self._follow(ShownRobot(name, joints, base))
            else:
                known.base, known.joint_names = base, joints
        self._placed = True
        if self._markers is not None:
            self._markers.robots(message.robots)

    def _follow(self, robot: ShownRobot) -> None:
        name = robot.name
        self._robots[name] = robot
        arm = self._streams.create_subscription(
            JointState, f"/{name}/joint_states", _unused, NEWEST, raw=True
        )
        self._takers[f"/{name}/joint_states"] = robot.take_arm
        self._poll.add(arm, f"/{name}/joint_states")

        def take_fingers(message: JointState) -> None:
            stamp_ns = time_from_message(message.header.stamp)
            robot.take_fingers(stamp_ns, dict(zip(message.name, message.position, strict=True)))

        def describe(message: String) -> None:
            robot.describe(message.data)
            self._placed = self._described = True

        robot.subscriptions = [
            arm,
            self._subscribe(JointState, f"/{name}/finger_states", take_fingers, qos.LATCHED),
            self._subscribe(String, f"/{name}/robot_description", describe, qos.LATCHED),
        ]
        if self._markers is not None:
            for kind, topic, take, quality in self._markers.topics_of(name):
                robot.subscriptions.append(self._subscribe(kind, topic, take, quality))


def _unused(message: Any) -> None:
    """Required by rclpy; the messages are taken by the thread instead."""
