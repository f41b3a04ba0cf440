"""Pairs of robots: conflicts, closing speed, and the smallest wait that resolves one."""

from __future__ import annotations

import pytest

from mrlab_ros.core.checking.pairs import closing_speed, pairs_of, smallest_delay, wait_frame
from mrlab_ros.core.checking.rehearsal_record import Collision, Distances, Rehearsed
from mrlab_ros.core.physics.engine import Kind, Near


def recorded(values, *hits):
    series = Distances()
    for value in values:
        series.add(Near(value, "wrist", "", "elbow"))
    times = [0.02 * i for i in range(len(values))]
    return Rehearsed(
        times=times, distances={("a", (Kind.ROBOT, "b")): series}, collisions=list(hits)
    )


def test_the_first_conflict_is_where_they_come_too_near_and_how_fast():
    (pair,) = pairs_of(recorded([0.3 - 0.02 * i for i in range(16)]), 0.05)
    assert pair.conflict == pytest.approx(0.26)
    assert pair.closing == pytest.approx(1.0)
    assert (pair.link, pair.other_link, pair.touches) == ("wrist", "elbow", False)


def test_a_contact_of_either_counts_for_the_pair():
    hit = Collision(0.1, "b", "elbow", Kind.ROBOT, "a", "wrist", (0, 0, 0), 0.001)
    (pair,) = pairs_of(recorded([0.2] * 10, hit), 0.01)
    assert (pair.conflict, pair.touches) == (0.1, True)


def test_what_stays_apart_has_no_conflict():
    (pair,) = pairs_of(recorded([0.2] * 10), 0.01)
    assert (pair.conflict, pair.closing) == (None, None)


def test_a_distance_that_grows_does_not_close():
    assert closing_speed([0.1, 0.2, 0.3], [0.0, 0.02, 0.04], 0.04) == 0.0
    assert closing_speed([0.1], [0.0], 0.0) == 0.0


def test_the_smallest_delay_lets_the_other_pass_a_crossing():
    # Both cross the same place from sample 4 to 6 of 10.
    def clear(i, j):
        return not (4 <= i <= 6 and 4 <= j <= 6)

    assert smallest_delay(10, 10, clear, 10) == 3
    assert smallest_delay(10, 10, clear, 2) is None


def test_no_delay_helps_where_one_stands_in_the_way():
    assert smallest_delay(10, 10, lambda i, j: (i, j) != (9, 9), 10) is None
    assert smallest_delay(10, 10, lambda i, j: i == 0 or j > 0, 10) is None


def test_a_pair_of_poses_is_compared_once():
    asked = []

    def clear(i, j):
        asked.append((i, j))
        return i - j != 3 or i == 9

    smallest_delay(10, 10, clear, 10)
    assert len(asked) == len(set(asked))


def test_a_wait_ends_at_the_first_frame_that_is_late_enough():
    starts = {"a": 0.0, "b": 0.5}
    assert wait_frame(0.3, starts, "b", "a", 100.0, 601) == 80
    assert wait_frame(0.301, {}, "b", "a", 100.0, 601) == 31
    assert wait_frame(9.0, {}, "b", "a", 100.0, 601) == 600
    assert wait_frame(0.3, {"a": 2.0}, "b", "a", 100.0, 601) == 0
