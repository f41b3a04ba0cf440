"""Reads a bag's messages into a report, by the message definitions that the bag itself carries."""

from __future__ import annotations

import contextlib
import math
import struct
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import orjson
from rosbags.serde import SerdeError
from rosbags.typesys import Stores, get_types_from_msg, get_typestore

from mrlab_ros.adapters.bags.courses import Reference, Samples, add_courses
from mrlab_ros.adapters.bags.diagnostics import (
    BAD_MESSAGE,
    BAG_LIVE,
    BAG_WITHOUT_MODEL,
    BAG_WITHOUT_ROBOTS,
    CLOCK_SET_BACK,
    MESSAGES_UNREADABLE,
    NOTHING_RECORDED,
    TRAJECTORY_UNREADABLE,
)
from mrlab_ros.adapters.bags.mcap_file import Message
from mrlab_ros.adapters.bags.reader import Bag
from mrlab_ros.core.base.clock import SECOND, PlaybackClock
from mrlab_ros.core.base.diagnostic import INFO, WARNING, Diagnostic, Severity
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.base.geometry import Pose
from mrlab_ros.core.recording.diagnostics import ENDING, LOOKED_HERE, importing
from mrlab_ros.core.recording.moves import ObjectTrack, Placed, Target, Targets
from mrlab_ros.core.recording.report import (
    GRASP_STATES,
    HOLDING,
    Changes,
    Contact,
    Event,
    Hop,
    ReferenceTrajectory,
    ReportedState,
    RobotReport,
    Series,
    SessionReport,
)
from mrlab_ros.core.recording.run_finding import runs_of
from mrlab_ros.core.robots.frames import without_frames

JOINTS = "sensor_msgs/msg/JointState"
DESCRIPTION = "/robot_description"
FINGERS = "/finger_states"
# What the stops of a guided replay are made from.
EVENTS = frozenset(
    f"mrlab_msgs/msg/{name}"
    for name in (
        "PlaybackState",
        "Collision",
        "Grasp",
        "GraspTargets",
        "Robots",
        "SceneObjects",
        "LookHere",
    )
)
# s; what physics sends sixty times a second is read thirty times.
OBJECT_INTERVAL = 1 / 30
# The values of LatencyHop.hop.
HOPS = ("published_to_bridged", "bridged_to_received", "published_to_received")
# s: stamps that go back further are of a clock that was set.
SET_BACK = 1.0
# Errors of reading a message whose bytes are damaged, or of another type.
BROKEN = (SerdeError, struct.error, ValueError, IndexError, MemoryError)
# Topics of a foreign bag that are named.
NAMED = 6
# Joint states of one robot that are compared with the trajectory; of more, every k-th.
COMPARED = 20_000
# Joint states of all robots that are compared, for the memory that takes: 0.4 kB each.
ALL_COMPARED = 400_000


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
        try:
            read = known.deserialize_cdr_le if data[1] else known.deserialize_cdr_be
            return read(data[4:], 0, known.cls, self._store)[0]
        except BROKEN as error:
            raise BadInput(BAD_MESSAGE(type=kind, problem=str(error))) from None


def read_session(bag: Bag, reference: Reference | None = None) -> SessionReport:
    """Return what happened in the session that `bag` recorded.

    reference: what the runs are compared with; None: the trajectory that each played.
    """
    reader = _Reader(bag)
    for message in bag.messages(topics=reader.topics):
        reader.take(message)
    report = reader.report
    report.troubles += [*reader.troubles(), *_missing(bag, report)]
    report.runs = runs_of(report, reader.objects, reader.targets)
    add_courses(report, reader.samples, reader.descriptions, reader.courses, reference)
    return report


def read_events(bag: Bag, wanted: Callable[[], bool]) -> SessionReport:
    """Return the runs of a session, without their figures, and the marks that people set in it.

    wanted: asked between messages; where it is False, the rest is not read.
    """
    reader = _Reader(bag, EVENTS)
    for message in bag.messages(topics=reader.topics):
        if not wanted():
            break
        reader.take(message)
    reader.report.runs = runs_of(reader.report, reader.objects, reader.targets)
    return reader.report


