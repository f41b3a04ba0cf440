"""Robot systems, driving real playback cores on a clock that the tests move by hand."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
import pytest
from fakes import SECOND, StraightPlanner, make_model, make_trajectory
from hypothesis import example, given, settings
from hypothesis import strategies as st
from refusals import refused

from mrlab_ros.core.base.diagnostics import (
    BAD_POSITION,
    ILLEGAL_EVENT,
    NAME_TAKEN,
    NO_ROBOT_IN_SCENE,
)
from mrlab_ros.core.base.errors import BadInput, IllegalEvent, LabError, Misuse, Unreached
from mrlab_ros.core.playback import diagnostics as playback_codes
from mrlab_ros.core.playback.playback import Playback
from mrlab_ros.core.playback.saved_state import come_back as back
from mrlab_ros.core.playback.saved_state import keep
from mrlab_ros.core.playback.states import Event, State
from mrlab_ros.core.systems import diagnostics as say
from mrlab_ros.core.systems.members import (
    Command,
    Loaded,
    Order,
    Reply,
)
from mrlab_ros.core.systems.registry import Systems
from mrlab_ros.core.systems.robot_system import RobotSystem
from mrlab_ros.core.systems.states import TABLE, Policy, SystemEvent, SystemState
from mrlab_ros.core.systems.timeline import Member, Mode
from mrlab_ros.core.systems.waits import parse
from mrlab_ros.core.trajectory.trajectory import Trajectory

MS = SECOND // 1000
PERIOD = 10 * MS
TOUCHES = playback_codes.HALTED_BY_CONTACT(link="link_5", other="cube_1")


class World:
    """Robots that obey at once, and the time they live in."""

    def __init__(self, frames: dict[str, int], rates: dict[str, float] | None = None) -> None:
        self.now = 5 * SECOND
        self.playbacks: dict[str, Playback] = {}
        self.sent: dict[str, list] = {robot: [] for robot in frames}
        self.seen: dict[str, State] = {}
        self.refusing: set[str] = set()
        # Robots whose process does not answer.
        self.frozen: set[str] = set()
        # Orders that wait for them.
        self.left: list[Order] = []
        self.catalogue: dict[str, Trajectory] = {}
        self.announced: list[tuple[SystemState, str]] = []
        self.system: RobotSystem
        for robot, count in frames.items():
            playback = Playback(make_model(), StraightPlanner(), 0.0)
            positions = np.column_stack([np.arange(count), -np.arange(count)]) * 1e-3 + 1.0
            rate = (rates or {}).get(robot, 100.0)
            playback.load(0, make_trajectory(positions, frame_rate=rate, trajectory_id=robot))
            self.playbacks[robot] = playback

    # the fleet

    def claim(self, robots: Sequence[str]) -> list[Loaded]:
        found = []
        for robot in robots:
            self._answer(robot)
            playback = self.playbacks[robot]
            playback.claim(self.now, "cell")
            playback.take_statuses()
            had = playback.trajectory
            name, *lengths = (had.id, had.duration, had.frame_rate) if had else ("", 0.0, 0.0)
            position = playback.clock.position
            found.append(Loaded(name, *lengths, self.now, playback.state, position))
        return found

    def release(self, robots: Sequence[str]) -> None:
        for robot in robots:
            self._answer(robot)
            self.playbacks[robot].release(self.now, "cell")

    def load(self, trajectories: Mapping[str, str]) -> None:
        for robot, trajectory_id in trajectories.items():
            playback = self.playbacks[robot]
            if trajectory_id not in self.catalogue:
                raise BadInput(say.NO_SYSTEM(system=trajectory_id))
            playback.load(self.now, self.catalogue[trajectory_id])
            playback.take_statuses()

    def reach(self, orders: Sequence[Order], timeout: float | None = None) -> list[Reply | None]:
        replies: list[Reply | None] = []
        for order in orders:
            try:
                replies += self.drive([order])
            except Unreached:
                replies.append(None)
            except LabError:
                replies.append(Reply(State.IDLE, 0.0, stamp_ns=self.now))
        return replies

    def leave(self, orders: Sequence[Order]) -> None:
        self.left += orders

    def _answer(self, robot: str) -> None:
        if robot in self.frozen:
            raise Unreached(say.PLAYBACK_SILENT(robots=[robot], timeout=2.0))

    def drive(self, orders: Sequence[Order]) -> list[Reply]:
        replies = []
        for order in orders:
            self._answer(order.robot)
            if order.robot in self.refusing:
                raise Misuse(playback_codes.ROBOT_GONE(robot=order.robot))
            playback, duration = self.playbacks[order.robot], 0.0
            if order.command is Command.STAGE:
                duration = playback.stage(self.now, order.position, by="cell")
            elif order.command is Command.PLAY:
                playback.play(self.now, order.stamp_ns, order.rate, order.until, by="cell")
            elif order.command is Command.PAUSE:
                playback.pause(self.now, by="cell")
            elif order.command is Command.STOP:
                playback.stop(self.now, by="cell")
            elif order.command is Command.SEEK:
                playback.seek(self.now, order.position, by="cell")
            elif order.command is Command.SET_RATE:
                playback.set_rate(self.now, order.rate, order.stamp_ns, by="cell")
            elif order.command is Command.HOLD:
                playback.hold_at(order.until, by="cell")
            # The reply has the state; as over the wire, an older status is out of date.
            playback.take_statuses()
            replies.append(Reply(playback.state, playback.clock.position, duration, self.now))
        return replies

    # time

    def advance(self, seconds: float) -> None:
        """Let time pass in steps of a millisecond; report to the system what its members do."""
        for _ in range(round(seconds * 1000)):
            self.now += MS
            for robot, playback in self.playbacks.items():
                while (due := playback.due_ns()) is not None and due <= self.now:
                    sample = playback.tick(self.now)
                    if sample is not None and sample.streamed:
                        self.sent[robot].append((sample.due_ns, sample.frame, self.now))
            self.report()
            self.system.poll(self.now)

    def announce(self) -> None:
        self.announced.append((self.system.state, self.system.message))

    def report(self) -> None:
        for robot, playback in self.playbacks.items():
            for snapshot in playback.take_statuses():
                if robot in self.system.members:
                    self.system.member_changed(
                        self.now, robot, snapshot.state, snapshot.clock.position
                    )

    def run_until(self, state: SystemState, seconds: float = 60.0) -> None:
        for _ in range(round(seconds * 100)):
            if self.system.state is state:
                return
            self.advance(0.01)
        raise AssertionError(f"{self.system.state} and not {state}: {self.system.message}")

    def play_to_the_end(self) -> None:
        self.system.play(self.now)
        self.run_until(SystemState.READY)

    def frames(self, robot: str) -> list[int]:
        return [frame for _, frame, _ in self.sent[robot]]

    def first_due(self, robot: str) -> int:
        return self.sent[robot][0][0]


def make(
    frames: dict[str, int],
    mode: Mode = Mode.PARALLEL,
    waits: dict[str, list[str]] | None = None,
    dwell: float = 0.0,
    rates: dict[str, float] | None = None,
    **options,
) -> World:
    world = World(frames, rates)
    members = [
        Member(robot, dwell=dwell, waits=tuple(map(parse, (waits or {}).get(robot, []))))
        for robot in frames
    ]
    world.system = RobotSystem("cell", members, world, mode, announce=world.announce, **options)
    world.system.prepare()
    world.report()
    return world


def playing(world: World, seconds: float = 0.0) -> World:
    """Play for some time."""
    world.system.play(world.now)
    world.run_until(SystemState.PLAYING)
    world.advance(seconds)
    return world


TWO = {"a": 101, "b": 51}


def test_parallel_members_begin_at_one_stamp_after_all_have_arrived():
    world = make(TWO)
    assert world.system.duration == 1.0
    assert world.system.play(world.now) == 0.5
    assert world.system.state is SystemState.STAGING
    assert said(world) == ("stages", {"duration": 0.5})
    world.advance(0.4)
    assert world.sent == {"a": [], "b": []}
    world.run_until(SystemState.READY)
    assert world.first_due("a") == world.first_due("b")
    assert world.frames("a") == list(range(101))
    assert world.frames("b") == list(range(51))
    assert world.system.message.code == "played_to_end"


def test_sequential_members_follow_each_other_with_dwell_to_the_nanosecond():
    world = make({"a": 101, "b": 51, "c": 11}, Mode.SEQUENTIAL, dwell=0.25)
    assert world.system.duration == pytest.approx(1.0 + 0.25 + 0.5 + 0.25 + 0.1)
    world.play_to_the_end()
    begin = world.first_due("a")
    assert world.first_due("b") == begin + 1_250_000_000
    assert world.first_due("c") == begin + 2_000_000_000
    assert [world.frames(r) for r in "abc"] == [list(range(n)) for n in (101, 51, 11)]


@pytest.mark.parametrize("mode", Mode)
def test_pause_and_play_keep_every_frame_and_the_common_line(mode):
    world = make({"a": 201, "b": 201}, mode, rates={"b": 50.0})
    world.system.play(world.now)
    for _ in range(7):
        world.advance(0.33)
        if world.system.state is SystemState.PLAYING:
            world.system.pause(world.now)
            world.advance(0.107)
            assert {p.state for p in world.playbacks.values()} <= {State.PAUSED, State.READY}
            world.play_to_the_end()
    for robot in "ab":
        assert world.frames(robot) == list(range(201))
    # Frame k of a and of b left at instants that differ as the timeline says, to a nanosecond.
    if mode is Mode.PARALLEL:
        due = {frame: at for at, frame, _ in world.sent["b"]}
        ends = [world.sent[robot][-1][0] for robot in "ab"]
        assert due[200] == ends[1]
        a = {frame: at for at, frame, _ in world.sent["a"]}
        assert abs((a[200] - a[199]) - PERIOD) <= 1


def test_seek_in_sequential_mode_puts_those_before_at_their_end_and_those_behind_at_their_start():
    world = make({"a": 101, "b": 101, "c": 101}, Mode.SEQUENTIAL)
    world.system.seek(world.now, 1.5)
    assert [p.clock.position for p in world.playbacks.values()] == [1.0, 0.5, 0.0]
    world.play_to_the_end()
    assert world.frames("a") == []
    assert world.frames("b") == list(range(50, 101))
    assert world.frames("c") == list(range(101))


def test_a_stop_rewinds_the_timeline():
    world = playing(make(TWO), 0.1)
    world.system.stop(world.now)
    assert (world.system.state, world.system.clock.position) == (SystemState.READY, 0.0)


def test_seek_while_playing_plays_on_from_there():
    world = playing(make(TWO), 0.2)
    world.system.seek(world.now, 0.8)
    assert world.system.state is SystemState.PLAYING
    world.run_until(SystemState.READY)
    assert world.frames("a")[-20:] == list(range(81, 101))
    assert 50 not in world.frames("b")


def test_step_goes_frame_by_frame_and_stops_at_the_ends():
    world = make(TWO)
    world.system.seek(world.now, 0.5)
    assert world.system.step(world.now, 1) == 0.51
    assert world.system.step(world.now, -2) == 0.49
    assert world.system.step(world.now, 1000) == 1.0
    assert world.system.step(world.now, -1000) == 0.0
    world.system.play(world.now)
    world.run_until(SystemState.PLAYING)
    with refused(ILLEGAL_EVENT, Misuse, event="step", state="PLAYING"):
        world.system.step(world.now, 1)


@pytest.mark.parametrize("mode", Mode)
@pytest.mark.parametrize("rate", [0.5, 2.0, 4.0])
def test_a_rate_change_on_the_way_keeps_the_members_on_one_line(mode, rate):
    world = playing(make({"a": 201, "b": 201}, mode), 0.5)
    world.system.set_rate(world.now, rate)
    line = world.system.clock
    world.run_until(SystemState.READY)
    for robot in "ab":
        start = world.system.members[robot].start
        assert abs(world.sent[robot][-1][0] - line.due(start + 2.0)) <= 2
        assert world.frames(robot)[-1] == 200


def test_loop_stages_and_begins_anew():
    world = make({"a": 21, "b": 11}, loop=True)
    world.system.play(world.now)
    world.advance(3.0)
    states = [state.name for state, _ in world.announced]
    assert states[:4] == ["PLAYING", "COMPLETE", "STAGING", "PLAYING"]
    assert world.frames("a")[:42] == [*range(21), *range(21)]
    world.system.loop = False
    world.run_until(SystemState.READY)


def test_a_collision_halts_all_in_one_step_and_all_clear_resumes_in_place():
    world = playing(make({"a": 201, "b": 201}), 0.5)
    world.playbacks["a"].collide(world.now, TOUCHES)
    world.report()
    assert world.system.state is SystemState.COLLISION_HALT
    assert world.playbacks["b"].state is State.PAUSED
    counts = [len(s) for s in world.sent.values()]
    with refused(ILLEGAL_EVENT, Misuse, event="play", state="COLLISION_HALT"):
        world.system.play(world.now)
    world.advance(1.0)
    assert [len(s) for s in world.sent.values()] == counts
    world.playbacks["a"].clear(world.now)
    world.report()
    assert world.system.state is SystemState.PAUSED
    world.play_to_the_end()
    assert world.frames("a") == world.frames("b") == list(range(201))


@pytest.mark.parametrize("mode", Mode)
def test_a_collision_of_a_member_alone_lets_the_others_go_on(mode):
    world = playing(make({"a": 201, "b": 201}, mode, policy=Policy.HALT_MEMBER), 0.5)
    world.playbacks["a"].collide(world.now, TOUCHES)
    world.advance(3.0)
    assert world.system.state is SystemState.PLAYING
    assert world.frames("b") == ([] if mode is Mode.SEQUENTIAL else list(range(201)))
    world.playbacks["a"].clear(world.now)
    world.run_until(SystemState.READY)
    assert world.frames("a") == world.frames("b") == list(range(201))
    if mode is Mode.SEQUENTIAL:
        assert world.first_due("b") >= world.sent["a"][-1][0]


def test_a_collision_while_staging_stops_all_and_nothing_starts():
    world = make(TWO)
    world.system.play(world.now)
    world.advance(0.1)
    world.playbacks["b"].collide(world.now, TOUCHES)
    world.advance(2.0)
    assert world.system.state is SystemState.COLLISION_HALT
    assert world.sent == {"a": [], "b": []}
    world.playbacks["b"].clear(world.now)
    world.advance(0.01)
    world.play_to_the_end()
    assert world.frames("b") == list(range(51))


def test_a_member_that_refuses_brings_all_to_rest():
    world = make(TWO)
    world.refusing = {"b"}
    with refused(playback_codes.ROBOT_GONE, Misuse, robot="b"):
        world.system.play(world.now)
    assert world.system.state is SystemState.READY
    assert world.playbacks["a"].state is State.READY
    world.refusing = set()
    world.play_to_the_end()
    assert world.frames("b") == list(range(51))


def test_a_staging_that_never_ends_is_given_up():
    world = make(TWO)
    world.system.play(world.now)
    world.playbacks["b"].due_ns = lambda: None
    world.run_until(SystemState.READY, 20.0)
    assert said(world) == ("late_at_start", {"robots": ["b"]})
    assert world.sent == {"a": [], "b": []}


def said(world: World) -> tuple[str, dict]:
    return world.system.message.code, dict(world.system.message.values)


def lose(world: World, robot: str) -> None:
    """Put a new playback in the place of a robot's, as if its process had been restarted."""
    trajectory = world.playbacks[robot].trajectory
    world.playbacks[robot] = Playback(make_model(), StraightPlanner(), 0.0)
    world.playbacks[robot].load(0, trajectory)
    world.playbacks[robot].take_statuses()
    world.system.member_changed(world.now, robot, State.IDLE, 0.0)


