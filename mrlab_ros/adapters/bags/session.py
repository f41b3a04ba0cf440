"""Reads a bag's messages into a report, by the message definitions that the bag itself carries."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import orjson
from rosbags.typesys import Stores, get_types_from_msg, get_typestore

from mrlab_ros.adapters.bags.mcap_file import Message
from mrlab_ros.adapters.bags.reader import Bag
from mrlab_ros.core.clock import SECOND, PlaybackClock
from mrlab_ros.core.recording.report import (
    GRASP_STATES,
    HOLDING,
    Changes,
    Contact,
    ReferenceTrajectory,
    ReportedState,
    RobotReport,
    Series,
    SessionReport,
)

# The values of LatencyHop.hop.
HOPS = ("published to bridged", "bridged to received", "published to received")
# Joint states of one robot that are compared with the trajectory; of more, every k-th.
COMPARED = 20_000


class Decoder:
    """Turns CDR into objects whose fields are named as in the message."""

    def __init__(self, definitions: dict[str, str]) -> None:
        self._store = get_typestore(Stores.EMPTY)
        for kind, text in definitions.items():
            self._store.register(
                {
                    name: entry
                    for name, entry in get_types_from_msg(text, kind).items()
                    if name not in self._store.fielddefs
                }
            )

    def __call__(self, kind: str, data: bytes) -> Any:
        # Not deserialize_cdr: that refuses what follows the last field, and rclpy's serialiser
        # leaves room there for the doubles of empty arrays.
        known = self._store.get_msgdef(kind)
        read = known.deserialize_cdr_le if data[1] else known.deserialize_cdr_be
        return read(data[4:], 0, known.cls, self._store)[0]


def read_session(bag: Bag) -> SessionReport:
    """Return what happened in the session that `bag` recorded."""
    reader = _Reader(bag)
    for message in bag.messages(topics=reader.topics):
        reader.take(message)
    return reader.report


class _Reader:
    def __init__(self, bag: Bag) -> None:
        self._bag = bag
        self._decode = Decoder(bag.definitions())
        self._courses = {
            name.removeprefix("trajectories/").removesuffix(".json"): _course(
                bag.attachment(name).data
            )
            for file in bag.files
            for name in file.attachments
            if name.startswith("trajectories/")
        }
        counts = [
            topic.messages
            for topic in bag.topics.values()
            if topic.type == "sensor_msgs/msg/JointState"
        ]
        step = math.ceil(max(counts, default=0) / COMPARED) or 1
        self.report = SessionReport(
            bag.duration,
            bag.start_ns,
            step=step,
            troubles=[*bag.troubles, *(gap.describe(bag.start_ns) for gap in bag.gaps())],
        )
        self._readers: dict[str, Callable[[float, RobotReport, Any], None]] = {
            "mrlab_msgs/msg/PlaybackState": self._state,
            "mrlab_msgs/msg/Telemetry": self._telemetry,
            "mrlab_msgs/msg/Collision": self._collision,
            "mrlab_msgs/msg/Grasp": self._grasp,
        }
        self._general: dict[str, Callable[[float, Any], None]] = {
            "mrlab_msgs/msg/Robots": self._robots,
            "mrlab_msgs/msg/RobotSystems": self._systems,
            "mrlab_msgs/msg/Contacts": self._contacts,
            "mrlab_msgs/msg/Latency": self._latency,
        }
        known = {*self._readers, *self._general, "sensor_msgs/msg/JointState"}
        self.topics = {topic.name for topic in bag.topics.values() if topic.type in known}

    def take(self, message: Message) -> None:
        kind = self._bag.topics[message.topic].type
        time = (message.log_time_ns - self._bag.start_ns) / SECOND
        if kind in self._general:
            self._general[kind](time, self._decode(kind, message.data))
            return
        robot = self.report.robot(message.topic.rsplit("/", 1)[0].strip("/"))
        if kind in self._readers:
            self._readers[kind](time, robot, self._decode(kind, message.data))
            return
        robot.joint_states += 1
        if robot.joint_states % self.report.step == 0:
            state = self._decode(kind, message.data)
            robot.compare(time, _ns(state.header.stamp), np.asarray(state.position), self._courses)

    def _state(self, time: float, robot: RobotReport, state: Any) -> None:
        clock = PlaybackClock(_ns(state.clock.stamp), state.clock.position, state.clock.rate)
        robot.add(ReportedState(_ns(state.header.stamp), state.label, state.trajectory_id, clock))
        robot.states.add(time, state.label, state.trajectory_id)

    def _telemetry(self, time: float, robot: RobotReport, telemetry: Any) -> None:
        if telemetry.frames_sent:
            robot.deadline.add(time, telemetry.deadline_error)
        robot.frames_lost = max(robot.frames_lost, telemetry.frames_lost)

    def _collision(self, time: float, robot: RobotReport, collision: Any) -> None:
        if collision.colliding:
            contact = collision.contact
            other = f"{contact.other} {contact.other_link}".strip()
            robot.collisions.append(Contact(time, contact.link, other, contact.frame))

    def _grasp(self, time: float, robot: RobotReport, grasp: Any) -> None:
        known = grasp.state < len(GRASP_STATES)
        label = GRASP_STATES[grasp.state] if known else str(grasp.state)
        robot.grasps.add(time, label, grasp.object)
        # Bags of earlier versions do not have these fields.
        reason = str(getattr(grasp, "reason", ""))
        if reason:
            robot.remarks.add(time, reason)
        if label == HOLDING and getattr(grasp, "friction_needed", None):
            robot.bear(grasp.object, grasp)

    def _robots(self, time: float, robots: Any) -> None:
        for entry in robots.robots:
            self.report.robot(entry.name).model = entry.model

    def _systems(self, time: float, systems: Any) -> None:
        for system in systems.systems:
            changes = self.report.systems
            if system.name not in changes:
                changes[system.name] = Changes()
            changes[system.name].add(time, system.label, system.message)

    def _contacts(self, time: float, contacts: Any) -> None:
        for contact in contacts.contacts:
            self.report.robot(contact.robot).contacts.append(time)

    def _latency(self, time: float, latency: Any) -> None:
        for hop in latency.hops:
            name = HOPS[hop.hop] if hop.hop < len(HOPS) else str(hop.hop)
            if latency.observer != "bridge":
                name += f" by {latency.observer}"
            owner = hop.topic.strip("/").split("/")[0]
            if not hop.topic:
                series = self.report.latency
            elif owner in self.report.robots:
                series = self.report.robots[owner].latency
            else:
                continue
            if hop.topic.endswith("/joint_states") or not hop.topic:
                series.setdefault(name, Series()).add(time, hop.p50)


def _ns(stamp: Any) -> int:
    return int(stamp.sec) * SECOND + int(stamp.nanosec)


def _course(data: bytes) -> ReferenceTrajectory:
    """Read what the comparison needs of a trajectory file: angles there are in degrees."""
    document = orjson.loads(data)
    positions = np.radians(np.array(document["frames"]["q"], dtype=np.float64))
    return ReferenceTrajectory(float(document["frame_rate"]), positions)
