"""The scene of the running lab, from the messages that it sends."""

from __future__ import annotations

import asyncio
import contextlib
from collections.abc import Callable, Mapping
from typing import Any

import numpy as np

from mrlab_ros.app.check.in_lab import LabScene
from mrlab_ros.core.base.errors import Unavailable
from mrlab_ros.core.base.geometry import Pose
from mrlab_ros.core.scene.document import ObjectEntry, RobotEntry, SceneDocument
from mrlab_ros.core.scene.surfaces import FLOOR, Surface
from mrlab_ros.gateway.checks.diagnostics import ROBOTS_NOT_KNOWN
from mrlab_ros.gateway.lab.connection import LabConnection, Sample
from mrlab_ros.gateway.lab.definitions import Definitions

# A robot that stands sends its joints twice a second, physics its objects once.
WAIT_S = 1.3
# A scene this old, s, serves another request.
FRESH_S = 1.0
ROBOTS, OBJECTS, SURFACES = (f"mrlab_msgs/msg/{n}" for n in ("Robots", "SceneObjects", "Surfaces"))
JOINTS = "sensor_msgs/msg/JointState"
JOINT_STATES = "*/joint_states"


class SceneWatch:
    """Reads the lab's scene when asked, and once for all who ask at the same time."""

    def __init__(
        self, lab: LabConnection, steady: Callable[[], float], wait: float = WAIT_S
    ) -> None:
        self._lab, self._steady, self._wait = lab, steady, wait
        self._lock = asyncio.Lock()
        self._known: LabScene | None = None
        self._read_at = 0.0

    async def now(self) -> LabScene:
        """Return the scene; raise Unavailable where the lab does not say which robots it has."""
        async with self._lock:
            if self._known is None or self._steady() - self._read_at > FRESH_S:
                self._known = await self._read()
                self._read_at = self._steady()
            return self._known

    async def _read(self) -> LabScene:
        lab = self._lab
        newest: dict[str, Sample] = {}
        complete = asyncio.Event()
        wanted: set[str] = set()

        def take(sample: Sample) -> None:
            newest[sample.key] = sample
            if wanted and wanted <= newest.keys():
                complete.set()

        undo = [lab.subscribe(key, take) for key in ("objects", JOINT_STATES)]
        try:
            robots = await lab.get("robots")
            surfaces = await lab.get("surfaces")
            if robots is None:
                raise Unavailable(ROBOTS_NOT_KNOWN())
            found = lab.definitions.decode(ROBOTS, robots.payload)
            wanted |= {f"{robot.name}/joint_states" for robot in found.robots}
            # without physics nothing says where objects are
            wanted |= {"objects"} & lab.keys.topics.keys()
            if not wanted <= newest.keys():
                # what does not say where it is stands at home, or is not there
                with contextlib.suppress(asyncio.TimeoutError):
                    await asyncio.wait_for(complete.wait(), self._wait)
        finally:
            for each in undo:
                each()
        return scene_of(lab.definitions, robots, surfaces, newest)


def scene_of(
    definitions: Definitions,
    robots: Sample,
    surfaces: Sample | None,
    newest: Mapping[str, Sample],
) -> LabScene:
    """Return the scene that messages describe. newest: of objects and joint states, by key."""
    entries, stands = [], {}
    for robot in definitions.decode(ROBOTS, robots.payload).robots:
        entries.append(RobotEntry(robot.name, robot.model, robot.end_effector, _pose(robot.pose)))
        sample = newest.get(f"{robot.name}/joint_states")
        if sample is not None:
            state = definitions.decode(JOINTS, sample.payload)
            at = dict(zip(state.name, state.position.tolist(), strict=False))
            if all(name in at for name in robot.joint_names):
                stands[robot.name] = tuple(at[name] for name in robot.joint_names)
    objects, in_tool = [], {}
    names = {entry.name for entry in entries}
    if "objects" in newest:
        for thing in definitions.decode(OBJECTS, newest["objects"].payload).objects:
            # a hand of a person is none of the robots
            holder = thing.held_by if thing.held_by in names else ""
            pose = _pose(thing.pose)
            objects.append(ObjectEntry(thing.name, thing.type, pose, held_by=holder))
            if holder:
                in_tool[thing.name] = _pose(thing.in_tool)
    planes: tuple[Surface, ...] = ()
    if surfaces is not None:
        found = definitions.decode(SURFACES, surfaces.payload).surfaces
        planes = tuple(_surface(each) for each in found)
    # a world has the endless floor anyway
    planes = tuple(s for s in planes if not (s.name == FLOOR and s.endless))
    document = SceneDocument(tuple(entries), tuple(objects), planes)
    return LabScene(document, stands, in_tool)


def _surface(message: Any) -> Surface:
    vertices = np.array([(v.x, v.y, v.z) for v in message.vertices], dtype=np.float64)
    return Surface(
        message.name,
        message.label,
        _pose(message.pose),
        vertices.reshape(-1, 3),
        np.array(message.triangles, dtype=np.int32).reshape(-1, 3),
        message.source,
    )


def _pose(message: Any) -> Pose:
    p, q = message.position, message.orientation
    return Pose((p.x, p.y, p.z), (q.x, q.y, q.z, q.w))
