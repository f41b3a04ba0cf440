"""Makes a bag of this lab of any ROS 2 bag: sqlite3 or MCAP, compressed or not, of any recorder.

Messages keep their bytes and the definitions that their bag has. Where joint states are those of
a robot of the library, that robot is added: in the scene, with its description and its joints.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
from rosbags.rosbag2 import Reader
from rosbags.typesys import Stores, get_types_from_msg, get_typestore
from rosbags.typesys.store import Typestore

from mrlab_ros.adapters.bags.diagnostics import (
    BAG_IMPORTED,
    JOINTS_MOVE,
    MOVES_NO_ROBOT,
    NOT_CDR,
    TYPE_UNKNOWN,
)
from mrlab_ros.adapters.bags.other import (
    definition_of,
    merged,
    opened,
    plain_file,
    readable,
    sources_of,
    topic_of,
)
from mrlab_ros.adapters.bags.writer import BagWriter
from mrlab_ros.adapters.robots import urdf
from mrlab_ros.adapters.robots.library import RobotLibrary
from mrlab_ros.core.base.clock import SECOND
from mrlab_ros.core.base.diagnostic import Diagnostic, Fix
from mrlab_ros.core.base.errors import BadInput, Misuse
from mrlab_ros.core.conversion.evidence.headings import prefixes
from mrlab_ros.core.recording.diagnostics import (
    JOINTS_OF_TOPIC,
    LEFT_OUT,
    NO_SUCH_JOINTS,
    NOTHING_TO_REPLAY,
    SEVERAL_MODELS,
)
from mrlab_ros.core.recording.metadata import QosProfile, Topic

JOINTS, ROBOTS, TEXT = "sensor_msgs/msg/JointState", "mrlab_msgs/msg/Robots", "std_msgs/msg/String"
MESH = re.compile(r"package://(.+)")
# Joint states in which the names of a topic's joints are looked for.
LOOKED_AT = 200
# m between robots that a bag does not place.
APART = 1.5


@dataclass
class Imported:
    """The outcome for a bag.

    robots: model by name; skipped: why, by topic; strange: names of joints that no robot of the
    library has, by topic.
    """

    folder: Path
    messages: int = 0
    robots: dict[str, str] = field(default_factory=dict)
    skipped: dict[str, Diagnostic] = field(default_factory=dict)
    strange: dict[str, list[str]] = field(default_factory=dict)

    def said(self, name: str) -> Diagnostic:
        """Return what is said of it; name: of the bag."""
        notes = [JOINTS_MOVE(robot=name, model=model) for name, model in self.robots.items()]
        adding = (Fix(command="mrlab robots import URDF"),)
        notes += [
            MOVES_NO_ROBOT(topic=topic, joints=joints, fixes=adding)
            for topic, joints in self.strange.items()
        ]
        notes += [LEFT_OUT(topic=topic, why=why) for topic, why in self.skipped.items()]
        return BAG_IMPORTED(bag=name, messages=self.messages, notes=notes)


def import_bag(
    source: Path,
    folder: Path,
    asked: Sequence[str],
    library: RobotLibrary,
    definition: Callable[[str], str],
) -> Imported:
    """Write the bag `source` to the new folder `folder` as this lab records bags.

    asked: models whose joints the bag holds; empty: found by the names. definition: returns the
    text of an installed type. Raises BadInput where it is no ROS 2 bag, or has not those joints.
    """
    with (
        readable(source),
        plain_file(source) as plain,
        opened(sources_of(plain)) as readers,
    ):
        return _Import(readers, source, asked, library, definition).write(folder)


class _Import:
    def __init__(
        self,
        readers: list[Reader],
        source: Path,
        asked: Sequence[str],
        library: RobotLibrary,
        definition: Callable[[str], str],
    ) -> None:
        self._readers = readers
        self._source = source
        self._library = library
        self._installed = definition
        self._texts: dict[str, str] = {}
        self._skipped: dict[str, Diagnostic] = {}
        known = get_typestore(Stores.ROS2_JAZZY)
        connections = [connection for reader in readers for connection in reader.connections]
        for connection in connections:
            why = self._take_text(connection, known)
            if why is not None:
                self._skipped[connection.topic] = why
        self._kept = [c for c in connections if c.topic not in self._skipped]
        if not self._kept:
            left_out = [LEFT_OUT(topic=topic, why=why) for topic, why in self._skipped.items()]
            raise BadInput(NOTHING_TO_REPLAY(path=str(source), left_out=left_out))
        self._types = get_typestore(Stores.EMPTY)
        for kind in {ROBOTS, TEXT, JOINTS, *(c.msgtype for c in self._kept)}:
            self._register(kind)
        self._models = self._chosen(asked)
        self._state: dict[str, dict[str, float]] = {topic: {} for topic in self._models}

    def write(self, folder: Path) -> Imported:
        writer = BagWriter(folder, self._text)
        done = Imported(folder, skipped=self._skipped)
        done.strange = {
            topic: names for topic, names in self._joint_names.items() if topic not in self._models
        }
        names = self._names()
        try:
            for connection in self._kept:
                writer.add_topic(topic_of(connection))
            for topic, name in names.items():
                done.robots[name] = self._models[topic]
            if names:
                self._add_scene(writer, done.robots)
            for connection, time_ns, data in self._messages({c.topic for c in self._kept}):
                name = names.get(connection.topic, "")
                # A topic of the same name as the robot's would be written twice.
                if f"/{name}/joint_states" != connection.topic:
                    writer.write(connection.topic, time_ns, data, time_ns)
                if name:
                    moved = self._mapped(connection.topic, data, time_ns)
                    if moved is not None:
                        writer.write(f"/{name}/joint_states", time_ns, moved, time_ns)
            writer.note("mrlab", {"imported_from": str(self._source)})
        finally:
            writer.close()
        done.messages = sum(part.messages for part in writer.facts.parts)
        return done

    def _messages(self, topics: Collection[str]) -> Iterator[tuple[Any, int, bytes]]:
        return merged(self._readers, topics)

    # types ----------------------------------------------------------------------------------

    def _take_text(self, connection: Any, known: Typestore) -> Diagnostic | None:
        """Keep the definition of a topic's type, the bag's own first; return why there is none."""
        kind = connection.msgtype
        if connection.ext.serialization_format not in ("", "cdr"):
            return NOT_CDR(format=connection.ext.serialization_format)
        if kind in self._texts:
            return None
        text = definition_of(connection, self._installed, known)
        if text is None:
            return TYPE_UNKNOWN(type=kind)
        self._texts[kind] = text
        return None

    def _text(self, kind: str) -> str:
        if kind not in self._texts:
            self._texts[kind] = self._installed(kind)
        return self._texts[kind]

    def _register(self, kind: str) -> None:
        if kind in self._types.fielddefs:
            return
        entries = get_types_from_msg(self._text(kind), kind)
        self._types.register(
            {name: e for name, e in entries.items() if name not in self._types.fielddefs}
        )

    # robots ---------------------------------------------------------------------------------

    def _chosen(self, asked: Sequence[str]) -> dict[str, str]:
        """Return the model of each topic of joint states; none in a bag of a lab."""
        self._joint_names: dict[str, list[str]] = {}
        if any(connection.msgtype == ROBOTS for connection in self._kept) and not asked:
            return {}
        models = {
            model: self._library.model(model).joint_names
            for model in (asked or self._library.ids())
        }
        topics: dict[str, dict[str, None]] = {}
        wanted = [c for c in self._kept if c.msgtype == JOINTS]
        for connection in wanted:
            names = topics.setdefault(connection.topic, {})
            for number, (_, _, data) in enumerate(self._messages({connection.topic})):
                if number >= LOOKED_AT:
                    break
                state: Any = self._types.deserialize_cdr(data, JOINTS)
                names |= dict.fromkeys(state.name)
        self._joint_names = {topic: list(names) for topic, names in topics.items()}
        return chosen_models(asked, models, self._joint_names)

    def _names(self) -> dict[str, str]:
        """Return a robot's name for each topic whose joints are mapped."""
        counts: dict[str, int] = {}
        found = {}
        for topic, model in self._models.items():
            counts[model] = counts.get(model, 0) + 1
            found[topic] = f"{model}_{counts[model]}"
        return found

    def _mapped(self, topic: str, data: bytes, time_ns: int) -> bytes | None:
        """Return a joint state of the robot alone; None until every joint was reported."""
        state: Any = self._types.deserialize_cdr(data, JOINTS)
        known = self._state[topic]
        known.update(zip(state.name, map(float, state.position), strict=False))
        joints = self._library.model(self._models[topic]).joint_names
        columns = columns_of(joints, list(known))
        if columns is None:
            return None
        values = np.array(list(known.values()))[columns]
        stamp = state.header.stamp
        if not stamp.sec and not stamp.nanosec:
            stamp = self._make("builtin_interfaces/msg/Time", *divmod(time_ns, SECOND))
        header = self._make("std_msgs/msg/Header", stamp, state.header.frame_id)
        empty = np.zeros(0)
        moved = self._make(JOINTS, header, list(joints), values, empty, empty)
        return bytes(self._types.serialize_cdr(moved, JOINTS))

    def _add_scene(self, writer: BagWriter, robots: dict[str, str]) -> None:
        """Write the robots, their descriptions, meshes and topics."""
        latched = (QosProfile(durability="transient_local", history="keep_last", depth=1),)
        start_ns = min(r.start_time for r in self._readers if r.message_count)
        writer.add_topic(Topic("/robots", ROBOTS, latched))
        entries = []
        meshes: set[str] = set()
        for number, (name, model) in enumerate(robots.items()):
            description = self._library.description(model)
            writer.add_topic(Topic(f"/{name}/joint_states", JOINTS, (QosProfile(),)))
            writer.add_topic(Topic(f"/{name}/robot_description", TEXT, latched))
            said = self._types.serialize_cdr(self._make(TEXT, description), TEXT)
            writer.write(f"/{name}/robot_description", start_ns, bytes(said), start_ns)
            writer.attach(f"robots/{name}.urdf", "model/urdf+xml", description.encode(), start_ns)
            meshes |= {
                str(mesh.get("filename")) for mesh in urdf.parse(description, name).iter("mesh")
            }
            pose = self._make(
                "geometry_msgs/msg/Pose",
                self._make("geometry_msgs/msg/Point", 0.0, APART * number, 0.0),
                self._make("geometry_msgs/msg/Quaternion", 0.0, 0.0, 0.0, 1.0),
            )
            joints = list(self._library.model(model).joint_names)
            entries.append(self._make("mrlab_msgs/msg/Robot", name, model, "", pose, joints))
        stamp = self._make("builtin_interfaces/msg/Time", *divmod(start_ns, SECOND))
        header = self._make("std_msgs/msg/Header", stamp, "world")
        scene = self._make(ROBOTS, header, entries, "")
        writer.write(
            "/robots", start_ns, bytes(self._types.serialize_cdr(scene, ROBOTS)), start_ns
        )
        for uri in sorted(meshes):
            match = MESH.fullmatch(uri)
            if match is not None:
                content = self._library.mesh_path(uri).read_bytes()
                writer.attach(f"meshes/{match[1]}", "model/gltf-binary", content, start_ns)

    def _make(self, kind: str, *values: Any) -> Any:
        return self._types.types[kind](*values)


