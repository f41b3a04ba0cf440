"""The world's rules on an engine that is only geometry."""

from __future__ import annotations

import numpy as np
import pytest
from fake_engine import FakeEngine
from refusals import refused

from mrlab_ros.core.base.clock import SECOND, PlaybackClock
from mrlab_ros.core.base.diagnostics import (
    A_NUMBER,
    AN_INTEGER,
    BAD_VALUE,
    BAD_VECTOR,
    COUNTED_NUMBERS,
    ENTRY,
    LIMITS_ABOVE,
    LIMITS_BETWEEN,
    MISSING_FIELD,
    MISTAKES,
    NAME_TAKEN,
    ONE_OF,
    POSE_NOT_FINITE,
    TRUE_OR_FALSE,
    UNKNOWN_FIELD,
)
from mrlab_ros.core.base.errors import BadInput, Misuse
from mrlab_ros.core.base.geometry import Pose, compose, inverse, relative
from mrlab_ros.core.physics import catalogue
from mrlab_ros.core.physics.clearance import Clearance, Halt
from mrlab_ros.core.physics.diagnostics import (
    FIXED_OBJECT,
    FIXED_WITH_MASS,
    HOLDS_ALREADY,
    HOLDS_NOTHING,
    JOINT_STATE_BEYOND,
    JOINT_STATE_SIZE,
    MASS_OR_FIXED,
    NO_OBJECT_IN_SCENE,
    NO_OBJECT_TYPE,
    OBJECT_ENTRY,
    SHAPE_AND_PARTS,
    SURFACE_BEYOND,
    SURFACE_IS_LINE,
    SURFACE_NO_VERTEX,
    SURFACE_TOO_FINE,
)
from mrlab_ros.core.physics.engine import BodyState, Kind, Touch
from mrlab_ros.core.physics.grasp import kinds
from mrlab_ros.core.physics.grasp.kinds import Gripper
from mrlab_ros.core.physics.grasp.states import Grasp
from mrlab_ros.core.physics.joint_stream import JointStream
from mrlab_ros.core.physics.objects import surface_body
from mrlab_ros.core.physics.settings import Settings
from mrlab_ros.core.physics.simulated_robot import GripperProgram, Playing
from mrlab_ros.core.physics.snapshots import Snapshot, Snapshots
from mrlab_ros.core.physics.world import World
from mrlab_ros.core.physics.world_state import CollisionChanged, GraspChanged, ObjectRemoved
from mrlab_ros.core.playback.states import State
from mrlab_ros.core.scene import surfaces as rooms
from mrlab_ros.core.scene.diagnostics import BAD_SOURCE, SURFACES_OF_ONE_NAME
from mrlab_ros.core.scene.surfaces import Surface

MS = SECOND // 1000
TYPES = {"ball": {"shape": "sphere", "size": [0.05], "mass": 0.1}}
TYPES["post"] = {"shape": "sphere", "size": [0.05], "fixed": True}


class Lab:
    """A world with one robot whose time the test moves, 10 ms at a time."""

    def __init__(self, *, gripper: Gripper = kinds.NONE, settings: Settings | None = None):
        self.engine = FakeEngine(fingers=gripper is kinds.FINGERS)
        types = catalogue.parse({"objects": TYPES})
        self.world = World(self.engine, types, settings or Settings())
        self.world.add_robot("a", "<robot/>", ("j1", "j2"), Pose(), gripper)
        self.now_ns = 0
        self.at = np.zeros(2)
        self.events = []
        self.go(0.0, 20 * MS)

    def go(self, x: float, duration_ns: int, y: float = 0.0) -> None:
        """Move the tip to (x, y) evenly."""
        start, goal = self.at, np.array([x, y])
        count = duration_ns // (10 * MS)
        velocity = (goal - start) / (duration_ns / SECOND)
        for i in range(1, count + 1):
            self.now_ns += 10 * MS
            self.at = start + (goal - start) * (i / count)
            self.world.joint_state("a", self.now_ns, self.at, velocity)
            self.send_others()
            self.world.advance(self.now_ns)
            self.events += self.world.take_events()

    def send_others(self) -> None:
        """Send the joint states of robots beside `a`."""

    def play(self, position: float = 0.0, state: State = State.PLAYING) -> None:
        rate = 1.0 if state is State.PLAYING else 0.0
        clock = PlaybackClock(self.now_ns, position, rate)
        self.world.playback("a", Playing(state, "t", clock, 0, 1001, 100.0, 10.0))

    def of(self, kind):
        return [event for event in self.events if isinstance(event, kind)]


def test_a_touch_halts_once_and_a_margin_kept_for_a_while_ends_it():
    lab = Lab()
    lab.world.spawn("ball", "ball", Pose((0.5, 0.0, 0.5)))
    lab.play()
    lab.go(0.46, 460 * MS)
    (halt,) = lab.of(CollisionChanged)
    assert halt.colliding
    assert (halt.contact.touch.link, halt.contact.touch.other) == ("tip", "ball")
    # The tip touches at x = 0.45, frame 45 of 100 Hz; the first step behind it is at most 1 later.
    assert halt.contact.frame in (45, 46)
    (contact,) = lab.world.take_contacts()
    assert (contact.robot, contact.touch.other) == ("a", "ball")
    assert list(lab.world.take_contacts()) == []
    for x in (0.449, 0.452, 0.445, 0.451, 0.446):  # in and out, never out of the margin
        lab.go(x, 300 * MS)
    assert len(lab.of(CollisionChanged)) == 1
    lab.go(0.3, 100 * MS)
    lab.go(0.3, 100 * MS)
    assert len(lab.of(CollisionChanged)) == 1
    lab.go(0.3, 200 * MS)
    assert [event.colliding for event in lab.of(CollisionChanged)] == [True, False]


