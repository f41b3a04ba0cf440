"""Singularities, smoothness, and points that the tool shall pass."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from refusals import refused

from mrlab_ros.adapters.robots.library import RobotLibrary
from mrlab_ros.core.checking.diagnostics import POINT_COUNT, POINT_NOT_NUMBERS, POINT_TOO_FAR
from mrlab_ros.core.checking.joint_limits import spectral_arc_length
from mrlab_ros.core.checking.tool import conditioning, dexterity_of, findings_of, jacobian
from mrlab_ros.core.checking.waypoints import passed, points_from_rows

MODEL = RobotLibrary(Path(__file__).parents[4] / "robots").model("ur5e")


def test_the_jacobian_is_the_derivative_of_the_tool():
    q = np.array([[0.3, -1.2, 1.1, -0.7, 0.9, 0.2]])
    whole, step = jacobian(MODEL.chain, q)[0], 1e-6
    for j in range(6):
        moved = q.copy()
        moved[0, j] += step
        a, b = MODEL.chain.tool0(q)[0], MODEL.chain.tool0(moved)[0]
        assert (b[:3, 3] - a[:3, 3]) / step == pytest.approx(whole[:3, j], abs=1e-5)
        turn = (b[:3, :3] @ a[:3, :3].T - np.eye(3)) / step
        assert [turn[2, 1], turn[0, 2], turn[1, 0]] == pytest.approx(whole[3:, j], abs=1e-5)


def test_a_stretched_elbow_and_an_aligned_wrist_are_singular_and_home_is_not():
    home, stretched, wrist = np.tile(MODEL.home, (3, 1))
    stretched[2], wrist[4] = 0.0, 0.0
    found = conditioning(MODEL.chain, np.array([home, stretched, wrist]), MODEL.reach)
    assert found[0] > 0.05
    assert found[1:] == pytest.approx([0.0, 0.0], abs=1e-9)


def test_each_pass_through_a_singularity_is_one_finding_with_its_time():
    q = np.tile(MODEL.home, (201, 1))
    q[:, 2] = 0.8 * np.cos(np.linspace(0, 2 * np.pi, 201))  # the elbow is straight twice
    found = findings_of(dexterity_of(MODEL.chain, q, 100.0, MODEL.reach), "r")
    assert [f.code for f in found] == ["near_singularity"] * 2
    assert [(f.time + f.end) / 2 for f in found] == pytest.approx([0.5, 1.5], abs=0.02)


def bell(count):
    s = np.linspace(0, 1, count)
    return 30 * s**2 * (1 - s) ** 2


def test_one_reach_is_smoother_than_one_with_a_stop():
    one = spectral_arc_length(bell(100), 100.0)
    two = spectral_arc_length(np.concatenate([bell(50), np.zeros(30), bell(50)]), 100.0)
    assert one == pytest.approx(-1.41, abs=0.05)  # Balasubramanian et al. 2015: about -1.4
    assert two < one - 0.5


def test_what_stands_has_no_smoothness():
    assert spectral_arc_length(np.zeros(50), 100.0) is None


TIMES = np.linspace(0, 4, 5)
SQUARE = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 0]], dtype=float)


def test_points_are_passed_between_the_samples_in_order():
    found = passed(SQUARE, TIMES, [(0.5, 0.003, 0), (1, 0.25, 0), (0, 0.5, 0)], 0.005)
    assert [p.time for p in found] == pytest.approx([0.5, 1.25, 3.5])
    assert [p.distance for p in found] == pytest.approx([0.003, 0, 0])
    assert all(p.within(0.005) for p in found)


def test_a_point_that_was_passed_too_early_is_out_of_order():
    late, early = passed(SQUARE, TIMES, [(0, 0.5, 0), (1, 0.5, 0)], 0.005)
    assert late.within(0.005)
    assert not early.in_order
    assert early.time == pytest.approx(1.5)


def test_a_point_beside_the_path_has_its_least_distance():
    (found,) = passed(SQUARE, TIMES, [(0.5, -0.2, 0)], 0.005)
    assert found.in_order
    assert found.distance == pytest.approx(0.2)


def test_a_table_of_points_may_have_a_heading_and_says_its_bad_line():
    assert points_from_rows([["x", "y", "z"], ["1", "2", "3"]], "p.csv") == ((1.0, 2.0, 3.0),)
    with refused(POINT_NOT_NUMBERS, file="p.csv", line=2, found=["1", "zwei", "3"]):
        points_from_rows([["x", "y", "z"], ["1", "zwei", "3"]], "p.csv")
    with refused(POINT_TOO_FAR, line=1, point=(0.0, 101.0, 0.0)):
        points_from_rows([["0", "101", "0"]], "p.csv")
    with refused(POINT_COUNT, count=0):
        points_from_rows([], "p.csv")
