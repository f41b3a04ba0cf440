"""Ranges, speeds, accelerations, jerk and smoothness of the joints in a motion.

Speeds are differences of the positions, as a controller sees them that is sent one position a
frame; nothing is smoothed. Smoothness is the spectral arc length of the tool's speed.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mrlab_ros.core.base.diagnostic import Diagnostic
from mrlab_ros.core.base.geometry import Array
from mrlab_ros.core.checking.diagnostics import (
    ACCELERATION_LIMIT,
    JERK_LIMIT,
    MOVES_AT_END,
    MOVES_AT_START,
    NEAR_JOINT_LIMIT,
    OUTSIDE_RANGE,
    OVER_SPEED,
    SMALL_JUMPS,
    SPEED_STEP,
    ZIGZAG,
)
from mrlab_ros.core.conversion.motion_checks import LIMIT_TOLERANCE
from mrlab_ros.core.robots.model import Joint

# An arm is at rest where no joint moves faster than this share of its limit.
REST_SHARE = 0.02
# From so little room to a limit on, rad or m, it is a finding: 2 degrees, or 2 mm.
NARROW = np.radians(2.0)
# A step of the speed is one where it is so many times the usual one (95th percentile), and so
# large a share of the joint's limit.
STEP_USUAL, STEP_SHARE = 10.0, 0.1
# A joint jumps where one row moves it so much faster or slower than both rows beside it, as a
# share of its limit, and so many times more than it usually does (median).
SPIKE_SHARE, SPIKE_USUAL = 0.1, 10.0
# It zigzags where it turns back within so short a time, s, faster than this share of its limit,
# and over more than this way, rad or m: less is the noise of an encoder.
TURNS_BACK, BACK_SHARE, BACK_WAY = 0.05, 0.05, 1e-3
# Of a limit that is computed from rounded numbers.
ROUNDING = 1.01


@dataclass(frozen=True)
class StatedLimits:
    """Limits that a vendor states beside range and speed: rad/s^2 and rad/s^3, or None."""

    acceleration: float | None = None
    jerk: float | None = None


@dataclass(frozen=True)
class JointFigures:
    """The most that a joint does. All rad, or m where it slides, and s.

    room: to the nearer end of its range, at `room_time`. first_speed, last_speed: of its ends.
    speed_step: the largest change of its speed from one frame to the next, at `step_time`, and
    `usual_step` the 95th percentile of these. jumps, backs: the times at which it jumps, and turns
    back at once; jump, back: the largest of their changes of speed.
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
    jumps: tuple[float, ...]
    jump: float
    backs: tuple[float, ...]
    back: float

    @property
    def speed_share(self) -> float:
        """The largest speed as a share of the joint's limit."""
        return self.speed / self.joint.max_velocity

    @property
    def jolts(self) -> bool:
        """Return whether its speed changes at one frame as it does nowhere else."""
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
    jumps, jump = _jumps(speeds, rate, joint.max_velocity)
    backs, back = _backs(speeds, rate, joint.max_velocity)
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
        jumps=jumps,
        jump=jump,
        backs=backs,
        back=back,
    )


def _jumps(speeds: Array, rate: float, most: float) -> tuple[tuple[float, ...], float]:
    """Return when single rows move a joint as neither row beside them does, and by how much."""
    if len(speeds) < 3:
        return (), 0.0
    beside = (speeds[:-2] + speeds[2:]) / 2
    spikes = np.abs(speeds[1:-1] - beside)
    # A corner, such as the end of a ramp, is no jump: the rows beside it differ as much.
    spikes -= np.abs(speeds[:-2] - speeds[2:]) / 2
    least = max(SPIKE_SHARE * most, SPIKE_USUAL * float(np.median(spikes)))
    rows = np.flatnonzero(spikes > least)
    return _times(rows + 1, rate), float(spikes[rows].max(initial=0.0))


def _backs(speeds: Array, rate: float, most: float) -> tuple[tuple[float, ...], float]:
    """Return when a joint turns back at once, and the largest change of its speed there."""
    moving = np.flatnonzero(speeds)
    way = np.sign(speeds[moving])
    starts = moving[np.flatnonzero(np.diff(way, prepend=0.0))]
    if len(starts) < 3:
        return (), 0.0
    peaks = np.maximum.reduceat(np.abs(speeds), starts)
    ways = np.abs(np.add.reduceat(speeds, starts)) / rate
    long = np.diff(starts, append=len(speeds)) / rate
    quick = (peaks > BACK_SHARE * most) & (ways > BACK_WAY)
    short = quick & (long <= max(TURNS_BACK, 1.0 / rate) * ROUNDING)
    # Between two others that are as quick.
    inner = np.flatnonzero(quick[:-2] & short[1:-1] & quick[2:]) + 1
    change = (peaks[inner] + peaks[inner - 1]).max(initial=0.0)
    return _times(starts[inner], rate), float(change)