def come_back(world: World, position: float, rate: float) -> None:
    """Make the system anew, as if the coordinator had been restarted."""
    members = [
        Member(m.robot, m.trajectory_id, duration=m.duration, frame_rate=m.frame_rate)
        for m in world.system.members.values()
    ]
    world.system = RobotSystem("cell", members, world, announce=world.announce)
    world.system.come_back(world.now, position, rate)


def test_a_system_whose_member_lost_its_playback_stands_in_place_and_plays_on():
    world = playing(make(TWO), 0.3)
    lose(world, "a")
    assert world.system.state is SystemState.PAUSED
    assert said(world) == ("member_lost", {"robot": "a"})
    assert world.playbacks["b"].state is State.PAUSED
    place = world.system.clock.position
    assert 0.1 < place < 0.3
    world.sent = {"a": [], "b": []}
    world.play_to_the_end()
    assert world.frames("a")[-1] == 100
    assert world.frames("a")[0] == pytest.approx(place * 100, abs=1)
    assert world.frames("b")[0] == pytest.approx(place * 100, abs=1)


def test_a_member_that_comes_back_with_its_trajectory_is_claimed_again():
    world = playing(make(TWO), 0.3)
    lose(world, "a")
    world.system.member_changed(world.now, "a", State.READY, 0.0, owner="", trajectory_id="other")
    assert world.playbacks["a"].system == ""
    world.system.member_changed(world.now, "a", State.READY, 0.0, owner="", trajectory_id="a")
    assert world.playbacks["a"].system == "cell"
    assert world.system.state is SystemState.PAUSED


