"""What is grasped, held, let go and put down."""

from __future__ import annotations

import pytest
from made_motions import checked, outcome, recorded, thing

from mrlab_ros.classroom.rubrics.measures.grasps import STANDS

HELD = [(1.0, "CLOSING", ""), (1.5, "HOLDING", "cube_1"), (3.0, "OPEN", "")]
THINGS = {"cube_1": thing(), "bin_1": thing(0.3, 0.0)}


def test_grasps_in_their_time():
    found = checked(record=recorded(HELD))
    assert outcome("grasps cube_1", found).share == 1.0
    assert outcome("grasps cube_1 between 1 and 2 s", found).share == 1.0
    late = outcome("grasps cube_1 before 1 s", found)
    assert (late.share, late.time) == (0.0, 1.5)
    assert (late.found.value, late.found.values["until"]) == (1.5, 1.0)
    early = outcome("grasps cube_1 after 2 s", found)
    assert (early.time, early.found.values["since"]) == (1.5, 2.0)
    assert outcome("grasps cube_2", found).time == 1.5
    assert outcome("grasps cube_1 by kr6_1", found).share == 0.0


@pytest.mark.parametrize(
    ("grasps", "time", "code"),
    [
        ((), 0.0, "never_grasped"),
        ([(1.0, "CLOSING", ""), (1.4, "EMPTY", "")], 1.4, "never_grasped_nothing"),
        ([(1.0, "CLOSING", "")], 1.0, "never_grasped_closes"),
        ([(1.5, "HOLDING", "cube_2")], 1.5, "never_grasped_other"),
    ],
)
def test_what_is_never_grasped_names_the_attempt(grasps, time, code):
    lost = outcome("grasps cube_1", checked(record=recorded(grasps)))
    assert (lost.share, lost.time, lost.found.code) == (0.0, time, code)


def test_holds_by_their_span_and_partly():
    found = checked(record=recorded(HELD))
    assert outcome("holds cube_1 until 3 s", found).share == 1.0
    assert outcome("holds cube_1 for 1.5 s", found).share == 1.0
    assert outcome("holds cube_1 for 3 s", found, partial="each").share == pytest.approx(0.5)
    assert outcome("holds cube_1 for 3 s", found).share == 0.0
    assert outcome("holds cube_1 until the end", found).time == pytest.approx(3.0)
    assert outcome("holds cube_1 from 1 to 2 s", found, partial="each").share == 0.5
    assert outcome("holds cube_1 from 1 to 2 s", found).time == pytest.approx(1.0)
    late = outcome("holds cube_1 until 1 s", found)
    assert (late.share, late.found.code, late.time) == (0.0, "grasped_late", 1.5)


def test_the_longest_of_several_holds_counts():
    held = [(t, state, "cube_1" if state == "HOLDING" else "") for t, state in (
        (0.5, "HOLDING"), (1.0, "OPEN"), (1.5, "HOLDING"), (3.0, "OPEN"), (3.5, "HOLDING"),
        (3.75, "OPEN"),
    )]  # fmt: skip
    found = outcome("holds cube_1 for 1.5 s", checked(record=recorded(held)))
    assert (found.share, found.found.value, found.time) == (1.0, 1.5, 3.0)


def test_a_hand_over_is_no_loss():
    from mrlab_ros.core.checking.rehearsal_record import GraspChange
    from mrlab_ros.core.physics.grasp.states import Grasp

    record = recorded(HELD)
    record.grasps.append(GraspChange(3.0, "kr6_1", Grasp.HOLDING, "cube_1"))
    assert outcome("holds cube_1 until the end", checked(record=record)).share == 1.0


def test_releases_and_places_by_where_the_object_lies_at_rest():
    record = recorded(HELD, {"cube_1": (0.3, 0.1, 0.025), "bin_1": (0.3, 0.13, 0.15)})
    found = checked(record=record, objects=THINGS)
    assert outcome("releases cube_1 within 5 mm of [0.3, 0.1]", found).share == 1.0
    near = outcome("releases cube_1 within 5 mm of [0.31, 0.1]", found, partial="until 15 mm")
    assert near.share == pytest.approx(0.5)
    assert near.time == 3.0
    assert outcome("releases cube_1 within 4 cm of bin_1", found).share == 1.0
    assert outcome("places cube_1 on the floor", found).share == 1.0
    assert outcome("places cube_1 in bin_1", found).share == 1.0
    assert outcome("places cube_1 on bin_1", found).share == 0.0


def test_what_is_still_held_or_rolls_or_left_is_not_released():
    sentence = "places cube_1 on the floor"
    held = recorded(HELD[:2], {"cube_1": (0.3, 0.1, 0.025)})
    for each in (sentence, "releases cube_1 within 5 mm of [0.3, 0.1]"):
        assert outcome(each, checked(record=held)).found.code == "still_held"
    rolls = recorded(HELD, {"cube_1": (0.3, 0.1, 0.025)})
    rolls.objects["cube_1"].values[0] = [0.2, 0.1, 0.025, 0, 0, 0, 1]
    moves = outcome(sentence, checked(record=rolls)).found
    assert (moves.code, moves.value) == ("still_moves", pytest.approx(0.1 / 0.5))
    rolls.objects["cube_1"].values[0] = [0.3 - 0.99 * STANDS * 0.5, 0.1, 0.025, 0, 0, 0, 1]
    assert outcome(sentence, checked(record=rolls, objects=THINGS)).share == 1.0
    gone = recorded(HELD, {"cube_1": (0.3, 0.1, 0.025)}, gone=[(3.5, "cube_1")])
    assert outcome(sentence, checked(record=gone)).found.code == "not_in_the_room"


def test_nothing_is_released_at_an_object_that_is_not_there():
    record = recorded(HELD, {"cube_1": (0.3, 0.1, 0.025)})
    lost = outcome("releases cube_1 within 4 cm of bin_1", checked(record=record, objects=THINGS))
    assert (lost.share, lost.found.code, lost.time) == (0.0, "no_object_checked", 3.0)
