"""Requests that waited while the process did not run."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from mrlab_ros.core.runtime.freezes import FROZEN_AFTER_S, LONG_S, LOOK_PERIOD_S, THAW_S, Freezes

BEGAN, ENDED = 100.0, 130.0


def watched(computed: Callable[[], float] = lambda: 0.0) -> Freezes:
    noted = Freezes("playback", computed)
    noted.begin()
    return noted


@pytest.fixture
def freezes() -> Freezes:
    """A process that ran until BEGAN, and again from ENDED on."""
    noted = watched()
    noted.look(BEGAN - LOOK_PERIOD_S)
    noted.look(BEGAN)
    return noted


def test_a_process_that_runs_refuses_nothing(freezes):
    assert watched().why_late(0.0, 1000.0) is None
    assert watched().why_doubtful(1000.0) is None
    now = BEGAN
    while now < BEGAN + 20.0:
        now += FROZEN_AFTER_S
        # It may be as old as it likes: a queue is no freeze.
        assert freezes.why_late(BEGAN - 1.0, now) is None
        assert freezes.why_doubtful(now) is None


@pytest.mark.parametrize("sent", [BEGAN - 1.0, BEGAN, BEGAN + 2.0, ENDED - FROZEN_AFTER_S - 0.1])
@pytest.mark.parametrize("later", [0, 16])
def test_what_was_sent_in_a_freeze_is_refused_however_late_it_is_taken(freezes, sent, later):
    for i in range(later + 1):
        freezes.look(ENDED + i * LOOK_PERIOD_S)
    why = freezes.why_late(sent, ENDED + later * LOOK_PERIOD_S)
    assert why.code == "waited_in_freeze"
    assert (why.values["process"], why.values["frozen"]) == ("playback", 30)


def test_who_takes_the_request_notices_the_freeze_before_any_beat(freezes):
    assert freezes.why_late(BEGAN + 2.0, ENDED).values["waited"] == 28


@pytest.mark.parametrize("sent", [ENDED - FROZEN_AFTER_S + 0.1, ENDED, ENDED + 1.0])
def test_whose_caller_still_waits_is_served(freezes, sent):
    freezes.look(ENDED)
    assert freezes.why_late(sent, ENDED + 1.2) is None


def test_a_sender_whose_clock_differs_is_never_refused_for_good(freezes):
    freezes.look(ENDED)
    for skew in (3600.0, -3600.0):
        assert freezes.why_late(ENDED + 0.1 + skew, ENDED + 0.1) is None


def test_two_freezes_with_a_moment_between_them_are_one(freezes):
    freezes.look(ENDED)
    freezes.look(ENDED + THAW_S / 2)
    assert freezes.why_late(BEGAN + 10.0, BEGAN + 50.0).values["frozen"] == 50
    freezes.look(BEGAN + 50.0 + 1.4)
    freezes.look(BEGAN + 70.0)
    assert freezes.why_late(BEGAN + 10.0, BEGAN + 70.0) is None


@pytest.mark.parametrize(("share", "refused"), [(0.02, True), (0.2, False), (1.0, False)])
def test_a_process_that_computes_is_busy_not_frozen(share, refused):
    used = [5.0]
    process = watched(lambda: used[0])
    process.look(BEGAN)
    used.append(used.pop() + share * (ENDED - BEGAN))
    process.look(ENDED)
    assert bool(process.why_late(BEGAN + 2.0, ENDED)) is refused
    assert bool(process.why_doubtful(ENDED)) is refused


def test_while_nobody_watches_nothing_is_a_freeze():
    process = watched()
    process.look(BEGAN)
    process.begin()
    process.end()
    process.look(BEGAN + 1.0)
    process.end()
    assert process.why_doubtful(BEGAN + 1.1) is None
    assert process.why_doubtful(ENDED - 5.0) is None, "asked before the next watcher comes"
    process.begin()
    assert process.why_doubtful(ENDED) is None
    process.look(ENDED + 1.0)
    assert process.why_doubtful(ENDED + 10.0) is not None


def test_what_has_no_stamp_is_refused_for_a_moment_after_a_long_freeze(freezes):
    why = freezes.why_doubtful(ENDED)
    assert (why.code, why.values["frozen"]) == ("may_be_old", 30)
    assert freezes.why_doubtful(ENDED + THAW_S + 0.01) is None
    short = watched()
    short.look(0.0)
    assert short.why_doubtful(LONG_S - 0.1) is None


def test_the_end_of_a_freeze_is_noted_by_the_look_that_ends_it():
    noted = watched()
    assert not noted.thawed(BEGAN)
    assert noted.thawed(ENDED)
    assert not noted.thawed(ENDED + LOOK_PERIOD_S)
