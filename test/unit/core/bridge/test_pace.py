"""When the graph is checked; times are s of the test's own clock."""

from __future__ import annotations

import pytest

from mrlab_ros.core.bridge.pace import REST_S, SETTLE_S, Pace

PERIOD = 0.25


def checks(pace, start, end, step=0.125):
    """Return (time, thorough) of each check from `start` to `end`, with a turn every `step`."""
    made = []
    for i in range(round((end - start) / step) + 1):
        now = start + i * step
        if pace.wait(now) == 0.0:
            made.append((now, pace.check(now)))
    return made


def test_the_first_check_is_due_at_once():
    pace = Pace(PERIOD)
    assert pace.wait(1234.5) == 0.0
    assert pace.check(1234.5) is True


def test_a_graph_at_rest_is_checked_seldom_and_thoroughly():
    made = checks(Pace(PERIOD), 0.0, 2 * REST_S)
    assert made == [(0.0, True), (REST_S, True), (2 * REST_S, True)]


def test_after_a_change_checks_go_on_until_it_has_settled_and_the_last_is_thorough():
    pace = Pace(PERIOD)
    pace.check(0.0)
    pace.changed(2.0)
    assert pace.wait(2.0) == 0.0
    made = checks(pace, 2.0, 2.0 + SETTLE_S + REST_S - PERIOD)
    assert [now for now, _ in made] == [2.0, 2.25, 2.5, 2.75, 3.0]
    assert [thorough for _, thorough in made] == [False, False, False, False, True]


def test_changes_without_end_make_no_more_checks_than_one_a_period():
    pace = Pace(PERIOD)
    made = 0
    for i in range(400):
        now = i * 0.01
        pace.changed(now)
        if pace.wait(now) == 0.0:
            pace.check(now)
            made += 1
    assert made == pytest.approx(4.0 / PERIOD, abs=1)


def test_a_new_period_counts_at_once():
    pace = Pace(60.0)
    pace.check(0.0)
    pace.changed(1.0)
    assert pace.wait(1.0) == 59.0
    pace.period = 0.5
    assert pace.wait(1.0) == 0.0
