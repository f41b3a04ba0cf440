"""Points at times of their own, sampled at an even rate."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mrlab_ros.core.conversion import resampling


def ns(*seconds):
    return np.rint(np.array(seconds) * 1e9).astype(np.int64)


def test_straight_lines_between_points_without_velocities():
    q = resampling.resample(ns(0, 0.2, 0.3), np.array([[0.0], [2.0], [0.0]]), None, 10)
    np.testing.assert_allclose(q, [[0], [1], [2], [0]], rtol=0, atol=1e-12)


def test_cubic_splines_meet_positions_and_velocities():
    # p(t) = t^3 - t is its own Hermite spline
    t = np.array([0.0, 0.35, 1.0, 1.7])
    q = resampling.resample(ns(*t), (t**3 - t)[:, None], (3 * t**2 - 1)[:, None], 100)
    at = np.arange(171) / 100
    np.testing.assert_allclose(q[:, 0], at**3 - at, rtol=0, atol=1e-12)


@given(
    st.lists(st.integers(1, 400), min_size=1, max_size=20),
    st.sampled_from([1, 30, 60, 100, 125, 1000]),
    st.booleans(),
    st.integers(0, 2**31),
)
def test_frames_at_points_have_exactly_their_positions(steps, rate, curved, start):
    frames = np.concatenate([[0], np.cumsum(steps)])
    times = np.rint(frames * 1e9 / rate).astype(np.int64) + start
    random = np.random.default_rng(1)
    points = random.normal(size=(len(frames), 3))
    velocities = random.normal(size=points.shape) if curved else None
    q = resampling.resample(times, points, velocities, rate)
    assert len(q) == frames[-1] + 1
    np.testing.assert_array_equal(q[frames], points)


def test_the_last_frame_is_the_last_point_where_that_falls_between_two():
    q = resampling.resample(ns(1, 1.25), np.array([[0.0], [1.0]]), None, 10)
    np.testing.assert_allclose(q[:, 0], [0, 0.4, 0.8, 1.0], rtol=0, atol=1e-12)


def test_states_stay_until_the_next_point():
    states = resampling.hold(ns(0, 0.2, 0.3), np.array([False, True, False]), 10)
    assert states.tolist() == [False, False, True, False]


@pytest.mark.parametrize("rate", [1.0, 29.97, 30.0, 125.0, 1000.0])
def test_an_even_rate_is_recognised_through_rounding(rate):
    times = np.rint(np.arange(5000) * 1e9 / rate).astype(np.int64) + 17
    assert resampling.even_rate(times) == pytest.approx(rate, rel=1e-9)


def test_uneven_points_have_no_rate():
    assert resampling.even_rate(ns(0, 0.1, 0.3)) is None
