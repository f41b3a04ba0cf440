"""A playback driven by others: goals of points, and streams of set-points."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from refusals import refused

from mrlab_ros.adapters.robots.library import RobotLibrary
from mrlab_ros.adapters.robots.ruckig_planner import RuckigPlanner
from mrlab_ros.core.base.clock import SECOND
from mrlab_ros.core.base.diagnostics import ILLEGAL_EVENT
from mrlab_ros.core.base.errors import BadInput, Misuse
from mrlab_ros.core.playback import diagnostics as say
from mrlab_ros.core.playback.goal import Code, Goal, Point, WrongGoal
from mrlab_ros.core.playback.playback import Playback
from mrlab_ros.core.playback.pursuit import Bounds, Pursuit
from mrlab_ros.core.playback.states import State
from mrlab_ros.core.trajectory.trajectory import Channels

UR5E = RobotLibrary(Path(__file__).parents[4] / "robots", Path("/nowhere")).model("ur5e")
NAMES = UR5E.joint_names
HOME = UR5E.home
TICK = SECOND // 100
TOUCHES = say.HALTED_BY_CONTACT(link="forearm_link", other="floor")


class Stage:
    """A playback and its time."""

    def __init__(self) -> None:
        self.playback = Playback(UR5E, RuckigPlanner(), 2.0)
        self.now_ns = 1_000 * SECOND
        self.samples = []

    def run(self, seconds: float) -> None:
        """Let time pass, and keep what is sent."""
        end_ns = self.now_ns + round(seconds * SECOND)
        while True:
            due_ns = self.playback.due_ns()
            if due_ns is None or due_ns > end_ns:
                break
            self.now_ns = max(self.now_ns, due_ns)
            sample = self.playback.tick(self.now_ns)
            if sample is not None:
                self.samples.append(sample)
        self.now_ns = end_ns

    def command(self, way: float, **changes) -> bool:
        return self.playback.external.command(self.now_ns, NAMES, (HOME + way).tolist(), **changes)

    def stream(self, ways, period=0.02) -> None:
        for way in ways:
            self.command(way)
            self.run(period)

    def goal(self, *at: tuple[float, float]):
        goal = Goal(NAMES, [Point(time, (HOME + way).tolist()) for time, way in at])
        return self.playback.external.pursue(self.now_ns, goal)

    @property
    def states(self):
        return [status.state for status in self.playback.take_statuses()]

    def fastest(self) -> float:
        arms = np.array([sample.positions for sample in self.samples])
        times = np.array([sample.due_ns for sample in self.samples]) / SECOND
        steps, passed = np.abs(np.diff(arms, axis=0)), np.diff(times)
        # A new goal begins at the instant of a joint state that was sent, with the same pose.
        assert not steps[passed == 0].any()
        return float((steps[passed > 0] / passed[passed > 0, None]).max())


@pytest.fixture
def stage() -> Stage:
    return Stage()


def test_a_goal_is_followed_to_its_last_point(stage: Stage) -> None:
    stage.goal((1.0, 0.5))
    assert stage.playback.state is State.PLAYING
    stage.run(1.1)
    assert stage.states[-3:] == [State.PLAYING, State.COMPLETE, State.READY]
    assert stage.playback.arm == pytest.approx(HOME + 0.5)


def test_a_new_goal_replaces_the_one_that_is_followed_from_where_the_arm_is(stage: Stage) -> None:
    stage.goal((1.0, 0.5))
    stage.run(0.5)
    stage.goal((1.0, 0.0))
    stage.run(1.1)
    assert stage.playback.arm == pytest.approx(HOME)
    assert stage.fastest() < 0.65


@pytest.mark.parametrize("after", [0.5, 0.503])
@pytest.mark.parametrize("driver", ["goal", "load", "command"])
def test_a_goal_takes_over_the_velocity_that_the_arm_has(stage: Stage, driver, after) -> None:
    if driver == "goal":
        stage.goal((1.0, 0.5))
    elif driver == "load":
        stage.goal((1.0, 0.25))
        stage.run(1.1)
        stage.playback.play(stage.now_ns)  # goes back to the start first
        stage.playback.set_rate(stage.now_ns, 2.0)
    else:
        stage.stream(0.005 * i for i in range(1, 100))
        after -= 0.5
    stage.run(after)
    assert stage.playback.moving
    stage.goal((1.0, -0.2))
    stage.run(1.1)
    assert stage.playback.arm == pytest.approx(HOME - 0.2)
    arms = np.array([sample.positions for sample in stage.samples])
    due = np.array([sample.due_ns for sample in stage.samples])
    begin = int(np.searchsorted(due, stage.now_ns - round(1.1 * SECOND)))
    around = slice(begin - 8, begin + 40)
    assert np.diff(due[around]).max() == TICK, "the joint states keep their rhythm"
    speeds = np.diff(arms[around], axis=0) / np.diff(due[around])[:, None] * SECOND
    assert np.abs(np.diff(speeds, axis=0)).max() < 0.1
    assert np.abs(speeds).max() > 0.2


@pytest.mark.parametrize("after", [0.3, 0.999, 1.7])
def test_a_goal_to_an_arm_that_plays_slowly_begins_now(stage: Stage, after) -> None:
    rows = HOME - 0.2 * np.arange(11)[:, None]
    made = stage.goal((1.0, 0.0))
    slow = replace(
        made,
        frame_rate=1.0,
        positions=rows,
        channels=Channels(np.full_like(rows, -0.2), np.zeros_like(rows)),
    )
    stage.playback.stop(stage.now_ns)
    stage.playback.load(stage.now_ns, slow)
    stage.playback.play(stage.now_ns)
    stage.run(3.0)
    stage.run(after)
    count, sent_ns = len(stage.samples), stage.now_ns
    stage.playback.external.pursue(
        sent_ns, Goal(NAMES, [Point(2.0, (stage.playback.arm + 1.5).tolist())])
    )
    stage.run(3.0)
    new = [sample.due_ns for sample in stage.samples[count:] if sample.streamed]
    assert new[0] >= sent_ns
    assert stage.fastest() < 3.14
    assert (np.diff(new) <= TICK).all()


def test_a_bad_goal_changes_nothing(stage: Stage) -> None:
    stage.goal((1.0, 0.5))
    stage.run(0.2)
    stage.states  # noqa: B018
    with pytest.raises(WrongGoal):
        stage.goal((0.01, 2.0))
    assert not stage.states
    stage.run(1.0)
    assert stage.playback.arm == pytest.approx(HOME + 0.5)


def test_a_goal_is_refused_to_a_member_of_a_system_and_in_a_halt(stage: Stage) -> None:
    stage.playback.claim(stage.now_ns, "cell")
    with refused(say.DRIVEN_BY_SYSTEM, Misuse, system="cell"):
        stage.goal((1.0, 0.5))
    stage.playback.release(stage.now_ns, "cell")
    stage.goal((1.0, 0.5))
    stage.run(0.2)
    stage.playback.collide(stage.now_ns, TOUCHES)
    with refused(ILLEGAL_EVENT, Misuse, event="load", state="COLLISION_HALT"):
        stage.goal((1.0, 0.2))


def test_a_stream_moves_the_arm_at_once_and_ends_in_a_pause(stage: Stage) -> None:
    assert stage.command(0.0)
    ways = [0.4 * np.sin(0.02 * i) for i in range(100)]
    stage.stream(ways)
    assert stage.playback.state is State.PLAYING
    assert stage.playback.arm == pytest.approx(HOME + ways[-1], abs=0.01)
    assert len(stage.samples) >= 150, "the joint states keep their rate"
    stage.run(1.0)
    assert stage.playback.state is State.PAUSED
    assert stage.playback.status().message.code == "commands_ended"
    assert stage.playback.arm == pytest.approx(HOME + ways[-1])


def test_the_first_set_point_is_approached_slowly_wherever_it_is(stage: Stage) -> None:
    stage.command(1.5)
    stage.stream([1.5] * 150)
    assert stage.playback.arm == pytest.approx(HOME + 1.5)
    assert stage.fastest() <= 0.31 * 3.15


def test_a_jump_is_refused_and_the_stream_goes_on(stage: Stage) -> None:
    stage.stream([0.0] * 10)
    with refused(say.COMMAND_JUMPS, BadInput, joint="shoulder_pan_joint", value=1.0):
        stage.command(1.0)
    said = stage.playback.status().message
    assert said.code == "command_refused"
    assert said.values["why"].diagnostic.code == "command_jumps"
    # The refusal can be read for a second.
    stage.stream([0.01 * i for i in range(52)])
    assert stage.playback.status().message.code == "follows_commands"
    assert stage.playback.state is State.PLAYING
    assert stage.fastest() < 3.15


def test_a_stream_with_a_jump_at_each_second_set_point_announces_few(stage: Stage) -> None:
    stage.stream([0.0] * 10)
    stage.playback.take_statuses()
    for _ in range(1000):
        with refused(say.COMMAND_JUMPS):
            stage.command(1.0)
        stage.stream([0.0], 0.002)
    told = [status.message.code for status in stage.playback.take_statuses()]
    assert len(told) <= 5, "two for each second of the stream"
    assert told[0] == "command_refused"


@pytest.mark.parametrize(
    ("names", "positions", "velocities", "code", "values"),
    [
        (["a"], [1.0], [], say.WRONG_JOINT_NAMES, {"unknown": ["a"], "missing": NAMES}),
        (NAMES, [0.0] * 5, [], say.WRONG_VALUE_COUNT, {"found": 5, "what": "positions"}),
        (NAMES, [float("nan")] * 6, [], say.VALUE_NOT_FINITE, {"joint": NAMES[0]}),
        (NAMES, [99.0] * 6, [], say.JOINT_OUT_OF_RANGE, {"joint": NAMES[0], "value": 99.0}),
        (NAMES, HOME.tolist(), [99.0] * 6, say.COMMAND_TOO_FAST, {"joint": NAMES[0], "value": 99}),
        (NAMES, HOME.tolist(), [float("nan")] * 6, say.COMMAND_TOO_FAST, {"joint": NAMES[0]}),
        (NAMES, HOME.tolist(), [1.0], say.WRONG_VALUE_COUNT, {"found": 1, "expected": 6}),
    ],
)
def test_a_bad_set_point_is_refused_and_moves_nothing(
    stage: Stage, names, positions, velocities, code, values
) -> None:
    with refused(code, **values):
        stage.playback.external.command(stage.now_ns, names, positions, velocities)
    assert stage.playback.state is State.IDLE
    stage.run(0.1)
    assert stage.playback.arm == pytest.approx(HOME)


def test_without_names_the_values_are_in_the_robot_s_order(stage: Stage) -> None:
    stage.playback.external.command(stage.now_ns, [], (HOME + 0.1).tolist())
    stage.run(0.4)
    assert stage.playback.arm == pytest.approx(HOME + 0.1)


def test_pause_holds_although_the_stream_goes_on_and_play_takes_it_up(stage: Stage) -> None:
    stage.stream([0.0] * 5)
    stage.playback.pause(stage.now_ns)
    for _ in range(50):
        with refused(say.COMMANDS_IGNORED, Misuse, state="PAUSED"):
            stage.command(0.1)
        stage.run(0.02)
    assert stage.playback.arm == pytest.approx(HOME)
    stage.playback.play(stage.now_ns)
    stage.stream([0.1] * 50)
    assert stage.playback.arm == pytest.approx(HOME + 0.1)
    stage.playback.stop(stage.now_ns)
    assert stage.playback.state is State.READY
    stage.run(1.0)
    assert stage.command(0.1), "a stream that begins again is taken"


def test_a_collision_ends_a_stream(stage: Stage) -> None:
    stage.stream([0.01 * i for i in range(10)])
    stage.playback.collide(stage.now_ns, TOUCHES)
    with refused(ILLEGAL_EVENT, Misuse, state="COLLISION_HALT"):
        stage.command(0.1)
    where = stage.playback.arm
    stage.run(1.0)
    assert (stage.playback.arm == where).all()


def test_a_stream_is_not_taken_while_a_trajectory_plays(stage: Stage) -> None:
    stage.goal((1.0, 0.5))
    with refused(ILLEGAL_EVENT, Misuse, event="load", state="PLAYING"):
        stage.command(0.0)


def follow(stage: Stage, bounds: Bounds):
    trajectory = stage.goal((1.0, 0.5))
    pursuit = Pursuit(trajectory, stage.now_ns, bounds)

    def outcome():
        for status in stage.playback.take_statuses():
            pursuit.note(status)
        sample = stage.samples[-1]
        instant = pursuit.instant(stage.now_ns, sample)
        return pursuit.outcome(stage.now_ns, instant)

    stage.playback.take_statuses()
    return outcome


def test_a_pursuit_ends_with_what_happened(stage: Stage) -> None:
    each = dict.fromkeys(NAMES, (0.01, 0.01, 0.01))
    tight = Bounds(path=each, goal=each, time=0.5)
    outcome = follow(stage, tight)
    stage.run(0.5)
    assert outcome() is None
    stage.run(0.6)
    done = outcome()
    assert done.code is Code.SUCCESSFUL
    assert done.figures.values["elapsed"] == done.figures.values["duration"] == 1.0
    assert (done.figures.values["left"], done.figures.values["most"]) == (0.0, pytest.approx(0))


@pytest.mark.parametrize(
    ("bounds", "disturb", "after", "code", "said"),
    [
        (
            Bounds(path=dict.fromkeys(NAMES, (0.05, 0.0, -1.0))), "pause", 0.3,
            Code.PATH_TOLERANCE_VIOLATED, "off_path",
        ),
        (
            Bounds(path={NAMES[2]: (0.0, 0.3, 0.0)}), "pause", 0.02,
            Code.PATH_TOLERANCE_VIOLATED, "off_path",
        ),
        (Bounds(time=0.5), "pause", 2.0, Code.GOAL_TOLERANCE_VIOLATED, "goal_late"),
        (Bounds(), "stop", 0.0, Code.INVALID_GOAL, "goal_stopped"),
        (Bounds(), "collide", 0.0, Code.PATH_TOLERANCE_VIOLATED, "goal_halted"),
        (Bounds(), "goal", 0.0, Code.INVALID_GOAL, "other_trajectory"),
    ],
)  # fmt: skip
def test_a_pursuit_that_is_disturbed(stage: Stage, bounds, disturb, after, code, said) -> None:
    outcome = follow(stage, bounds)
    stage.run(0.3)
    if disturb == "goal":
        stage.goal((1.0, 0.0))
    elif disturb == "collide":
        stage.playback.collide(stage.now_ns, TOUCHES)
    else:
        getattr(stage.playback, disturb)(stage.now_ns)
    stage.run(after)
    found = outcome()
    assert found.code is code
    assert found.said.code == said
    if disturb == "pause":
        assert found.said.values["state"] == "PAUSED"


def test_without_tolerances_a_pause_ends_nothing(stage: Stage) -> None:
    outcome = follow(stage, Bounds())
    stage.run(0.3)
    stage.playback.pause(stage.now_ns)
    stage.run(2.0)
    assert outcome() is None
    stage.playback.play(stage.now_ns)
    stage.run(1.0)
    assert outcome().code is Code.SUCCESSFUL


def test_tolerances_name_joints() -> None:
    with refused(say.TOLERANCE_OF_NO_JOINT, WrongGoal, found="x"):
        Bounds(path={"x": 1.0}).check(NAMES)
    with refused(say.TOLERANCE_NO_NUMBER, WrongGoal, joint=NAMES[0]):
        Bounds(goal={NAMES[0]: (0.0, 0.0, float("nan"))}).check(NAMES)
    with refused(say.TOLERANCE_NO_NUMBER, WrongGoal, joint=NAMES[0], tolerance=-0.5):
        Bounds(path={NAMES[0]: (0.1, -0.5, 0.0)}).check(NAMES)
    Bounds(path={NAMES[0]: (-1.0, 0.0, 0.1)}, time=-1.0).check(NAMES)


def test_an_acceleration_is_the_change_of_the_velocity_s_error(stage: Stage) -> None:
    outcome = follow(stage, Bounds(path={NAMES[2]: (0.0, 0.0, 5.0)}))
    stage.run(0.3)
    assert outcome() is None
    stage.playback.pause(stage.now_ns)
    stage.run(0.05)
    values = outcome().said.values
    assert (values["unit"], values["value"]) == ("rad/s^2", pytest.approx(0.5 / 0.05))


def test_the_course_is_known_from_its_newest_change_to_its_end(stage: Stage) -> None:
    with refused(say.FOLLOWS_NOTHING, state="IDLE"):
        stage.playback.at(stage.now_ns)
    stage.goal((2.0, 1.0))
    began = stage.now_ns
    stage.run(0.5)
    positions, velocities, accelerations = stage.playback.at(began + SECOND)
    assert positions == pytest.approx(HOME + 0.5)
    assert velocities == pytest.approx(np.full(6, 0.5))
    assert accelerations == pytest.approx(np.zeros(6), abs=1e-9)
    with refused(say.OUTSIDE_COURSE, side="after"):
        stage.playback.at(began + 3 * SECOND)
    stage.playback.pause(stage.now_ns)
    with refused(say.OUTSIDE_COURSE, side="before"):
        stage.playback.at(began)
    standing = stage.playback.at(began + 9 * SECOND)
    assert standing[0] == pytest.approx(stage.playback.arm)
    assert not standing[1].any()
