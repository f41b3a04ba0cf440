"""Checks of a joint trajectory: that it is a motion, and within the limits of a robot."""

from __future__ import annotations

import itertools
import math
import re
from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mrlab_ros.core.base.diagnostic import Diagnostic, Fix
from mrlab_ros.core.conversion.diagnostics import (
    DISCONTINUITY,
    JOINT_LIMIT,
    JUMP_FULL_TURN,
    NON_FINITE,
    STRAY_ROWS,
    VELOCITY_LIMIT,
)
from mrlab_ros.core.conversion.evidence.joining import rows_but, rows_of
from mrlab_ros.core.conversion.options import LEAST_RATE
from mrlab_ros.core.robots.model import Joint, RobotModel
from mrlab_ros.core.trajectory.trajectory import Array

# rad; what a limit may be passed by, as its decimals in a data sheet are rounded
LIMIT_TOLERANCE = 1e-4
FULL_TURN = 2 * np.pi
# A jump is a step that is this many times what the joint could do between two frames,
JUMP_VELOCITY_FACTOR = 3.0
# and this many times the joint's own usual step (its 95th percentile),
JUMP_USUAL_FACTOR = 10.0
# and at least so large, rad.
JUMP_LEAST = 0.25
# A step of this many rad from a full turn is one (an arm moves on while its angle wraps).
TURN_TOLERANCE = 0.5
# a variable of a workspace, not a part or several joined
STORED = re.compile(r"[A-Za-z][\w.]*(?<!\.)")
MOST_PARTS = 4  # between jumps that are offered
# Rows between two jumps that are no part of the motion: at most so many beside one another,
MOST_STRAY = 5
# and at most this share of all.
STRAY_SHARE = 0.05
OF_STRAY = frozenset({"joint_limit", "velocity_limit"})  # that such rows lead to


# A variable that MATLAB can assign to, whole.
PLAIN = re.compile(r"[A-Za-z]\w*(\.[A-Za-z]\w*)*", re.ASCII)


def non_finite(values: NDArray[Any], variable: str) -> Diagnostic | None:
    """Return the finding where `values`, (N, d), hold NaN or Inf."""
    # The sum is finite unless something in it is not (or overflows, which the full look sorts
    # out), and needs no temporary of the matrix' size.
    with np.errstate(all="ignore"):
        if np.isfinite(values.sum(dtype=np.float64)):
            return None
    bad = np.argwhere(~np.isfinite(values))
    if not len(bad):
        return None
    rows = np.unique(bad[:, 0]) + 1
    return NON_FINITE(
        variable=variable,
        first_row=int(rows[0]),
        last_row=int(rows[-1]),
        column=int(bad[0, 1]) + 1,
        count=len(bad),
        rows=len(rows),
        of=len(values),
        fixes=_without(rows, len(values), variable),
    )


def _without(rows: NDArray[Any], count: int, variable: str) -> tuple[Fix, ...]:
    """Return what mends rows, from 1, that are not finite.

    Ends are left out, and rows inside where they are as few as those that stray. Rows inside are
    filled in MATLAB along a straight line between their neighbours: the motion keeps its time.
    """
    name = variable if PLAIN.fullmatch(variable) else "q"
    if count - len(rows) < 2:
        return (Fix(matlab=f"find(any(~isfinite({name}), 2)).'"),)
    parts = np.split(rows - 1, np.flatnonzero(np.diff(rows) > 1) + 1)
    runs = [(int(part[0]), int(part[-1])) for part in parts]
    begin = runs[0][1] + 1 if runs[0][0] == 0 else 0
    end = runs[-1][0] if runs[-1][1] == count - 1 else count
    if end - begin == count - len(rows):
        line = f"{name} = {name}({begin + 1}:{end}, :);"
        return (Fix("variable", rows_of(variable, begin + 1, end), line),)
    inside = [run for run in runs if begin <= run[0] < end]
    few = sum(b - a + 1 for a, b in inside) <= max(MOST_STRAY, STRAY_SHARE * count)
    out: tuple[Fix, ...] = ()
    if few and all(b - a < MOST_STRAY for a, b in inside) and not variable.startswith("/"):
        out = (Fix("variable", rows_but(variable, runs, count)),)
    filled = f"interp1(find(ok), {name}(ok, :), (1:size({name}, 1))')"
    return (
        *out,
        Fix(matlab=f"ok = all(isfinite({name}), 2); {name} = {filled};"),
    )