def test_moving_the_obstacle_away_clears_too_and_playing_into_it_again_halts_again():
    lab = Lab()
    lab.world.spawn("ball", "ball", Pose((0.5, 0.0, 0.5)))
    lab.go(0.46, 460 * MS)
    lab.world.move("ball", Pose((2.0, 0, 0.5)), (0, 0, 0), (0, 0, 0), held=True)
    lab.go(0.46, 400 * MS)
    assert [event.colliding for event in lab.of(CollisionChanged)] == [True, False]
    lab.world.move("ball", Pose((0.5, 0, 0.5)), (0, 0, 0), (0, 0, 0), held=True)
    lab.go(0.46, 100 * MS)
    assert [event.colliding for event in lab.of(CollisionChanged)] == [True, False, True]
    lab.play()
    lab.go(0.461, 20 * MS)
    assert [event.colliding for event in lab.of(CollisionChanged)] == [True, False, True, True]


def test_a_halt_of_another_world_stays_while_the_arm_is_close_to_anything():
    """It stands where it halted, a hair from what it hit before physics was started anew."""
    lab = Lab()
    lab.world.spawn("post", "post", Pose((0.5, 0.0, 0.5)))
    settings = Settings()
    gap = lab.engine.distance("a", Kind.OBJECT, "post", 1.0)
    lab.go(gap - settings.clear_margin / 2, 10 * MS)
    lab.play(state=State.COLLISION_HALT)
    lab.go(lab.at[0], 2000 * MS)
    assert not lab.of(CollisionChanged)
    lab.go(gap - 3 * settings.clear_margin, 100 * MS)
    lab.go(lab.at[0], 600 * MS)
    assert [event.colliding for event in lab.of(CollisionChanged)] == [False]


@pytest.mark.parametrize(("x", "told"), [(0.3, [False]), (0.46, [True, False])])
def test_a_halt_that_another_world_began_is_ended_here(x, told):
    """Physics was started anew, or the robot was built anew with another end effector."""
    lab = Lab()
    lab.world.spawn("ball", "ball", Pose((0.5, 0.0, 0.5)))
    lab.play(state=State.COLLISION_HALT)
    lab.go(x, 10 * MS)
    lab.go(x, 400 * MS)
    lab.go(0.3, 100 * MS)
    lab.go(0.3, 400 * MS)
    assert [event.colliding for event in lab.of(CollisionChanged)] == told
    # From now on only what the arm touches itself counts.
    assert not lab.world.robot("a").inherited


def test_a_silent_arm_is_waited_for_a_while_and_a_foreign_clock_is_not():
    lab = Lab()
    lab.play()
    lab.go(0.1, 100 * MS)
    last = lab.now_ns
    for k in range(1, 99):
        lab.world.advance(last + k * 10 * MS)
        assert last - 5 * MS < lab.world.now_ns <= last
    lab.world.advance(last + 1020 * MS)
    assert lab.world.now_ns > last + SECOND
    lab.world.playback("a", Playing())
    lab.world.joint_state("a", last - 3600 * SECOND, (0.2, 0.0), (1.0, 0.0))
    lab.world.advance(last + 1040 * MS)
    assert lab.world.now_ns > last + 1030 * MS
    assert lab.engine.arms["a"]["q"] == (0.2, 0.0)


def test_what_the_playback_does_holds_from_its_stamp_on():
    lab = Lab(gripper=kinds.FINGERS)
    lab.world.set_program("a", GripperProgram((0.0, 1.0), (True, False)))
    lab.play()
    lab.go(0.1, 500 * MS)
    stopped = lab.now_ns + 300 * MS
    clock = PlaybackClock(stopped, 1.5, 0.0)
    lab.world.playback("a", Playing(State.PAUSED, "t", clock, 0, 1001, 100.0, 10.0, stopped))
    lab.go(0.15, 290 * MS)
    assert lab.world.robot("a").closed
    lab.go(0.15, 20 * MS)
    assert not lab.world.robot("a").closed
    lab.go(0.15, 1000 * MS)
    far = lab.now_ns + 3600 * SECOND
    lab.world.playback("a", Playing(State.IDLE, stamp_ns=far))
    assert lab.world.robot("a").playing.state is State.IDLE


def test_fast_motion_is_looked_at_in_small_parts():
    lab = Lab()
    lab.world.spawn("ball", "ball", Pose((0.5, 0.0, 0.5)))
    lab.engine.RADIUS = 0.0025  # 5 mm thick, and a step at 3 m/s is 12.5 mm
    lab.engine.calls.clear()
    lab.go(1.5, 500 * MS)
    assert [event.colliding for event in lab.of(CollisionChanged)][:1] == [True]
    assert lab.engine.calls.count("step") == pytest.approx(4 * 120, abs=8)


def test_a_jump_is_no_motion_and_takes_along_what_the_hand_holds():
    lab = Lab(gripper=kinds.FINGERS)
    lab.world.spawn("ball", "ball", Pose((0.02, 0.0, 0.5)))
    lab.world.spawn("post", "between", Pose((0.5, 0.0, 0.5)))
    lab.world.attach("a", "ball")
    lab.now_ns += 10 * MS
    lab.world.joint_state("a", lab.now_ns, [1.0, 0.0], [0.0, 0.0])
    lab.world.advance(lab.now_ns + 10 * MS)
    assert not [e for e in lab.world.take_events() if isinstance(e, CollisionChanged)]
    assert lab.world.motion("ball").pose.position == pytest.approx((1.02, 0.0, 0.5))


