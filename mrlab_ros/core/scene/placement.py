"""Chooses a place for a robot: level surfaces of the room, free space there, viewers.

Everything is in the frame `world`, lengths in m, angles in rad.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field

import numpy as np

from mrlab_ros.core.base.errors import BadInput, Misuse
from mrlab_ros.core.base.geometry import Array, Pose, rotate
from mrlab_ros.core.base.names import close_to
from mrlab_ros.core.scene.diagnostics import (
    NO_LEVEL_SURFACE,
    NO_PLACE_BEFORE_VIEWER,
    NO_PLACE_ON_SURFACE,
)

FLOOR = "floor"
# A plane is level where its normal is this near to the vertical: the cosine of 10 degrees.
LEVEL = 0.985
# Of a robot's base, with room for its screws.
BASE_RADIUS = 0.12
# Robots placed automatically stand this share of their reaches apart, so that two arms can meet
# but not stand in each other.
SPACING = 0.75
# Two bases on one surface that is no floor: arms there may meet, but not stand in each other.
BESIDE = 0.45
# The part of its reach that a robot's base takes beside objects, and that its arm may
# take at home: over objects that are lower than the base's share of the reach it passes.
BASE_SHARE, HOME_SHARE = 0.2, 0.6
# An object that reaches so little above a surface, m, is not in the way there.
FLAT = 0.002
# Surfaces so much above a place are above the robot's base, not in it.
HEADROOM = 0.05
# Candidates lie on rings about the viewer.
NEAREST, FARTHEST, RING = 0.45, 3.0, 0.12
SECTOR, STEP = math.radians(60.0), math.radians(6.0)
# How far before a viewer a robot stands well: a part of its reach, and this.
READY = 0.7
# An orientation whose x points this steeply says nothing about what is in front.
STEEP = 0.98
# Labels of surfaces that nothing stands on.
NEVER = frozenset({"ceiling", "wall", "door", "window"})


@dataclass(frozen=True)
class Support:
    """A level surface; outline: (V, 2) in world, empty where it has no end."""

    name: str
    height: float
    outline: Array = field(default_factory=lambda: np.zeros((0, 2)), compare=False)

    def holds(self, x: float, y: float, margin: float) -> bool:
        """Return whether a point is on it, `margin` or more from its edge."""
        if not len(self.outline):
            return True
        return self._inside(x, y) and self._from_edge(x, y) >= margin

    def covers(self, x: float, y: float, margin: float) -> bool:
        """Return whether a point is on it, or nearer than `margin` to it."""
        return not len(self.outline) or self._inside(x, y) or self._from_edge(x, y) < margin

    def _inside(self, x: float, y: float) -> bool:
        a, b = self.outline, np.roll(self.outline, 1, axis=0)
        crosses = (a[:, 1] > y) != (b[:, 1] > y)
        slope = (b[crosses, 0] - a[crosses, 0]) / (b[crosses, 1] - a[crosses, 1])
        at = slope * (y - a[crosses, 1]) + a[crosses, 0]
        return bool((x < at).sum() % 2)

    def _from_edge(self, x: float, y: float) -> float:
        a, edge = self.outline, np.roll(self.outline, -1, axis=0) - self.outline
        to = np.array([x, y]) - a
        length = np.maximum((edge**2).sum(axis=1), 1e-12)
        share = np.clip((to * edge).sum(axis=1) / length, 0.0, 1.0)
        return float(np.hypot(*(to - share[:, None] * edge).T).min())


ENDLESS_FLOOR = Support(FLOOR, 0.0)


def support_of(
    name: str, label: str, pose: Pose, vertices: Array, is_mesh: bool
) -> Support | None:
    """Return the level surface that a detected plane is; None where nothing stands on it.

    vertices: (V, 3) in the plane's frame, whose z is its normal. A plane may come with its normal
    downwards: gravity alone says what is level.
    """
    if is_mesh or label in NEVER or label == FLOOR or len(vertices) < 3:
        return None
    if abs(rotate(pose.orientation, (0.0, 0.0, 1.0))[2]) < LEVEL:
        return None
    world = np.array([rotate(pose.orientation, (v[0], v[1], v[2])) for v in vertices.tolist()])
    world += pose.position
    return Support(name, float(world[:, 2].mean()), world[:, :2])


@dataclass(frozen=True)
class Standing:
    """A robot that is there. reach: of its arm."""

    position: tuple[float, float, float]
    reach: float


@dataclass(frozen=True)
class Thing:
    """An object that is there. radius: of the upright cylinder around it; low, high: its ends."""

    x: float
    y: float
    radius: float
    low: float
    high: float

    @classmethod
    def of(cls, pose: Pose, size: tuple[float, float, float]) -> Thing:
        """Return an object by its pose and the edges of the box around it, in its own frame."""
        x, y, z = size
        edges = [
            rotate(pose.orientation, e) for e in ((x, 0.0, 0.0), (0.0, y, 0.0), (0.0, 0.0, z))
        ]
        across, deep, up = (sum(abs(edge[axis]) for edge in edges) / 2 for axis in range(3))
        px, py, pz = pose.position
        return cls(px, py, math.hypot(across, deep), pz - up, pz + up)

    def leaves(self, x: float, y: float, height: float, reach: float) -> bool:
        """Return whether a robot of this reach at a place touches it neither with its base nor
        with its arm at home; reach 0: only the base counts."""
        if self.high <= height + FLAT or self.low > height + 2 * max(reach, BASE_RADIUS):
            return True
        base = max(BASE_RADIUS, BASE_SHARE * reach)
        tall = reach and self.high > height + BASE_SHARE * reach
        needed = self.radius + (max(HOME_SHARE * reach, base) if tall else base)
        return math.hypot(x - self.x, y - self.y) >= needed


@dataclass(frozen=True)
class Viewer:
    """A standing person: the place of the eyes and the direction of their x."""

    position: tuple[float, float, float]
    ahead: tuple[float, float, float]

    @classmethod
    def of(cls, pose: Pose) -> Viewer:
        return cls(pose.position, rotate(pose.orientation, (1.0, 0.0, 0.0)))

    @property
    def heading(self) -> float:
        """About z; 0 where they look straight up or down."""
        x, y, z = self.ahead
        return 0.0 if abs(z) > STEEP else math.atan2(y, x)


def named_support(name: str, supports: Sequence[Support]) -> Support:
    """Return the surface called `name`, the floor where that is empty; raise BadInput."""
    wanted = name or FLOOR
    for support in (*supports, ENDLESS_FLOOR):
        if support.name == wanted:
            return support
    known = [support.name for support in (*supports, ENDLESS_FLOOR)]
    raise BadInput(NO_LEVEL_SURFACE(surface=name, known=known, close=close_to(name, known)))


def place_on(
    support: Support,
    supports: Sequence[Support],
    standing: Sequence[Standing],
    things: Sequence[Thing] = (),
) -> Pose:
    """Return the clear place on a surface that is nearest to its middle; raise Misuse."""
    middle = support.outline.mean(axis=0)
    reach = float(np.hypot(*(support.outline - middle).T).max())
    for radius in np.arange(0.0, reach, RING / 2).tolist():
        count = max(1, round(radius / 0.02))
        for angle in (math.tau * i / count for i in range(count)):
            x = float(middle[0]) + radius * math.cos(angle)
            y = float(middle[1]) + radius * math.sin(angle)
            if _is_clear(support, x, y, 0.0, supports, standing, things):
                return Pose((x, y, support.height))
    raise Misuse(NO_PLACE_ON_SURFACE(surface=support.name))


def place_before(
    viewer: Viewer,
    reach: float,
    supports: Sequence[Support],
    standing: Sequence[Standing],
    only: Support | None = None,
    things: Sequence[Thing] = (),
) -> Pose:
    """Return the best place before a viewer, facing them; raise Misuse where there is none.

    The nearest level surface in front wins: where they look, at arm's length and a bit, not far to
    the side. only: this surface alone.
    """
    wanted = READY + 0.5 * min(reach, 1.4)
    levels = [only] if only is not None else [*supports, ENDLESS_FLOOR]
    gaze = _gaze(viewer, levels)
    best: tuple[float, Pose] | None = None
    for support in levels:
        if support.height > viewer.position[2]:
            continue
        ideal = wanted if support.name == FLOOR else min(wanted, 1.0)
        for x, y, distance, bearing in _candidates(viewer, anywhere=only is not None):
            cost = abs(distance - ideal) + 0.6 * abs(bearing)
            if gaze is not None:
                cost += 0.5 * math.dist((x, y, support.height), gaze)
            if best is not None and cost >= best[0]:
                continue
            if _is_clear(support, x, y, reach, supports, standing, things):
                best = cost, _facing(x, y, support.height, viewer)
    if best is not None:
        return best[1]
    if only is not None:
        raise Misuse(NO_PLACE_ON_SURFACE(surface=only.name))
    raise Misuse(NO_PLACE_BEFORE_VIEWER(distance=FARTHEST))


def _candidates(viewer: Viewer, *, anywhere: bool) -> Iterator[tuple[float, float, float, float]]:
    """Yield x, y, distance and bearing from the viewer."""
    sector = math.pi if anywhere else SECTOR
    bearings = np.arange(-sector, sector + 1e-9, STEP)
    for distance in np.arange(NEAREST, FARTHEST + 1e-9, RING):
        for bearing in bearings:
            angle = viewer.heading + bearing
            x = viewer.position[0] + distance * math.cos(angle)
            y = viewer.position[1] + distance * math.sin(angle)
            yield float(x), float(y), float(distance), float(bearing)


def _gaze(viewer: Viewer, supports: Iterable[Support]) -> tuple[float, float, float] | None:
    """Return where the viewer looks at a surface; None where they do not look down."""
    x, y, z = viewer.position
    dx, dy, dz = viewer.ahead
    if dz > -0.15:
        return None
    found = None
    for support in sorted(supports, key=lambda s: -s.height):
        share = (support.height - z) / dz
        at = (x + share * dx, y + share * dy, support.height)
        if share > 0 and math.hypot(at[0] - x, at[1] - y) < FARTHEST and support.holds(*at[:2], 0):
            found = found or at
    return found


def _is_clear(
    support: Support,
    x: float,
    y: float,
    reach: float,
    supports: Iterable[Support],
    standing: Iterable[Standing],
    things: Iterable[Thing],
) -> bool:
    if not support.holds(x, y, BASE_RADIUS):
        return False
    for other in supports:
        above = other.height > support.height + HEADROOM
        if other is not support and above and other.covers(x, y, BASE_RADIUS):
            return False
    for robot in standing:
        apart = math.hypot(x - robot.position[0], y - robot.position[1])
        if abs(robot.position[2] - support.height) > 0.5:
            needed = BESIDE
        elif support.name == FLOOR and reach:
            needed = SPACING * (reach + robot.reach)
        else:
            needed = BESIDE
        if apart < needed:
            return False
    # On a table there is no room to keep the arm away from what stands there.
    free = reach if support.name == FLOOR else 0.0
    return all(thing.leaves(x, y, support.height, free) for thing in things)


def _facing(x: float, y: float, z: float, viewer: Viewer) -> Pose:
    """Return the upright pose whose x points at the viewer."""
    heading = math.atan2(viewer.position[1] - y, viewer.position[0] - x)
    return Pose((x, y, z), (0.0, 0.0, math.sin(heading / 2), math.cos(heading / 2)))
