"""Goals of joint points: what is refused, and what the trajectory made of them is."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from refusals import refused

from mrlab_ros.adapters.robots.library import RobotLibrary
from mrlab_ros.core.base.clock import SECOND
from mrlab_ros.core.playback import diagnostics as say
from mrlab_ros.core.playback.goal import (
    AT_LIMIT,
    AT_START,
    FRAME_RATE,
    LONGEST,
    STANDSTILL,
    Code,
    Goal,
    Point,
    WrongGoal,
    check_limits,
    trajectory,
)

UR5E = RobotLibrary(Path(__file__).parents[4] / "robots", Path("/nowhere")).model("ur5e")
ARM = UR5E.home
NOW = 1_000 * SECOND


def points(*at: tuple[float, float], speeds: list[float] | None = None) -> list[Point]:
    """Return points (time, rad that every joint is from where the arm stands)."""
    return [
        Point(time, (ARM + way).tolist(), () if speeds is None else [speeds[i]] * 6)
        for i, (time, way) in enumerate(at)
    ]


def goal(*at: tuple[float, float], **changes: object) -> Goal:
    return replace(Goal(UR5E.joint_names, points(*at)), **changes)  # type: ignore[arg-type]


def test_points_without_velocities_are_joined_by_straight_lines() -> None:
    found = trajectory(goal((1.0, 0.5), (2.0, 0.2)), UR5E, ARM, NOW)
    assert found.frame_count == 201
    assert found.positions[0] == pytest.approx(ARM)
    assert found.positions[50] == pytest.approx(ARM + 0.25)
    assert found.positions[100] == pytest.approx(ARM + 0.5)
    assert (found.positions[-1] == ARM + 0.2).all(), "ends exactly at the last point"


def test_a_first_point_that_is_due_at_once_is_where_the_arm_is() -> None:
    with refused(say.STARTS_ELSEWHERE, WrongGoal, limit=AT_START) as found:
        trajectory(goal((0.0, 0.5), (1.0, 0.2)), UR5E, ARM, NOW)
    assert isinstance(found.value, WrongGoal)
    assert found.value.code is Code.PATH_TOLERANCE_VIOLATED
    measured = trajectory(goal((0.0, 0.01), (1.0, 0.2)), UR5E, ARM, NOW)
    assert measured.positions[0] == pytest.approx(ARM)
    moving = np.full(6, 0.5)
    assert trajectory(goal((0.0, -0.2), (1.0, 0.2)), UR5E, ARM, NOW, moving).frame_count == 101
    ahead = goal((0.0, 0.5), (1.0, 0.2), stamp_ns=NOW + SECOND)
    assert trajectory(ahead, UR5E, ARM, NOW).positions[100] == pytest.approx(ARM + 0.5)


def test_velocities_make_the_way_cubic_and_accelerations_quintic() -> None:
    smooth = replace(goal(), points=points((1.0, 0.5), (2.0, 0.0), speeds=[0.0, 0.0]))
    found = trajectory(smooth, UR5E, ARM, NOW)
    assert found.positions[50] == pytest.approx(ARM + 0.25)
    assert found.positions[25] == pytest.approx(ARM + 0.5 * (3 / 16 - 2 / 64))
    with_accelerations = [replace(p, accelerations=[0.0] * 6) for p in smooth.points]
    found = trajectory(replace(smooth, points=with_accelerations), UR5E, ARM, NOW)
    s = 0.25
    assert found.positions[25] == pytest.approx(ARM + 0.5 * (10 * s**3 - 15 * s**4 + 6 * s**5))
    numeric = np.gradient(found.positions, 1 / FRAME_RATE, axis=0)
    assert found.channels.velocities[1:-1] == pytest.approx(numeric[1:-1], abs=1e-2)


def test_the_joints_may_come_in_any_order() -> None:
    turned = [replace(p, positions=list(p.positions)[::-1]) for p in points((1.0, 0.3))]
    found = trajectory(Goal(UR5E.joint_names[::-1], turned), UR5E, ARM, NOW)
    assert found.positions[-1] == pytest.approx(ARM + 0.3)


def test_a_goal_in_the_future_takes_until_then_and_one_that_began_goes_on_from_there() -> None:
    found = trajectory(goal((0.0, 0.0), (1.0, 0.1), stamp_ns=NOW + SECOND), UR5E, ARM, NOW)
    assert found.duration == pytest.approx(2.0)
    assert found.positions[100] == pytest.approx(ARM), "waits at the first point"
    assert found.positions[-1] == pytest.approx(ARM + 0.1)
    late = goal((1.0, 0.1), (2.0, 0.2), (3.0, 0.3), stamp_ns=NOW - 3 * SECOND // 2)
    found = trajectory(late, UR5E, ARM, NOW)
    assert found.duration == pytest.approx(1.5)
    assert found.positions[50] == pytest.approx(ARM + 0.2)


def test_a_first_point_at_zero_is_where_the_arm_is() -> None:
    found = trajectory(goal((0.0, 0.001), (1.0, 0.2)), UR5E, ARM, NOW)
    assert found.positions[0] == pytest.approx(ARM)
    assert found.positions[-1] == pytest.approx(ARM + 0.2)


@pytest.mark.parametrize("speeds", [None, [0.1, 0.0]])
@pytest.mark.parametrize("accelerations", [None, 0.0])
@pytest.mark.parametrize("moving", [0.5, -0.5])
def test_an_arm_that_moves_is_taken_over_without_a_jump(speeds, accelerations, moving) -> None:
    at = points((1.0, 0.3), (2.0, 0.4), speeds=speeds)
    if accelerations is not None:
        at = [replace(p, accelerations=[accelerations] * 6) for p in at]
    velocities = np.full(6, moving)
    found = trajectory(Goal(UR5E.joint_names, at), UR5E, ARM, NOW, velocities)
    assert found.positions[100] == pytest.approx(ARM + 0.3), "is at the first point in time"
    way = np.diff(found.positions, axis=0)
    numeric = way * FRAME_RATE
    assert found.channels.velocities[0] == pytest.approx(velocities)
    assert numeric[0] == pytest.approx(velocities, abs=0.1)
    changes = np.abs(np.diff(numeric, axis=0))
    assert changes[:98].max() < 0.1, "no joint's velocity jumps"
    middle = (found.channels.velocities[:-1] + found.channels.velocities[1:]) / 2
    assert numeric[:99] == pytest.approx(middle[:99], abs=0.02)


def test_an_arm_that_would_swing_past_a_limit_or_be_too_fast_is_refused() -> None:
    near = ARM.copy()
    near[2] = UR5E.joints[2].upper - 0.01
    there = Goal(UR5E.joint_names, [Point(1.0, near.tolist())])
    with refused(say.JOINT_OUT_OF_RANGE, WrongGoal, joint=UR5E.joint_names[2], time=0.15):
        trajectory(there, UR5E, near, NOW, np.full(6, 1.0))
    with refused(say.GOAL_TOO_FAST, WrongGoal):
        trajectory(goal((0.05, 0.05)), UR5E, ARM, NOW, np.full(6, -3.0))


NAN = float("nan")
PAN = UR5E.joint_names[0]
BAD = [
    (Goal(UR5E.joint_names, []), Code.INVALID_GOAL, say.NO_POINTS, {}),
    (
        Goal([], points((1, 0))),
        Code.INVALID_JOINTS,
        say.WRONG_JOINT_NAMES,
        {"missing": UR5E.joint_names},
    ),
    (
        Goal([*UR5E.joint_names[:5], "x"], points((1, 0))),
        Code.INVALID_JOINTS,
        say.WRONG_JOINT_NAMES,
        {"unknown": ["x"], "missing": ["wrist_3_joint"]},
    ),
    (
        Goal([*UR5E.joint_names, "elbow_joint"], points((1, 0))),
        Code.INVALID_JOINTS,
        say.WRONG_JOINT_NAMES,
        {"repeated": ["elbow_joint"], "missing": []},
    ),
    (goal((1.0, 0.1), (1.0, 0.2)), Code.INVALID_GOAL, say.TIMES_NOT_RISING, {"point": 1}),
    (goal((-1.0, 0.1)), Code.INVALID_GOAL, say.BAD_FIRST_TIME, {"time": -1.0}),
    (goal((700.0, 0.1)), Code.INVALID_GOAL, say.GOAL_TOO_LONG, {"duration": 700.0}),
    (goal((1.0, NAN)), Code.INVALID_GOAL, say.VALUE_NOT_FINITE, {"joint": PAN, "point": 1}),
    (
        goal((1.0, 50.0)),
        Code.INVALID_GOAL,
        say.JOINT_OUT_OF_RANGE,
        {"joint": PAN, "point": 1, "upper": UR5E.joints[0].upper},
    ),
    (
        goal((0.01, 1.0)),
        Code.INVALID_GOAL,
        say.GOAL_TOO_FAST,
        {"time": 0.01, "limit": UR5E.joints[0].max_velocity},
    ),
    (goal((0.0, 1.0)), Code.INVALID_GOAL, say.GOAL_TOO_FAST, {}),
    (
        Goal(UR5E.joint_names, [Point(1.0, [0.0] * 5)]),
        Code.INVALID_GOAL,
        say.WRONG_VALUE_COUNT,
        {"found": 5, "expected": 6, "what": "positions", "point": 1},
    ),
    (Goal(UR5E.joint_names, [Point(1.0, ())]), Code.INVALID_GOAL, say.NO_POSITIONS, {}),
    (
        Goal(UR5E.joint_names, points((1.0, 0.1), speeds=[0.2])),
        Code.INVALID_GOAL,
        say.ENDS_MOVING,
        {"value": 0.2},
    ),
    (
        Goal(UR5E.joint_names, [Point(1.0, ARM.tolist(), effort=[1.0] * 6)]),
        Code.INVALID_GOAL,
        say.HAS_EFFORTS,
        {},
    ),
    (
        goal((1.0, 0.1), stamp_ns=NOW + 3600 * SECOND),
        Code.INVALID_GOAL,
        say.GOAL_TOO_LONG,
        {"duration": 3601.0},
    ),
    (
        goal((1.0, 0.1), stamp_ns=NOW - 2 * SECOND),
        Code.OLD_HEADER_TIMESTAMP,
        say.GOAL_OVER,
        {"ago": 1.0},
    ),
]


@pytest.mark.parametrize(("wrong", "code", "said", "values"), BAD)
def test_a_bad_goal_is_refused_with_its_code(wrong: Goal, code: Code, said, values) -> None:
    with refused(said, WrongGoal, **values) as error:
        trajectory(wrong, UR5E, ARM, NOW)
    assert error.value.code is code


def test_a_goal_of_the_longest_time_is_taken() -> None:
    assert trajectory(goal((LONGEST, 0.1)), UR5E, ARM, NOW).duration == LONGEST
    with refused(say.GOAL_TOO_LONG, WrongGoal):
        trajectory(goal((LONGEST + 0.01, 0.1)), UR5E, ARM, NOW)


def test_a_goal_whose_last_point_is_now_is_a_set_point() -> None:
    found = trajectory(goal((1.0, 0.001), stamp_ns=NOW - SECOND), UR5E, ARM, NOW)
    assert found.frame_count == 2
    assert found.positions[-1] == pytest.approx(ARM + 0.001)


def test_a_last_point_slower_than_a_standstill_is_an_end() -> None:
    def ending(speed: float) -> Goal:
        return replace(goal(), points=points((1.0, 0.1), speeds=[speed]))

    assert trajectory(ending(STANDSTILL), UR5E, ARM, NOW).frame_count == 101
    with refused(say.ENDS_MOVING, WrongGoal):
        trajectory(ending(1.01 * STANDSTILL), UR5E, ARM, NOW)


def test_a_joint_may_round_beyond_its_limit() -> None:
    at = ARM.copy()
    at[0] = UR5E.joints[0].upper + 0.9 * AT_LIMIT
    check_limits(at, UR5E)
    at[0] = UR5E.joints[0].upper + 1.1 * AT_LIMIT
    with refused(say.JOINT_OUT_OF_RANGE, WrongGoal, point=None):
        check_limits(at, UR5E)


def test_accelerations_are_those_of_segments_of_any_length() -> None:
    """A polynomial of the fourth degree comes back as it is, whatever the times of its points."""

    def x(t: float) -> tuple[float, float, float]:
        whole, c = 3.25, 0.03
        way = c * (whole * t**3 / 3 - t**4 / 4)
        return way, c * t**2 * (whole - t), c * (2 * whole * t - 3 * t**2)

    given = [
        Point(t, (ARM + p).tolist(), [v] * 6, [a] * 6)
        for t in (0.5, 2.0, 3.25)
        for p, v, a in (x(t),)
    ]
    found = trajectory(replace(goal(), points=given), UR5E, ARM, NOW)
    wanted = np.array([x(t) for t in np.arange(326) / FRAME_RATE])
    assert found.positions == pytest.approx(ARM + wanted[:, :1], abs=1e-9)
    assert found.channels.velocities[1:] == pytest.approx(np.tile(wanted[1:, 1:2], 6), abs=1e-6)
