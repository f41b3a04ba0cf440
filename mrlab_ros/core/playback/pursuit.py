"""How a goal that is being followed ends: reached, off its tolerances, halted or replaced."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from mrlab_ros.core.base.clock import SECOND
from mrlab_ros.core.base.diagnostic import Diagnostic
from mrlab_ros.core.base.geometry import Array
from mrlab_ros.core.playback import diagnostics as say
from mrlab_ros.core.playback.execution import PlaybackStatus
from mrlab_ros.core.playback.goal import Code, WrongGoal
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
                unknown = say.TOLERANCE_OF_NO_JOINT(found=name, expected=joint_names)
                raise WrongGoal(unknown, Code.INVALID_JOINTS)
            if not np.isfinite(value):
                raise WrongGoal(say.TOLERANCE_NO_NUMBER(joint=name, tolerance=value))


@dataclass(frozen=True)
class Outcome:
    """How a goal ended."""

    code: Code
    said: Diagnostic


@dataclass(frozen=True)
class Instant:
    """The desired and the actual joints at one time, (J,) rad and rad/s; elapsed: s."""

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
        self._paused = False

    def note(self, status: PlaybackStatus) -> None:
        """Take a change of the playback's state."""
        if self._outcome is not None:
            return
        if status.trajectory is not self.trajectory:
            self._outcome = Outcome(Code.INVALID_GOAL, say.OTHER_TRAJECTORY())
        elif status.state is State.COMPLETE:
            self._complete = True
        elif status.state is State.COLLISION_HALT:
            halted = say.GOAL_HALTED(why=status.message)
            self._outcome = Outcome(Code.PATH_TOLERANCE_VIOLATED, halted)
        elif status.state in (State.READY, State.IDLE) and not self._complete:
            self._outcome = Outcome(Code.INVALID_GOAL, say.GOAL_STOPPED())
        self._paused = status.state is State.PAUSED

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
        state = State.PAUSED.name if self._paused else None
        if self._complete:
            off = self._off(self._bounds.goal, last - instant.actual)
            if off:
                return Outcome(Code.GOAL_TOLERANCE_VIOLATED, say.OFF_GOAL(**off))
            return Outcome(Code.SUCCESSFUL, say.GOAL_REACHED())
        off = self._off(self._bounds.path, instant.desired - instant.actual)
        if off:
            return Outcome(Code.PATH_TOLERANCE_VIOLATED, say.OFF_PATH(state=state, **off))
        late = (now_ns - self._start_ns) / SECOND - self.trajectory.duration
        if 0 < self._bounds.time < late:
            return Outcome(Code.GOAL_TOLERANCE_VIOLATED, say.GOAL_LATE(late=late, state=state))
        return None

    def _off(self, tolerances: Tolerances, errors: Array) -> dict[str, Any]:
        """Return the joint that is off by more than it may, with value and limit; or nothing."""
        for joint, error in zip(self.trajectory.joint_names, errors.tolist(), strict=True):
            allowed = tolerances.get(joint, 0.0)
            if 0 < allowed < abs(error):
                return {"joint": joint, "value": error, "limit": allowed}
        return {}