@pytest.mark.parametrize(
    ("positions", "velocities", "code"),
    [
        ([np.nan, 0], [0, 0], JOINT_STATE_BEYOND),
        ([0.0], [0.0], JOINT_STATE_SIZE),
        ([0, 0], [0, 0, 0], JOINT_STATE_SIZE),
        ([1e300, 0], [0, 0], JOINT_STATE_BEYOND),
        ([0, 0], [0, -1e300], JOINT_STATE_BEYOND),
    ],
)
def test_a_joint_state_that_is_none_is_refused_and_changes_nothing(positions, velocities, code):
    lab = Lab()
    with refused(code, BadInput):
        lab.world.joint_state("a", lab.now_ns + 1, positions, velocities)
    lab.go(0.1, 100 * MS)
    assert lab.engine.arms["a"]["q"] == pytest.approx([0.1, 0.0], abs=0.005)


def test_joint_states_that_go_back_in_time_are_left_out_unless_the_clock_began_anew():
    stream = JointStream(1, SECOND, 2 * SECOND)
    assert stream.add(5 * SECOND, [0.1], [0.0], 0)
    assert not stream.add(5 * SECOND - 10 * MS, [0.2], [0.0], 0)
    assert not stream.add(5 * SECOND, [0.2], [0.0], 0)
    assert stream.add(1 * SECOND, [0.3], [0.0], 0)
    assert stream.at(1 * SECOND).positions == (0.3,)


def test_the_motion_goes_through_every_joint_state_and_is_straight_between():
    stream = JointStream(1, SECOND, 2 * SECOND)
    q = np.cumsum(np.random.default_rng(0).uniform(-0.01, 0.01, 20))
    for i, x in enumerate(q):
        stream.add(i * 10 * MS, [x], [0.5], i * 10 * MS - 10 * MS)
        assert stream.known_until(i * 10 * MS, 10 * MS) == (i * 10 * MS if i else None)
        if i:
            middle = stream.at(i * 10 * MS - 5 * MS)
            assert middle.positions[0] == pytest.approx((q[i - 1] + x) / 2)
            assert middle.velocities[0] == pytest.approx((x - q[i - 1]) / 0.01)
        assert stream.at(i * 10 * MS).positions[0] == x


def test_a_slow_stream_is_shown_a_period_late():
    stream = JointStream(1, SECOND, 2 * SECOND)
    for i in range(5):
        stream.add(i * 100 * MS, [0.1 * i], [1.0], i * 100 * MS)
    assert stream.delay_ns == 100 * MS
    assert stream.at(450 * MS).positions[0] == pytest.approx(0.35)
    assert stream.shown_ns(450 * MS) == 350 * MS
    # What comes every two seconds is shown when it comes, and nothing waits for it.
    for i in range(1, 4):
        stream.add(2 * i * SECOND, [1.0 * i], [0.5], 2 * i * SECOND)
    assert stream.known_until(7 * SECOND, 10 * MS) is None
    assert stream.at(6 * SECOND + MS).positions[0] == 3.0


def test_two_opposing_stalled_fingers_hold_and_opening_lets_go_with_the_hands_velocity():
    lab = Lab(gripper=kinds.FINGERS)
    lab.world.spawn("ball", "ball", Pose((0.0, 0.0, 0.47)))
    lab.engine.pinched, lab.engine.block = "ball", 0.02
    before = lab.world.motion("ball").pose
    lab.world.set_program("a", GripperProgram((0.1, 2.0), (True, False)))
    lab.play()
    lab.go(0.0, 1000 * MS)
    assert [e.state for e in lab.of(GraspChanged)] == [Grasp.OPEN, Grasp.CLOSING, Grasp.HOLDING]
    assert lab.world.motion("ball").pose == before
    assert lab.world.object("ball").held_by == "a"
    lab.go(0.5, 1000 * MS)
    assert lab.world.motion("ball").pose.position == pytest.approx((0.5, 0.0, 0.47), abs=0.005)
    lab.go(0.6, 200 * MS)
    assert lab.of(GraspChanged)[-1].state is Grasp.OPEN
    assert lab.world.motion("ball").linear == pytest.approx((0.5, 0.0, 0.0))
    assert lab.world.object("ball").held_by == ""
    assert not lab.of(CollisionChanged)


def test_closing_on_nothing_is_an_empty_grasp():
    lab = Lab(gripper=kinds.FINGERS)
    lab.world.set_program("a", GripperProgram((0.1,), (True,)))
    lab.play()
    lab.go(0.0, 1500 * MS)
    assert [e.state for e in lab.of(GraspChanged)] == [Grasp.OPEN, Grasp.CLOSING, Grasp.EMPTY]


def test_attaching_by_hand_takes_from_another_and_detaching_leaves_an_open_gripper():
    lab = Lab(gripper=kinds.FINGERS, settings=Settings(attach_reach=0.5))
    lab.world.add_robot("b", "<robot/>", ("j1", "j2"), Pose((1.0, 0, 0)), kinds.FINGERS)
    lab.world.joint_state("b", lab.now_ns, [0, 0], [0, 0])
    lab.world.spawn("ball", "ball", Pose((0.5, 0.0, 0.5)))
    lab.go(0.0, 20 * MS)
    lab.world.attach("a", "ball")
    with refused(HOLDS_ALREADY, Misuse, robot="a", object="ball"):
        lab.world.attach("a", "ball")
    lab.world.attach("b", "ball")
    assert lab.world.robot("a").grasp is Grasp.OPEN
    assert lab.world.object("ball").held_by == "b"
    assert lab.world.detach("b") == "ball"
    with refused(HOLDS_NOTHING, Misuse, robot="b"):
        lab.world.detach("b")
    lab.world.spawn("post", "post", Pose((3.0, 0.0, 0.5)))
    with refused(FIXED_OBJECT, Misuse, object="post"):
        lab.world.attach("a", "post")