def test_a_member_that_obeys_nobody_any_more_pauses_the_system_and_is_claimed_again():
    world = playing(make(TWO), 0.3)
    world.playbacks["a"].release(world.now, "cell")
    world.playbacks["a"].take_statuses()
    world.system.member_changed(world.now, "a", State.PAUSED, 0.2, owner="", trajectory_id="a")
    assert world.system.state is SystemState.PAUSED
    assert world.playbacks["b"].state is State.PAUSED
    assert world.playbacks["a"].system == "cell"
    world.play_to_the_end()
    assert world.frames("a") == list(range(101))


def test_a_restarted_system_stands_in_place_and_takes_its_members_back():
    world = playing(make(TWO), 0.3)
    come_back(world, 0.2, 1.0)
    assert said(world)[0] == "coordinator_restarted"
    assert (world.system.state, world.system.clock.position) == (SystemState.PAUSED, 0.2)
    # They still play for the one that is gone.
    for robot in TWO:
        world.system.member_changed(
            world.now, robot, State.PLAYING, 0.3, owner="cell", trajectory_id=robot
        )
    assert {p.state for p in world.playbacks.values()} == {State.PAUSED}
    world.play_to_the_end()
    assert world.frames("a")[-1] == 100


def test_an_old_report_with_a_later_stamp_does_not_move_a_restarted_system_for_good():
    """The clock was set back: what a member said before that has a stamp ahead of all later."""
    world = make(TWO)
    come_back(world, 0.0, 1.0)
    for robot in TWO:
        world.system.member_changed(
            world.now, robot, State.PAUSED, 0.0, owner="cell", trajectory_id=robot
        )
    ahead = world.now + 600 * SECOND
    world.system.member_changed(world.now, "a", State.PAUSED, 0.2, ahead, "cell", "a")
    assert world.system.clock.position == 0.2
    world.system.member_changed(world.now, "a", State.PAUSED, 0.0, world.now, "cell", "a")
    assert world.system.clock.position == 0.0


def test_a_member_that_comes_back_in_a_halt_halts_the_system():
    world = playing(make(TWO), 0.3)
    world.playbacks["a"].collide(world.now, TOUCHES)
    world.playbacks["a"].take_statuses()
    world.system.members["a"].playback_state = State.IDLE
    world.system.pause(world.now)
    world.system.member_changed(
        world.now, "a", State.COLLISION_HALT, 0.3, owner="", trajectory_id="a"
    )
    assert world.system.state is SystemState.COLLISION_HALT
    assert said(world) == ("still_collides", {"robot": "a"})
    world.playbacks["a"].clear(world.now)
    world.report()
    assert world.system.state is SystemState.PAUSED


def test_a_system_of_a_robot_that_is_halted_begins_in_the_halt():
    world = playing(make(TWO), 0.3)
    world.playbacks["a"].collide(world.now, TOUCHES)
    world.report()
    # A member left, which ended the system; it is made again.
    world.system = RobotSystem("cell", [Member("a"), Member("b")], world)
    world.system.prepare()
    assert world.system.state is SystemState.COLLISION_HALT
    assert said(world) == ("still_collides", {"robot": "a"})
    world.playbacks["a"].clear(world.now)
    world.report()
    assert world.system.state is SystemState.PAUSED
    world.play_to_the_end()


