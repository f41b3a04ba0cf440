"""What a check says of grasps: a hand-over that one robot leaves before the other comes."""

from __future__ import annotations

import pytest

from mrlab_ros.core.checking.evidence import of_grasps
from mrlab_ros.core.checking.rehearsal_record import Drop, GraspChange, Rehearsed
from mrlab_ros.core.physics.diagnostics import TORN_OFF
from mrlab_ros.core.physics.grasp.states import Grasp

TAKES = GraspChange(2.0, "giver", Grasp.HOLDING, "rod")
LETS_GO = GraspChange(4.6, "giver", Grasp.OPEN, "")
MISSES = GraspChange(12.8, "taker", Grasp.EMPTY, "")


def test_a_taker_that_comes_too_late_is_told_who_let_go_and_when() -> None:
    (found,) = of_grasps(Rehearsed(grasps=[TAKES, LETS_GO, MISSES]), ["rod"])
    assert (found.code, found.robot, found.other) == ("missed_hand_over", "taker", "rod")
    assert found.values["giver"] == "giver"
    assert found.values["ago"] == pytest.approx(8.2)


@pytest.mark.parametrize(
    "before",
    [
        [],
        [TAKES],
        [TAKES, LETS_GO, GraspChange(6.0, "third", Grasp.HOLDING, "rod")],
        [
            GraspChange(2.0, "taker", Grasp.HOLDING, "rod"),
            GraspChange(3.0, "taker", Grasp.OPEN, ""),
        ],
    ],
    ids=["nobody held it", "still held", "held by a third", "let go by itself"],
)
def test_a_taker_that_was_not_late_is_told_where_to_close(before: list[GraspChange]) -> None:
    found = of_grasps(Rehearsed(grasps=[*before, MISSES]), ["rod"])[-1]
    assert (found.code, found.robot) == ("grasps_nothing", "taker")


def test_a_room_without_parts_is_named_where_a_gripper_closes() -> None:
    (found,) = of_grasps(Rehearsed(grasps=[MISSES]), [])
    assert (found.code, found.robot, found.time) == ("nothing_to_grasp", "taker", 12.8)


def test_what_is_let_go_in_the_air_drops_and_what_is_set_down_does_not() -> None:
    drops = [Drop(1.0, "r", "cube", 0.3), Drop(2.0, "r", "rod", 0.004)]
    (found,) = of_grasps(Rehearsed(drops=drops), [])
    assert (found.code, found.other, found.value) == ("drops_object", "cube", 0.3)


def test_a_giver_that_stays_closed_fails_the_hand_over() -> None:
    torn = TORN_OFF(object="rod", robot="giver", other="taker", way=0.012, force=90.0, margin=0.1)
    changes = [
        TAKES,
        GraspChange(4.0, "taker", Grasp.HOLDING, "rod"),
        GraspChange(4.0, "giver", Grasp.EMPTY, ""),
        GraspChange(5.0, "giver", Grasp.EMPTY, "", torn),
    ]
    (found,) = of_grasps(Rehearsed(grasps=changes), ["rod"])
    assert (found.code, found.robot, found.other) == ("failed_hand_over", "giver", "rod")
    assert found.values["why"] == torn
