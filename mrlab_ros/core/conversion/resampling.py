"""Lays rows and points out as frames at an even rate, Hz, as stored or resampled."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mrlab_ros.core.base.diagnostic import Diagnostic, Fix, Severity
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.conversion import frame_rate, motion_checks, rate_findings
from mrlab_ros.core.conversion.diagnostics import (
    BAD_MESSAGE,
    LATE_POINT,
    NO_TIMES,
    RATE_DEFAULT,
    RECORDING_PAUSES,
    RESAMPLED,
    STAMPS_BACK,
    TOO_LONG,
    WAYPOINTS,
)
from mrlab_ros.core.conversion.evidence.joining import first_path, picked_rows, rows_of
from mrlab_ros.core.conversion.evidence.survey import Survey, is_coarse
from mrlab_ros.core.conversion.layout import Layout
from mrlab_ros.core.conversion.options import Options
from mrlab_ros.core.conversion.picking import Chosen
from mrlab_ros.core.conversion.workspace import EARLIER, Variable, Workspace
from mrlab_ros.core.trajectory import gripper_states
from mrlab_ros.core.trajectory.trajectory import Array

MOST_FRAMES = 2_000_000  # of a message that is sampled: five hours and a half at 100 Hz
MOST_OWN_RATE = 10_000.0  # Hz; points that come more often are sampled at the default
# Hz and rad (m): rows that come more slowly and are farther apart are waypoints
WAYPOINT_RATE, WAYPOINT_STEP = 10.0, 0.1
TIMES_IN_MATLAB = "t = 2 * (0:size(q, 1) - 1)'; save('traj.mat', 'q', 't', '-v7')"

Nanoseconds = NDArray[np.int64]
# ns; how far a point may lie from a frame and be that frame: both are rounded to whole ns
# a pause: s, and how many usual steps; of a motion of so many steps
PAUSE, MANY_STEPS, FEWEST_STEPS = 1.0, 20, 20
SAME_TIME_NS = 1


def even_rate(times_ns: Nanoseconds) -> float | None:
    """Return the rate, Hz, of points in even steps, None where their steps differ.

    times_ns: (K,), strictly rising. Even means that each point is within a nanosecond or two of
    where the rate puts it, which is how finely a message can say it.
    """
    elapsed = times_ns - times_ns[0]
    rate = (len(elapsed) - 1) * 1e9 / float(elapsed[-1])
    if abs(rate - round(rate)) < 1e-6 * rate:
        rate = float(round(rate))
    expected = np.arange(len(elapsed)) * (1e9 / rate)
    return rate if np.abs(elapsed - expected).max() <= 2 * SAME_TIME_NS else None


def frame_count(times_ns: Nanoseconds, rate: float) -> int:
    """Return how many frames at `rate` Hz reach from the first point to the last or just past."""
    duration = (int(times_ns[-1]) - int(times_ns[0]) - SAME_TIME_NS) * 1e-9
    return int(np.ceil(duration * rate)) + 1


def _segments(times_ns: Nanoseconds, rate: float) -> tuple[NDArray[np.intp], Array]:
    """Return for each frame the point that it follows, and the time since that point, s.

    A frame within SAME_TIME_NS of a point follows that point by 0; frames past the last point
    are at the last point.
    """
    frames = np.arange(frame_count(times_ns, rate))
    at_ns = np.minimum(np.rint(frames * (1e9 / rate)).astype(np.int64) + times_ns[0], times_ns[-1])
    follows = np.searchsorted(times_ns, at_ns + SAME_TIME_NS, side="right") - 1
    since_ns = at_ns - times_ns[follows]
    since_ns[np.abs(since_ns) <= SAME_TIME_NS] = 0
    return follows, since_ns * 1e-9


def resample(
    times_ns: Nanoseconds, positions: Array, velocities: Array | None, rate: float
) -> Array:
    """Return the positions, (N, J), at every 1 / rate s from the first point on.

    times_ns: (K,), strictly rising; positions: (K, J); velocities: (K, J) in the positions' unit
    a second, or None. Straight lines between points, or cubic Hermite splines where there are
    velocities. A frame at a point has exactly the point's positions; the last frame has those of
    the last point, which lies less than 1 / rate s before it.
    """
    follows, since = _segments(times_ns, rate)
    frames = positions[follows]
    between = np.flatnonzero(since)
    start = follows[between]
    step = (np.diff(times_ns) * 1e-9)[start, np.newaxis]
    s = since[between, np.newaxis] / step
    p0, p1 = positions[start], positions[start + 1]
    if velocities is None:
        frames[between] = p0 + s * (p1 - p0)
        return frames
    # Hermite's cubic: p(0) = p0, p(1) = p1, p'(0) = m0, p'(1) = m1
    m0, m1 = velocities[start] * step, velocities[start + 1] * step
    a, b = 2 * (p0 - p1) + m0 + m1, 3 * (p1 - p0) - 2 * m0 - m1
    frames[between] = ((a * s + b) * s + m0) * s + p0
    return frames


def hold(times_ns: Nanoseconds, states: NDArray[np.bool_], rate: float) -> NDArray[np.bool_]:
    """Return the states, (N,), at every 1 / rate s: each stays until the next point."""
    return gripper_states.states_at(states, _segments(times_ns, rate)[0])


def at_a_rate(
    survey: Survey,
    chosen: Chosen,
    layout: Layout,
    options: Options,
    default: float,
    file: str,
    notes: list[Diagnostic],
) -> tuple[Layout, float]:
    """Return the samples as frames at an even rate, and that rate, Hz."""
    variable = chosen.variable
    if variable.is_message:
        return _resampled(survey.workspace, variable, layout, options, default, notes)
    rows = len(layout.arm)
    if options.frame_rate and not options.resample:
        notes += _waypoints(variable.path, layout.arm, options.frame_rate, timed=False)
        return layout, options.frame_rate
    # what the options took of the matrix, in rad; with a column of time or in degrees all is far
    assessment = replace(survey.of(variable), coarse=is_coarse(layout.arm))
    if np.any(layout.scale != 1.0):
        # a derivative in rad/s of positions in another unit says nothing of the rate
        assessment = replace(assessment, rates=())
    found = frame_rate.find(survey, assessment, variable.path, rows, layout.times, default, file)
    if not options.resample:
        notes += found.notes
        assumed = any(n.code == RATE_DEFAULT.code for n in found.notes)
        notes += _waypoints(
            variable.path, layout.arm, found.rate, timed=not assumed, assumed=assumed
        )
        return layout, found.rate
    return _made_even(variable.path, found, layout, options, default, notes)


def _too_long(path: str, *, duration: float, rate: float) -> Diagnostic:
    """Return what is said of rows that last too long for a rate: s, Hz."""
    lower = 0.99 * (MOST_FRAMES - 1) / duration
    found = TOO_LONG(variable=path, most=MOST_FRAMES, duration=duration, rate=rate, lower=lower)
    # below that a gap is the fault, and no rate mends it
    return found if lower >= 1 else replace(found, fixes=())


def _waypoints(
    path: str, arm: NDArray[Any], rate: float, *, timed: bool, assumed: bool = False
) -> list[Diagnostic]:
    """Return a warning where rows are so far apart that they are waypoints rather than samples.

    timed: the file says when the rows are reached. assumed: it does not say their rate either.
    """
    if rate > WAYPOINT_RATE and not assumed:
        return []
    steps = np.abs(np.diff(arm, axis=0)).max(axis=1)
    worst = int(steps.argmax())
    least = float(np.median(steps)) if rate > WAYPOINT_RATE else steps[worst]
    if least <= WAYPOINT_STEP:
        return []
    found = WAYPOINTS(
        variable=path,
        rate=rate,
        value=float(steps[worst]),
        unit="rad",
        limit=WAYPOINT_STEP,
        first_row=worst + 2,
        last_row=worst + 2,
    )
    return [found if timed else replace(found, fixes=(Fix(matlab=TIMES_IN_MATLAB),))]


def _made_even(
    path: str,
    found: frame_rate.Rate,
    layout: Layout,
    options: Options,
    default: float,
    notes: list[Diagnostic],
) -> tuple[Layout, float]:
    """Return rows at times of their own as frames at an even rate, joined by straight lines.

    Waypoints become frames at the rate that was asked for, else at `default`, Hz.
    """
    clock = found.clock
    if clock is None and any(n.code == RATE_DEFAULT.code for n in found.notes):
        fixes = (Fix(matlab=TIMES_IN_MATLAB), Fix("resample", "", ""))
        raise BadInput(NO_TIMES(variable=path, fixes=fixes))
    if clock is None:
        times = np.arange(len(layout.arm)) / found.rate
        even = found.rate
        notes += found.notes
    else:
        flaws = rate_findings.flaws(clock)
        if clock.backward:
            raise BadInput(replace(flaws[0], severity=Severity.ERROR))
        notes += [n for n in found.notes if n not in flaws and not n.code.startswith("time_")]
        times, even = clock.times, frame_rate.resampling_rate(clock)
    if even <= WAYPOINT_RATE:
        even = default
    times_ns = np.rint(times * 1e9).astype(np.int64)
    kept = np.flatnonzero(np.diff(times_ns, prepend=times_ns[0] - 1) > 0)
    times_ns = times_ns[kept]
    rate = options.frame_rate or even
    frames = frame_count(times_ns, rate)
    words: dict[str, Any] = {"duration": float(times_ns[-1]) * 1e-9, "rate": rate}
    if frames > MOST_FRAMES:
        raise BadInput(_too_long(path, **words))
    words |= {"points": len(times_ns), "frames": frames, "curve": "lines"}
    notes.append(RESAMPLED(variable=path, **words))
    arm = resample(times_ns, layout.arm[kept], None, rate)
    gripper = layout.gripper
    if gripper is not None:
        gripper = hold(times_ns, gripper[kept], rate)
    return replace(layout, arm=arm, gripper=gripper), rate


def _resampled(
    workspace: Workspace,
    variable: Variable,
    layout: Layout,
    options: Options,
    default: float,
    notes: list[Diagnostic],
) -> tuple[Layout, float]:
    """Return the points of a message as frames.

    The rate is the one asked for; else that of the points, where they come evenly and as often
    as the default or more, so that none is lost; else the default.
    """
    times = _part(workspace, variable, "time_from_start")
    assert times is not None
    times_ns = np.rint(times.reshape(-1).astype(np.float64) * 1e9).astype(np.int64)
    late = np.flatnonzero(np.diff(times_ns) <= 0)
    if len(late):
        point = int(late[0]) + 2
        why = LATE_POINT(point=point, time=float(times_ns[point - 1]) * 1e-9)
        raise BadInput(BAD_MESSAGE(variable=variable.path, why=why))
    notes += _interrupted(workspace, variable, times_ns)
    velocities = _part(workspace, variable, "velocities")
    if velocities is not None:
        velocities = velocities[:, layout.source_columns].astype(np.float64)
        bad = motion_checks.non_finite(velocities, f"{variable.path}.velocities")
        if bad is not None:
            raise BadInput(bad)
        velocities *= layout.scale
    own = even_rate(times_ns) or 0.0
    kept = own if default <= own <= MOST_OWN_RATE else default
    rate = options.frame_rate or kept
    frames = frame_count(times_ns, rate)
    duration = float(times_ns[-1] - times_ns[0]) * 1e-9
    words: dict[str, Any] = {"duration": duration, "rate": rate}
    if frames > MOST_FRAMES:
        raise BadInput(_too_long(variable.path, **words))
    curve = "lines" if velocities is None else "splines"
    words |= {"points": len(times_ns), "frames": frames, "curve": curve}
    notes.append(RESAMPLED(variable=variable.path, **words))
    arm = resample(times_ns, layout.arm, velocities, rate)
    gripper = layout.gripper
    if gripper is not None:
        gripper = hold(times_ns, gripper, rate)
    return replace(layout, arm=arm, gripper=gripper), rate


def _interrupted(
    workspace: Workspace, variable: Variable, times_ns: NDArray[np.int64]
) -> list[Diagnostic]:
    """Return the warnings of stamps that go back and of a long pause between two points."""
    notes = []
    earlier = workspace.find(f"{first_path(variable.path)}.{EARLIER}")
    count = 0.0 if earlier is None else workspace.scalar(earlier)
    if count:
        notes.append(STAMPS_BACK(variable=variable.path, count=int(count)))
    steps = np.diff(times_ns) * 1e-9
    if len(steps) >= FEWEST_STEPS and steps.max() >= max(PAUSE, MANY_STEPS * np.median(steps)):
        row = int(steps.argmax()) + 2
        words: dict[str, Any] = {"first_row": row, "last_row": row, "value": float(steps.max())}
        before = rows_of(variable.path, 1, row - 1)
        fixes = (Fix("variable", before, f"q = {before};"),)
        notes.append(RECORDING_PAUSES(variable=variable.path, unit="s", fixes=fixes, **words))
    return notes


def _part(workspace: Workspace, message: Variable, name: str) -> NDArray[Any] | None:
    """Return what stands beside the points of a message, of those rows that were picked."""
    whole = first_path(message.path)
    found = workspace.find(f"{whole}.{name}")
    if found is None or found.values is None:
        return None
    return (
        found.values if whole == message.path else found.values[picked_rows(message.path, found)]
    )
