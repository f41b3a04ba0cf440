"""How a goal that is being followed ends: reached, off its tolerances, halted or replaced."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np

from mrlab_ros.core.clock import SECOND
from mrlab_ros.core.geometry import Array
from mrlab_ros.core.playback.goal import Code, WrongGoal
from mrlab_ros.core.playback.playback import PlaybackStatus
from mrlab_ros.core.playback.states import State
from mrlab_ros.core.trajectory.trajectory import Trajectory

# As control_msgs/JointTolerance has it: below 0 nothing is checked; 0 is the default, which here
# is nothing, too.
Tolerances = Mapping[str, float]


@dataclass(frozen=True)
class Bounds:
    """path: how far a joint may be off on the way, rad by joint; goal: at the end. time: s after
    the planned end in which the goal has to be reached; 0: no limit."""

    path: Tolerances = field(default_factory=dict)
    goal: Tolerances = field(default_factory=dict)
    time: float = 0.0

    def check(self, joint_names: Sequence[str]) -> None:
        """Raise WrongGoal where a tolerance names no joint or is no number."""
        for name, value in (*self.path.items(), *self.goal.items()):
            if name not in joint_names:
                raise WrongGoal(
                    Code.INVALID_JOINTS,
                    f"a tolerance is for {name}; expected one of {', '.join(joint_names)}",
                )
            if not np.isfinite(value):
                raise WrongGoal(
                    Code.INVALID_GOAL, f"the tolerance for {name} is {value}; expected a number"
                )


@dataclass(frozen=True)
class Outcome:
    """How a goal ended."""

    code: Code
    text: str


@dataclass(frozen=True)
class Instant:
    """Where the joints should be and are at one time, (J,) rad and rad/s; elapsed: s."""

    elapsed: float
    desired: Array
    desired_velocities: Array
    actual: Array


class Pursuit:
    """A goal that a playback follows: its trajectory, its start, ns, and its bounds."""

    def __init__(self, trajectory: Trajectory, start_ns: int, bounds: Bounds) -> None:
        self.trajectory = trajectory
        self._start_ns = start_ns
        self._bounds = bounds
        self._complete = False
        self._outcome: Outcome | None = None
        self._paused = ""

    def note(self, status: PlaybackStatus) -> None:
        """Take a change of the playback's state."""
        if self._outcome is not None:
            return
        if status.trajectory is not self.trajectory:
            self._outcome = Outcome(Code.INVALID_GOAL, "another trajectory was loaded meanwhile")
        elif status.state is State.COMPLETE:
            self._complete = True
        elif status.state is State.COLLISION_HALT:
            self._outcome = Outcome(
                Code.PATH_TOLERANCE_VIOLATED, f"the arm halted: {status.message}"
            )
        elif status.state in (State.READY, State.IDLE) and not self._complete:
            self._outcome = Outcome(Code.INVALID_GOAL, "the robot was stopped")
        self._paused = ", since the robot was paused" if status.state is State.PAUSED else ""

    def instant(self, now_ns: int, sent_ns: int, arm: Array) -> Instant:
        """Return where the arm should be and is; sent_ns: the stamp of its last joint state."""
        at_ns = now_ns if self._paused else min(sent_ns, now_ns)
        elapsed = min(max((at_ns - self._start_ns) / SECOND, 0.0), self.trajectory.duration)
        _, desired, velocities = self.trajectory.at(elapsed)
        return Instant(elapsed, desired, velocities, arm)

    def outcome(self, now_ns: int, instant: Instant) -> Outcome | None:
        """Return how the goal ended; None: it goes on."""
        if self._outcome is not None:
            return self._outcome
        last = self.trajectory.positions[-1]
        if self._complete:
            off = self._off(self._bounds.goal, last - instant.actual)
            if off:
                return Outcome(Code.GOAL_TOLERANCE_VIOLATED, f"{off} off the goal")
            return Outcome(Code.SUCCESSFUL, "Goal successfully reached!")
        off = self._off(self._bounds.path, instant.desired - instant.actual)
        if off:
            return Outcome(Code.PATH_TOLERANCE_VIOLATED, f"{off} off the path{self._paused}")
        late = (now_ns - self._start_ns) / SECOND - self.trajectory.duration
        if 0 < self._bounds.time < late:
            return Outcome(
                Code.GOAL_TOLERANCE_VIOLATED,
                f"the goal was not reached {late:.2f} s after its time{self._paused}",
            )
        return None

    def _off(self, tolerances: Tolerances, errors: Array) -> str:
        """Return which joint is off by more than it may, and by how much; empty: none."""
        for joint, error in zip(self.trajectory.joint_names, errors.tolist(), strict=True):
            allowed = tolerances.get(joint, 0.0)
            if 0 < allowed < abs(error):
                return f"{joint} is {error:.4g} rad (allowed: {allowed:.4g})"
        return ""
