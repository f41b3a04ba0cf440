"""What a grasp bears, what is said of it, and how often; fingers and cups of an engine that is
only geometry."""

from __future__ import annotations

import numpy as np
import pytest
from fake_engine import FakeEngine
from refusals import refused

from mrlab_ros.core.base.clock import SECOND, PlaybackClock
from mrlab_ros.core.base.errors import Misuse
from mrlab_ros.core.base.geometry import Pose
from mrlab_ros.core.physics import catalogue
from mrlab_ros.core.physics.diagnostics import NO_SEAL_AT_EDGE, OUT_OF_ATTACH_REACH
from mrlab_ros.core.physics.grasp import kinds
from mrlab_ros.core.physics.grasp.kinds import Gripper
from mrlab_ros.core.physics.grasp.load import Grip, Tool, bears
from mrlab_ros.core.physics.grasp.states import Grasp
from mrlab_ros.core.physics.settings import Settings
from mrlab_ros.core.physics.simulated_robot import GripperProgram, Playing
from mrlab_ros.core.physics.world import World
from mrlab_ros.core.physics.world_state import GraspChanged, LoadChanged
from mrlab_ros.core.playback.states import State

MS = SECOND // 1000
G = 9.80665
BALL = {"shape": "sphere", "size": [0.05], "mass": 0.1}
DOWN = Pose((0.0, 0.0, 0.5), (1.0, 0.0, 0.0, 0.0))
CUP = Tool(force=45.0, lip_radius=0.02)


class Leaky(FakeEngine):
    """Under a cup's lip there is something at the first `sealed` of its points only."""

    sealed = 0

    def rays(self, name, starts, ends):
        hits = super().rays(name, starts, ends)
        return [hit if i < self.sealed else None for i, hit in enumerate(hits)]


class Cell:
    """A robot that plays on the spot, or moves its tip, 10 ms at a time."""

    def __init__(self, gripper: Gripper, at: Pose, tool: Tool | None = None) -> None:
        self.engine = Leaky(fingers=gripper is kinds.FINGERS)
        self.world = World(self.engine, catalogue.parse({"objects": {"ball": BALL}}), Settings())
        self.world.add_robot("a", "", ("j1", "j2"), Pose(), gripper, frozenset(), tool)
        self.world.spawn("ball", "ball", at)
        self.now_ns = 0
        self.x = 0.0
        self.events: list = []
        self.go(0.0, 0.02)
        self.world.set_program("a", GripperProgram((0.1,), (True,)))
        clock = PlaybackClock(self.now_ns, 0.0, 1.0)
        self.world.playback("a", Playing(State.PLAYING, "t", clock, 0, 9001, 100.0, 90.0))

    def go(self, x: float, seconds: float) -> None:
        start, count = self.x, round(seconds * 100)
        for i in range(1, count + 1):
            self.now_ns += 10 * MS
            self.x = start + (x - start) * i / count
            velocity = np.array([(x - start) / seconds, 0.0])
            self.world.joint_state("a", self.now_ns, np.array([self.x, 0.0]), velocity)
            self.world.advance(self.now_ns)
            self.events += self.world.take_events()

    def said(self) -> list[GraspChanged]:
        """Return all that was announced of the gripper, and forget it."""
        found = [e.grasp if isinstance(e, LoadChanged) else e for e in self.events]
        self.events = []
        return [e for e in found if isinstance(e, GraspChanged)]


@pytest.fixture
def pinched():
    """Return a cell whose fingers hold the ball."""
    cell = Cell(kinds.FINGERS, Pose((0.0, 0.0, 0.47)))
    cell.engine.pinched, cell.engine.block = "ball", 0.02
    cell.go(0.0, 1.0)
    assert cell.world.robot("a").held == "ball"
    return cell


def lifted_by_cup(mass: float, force: float = 45.0, beside: float = 0.0, up: float = 0.0):
    grip = Grip((0.0, 0.0, 0.1), ((0.0, 0.0, 1.0),), 0.02, kinds.CUP)
    centre = (beside, 0.0, 0.4)
    return bears(grip, DOWN, (0.0, 0.0, 0.5), centre, (0.0, 0.0, up), mass, 5.0, 0.6, force)