class Pair(Lab):
    """A lab with a second robot, `b`, whose base is 1 m further along x; it holds its tip at x."""

    def __init__(self, gripper: Gripper) -> None:
        self.b: float | None = None
        super().__init__(gripper=gripper)
        self.world.add_robot("b", "<robot/>", ("j1", "j2"), Pose((1.0, 0, 0)), gripper)
        self.world.spawn("ball", "ball", Pose((0.5, 0.0, 0.5)))

    def both(self, a: float, b: float, duration_ns: int) -> None:
        self.b = b
        self.go(a, duration_ns)

    def send_others(self) -> None:
        if self.b is not None:
            self.world.joint_state("b", self.now_ns, (self.b - 1.0, 0.0), (0.0, 0.0))

    def close(self, robot: str, *opens: float, state: State = State.PLAYING) -> None:
        """Let a robot close from here on, and open so many seconds later."""
        self.world.set_program(
            robot, GripperProgram((0.0, *opens), (True, *(False for _ in opens)))
        )
        clock = PlaybackClock(self.now_ns, 0.0, 1.0)
        playing = Playing(state, "t", clock, 0, 1001, 100.0, 10.0)
        self.world.playback(robot, playing)

    def grasps(self, robot: str) -> list[Grasp]:
        return [e.state for e in self.of(GraspChanged) if e.robot == robot]


def test_a_cup_takes_from_another_that_does_not_take_it_back():
    lab = Pair(kinds.CUP)
    lab.both(0.46, 1.0, 100 * MS)
    lab.close("a")
    lab.both(0.46, 0.56, 100 * MS)
    lab.close("b")
    lab.both(0.46, 0.54, 300 * MS)
    assert lab.world.object("ball").held_by == "b"
    assert lab.grasps("a") == [Grasp.OPEN, Grasp.CLOSING, Grasp.HOLDING, Grasp.EMPTY]
    assert lab.grasps("b") == [Grasp.OPEN, Grasp.CLOSING, Grasp.HOLDING]
    lab.world.detach("b")
    lab.both(0.46, 0.54, 100 * MS)
    assert lab.world.object("ball").held_by == ""
    assert not lab.of(CollisionChanged)


def test_fingers_take_an_object_over_from_fingers_that_open_later():
    lab = Pair(kinds.FINGERS)
    lab.engine.pinched, lab.engine.block = "ball", 0.02
    lab.both(0.46, 1.5, 100 * MS)
    lab.close("a", 3.0)
    lab.both(0.46, 0.54, 1000 * MS)
    assert lab.world.object("ball").held_by == "a"
    lab.close("b")
    before = lab.world.motion("ball").pose
    lab.both(0.46, 0.54, 1000 * MS)
    assert lab.world.object("ball").held_by == "b"
    assert lab.world.motion("ball").pose.position == pytest.approx(before.position, abs=1e-4)
    lab.both(0.46, 0.54, 1500 * MS)
    assert lab.grasps("a")[2:] == [Grasp.HOLDING, Grasp.EMPTY, Grasp.OPEN]
    lab.both(0.46, 0.9, 200 * MS)
    assert lab.world.motion("ball").pose.position[0] > 0.8
    assert not lab.of(CollisionChanged)


def test_what_is_kept_for_a_robot_is_taken_by_no_other_that_closes_on_it():
    lab = Pair(kinds.FINGERS)
    lab.engine.pinched, lab.engine.block = "ball", 0.02
    lab.both(0.46, 0.54, 100 * MS)
    place = lab.world.motion("ball").pose
    lab.world.move("ball", place, (0.0,) * 3, (0.0,) * 3, held=True, kept_for="b")
    lab.close("a")
    lab.both(0.46, 0.54, 2000 * MS)
    assert lab.grasps("a") == [Grasp.OPEN, Grasp.CLOSING, Grasp.EMPTY]
    lab.close("b")
    lab.both(0.46, 0.54, 2000 * MS)
    assert lab.world.object("ball").held_by == "b"


def test_a_gripper_that_closes_where_its_robot_was_put_takes_nothing_over():
    lab = Pair(kinds.FINGERS)
    lab.engine.pinched, lab.engine.block = "ball", 0.02
    lab.both(0.46, 1.5, 100 * MS)
    lab.close("a")
    lab.both(0.46, 0.54, 1000 * MS)
    assert lab.world.object("ball").held_by == "a"
    lab.close("b", state=State.PAUSED)
    lab.both(0.46, 0.54, 2000 * MS)
    assert lab.world.object("ball").held_by == "a"
    assert lab.grasps("b") == [Grasp.OPEN, Grasp.CLOSING, Grasp.EMPTY]


def test_of_two_that_close_on_an_object_together_the_first_keeps_it():
    lab = Pair(kinds.FINGERS)
    lab.engine.pinched, lab.engine.block = "ball", 0.02
    lab.both(0.46, 0.54, 100 * MS)
    lab.close("a")
    lab.close("b")
    lab.both(0.46, 0.54, 2000 * MS)
    assert lab.world.object("ball").held_by == "a"
    assert lab.grasps("b") == [Grasp.OPEN, Grasp.CLOSING, Grasp.EMPTY]


