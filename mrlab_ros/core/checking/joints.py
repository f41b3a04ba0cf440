"""What the joints do in a motion: ranges, speeds, accelerations, jerk, and how it begins and ends.

Speeds are differences of the positions, as a controller sees them that is sent one position a
frame; nothing is smoothed.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from mrlab_ros.core.base.diagnostic import Severity
from mrlab_ros.core.checking.findings import Finding
from mrlab_ros.core.conversion.limits import LIMIT_TOLERANCE
from mrlab_ros.core.geometry import Array
from mrlab_ros.core.robots.model import Joint

# An arm is at rest where no joint moves faster than this share of its limit.
REST_SHARE = 0.02
# From so little room to a limit on, rad or m, it is a finding: 2 degrees, or 2 mm.
NARROW = np.radians(2.0)
# A step of the speed is one where it is so many times the usual one (95th percentile), and so
# large a share of the joint's limit.
STEP_USUAL, STEP_SHARE = 10.0, 0.1
# Of a limit that is computed from rounded numbers.
ROUNDING = 1.01


@dataclass(frozen=True)
class StatedLimits:
    """What a vendor states of a joint beside range and speed: rad/s^2 and rad/s^3, or None."""

    acceleration: float | None = None
    jerk: float | None = None


@dataclass(frozen=True)
class JointFigures:
    """The most that a joint does. All rad, or m where it slides, and s.

    room: to the nearer end of its range, at `room_time`. first_speed, last_speed: of its ends.
    speed_step: the largest change of its speed from one frame to the next, at `step_time`, and
    `usual_step` the 95th percentile of these.
    """

    joint: Joint
    stated: StatedLimits
    lower: float
    upper: float
    room: float
    room_time: float
    speed: float
    speed_time: float
    acceleration: float
    acceleration_time: float
    jerk: float
    jerk_time: float
    first_speed: float
    last_speed: float
    speed_step: float
    step_time: float
    usual_step: float

    @property
    def speed_share(self) -> float:
        """The largest speed as a share of the joint's limit."""
        return self.speed / self.joint.max_velocity

    @property
    def jolts(self) -> bool:
        """Whether its speed changes at one frame as it does nowhere else."""
        return (
            self.speed_step > STEP_USUAL * self.usual_step
            and self.speed_step > STEP_SHARE * self.joint.max_velocity
        )


def figures_of(
    positions: Array,
    frame_rate: float,
    joints: Sequence[Joint],
    stated: Mapping[str, StatedLimits],
) -> tuple[JointFigures, ...]:
    """Return the figures of each joint; positions: (N, J) rad, in the order of `joints`."""
    return tuple(
        _figures(positions[:, j], frame_rate, joint, stated.get(joint.name, StatedLimits()))
        for j, joint in enumerate(joints)
    )


def _figures(q: Array, rate: float, joint: Joint, stated: StatedLimits) -> JointFigures:
    room = np.minimum(q - joint.lower, joint.upper - q)
    speeds = np.diff(q) * rate
    changes = np.diff(speeds)
    jerks = np.diff(changes) * rate * rate

    def most(values: Array, behind: int) -> tuple[float, float]:
        """Return the largest amount, and the time of the frame `behind` its first one, s."""
        if not len(values):
            return 0.0, 0.0
        at = int(np.abs(values).argmax())
        return float(abs(values[at])), (at + behind) / rate

    speed, speed_time = most(speeds, 0)
    step, step_time = most(changes, 1)
    jerk, jerk_time = most(jerks, 1)
    nearest = int(room.argmin())
    return JointFigures(
        joint=joint,
        stated=stated,
        lower=float(q.min()),
        upper=float(q.max()),
        room=float(room[nearest]),
        room_time=nearest / rate,
        speed=speed,
        speed_time=speed_time,
        acceleration=step * rate,
        acceleration_time=step_time,
        jerk=jerk,
        jerk_time=jerk_time,
        first_speed=_end_speed(q[:3], rate),
        last_speed=_end_speed(q[::-1][:3], rate),
        speed_step=step,
        step_time=step_time,
        usual_step=float(np.quantile(np.abs(changes), 0.95)) if len(changes) else 0.0,
    )