def against_robot(
    positions: Array, frame_rate: float, joints: Sequence[Joint], variable: str, robot: str
) -> list[Diagnostic]:
    """Check positions, (N, J) rad in the order of `joints`, sampled at `frame_rate` Hz.

    One finding a joint and kind at most, of its worst row.
    """
    findings: list[Diagnostic] = []
    jumps: set[int] = set()
    for column, joint in enumerate(joints):
        q = np.ascontiguousarray(positions[:, column])
        steps = _steps(q, joint, frame_rate, variable, robot)
        beyond = _range(q, column, joint, frame_rate, variable)
        # a full turn, or a jump, is why the joint leaves its range
        findings += [*steps, *beyond] if steps else beyond
        if any(found.code == "discontinuity" for found in steps):
            jumps |= _jumps(q, joint, frame_rate)
    stray = _stray(positions, sorted(jumps), frame_rate, joints)
    if stray:
        findings = [
            _as_stray(f, stray, len(positions), variable) if f.code == "discontinuity" else f
            for f in findings
            if not (f.code in OF_STRAY and _within(f, stray))
        ]
    elif jumps:
        parts = _between(sorted(jumps), len(positions), variable)
        findings = [replace(f, fixes=parts) if f.code == "discontinuity" else f for f in findings]
    return sorted(_at_one_rate(findings), key=lambda found: found.code != "jump_2pi")


def _at_one_rate(findings: list[Diagnostic]) -> list[Diagnostic]:
    """Return the findings, in which each joint that is too fast names the rate that suits all."""
    too_fast = [f for f in findings if f.code == "velocity_limit"]
    if not too_fast:
        return findings
    slower = min(float(f.values["slower"]) for f in too_fast)
    times = float(too_fast[0].values["rate"]) / slower
    said = []
    for found in too_fast:
        again = VELOCITY_LIMIT(**{**found.values, "slower": slower, "times": times})
        (fix,) = again.fixes
        line = fix.matlab.removeprefix("q = q; ")
        said.append(replace(again, fixes=(replace(fix, matlab=line),)))
    return [f for f in findings if f not in too_fast] + said


def with_own_times(finding: Diagnostic) -> Diagnostic:
    """Return a finding of frames that were made of points with times: no rate slows these."""
    if finding.code != "velocity_limit":
        return finding
    return VELOCITY_LIMIT(**{**finding.values, "rate": None, "slower": None}, fixes=())


def _range(
    q: Array, column: int, joint: Joint, frame_rate: float, variable: str
) -> list[Diagnostic]:
    lower, upper = joint.lower - LIMIT_TOLERANCE, joint.upper + LIMIT_TOLERANCE
    low, high = float(q.min()), float(q.max())
    if lower <= low and high <= upper:
        return []
    frame = int(q.argmin() if lower - low > high - upper else q.argmax())
    rows = np.flatnonzero((q < lower) | (q > upper))
    place = f"q(:, {column + 1})"
    look = f"find({place} < {joint.lower:.6g} | {place} > {joint.upper:.6g})"
    fixes = [Fix(matlab=look)]
    # a motion that begins inside and has no jump fits when it is made smaller
    begin, reach = float(q[0]), joint.max_velocity / frame_rate
    if joint.lower < begin < joint.upper and float(np.abs(np.diff(q)).max()) <= reach:
        part = min(
            (joint.upper - begin) / max(high - begin, joint.upper - begin),
            (begin - joint.lower) / max(begin - low, begin - joint.lower),
        )
        smaller = f"q(1, {column + 1})"
        line = f"{place} = {smaller} + {math.floor(part * 100) / 100:g} * ({place} - {smaller});"
        fixes.insert(0, Fix(matlab=line))
    return [
        JOINT_LIMIT(
            variable=variable,
            joint=joint.name,
            row=frame + 1,
            time=frame / frame_rate,
            lower=joint.lower,
            upper=joint.upper,
            count=len(rows),
            first_row=int(rows[0]) + 1,
            last_row=int(rows[-1]) + 1,
            value=float(q[frame]),
            limit=joint.upper if q[frame] > upper else joint.lower,
            unit="rad",
            fixes=tuple(fixes),
        )
    ]