def test_a_robot_put_into_a_surface_may_move_out_of_it():
    lab = Lab()
    lab.world.set_surfaces([wall(1.4)])
    lab.world.add_robot("b", "<robot/>", ("j1", "j2"), Pose((1.0, 0, 0)), kinds.NONE)

    def turn(start: int, stop: int, way: int) -> list[CollisionChanged]:
        for i in range(start, stop, way):
            lab.now_ns += 10 * MS
            lab.world.joint_state("b", lab.now_ns, (i / 200, 0.0), (0.5 * way, 0.0))
            lab.world.advance(lab.now_ns)
        return [e for e in lab.world.take_events() if isinstance(e, CollisionChanged)]

    assert not turn(100, 60, -1)
    (hit,) = turn(60, 100, 1)
    assert (hit.robot, hit.colliding) == ("b", True)


def test_a_robot_removed_while_holding_leaves_the_object_behind():
    lab = Lab()
    lab.world.spawn("ball", "ball", Pose((0.1, 0.0, 0.5)))
    lab.world.attach("a", "ball")
    lab.world.remove_robot("a")
    assert lab.world.object("ball").held_by == ""
    assert not lab.engine.held


def test_the_oldest_free_object_makes_room_and_that_is_announced():
    lab = Lab(settings=Settings(max_objects=3))
    for i in range(3):
        lab.world.spawn("ball", f"ball_{i}", Pose((0.0, 1.0 + i, 0.5)))
    lab.world.attach("a", "ball_0", reach=1.0)
    lab.world.spawn("ball", "", Pose((0.0, 5.0, 0.5)))
    assert [o.name for o in lab.world.objects] == ["ball_0", "ball_2", "ball_3"]
    (removed,) = [e for e in lab.world.take_events() if isinstance(e, ObjectRemoved)]
    assert removed.name == "ball_1"


def test_refused_objects_say_why():
    world = Lab().world
    with refused(NO_OBJECT_TYPE, BadInput, type="cow", known=["ball", "post"]):
        world.spawn("cow")
    with refused(POSE_NOT_FINITE, BadInput):
        world.spawn("ball", pose=Pose((np.nan, 0, 0)))
    with refused(BAD_VECTOR, BadInput, what="position"):
        world.spawn("ball", pose=Pose((1e6, 0, 0)))
    with refused(NAME_TAKEN, BadInput, name="a"):
        world.spawn("ball", "a")
    with refused(NO_OBJECT_IN_SCENE, Misuse, object="ball", known=[]):
        world.remove("ball")
    world.spawn("ball", "ball")
    with refused(BAD_VECTOR, BadInput, what="velocity"):
        world.move("ball", Pose(), (0, 0, 1e9), (0, 0, 0), held=False)


def test_objects_that_leave_the_room_are_removed():
    lab = Lab()
    lab.world.spawn("ball", "ball", Pose((0.0, 0.0, 5.0)))
    lab.engine.motions["ball"] = BodyState(Pose((0.0, 0.0, -50.0)))
    lab.go(0.0, 300 * MS)
    assert [e.name for e in lab.of(ObjectRemoved)] == ["ball"]
    assert not lab.world.objects


def wall(x: float, label: str = "wall") -> Surface:
    square = np.array([[0, -1, -1], [0, 1, -1], [0, 1, 1], [0, -1, 1.0]])
    return Surface("wall", label, Pose((x, 0.0, 0.0)), square, np.zeros((0, 3), np.int32))


def test_a_surface_in_the_robot_counts_once_the_arm_has_left_it():
    lab = Lab()
    lab.go(0.5, 500 * MS)
    assert lab.world.set_surfaces([wall(0.4)]) == ("wall",)
    lab.go(0.45, 300 * MS)
    assert not lab.of(CollisionChanged)
    lab.go(0.3, 300 * MS)
    lab.go(0.5, 300 * MS)
    assert [event.colliding for event in lab.of(CollisionChanged)] == [True]


def test_a_mesh_is_made_of_the_vertices_its_triangles_name():
    vertices = np.arange(3_000_000, dtype=np.float64).reshape(-1, 3) / 1e4
    triangles = np.array([[9, 70, 800], [70, 9, 5]], np.int32)
    (part,) = surface_body(Surface("m", "mesh", Pose(), vertices, triangles), 100).parts
    assert len(part.vertices) == 4
    assert np.array_equal(part.vertices[part.triangles], vertices[triangles])


@pytest.mark.parametrize("state_first", [True, False])
def test_a_world_that_begins_in_a_halt_keeps_it_while_the_arm_is_in_the_wall(state_first):
    lab = Lab()
    lab.world = World(lab.engine, catalogue.parse({"objects": TYPES}), Settings())
    lab.world.set_surfaces([wall(0.4)])
    lab.world.add_robot("a", "<robot/>", ("j1", "j2"), Pose(), kinds.NONE)
    lab.at = np.array([0.45, 0.0])
    if state_first:
        lab.play(state=State.COLLISION_HALT)
        lab.go(0.45, 100 * MS)
    else:
        lab.go(0.45, 100 * MS)
        lab.play(state=State.COLLISION_HALT)
    lab.go(0.45, 800 * MS)
    assert [event.colliding for event in lab.of(CollisionChanged)] == [True]
    lab.go(0.2, 200 * MS)
    lab.go(0.2, 600 * MS)
    assert [event.colliding for event in lab.of(CollisionChanged)] == [True, False]