def model_that_played(bag: Bag) -> str:
    """Return the model of the first robot of a bag; raise BadInput where it has none."""
    decode = Decoder(bag.definitions())
    kind = "mrlab_msgs/msg/Robots"
    topics = {topic.name for topic in bag.topics.values() if topic.type == kind}
    for message in bag.messages(topics=topics):
        for robot in decode(kind, message.data).robots:
            return str(robot.model)
    raise BadInput(BAG_WITHOUT_MODEL(path=str(bag.path)))


class _Reader:
    """types: of the messages that are read; empty: all that the report needs."""

    def __init__(self, bag: Bag, types: frozenset[str] = frozenset()) -> None:
        self._bag = bag
        self._decode = Decoder(bag.definitions())
        self.courses: dict[str, ReferenceTrajectory] = {}
        unread = []
        for name in [name for file in bag.files for name in file.attachments]:
            if types or not name.startswith("trajectories/"):
                continue
            try:
                course = _course(bag.attachment(name).data)
            except (ValueError, TypeError, LookupError):
                unread.append(TRAJECTORY_UNREADABLE(attachment=name))
            else:
                self.courses[name.removeprefix("trajectories/").removesuffix(".json")] = course
        counts = [topic.messages for topic in bag.topics.values() if topic.type == JOINTS]
        step = math.ceil(max(max(counts, default=0) / COMPARED, sum(counts) / ALL_COMPARED)) or 1
        self.report = SessionReport(
            bag.duration,
            bag.start_ns,
            step=step,
            troubles=[
                *_condition(bag),
                *(gap.said(bag.start_ns) for gap in bag.gaps()),
                *unread,
            ],
        )
        self.objects: dict[str, ObjectTrack] = {}
        self.targets: dict[str, Targets] = {}
        self.samples: dict[str, Samples] = {}
        # URDFs by robot.
        self.descriptions: dict[str, str] = {}
        self._seen = -1.0
        # When a robot's stamps went back, s of the session; by how much, s; the stamp before, ns.
        self._set_back: tuple[float, float, int] | None = None
        # Set while the times of the bag go on evenly after that.
        self._even = False
        # Messages that cannot be read, by topic.
        self._broken: dict[str, int] = {}
        self._readers: dict[str, Callable[[float, RobotReport, Any], None]] = {
            "mrlab_msgs/msg/PlaybackState": self._state,
            "mrlab_msgs/msg/Telemetry": self._telemetry,
            "mrlab_msgs/msg/Collision": self._collision,
            "mrlab_msgs/msg/Grasp": self._grasp,
            "mrlab_msgs/msg/GraspTargets": self._targets,
        }
        self._general: dict[str, Callable[[float, Any], None]] = {
            "mrlab_msgs/msg/Robots": self._robots,
            "mrlab_msgs/msg/RobotSystems": self._systems,
            "mrlab_msgs/msg/Contacts": self._contacts,
            "mrlab_msgs/msg/Latency": self._latency,
            "mrlab_msgs/msg/SceneObjects": self._objects,
            "mrlab_msgs/msg/LookHere": self._mark,
        }
        known = types or {*self._readers, *self._general, JOINTS}
        self.topics = {
            topic.name
            for topic in bag.topics.values()
            if topic.type in known or (not types and topic.name.endswith(DESCRIPTION))
        }

    def troubles(self) -> list[Diagnostic]:
        """Return what was wrong with the messages."""
        said = [
            MESSAGES_UNREADABLE(messages=count, topic=topic)
            for topic, count in self._broken.items()
        ]
        if self._set_back is not None:
            at, back, _ = self._set_back
            then = "even" if self._even else "piled"
            said.append(CLOCK_SET_BACK(time=at, by=back, then=then))
        return said

    def take(self, message: Message) -> None:
        """Take a message; one that cannot be read is counted."""
        try:
            self._take(message)
        except BadInput:
            self._broken[message.topic] = self._broken.get(message.topic, 0) + 1

    def _take(self, message: Message) -> None:
        kind = self._bag.topics[message.topic].type
        time = (message.log_time_ns - self._bag.start_ns) / SECOND
        if kind in self._general:
            if kind != "mrlab_msgs/msg/SceneObjects" or time - self._seen >= OBJECT_INTERVAL:
                self._general[kind](time, self._decode(kind, message.data))
            return
        if message.topic.endswith(DESCRIPTION):
            name = message.topic.removesuffix(DESCRIPTION).strip("/")
            # The topic without a robot's name has all robots at once.
            if name:
                text = self._decode(kind, message.data).data
                self.descriptions[name] = without_frames(text, name)
            return
        if message.topic.endswith(FINGERS):
            return
        name = message.topic.rsplit("/", 1)[0].strip("/")
        if not name:  # joint states of no robot of the lab, in a bag of others
            return
        robot = self.report.robot(name)
        if kind in self._readers:
            self._readers[kind](time, robot, self._decode(kind, message.data))
            return
        robot.joint_states += 1
        if robot.joint_states % self.report.step == 0:
            state = self._decode(kind, message.data)
            stamp_ns, positions = _ns(state.header.stamp), np.asarray(state.position)
            robot.compare(time, stamp_ns, positions, self.courses)
            self.samples.setdefault(robot.name, Samples(list(state.name))).add(
                time, stamp_ns, self._bag.start_ns, positions
            )

    def _state(self, time: float, robot: RobotReport, state: Any) -> None:
        clock = PlaybackClock(_ns(state.clock.stamp), state.clock.position, state.clock.rate)
        stamp_ns = _ns(state.header.stamp)
        if self._set_back is not None:
            at, _, stamp_before_ns = self._set_back
            self._even |= time > at + SET_BACK / 10 and stamp_ns < stamp_before_ns
        elif robot.reported:
            before = robot.reported[-1]
            back = (before.stamp_ns - stamp_ns) / SECOND
            if back > SET_BACK:
                self._set_back = (time, back + time - before.time, before.stamp_ns)
        robot.add(
            ReportedState(
                stamp_ns,
                state.label,
                state.trajectory_id,
                clock,
                time,
                # Bags of earlier versions do not have these fields.
                getattr(state, "trajectory_version", 0),
                getattr(state, "duration", 0.0),
                getattr(state, "system", ""),
            )
        )
        robot.states.add(time, state.label, state.trajectory_id)
        said = _said(state, "message", INFO)
        if said is not None:
            robot.reasons.add(time, said)

    def _telemetry(self, time: float, robot: RobotReport, telemetry: Any) -> None:
        if telemetry.frames_sent:
            robot.deadline.add(time, telemetry.deadline_error)
        robot.frames_lost = max(robot.frames_lost, telemetry.frames_lost)

    def _collision(self, time: float, robot: RobotReport, collision: Any) -> None:
        if collision.colliding:
            contact = collision.contact
            other = f"{contact.other} {contact.other_link}".strip()
            place = (contact.point.x, contact.point.y, contact.point.z)
            robot.collisions.append(Contact(time, contact.link, other, contact.frame + 1, place))

    def _grasp(self, time: float, robot: RobotReport, grasp: Any) -> None:
        known = grasp.state < len(GRASP_STATES)
        label = GRASP_STATES[grasp.state] if known else str(grasp.state)
        robot.grasps.add(time, label, grasp.object)
        said = _said(grasp, "reason", WARNING)
        if said is not None:
            held = {"object": grasp.object} if grasp.object else {}
            whose = {"robot": robot.name, **held, **said.values}
            robot.remarks.add(time, replace(said, values=whose))
        if label == HOLDING and getattr(grasp, "friction_needed", None):
            robot.bear(grasp.object, grasp)

    def _targets(self, time: float, robot: RobotReport, targets: Any) -> None:
        self.targets.setdefault(robot.name, Targets()).add(
            time,
            tuple(Target(each.time, each.close, _pose(each.tool0)) for each in targets.targets),
        )

    def _objects(self, time: float, objects: Any) -> None:
        self._seen = time
        for thing in objects.objects:
            in_tool = getattr(thing, "in_tool", None) if thing.held_by else None
            with contextlib.suppress(BadInput):  # a pose that is none
                held = None if in_tool is None else _pose(in_tool)
                place = Placed(_pose(thing.pose), thing.held_by, held)
                self.objects.setdefault(thing.name, ObjectTrack()).add(time, place)

    def _robots(self, time: float, robots: Any) -> None:
        for entry in robots.robots:
            robot = self.report.robot(entry.name)
            robot.model = entry.model
            robot.bases.append((time, _pose(entry.pose)))

    def _systems(self, time: float, systems: Any) -> None:
        for system in systems.systems:
            changes = self.report.systems
            if system.name not in changes:
                changes[system.name] = Changes()
            changes[system.name].add(time, system.label, said=_said(system, "message", INFO))

    def _contacts(self, time: float, contacts: Any) -> None:
        for contact in contacts.contacts:
            self.report.robot(contact.robot).contacts.append(time)

    def _mark(self, time: float, mark: Any) -> None:
        place = (mark.point.x, mark.point.y, mark.point.z)
        self.report.marks.append(Event(time, "", 0, LOOKED_HERE(name=mark.name), place))

    def _latency(self, time: float, latency: Any) -> None:
        for hop in latency.hops:
            ends = HOPS[hop.hop] if hop.hop < len(HOPS) else str(hop.hop)
            name = Hop(ends, "" if latency.observer == "bridge" else latency.observer)
            owner = hop.topic.strip("/").split("/")[0]
            if not hop.topic:
                series = self.report.latency
            elif owner in self.report.robots:
                series = self.report.robots[owner].latency
            else:
                continue
            if hop.topic.endswith("/joint_states") or not hop.topic:
                series.setdefault(name, Series()).add(time, hop.p50)