def test_the_margin_of_a_cup_that_lifts_straight_up_is_that_of_its_pull():
    load = lifted_by_cup(1.2)
    assert load.slip_margin == pytest.approx(45.0 / (1.2 * G) - 1.0)
    assert lifted_by_cup(1.2, up=2.0).slip_margin == pytest.approx(45.0 / (1.2 * (G + 2.0)) - 1.0)
    # Beside the middle the weight peels as well.
    peel = 1.2 * G * 0.03 / 0.02
    assert lifted_by_cup(1.2, beside=0.03).slip_margin == pytest.approx(45 / (1.2 * G + peel) - 1)


@pytest.mark.parametrize("beside", [0.0, 0.01])
def test_a_cup_comes_off_where_its_margin_is_used_up(beside):
    most = 45.0 / G / (1.0 + beside / 0.02)
    below, above = (lifted_by_cup(most * share, beside=beside) for share in (0.99, 1.01))
    assert below.slip_margin > 0 >= below.excess
    assert above.slip_margin < 0 < above.excess


def test_what_a_grasp_will_need_when_lifted_is_said_from_the_start(pinched):
    grasp = pinched.said()[-1]
    assert grasp.state is Grasp.HOLDING
    assert grasp.load.friction_needed == pytest.approx(0.1 * G / 100.0, rel=0.01)


def test_a_load_that_changes_is_announced_at_once_and_twice_a_second_at_most(pinched):
    before = pinched.said()[-1].load
    pinched.go(0.02, 0.2)
    changed = pinched.said()
    assert changed
    assert changed[0].stamp_ns <= pinched.now_ns - 100 * MS
    assert changed[0].load.friction_needed > 1.04 * before.friction_needed
    for i in range(40):
        pinched.go(0.05 * (i % 2), 0.1)
    count = len(pinched.said())
    assert 4 <= count <= 8 + 2


def test_the_reason_why_a_cup_did_not_seal_stays_in_the_last_message():
    cell = Cell(kinds.CUP, Pose((0.0, 0.0, 0.46)), CUP)
    cell.go(0.0, 0.3)
    cell.world.move("ball", Pose((2.0, 0.0, 0.46)), (0, 0, 0), (0, 0, 0), held=False)
    cell.go(0.0, 0.5)
    last = cell.said()[-1]
    assert last.state is Grasp.EMPTY
    assert last.reason == NO_SEAL_AT_EDGE(object="ball", share=0.0)


def test_a_magnet_is_a_row_that_holds_without_a_seal():
    loads = []
    for friction in (0.4, 0.8):
        cell = Cell(Gripper("magnet", pulls=True, friction=friction), Pose((0.0, 0.0, 0.46)), CUP)
        cell.go(0.0, 0.5)
        held = cell.said()[-1]
        assert (held.state, held.object) == (Grasp.HOLDING, "ball")
        loads.append(held.load.friction)
    assert loads[1] == pytest.approx(2 * loads[0])


def test_a_seal_that_changes_all_the_time_is_announced_twice_a_second_at_most():
    cell = Cell(kinds.CUP, Pose((0.0, 0.0, 0.46)), CUP)
    for i in range(60):
        cell.engine.sealed = i % 14
        cell.go(0.0, 0.05)
    of_state = [e for e in cell.events if isinstance(e, GraspChanged)]
    assert [e.state for e in of_state] == [Grasp.OPEN, Grasp.CLOSING, Grasp.EMPTY]
    assert 3 <= len(cell.events) - len(of_state) <= 6


def test_an_object_out_of_the_hands_reach_is_not_attached():
    cell = Cell(kinds.FINGERS, Pose((0.8, 0.0, 0.5)))
    with refused(OUT_OF_ATTACH_REACH, Misuse, object="ball", robot="a", limit=0.2):
        cell.world.attach("a", "ball")
    assert cell.world.object("ball").held_by == ""
    cell.go(0.61, 0.5)
    cell.world.attach("a", "ball")
    assert cell.world.robot("a").held == "ball"