def test_surfaces_that_are_none_are_refused_and_the_old_ones_stay():
    world = Lab().world
    world.set_surfaces([wall(3.0)])
    line = Surface("line", "", Pose(), np.array([[0, 0, 0], [1, 0, 0], [2, 0, 0.0]]),
                   np.zeros((0, 3), np.int32))  # fmt: skip
    million = Surface("mesh", "", Pose(), np.eye(3), np.zeros((1_000_000, 3), np.int32))
    stray = Surface("stray", "", Pose(), np.eye(3), np.array([[0, 1, 7]], np.int32))
    broken = Surface("broken", "", Pose(), np.eye(3) * np.nan, np.zeros((0, 3), np.int32))
    for surface, code, values in (
        (line, SURFACE_IS_LINE, {"surface": "line"}),
        (million, SURFACE_TOO_FINE, {"count": 1_000_000, "most": 20_000}),
        (stray, SURFACE_NO_VERTEX, {"vertex": 7, "count": 3}),
        (broken, SURFACE_BEYOND, {"surface": "broken"}),
    ):
        with refused(code, BadInput, **values):
            world.set_surfaces([surface])
    assert [s.name for s in world.surfaces] == ["wall", "floor"]


def test_the_engine_has_the_surfaces_of_the_room_and_no_others():
    lab = Lab()
    for room, expected in (
        ([wall(3.0)], {"wall": 3.0}),
        ([wall(3.0)], {"wall": 3.0}),
        ([wall(4.0)], {"wall": 4.0}),
        ([], {}),
    ):
        lab.world.set_surfaces(room)
        assert {n: x for n, x in lab.engine.surfaces.items() if n != rooms.FLOOR} == expected


def seen(world) -> list[tuple[str, str]]:
    return [(surface.name, surface.source) for surface in world.surfaces]


def test_two_headsets_do_not_replace_each_others_surfaces():
    world = Lab().world
    world.set_surfaces([wall(5.0)])
    world.set_surfaces([rooms.floor(), wall(3.0)], "quest_a")
    world.set_surfaces([rooms.floor(), wall(4.0)], "quest_b")
    both = [("wall", ""), ("floor", ""), ("wall_2", "quest_a"), ("wall_3", "quest_b")]
    assert seen(world) == both
    world.set_surfaces([rooms.floor(), wall(3.5)], "quest_a")
    assert sorted(seen(world)) == sorted(both)
    places = {surface.name: surface.pose.position[0] for surface in world.surfaces}
    assert (places["wall"], places["wall_2"], places["wall_3"]) == (5.0, 3.5, 4.0)
    flat = np.array([[0, 0, 0], [1, 0, 0], [2, 0, 0.0]])
    line = Surface("line", "", Pose(), flat, np.zeros((0, 3), np.int32))
    with refused(SURFACE_IS_LINE, BadInput):
        world.set_surfaces([line], "quest_a")
    with refused(BAD_SOURCE, BadInput, count=65, most=64):
        world.set_surfaces([], "x" * 65)
    with refused(SURFACES_OF_ONE_NAME, BadInput, name="wall"):
        world.set_surfaces([wall(1.0), wall(2.0)], "quest_a")
    assert sorted(seen(world)) == sorted(both)
    world.set_surfaces([], "quest_a")
    assert seen(world) == [("wall", ""), ("floor", ""), ("wall_3", "quest_b")]
    # Without a source all are replaced, as a scene file does.
    world.set_surfaces([wall(2.0)])
    assert seen(world) == [("wall", ""), ("floor", "")]


def test_scrubbing_back_puts_the_object_down_and_forward_into_the_hand_again():
    lab = Lab(gripper=kinds.FINGERS)
    lab.world.spawn("ball", "ball", Pose((0.0, 0.0, 0.47)))
    lab.engine.pinched, lab.engine.block = "ball", 0.02
    lab.world.set_program("a", GripperProgram((0.1,), (True,)))
    lab.play()
    lab.go(0.0, 1000 * MS)
    lab.go(1.0, 1000 * MS)
    lab.play(2.0, State.PAUSED)

    def seek(position: float, x: float) -> None:
        lab.play(position, State.PAUSED)
        lab.now_ns += 10 * MS
        lab.at = np.array([x, 0.0])
        lab.world.joint_state("a", lab.now_ns, lab.at, [0.0, 0.0])
        lab.world.advance(lab.now_ns)
        lab.go(x, 200 * MS)

    seek(0.05, 0.0)
    assert lab.world.object("ball").held_by == ""
    assert lab.world.motion("ball").pose.position == pytest.approx((0.0, 0.0, 0.47))
    seek(1.5, 0.5)
    assert lab.world.object("ball").held_by == "a"
    assert lab.world.motion("ball").pose.position == pytest.approx((0.5, 0.0, 0.47), abs=0.005)


def test_snapshots_are_bounded_and_keep_the_whole_run():
    snapshots = Snapshots(10.0, 20)
    for i in range(1000):
        if snapshots.wants(i / 100):
            snapshots.add(Snapshot(i / 100, {}))
    assert len(snapshots) <= 20
    assert snapshots.at(0.0).position == 0.0
    assert snapshots.at(9.9).position > 8.5
    assert snapshots.at(20.0) is None
    snapshots.cut(5.0)
    assert snapshots.at(4.9) is not None
    assert snapshots.at(9.0) is None


def test_clearance_needs_the_margin_without_a_break():
    clearance = Clearance(0.01, 200)
    assert clearance.touched()
    assert not clearance.touched()
    assert not clearance.apart(0, 0.02)
    assert not clearance.apart(100, 0.005)
    assert not clearance.apart(200, 0.02)
    assert not clearance.apart(399, 0.02)
    assert clearance.apart(400, 0.02)
    assert clearance.state is Halt.CLEAR