def columns_of(joints: Sequence[str], names: Sequence[str]) -> list[int] | None:
    """Return where each joint of a robot stands among `names`, None where one is missing.

    A name may have a prefix, such as left_elbow_joint or cell/elbow_joint, that is the same for
    all joints.
    """
    for prefix in prefixes(joints, names):
        return [names.index(prefix + joint) for joint in joints]
    return None


def chosen_models(
    asked: Sequence[str],
    models: Mapping[str, Sequence[str]],
    topics: Mapping[str, Sequence[str]],
) -> dict[str, str]:
    """Return the model of each topic whose joints are a robot's.

    asked: models that the person named; empty: found by the names. models: joints of each model;
    topics: joint names of each topic. Raises BadInput where an asked robot has no joints there,
    Misuse where the names fit several robots and none was named.
    """
    if asked:
        return _of_asked(asked, models, topics)
    found = {}
    for topic, names in topics.items():
        fitting = [model for model in models if columns_of(models[model], names) is not None]
        # An arm of seven joints fits one of six whose names are among them.
        most = max((len(models[model]) for model in fitting), default=0)
        fitting = [model for model in fitting if len(models[model]) == most]
        if len(fitting) > 1:
            fix = Fix(option="robot", value=fitting[0])
            raise Misuse(SEVERAL_MODELS(topic=topic, models=fitting, fixes=(fix,)))
        if fitting:
            found[topic] = fitting[0]
    return found


def _of_asked(
    asked: Sequence[str],
    models: Mapping[str, Sequence[str]],
    topics: Mapping[str, Sequence[str]],
) -> dict[str, str]:
    found: dict[str, str] = {}
    for model in asked:
        free = [
            topic
            for topic, names in topics.items()
            if topic not in found and columns_of(models[model], names) is not None
        ]
        if not free:
            there = [JOINTS_OF_TOPIC(topic=topic, joints=names) for topic, names in topics.items()]
            raise BadInput(NO_SUCH_JOINTS(model=model, joints=models[model], found=there))
        found[free[0]] = model
    return found
