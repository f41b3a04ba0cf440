"""The derived channels against closed forms."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.trajectory import derived_signals
from mrlab_ros.core.trajectory.derived_signals import (
    GRAVITY,
    ProxyCoefficients,
    derivative,
    derive,
)

ONE = ProxyCoefficients((2.0,), (5.0,), (3.0,), (0.4,), 50.0)


@pytest.mark.parametrize("rate", [50.0, 100.0, 500.0])
def test_a_sine_keeps_its_derivative_up_to_the_stated_loss(rate):
    w = 2.0
    t = np.arange(int(4 * rate)) / rate
    got = derivative(np.sin(w * t)[:, None], rate)[:, 0]
    exact = w * np.cos(w * t)
    loss = (w / rate) ** 2 * (1 / 6 + 1 / 4)
    np.testing.assert_allclose(got[2:-2], exact[2:-2] * (1 - loss), rtol=0, atol=w * loss**1.5)
    # one-sided at the ends: first order, half a step of the curvature
    np.testing.assert_allclose(got, exact, rtol=0, atol=0.51 * w**2 / rate)


def test_a_quintic_has_its_velocity_and_acceleration():
    rate, n = 200.0, 401
    u = np.linspace(0, 1, n)
    duration = (n - 1) / rate
    q = 10 * u**3 - 15 * u**4 + 6 * u**5
    channels = derive(q[:, None], rate, ONE)
    velocity = (30 * u**2 - 60 * u**3 + 30 * u**4) / duration
    acceleration = (60 * u - 180 * u**2 + 120 * u**3) / duration**2
    np.testing.assert_allclose(channels.velocities[:, 0], velocity, rtol=0, atol=2e-4)
    inner = slice(3, -3)
    weight = 3 * GRAVITY * 0.4 * np.sin(q)
    proxy = 2 * acceleration + 5 * velocity + weight
    np.testing.assert_allclose(channels.effort_proxy[inner, 0], proxy[inner], rtol=0, atol=3e-3)


@given(
    slope=st.floats(-3, 3),
    offset=st.floats(-3, 3),
    rate=st.floats(1, 1000),
    rows=st.integers(2, 30),
)
def test_a_straight_line_is_exact_up_to_its_ends(slope, offset, rate, rows):
    t = np.arange(rows) / rate
    got = derivative((slope * t + offset)[:, None], rate)
    np.testing.assert_allclose(got, slope, rtol=0, atol=1e-9 * rate)


def test_the_proxy_is_the_formula():
    rate = 100.0
    q = np.sin(np.arange(300) / rate)[:, None]
    c = derive(q, rate, ONE)
    expected = (
        2 * derivative(c.velocities, rate) + 5 * c.velocities + 3 * GRAVITY * 0.4 * np.sin(q)
    )
    np.testing.assert_allclose(c.effort_proxy, expected, rtol=1e-13, atol=1e-12)


def test_a_step_is_clipped():
    q = np.repeat([0.0, 3.0], 20)[:, None]
    c = derive(q, 100.0, ProxyCoefficients((2.0,), (0.0,), (0.0,), (0.0,), 50.0))
    assert c.effort_proxy.max() == 2 * 50.0
    assert c.effort_proxy.min() == -2 * 50.0


@pytest.mark.parametrize("rows", [2, 3, 6, 7, 8, 9, 14, 15, 50])
def test_blocks_give_the_same_bits_as_the_whole(rows, monkeypatch):
    positions = np.random.default_rng(1).normal(size=(rows, 3))
    coefficients = ProxyCoefficients((1.0,), (0.5,), (2.0,), (0.3,), 100.0)
    whole = derive(positions, 100.0, coefficients)
    monkeypatch.setattr(derived_signals, "BLOCK_ROWS", 7)
    parts = derive(positions, 100.0, coefficients)
    np.testing.assert_array_equal(parts.velocities, whole.velocities)
    np.testing.assert_array_equal(parts.effort_proxy, whole.effort_proxy)


def test_two_rows_have_the_difference_between_them():
    q = np.array([[0.0], [0.5]])
    c = derive(q, 10.0, ONE)
    np.testing.assert_array_equal(c.velocities, [[5.0], [5.0]])
    still = 5 * c.velocities + 3 * GRAVITY * 0.4 * np.sin(q)
    np.testing.assert_allclose(c.effort_proxy, still, rtol=1e-15)


def test_a_longer_arm_repeats_the_last_coefficient():
    q = np.tile(np.sin(np.arange(50) / 50)[:, None], 3)
    c = derive(q, 50.0, ONE)
    np.testing.assert_array_equal(c.effort_proxy[:, 0], c.effort_proxy[:, 2])


@pytest.mark.parametrize(
    ("change", "named"),
    [
        ({"inertia": []}, "inertia"),
        ({"mass": [1, "two"]}, "mass"),
        ({"damping": [-1]}, "damping"),
        ({"length": 3}, "length"),
        ({"max_acceleration": 0}, "max_acceleration"),
    ],
)
def test_wrong_coefficients_are_named(change, named):
    good = {"inertia": [1], "damping": [1], "mass": [1], "length": [1], "max_acceleration": 9}
    assert ProxyCoefficients.from_mapping(good).of_joint(4) == (1, 1, GRAVITY)
    with pytest.raises(BadInput, match=named):
        ProxyCoefficients.from_mapping({**good, **change})