def test_a_stop_that_does_not_reach_a_member_is_repeated_until_it_does():
    world = playing(make(TWO))
    world.frozen = {"b"}
    world.system.stop(world.now)
    assert world.system.state is SystemState.STOPPING
    assert world.system.message.code == "may_still_move"
    assert world.system.message.values["robots"] == ["b"]
    assert world.playbacks["a"].state is State.READY
    with refused(ILLEGAL_EVENT, Misuse, event="play", state="STOPPING"):
        world.system.play(world.now)
    world.now += 5 * SECOND
    world.system.poll(world.now)
    assert world.system.state is SystemState.STOPPING
    world.frozen = set()
    world.now += 5 * SECOND
    world.system.poll(world.now)
    assert world.system.state is SystemState.READY
    assert world.playbacks["b"].state is State.READY
    world.sent = {"a": [], "b": []}
    world.play_to_the_end()
    assert world.frames("b") == list(range(51))


def freeze(world: World, seconds: float = 0.3) -> float:
    """Let the process of `b` freeze in a run; return where the timeline is, s."""
    world.system.play(world.now)
    world.run_until(SystemState.PLAYING)
    world.advance(seconds)
    world.frozen = {"b"}
    return world.system.clock.at(world.now)


def thaw(world: World) -> None:
    """Let `b` run again; it has missed every order, and plays on."""
    world.frozen = set()
    world.system.member_changed(
        world.now, "b", world.playbacks["b"].state, 0.3, owner="cell", trajectory_id="b"
    )


@pytest.mark.parametrize("killed", [False, True])
def test_a_pause_that_does_not_reach_a_member_pauses_in_place(killed):
    world = make(TWO)
    place = freeze(world)
    world.system.pause(world.now)
    assert world.system.state is SystemState.PAUSED
    assert world.system.message.code == "paused_without"
    assert world.system.message.values["robots"] == ["b"]
    assert world.system.clock.position == pytest.approx(place)
    assert world.playbacks["a"].state is State.PAUSED
    world.now += 5 * SECOND
    world.system.poll(world.now)
    world.system.pause(world.now)
    with pytest.raises(Unreached):
        world.system.play(world.now)
    assert world.system.state is SystemState.PAUSED
    if killed:
        lose(world, "b")
    thaw(world)
    assert world.playbacks["b"].state is not State.PLAYING
    assert world.playbacks["b"].system == "cell"
    world.sent = {"a": [], "b": []}
    world.play_to_the_end()
    assert world.system.message.code == "played_to_end"
    assert world.frames("a")[0] == pytest.approx(place * 100, abs=1)
    assert world.frames("b")[-1] == 50


def test_a_refused_seek_that_does_not_reach_a_member_leaves_the_system_where_it_was():
    world = make(TWO)
    place = freeze(world)
    with pytest.raises(Unreached):
        world.system.seek(world.now, 0.05)
    assert world.system.state is SystemState.PAUSED
    assert world.system.clock.position == pytest.approx(place)
    thaw(world)
    world.frozen = {"b"}
    with pytest.raises(Unreached):
        world.system.seek(world.now, 0.05)
    assert world.system.state is SystemState.PAUSED
    assert world.system.clock.position == pytest.approx(place)
    assert world.system.members["a"].position == pytest.approx(place)


def test_a_member_that_does_not_answer_its_start_pauses_the_system():
    world = make({"a": 101, "b": 51}, Mode.SEQUENTIAL)
    freeze(world)
    world.advance(0.2)
    with pytest.raises(Unreached):
        world.advance(1.0)
    assert world.system.state is SystemState.PAUSED
    assert world.playbacks["a"].state is State.PAUSED
    assert world.system.clock.position > 0.5
    assert said(world) == ("members_silent", {"robots": ["b"]})


def test_a_member_that_loops_by_itself_does_not_keep_the_system_from_ending():
    world = World(TWO)
    world.playbacks["a"].set_loop(True)
    world.system = RobotSystem("cell", [Member(robot) for robot in TWO], world)
    world.system.prepare()
    world.report()
    world.play_to_the_end()
    assert world.frames("a") == list(range(101))


def test_a_member_waits_for_another_s_frame():
    world = make({"a": 101, "b": 51}, waits={"b": ["frame 0: after a.frame 60"]})
    world.play_to_the_end()
    begin = world.first_due("b") - world.first_due("a")
    assert 0.6 * SECOND <= begin <= 0.75 * SECOND
    assert world.frames("b") == list(range(51))


def test_a_hold_on_the_way_whose_signal_came_before_is_not_felt():
    world = make({"a": 101, "b": 101}, waits={"b": ["frame 80: after a.frame 20"]})
    world.play_to_the_end()
    assert world.first_due("a") == world.first_due("b")
    assert world.sent["a"][-1][0] == world.sent["b"][-1][0]


def test_a_hand_over_waits_for_the_object_whatever_time_that_takes():
    waits = {
        "a": ["frame 50: object cube_1 held by b"],
        "b": ["frame 0: after a.frame 40", "frame 30: object cube_1 free"],
    }
    world = make({"a": 101, "b": 61}, waits=waits)
    world.system.grasped(world.now, "a", "cube_1")
    world.system.play(world.now)
    world.run_until(SystemState.PLAYING)
    world.advance(3.0)
    assert world.frames("a")[-1] == 50
    assert world.frames("b")[-1] == 30
    assert world.system.members["b"].waiting_for.text == "frame 30: object cube_1 free"
    world.system.grasped(world.now, "a", None)
    world.advance(0.2)
    world.system.grasped(world.now, "b", "cube_1")
    world.run_until(SystemState.READY)
    assert world.frames("a") == list(range(101))
    assert world.frames("b") == list(range(61))


def test_in_sequential_mode_those_behind_a_wait_follow_it():
    waits = {"a": ["frame 50: object cube_1 held by a"]}
    world = playing(make({"a": 101, "b": 51}, Mode.SEQUENTIAL, waits=waits), 4.0)
    assert world.frames("b") == []
    world.system.grasped(world.now, "a", "cube_1")
    world.run_until(SystemState.READY)
    assert world.first_due("b") == world.sent["a"][-1][0]


@pytest.mark.parametrize(
    ("wait", "code", "values"),
    [
        ("frame 0: after x.frame 1", say.WAIT_FOR_STRANGER, {"robot": "x", "members": ["a", "b"]}),
        ("frame 10: after b.frame 20", say.WAIT_FOR_ITSELF, {"robot": "b"}),
        ("frame 51: after a.frame 1", say.WAIT_BEYOND_END, {"frame": 51, "last_frame": 50}),
        ("when ready", say.BAD_WAIT, {"wait": "when ready"}),
    ],
)
def test_a_wait_that_cannot_be_is_refused(wait, code, values):
    with refused(code, BadInput, **values):
        make(TWO, waits={"b": [wait]})


