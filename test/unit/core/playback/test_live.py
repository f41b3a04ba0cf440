"""A stream of set-points is followed within a period at any rate, and the arm stands behind it."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from mrlab_ros.adapters.robots.library import RobotLibrary
from mrlab_ros.core.base.clock import SECOND
from mrlab_ros.core.playback.live import CLOSING_SHARE, RATE, SetPoints

pytestmark = pytest.mark.fast
UR5E = RobotLibrary(Path(__file__).parents[4] / "robots", Path("/nowhere")).model("ur5e")
FASTEST = np.array([joint.max_velocity for joint in UR5E.joints])
TICK = round(SECOND / RATE)
SLACK = 0.005  # s that the arm may be late beside the period
START_NS = 1_000 * SECOND


class Arm:
    """An arm that follows set-points, by its own joint states."""

    def __init__(self, at) -> None:
        self.set_points = SetPoints(UR5E)
        self.set_points.rest(START_NS)
        self.now_ns, self.at = START_NS, np.array(at, dtype=float)
        self.times, self.path = [0.0], [self.at]

    def run_to(self, end_ns: int) -> None:
        while self.now_ns + TICK <= end_ns:
            self.now_ns += TICK
            self.at, _ = self.set_points.step(self.now_ns, self.at)
            self.times.append((self.now_ns - START_NS) / SECOND)
            self.path.append(self.at)

    def follow(self, way, times) -> None:
        for time in times:
            self.run_to(START_NS + round(time * SECOND))
            self.set_points.go_to(START_NS + round(time * SECOND), way(time))

    def fastest(self) -> float:
        """Return the greatest share of a joint's limit that it moved at."""
        steps = np.abs(np.diff(self.path, axis=0)) / (TICK / SECOND)
        return float((steps / FASTEST).max())


def ramp(speed):
    return lambda time: UR5E.home + speed * time


@pytest.mark.parametrize("speed", [0.2, 0.8 * FASTEST.min()])
@pytest.mark.parametrize("rate", [10, 20, 50, 100, 125, 250, 500, 1000])
def test_a_stream_is_followed_within_a_period_and_the_arm_stands_behind_it(rate, speed):
    arm = Arm(UR5E.home)
    seconds = 1.5
    arm.follow(ramp(speed), np.arange(0.0, seconds, 1 / rate))
    times = np.array(arm.times)
    behind = speed * times - (np.array(arm.path) - UR5E.home).max(axis=1)
    settled = times > 0.5
    assert behind[settled].max() <= speed * (1 / rate + SLACK)
    assert behind[settled].min() >= -1e-9, "the arm is never ahead of its set-points"
    assert arm.fastest() <= 1.0 + 1e-9
    newest = ramp(speed)(np.arange(0.0, seconds, 1 / rate)[-1])
    left = np.abs(newest - arm.at).max()
    arm.run_to(arm.now_ns + SECOND)
    assert left <= speed * (1 / rate + SLACK), "what is left when the stream ends"
    assert arm.at == pytest.approx(newest)
    path = np.array(arm.path)[times.size :]
    assert np.abs(np.diff(path, axis=0)).max() <= speed * TICK / SECOND + 1e-9, "it does not race"


@settings(max_examples=60, deadline=None)
@given(
    rate=st.floats(10, 1000),
    jitter=st.lists(st.floats(-0.45, 0.45), min_size=20, max_size=20),
    burst=st.integers(1, 4),
    speed=st.floats(0.05, 0.6),
    away=st.floats(-0.5, 0.5),
)
def test_uneven_streams_stay_within_limits_and_end_at_the_newest_set_point(
    rate, jitter, burst, speed, away
):
    """In bursts and with jitter, from a place elsewhere: set-points come when they come."""
    count = int(2.5 * rate) // burst * burst
    numbers = np.arange(count)
    asked = numbers / rate
    came = (numbers // burst * burst + np.resize(jitter, count)) / rate
    came = np.maximum.accumulate(np.maximum(came, 0.0))
    came[numbers % burst != 0] = came[numbers // burst * burst][numbers % burst != 0]
    speeds = speed * FASTEST.min()
    arm = Arm(UR5E.home + away)
    for time, wanted in zip(came, asked, strict=True):
        arm.run_to(START_NS + round(time * SECOND))
        goal = UR5E.home + speeds * wanted
        arm.set_points.go_to(START_NS + round(time * SECOND), goal)
    late = np.abs(goal - arm.at).max()
    assert late <= speeds * (3 * burst / rate + SLACK) + 1e-9
    assert arm.fastest() <= 1.0 + 1e-9
    ended = len(arm.path)
    arm.run_to(arm.now_ns + SECOND)
    assert arm.at == pytest.approx(goal)
    after = np.abs(np.diff(arm.path[ended - 1 :], axis=0)).max() * SECOND / TICK
    # The mean interval falls while a burst comes (to 0.17 of its period where four come at once),
    # so the reference goes its last way in less time than the stream took for it.
    assert after <= CLOSING_SHARE * FASTEST.max() + 2 * burst * speeds + 1e-9


def test_the_rate_may_change_in_the_middle():
    arm = Arm(UR5E.home)
    times = np.concatenate([np.arange(0, 1, 0.1), np.arange(1, 2, 0.001), np.arange(2, 3, 0.05)])
    speed = 0.3
    arm.follow(ramp(speed), times)
    behind = speed * np.array(arm.times) - (np.array(arm.path) - UR5E.home).max(axis=1)
    sampled = np.array(arm.times)
    assert behind[(sampled > 1.2) & (sampled < 2)].max() <= speed * (0.001 + SLACK)
    assert behind.max() <= speed * (0.1 + SLACK)


def test_an_arm_elsewhere_closes_up_on_a_stream_that_moves_away():
    arm = Arm(UR5E.home - 0.5)
    speed = 0.6 * FASTEST.min()
    arm.follow(ramp(speed), np.arange(0.0, 1.5, 0.01))
    assert np.abs(ramp(speed)(1.49) - arm.at).max() <= speed * (0.01 + SLACK)
    assert arm.fastest() <= 0.6 + CLOSING_SHARE + 1e-9


def test_after_a_freeze_the_arm_does_not_leap():
    arm = Arm(UR5E.home - 1.0)
    arm.set_points.go_to(START_NS, UR5E.home)
    at, _ = arm.set_points.step(START_NS + 3 * SECOND, arm.at)
    assert np.abs(at - arm.at).max() <= 0.02 * CLOSING_SHARE * FASTEST.max() + 1e-12
