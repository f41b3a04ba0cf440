"""Set-points that come one by one, from Simulink or a script, made into motion within limits.

The arm goes in a straight line in joint space from where it is to the newest set-point, in the
time since the one before it, and never faster than its joints may. So it follows a stream with a
delay of one set-point, and a slow stream evenly.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from mrlab_ros.core.clock import SECOND
from mrlab_ros.core.errors import BadInput
from mrlab_ros.core.geometry import Array
from mrlab_ros.core.playback.goal import FRAME_RATE, check_limits, unpublished
from mrlab_ros.core.robots.model import RobotModel
from mrlab_ros.core.trajectory.trajectory import Trajectory

LIVE = "live"
# Without a set-point for this time the stream has ended, s.
SILENCE = 0.5
# Set-points that are late are not taken for fast ones, s.
JITTER = 0.1
# A stream's first set-point is approached at this share of the joints' velocity limits.
APPROACH_SHARE = 0.3
# Two set-points are joined in no less and no more than this time, s.
SHORTEST, LONGEST = 1 / FRAME_RATE, 0.25


@dataclass(frozen=True)
class Straight:
    """A motion at constant velocity; a Motion of the planner's port. start, goal: (J,) rad."""

    start: Array
    goal: Array
    duration: float

    def at(self, elapsed: float) -> tuple[Array, Array]:
        if elapsed > self.duration:
            return self.goal, np.zeros_like(self.goal)
        share = min(max(elapsed, 0.0) / self.duration, 1.0)
        way = self.goal - self.start
        return self.start + share * way, way / self.duration


class SetPoints:
    """The stream of set-points of one arm: what is accepted, and the motion to it."""

    def __init__(self, model: RobotModel) -> None:
        self._model = model
        self._fastest = np.array([joint.max_velocity for joint in model.joints])
        self._last: Array | None = None
        self._last_ns = 0
        self._approaching = True

    def checked(
        self, names: Sequence[str], positions: Sequence[float], velocities: Sequence[float] = ()
    ) -> Array:
        """Return the positions, (J,) rad in the model's order; without names they are in it.

        Raises BadInput where joints are missing or unknown, or a value is no number or beyond its
        limits.
        """
        known = self._model.joint_names
        names = list(names) or list(known)
        if sorted(names) != sorted(known):
            raise BadInput(
                f"the joint command names {', '.join(names)}; expected each of {', '.join(known)} "
                "once, in any order"
            )
        for kind, values in (("positions", positions), ("velocities", velocities)):
            if len(values) != len(names) and (values or kind == "positions"):
                raise BadInput(
                    f"the joint command has {len(values)} {kind}; expected {len(known)}"
                )
        order = [names.index(joint) for joint in known]
        found = np.array(positions, dtype=np.float64)[order]
        if not np.isfinite(found).all():
            joint = known[int(np.flatnonzero(~np.isfinite(found))[0])]
            raise BadInput(f"the joint command for {joint} is NaN or infinite; expected rad")
        check_limits(found, self._model, " in the joint command")
        if velocities:
            fast = np.abs(np.array(velocities, dtype=np.float64)[order])
            if not (fast <= self._fastest).all():
                joint_at = int((~(fast <= self._fastest)).argmax())
                raise BadInput(
                    f"the joint command moves {known[joint_at]} at {fast[joint_at]:.3g} rad/s; "
                    f"expected {self._fastest[joint_at]:.3g} at most"
                )
        return found

    def rest(self) -> None:
        """Take the next set-point as the first of a stream."""
        self._last = None

    def motion(self, now_ns: int, arm: Array, goal: Array) -> Straight:
        """Return the motion from `arm` to the next set-point; raise BadInput where it is a jump.

        The first set-point is approached slowly, and so is what follows until the arm is there.
        """
        passed = max((now_ns - self._last_ns) / SECOND, 0.0)
        if self._last is None:
            self._approaching = True
        else:
            jump = np.abs(goal - self._last) / self._fastest
            if jump.max() > passed + JITTER:
                joint = int(jump.argmax())
                raise BadInput(
                    f"the joint command jumps: {self._model.joint_names[joint]} by "
                    f"{goal[joint] - self._last[joint]:.3g} rad in {passed:.3g} s; expected "
                    f"{self._fastest[joint]:.3g} rad/s at most. Move there in smaller steps, or "
                    f"pause the stream for {SILENCE:g} s"
                )
        self._last, self._last_ns = goal, now_ns
        needed = float((np.abs(goal - arm) / self._fastest).max())
        given = max(min(passed, LONGEST), SHORTEST)
        if self._approaching:
            slowly = needed / APPROACH_SHARE
            self._approaching = slowly > given
            needed = slowly
        return Straight(arm, goal, max(given, needed))

    def shift(self, by_ns: int) -> None:
        """Go on as before after the clock was set by `by_ns`."""
        self._last_ns += by_ns

    def place(self, arm: Array) -> Trajectory:
        """Return what stands for the stream while it lasts: standing where it began."""
        standing = np.vstack([arm, arm])
        return unpublished(LIVE, self._model, standing, np.zeros_like(standing))
