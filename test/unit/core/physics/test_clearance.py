"""A halt ends where the margin was kept for the hold time without a break."""

from __future__ import annotations

import pytest

from mrlab_ros.core.physics.clearance import Clearance, Halt

HOLD = 100


@pytest.fixture
def clearance() -> Clearance:
    made = Clearance(0.01, HOLD)
    assert made.touched()
    return made


def test_a_collision_begins_once_and_ends_once(clearance):
    assert not clearance.touched()
    assert not clearance.apart(0, 1.0)
    assert not clearance.apart(HOLD - 1, 1.0)
    assert clearance.apart(HOLD, 1.0)
    assert clearance.state is Halt.CLEAR
    assert not clearance.apart(2 * HOLD, 1.0)


@pytest.mark.parametrize("distance", [0.0, 0.0099])
def test_what_is_nearer_than_the_margin_begins_the_hold_anew(clearance, distance):
    clearance.apart(0, 1.0)
    clearance.apart(50, distance)
    assert not clearance.apart(60, 1.0)
    assert not clearance.apart(60 + HOLD - 1, 1.0)
    assert clearance.apart(60 + HOLD, 1.0)


def test_the_margin_itself_is_kept(clearance):
    clearance.apart(0, 0.01)
    assert clearance.apart(HOLD, 0.01)


def test_a_touch_begins_the_hold_anew_also_of_the_second_collision(clearance):
    clearance.apart(0, 1.0)
    clearance.touched()
    assert not clearance.apart(HOLD, 1.0)
    assert clearance.apart(2 * HOLD, 1.0)
    assert clearance.touched()
    assert not clearance.apart(3 * HOLD, 1.0)
    assert not clearance.apart(4 * HOLD - 1, 1.0)
    assert clearance.apart(4 * HOLD, 1.0)
