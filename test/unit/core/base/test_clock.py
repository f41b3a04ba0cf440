"""The playback clock: its pair, and the instants at which it shows a position."""

from __future__ import annotations

import itertools
import math
from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st
from refusals import refused

from mrlab_ros.core.base.clock import (
    RATE_RANGE,
    SECOND,
    SLEW,
    STEP_NS,
    LabTime,
    PlaybackClock,
    checked_position,
    checked_rate,
)
from mrlab_ros.core.base.diagnostics import BAD_POSITION, BAD_RATE
from mrlab_ros.core.base.errors import BadInput

# Wall time in ns is about 1.8e18; a session lasts a day at most.
stamps = st.integers(0, 4_000_000_000_000_000_000)
rates = st.floats(*RATE_RANGE)
positions = st.floats(0, 3600)
elapsed = st.integers(0, 86_400 * SECOND)


@given(stamps, positions, rates, elapsed)
def test_position_grows_with_the_rate(
    stamp: int, position: float, rate: float, after: int
) -> None:
    clock = PlaybackClock(stamp, position, rate)
    expected = position + rate * after / SECOND
    assert clock.at(stamp + after) == pytest.approx(expected, rel=1e-12, abs=1e-12)


@given(stamps, positions, rates, st.integers(0, 10 * SECOND))
def test_before_its_stamp_it_shows_its_own_position(
    stamp: int, position: float, rate: float, before: int
) -> None:
    assert PlaybackClock(stamp, position, rate).at(stamp - before) == position


@given(stamps, positions, elapsed)
def test_a_standing_clock_stands(stamp: int, position: float, after: int) -> None:
    assert PlaybackClock(stamp, position, 0.0).at(stamp + after) == position


@given(stamps, positions, rates, elapsed, elapsed)
def test_it_never_runs_backwards(
    stamp: int, position: float, rate: float, first: int, second: int
) -> None:
    clock = PlaybackClock(stamp, position, rate)
    early, late = sorted((first, second))
    assert clock.at(stamp + early) <= clock.at(stamp + late)


@given(stamps, positions, rates, st.floats(0, 3600))
def test_due_is_the_instant_at_which_it_shows_a_position(
    stamp: int, position: float, rate: float, ahead: float
) -> None:
    clock = PlaybackClock(stamp, position, rate)
    due = clock.due(position + ahead)
    assert clock.at(due) == pytest.approx(position + ahead, abs=rate / SECOND + 1e-9)


@given(stamps, positions, rates, rates, elapsed, elapsed)
def test_taking_the_pair_anew_makes_no_jump(
    stamp: int, position: float, rate: float, other: float, until: int, after: int
) -> None:
    first = PlaybackClock(stamp, position, rate)
    change = stamp + until
    second = PlaybackClock(change, first.at(change), other)
    assert second.at(change) == first.at(change)
    expected = first.at(change) + other * after / SECOND
    assert second.at(change + after) == pytest.approx(expected, rel=1e-12, abs=1e-9)


@pytest.mark.parametrize("frame_rate", [100.0, 250.0, 500.0, 1000.0, 29.97])
def test_ten_thousand_deadlines_do_not_drift(frame_rate: float) -> None:
    stamp = 1_800_000_000_123_456_789
    clock = PlaybackClock(stamp, 0.0, 1.0)
    for frame in range(0, 10_000, 7):
        exact = Fraction(frame * SECOND) / Fraction(frame_rate)
        assert abs(clock.due(frame / frame_rate) - stamp - exact) <= 1


@given(rates)
def test_a_rate_in_range_is_taken_either_way(rate: float) -> None:
    assert checked_rate(rate) == rate
    assert checked_rate(-rate) == -rate


@pytest.mark.parametrize(
    "rate", [0.0, -0.0999, -4.001, 0.0999, 4.001, math.nan, math.inf, -math.inf]
)
def test_a_rate_out_of_range_is_refused(rate: float) -> None:
    with refused(BAD_RATE, BadInput, rate=rate, low=0.1, high=4.0):
        checked_rate(rate)


@given(st.data(), st.floats(0, 3600))
def test_a_position_on_the_timeline_is_taken(data: st.DataObject, duration: float) -> None:
    position = data.draw(st.floats(0, duration))
    assert checked_position(position, duration) == position


@pytest.mark.parametrize("position", [-0.001, 2.501, math.nan, math.inf, -math.inf])
def test_a_position_off_the_timeline_is_refused(position: float) -> None:
    with refused(BAD_POSITION, BadInput, position=position, duration=2.5):
        checked_position(position, 2.5)


WALL = 1_800_000_000 * SECOND
MS = SECOND // 1000