def test_poses_compose_and_invert():
    a = Pose((1.0, 2.0, 3.0), (0.5, 0.5, 0.5, 0.5))
    b = Pose((-1.0, 0.5, 2.0), (0.0, 0.6, 0.0, 0.8))
    assert compose(a, relative(a, b)).position == pytest.approx(b.position)
    assert compose(a, inverse(a)).position == pytest.approx((0, 0, 0))
    assert compose(a, inverse(a)).orientation == pytest.approx((0, 0, 0, 1))


@pytest.mark.parametrize(
    ("values", "code", "said"),
    [
        ({"step_rate": 1}, LIMITS_BETWEEN, {"low": 60, "high": 2000}),
        ({"speed": 1}, UNKNOWN_FIELD, {"key": "speed"}),
        ({"clear_margin": "wide"}, A_NUMBER, {"unit": "m"}),
        ({"clear_time": 0}, LIMITS_ABOVE, {"low": 0}),
        ({"max_objects": 2.5}, AN_INTEGER, {}),
        ({"stall_time": float("nan")}, BAD_VALUE, {"found": "nan"}),
        ({"clear_time": 0, "step_rat": 240}, MISTAKES, {"count": 2}),
    ],
)
def test_settings_that_cannot_be_are_refused(values, code, said):
    with refused(code, BadInput, **said):
        Settings.from_mapping(values)


@pytest.mark.parametrize(
    ("entry", "code", "values"),
    [
        ({"shape": "box", "size": [1, 1, 1], "mass": 0}, MASS_OR_FIXED, {}),
        ({"shape": "box", "size": [1, 1, 1]}, MISSING_FIELD, {}),
        ({"shape": "box", "size": [1, 1, 1], "mass": float("nan")}, BAD_VALUE, {"found": "nan"}),
        ({"shape": "box", "size": [1, 1], "mass": 1}, COUNTED_NUMBERS, {"count": 3}),
        (
            {"shape": "cow", "size": [1], "mass": 1},
            ONE_OF,
            {"choices": ["box", "cylinder", "sphere"]},
        ),
        ({"shape": "sphere", "size": [99], "mass": 1}, LIMITS_BETWEEN, {"low": 0.002, "high": 5}),
        ({"shape": "sphere", "size": [1], "mass": 1, "fixed": True}, FIXED_WITH_MASS, {}),
        (
            {"shape": "sphere", "size": [1], "mass": 1, "parts": [{"shape": "box"}]},
            SHAPE_AND_PARTS,
            {},
        ),
        ({"shape": "sphere", "size": [1], "weight": 1}, UNKNOWN_FIELD, {"key": "weight"}),
        ({"shape": "sphere", "size": [1], "fixed": "yes"}, TRUE_OR_FALSE, {}),
        (
            {
                "parts": [
                    {"shape": "box", "size": [1, 1, 1]},
                    {"shape": "box", "size": [0, 1, 1]},
                ],
                "mass": 1,
            },
            ENTRY,
            {"one": "part", "number": 2, "place": OBJECT_ENTRY(object="thing")},
        ),
    ],
)
def test_catalogue_entries_that_cannot_be_are_refused(entry, code, values):
    with refused(code, BadInput, **values):
        catalogue.parse({"objects": {"thing": entry}})


def test_a_world_at_rest_is_stepped_less_often_and_goes_on_at_once():
    lab = Lab(gripper=kinds.FINGERS)
    world = lab.world

    def steps(duration_ns):
        before = world.steps
        lab.now_ns += duration_ns
        world.advance(lab.now_ns)
        return world.steps - before

    lab.go(0.1, 500 * MS)
    # The last joint state says that the arm has arrived.
    world.joint_state("a", lab.now_ns + MS, lab.at, (0.0, 0.0))
    steps(SECOND)
    assert world.next_ns - world.now_ns == 50 * MS
    assert steps(SECOND) == 20
    # Its standing pose, said again, changes nothing.
    world.joint_state("a", lab.now_ns, lab.at, (0.0, 0.0))
    assert steps(SECOND) == 20
    # What is put there is looked at.
    world.spawn("ball", "ball", Pose((2.0, 0.0, 0.5)))
    assert steps(100 * MS) > 2
    steps(SECOND)
    # What a person holds may move at any time.
    world.move("ball", Pose((2.0, 0, 0.5)), (0, 0, 0), (0, 0, 0), held=True, hand="left")
    assert world.follow("ball", "left", 2, Pose((2.1, 0, 0.5)))
    assert world.motion("ball").pose.position[0] == pytest.approx(2.1)
    # An older move, one of another hand, and one of what is no object count for nothing.
    for name, hand, sequence in (("ball", "left", 1), ("ball", "right", 3), ("cow", "left", 3)):
        assert not world.follow(name, hand, sequence, Pose((9.0, 0, 0.5)))
    with pytest.raises(BadInput):
        world.follow("ball", "left", 3, Pose((1e9, 0, 0.5)))
    steps(100 * MS)
    assert steps(SECOND) == 240
    # A hand that moves on keeps what it has, one that does not lets go.
    carried = world.carried()
    assert world.follow("ball", "left", 4, Pose((2.0, 0, 0.5)))
    assert world.let_go(carried) == []
    assert world.let_go(world.carried()) == ["ball"]
    assert world.object("ball").held_by == ""
    world.move("ball", Pose((0.15, 0, 0.5)), (0, 0, 0), (0, 0, 0), held=False)
    # A move that was on its way when it was let go.
    assert not world.follow("ball", "left", 5, Pose((2.0, 0, 0.5)))
    # An arm that moves has every step at once, and halts at what it meets.
    steps(SECOND)
    lab.play()
    lab.now_ns += 10 * MS
    before = world.steps
    lab.go(0.12, 200 * MS)
    assert world.steps - before >= 48
    assert [event.colliding for event in lab.of(CollisionChanged)][:1] == [True]


