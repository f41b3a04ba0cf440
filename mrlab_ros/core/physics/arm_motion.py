"""Prescribed arms: posed by their joint states at every step, in parts where they are fast."""

from __future__ import annotations

import math

from mrlab_ros.core.physics.collisions import Collisions
from mrlab_ros.core.physics.grippers import Grippers
from mrlab_ros.core.physics.joint_stream import Joints, between
from mrlab_ros.core.physics.simulated_robot import Robot
from mrlab_ros.core.physics.world_state import WorldState
from mrlab_ros.core.playback.states import State

# A robot that moved in a step: start and end positions, and velocities.
Moved = tuple[Robot, Joints, Joints, Joints]


class ArmMotion:
    """Poses the arms of a world."""

    def __init__(self, state: WorldState, grippers: Grippers, collisions: Collisions) -> None:
        self._engine = state.engine
        self._settings = state.settings
        self._robots = state.robots
        self._grippers = grippers
        self._collisions = collisions

    def pose(self, now_ns: int, *, check: bool) -> list[Moved]:
        """Pose every arm by its joint states; return those that moved.

        check: those that stand are posed again, too.
        """
        moved: list[Moved] = []
        for robot in self._robots.values():
            placed = robot.stream.at(now_ns)
            if placed is None:
                continue
            before = robot.placed
            same = before == placed.positions
            # Contacts can drift a standing arm; re-place it only while something touches it.
            idle = same and not (check or robot.touches or robot.held)
            if idle and not any(placed.velocities):
                continue
            jumped = placed.jumped or before is None
            self._engine.move_arm(robot.name, placed.positions, placed.velocities, jumped=jumped)
            robot.placed = placed.positions
            if jumped:
                self._grippers.carry(robot)
                if robot.pending is not None:
                    robot.pending = (now_ns, robot.pending[1])
                if before is None and robot.playing.state is not State.COLLISION_HALT:
                    self._collisions.tolerate(robot)
            elif before is not None and not same:
                moved.append((robot, before, placed.positions, placed.velocities))
        return moved

    def divisions(self, moved: list[Moved]) -> int:
        """Return into how many parts to divide a step so that no arm passes through a plate."""
        most = 0.0
        for robot, start, end, velocities in moved:
            # Upper bound: the way of the arm's end if it were fully stretched.
            bound = robot.reach(end, start)
            if bound > self._settings.max_travel:
                if velocities is not robot.share_of:
                    # The share is constant along a straight motion in joint space.
                    stretched = robot.reach(velocities)
                    speed = self._engine.speed(robot.name)
                    robot.share = min(speed / stretched, 1.0) if stretched else 1.0
                    robot.share_of = velocities
                most = max(most, bound * robot.share)
        return min(math.ceil(most / self._settings.max_travel) or 1, self._settings.max_divisions)

    def pose_between(self, moved: list[Moved], share: float) -> None:
        """Pose the arms that moved at a share, 0 to 1, of their way in this step."""
        for robot, start, end, velocities in moved:
            at = between(start, end, share)
            self._engine.move_arm(robot.name, at, velocities)