def test_the_mode_changes_only_while_nothing_is_under_way():
    world = make(TWO)
    world.system.set_mode(Mode.SEQUENTIAL)
    assert world.system.duration == 1.5
    world.system.play(world.now)
    with refused(say.STOP_FIRST, IllegalEvent):
        world.system.set_mode(Mode.PARALLEL)


@pytest.mark.parametrize("position", [-1.0, 1.1, float("nan")])
def test_a_place_off_the_timeline_is_refused(position):
    world = make(TWO)
    with refused(BAD_POSITION, BadInput, duration=1.0):
        world.system.seek(world.now, position)
    assert world.system.state is SystemState.READY


step = st.tuples(
    st.sampled_from(
        ["play", "pause", "stop", "seek", "rate", "collide", "clear", "lose", "wait", "wait"]
    ),
    st.sampled_from(["a", "b", "c"]),
    st.floats(0, 1),
)


@settings(max_examples=50, deadline=None)
@given(st.sampled_from(list(Mode)), st.sampled_from(list(Policy)), st.lists(step, max_size=25))
@example(
    Mode.PARALLEL,
    Policy.HALT_ALL,
    [
        ("rate", "a", 0.65625),
        ("play", "a", 0.59375),
        ("play", "a", 0.765625),
        ("play", "a", 0.671875),
        ("play", "a", 0.34375),
        ("rate", "a", 0.0),
    ],
)
@pytest.mark.slow
def test_whatever_happens_no_member_moves_while_the_system_stands_and_play_recovers(
    mode, policy, steps
):
    world = make({"a": 31, "b": 21, "c": 11}, mode, policy=policy)
    system = world.system
    for name, robot, x in steps:
        playback = world.playbacks[robot]
        try:
            if name == "play":
                system.play(world.now)
            elif name == "pause":
                system.pause(world.now)
            elif name == "stop":
                system.stop(world.now)
            elif name == "seek":
                system.seek(world.now, x * system.duration)
            elif name == "rate":
                system.set_rate(world.now, (0.1 + 3.9 * x) * (-1 if round(16 * x) % 2 else 1))
            elif name == "collide":
                playback.collide(world.now, TOUCHES)
            elif name == "clear":
                playback.clear(world.now)
            elif name == "lose":
                fresh = Playback(make_model(), StraightPlanner(), 0.0)
                fresh.load(0, playback.trajectory)
                fresh.take_statuses()
                world.playbacks[robot] = fresh
                system.member_changed(world.now, robot, State.IDLE, 0.0)
        except LabError:
            pass
        world.report()
        standing = system.state in (
            SystemState.READY, SystemState.PAUSED, SystemState.COLLISION_HALT,
        )  # fmt: skip
        moving = [
            r for r, p in world.playbacks.items() if p.state in (State.PLAYING, State.ADJUSTING)
        ]
        assert not (standing and moving), (system.state, system.message, moving)
        assert 0 <= system.clock.position <= system.duration + 1e-6
        assert system.duration >= max(m.duration for m in system.members.values())
        world.advance(round(x * 0.3, 3))
    # However it went: once nothing touches anything, stop and play lead to the end.
    for playback in world.playbacks.values():
        if playback.state is State.COLLISION_HALT:
            playback.clear(world.now)
    world.advance(0.01)
    system.stop(world.now)
    system.set_rate(world.now, 1.0)
    world.sent = {robot: [] for robot in world.sent}
    system.play(world.now)
    world.run_until(SystemState.READY)
    assert system.message.code == "played_to_end"
    assert [world.frames(r) for r in "abc"] == [list(range(n)) for n in (31, 21, 11)]


def in_state(state: SystemState) -> World:
    """A system of two in a state, as commands and reports lead there."""
    world = make(TWO, mode=Mode.SEQUENTIAL)
    if state is not SystemState.READY:
        world.system.play(world.now)
    if state is SystemState.PAUSED:
        # While they move to their places: the next play has to stage them again.
        world.advance(0.1)
        world.system.pause(world.now)
    if state in (SystemState.PLAYING, SystemState.COLLISION_HALT, SystemState.COMPLETE):
        world.run_until(SystemState.PLAYING)
        world.advance(0.3)
    if state is SystemState.COLLISION_HALT:
        world.playbacks["a"].collide(world.now, TOUCHES)
        world.report()
    if state is SystemState.COMPLETE:
        # COMPLETE lasts no longer than its announcement, so no command leads to it.
        world.system._machine.fire(SystemEvent.FINISH)
    if state is SystemState.STOPPING:
        world.frozen = {"b"}
        world.system.stop(world.now)
    assert world.system.state is state
    world.announced.clear()
    return world


def collide(world: World) -> None:
    """Report that a member collides: it was halted by its own playback."""
    position = world.system.members["b"].position
    world.system.member_changed(world.now, "b", State.COLLISION_HALT, position)


# The events that come from outside: the commands of people, and what members report.
CALLS = {
    SystemEvent.STAGE: lambda w: w.system.play(w.now),
    SystemEvent.PAUSE: lambda w: w.system.pause(w.now),
    SystemEvent.STOP: lambda w: w.system.stop(w.now),
    SystemEvent.SEEK: lambda w: w.system.seek(w.now, 0.1),
    SystemEvent.STEP: lambda w: w.system.step(w.now, 1),
    SystemEvent.SET_MODE: lambda w: w.system.set_mode(Mode.PARALLEL),
    SystemEvent.LOSE: lambda w: w.system.member_changed(w.now, "b", State.IDLE, 0.0),
    SystemEvent.COLLIDE: collide,
}


def seen(world: World) -> tuple:
    system = world.system
    return system.state, system.message, system.clock, system.mode, system.duration, system.rate


@pytest.mark.parametrize("event", CALLS)
@pytest.mark.parametrize("state", SystemState)
def test_every_event_in_every_state_does_what_the_table_says_or_changes_nothing(state, event):
    world = in_state(state)
    before = seen(world)
    if (state, event) in TABLE.rows:
        CALLS[event](world)
        assert world.system.state is TABLE.rows[state, event]
        if state in TABLE.ignored.get(event, ()):
            assert seen(world) == before
        return
    with refused(ILLEGAL_EVENT, IllegalEvent, event=event.value, state=state.name):
        CALLS[event](world)
    assert seen(world) == before


def test_reports_are_announced_with_complete_in_between_and_commands_by_their_caller():
    world = make({"a": 11})
    world.system.play(world.now)
    assert world.announced == []
    world.run_until(SystemState.READY)
    states = [state.name for state, _ in world.announced]
    assert states == ["PLAYING", "COMPLETE", "READY"]
    world.system.poll(world.now)
    assert len(world.announced) == 3


