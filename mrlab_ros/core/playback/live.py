"""Set-points that come one by one, from Simulink or a script, made into motion within limits.

The reference goes in a straight line in joint space from where it is to each set-point as it
comes, in the time that set-points take to come: it is one set-point late and never jumps. The arm
is at the reference wherever its joints' limits let it. Where it is behind, as at the start of a
stream, it closes up at a share of these limits beside the reference's own speed; so what is left
when the stream ends is closed at that share, not at full speed.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from mrlab_ros.core.base.clock import SECOND
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.base.geometry import Array
from mrlab_ros.core.playback.diagnostics import (
    COMMAND_JUMPS,
    COMMAND_TOO_FAST,
    VALUE_NOT_FINITE,
    WRONG_VALUE_COUNT,
)
from mrlab_ros.core.playback.goal import check_limits, order, unpublished
from mrlab_ros.core.robots.model import RobotModel
from mrlab_ros.core.trajectory.trajectory import Trajectory

LIVE = "live"
# Without a set-point for this time the stream has ended, s.
SILENCE = 0.5
# Set-points that are late are not taken for fast ones, s.
JITTER = 0.1
# An arm that is behind the reference closes up at this share of the joints' velocity limits.
CLOSING_SHARE = 0.3
# Joint states of a stream, Hz: at 1000 set-points a second they are as new as at 100.
RATE = 250.0
# Two set-points are joined in no more than this time, s.
LONGEST = 0.25
# Share of the newest interval in the mean one, by which set-points that come in bursts are joined.
NEWEST_SHARE = 0.2
# A set-point that is later than this behind a period is overdue, s.
LATE = 0.02
# After a freeze the arm does in one joint state what it does in this time at most, s.
LONGEST_STEP = 0.02


@dataclass(frozen=True)
class Line:
    """A motion of the reference at constant velocity; start, goal: (J,) rad; duration: s."""

    start_ns: int
    start: Array
    goal: Array
    duration: float

    def at(self, now_ns: int) -> tuple[Array, Array]:
        """Return positions and speeds, (J,) rad and rad/s.

        The speeds are those of the stream: they last until the next set-point is overdue.
        """
        elapsed = max((now_ns - self.start_ns) / SECOND, 0.0)
        way = self.goal - self.start
        overdue = elapsed > 2 * self.duration + LATE
        speeds = np.zeros_like(way) if overdue or not self.duration else way / self.duration
        if elapsed >= self.duration:
            return self.goal, np.abs(speeds)
        return self.start + elapsed / self.duration * way, np.abs(speeds)


class SetPoints:
    """The stream of set-points of one arm: what is accepted, and where the arm goes for it."""

    def __init__(self, model: RobotModel) -> None:
        self._model = model
        self._fastest = np.array([joint.max_velocity for joint in model.joints])
        self._last: Array | None = None
        self._last_ns = 0
        self._line: Line | None = None
        self._mean = 0.0  # s between two set-points; 0: not known
        self._stepped_ns = 0

    def checked(
        self, names: Sequence[str], positions: Sequence[float], velocities: Sequence[float] = ()
    ) -> Array:
        """Return the positions, (J,) rad in the model's order; without names they are in it.

        Raises BadInput where joints are missing or unknown, or a value is no number or beyond its
        limits.
        """
        known = self._model.joint_names
        names = list(names) or list(known)
        places = order(names, self._model)
        for kind, values in (("positions", positions), ("velocities", velocities)):
            if len(values) != len(names) and (values or kind == "positions"):
                raise BadInput(
                    WRONG_VALUE_COUNT(found=len(values), what=kind, expected=len(known))
                )
        found = np.array(positions, dtype=np.float64)[places]
        if not np.isfinite(found).all():
            joint = known[int(np.flatnonzero(~np.isfinite(found))[0])]
            raise BadInput(VALUE_NOT_FINITE(joint=joint, what="positions"))
        check_limits(found, self._model)
        if velocities:
            fast = np.abs(np.array(velocities, dtype=np.float64)[places])
            if not (fast <= self._fastest).all():
                joint_at = int((~(fast <= self._fastest)).argmax())
                raise BadInput(
                    COMMAND_TOO_FAST(
                        joint=known[joint_at],
                        value=float(fast[joint_at]),
                        limit=float(self._fastest[joint_at]),
                    )
                )
        return found

    def rest(self, now_ns: int) -> None:
        """Take the next set-point as the first of a stream; until then the arm stands."""
        self._last, self._line, self._mean = None, None, 0.0
        self._stepped_ns = now_ns

    def go_to(self, now_ns: int, goal: Array) -> None:
        """Take the set-point that came at `now_ns`; raise BadInput where it is a jump."""
        passed = max((now_ns - self._last_ns) / SECOND, 0.0)
        start, duration = goal, 0.0
        if self._last is not None and self._line is not None:
            jump = np.abs(goal - self._last) / self._fastest
            if jump.max() > passed + JITTER:
                joint = int(jump.argmax())
                raise BadInput(
                    COMMAND_JUMPS(
                        joint=self._model.joint_names[joint],
                        value=float(goal[joint] - self._last[joint]),
                        passed=passed,
                        limit=float(self._fastest[joint]),
                        silence=SILENCE,
                    )
                )
            self._mean += NEWEST_SHARE * (passed - self._mean) if self._mean else passed
            start, _ = self._line.at(now_ns)
            duration = min(max(passed, self._mean), LONGEST)
        self._last, self._last_ns = goal, now_ns
        self._line = Line(now_ns, start, goal, duration)

    def step(self, now_ns: int, arm: Array) -> tuple[Array, Array]:
        """Return where the arm is to be at `now_ns` and its velocities, (J,) rad and rad/s.

        arm: where it was at the step before. Steps go forward in time.
        """
        passed = min(max((now_ns - self._stepped_ns) / SECOND, 0.0), LONGEST_STEP)
        self._stepped_ns = now_ns
        if self._line is None or not passed:
            return arm, np.zeros_like(arm)
        reference, speeds = self._line.at(now_ns)
        fastest = np.minimum(CLOSING_SHARE * self._fastest + speeds, self._fastest)
        way = reference - arm
        needed = float((np.abs(way) / (fastest * passed)).max())
        if needed > 1.0:
            way, reference = way / needed, arm + way / needed
        return reference, way / passed

    def place(self, arm: Array) -> Trajectory:
        """Return what stands for the stream while it lasts: standing where it began."""
        standing = np.vstack([arm, arm])
        made = unpublished(LIVE, self._model, standing, np.zeros_like(standing))
        return replace(made, frame_rate=RATE)