def _end_speed(q: Array, rate: float) -> float:
    """Return the speed at the first of up to three positions.

    One-sided difference of second order: (-3 q0 + 4 q1 - q2) / 2 dt. It is 0 for a motion that
    begins with any acceleration, so long as that is even.
    """
    if len(q) < 3:
        return float(abs(q[-1] - q[0]) * rate)
    return float(abs(-3 * q[0] + 4 * q[1] - q[2]) * rate / 2)


def findings_of(figures: Sequence[JointFigures], robot: str, end: float) -> list[Finding]:
    """Return what the figures say against a motion that is `end` s long."""
    found: list[Finding] = []
    for one in figures:
        found += _of_limits(one, robot)
        found += _of_ends(one, robot, end)
    return found


def _of_limits(one: JointFigures, robot: str) -> list[Finding]:
    joint, name = one.joint, one.joint.name
    found = []
    if one.room < -LIMIT_TOLERANCE:
        found.append(
            Finding(
                "joint_limit", Severity.ERROR,
                f"{name} is {-one.room:.3g} rad beyond its range of {joint.lower:.4g} to "
                f"{joint.upper:.4g} rad.",
                "Keep the joint in its range, or convert the file again for this robot.",
                robot, name, one.room_time, None, one.room, 0.0, "rad",
            )
        )  # fmt: skip
    elif one.room < NARROW:
        found.append(
            Finding(
                "near_joint_limit", Severity.WARNING,
                f"{name} comes within {max(one.room, 0.0):.3g} rad of the end of its range.",
                "Choose another configuration of the arm, or turn the task about the base.",
                robot, name, one.room_time, None, one.room, NARROW, "rad",
            )
        )  # fmt: skip
    if one.speed > joint.max_velocity * ROUNDING:
        found.append(
            Finding(
                "velocity_limit", Severity.ERROR,
                f"{name} moves at {one.speed:.3g} rad/s; it reaches {joint.max_velocity:.3g}.",
                f"Give the motion at least {one.speed_share:.2f} times its duration.",
                robot, name, one.speed_time, None, one.speed, joint.max_velocity, "rad/s",
            )
        )  # fmt: skip
    for code, what, value, limit, time, unit in (
        ("acceleration_limit", "accelerates by", one.acceleration, one.stated.acceleration,
         one.acceleration_time, "rad/s^2"),
        ("jerk_limit", "has a jerk of", one.jerk, one.stated.jerk, one.jerk_time, "rad/s^3"),
    ):  # fmt: skip
        if limit is not None and value > limit * ROUNDING:
            found.append(
                Finding(
                    code, Severity.ERROR,
                    f"{name} {what} {value:.3g} {unit}; its vendor states {limit:.3g}.",
                    "Plan with a smooth time law, such as a quintic, or give it more time.",
                    robot, name, time, None, value, limit, unit,
                )
            )  # fmt: skip
    return found


def _of_ends(one: JointFigures, robot: str, end: float) -> list[Finding]:
    name, most = one.joint.name, REST_SHARE * one.joint.max_velocity
    found = [
        Finding(
            code, Severity.ERROR,
            f"{name} {verb} at {speed:.3g} rad/s, not at rest.",
            remedy,
            robot, name, time, None, speed, most, "rad/s",
        )
        for code, verb, speed, time, remedy in (
            ("moves_at_start", "begins", one.first_speed, 0.0,
             "Begin with speed 0, for example with a quintic time law."),
            ("moves_at_end", "ends", one.last_speed, end,
             "Bring the motion to rest, for example with a quintic time law."),
        )
        if speed > most
    ]  # fmt: skip
    if one.jolts:
        found.append(
            Finding(
                "speed_step", Severity.ERROR,
                f"{name} changes its speed by {one.speed_step:.3g} rad/s from one frame to the "
                f"next; its other steps stay below {one.usual_step:.3g}.",
                "Blend the two parts of the motion, or stop between them.",
                robot, name, one.step_time, None, one.speed_step,
                STEP_SHARE * one.joint.max_velocity, "rad/s",
            )
        )  # fmt: skip
    return found