def _steps(
    q: Array, joint: Joint, frame_rate: float, variable: str, robot: str
) -> list[Diagnostic]:
    steps = np.abs(np.diff(q))
    reach = joint.max_velocity / frame_rate
    frame = int(steps.argmax())
    largest = float(steps[frame])
    if not largest > reach * 1.01:
        return []
    place: dict[str, Any] = {
        "variable": variable,
        "joint": joint.name,
        "first_row": frame + 1,
        "last_row": frame + 2,
        "time": frame / frame_rate,
    }
    usual = float(np.quantile(steps, 0.95))
    isolated = largest > max(reach * JUMP_VELOCITY_FACTOR, usual * JUMP_USUAL_FACTOR, JUMP_LEAST)
    # a joint may wrap every other sample: such jumps are no usual steps
    turned = abs(largest - FULL_TURN) < TURN_TOLERANCE and largest > reach * JUMP_VELOCITY_FACTOR
    moved_on = abs(largest - FULL_TURN) <= reach
    if turned and (isolated or moved_on or _wraps(q)):
        return [JUMP_FULL_TURN(value=largest, limit=reach, unit="rad", **place)]
    # A handful of waypoints has no usual step that one could stand out from.
    if isolated and len(steps) >= 10:
        return [DISCONTINUITY(value=largest, limit=reach, unit="rad", usual=usual, **place)]
    too_fast = int(np.count_nonzero(steps > reach * 1.01))
    return [
        VELOCITY_LIMIT(
            value=largest * frame_rate,
            limit=joint.max_velocity,
            unit="rad/s",
            rate=frame_rate,
            slower=_slower(joint.max_velocity / largest),
            times=largest / reach,
            model=robot,
            count=too_fast,
            **place,
        )
    ]


def _slower(rate: float) -> float:
    """Return a rate, Hz, with two digits that is not above `rate`."""
    if rate <= LEAST_RATE:
        return LEAST_RATE
    digit = 10.0 ** (math.floor(math.log10(rate)) - 1)
    return max(float(f"{math.floor(rate / digit + 1e-9) * digit:.2g}"), LEAST_RATE)


def _wraps(q: Array) -> bool:
    """Say whether angles stay between -pi and pi and jump from one to the other."""
    return bool(np.abs(q).max() <= np.pi + 0.01 and np.ptp(q) > FULL_TURN - TURN_TOLERANCE)


def _jumps(q: Array, joint: Joint, frame_rate: float) -> set[int]:
    """Return the frames after which a joint jumps, as the largest of its steps does."""
    steps = np.abs(np.diff(q))
    return {int(frame) for frame in np.flatnonzero(steps > _least_jump(q, joint, frame_rate))}


def _least_jump(q: Array, joint: Joint, frame_rate: float) -> float:
    """Return above how many rad a step of a joint's angles is a jump."""
    usual = float(np.quantile(np.abs(np.diff(q)), 0.95))
    reach = joint.max_velocity / frame_rate
    return max(reach * JUMP_VELOCITY_FACTOR, usual * JUMP_USUAL_FACTOR, JUMP_LEAST)


def _stray(
    positions: Array, jumps: list[int], frame_rate: float, joints: Sequence[Joint]
) -> list[tuple[int, int]]:
    """Return the first and last frame of each few that joints jump to and back from.

    None unless the motion goes on without them as if they had never been there.
    """
    runs = [(a + 1, b) for a, b in itertools.pairwise(jumps) if b - a <= MOST_STRAY]
    rows = [row for first, last in runs for row in range(first, last + 1)]
    if not rows or len(rows) > max(MOST_STRAY, STRAY_SHARE * len(positions)):
        return []
    kept = np.delete(positions, rows, axis=0)
    whole = all(
        np.abs(np.diff(kept[:, column])).max()
        <= _least_jump(positions[:, column], joint, frame_rate)
        for column, joint in enumerate(joints)
    )
    return runs if whole else []


def _within(found: Diagnostic, runs: list[tuple[int, int]]) -> bool:
    """Say whether a finding is about stray frames alone, or a step to or from them."""
    return any(a <= found.first_row and found.last_row <= b + 2 for a, b in runs)