def test_a_loop_whose_members_cannot_be_claimed_again_ends_with_the_reason():
    world = playing(make({"a": 11}, loop=True), 0.15)
    # The host has lost the playback at the last frame, and nobody has reported it yet.
    world.system.members["a"].done = True
    world.system.members["a"].playback_state = State.IDLE

    def gone(robots: Sequence[str]) -> list[Loaded]:
        raise Misuse(playback_codes.NOT_PLAYED(robot=robots[0]))

    world.claim = gone
    with refused(playback_codes.NOT_PLAYED, Misuse, robot="a"):
        world.system.poll(world.now)
    assert world.system.state is SystemState.READY
    assert said(world) == ("not_played", {"robot": "a"})


def test_a_state_from_before_the_last_reply_is_out_of_date():
    world = playing(make(TWO), 0.3)
    world.system.pause(world.now)
    replied = world.now
    world.system.member_changed(world.now, "a", State.COLLISION_HALT, 0.1, replied - 1)
    assert world.system.state is SystemState.PAUSED
    assert world.system.members["a"].playback_state is State.PAUSED
    world.system.member_changed(world.now, "a", State.COLLISION_HALT, 0.1, replied)
    assert world.system.members["a"].playback_state is State.COLLISION_HALT


def test_a_member_with_another_trajectory_loads_the_one_it_is_given():
    world = World({"a": 11})
    other = make_trajectory(np.ones((21, 2)), trajectory_id="other")
    world.catalogue["other"] = other
    world.system = RobotSystem("cell", [Member("a", "other")], world)
    world.system.prepare()
    assert world.playbacks["a"].trajectory is other
    assert world.system.duration == other.duration
    assert world.playbacks["a"].system == "cell"


def test_a_system_that_cannot_be_leaves_every_robot_as_it_was():
    world = World({"a": 101, "b": 51})
    first = world.playbacks["a"].trajectory
    world.catalogue = {
        "a": first,
        "other": make_trajectory(np.ones((21, 2)), trajectory_id="other"),
    }
    world.playbacks["a"].seek(world.now, 0.5)
    arm = world.playbacks["a"].arm
    members = [Member("a", "other"), Member("b", waits=(parse("frame 60: after a.frame 1"),))]
    with refused(say.WAIT_BEYOND_END, BadInput, robot="b", frame=60):
        RobotSystem("cell", members, world).prepare()
    a, b = world.playbacks["a"], world.playbacks["b"]
    assert (a.system, b.system) == ("", "")
    assert a.trajectory is first
    assert (a.state, a.clock.position) == (State.PAUSED, 0.5)
    assert np.array_equal(a.arm, arm)
    assert b.state is State.READY


def test_a_load_that_fails_leaves_every_robot_as_it_was():
    world = World({"a": 11, "b": 11})
    with refused(say.NO_SYSTEM, BadInput, system="ghost"):
        RobotSystem("cell", [Member("a"), Member("b", "ghost")], world).prepare()
    assert [p.system for p in world.playbacks.values()] == ["", ""]


def test_a_robot_that_moves_by_itself_is_not_claimed():
    world = World({"a": 101})
    world.playbacks["a"].seek(world.now, 0.0)
    world.playbacks["a"].play(world.now)
    with refused(playback_codes.NOT_STANDING, Misuse, state="PLAYING"):
        RobotSystem("cell", [Member("a")], world).prepare()
    assert world.playbacks["a"].state is State.PLAYING


def test_a_member_without_a_trajectory_is_refused():
    world = World({})
    world.playbacks["a"] = Playback(make_model(), StraightPlanner(), 0.0)
    system = RobotSystem("cell", [Member("a")], world)
    with refused(say.NO_TRAJECTORY_LOADED, Misuse, robot="a"):
        system.prepare()


SCENE = frozenset({"a", "b", "c"})


def test_a_robot_is_in_one_system_at_a_time():
    systems = Systems()
    cell = RobotSystem("cell", [Member("a"), Member("b")], World({}))
    assert systems.check("cell", ["a", "b"], SCENE) == "cell"
    systems.add(cell)
    assert systems.of("a") is cell
    assert systems.of("c") is None
    with refused(playback_codes.MEMBER_OF_SYSTEM, Misuse, robot="b", system="cell"):
        systems.check("other", ["c", "b"], SCENE)
    assert [s.name for s in systems] == ["cell"]
    systems.dissolve("cell")
    assert systems.of("a") is None
    systems.check("other", ["b"], SCENE)


def test_a_system_that_misses_a_member_is_named_with_it():
    systems = Systems()
    for name, robots in (("one", "ab"), ("two", "c")):
        systems.add(RobotSystem(name, [Member(robot) for robot in robots], World({})))
    assert systems.without_members(SCENE) == []
    [(system, missing)] = systems.without_members(frozenset({"b", "c"}))
    assert (system.name, missing) == ("one", ["a"])


def test_names_are_given_and_checked():
    systems = Systems()
    systems.add(RobotSystem(systems.check("", ["a"], SCENE), [Member("a")], World({})))
    assert systems.check("", ["b"], SCENE) == "system_2"
    for taken in ("system_1", "a"):
        with refused(NAME_TAKEN, BadInput, name=taken):
            systems.check(taken, ["c"], SCENE)


@pytest.mark.parametrize(
    ("robots", "code", "values"),
    [
        ([], say.NO_MEMBERS, {}),
        (["x"], NO_ROBOT_IN_SCENE, {"robot": "x", "known": ["a", "b", "c"]}),
        (["a", "a"], say.ROBOT_REPEATED, {"robot": "a", "count": 2}),
    ],
)
def test_members_that_cannot_be_are_refused(robots, code, values):
    with refused(code, BadInput, **values):
        Systems().check("cell", robots, SCENE)


def test_an_unknown_system_is_named_with_those_that_are_there():
    with refused(say.NO_SYSTEM, Misuse, system="cell", known=[]):
        Systems().get("cell")


@pytest.mark.parametrize("mode", Mode)
@pytest.mark.parametrize("rate", [-1.0, -2.0])
def test_backwards_the_same_run_is_played_from_its_end_to_its_start(mode, rate):
    world = make(TWO, mode, dwell=0.5)
    system = world.system
    system.set_rate(world.now, rate)
    assert system.clock.position == system.duration
    system.play(world.now)
    world.run_until(SystemState.READY)
    assert system.message.code == "played_back"
    step = round(-rate)
    assert world.frames("a") == list(range(100, -1, -step))
    assert world.frames("b") == list(range(50, -1, -step))
    lag = (world.first_due("a") - world.first_due("b")) / SECOND * step
    # Forwards b begins 1.5 s after a; parallel, a ends 0.5 s after b.
    assert lag == pytest.approx(1.0 if mode is Mode.SEQUENTIAL else -0.5, abs=1e-6)


