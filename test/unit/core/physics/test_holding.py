"""What a robot held before a restart comes back to its hand, or is let go."""

from __future__ import annotations

import numpy as np
import pytest
from fake_engine import FakeEngine
from refusals import refused

from mrlab_ros.core.base.clock import SECOND, PlaybackClock
from mrlab_ros.core.base.errors import Misuse
from mrlab_ros.core.base.geometry import Pose, compose
from mrlab_ros.core.physics import catalogue
from mrlab_ros.core.physics.diagnostics import FIXED_OBJECT, OPENED_UNSEEN
from mrlab_ros.core.physics.engine import BodyState
from mrlab_ros.core.physics.grasp import kinds
from mrlab_ros.core.physics.pending_grasp import CLOSING_NS, PendingGrasp
from mrlab_ros.core.physics.settings import Settings
from mrlab_ros.core.physics.simulated_robot import GripperProgram, Playing
from mrlab_ros.core.physics.world import World
from mrlab_ros.core.physics.world_state import HAND
from mrlab_ros.core.playback.states import State

TYPES = {
    "ball": {"shape": "sphere", "size": [0.05], "mass": 0.1},
    "post": {"shape": "sphere", "size": [0.05], "fixed": True},
}
IN_HAND = Pose((0.1, 0.0, 0.0))
TIMEOUT_NS = 5 * SECOND


@pytest.fixture
def world():
    world = World(FakeEngine(), catalogue.parse({"objects": TYPES}), Settings())
    world.spawn("ball", "ball", Pose((2.0, 2.0, 2.0)))
    world.move("ball", Pose((2.0, 2.0, 2.0)), (0.0,) * 3, (0.0,) * 3, held=True)
    return world


@pytest.fixture
def grasp():
    return PendingGrasp("ball", "a", IN_HAND, TIMEOUT_NS)


def add_robot(world, *, placed: bool = True) -> None:
    world.add_robot("a", "<robot/>", ("j1", "j2"), Pose(), kinds.NONE)
    if placed:
        world.joint_state("a", 1, np.zeros(2), np.zeros(2))
        world.advance(1)
        world.advance(SECOND)


def test_it_waits_for_its_robot_where_it_was(world, grasp):
    assert not grasp.check(world, SECOND, absent=False)
    assert not grasp.check(world, SECOND, absent=True)
    add_robot(world, placed=False)
    assert not grasp.check(world, 2 * SECOND, absent=False)
    assert world.object("ball").held_by == HAND
    assert world.motion("ball").pose.position == (2.0, 2.0, 2.0)


def test_it_is_let_go_where_its_robot_does_not_come(world, grasp):
    assert not grasp.check(world, TIMEOUT_NS, absent=True)
    assert grasp.check(world, TIMEOUT_NS + 1, absent=True)
    assert world.object("ball").held_by == ""


def test_it_moves_with_the_hand_and_is_attached_where_no_finger_closes_on_it(world, grasp):
    add_robot(world)
    assert not grasp.check(world, 10, absent=False)
    hand = world.hand("a").pose.position
    assert world.motion("ball").pose.position == pytest.approx((hand[0] + 0.1, hand[1], hand[2]))
    assert world.object("ball").held_by == HAND
    assert not grasp.check(world, 10 + CLOSING_NS - 1, absent=False)
    assert grasp.check(world, 10 + CLOSING_NS, absent=False)
    assert world.object("ball").held_by == "a"


def test_it_is_done_where_the_fingers_hold_it_or_it_is_gone(world, grasp):
    add_robot(world)
    world.attach("a", "ball", reach=4.0)
    assert grasp.check(world, 10, absent=False)
    world.remove("ball")
    assert grasp.check(world, 20, absent=False)


def test_what_is_fixed_to_the_room_cannot_come_back(world):
    add_robot(world)
    world.spawn("post", "post", Pose((3.0, 3.0, 0.0)))
    grasp = PendingGrasp("post", "a", IN_HAND, TIMEOUT_NS)
    assert not grasp.check(world, 0, absent=False)
    with refused(FIXED_OBJECT, Misuse):
        grasp.check(world, CLOSING_NS, absent=False)


@pytest.mark.parametrize("missed", [True, False])
@pytest.mark.parametrize(("state", "position"), [(State.PAUSED, 3.0), (State.READY, 0.0)])
def test_it_lies_where_its_gripper_was_told_to_open_meanwhile(world, missed, state, position):
    place = Pose((0.0, 1.0, 0.5))
    add_robot(world)
    world.set_program("a", GripperProgram((1.0, 2.0), (True, False), (Pose(), place)))
    # A run that has ended stands at its beginning; what it commanded last counts.
    for known, at, stamp_ns in ((State.PLAYING, 0.0, 1), (state, position, SECOND // 2)):
        clock = PlaybackClock(stamp_ns, at, 8.0 if known is State.PLAYING else 0.0)
        world.playback("a", Playing(known, "t", clock, 0, 401, 100.0, 4.0, stamp_ns))
    world.take_events()
    grasp = PendingGrasp("ball", "a", IN_HAND, TIMEOUT_NS, missed=missed)
    assert grasp.check(world, 10, absent=False) is missed
    if not missed:
        # A scene says what it is to be like, whatever was commanded.
        assert grasp.check(world, 10 + CLOSING_NS, absent=False)
        assert world.object("ball").held_by == "a"
        return
    assert grasp.let_go == OPENED_UNSEEN(object="ball", robot="a")
    assert world.object("ball").held_by == ""
    assert world.motion("ball") == BodyState(compose(place, IN_HAND))
    assert [event.reason for event in world.take_events()] == [grasp.let_go]
