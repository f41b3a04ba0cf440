"""Members that would wait for each other without end."""

from __future__ import annotations

import pytest
from refusals import refused

from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.systems.diagnostics import WAITING_CIRCLE
from mrlab_ros.core.systems.timeline import Member, Mode, Timeline
from mrlab_ros.core.systems.waits import parse, waiting_circle


def members(**waits: list[str]) -> list[Member]:
    return [Member(r, waits=tuple(map(parse, w)), frame_rate=100.0) for r, w in waits.items()]


def test_two_that_wait_for_each_other_are_named_with_their_waits():
    pair = members(a=["frame 10: after b.frame 20"], b=["frame 10: after a.frame 20"])
    circle = waiting_circle(pair, sequential=False)
    assert sorted((step.code, step.robot, step.values["wait"]) for step in circle) == [
        ("waits_at", "a", "frame 10: after b.frame 20"),
        ("waits_at", "b", "frame 10: after a.frame 20"),
    ]


@pytest.mark.parametrize(
    "waits",
    [
        # b reaches its frame 20 before it waits.
        {"a": ["frame 10: after b.frame 20"], "b": ["frame 30: after a.frame 40"]},
        # A member that waits stands at the very frame that the other waits for.
        {"a": ["frame 10: after b.frame 10"], "b": ["frame 10: after a.frame 10"]},
        # Every member stands at its first frame.
        {"a": ["frame 10: after b.frame 0"], "b": ["frame 0: after a.frame 20"]},
        # Objects are physics' matter.
        {"a": ["frame 10: object rod_1 held by b"], "b": ["frame 10: after a.frame 20"]},
    ],
)
def test_waits_that_can_be_met_are_no_circle(waits):
    assert waiting_circle(members(**waits), sequential=False) == []


def test_a_circle_of_three_is_found():
    three = members(
        a=["frame 1: after b.frame 5"],
        b=["frame 1: after c.frame 5"],
        c=["frame 1: after a.frame 5"],
    )
    assert len(waiting_circle(three, sequential=False)) == 3


def test_a_member_that_waits_for_its_successor_is_a_circle_in_sequential_mode_alone():
    pair = members(a=["frame 10: after b.frame 20"], b=[])
    assert waiting_circle(pair, sequential=False) == []
    circle = waiting_circle(pair, sequential=True)
    assert {(step.code, step.robot) for step in circle} >= {("ends_first", "a"), ("waits_at", "a")}


def test_the_mode_cannot_be_set_where_it_makes_a_circle():
    timeline = Timeline(members(a=["frame 10: after b.frame 20"], b=[]), Mode.PARALLEL)
    timeline.check_circles(Mode.PARALLEL)
    with refused(WAITING_CIRCLE, BadInput):
        timeline.check_circles(Mode.SEQUENTIAL)