def test_backwards_nothing_waits_and_forwards_again_it_does():
    world = make(TWO, waits={"b": ["frame 10: after a.frame 60"]})
    system = world.system
    system.play(world.now)
    world.run_until(SystemState.PLAYING)
    world.advance(0.8)
    system.set_rate(world.now, -1.0)
    assert system.state is SystemState.PLAYING
    world.run_until(SystemState.READY)
    assert world.frames("a")[-1] == world.frames("b")[-1] == 0
    for robot in "ab":
        frames = world.frames(robot)
        turn = frames.index(max(frames))
        assert frames == [*range(turn + 1), *range(turn - 1, -1, -1)]
    system.set_rate(world.now, 1.0)
    world.sent = {robot: [] for robot in world.sent}
    system.play(world.now)
    world.run_until(SystemState.READY)
    # b went on from frame 10 when a had reached frame 60.
    held = {frame: now for _, frame, now in world.sent["b"]}
    reached = {frame: now for _, frame, now in world.sent["a"]}
    assert held[11] > reached[60]


def test_a_direction_is_not_changed_while_members_move_to_their_places():
    world = make(TWO)
    world.system.play(world.now)
    with refused(say.MEMBERS_MOVE_TO_PLACES, Misuse):
        world.system.set_rate(world.now, -1.0)
    assert world.system.rate == 1.0
    world.run_until(SystemState.PLAYING)