def _as_stray(
    jump: Diagnostic, runs: list[tuple[int, int]], count: int, variable: str
) -> Diagnostic:
    """Return a jump as the rows that stray, with what leaves them out or puts others in."""
    first, last = next(
        (run for run in runs if jump.first_row - 1 in (run[0] - 1, run[1])), runs[0]
    )
    name = variable if STORED.fullmatch(variable) else "q"
    # of a message, which is resampled, rows are points
    leave_out = () if variable.startswith("/") else (rows_but(variable, runs, count),)
    line = " ".join(
        f"{name}({a}:{b}, :) = interp1([{a - 1} {b + 1}], {name}([{a - 1} {b + 1}], :), {a}:{b});"
        if b > a
        else f"{name}({a}, :) = mean({name}([{a - 1} {a + 1}], :));"
        for a, b in ((a + 1, b + 1) for a, b in runs)
    )
    return STRAY_ROWS(
        variable=variable,
        joint=jump.joint,
        value=jump.value,
        unit=jump.unit,
        limit=jump.limit,
        time=jump.values["time"],
        first_row=first + 1,
        last_row=last + 1,
        count=sum(b - a + 1 for a, b in runs),
        fixes=(*(Fix("variable", path) for path in leave_out), Fix(matlab=line)),
    )


def _between(jumps: list[int], rows: int, variable: str) -> tuple[Fix, ...]:
    """Return what takes one of the parts between jumps after those frames, the longest first."""
    ends = [-1, *jumps, rows - 1]
    pieces = [(a + 2, b + 1) for a, b in itertools.pairwise(ends) if b - a >= 2]
    pieces.sort(key=lambda piece: piece[0] - piece[1])
    # of a message, which is resampled, rows are points and a jump lies between frames
    if not pieces or variable.startswith("/"):
        return (Fix(matlab=f"plot(diff({variable}))"),)
    fixes = []
    for first, last in pieces[:MOST_PARTS]:
        path = rows_of(variable, first, last)
        # What is stored is shortened where it is: under another name it would be something else.
        name = variable if STORED.fullmatch(variable) else "q"
        is_stored = ".." not in variable and variable[0].isalpha()
        part = path if is_stored else f"q({first}:{last}, :)"
        fixes.append(Fix("variable", path, f"{name} = {part};"))
    return tuple(fixes)


def of_columns(finding: Diagnostic) -> Diagnostic:
    """Return a finding whose fixes that name rows name columns: samples are columns here."""
    fixes = (
        replace(
            fix,
            value=re.sub(r"\(([^()]*), :\)$", r"(:, \1)", fix.value),
            matlab=re.sub(r"^(?=(\w+)[ (][^;]*=[^;]*\b\1\b)", r"\1 = \1.'; ", fix.matlab),
        )
        for fix in finding.fixes
    )
    return replace(finding, fixes=tuple(fixes))


# Rows that are as far apart as any two: the mean square of the steps over twice the variance is 1
# for random rows and far below it for a motion (von Neumann's ratio).
RANDOM = 0.5
ENOUGH_ROWS = 50
LEAST_STEP = 0.2  # rad; smaller steps are noise
MOSTLY = 0.5  # share of the steps that are too fast
SAME_PLACE, JUMPING = 2e-3, 0.3  # m and rad
SAMPLE = 4000


def fault(arm: Array, rate: float, robot: RobotModel) -> str:
    """Return why joint positions, (N, J) rad at `rate` Hz, are no motion: random, pose, or empty.

    Rows that a robot could follow at that rate are a motion, in whatever order they come.
    """
    steps = np.abs(np.diff(arm[:SAMPLE], axis=0))
    fastest = np.array([joint.max_velocity for joint in robot.joints])
    too_fast = (steps * rate > fastest).any(axis=1)
    if not len(steps) or np.count_nonzero(too_fast) < MOSTLY * len(steps):
        return ""
    if float(np.median(steps.max(axis=1))) < LEAST_STEP:
        return ""
    if len(arm) >= ENOUGH_ROWS:
        spread = arm[:SAMPLE].var(axis=0)
        moving = spread > 1e-6
        ratio = (steps[:, moving] ** 2).mean(axis=0) / (2 * spread[moving])
        return "random" if moving.any() and float(ratio.mean()) > RANDOM else ""
    if robot.chain is None or len(arm) < 3:
        return ""
    places = robot.chain.tool0(arm)[:, :3, 3]
    jumps = float(steps.max(axis=1).min()) > JUMPING
    return "pose" if jumps and float(np.ptp(places, axis=0).max()) < SAME_PLACE else ""