def test_it_advances_with_the_steady_clock_and_agrees_with_the_wall_clock() -> None:
    time = LabTime(5 * SECOND, WALL)
    assert time.follow_wall(6 * SECOND, WALL + SECOND) == WALL + SECOND
    assert (time.shifted_ns, time.simulated) == (0, False)


def test_a_step_shifts_it_at_once_and_it_agrees_again() -> None:
    time = LabTime(0, WALL)
    assert time.follow_wall(SECOND, WALL - 4 * SECOND) == WALL - 4 * SECOND
    assert time.shifted_ns == -5 * SECOND
    assert time.follow_wall(2 * SECOND, WALL + 3600 * SECOND) == WALL + 3600 * SECOND
    # What was scheduled 1 s ahead before both steps is due 1 s after them.
    assert time.shifted_ns == 3598 * SECOND


@pytest.mark.parametrize(("error_ns", "shifted_ns"), [(STEP_NS, STEP_NS), (STEP_NS - 1, 0)])
def test_the_smallest_step_shifts_it_and_a_smaller_difference_does_not(
    error_ns: int, shifted_ns: int
) -> None:
    time = LabTime(0, WALL)
    time.follow_wall(0, WALL + error_ns)
    assert time.shifted_ns == shifted_ns


def test_a_small_difference_is_slewed_and_time_never_goes_back() -> None:
    time = LabTime(0, WALL)
    seen = [time.follow_wall(i * 10 * MS, WALL + i * 10 * MS - 50 * MS) for i in range(1, 2001)]
    gaps = [b - a for a, b in itertools.pairwise(seen)]
    assert min(gaps) >= 10 * MS * (1 - SLEW) - 1
    assert max(gaps) <= 10 * MS
    assert seen[0] - WALL > 9 * MS
    assert seen[-1] == WALL + 20 * SECOND - 49 * MS
    assert time.shifted_ns == 0


@given(st.lists(st.tuples(st.integers(0, SECOND), st.integers(-SECOND, SECOND)), max_size=30))
def test_what_is_scheduled_is_due_when_it_would_be_without_any_step(
    steps: list[tuple[int, int]],
) -> None:
    time, steady, wall = LabTime(0, WALL), 0, WALL
    due = WALL + 20 * SECOND
    for passed, step in steps:
        steady, wall = steady + passed, wall + passed + step
        left = due + time.shifted_ns
        now = time.follow_wall(steady, wall)
        left = due + time.shifted_ns - now
        # Slewing, and steps too small to shift, are all that parts them.
        assert abs(left - (20 * SECOND - steady)) <= SLEW * steady + 1
        assert abs(now - wall) < STEP_NS


def test_clock_gives_the_time_and_pauses_it() -> None:
    time = LabTime(0, WALL)
    assert time.follow_clock(0, SECOND) == 0
    assert time.simulated
    assert time.shifted_ns == -(WALL + SECOND)
    # The first message: no time has passed since there was none.
    assert time.follow_clock(100 * SECOND, 2 * SECOND) == 100 * SECOND
    assert time.shifted_ns == 99 * SECOND - WALL
    shifted = time.shifted_ns
    for at in (101, 101, 101, 140):
        assert time.follow_clock(at * SECOND, 3 * SECOND) == at * SECOND
    assert time.shifted_ns == shifted


def test_a_clock_that_goes_back_shifts_what_is_scheduled() -> None:
    time = LabTime(0, WALL)
    time.follow_clock(100 * SECOND, 0)
    shifted = time.shifted_ns
    assert time.follow_clock(40 * SECOND, SECOND) == 40 * SECOND
    assert time.shifted_ns - shifted == -60 * SECOND


def test_the_wall_clock_takes_over_where_use_sim_time_is_switched_off() -> None:
    time = LabTime(0, WALL)
    time.follow_clock(100 * SECOND, 0)
    assert time.follow_wall(9 * SECOND, WALL + 9 * SECOND) == WALL + 9 * SECOND
    assert not time.simulated
    assert time.shifted_ns == 9 * SECOND


def test_a_clock_that_nobody_has_set_stands_at_the_start() -> None:
    assert PlaybackClock().at(5 * SECOND) == 0.0


@given(st.integers(-600 * SECOND, 600 * SECOND), st.integers(0, 40_000))
def test_two_processes_shift_by_the_same(step: int, noise: int) -> None:
    """Each measures a step a little differently."""
    step = round(step / 2_000_000) * 2_000_000
    one, other = LabTime(0, 1000 * SECOND), LabTime(0, 1000 * SECOND)
    one.follow_wall(SECOND, 1001 * SECOND + step)
    other.follow_wall(SECOND, 1001 * SECOND + step + noise)
    if abs(step) > STEP_NS:
        assert one.shifted_ns == other.shifted_ns