def _times(rows: NDArray[np.integer[Any]], rate: float) -> tuple[float, ...]:
    return tuple((rows / rate).tolist())


def _end_speed(q: Array, rate: float) -> float:
    """Return the speed at the first of up to three positions.

    One-sided difference of second order: (-3 q0 + 4 q1 - q2) / 2 dt. It is 0 for a motion that
    begins with any acceleration, so long as that is even.
    """
    if len(q) < 3:
        return float(abs(q[-1] - q[0]) * rate)
    return float(abs(-3 * q[0] + 4 * q[1] - q[2]) * rate / 2)


def findings_of(figures: Sequence[JointFigures], robot: str, end: float) -> list[Diagnostic]:
    """Return what the figures say against a motion that is `end` s long."""
    return [found for one in figures for found in _of_joint(one, robot, end)]


def _of_joint(one: JointFigures, robot: str, end: float) -> Iterator[Diagnostic]:
    joint = one.joint
    at: dict[str, Any] = {"robot": robot, "joint": joint.name}
    if one.room < -LIMIT_TOLERANCE:
        yield OUTSIDE_RANGE(
            **at,
            time=one.room_time,
            value=-one.room,
            limit=0.0,
            unit="rad",
            lower=joint.lower,
            upper=joint.upper,
        )
    elif one.room < NARROW:
        room = max(one.room, 0.0)
        yield NEAR_JOINT_LIMIT(
            **at, time=one.room_time, value=room, limit=float(NARROW), unit="rad"
        )
    most = joint.max_velocity
    if one.speed > most * ROUNDING:
        yield OVER_SPEED(
            **at,
            time=one.speed_time,
            value=one.speed,
            limit=most,
            unit="rad/s",
            times=one.speed_share,
        )
    for code, value, limit, time, unit in (
        (ACCELERATION_LIMIT, one.acceleration, one.stated.acceleration, one.acceleration_time,
         "rad/s^2"),
        (JERK_LIMIT, one.jerk, one.stated.jerk, one.jerk_time, "rad/s^3"),
    ):  # fmt: skip
        if limit is not None and value > limit * ROUNDING:
            yield code(**at, time=time, value=value, limit=limit, unit=unit)
    for code, speed, time in (
        (MOVES_AT_START, one.first_speed, 0.0),
        (MOVES_AT_END, one.last_speed, end),
    ):
        if speed > REST_SHARE * most:
            yield code(**at, time=time, value=speed, limit=REST_SHARE * most, unit="rad/s")
    # A row that goes back is both; one of the two says it.
    zigzags = 2 * len(one.backs) >= len(one.jumps)
    times, value = (one.backs, one.back) if zigzags else (one.jumps, one.jump)
    if times:
        code = ZIGZAG if zigzags else SMALL_JUMPS
        yield code(**at, time=times[0], value=value, unit="rad/s", count=len(times))
        return
    if one.jolts:
        yield SPEED_STEP(
            **at,
            time=one.step_time,
            value=one.speed_step,
            limit=STEP_SHARE * most,
            unit="rad/s",
            usual=one.usual_step,
        )


# As Balasubramanian et al. recommend.
PADDING = 4
CUT_OFF = 10.0  # Hz
LEAST_AMPLITUDE = 0.05


def spectral_arc_length(speeds: Array, rate: float) -> float | None:
    """Return SPARC of a speed profile, (N,) m/s at `rate` Hz: the nearer to 0 the smoother.

    A single smooth reach has about -1.4 to -1.6; each stop or correction makes it more negative.
    None where nothing moves. The length of the normalised amplitude spectrum up to the last
    frequency, at most 10 Hz, whose amplitude is 0.05 or more (Balasubramanian, Melendez-Calderon,
    Roby-Brami and Burdet, Journal of NeuroEngineering and Rehabilitation 12:112, 2015).
    """
    if len(speeds) < 3 or not float(speeds.max()) > 1e-9:
        return None
    count = 2 ** (int(np.ceil(np.log2(len(speeds)))) + PADDING)
    amplitude = np.abs(np.fft.rfft(speeds, count))
    amplitude /= amplitude.max()
    frequency = np.fft.rfftfreq(count, 1.0 / rate)
    inside = frequency <= CUT_OFF
    frequency, amplitude = frequency[inside], amplitude[inside]
    loud = np.flatnonzero(amplitude >= LEAST_AMPLITUDE)
    frequency, amplitude = frequency[: loud[-1] + 1], amplitude[: loud[-1] + 1]
    span = frequency[-1] - frequency[0]
    if not span > 0:
        return None
    steps = np.hypot(np.diff(frequency) / span, np.diff(amplitude))
    return -float(steps.sum())
