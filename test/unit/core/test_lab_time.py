"""A wall clock that is set, and /clock, as one time that scheduled work can follow."""

from __future__ import annotations

import itertools

from hypothesis import given
from hypothesis import strategies as st

from mrlab_ros.core.clock import SECOND
from mrlab_ros.core.lab_time import SLEW, STEP_NS, LabTime

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
