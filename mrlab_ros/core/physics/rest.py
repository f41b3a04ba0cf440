"""Rest: while nothing in the world moves or touches, it is stepped less often."""

from __future__ import annotations

from collections.abc import Callable, Hashable, Mapping

from mrlab_ros.core.base.geometry import Pose
from mrlab_ros.core.physics.engine import BodyState
from mrlab_ros.core.physics.grasp import Grasp
from mrlab_ros.core.physics.simulated_robot import Robot
from mrlab_ros.core.physics.world_state import WorldState
from mrlab_ros.core.playback.states import MOVING

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
