"""Steps of the world: prescribed arms, the fixed grid of instants, and rest.

Arms are posed by their joint states at every step, in parts where they are fast. While nothing in
the world moves or touches, it is stepped less often.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Hashable, Mapping

from mrlab_ros.core.base.clock import SECOND
from mrlab_ros.core.base.geometry import Pose
from mrlab_ros.core.physics.collisions import Collisions
from mrlab_ros.core.physics.engine import BodyState
from mrlab_ros.core.physics.grasp.states import Grasp
from mrlab_ros.core.physics.grippers import Grippers
from mrlab_ros.core.physics.joint_stream import Joints, between
from mrlab_ros.core.physics.simulated_robot import Robot
from mrlab_ros.core.physics.world_state import WorldState
from mrlab_ros.core.playback.states import MOVING, State

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


# Decimals of a finger's position, m or rad, that a drive at its end leaves as they are.
FINGER_DECIMALS = 5


class Rest:
    """Compares the world with what it was a moment ago.

    resting: nothing has moved between the last two calls of compare(). Objects that sleep keep
    their pose exactly; what a robot or a person holds does not rest.
    """

    def __init__(self, state: WorldState) -> None:
        self._world_state = state
        self.resting = False
        self._before: Hashable = None

    def end(self) -> None:
        """Take that something moves."""
        self.resting = False
        self._before = None

    def compare(self, motions: Callable[[], Mapping[str, BodyState]]) -> None:
        """Compare the world with the last call's. motions: reads those of all movable objects."""
        state = self._world_state
        found: Hashable = None
        if all(map(self._stands, state.robots.values())) and not any(
            thing.held_by for thing in state.objects.values()
        ):
            poses: dict[str, Pose] = {name: motion.pose for name, motion in motions().items()}
            fingers = [
                round(finger.position, FINGER_DECIMALS)
                for name in state.robots
                for finger in state.engine.fingers(name)
            ]
            found = (tuple(state.robots), tuple(poses.items()), tuple(fingers))
        self.resting = found is not None and found == self._before
        self._before = found

    def _stands(self, robot: Robot) -> bool:
        """Return whether a robot neither moves nor touches, and waits for nothing."""
        return (
            robot.stream.stands(self._world_state.now_ns)
            and robot.playing.state not in MOVING
            and robot.grasp is not Grasp.CLOSING
            and robot.pending is None
            and not (robot.queued or robot.touches or robot.held or robot.leaving)
        )


# Clearance and snapshots run every SLOW_STEPS steps; every ROOM_STEPS, a multiple of it, what has
# left the room is looked for.
SLOW_STEPS = 12
ROOM_STEPS = 60


class StepGrid:
    """Counts steps of `rate` a second, Hz, from an instant on. count: that of the last step."""

    def __init__(self, rate: float) -> None:
        self._rate = rate
        self._epoch_ns: int | None = None
        self.count = 0

    @property
    def started(self) -> bool:
        return self._epoch_ns is not None

    def start(self, now_ns: int) -> None:
        """Let step 0 be at `now_ns`."""
        self._epoch_ns = now_ns

    def shift(self, by_ns: int) -> None:
        """Move all instants by `by_ns`; the count goes on."""
        assert self._epoch_ns is not None
        self._epoch_ns += by_ns

    def stamp(self, count: int) -> int:
        """Return the instant of a step, ns."""
        assert self._epoch_ns is not None
        return self._epoch_ns + round(count * SECOND / self._rate)

    def next(self, *, resting: bool) -> int:
        """Return the count of the next step: a world at rest makes every SLOW_STEPS-th only."""
        if resting:
            return (self.count // SLOW_STEPS + 1) * SLOW_STEPS
        return self.count + 1
