"""Planned against measured: the delay is found, and what remains is the error of each joint."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from refusals import refused

from mrlab_ros.core.trajectory import diagnostics as say
from mrlab_ros.core.trajectory.comparison import compare
from mrlab_ros.core.trajectory.trajectory import Channels, Source, Trajectory

NAMES = ("a", "b")


def motion(course, duration: float, rate: float) -> Trajectory:
    """A motion of two joints by `course(times)`, (N, 2) rad."""
    times = np.arange(round(duration * rate) + 1) / rate
    positions = course(times)
    zeros = np.zeros_like(positions)
    return Trajectory("m", "x", None, NAMES, rate, positions, None, Channels(zeros, zeros),
                      Source("", "", ""))  # fmt: skip


def wave(times):
    """Stand, move for 3 s, stand."""
    s = np.clip(times / 3, 0, 1)
    return np.stack([np.sin(5 * s) * s * (1 - s), s**2 * (3 - 2 * s)], axis=1)


@settings(max_examples=40, deadline=None)
@given(st.floats(-0.8, 4.0), st.sampled_from([25.0, 100.0, 125.0, 500.0]))
def test_the_delay_is_found_between_samples(delay: float, rate: float) -> None:
    found = compare(motion(wave, 3, 100), motion(lambda t: wave(t - delay), 7, rate))
    assert found.delay == pytest.approx(delay, abs=0.003)
    assert found.most.max() < 0.01


def test_what_remains_is_off() -> None:
    def measured(times):
        noise = np.random.default_rng(1).normal(0, 1e-4, (len(times), 2))
        return wave(times - 1.0) + np.array([0.0, 0.05]) + noise

    found = compare(motion(wave, 3, 100), motion(measured, 5, 125))
    assert found.delay == pytest.approx(1.0, abs=0.005)
    assert found.most == pytest.approx([0.0, 0.05], abs=0.003)
    assert found.rms == pytest.approx([0.0, 0.05], abs=0.002)
    assert (found.worst, found.compared) == (1, pytest.approx(3.0, abs=0.02))


def test_a_part_of_a_motion_is_compared_where_it_is() -> None:
    found = compare(motion(wave, 3, 100), motion(lambda t: wave(t + 1.0), 1, 100))
    assert found.delay == pytest.approx(-1.0, abs=0.01)
    assert found.compared == pytest.approx(1.0, abs=0.02)
    assert found.most.max() < 0.01


def test_a_robot_that_stands_has_no_delay() -> None:
    still = motion(lambda t: np.full((len(t), 2), 0.3), 2, 100)
    found = compare(motion(wave, 3, 100), still)
    assert (found.delay, found.compared) == (0.0, 2.0)
    with refused(say.OF_OTHER_JOINTS, found=["a", "c"]):
        compare(still, replace(still, joint_names=("a", "c")))
