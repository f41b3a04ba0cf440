"""Checks against a robot: each finding names joint, frame, value and limit."""

import numpy as np
import pytest
from fakes import make_model

from mrlab_ros.core.base.diagnostic import Severity
from mrlab_ros.core.conversion import motion_checks

ROBOT = make_model(2)  # both joints -3 to 3 rad, 2 rad/s


def check(positions, rate=100.0):
    return motion_checks.against_robot(positions, rate, ROBOT.joints, "q", "fake")


def smooth(rows=200, reach=1.0):
    u = np.linspace(0, 1, rows)[:, None]
    return reach * np.hstack([u, -u]) * (3 - 2 * u) * u


def test_a_fitting_motion_has_no_findings():
    assert check(smooth()) == []


def test_the_limit_itself_is_inside():
    q = smooth(2000, 3.0)
    assert check(q) == []


@pytest.mark.parametrize("side", [1, -1])
def test_a_joint_that_leaves_its_range_is_named_at_its_worst_frame(side):
    q = smooth(2000)
    q[700:1200, 1] += side * np.hanning(500) * 6.0
    found = [d for d in check(q) if d.code == "joint_limit"]
    assert len(found) == 1
    worst = int(np.abs(q[:, 1]).argmax())
    assert found[0].severity is Severity.ERROR
    values = found[0].values
    assert (found[0].joint, values["row"], found[0].unit) == ("joint_2", worst + 1, "rad")
    assert (found[0].value, values["lower"], values["upper"]) == (q[worst, 1], -3.0, 3.0)


def test_too_fast_is_a_warning_with_the_velocity_and_the_limit():
    q = smooth(60)
    (found, other) = check(q, 100.0)
    fastest = np.abs(np.diff(q[:, 0])).max() * 100
    assert (found.code, found.severity) == ("velocity_limit", Severity.WARNING)
    assert (found.joint, found.limit, found.unit) == ("joint_1", 2.0, "rad/s")
    assert found.value == pytest.approx(fastest)
    assert other.joint == "joint_2"
    assert check(q, 40.0) == []


def test_a_jump_is_found_between_its_two_frames():
    q = smooth()
    q[120:, 0] += 0.8
    (found,) = check(q)
    assert (found.code, found.first_row, found.joint) == ("discontinuity", 120, "joint_1")
    assert found.severity is Severity.ERROR


@pytest.mark.parametrize("turn", [2 * np.pi, -2 * np.pi])
def test_a_full_turn_is_told_from_another_jump(turn):
    q = smooth()
    q[50:, 1] += turn
    codes = {d.code for d in check(q)}
    assert "jump_2pi" in codes
    assert "discontinuity" not in codes


def test_a_few_waypoints_are_only_too_fast():
    q = np.array([[0.0, 0.0], [1.0, 0.5], [1.5, -0.5]])
    assert {d.code for d in check(q)} == {"velocity_limit"}


def test_two_equal_rows_are_fine():
    assert check(np.zeros((2, 2))) == []


@pytest.mark.parametrize("value", [np.nan, np.inf, -np.inf])
def test_the_first_value_that_is_not_finite_is_placed(value):
    q = np.zeros((10, 6))
    q[3, 2] = q[5, 0] = value
    found = motion_checks.non_finite(q, "q")
    assert found is not None
    assert (found.first_row, found.values["column"], found.values["count"]) == (4, 3, 2)
    assert found.fixes[0].value == "q([1:3 5 7:10], :)"
    q[:2] = q[9] = value
    found = motion_checks.non_finite(q[[0, 1, 2, 4, 6, 7, 9]], "q")
    assert found is not None
    assert [fix.value for fix in found.fixes] == ["q(3:6, :)"]
    found = motion_checks.non_finite(np.where(np.arange(40)[:, None] % 2, q[2], value), "q")
    assert found is not None
    assert [fix.option for fix in found.fixes] == [""]


def test_huge_but_finite_values_are_finite():
    assert motion_checks.non_finite(np.full((4, 2), 1e308), "q") is None
    assert motion_checks.non_finite(np.ones((4, 2), np.float32), "q") is None
