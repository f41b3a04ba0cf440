"""A goal of joint points, as MoveIt sends one, made into a trajectory from where the arm stands.

What is checked and how it is interpolated is what ros2_controllers' joint_trajectory_controller
does: linear between positions, cubic with velocities, quintic with accelerations as well. Limits
are checked beyond that, and an arm that moves changes its velocity without a jump also where the
points have positions alone.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from enum import Enum
from itertools import pairwise

import numpy as np

from mrlab_ros.core.base.clock import SECOND
from mrlab_ros.core.base.diagnostic import Diagnostic
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.base.geometry import Array
from mrlab_ros.core.playback import diagnostics as say
from mrlab_ros.core.robots.model import RobotModel
from mrlab_ros.core.trajectory.trajectory import Channels, Source, Trajectory

# Joint states a second.
FRAME_RATE = 100.0
# The longest goal, s.
LONGEST = 600.0
# Rounding that a joint's limits allow for: rad (m), and share of the velocity limit.
AT_LIMIT = 1e-6
VELOCITY_SLACK = 0.01
# How fast an arm that moves takes on the velocity of a goal without velocities, rad/s^2 (m/s^2).
BLEND_ACCELERATION = 6.0
# How far a first point that is due at once may be from the arm, rad (m); of an arm that moves also
# the way that it went since its client measured it, s.
AT_START, MEASURED_S = 0.1, 0.5
# A last velocity below this is standstill, rad/s.
STANDSTILL = 1e-4
# No trajectory of the catalogue has version 0: this one cannot be fetched there.
UNPUBLISHED = 0
FOLLOWED = "follow_joint_trajectory"


class Code(Enum):
    """Why a goal ended; the values are those of control_msgs/FollowJointTrajectory."""

    SUCCESSFUL = 0
    INVALID_GOAL = -1
    INVALID_JOINTS = -2
    OLD_HEADER_TIMESTAMP = -3
    PATH_TOLERANCE_VIOLATED = -4
    GOAL_TOLERANCE_VIOLATED = -5


class WrongGoal(BadInput):
    """A goal that cannot be carried out."""

    def __init__(self, said: Diagnostic, code: Code = Code.INVALID_GOAL) -> None:
        super().__init__(said)
        self.code = code


@dataclass(frozen=True)
class Point:
    """The joints at `time` (s from the goal's start); rad, rad/s, rad/s^2, or none."""

    time: float
    positions: Sequence[float]
    velocities: Sequence[float] = ()
    accelerations: Sequence[float] = ()
    effort: Sequence[float] = ()


@dataclass(frozen=True)
class Goal:
    """joint_names: the order of the points' values. stamp_ns: of the start; 0: now."""

    joint_names: Sequence[str]
    points: Sequence[Point]
    stamp_ns: int = 0


def trajectory(
    goal: Goal, model: RobotModel, arm: Array, now_ns: int, velocities: Array | None = None
) -> Trajectory:
    """Return what leads from `arm`, (J,) rad, at `now_ns` along the goal's points.

    velocities: (J,) rad/s, of the arm at `now_ns`; None: it stands. The way to the first point
    takes the time until then, also where the goal's start lies ahead. A first of several points
    that is due at once must be where the arm is. Of a goal whose start has passed, what lies ahead
    is left. Raises WrongGoal.
    """
    moving = np.zeros_like(arm) if velocities is None else velocities
    places = order(goal.joint_names, model)
    if not goal.points:
        raise WrongGoal(say.NO_POINTS())
    times = np.array([point.time for point in goal.points])
    _check_times(times)
    rows = {
        kind: _rows(goal.points, kind, places, model)
        for kind in ("positions", "velocities", "accelerations")
    }
    if any(point.effort for point in goal.points):
        raise WrongGoal(say.HAS_EFFORTS())
    positions = rows["positions"]
    if positions is None:
        raise WrongGoal(say.NO_POSITIONS())
    for number, row in enumerate(positions, 1):
        check_limits(row, model, point=number)
    speeds = rows["velocities"]
    if speeds is not None and np.abs(speeds[-1]).max() > STANDSTILL:
        joint = int(np.abs(speeds[-1]).argmax())
        velocity = float(speeds[-1][joint])
        raise WrongGoal(say.ENDS_MOVING(joint=model.joint_names[joint], value=velocity))
    passed = (now_ns - (goal.stamp_ns or now_ns)) / SECOND
    if passed > times[-1]:
        over = say.GOAL_OVER(ago=float(passed - times[-1]))
        raise WrongGoal(over, Code.OLD_HEADER_TIMESTAMP)
    if len(times) > 1 and times[0] == passed == 0:
        _check_start(positions[0] - arm, moving, model)
    times = times - passed
    if times[-1] > LONGEST:
        raise WrongGoal(say.GOAL_TOO_LONG(duration=float(times[-1]), longest=LONGEST))
    ahead = times > 0
    if not ahead.any():
        # One point at 0, which JTC takes as a set-point; here only a small step is one.
        ahead[-1] = True
    knots = np.concatenate([[0.0], np.maximum(times[ahead], 1 / FRAME_RATE)])
    frames, along = _sampled(
        knots,
        np.vstack([arm, positions[ahead]]),
        None if speeds is None else np.vstack([moving, speeds[ahead]]),
        None
        if speeds is None or rows["accelerations"] is None
        else np.vstack([np.zeros_like(arm), rows["accelerations"][ahead]]),
    )
    if speeds is None and moving.any():
        _blend(frames, along, moving, knots[1], positions[ahead][0])
    _check_motion(frames, along, model)
    return unpublished(FOLLOWED, model, frames, along)


def _check_start(away: Array, moving: Array, model: RobotModel) -> None:
    """Raise WrongGoal where the first point is further from the arm than it can have moved.

    away, moving: (J,) rad and rad/s.
    """
    allowed = AT_START + MEASURED_S * np.abs(moving)
    joint = int((np.abs(away) - allowed).argmax())
    if abs(away[joint]) > allowed[joint]:
        raise WrongGoal(
            say.STARTS_ELSEWHERE(
                joint=model.joint_names[joint],
                value=float(abs(away[joint])),
                limit=float(allowed[joint]),
            ),
            Code.PATH_TOLERANCE_VIOLATED,
        )


def unpublished(name: str, model: RobotModel, positions: Array, velocities: Array) -> Trajectory:
    """Return a trajectory that no catalogue has; positions and velocities are (N, J)."""
    return Trajectory(
        id=name,
        robot_model=model.id,
        end_effector=None,
        joint_names=model.joint_names,
        frame_rate=FRAME_RATE,
        positions=positions,
        gripper=None,
        channels=Channels(velocities, np.zeros_like(positions)),
        source=Source("", "", ""),
        version=UNPUBLISHED,
    )


def check_limits(
    positions: Array, model: RobotModel, point: int | None = None, time: float | None = None
) -> None:
    """Raise WrongGoal where a joint of `positions`, (J,) rad, is beyond its limits, or none.

    point: counted from 1; time: s between two points. None: of a joint command.
    """
    for joint, value in zip(model.joints, positions.tolist(), strict=True):
        if not joint.lower - AT_LIMIT <= value <= joint.upper + AT_LIMIT:
            raise WrongGoal(
                say.JOINT_OUT_OF_RANGE(
                    joint=joint.name,
                    value=value,
                    lower=joint.lower,
                    upper=joint.upper,
                    point=point,
                    time=time,
                )
            )


def order(names: Sequence[str], model: RobotModel) -> list[int]:
    """Return for each joint of the model its place in `names`; raise WrongGoal."""
    known = model.joint_names
    if sorted(names) != sorted(known):
        wrong = say.WRONG_JOINT_NAMES(
            missing=[joint for joint in known if joint not in names],
            unknown=[name for name in names if name not in known],
            repeated=sorted({name for name in names if list(names).count(name) > 1}),
            expected=known,
        )
        raise WrongGoal(wrong, Code.INVALID_JOINTS)
    return [list(names).index(joint) for joint in known]


def _check_times(times: Array) -> None:
    if not np.isfinite(times).all() or times[0] < 0:
        raise WrongGoal(say.BAD_FIRST_TIME(time=float(times[0])))
    for number, (before, after) in enumerate(pairwise(times.tolist()), 1):
        if after <= before:
            raise WrongGoal(say.TIMES_NOT_RISING(point=number, before=before, after=after))


def _rows(
    points: Sequence[Point], kind: str, places: list[int], model: RobotModel
) -> Array | None:
    """Return the values of all points, (N, J) in the model's order; None where none has any."""
    values = [list(getattr(point, kind)) for point in points]
    if not any(values):
        return None
    for number, row in enumerate(values, 1):
        if len(row) != len(places):
            raise WrongGoal(
                say.WRONG_VALUE_COUNT(
                    found=len(row), what=kind, expected=len(places), point=number
                )
            )
    rows = np.array(values, dtype=np.float64)[:, places]
    if not np.isfinite(rows).all():
        number, joint = np.argwhere(~np.isfinite(rows))[0].tolist()
        name = model.joint_names[joint]
        raise WrongGoal(say.VALUE_NOT_FINITE(joint=name, what=kind, point=number + 1))
    return rows


def _check_motion(frames: Array, speeds: Array, model: RobotModel) -> None:
    """Raise WrongGoal where the arm would leave a limit or be too fast between the points."""
    most = np.array([joint.max_velocity for joint in model.joints])
    steps = np.abs(np.diff(frames, axis=0)) * FRAME_RATE
    fastest = np.maximum(steps, np.abs(speeds[1:]))
    if (fastest > most * (1 + VELOCITY_SLACK)).any():
        frame, joint = np.unravel_index(int((fastest / most).argmax()), fastest.shape)
        raise WrongGoal(
            say.GOAL_TOO_FAST(
                joint=model.joint_names[joint],
                value=float(fastest[frame, joint]),
                limit=float(most[joint]),
                time=float(frame + 1) / FRAME_RATE,
            )
        )
    for frame in (frames.argmax(axis=0).tolist()) + (frames.argmin(axis=0).tolist()):
        if frame:
            check_limits(frames[frame], model, time=frame / FRAME_RATE)


def _sampled(
    knots: Array, positions: Array, velocities: Array | None, accelerations: Array | None
) -> tuple[Array, Array]:
    """Return positions and velocities (N, J) at the frame rate; it ends with the last knot."""
    count = max(int(np.ceil(knots[-1] * FRAME_RATE - 1e-9)), 1)
    at = np.minimum(np.arange(count + 1) / FRAME_RATE, knots[-1])
    segment = np.clip(np.searchsorted(knots, at, side="right") - 1, 0, len(knots) - 2)
    length = np.diff(knots)[segment][:, None]
    s = (at - knots[segment])[:, None] / length
    p0, p1 = positions[segment], positions[segment + 1]
    if velocities is None:
        frames, speeds = p0 + s * (p1 - p0), (p1 - p0) / length
        speeds[0] = speeds[-1] = 0.0
    else:
        v0, v1 = velocities[segment] * length, velocities[segment + 1] * length
        if accelerations is None:
            way = p1 - p0
            b, c = 3 * way - 2 * v0 - v1, v0 + v1 - 2 * way
            frames = p0 + s * (v0 + s * (b + s * c))
            speeds = (v0 + s * (2 * b + s * 3 * c)) / length
        else:
            a0 = accelerations[segment] * length**2
            a1 = accelerations[segment + 1] * length**2
            way = p1 - p0
            c3 = 10 * way - 6 * v0 - 4 * v1 - 1.5 * a0 + 0.5 * a1
            c4 = -15 * way + 8 * v0 + 7 * v1 + 1.5 * a0 - a1
            c5 = 6 * way - 3 * (v0 + v1) - 0.5 * (a0 - a1)
            frames = p0 + s * (v0 + s * (a0 / 2 + s * (c3 + s * (c4 + s * c5))))
            speeds = (v0 + s * (a0 + s * (3 * c3 + s * (4 * c4 + s * 5 * c5)))) / length
    frames[0], frames[-1] = positions[0], positions[-1]
    return frames, speeds


def _blend(frames: Array, speeds: Array, moving: Array, end: float, point: Array) -> None:
    """Begin the straight line to `point`, (J,) rad at `end` s, with the velocities `moving`.

    frames, speeds: (N, J), changed in place. The velocity changes evenly, then stays, so that the
    arm is at the point in time and no joint is faster than before or after.
    """
    way = point - frames[0]
    change = np.maximum(np.abs(moving), np.abs(way / end - moving)).max()
    lasts = min(change / BLEND_ACCELERATION, end)
    after = (way - moving * lasts / 2) / (end - lasts / 2)
    count = int(np.searchsorted(np.arange(len(frames)) / FRAME_RATE, end - 1e-9))
    at = (np.arange(count) / FRAME_RATE)[:, None]
    bends = at < lasts
    share = at / lasts
    frames[:count] = np.where(
        bends,
        frames[0] + at * (moving + share * (after - moving) / 2),
        point - after * (end - at),
    )
    speeds[:count] = np.where(bends, moving + share * (after - moving), after)
