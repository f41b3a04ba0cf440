"""How a goal that is being followed ends: reached, off its tolerances, halted or replaced."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from mrlab_ros.core.base.clock import SECOND
from mrlab_ros.core.base.diagnostic import Diagnostic
from mrlab_ros.core.base.geometry import Array
from mrlab_ros.core.playback import diagnostics as say
from mrlab_ros.core.playback.execution import PlaybackStatus
from mrlab_ros.core.playback.goal import Code, WrongGoal
from mrlab_ros.core.playback.states import State
from mrlab_ros.core.playback.stream import Sample
from mrlab_ros.core.trajectory.trajectory import Trajectory

# By joint how far it may be off: rad, rad/s, rad/s^2. As control_msgs/JointTolerance has it, 0 is
# the default, which here is no limit, and so is ERASED.
Tolerances = Mapping[str, tuple[float, float, float]]
ERASED = -1.0
UNITS = ("rad", "rad/s", "rad/s^2")


@dataclass(frozen=True)
class Bounds:
    """path: how far a joint may be off on the way; goal: at the end. time: s after the planned end
    in which the goal has to be reached; 0: no limit."""

    path: Tolerances = field(default_factory=dict)
    goal: Tolerances = field(default_factory=dict)
    time: float = 0.0

    def check(self, joint_names: Sequence[str]) -> None:
        """Raise WrongGoal where a tolerance names no joint or is no tolerance."""
        for name, values in (*self.path.items(), *self.goal.items()):
            if name not in joint_names:
                unknown = say.TOLERANCE_OF_NO_JOINT(found=name, expected=joint_names)
                raise WrongGoal(unknown, Code.INVALID_JOINTS)
            _check_tolerances(name, values)
        _check_tolerances("goal_time_tolerance", (self.time,))


def _check_tolerances(of: str, values: Iterable[float]) -> None:
    for value in values:
        if not np.isfinite(value) or (value < 0 and value != ERASED):
            raise WrongGoal(say.TOLERANCE_NO_NUMBER(joint=of, tolerance=value))


@dataclass(frozen=True)
class Outcome:
    """How a goal ended. figures: how far it came; None: it did not begin."""

    code: Code
    said: Diagnostic
    figures: Diagnostic | None = None


@dataclass(frozen=True)
class Instant:
    """The desired and the actual joints at one time, (J,) rad and rad/s; elapsed: s.

    errors: desired less actual, (3, J): rad, rad/s, and rad/s^2 as the mean since the instant
    before.
    """

    elapsed: float
    desired: Array
    desired_velocities: Array
    actual: Array
    actual_velocities: Array
    errors: Array


class Pursuit:
    """A goal that a playback follows: its trajectory, its start, ns, and its bounds."""

    def __init__(self, trajectory: Trajectory, start_ns: int, bounds: Bounds) -> None:
        self.trajectory = trajectory
        self._start_ns = start_ns
        self._bounds = bounds
        self._complete = False
        self._outcome: Outcome | None = None
        self._paused = False
        # What was seen last, and when; the largest errors on the way, (J,) rad.
        self._before: tuple[int, Instant] | None = None
        self._most = np.zeros(len(trajectory.joint_names))

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

    def instant(self, now_ns: int, sent: Sample) -> Instant:
        """Return where the arm should be and is; sent: its last joint state."""
        at_ns = now_ns if self._paused else min(sent.due_ns, now_ns)
        elapsed = min(max((at_ns - self._start_ns) / SECOND, 0.0), self.trajectory.duration)
        _, desired, velocities = self.trajectory.at(elapsed)
        off = np.stack([desired - sent.positions, velocities - sent.velocities])
        change = np.zeros_like(desired)
        if self._before is not None and now_ns > self._before[0]:
            then_ns, before = self._before
            change = (off[1] - before.errors[1]) * (SECOND / (now_ns - then_ns))
        self._most = np.maximum(self._most, np.abs(off[0]))
        seen = Instant(
            elapsed, desired, velocities, sent.positions, sent.velocities, np.vstack([off, change])
        )
        self._before = now_ns, seen
        return seen

    def outcome(self, now_ns: int, instant: Instant) -> Outcome | None:
        """Return how the goal ended; None: it goes on."""
        ended = self._outcome or self._ended(now_ns, instant)
        return ended and replace(ended, figures=self.figures())

    @property
    def seen(self) -> Instant | None:
        """The newest instant; None before the first."""
        return None if self._before is None else self._before[1]

    def figures(self) -> Diagnostic | None:
        """Return how far the goal came, for its answer; None: nothing was seen of it yet."""
        instant = self.seen
        if instant is None:
            return None
        joints = self.trajectory.joint_names
        left = np.abs(self.trajectory.positions[-1] - instant.actual)
        return say.GOAL_FIGURES(
            elapsed=instant.elapsed,
            duration=self.trajectory.duration,
            joint=joints[int(left.argmax())],
            left=float(left.max()),
            worst=joints[int(self._most.argmax())],
            most=float(self._most.max()),
        )

    def _ended(self, now_ns: int, instant: Instant) -> Outcome | None:
        state = State.PAUSED.name if self._paused else None
        if self._complete:
            last = self.trajectory.positions[-1] - instant.actual
            off = self._off(self._bounds.goal, np.vstack([last, instant.errors[1:]]))
            if off:
                return Outcome(Code.GOAL_TOLERANCE_VIOLATED, say.OFF_GOAL(**off))
            return Outcome(Code.SUCCESSFUL, say.GOAL_REACHED())
        off = self._off(self._bounds.path, instant.errors)
        if off:
            return Outcome(Code.PATH_TOLERANCE_VIOLATED, say.OFF_PATH(state=state, **off))
        late = (now_ns - self._start_ns) / SECOND - self.trajectory.duration
        if 0 < self._bounds.time < late:
            return Outcome(Code.GOAL_TOLERANCE_VIOLATED, say.GOAL_LATE(late=late, state=state))
        return None

    def _off(self, tolerances: Tolerances, errors: Array) -> dict[str, Any]:
        """Return the joint that is off by more than it may, with value and limit; or nothing.

        errors: (3, J), in the order of a tolerance's values.
        """
        for joint, off in zip(self.trajectory.joint_names, errors.T.tolist(), strict=True):
            for unit, error, allowed in zip(UNITS, off, tolerances.get(joint, ()), strict=False):
                if 0 < allowed < abs(error):
                    return {"joint": joint, "value": error, "limit": allowed, "unit": unit}
        return {}
