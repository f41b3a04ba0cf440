"""Figures of the joints: what begins and ends at rest, what is too fast, what jolts."""

from __future__ import annotations

import numpy as np
import pytest

from mrlab_ros.core.checking.joint_limits import StatedLimits, figures_of, findings_of
from mrlab_ros.core.robots.model import Joint

JOINT = Joint("elbow", -2.0, 2.0, 3.0)
S = np.linspace(0, 1, 201)
QUINTIC = 10 * S**3 - 15 * S**4 + 6 * S**5


def codes(q, rate=100.0, stated=None):
    figures = figures_of(
        np.asarray(q)[:, None], rate, [JOINT], {"elbow": stated or StatedLimits()}
    )
    return {f.code for f in findings_of(figures, "r", (len(q) - 1) / rate)}


def test_a_quintic_refuses_nothing():
    assert codes(QUINTIC) == set()


@pytest.mark.parametrize("rate", [10.0, 100.0, 1000.0])
def test_a_cubic_is_at_rest_at_its_ends_at_any_rate(rate):
    s = np.linspace(0, 1, int(2 * rate) + 1)
    assert not codes(3 * s**2 - 2 * s**3, rate) & {"moves_at_start", "moves_at_end"}


def test_a_line_neither_begins_nor_ends_at_rest():
    assert codes(0.5 * S) == {"moves_at_start", "moves_at_end"}


def test_only_the_end_that_moves_is_named():
    assert codes(QUINTIC[:101]) == {"moves_at_end"}


def test_a_speed_beyond_the_limit_says_how_much_longer_it_must_take():
    figures = figures_of(3.9 * QUINTIC[:, None] - 1.95, 100.0, [JOINT], {})
    (found,) = (f for f in findings_of(figures, "r", 2.0) if f.code == "over_speed")
    assert found.value == pytest.approx(3.9 * 1.875 / 2, rel=1e-3)
    assert found.time == pytest.approx(1.0, abs=0.02)
    assert found.values["times"] == pytest.approx(1.22, abs=0.01)


def test_a_step_of_the_speed_in_the_middle_is_found_where_it_is():
    q = np.concatenate([np.zeros(100), 0.008 * np.arange(100)])
    figures = figures_of(q[:, None], 100.0, [JOINT], {})
    (found,) = (f for f in findings_of(figures, "r", 1.99) if f.code == "speed_step")
    assert found.time == pytest.approx(1.0, abs=0.011)


@pytest.mark.parametrize("rate", [50.0, 100.0, 500.0])
def test_a_joint_that_turns_back_at_once_zigzags(rate):
    s = np.linspace(0, 1, int(2 * rate) + 1)
    smooth = 10 * s**3 - 15 * s**4 + 6 * s**5
    shaken = smooth + 0.012 * np.sign(np.sin(np.pi * 0.999 * s * min(rate, 100) * 2))
    assert codes(smooth, rate) == set()
    assert "zigzag" in codes(shaken, rate)
    # An encoder's noise is none.
    noise = np.random.default_rng(0).normal(0, 5e-5, len(s))
    assert not codes(smooth + noise, rate) & {"zigzag", "small_jumps"}


def test_many_small_jumps_are_found():
    jumps = np.zeros(len(QUINTIC))
    jumps[3::5] = 0.02
    figures = figures_of((QUINTIC - 1.9 + np.cumsum(jumps))[:, None], 100.0, [JOINT], {})
    (found,) = (f for f in findings_of(figures, "r", 2.0) if f.code == "small_jumps")
    assert found.values["count"] == pytest.approx(40, abs=4)
    assert found.value == pytest.approx(2.0, rel=0.1)


def test_acceleration_and_jerk_count_only_where_they_are_stated():
    assert codes(QUINTIC, stated=StatedLimits(1.0, 5.0)) == {"acceleration_limit", "jerk_limit"}
    assert codes(QUINTIC, stated=StatedLimits(2.0, 60.0)) == set()


def test_a_joint_near_its_limit_warns_and_beyond_it_refuses():
    assert codes(1.98 * QUINTIC) == {"near_joint_limit"}
    assert codes(2.02 * QUINTIC) == {"outside_range"}


def test_two_frames_have_figures():
    assert codes([0.0, 0.0]) == set()