def test_what_a_person_gives_to_a_gripper_halts_no_arm_until_it_has_left_the_fingers():
    lab = Lab(gripper=kinds.FINGERS)
    lab.world.spawn("ball", "ball", Pose((2.0, 0.0, 0.5)))
    lab.play()
    still = (0.0,) * 3
    lab.world.move("ball", Pose((0.2, 0.0, 0.5)), still, still, held=True)
    lab.go(0.19, 190 * MS)
    lab.world.move("ball", Pose((0.2, 0.0, 0.5)), still, still, held=False)
    lab.go(0.2, 100 * MS)
    assert lab.of(CollisionChanged) == []
    lab.go(0.0, 200 * MS)
    lab.go(0.19, 190 * MS)
    assert [event.colliding for event in lab.of(CollisionChanged)] == [True]


def test_backwards_the_objects_go_back_along_the_run():
    lab = Lab(gripper=kinds.FINGERS)
    lab.world.spawn("ball", "ball", Pose((0.0, 0.0, 0.47)))
    lab.world.spawn("ball", "other", Pose((5.0, 0.0, 0.47)))
    lab.engine.pinched, lab.engine.block = "ball", 0.02
    lab.world.set_program("a", GripperProgram((0.1, 1.5), (True, False)))
    lab.play()
    lab.go(0.0, 1000 * MS)
    lab.world.move("other", Pose((6.0, 0.0, 0.47)), (0, 0, 0), (0, 0, 0), held=False)
    lab.go(1.0, 1000 * MS)
    assert lab.world.object("ball").held_by == ""
    kept = len(lab.world.robot("a").snapshots)
    clock = PlaybackClock(lab.now_ns, 2.0, -1.0)
    lab.world.playback("a", Playing(State.PLAYING, "t", clock, 0, 1001, 100.0, 10.0))
    lab.engine.pinched = ""
    lab.go(0.3, 700 * MS)
    assert lab.world.object("ball").held_by == "a"
    assert lab.world.motion("ball").pose.position == pytest.approx((0.3, 0.0, 0.47), abs=0.02)
    lab.go(0.0, 300 * MS)
    lab.go(0.0, 980 * MS)
    assert lab.world.object("ball").held_by == ""
    assert lab.world.motion("ball").pose.position == pytest.approx((0.0, 0.0, 0.47), abs=0.01)
    assert lab.world.motion("other").pose.position == pytest.approx((5.0, 0.0, 0.47), abs=0.01)
    # Nothing was recorded on the way back, and the run is still known.
    assert len(lab.world.robot("a").snapshots) == kept


def test_who_touched_itself_is_free_as_soon_as_it_does_not_touch():
    """Links of one arm are always near each other: no margin is asked of them."""
    lab = Lab()
    own = Touch("tip", Kind.SELF, "a", "base", (0.0, 0.0, 0.5), (1.0, 0.0, 0.0), 0.001, 0.1)
    lab.engine.touches = lambda name: [own]
    lab.engine.distance = lambda arm, kind, *_: 0.0 if kind is Kind.SELF else 1.0
    lab.go(0.01, 20 * MS)
    lab.engine.touches = lambda name: []
    lab.go(0.01, 500 * MS)
    assert [event.colliding for event in lab.of(CollisionChanged)] == [True, False]


def test_what_the_arm_was_put_away_from_is_no_partner_of_its_next_halt():
    lab = Lab()
    lab.world.spawn("post", "post", Pose((0.5, 0.0, 0.5)))
    lab.world.spawn("post", "other", Pose((-0.5, 0.0, 0.5)))
    lab.go(0.46, 460 * MS)
    lab.go(0.3, 200 * MS)
    lab.go(0.3, 500 * MS)
    lab.go(-0.46, 760 * MS)
    # The first post comes near without touching: it halted the arm before, not this time.
    lab.world.move("post", Pose((-0.4, 0.055, 0.5)), (0, 0, 0), (0, 0, 0), held=True)
    lab.go(-0.4, 60 * MS)
    lab.go(-0.4, 500 * MS)
    assert [event.colliding for event in lab.of(CollisionChanged)] == [True, False, True, False]


def test_an_object_that_the_arm_passed_into_stops_it_again_once_it_was_left():
    lab = Lab()
    lab.engine.squeezed = lambda arm, name, normal: (0.0, 0.0, 0.1)
    lab.world.spawn("ball", "ball", Pose((0.5, 0.0, 0.5)))
    lab.go(0.46, 460 * MS)
    assert lab.engine.calls.count("let_pass a ball True") == 1
    assert "let_pass a ball False" not in lab.engine.calls
    lab.go(0.0, 460 * MS)
    assert lab.engine.calls.count("let_pass a ball False") == 1
    assert lab.world.robot("a").passing == set()


def test_a_surface_that_moved_stands_at_its_new_place():
    lab = Lab()
    lab.world.set_surfaces([wall(0.6)])
    lab.world.set_surfaces([wall(0.3)])
    lab.go(0.32, 320 * MS)
    (halt,) = lab.of(CollisionChanged)
    assert halt.contact.touch.other == "wall"