def _missing(bag: Bag, report: SessionReport) -> list[Diagnostic]:
    """Return what a bag has in place of a session of a lab; nothing where it has robots."""
    if not bag.message_count:
        return [NOTHING_RECORDED()]
    if report.robots:
        return []
    topics = sorted(bag.topics.values(), key=lambda topic: topic.name)
    return [
        BAG_WITHOUT_ROBOTS(
            topics=[topic.name for topic in topics[:NAMED]],
            types=[topic.type for topic in topics[:NAMED]],
            more=max(len(topics) - NAMED, 0) or None,
            fixes=importing(bag.path) if any(topic.type == JOINTS for topic in topics) else (),
        )
    ]


def _condition(bag: Bag) -> list[Diagnostic]:
    return [BAG_LIVE(fixes=ENDING)] if bag.live else bag.troubles


def _said(message: Any, text: str, severity: Severity) -> Diagnostic | None:
    """Return what a message of a bag says in its field `text`; None: nothing.

    Bags of earlier versions do not have the fields of its code, or of the text.
    """
    said = str(getattr(message, text, ""))
    if not said:
        return None
    values = {each.key: each.value for each in getattr(message, "values", ())}
    return Diagnostic(getattr(message, "code", ""), severity, said, values=values)


def _pose(pose: Any) -> Pose:
    p, q = pose.position, pose.orientation
    return Pose(
        (float(p.x), float(p.y), float(p.z)), (float(q.x), float(q.y), float(q.z), float(q.w))
    )


def _ns(stamp: Any) -> int:
    return int(stamp.sec) * SECOND + int(stamp.nanosec)


def _course(data: bytes) -> ReferenceTrajectory:
    """Read what the comparison needs of a trajectory file: angles there are in degrees."""
    document = orjson.loads(data)
    positions = np.radians(np.array(document["frames"]["q"], dtype=np.float64))
    return ReferenceTrajectory(float(document["frame_rate"]), positions)
