"""Reads from a bag all that a picture of the session needs: URDFs, joints, objects, meshes."""

from __future__ import annotations

import re
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from mrlab_ros.adapters.bags.diagnostics import BAD_MESH_ADDRESS
from mrlab_ros.adapters.bags.reader import Bag
from mrlab_ros.adapters.bags.session import Decoder
from mrlab_ros.core.base.clock import SECOND
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.recording.recorded_motion import RecordedMotion, RecordedObject, RecordedRobot
from mrlab_ros.core.recording.run_finding import time_of
from mrlab_ros.core.robots.frames import without_frames

TYPES = {
    "sensor_msgs/msg/JointState",
    "mrlab_msgs/msg/Robots",
    "mrlab_msgs/msg/SceneObjects",
    "std_msgs/msg/String",
}
# s; what physics sends sixty times a second is drawn thirty times
OBJECT_INTERVAL = 1 / 30
PACKAGE = "package://"
OWN = "package://mrlab_ros/"
# Of one robot; /robot_description has all of them.
DESCRIPTION = re.compile(r"/.+/robot_description")


def read_motion(bag: Bag) -> RecordedMotion:
    """Return what moved in the session that `bag` recorded."""
    decode = Decoder(bag.definitions())
    found = RecordedMotion()
    topics = {
        topic.name
        for topic in bag.topics.values()
        if topic.type in TYPES
        and (topic.type != "std_msgs/msg/String" or DESCRIPTION.fullmatch(topic.name))
    }
    before = -1.0
    for message in bag.messages(topics=topics):
        kind = bag.topics[message.topic].type
        time = (message.log_time_ns - bag.start_ns) / SECOND
        if kind == "mrlab_msgs/msg/SceneObjects":
            if time - before < OBJECT_INTERVAL:
                continue
            before = time
        try:
            data = decode(kind, message.data)
        except BadInput:  # the report counts it
            continue
        if kind == "mrlab_msgs/msg/Robots":
            found.scene(time, {entry.name for entry in data.robots})
            for entry in data.robots:
                robot = found.robot(entry.name)
                robot.model, robot.end_effector = entry.model, entry.end_effector
                robot.base.add(time, _pose(entry.pose))
        elif kind == "mrlab_msgs/msg/SceneObjects":
            for thing in data.objects:
                _take_object(found, time, thing)
        else:
            name = message.topic.rsplit("/", 1)[0].strip("/")
            robot = found.robot(name)
            if kind == "std_msgs/msg/String":
                robot.urdf = without_frames(data.data, name)
            else:
                stamp = data.header.stamp
                stamp_ns = stamp.sec * SECOND + stamp.nanosec
                last = robot.track.times[-1] if robot.track.times else 0.0
                shown = time_of(time, (stamp_ns - bag.start_ns) / SECOND, last)
                _take_joints(robot, shown, data)
    return found


def _take_joints(robot: RecordedRobot, time: float, state: Any) -> None:
    for name in state.name:
        if name not in robot.joints:
            robot.joints.append(name)
            for earlier in robot.track.values:
                earlier.append(0.0)
    values = list(robot.track.values[-1]) if robot.track.values else [0.0] * len(robot.joints)
    for name, value in zip(state.name, state.position, strict=False):
        values[robot.joints.index(name)] = float(value)
    robot.track.add(time, values)


def _take_object(found: RecordedMotion, time: float, thing: Any) -> None:
    known = found.objects.get(thing.name)
    if known is None:
        shape = {
            "mesh": thing.mesh,
            "size": _fields(thing.size, "xyz"),
            "color": _fields(thing.color, "rgba"),
            "primitive": _primitive(thing),
        }
        known = found.objects[thing.name] = RecordedObject(shape, time, time)
    known.last = time
    known.track.add(time, _pose(thing.pose))
    if not known.holders or known.holders[-1][1] != thing.held_by:
        known.holders.append((time, thing.held_by))


def _primitive(thing: Any) -> dict[str, Any]:
    """Return the primitive; a bag of an earlier lab has none."""
    shape = getattr(thing, "primitive", None)
    if shape is None:
        return {"type": 0, "dimensions": []}
    return {"type": int(shape.type), "dimensions": [float(v) for v in shape.dimensions]}


def _fields(message: Any, names: str) -> dict[str, float]:
    return {name: float(getattr(message, name)) for name in names}


def _pose(pose: Any) -> list[float]:
    p, q = pose.position, pose.orientation
    return [p.x, p.y, p.z, q.x, q.y, q.z, q.w]


@contextmanager
def mesh_files(bag: Bag, share: Path) -> Iterator[Any]:
    """Yield what returns the file of a mesh URI: the bag carries its meshes as attachments.

    share: this package's folder, for bags of earlier versions, which lack the meshes of objects.
    """
    attached = {name for file in bag.files for name in file.attachments}
    share = share.resolve()
    with tempfile.TemporaryDirectory() as folder:

        def resolve(uri: str) -> Path:
            name = f"meshes/{uri.removeprefix(PACKAGE)}"
            if not uri.startswith(PACKAGE):
                raise BadInput(BAD_MESH_ADDRESS(uri=uri, expected=PACKAGE))
            own = (share / uri.removeprefix(OWN)).resolve()
            if uri.startswith(OWN) and name not in attached and own.is_relative_to(share):
                return own
            path = Path(folder) / f"{len(list(Path(folder).iterdir()))}{Path(uri).suffix}"
            path.write_bytes(bag.attachment(name).data)
            return path

        yield resolve