@pytest.mark.parametrize("turns", [1, 2])
def test_a_direction_may_change_in_a_pause(turns):
    world = make(TWO, Mode.SEQUENTIAL)
    system = world.system
    system.play(world.now)
    world.run_until(SystemState.PLAYING)
    world.advance(1.3)
    system.pause(world.now)
    for _ in range(turns):
        system.set_rate(world.now, -system.rate)
    system.play(world.now)
    world.run_until(SystemState.READY)
    a, b = world.frames("a"), world.frames("b")
    if turns == 1:
        assert (a[-1], b[-1], max(b)) == (0, 0, b[len(b) // 2])
        assert a == [*range(101), *range(100, -1, -1)]
    else:
        assert (a, b) == (list(range(101)), list(range(51)))


@pytest.mark.parametrize("rate", [0.5, -2.0])
def test_a_restarted_system_goes_on_at_the_rate_that_it_had(rate):
    world = playing(make(TWO), 0.6)
    come_back(world, 0.5, rate)
    assert world.system.rate == rate
    world.system.play(world.now)
    world.run_until(SystemState.PLAYING)
    assert world.system.clock.rate == rate


# Death of a process: the members that it plays are where their last joint states were.


def go_down(world: World, robots: str, *, frozen: bool = False, heard_after: float = 0.0) -> None:
    """End or freeze the process that plays `robots`; the system is told `heard_after` s later."""
    at_ns = world.now
    world.frozen |= set(robots)
    if not frozen:
        for robot in robots:
            world.playbacks[robot].take_statuses()
            world.playbacks[robot].due_ns = lambda: None
    world.now += round(heard_after * SECOND)
    how = "" if frozen else "SIGKILL"
    world.system.members_down(world.now, at_ns, list(robots), "playback", how)


def come_up(world: World, robots: str, behind: int = 0) -> None:
    """Bring a process back that had ended; its members stand `behind` frames before their last."""
    world.frozen -= set(robots)
    for robot in robots:
        before = world.playbacks[robot]
        position = before.stream.position
        if before.stream.streamed is not None:
            position = max(position - behind / before.stream.trajectory.frame_rate, 0.0)
        fresh = world.playbacks[robot] = Playback(make_model(), StraightPlanner(), 0.0)
        kept = keep(before)._replace(
            position=position, arm=before.stream.trajectory.sample(position)
        )
        back(fresh, world.now, before.stream.trajectory, kept)
        fresh.take_statuses()
        world.system.member_changed(
            world.now, robot, fresh.state, position, owner="", trajectory_id=robot
        )


def places(world: World) -> list[float]:
    """The places of the system and of those members that are inside their shares, s."""
    found = [(m, world.playbacks[m.robot].clock.position) for m in world.system.members.values()]
    inside = [m.start + place for m, place in found if 0 < place < m.duration]
    return [world.system.clock.position, *inside]


@pytest.mark.parametrize("heard_after", [0.005, 8.0])
@pytest.mark.parametrize("behind", [0, 7])
@pytest.mark.parametrize("rate", [1.0, 0.5, -1.0])
def test_a_system_whose_members_died_stands_where_they_did_and_plays_on_from_one_place(
    heard_after, behind, rate
):
    world = make({"a": 101, "b": 101})
    world.system.set_rate(world.now, rate)
    playing(world, 0.3)
    go_down(world, "ab", heard_after=heard_after)
    system = world.system
    assert system.state is SystemState.PAUSED
    assert system.message.code == "process_died"
    assert system.message.values["how"] == "SIGKILL"
    last = [world.playbacks[robot].stream.position for robot in "ab"]
    assert system.clock.position == pytest.approx((min if rate > 0 else max)(last), abs=1e-12)
    come_up(world, "ab", behind)
    assert system.message.code == "members_back"
    assert places(world) == pytest.approx([places(world)[0]] * 3, abs=1e-12)
    came = system.clock.position
    assert abs(came - last[0]) <= (behind + 1) / 100
    world.sent = {"a": [], "b": []}
    system.play(world.now)
    world.run_until(SystemState.PLAYING)
    world.advance(0.15)
    for robot in "ab":
        clock = world.playbacks[robot].clock
        assert clock.at(world.now) == pytest.approx(system.clock.at(world.now), abs=1e-9)
    world.run_until(SystemState.READY)
    assert world.frames("a")[-1] == (100 if rate > 0 else 0)


def test_a_member_that_survives_stands_at_once_and_waits_for_the_one_that_died():
    world = playing(make(TWO), 0.3)
    died_at = world.playbacks["a"].stream.position
    world.advance(0.05)
    world.frozen = {"a"}
    world.system.members_down(world.now, world.now - 50 * MS, ["a"], "playback", "SIGKILL")
    assert world.playbacks["b"].state is State.PAUSED
    assert world.system.clock.position == pytest.approx(died_at)
    world.playbacks["a"].take_statuses()
    world.playbacks["a"].halt(world.now, Event.PAUSE, None)
    world.playbacks["a"].stream.streamed = None
    world.playbacks["a"].stream.jump(world.now, died_at)
    come_up(world, "a")
    ahead = world.playbacks["b"].stream.position
    assert ahead == pytest.approx(died_at + 0.05)
    world.sent = {"a": [], "b": []}
    world.play_to_the_end()
    # Nobody moved back, no frame is missing, and both begin on one line.
    assert world.frames("b")[0] == round(ahead * 100) + 1
    first = {robot: (due, frame) for robot in "ab" for due, frame, _ in world.sent[robot][:1]}
    assert first["b"][0] - first["a"][0] == (first["b"][1] - first["a"][1]) * PERIOD


def test_a_member_that_is_far_ahead_of_the_line_moves_to_it_before_the_system_plays():
    world = playing(make({"a": 101, "b": 101}), 0.3)
    # The death of a is noticed late, by its absence.
    world.playbacks["a"].due_ns = lambda: None
    world.advance(0.5)
    world.frozen = {"a"}
    world.system.pause(world.now)
    come_up(world, "a")
    place = world.system.clock.position
    assert place == pytest.approx(world.playbacks["a"].clock.position, abs=1e-12)
    assert world.playbacks["b"].clock.position > place + 0.4
    world.sent = {"a": [], "b": []}
    world.play_to_the_end()
    assert world.frames("b") == list(range(round(place * 100), 101))
    assert world.sent["b"][-1][0] == world.sent["a"][-1][0]


def test_a_frozen_process_is_left_the_order_to_pause_and_its_members_are_lined_up():
    world = playing(make(TWO), 0.3)
    go_down(world, "ab", frozen=True)
    assert world.system.message.code == "process_froze"
    assert [(order.robot, order.command) for order in world.left] == [
        ("a", Command.PAUSE), ("b", Command.PAUSE),
    ]  # fmt: skip
    place = world.system.clock.position
    # Both send what was late before they carry out the order, one of them more.
    world.frozen = set()
    for robot, count in (("a", 2), ("b", 3)):
        playback = world.playbacks[robot]
        for _ in range(count):
            world.now = max(playback.due_ns(), world.now)
            assert playback.tick(world.now) is not None
        playback.pause(world.now, by="cell")
        world.system.member_changed(
            world.now,
            robot,
            State.PAUSED,
            playback.clock.position,
            owner="cell",
            trajectory_id=robot,
        )
    assert world.system.message.code == "members_back"
    assert world.system.clock.position == world.playbacks["a"].clock.position
    assert place < world.system.clock.position < world.playbacks["b"].clock.position
    world.play_to_the_end()
    assert world.frames("a")[-1] == 100


@pytest.mark.parametrize("state", SystemState)
def test_a_death_in_every_state_leaves_the_system_standing_and_playable(state):
    world = in_state(state)
    world.frozen = set()
    go_down(world, "ab")
    expected = TABLE.rows.get((state, SystemEvent.LOSE), state)
    if state is SystemState.STOPPING:
        # What a stop did not reach before stands with its process.
        expected = SystemState.READY
    elif state is SystemState.COLLISION_HALT:
        # Nobody is halted until it comes back so.
        expected = SystemState.PAUSED
    assert world.system.state is expected
    come_up(world, "ab")
    world.advance(0.01)
    if world.system.state is SystemState.COLLISION_HALT:
        world.playbacks["a"].clear(world.now)
        world.report()
    if world.system.state is SystemState.PAUSED:
        position = world.system.clock.position
        assert places(world) == pytest.approx([position] * len(places(world)), abs=1e-12)
    world.sent = {"a": [], "b": []}
    world.play_to_the_end()
    assert world.frames("a")[-1] == 100
    assert world.frames("b")[-1] == 50


def test_members_that_were_frozen_in_ready_are_claimed_when_their_process_runs_again():
    world = make(TWO)
    go_down(world, "ab", frozen=True)
    assert (world.system.state, said(world)[0]) == (SystemState.READY, "process_froze")
    assert {m.playback_state for m in world.system.members.values()} == {State.IDLE}
    world.frozen = set()
    world.system.members_run(world.now, ["a", "b"])
    assert said(world) == ("members_back", {"robots": ["a", "b"], "position": 0.0})
    assert {m.playback_state for m in world.system.members.values()} == {State.READY}
    world.play_to_the_end()
    assert world.frames("a") == list(range(101))


fault = st.tuples(
    st.sampled_from(
        ["play", "play", "pause", "seek", "rate", "turn", "kill", "kill", "freeze", "wait", "wait"]
    ),
    st.sampled_from(["a", "b", "ab", "abc"]),
    st.floats(0, 1),
)


def furthest_behind(world: World) -> float | None:
    """Where the member stands that has not ended and is furthest behind, s; None: none is."""
    choose = max if world.system.rate < 0 else min
    found = []
    for member in world.system.members.values():
        playback = world.playbacks[member.robot]
        # One that is ready for another run has its clock at the beginning of that.
        ready = playback.state is State.READY
        if not member.done:
            found.append(member.start + (member.position if ready else playback.clock.position))
    return choose(found, default=None)


@settings(max_examples=15, deadline=None)
@given(st.sampled_from(list(Mode)), st.lists(fault, max_size=20))
def test_whatever_process_dies_or_freezes_a_system_stands_and_plays_in_one_place(mode, faults):
    world = make({"a": 81, "b": 61, "c": 41}, mode, rates={"b": 50.0})
    system = world.system
    for name, robots, x in faults:
        try:
            if name == "play":
                system.play(world.now)
                world.run_until(SystemState.PLAYING, 5.0)
            elif name == "pause":
                system.pause(world.now)
            elif name == "seek":
                system.seek(world.now, x * system.duration)
            elif name in ("rate", "turn"):
                system.set_rate(world.now, (0.1 + 3.9 * x) * (-1 if name == "turn" else 1))
            elif name == "kill":
                moved = system.state is SystemState.PLAYING
                go_down(world, robots, heard_after=0.01 * x)
                world.advance(round(0.1 * x, 3))
                # What moved may come back behind the place that it had reached.
                come_up(world, robots, behind=round(8 * x) if moved else 0)
            elif name == "freeze":
                go_down(world, robots, frozen=True)
                world.frozen -= set(robots)
                for robot in robots:
                    if world.playbacks[robot].state in (State.PLAYING, State.ADJUSTING):
                        world.playbacks[robot].pause(world.now, by="cell")
                        world.playbacks[robot].take_statuses()
                system.members_run(world.now, list(robots))
        except LabError:
            pass
        world.report()
        if system.state is SystemState.PAUSED and (place := furthest_behind(world)) is not None:
            assert system.clock.position == pytest.approx(place, abs=1e-9)
        world.advance(round(x * 0.3, 3))
        if system.state is SystemState.PLAYING:
            for member in system.members.values():
                playback = world.playbacks[member.robot]
                if playback.state is State.PLAYING and world.now > playback.clock.stamp_ns:
                    own = member.start + playback.clock.at(world.now)
                    assert own == pytest.approx(system.clock.at(world.now), abs=1e-8)
    system.stop(world.now)
    system.set_rate(world.now, 1.0)
    world.sent = {robot: [] for robot in world.sent}
    world.play_to_the_end()
    assert [world.frames(r) for r in "abc"] == [list(range(n)) for n in (81, 61, 41)]


def test_a_member_that_stands_after_a_freeze_that_nobody_announced_stands_all_on_one_line():
    world = playing(make(TWO), 0.3)
    world.playbacks["a"].thaw(world.now)
    world.report()
    assert world.system.state is SystemState.PAUSED
    assert said(world) == ("members_silent", {"robots": ["a"]})
    assert world.playbacks["b"].state is State.PAUSED
    assert world.system.clock.position == world.playbacks["a"].clock.position
    world.play_to_the_end()
    assert world.frames("a") == list(range(101))
    assert world.frames("b") == list(range(51))
