"""The record of a rehearsal in physics: contacts, distances, grasps, and places over time."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

from mrlab_ros.core.base.diagnostic import Diagnostic
from mrlab_ros.core.base.geometry import Vector
from mrlab_ros.core.physics.engine import Kind, Near
from mrlab_ros.core.physics.grasp.load import Load
from mrlab_ros.core.physics.grasp.states import Grasp
from mrlab_ros.core.scene.surfaces import Surface

Other = tuple[Kind, str]


@dataclass
class Collision:
    """A contact that halts a robot. time: s from the start of the motion; end: when it was clear
    again, None: not before the end. held: what the robot held and touched with."""

    time: float
    robot: str
    link: str
    kind: Kind
    other: str
    other_link: str
    point: Vector
    depth: float
    held: str = ""
    end: float | None = None


@dataclass(frozen=True)
class GraspChange:
    """A change of a gripper at a time, s. reason: why, None: no remark."""

    time: float
    robot: str
    state: Grasp
    object: str
    reason: Diagnostic | None = None
    load: Load | None = None


@dataclass
class Drop:
    """An object that a gripper let go, and how far it fell then, m. time: s."""

    time: float
    robot: str
    object: str
    height: float = 0.0


@dataclass
class Distances:
    """How far a robot is from something over time, m; one a sample, the farthest that is looked
    for where it is farther. links: of the robot, at each sample; empty: farther. arm: where the
    links alone are nearest, at samples at which something held is nearer; None: farther."""

    values: list[float] = field(default_factory=list)
    links: list[str] = field(default_factory=list)
    other_links: list[str] = field(default_factory=list)
    held: list[str] = field(default_factory=list)
    arm: dict[int, Near | None] = field(default_factory=dict)

    def add(self, near: Near) -> None:
        self.values.append(near.distance)
        self.links.append(near.link)
        self.other_links.append(near.other_link)
        self.held.append(near.held)

    def add_far(self, count: int, farthest: float) -> None:
        """Add samples at which it was farther than is looked for."""
        self.values += [farthest] * count
        for names in (self.links, self.other_links, self.held):
            names += [""] * count

    def without(self, held: str, farthest: float) -> Distances:
        """Return them of the links alone where `held` is nearer than these."""
        if held not in self.held or not held:
            return self
        found = Distances()
        for at, value in enumerate(self.values):
            near: Near | None = Near(value, self.links[at], self.held[at], self.other_links[at])
            if self.held[at] == held:
                near = self.arm.get(at)
            if near is None:
                found.add_far(1, farthest)
            else:
                found.add(near)
        return found

    def least(self) -> int:
        """Return the index of the least distance."""
        return min(range(len(self.values)), key=self.values.__getitem__)


@dataclass
class Course:
    """Places of one thing over time. values: of a robot its joints, then its fingers, rad or m; of
    an object x, y, z, qx, qy, qz, qw in world. holders: since when which robot holds it."""

    times: list[float] = field(default_factory=list)
    values: list[list[float]] = field(default_factory=list)
    holders: list[tuple[float, str]] = field(default_factory=list)

    def add(self, time: float, values: list[float]) -> None:
        self.times.append(time)
        self.values.append(values)


@dataclass
class Rehearsed:
    """The whole recording. Times are s from the start of the motion.

    times: of the distances. distances: by robot and by what it is far from. begins_inside: of
    each robot, the surfaces in which it stood at the first frame. starts, ends: of each robot,
    when it left its first frame and reached its last one. waited: of each robot, s in all.
    stuck: the wait that held a robot for ever. gone: what left the room, and when. states: of each
    robot's playback, since when. surfaces: of the room.
    """

    duration: float = 0.0
    times: list[float] = field(default_factory=list)
    distances: dict[tuple[str, Other], Distances] = field(default_factory=dict)
    collisions: list[Collision] = field(default_factory=list)
    grasps: list[GraspChange] = field(default_factory=list)
    drops: list[Drop] = field(default_factory=list)
    begins_inside: dict[str, Sequence[str]] = field(default_factory=dict)
    starts: dict[str, float] = field(default_factory=dict)
    ends: dict[str, float] = field(default_factory=dict)
    waited: dict[str, float] = field(default_factory=dict)
    stuck: dict[str, str] = field(default_factory=dict)
    gone: list[tuple[float, str]] = field(default_factory=list)
    states: dict[str, list[tuple[float, str]]] = field(default_factory=dict)
    robots: dict[str, Course] = field(default_factory=dict)
    objects: dict[str, Course] = field(default_factory=dict)
    surfaces: tuple[Surface, ...] = field(default=(), compare=False)

    def of(self, robot: str) -> list[Collision]:
        """Return the collisions of one robot."""
        return [one for one in self.collisions if one.robot == robot]
