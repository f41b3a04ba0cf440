"""The robots in the scene: their names, places and end effectors."""

from __future__ import annotations

import itertools
import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cache

from mrlab_ros.core.base.diagnostics import NO_ROBOT_IN_SCENE
from mrlab_ros.core.base.errors import Misuse
from mrlab_ros.core.base.geometry import WORLD_SIZE, Pose, checked_vector
from mrlab_ros.core.base.names import checked_name, close_to
from mrlab_ros.core.scene.carrier import Carrier, carrier
from mrlab_ros.core.scene.diagnostics import NO_PLACE_ON_FLOOR
from mrlab_ros.core.scene.placement import (
    FLOOR,
    SPACING,
    Standing,
    Support,
    Thing,
    Viewer,
    named_support,
    place_before,
    place_on,
)

GRID = 0.25
GRID_RADIUS = 80


@cache
def _cells() -> tuple[tuple[float, float], ...]:
    """Return the places of the floor's grid, m, nearest to the origin first."""
    steps = range(-GRID_RADIUS, GRID_RADIUS + 1)
    # To the left of the origin before the right, and beside it before behind it.
    cells = sorted(itertools.product(steps, steps), key=lambda c: (math.hypot(*c), c[0], -c[1]))
    return tuple((i * GRID, j * GRID) for i, j in cells)


@dataclass(frozen=True)
class PlacedRobot:
    """A robot of the scene; end_effector is None for a bare flange. reach: m."""

    name: str
    model: str
    end_effector: str | None
    pose: Pose
    reach: float
    joint_names: tuple[str, ...]


class Scene:
    """The set of robots, in order of arrival; every change is checked before it is made."""

    def __init__(self) -> None:
        self._robots: dict[str, PlacedRobot] = {}
        self._carriers: dict[str, Carrier | None] = {}

    @property
    def robots(self) -> tuple[PlacedRobot, ...]:
        return tuple(self._robots.values())

    def robot(self, name: str) -> PlacedRobot:
        """Return the robot called `name`; raise Misuse where there is none."""
        try:
            return self._robots[name]
        except KeyError:
            close = close_to(name, self._robots)
            raise Misuse(
                NO_ROBOT_IN_SCENE(robot=name, known=[*self._robots], close=close)
            ) from None

    def free_name(self, model: str) -> str:
        """Return the model's id with the first free number: ur5e_1, ur5e_2, ..."""
        return next(
            name
            for number in itertools.count(1)
            if (name := f"{model}_{number}") not in self._robots
        )

    def free_pose(self, reach: float, things: Sequence[Thing] = ()) -> Pose:
        """Return the place nearest to the origin on the floor that keeps clear of all robots, and
        of these objects."""
        for x, y in _cells():
            if all(
                math.hypot(x - r.pose.position[0], y - r.pose.position[1])
                >= SPACING * (reach + r.reach)
                for r in self._robots.values()
            ) and all(thing.leaves(x, y, 0.0, reach) for thing in things):
                return Pose((x, y, 0.0))
        raise Misuse(NO_PLACE_ON_FLOOR(distance=GRID_RADIUS * GRID))

    def free_pose_on(
        self,
        reach: float,
        surface: str,
        viewer: Pose | None,
        supports: Sequence[Support],
        things: Sequence[Thing] = (),
    ) -> Pose:
        """Return a clear pose on a level surface of the room, facing the viewer if one is given.

        surface: its name; empty: the best one in front of the viewer, or the floor without one.
        Raises BadInput for an unknown surface, Misuse where there is no room.
        """
        standing = [Standing(robot.pose.position, robot.reach) for robot in self._robots.values()]
        if viewer is not None:
            only = named_support(surface, supports) if surface else None
            return place_before(Viewer.of(viewer), reach, supports, standing, only, things)
        support = named_support(surface, supports)
        if support.name == FLOOR:
            return self.free_pose(reach, things)
        return place_on(support, supports, standing, things)

    def spawn(self, robot: PlacedRobot) -> PlacedRobot:
        """Add `robot`; raise BadInput where its name or its position cannot be used."""
        checked_vector(robot.pose.position, "position", WORLD_SIZE)
        checked_name(robot.name, frozenset(self._robots), "robot")
        self._robots[robot.name] = robot
        return robot

    def place(self, name: str, pose: Pose, hand: str = "") -> PlacedRobot:
        """Set the pose of a robot; raise BadInput where it is outside the room.

        hand: the id of a hand that carries on from here; empty: moves by hand count no more.
        """
        checked_vector(pose.position, "position", WORLD_SIZE)
        self._robots[name] = replace(self.robot(name), pose=pose)
        self._carriers[name] = carrier(hand)
        return self._robots[name]

    def follow(self, name: str, hand: str, sequence: int, pose: Pose) -> bool:
        """Set the pose of a robot to where its hand has it; return whether this move counts.

        Raises BadInput where the pose is outside the room.
        """
        by = self._carriers.get(name)
        if name not in self._robots or by is None:
            return False
        checked_vector(pose.position, "position", WORLD_SIZE)
        if not by.follows(hand, sequence):
            return False
        self._robots[name] = replace(self._robots[name], pose=pose)
        return True

    def set_end_effector(self, name: str, end_effector: str | None) -> PlacedRobot:
        self._robots[name] = replace(self.robot(name), end_effector=end_effector)
        return self._robots[name]

    def remove(self, name: str) -> PlacedRobot:
        self.robot(name)
        self._carriers.pop(name, None)
        return self._robots.pop(name)
