"""The playback core, driven by a clock that the tests move by hand."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from fakes import SECOND, StraightPlanner, make_model, make_trajectory
from hypothesis import given
from hypothesis import strategies as st
from refusals import refused

from mrlab_ros.core.base.diagnostics import BAD_POSITION, BAD_RATE, ILLEGAL_EVENT
from mrlab_ros.core.base.errors import BadInput, IllegalEvent, LabError, Misuse
from mrlab_ros.core.playback import diagnostics as say
from mrlab_ros.core.playback.playback import Playback
from mrlab_ros.core.playback.saved_state import come_back, keep
from mrlab_ros.core.playback.states import TABLE, Event, State
from mrlab_ros.core.playback.stream import LOST_AFTER_NS, Sample
from mrlab_ros.core.trajectory.diagnostics import (
    OF_ANOTHER_END_EFFECTOR,
    OF_ANOTHER_MODEL,
    OF_OTHER_JOINTS,
)

PERIOD = SECOND // 100
START = 7 * SECOND
TOUCHES = say.HALTED_BY_CONTACT(link="link_5", other="cube_1")


def make(home: float = 0.0, standing_rate: float = 0.0) -> Playback:
    return Playback(make_model(home=home), StraightPlanner(), standing_rate)


def loaded(trajectory=None) -> Playback:
    playback = make()
    playback.load(0, trajectory or make_trajectory())
    playback.tick(0)
    return playback


def on_start(trajectory=None) -> Playback:
    """A playback whose arm stands on the first frame, READY."""
    playback = loaded(trajectory)
    playback.seek(0, 0.0)
    playback.stop(0)
    playback.tick(0)
    return playback


def run(playback: Playback, until_ns: int, late_ns: int = 0) -> list[Sample]:
    """Serve the playback at its own deadlines (plus a delay) up to an instant."""
    samples = []
    while (due := playback.due_ns()) is not None and due + late_ns <= until_ns:
        sample = playback.tick(due + late_ns)
        if sample is not None:
            samples.append(sample)
    return samples


def streamed(samples: list[Sample]) -> list[Sample]:
    return [s for s in samples if s.streamed]


def labels(playback: Playback) -> list[str]:
    return [s.state.name for s in playback.take_statuses()]


def test_plays_every_frame_once_in_order_with_its_exact_values_at_its_own_deadline():
    trajectory = make_trajectory(np.random.default_rng(1).normal(size=(10_000, 2)))
    playback = on_start(trajectory)
    playback.play(START)
    samples = run(playback, START + 200 * SECOND)
    assert [s.frame for s in samples] == list(range(10_000))
    assert np.array_equal([s.positions for s in samples], trajectory.positions)
    assert [s.due_ns for s in samples] == [START + i * PERIOD for i in range(10_000)]
    assert playback.progress() == (playback.trajectory, 10_000, 0)


@given(
    frames=st.integers(2, 300),
    rate=st.sampled_from([30.0, 100.0, 125.0, 333.3, 1000.0]),
)
def test_every_frame_once_at_any_frame_rate(frames, rate):
    positions = np.arange(2.0 * frames).reshape(frames, 2)
    playback = on_start(make_trajectory(positions, frame_rate=rate))
    playback.play(START)
    samples = run(playback, START + 1000 * SECOND)
    assert np.array_equal([s.positions for s in samples], positions)


def test_an_arm_that_stands_elsewhere_moves_to_the_first_frame_before_it_plays():
    playback = loaded()
    playback.take_statuses()
    playback.play(START)
    assert labels(playback) == ["ADJUSTING"]
    samples = run(playback, START + SECOND)
    adjusting = [s for s in samples if not s.streamed]
    assert np.allclose(adjusting[0].positions, make_model().home)
    assert np.array_equal(adjusting[-1].positions, playback.trajectory.positions[0])
    assert [s.frame for s in streamed(samples)] == list(range(11))
    assert labels(playback) == ["PLAYING", "COMPLETE", "READY"]


def test_pause_stands_on_the_last_frame_sent_and_play_goes_on_with_the_next():
    playback = on_start()
    playback.play(START)
    before = run(playback, START + 4 * PERIOD)
    playback.pause(START + 4 * PERIOD + PERIOD // 2)
    assert playback.clock.position == before[-1].position == 0.04
    standing = playback.tick(playback.due_ns())
    assert np.array_equal(standing.positions, playback.trajectory.positions[4])
    playback.play(START + 60 * SECOND)
    after = run(playback, START + 100 * SECOND)
    assert [s.frame for s in before + after] == list(range(11))
    assert after[0].due_ns == START + 60 * SECOND + PERIOD


def test_pause_before_a_start_that_lies_ahead_loses_no_frame():
    playback = on_start()
    playback.play(START, start_ns=START + SECOND)
    playback.pause(START + SECOND // 2)
    playback.play(START + 2 * SECOND)
    assert [s.frame for s in streamed(run(playback, START + 9 * SECOND))] == list(range(11))


@pytest.mark.parametrize("rate", [0.1, 0.25, 0.5, 2.0, 3.0, 4.0])
def test_other_rates_keep_the_period_and_end_on_the_last_frame(rate):
    playback = on_start()
    playback.set_rate(0, rate)
    playback.play(START)
    samples = run(playback, START + 9 * SECOND)
    gaps = np.diff([s.due_ns for s in samples])
    assert all(abs(gap - PERIOD) <= 1 for gap in gaps[:-1])
    assert np.array_equal(samples[-1].positions, playback.trajectory.positions[-1])
    assert samples[-1].due_ns == START + round(0.1 / rate * SECOND)


def test_a_rate_change_while_playing_neither_jumps_nor_repeats():
    playback = on_start()
    playback.play(START)
    before = run(playback, START + 3 * PERIOD)
    playback.take_statuses()
    playback.set_rate(START + 3 * PERIOD + PERIOD // 4, 0.5)
    (told,) = playback.take_statuses()
    assert (told.message.code, told.clock.rate) == ("rate_set", 0.5)
    middle = run(playback, START + 8 * PERIOD)
    playback.set_rate(START + 8 * PERIOD, 1.0)
    after = run(playback, START + SECOND)
    positions = [s.position for s in before + middle + after]
    assert all(np.diff(positions) > 0)
    assert np.diff(positions).max() <= 0.01 + 1e-9
    assert positions[-1] == playback.trajectory.duration


def test_late_service_sends_all_frames_without_a_burst():
    playback = on_start(make_trajectory(np.arange(200.0).reshape(100, 2)))
    playback.play(START)
    run(playback, START + 10 * PERIOD)
    now = START + 20 * PERIOD
    sent_at, frames = [], []
    while playback.state is State.PLAYING:
        now = max(now, playback.due_ns())
        sample = playback.tick(now)
        sent_at.append(now)
        frames.append(sample.frame)
    assert frames == list(range(11, 100))
    assert np.diff(sent_at).min() >= PERIOD // 2
    assert playback.progress()[2] == 0


def test_what_is_far_too_late_is_left_out_and_counted():
    playback = on_start(make_trajectory(np.arange(6000.0).reshape(3000, 2)))
    playback.play(START)
    run(playback, START + 10 * PERIOD)
    sample = playback.tick(START + 10 * PERIOD + 2 * LOST_AFTER_NS)
    late = 2 * LOST_AFTER_NS // PERIOD
    assert sample.frame == 10 + late
    assert playback.progress()[2] == late - 1


def test_seek_while_playing_plays_on_from_there():
    playback = on_start()
    playback.play(START)
    run(playback, START + 2 * PERIOD)
    playback.seek(START + 3 * PERIOD, 0.08)
    assert playback.state is State.PLAYING
    assert [s.frame for s in streamed(run(playback, START + SECOND))] == [8, 9, 10]


def test_seek_shows_the_pose_at_once():
    playback = loaded()
    playback.seek(START, 0.055)
    assert playback.state is State.PAUSED
    sample = playback.tick(START)
    rows = playback.trajectory.positions
    assert np.allclose(sample.positions, (rows[5] + rows[6]) / 2)


def test_loop_starts_over_one_period_after_the_last_frame_when_the_motion_is_closed():
    t = np.linspace(0, 2 * np.pi, 11)
    closed = np.column_stack([np.sin(t), np.cos(t)])
    closed[-1] = closed[0]
    playback = on_start(make_trajectory(closed))
    playback.set_loop(True)
    playback.play(START)
    samples = streamed(run(playback, START + 21 * PERIOD))
    assert [s.frame for s in samples] == [*range(11), *range(11)]
    assert all(np.diff([s.due_ns for s in samples]) == PERIOD)


def test_loop_moves_back_to_the_start_when_the_motion_is_open():
    playback = on_start()
    playback.set_loop(True)
    playback.play(START)
    playback.take_statuses()
    run(playback, START + SECOND)
    assert labels(playback)[:2] == ["ADJUSTING", "PLAYING"]


def test_collision_halts_in_place_and_clearing_resumes_in_place():
    playback = on_start()
    playback.play(START)
    before = run(playback, START + 4 * PERIOD)
    assert playback.collide(START + 4 * PERIOD, TOUCHES)
    assert playback.state is State.COLLISION_HALT
    assert streamed(run(playback, START + SECOND)) == []
    with refused(ILLEGAL_EVENT, Misuse, event="play", state="COLLISION_HALT"):
        playback.play(START + SECOND)
    playback.clear(START + 2 * SECOND)
    assert playback.state is State.PAUSED
    playback.play(START + 3 * SECOND)
    after = streamed(run(playback, START + 9 * SECOND))
    assert [s.frame for s in streamed(before) + after] == list(range(11))


def test_a_standing_arm_does_not_halt():
    playback = loaded()
    assert not playback.collide(START, "cube_1 fell on it")
    assert playback.state is State.READY


def test_halt_while_adjusting_moves_to_the_start_again_after_clearing():
    playback = loaded()
    playback.play(START)
    run(playback, START + SECOND // 4)
    playback.collide(START + SECOND // 4, TOUCHES)
    playback.clear(START + SECOND)
    playback.play(START + 2 * SECOND)
    assert playback.state is State.ADJUSTING
    assert [s.frame for s in streamed(run(playback, START + 9 * SECOND))] == list(range(11))


def test_seek_and_stop_in_a_halt_move_the_arm_and_keep_the_halt():
    playback = on_start()
    playback.play(START)
    run(playback, START + 5 * PERIOD)
    playback.collide(START + 5 * PERIOD, "x")
    playback.seek(START + SECOND, 0.02)
    assert playback.state is State.COLLISION_HALT
    assert np.array_equal(playback.arm, playback.trajectory.positions[2])
    playback.stop(START + 2 * SECOND)
    assert playback.state is State.COLLISION_HALT
    assert np.array_equal(playback.arm, playback.trajectory.positions[0])
    playback.stop(START + 3 * SECOND)
    assert playback.state is State.COLLISION_HALT
    assert np.array_equal(playback.arm, playback.model.home)
    playback.clear(START + 4 * SECOND)
    assert playback.state is State.PAUSED


def test_staging_waits_at_the_start_until_the_common_stamp():
    playback = loaded()
    playback.claim(START, "cell")
    assert playback.stage(START, 0.0, by="cell") == 0.5
    run(playback, START + SECOND)
    assert playback.state is State.PAUSED
    playback.play(START + SECOND, START + 2 * SECOND, by="cell")
    samples = streamed(run(playback, START + 9 * SECOND))
    assert samples[0].due_ns == START + 2 * SECOND
    assert [s.frame for s in samples] == list(range(11))


def test_a_member_waits_at_a_hold_and_goes_on_with_the_next_frame():
    playback = on_start()
    playback.play(START, until=0.04)
    before = streamed(run(playback, START + SECOND))
    assert playback.state is State.PAUSED
    assert playback.clock.position == 0.04
    playback.play(START + 2 * SECOND)
    after = streamed(run(playback, START + 9 * SECOND))
    assert [s.frame for s in before + after] == list(range(11))
    assert [s.frame for s in before] == list(range(5))


def test_a_hold_that_is_lifted_in_time_is_not_felt():
    playback = on_start()
    playback.play(START, until=0.04)
    before = run(playback, START + 2 * PERIOD)
    playback.hold_at(None)
    samples = before + run(playback, START + SECOND)
    assert [s.due_ns for s in samples if s.streamed] == [START + i * PERIOD for i in range(11)]


def test_a_hold_can_be_moved_ahead_but_not_behind():
    playback = on_start()
    playback.play(START, until=0.04)
    run(playback, START + 2 * PERIOD)
    with refused(say.PASSED_ALREADY, Misuse, until=0.01):
        playback.hold_at(0.01)
    playback.hold_at(0.06)
    run(playback, START + SECOND)
    assert playback.clock.position == 0.06


def test_members_that_resume_on_a_pair_in_the_past_stay_on_one_timeline():
    playback = on_start()
    playback.play(START)
    run(playback, START + 4 * PERIOD)
    playback.pause(START + 4 * PERIOD + PERIOD // 2)
    playback.play(START + SECOND, START + SECOND - PERIOD // 2)
    after = streamed(run(playback, START + 9 * SECOND))
    assert after[0].frame == 5
    assert after[0].due_ns == START + SECOND + PERIOD // 2


def test_a_rate_set_since_an_instant_in_the_past_is_exact_and_never_goes_back():
    playback = on_start(make_trajectory(np.arange(200.0).reshape(100, 2)))
    playback.play(START)
    before = run(playback, START + 10 * PERIOD)
    playback.set_rate(START + 10 * PERIOD, 0.1, START + 8 * PERIOD)
    assert playback.clock.at(START + 18 * PERIOD) == pytest.approx(0.09)
    after = run(playback, START + 60 * PERIOD)
    assert after[0].position > before[-1].position
    assert all(np.diff([s.position for s in after]) > 0)


def test_staging_where_it_is_paused_already_changes_nothing():
    playback = on_start()
    playback.play(START)
    run(playback, START + 4 * PERIOD)
    playback.pause(START + 4 * PERIOD)
    playback.take_statuses()
    assert playback.stage(START + SECOND, playback.clock.position) == 0.0
    assert playback.take_statuses() == []


def test_a_system_cannot_play_a_member_it_has_not_staged():
    playback = loaded()
    playback.claim(START, "cell")
    with refused(say.NOT_IN_PLACE, Misuse, position=0.0):
        playback.play(START, by="cell")


def test_a_member_obeys_its_system_alone():
    playback = on_start()
    playback.claim(START, "cell")
    for command in (
        lambda: playback.play(START),
        lambda: playback.pause(START),
        lambda: playback.stop(START),
        lambda: playback.seek(START, 0.0),
        lambda: playback.set_rate(START, 2.0),
        lambda: playback.load(START, make_trajectory()),
        lambda: playback.unload(START),
        lambda: playback.stage(START, 0.0),
        lambda: playback.hold_at(None),
        lambda: playback.set_loop(True),
    ):
        with refused(say.DRIVEN_BY_SYSTEM, Misuse, system="cell"):
            command()
    with refused(say.MEMBER_OF_SYSTEM, Misuse, system="cell"):
        playback.claim(START, "other")
    playback.play(START, by="cell")
    playback.release(START + PERIOD, "cell")
    assert playback.state is State.PAUSED
    playback.play(START + SECOND)


def test_unloading_forgets_the_trajectory():
    playback = on_start()
    playback.unload(START)
    assert (playback.state, playback.trajectory) == (State.IDLE, None)


@pytest.mark.parametrize("position", [-0.01, 0.11])
def test_no_member_is_staged_off_its_timeline(position):
    playback = on_start()
    with refused(BAD_POSITION, BadInput, position=position):
        playback.stage(START, position)
    assert playback.state is State.READY


def test_an_arm_is_staged_where_its_pose_comes_again_later():
    there_and_back = np.abs(np.arange(11) - 5.0)[:, None] * [1.0, 1.0]
    playback = loaded(make_trajectory(there_and_back))
    playback.seek(START, 0.02)
    playback.tick(START)
    playback.stage(START, 0.08)
    run(playback, START + SECOND)
    assert (playback.state, playback.clock.position) == (State.PAUSED, 0.08)


def test_a_status_that_is_announced_again_is_the_one_before():
    playback = on_start()
    before = playback.take_statuses()[-1]
    playback.announce_again()
    assert playback.take_statuses() == [before]


def test_a_trajectory_for_another_model_is_refused_and_changes_nothing():
    playback = on_start()
    before = playback.trajectory
    with refused(OF_ANOTHER_MODEL, BadInput, made_for="ur5e", robot_model="fake"):
        playback.load(START, make_trajectory(robot_model="ur5e"))
    with refused(OF_OTHER_JOINTS, BadInput, found=["a", "b"]):
        playback.load(START, make_trajectory(joint_names=("a", "b")))
    assert playback.trajectory is before


@pytest.mark.parametrize("position", [-0.1, 0.2, float("nan"), float("inf")])
def test_a_position_off_the_timeline_is_refused(position):
    playback = on_start()
    with refused(BAD_POSITION, BadInput, position=position, duration=0.1):
        playback.seek(START, position)
    assert playback.state is State.READY


@pytest.mark.parametrize("rate", [0.0, 0.05, 5.0, -0.05, -5.0, float("nan")])
def test_a_rate_out_of_range_is_refused(rate):
    playback = on_start()
    with refused(BAD_RATE, BadInput, rate=rate, low=0.1, high=4.0):
        playback.set_rate(START, rate)
    assert playback.rate == 1.0


def in_state(state: State) -> Playback:
    if state is State.IDLE:
        playback = make()
        playback.take_statuses()
        return playback
    playback = loaded() if state is State.ADJUSTING else on_start()
    if state is State.PAUSED:
        playback.seek(START, 0.05)
    elif state is not State.READY:
        playback.play(START)
        if state is State.COLLISION_HALT:
            playback.collide(START + PERIOD, TOUCHES)
    if state is State.COMPLETE:
        # COMPLETE lasts no longer than its announcement, so no command leads to it.
        playback.machine.fire(Event.FINISHED)
    assert playback.state is state
    playback.take_statuses()
    return playback


# The events that come from outside: the commands of people, and the reports of physics.
CALLS = {
    Event.LOAD: lambda p: p.load(START, make_trajectory()),
    Event.UNLOAD: lambda p: p.unload(START),
    Event.PLAY: lambda p: p.play(START),
    Event.PAUSE: lambda p: p.pause(START),
    Event.STOP: lambda p: p.stop(START),
    Event.SEEK: lambda p: p.seek(START, 0.03),
    Event.STAGE: lambda p: p.stage(START, 0.1),
    Event.COLLIDED: lambda p: p.collide(START, TOUCHES),
    Event.CLEARED: lambda p: p.clear(START),
    Event.CLEAR_HALT: lambda p: p.clear_halt(START),
}


@pytest.mark.parametrize("event", CALLS)
@pytest.mark.parametrize("state", State)
def test_every_event_in_every_state_does_what_the_table_says_or_changes_nothing(state, event):
    playback = in_state(state)
    if event is Event.CLEAR_HALT:
        playback.touching = False
    before = playback.status(), playback.due_ns(), playback.arm
    if (state, event) in TABLE.transitions:
        CALLS[event](playback)
        assert playback.state is TABLE.transitions[state, event]
        assert playback.take_statuses()[-1].state is playback.state
        return
    if state in TABLE.ignored.get(event, ()):
        CALLS[event](playback)
    else:
        with refused(ILLEGAL_EVENT, IllegalEvent, event=event.value, state=state.name):
            CALLS[event](playback)
    assert (playback.status(), playback.due_ns(), playback.arm) == before
    assert playback.take_statuses() == []


def test_a_halt_is_not_cleared_by_command_while_the_arm_touches_something():
    playback = in_state(State.COLLISION_HALT)
    with refused(say.STILL_TOUCHES, Misuse):
        playback.clear_halt(START)
    assert playback.state is State.COLLISION_HALT
    assert playback.clear(START)
    assert playback.state is State.PAUSED


def test_a_trajectory_for_another_end_effector_is_refused_until_it_is_fitted():
    playback = make()
    trajectory = replace(make_trajectory(), end_effector="gripper")
    with refused(OF_ANOTHER_END_EFFECTOR, BadInput, made_for="gripper"):
        playback.load(START, trajectory)
    assert playback.trajectory is None
    playback.end_effector = "gripper"
    playback.load(START, trajectory)
    assert playback.trajectory is trajectory


def test_a_refused_play_of_a_system_does_not_change_the_rate():
    playback = loaded()
    playback.claim(START, "cell")
    with refused(say.NOT_IN_PLACE, Misuse, position=0.0):
        playback.play(START, rate=2.0, by="cell")
    assert playback.rate == 1.0


@pytest.mark.parametrize("state", [s for s in State if s is not State.COMPLETE])
def test_leaving_a_system_pauses_what_moves_and_nothing_else(state):
    playback = in_state(state)
    playback.system = "cell"
    playback.release(START, "cell")
    assert playback.state is TABLE.rows[state, Event.RELEASED]
    assert playback.system == ""


def test_the_standing_rate_can_change_at_any_time():
    playback = make(standing_rate=0.0)
    playback.set_standing_rate(0, 2.0)
    assert playback.due_ns() == 0, "the first pose still leaves at once"
    playback.tick(0)
    assert playback.due_ns() == SECOND // 2
    playback.set_standing_rate(SECOND // 4, 10.0)
    assert playback.due_ns() == SECOND // 4 + SECOND // 10
    playback.set_standing_rate(SECOND // 4, 0.0)
    assert playback.due_ns() is None
    moving = on_start()
    moving.play(START)
    due = moving.due_ns()
    moving.set_standing_rate(START, 100.0)
    assert moving.due_ns() == due, "a moving robot keeps its deadlines"


def test_a_standing_robot_repeats_its_pose():
    playback = make(standing_rate=2.0)
    samples = run(playback, 2 * SECOND)
    assert len(samples) == 5
    assert not any(s.streamed for s in samples)


def test_a_standing_robot_repeats_its_pose_at_once_for_who_comes():
    playback = make(standing_rate=2.0)
    playback.tick(0)
    playback.repeat(SECOND // 4)
    sample = playback.tick(SECOND // 4)
    assert sample is not None
    assert not sample.streamed
    assert playback.due_ns() == 3 * SECOND // 4
    silent = make(standing_rate=0.0)
    silent.tick(0)
    silent.repeat(SECOND)
    assert silent.due_ns() is None
    moving = on_start()
    moving.play(START)
    due = moving.due_ns()
    moving.repeat(START)
    assert moving.due_ns() == due, "a moving robot keeps its deadlines"


def test_a_robot_that_may_not_repeat_itself_is_silent():
    playback = make(standing_rate=0.0)
    assert len(run(playback, 2 * SECOND)) == 1
    assert playback.due_ns() is None


@given(
    st.lists(
        st.tuples(
            st.sampled_from(["play", "pause", "stop", "seek", "rate", "wait", "collide", "clear"]),
            st.floats(0, 1),
        ),
        max_size=30,
    )
)
def test_whatever_is_asked_the_arm_stays_on_the_trajectory_and_never_moves_while_it_stands(steps):
    playback = on_start()
    rows = playback.trajectory.positions
    now = START
    for name, x in steps:
        now += 3_000_001
        try:
            if name == "play":
                playback.play(now)
            elif name == "pause":
                playback.pause(now)
            elif name == "stop":
                playback.stop(now)
            elif name == "seek":
                playback.seek(now, x * playback.trajectory.duration)
            elif name == "rate":
                playback.set_rate(now, (0.1 + 3.9 * x) * (-1 if round(16 * x) % 2 else 1))
            elif name == "collide":
                playback.collide(now, "x")
            elif name == "clear":
                playback.clear(now)
        except LabError:
            pass
        standing = playback.state not in (State.PLAYING, State.ADJUSTING)
        arm = playback.arm
        if np.array_equal(arm, playback.model.home):
            # A second stop in a halt leads there, and the way back begins there.
            rows = np.vstack((rows, arm))
        samples = run(playback, now := now + round(x * 4 * PERIOD))
        if standing:
            assert all(np.array_equal(s.positions, arm) for s in samples)
        for sample in samples:
            assert (sample.positions >= rows.min(axis=0) - 1e-12).all()
            assert (sample.positions <= rows.max(axis=0) + 1e-12).all()
            assert 0 <= sample.position <= playback.trajectory.duration
        assert playback.state in State


def backwards(rate: float = -1.0) -> Playback:
    """A playback whose arm stands on its last frame, READY to play backwards."""
    playback = loaded()
    playback.set_rate(0, rate)
    playback.seek(0, 0.1)
    playback.stop(0)
    playback.tick(0)
    playback.take_statuses()
    return playback


def test_backwards_a_run_begins_at_the_last_frame_and_is_complete_at_the_first():
    playback = backwards()
    assert playback.clock.position == 0.1
    playback.play(START)
    samples = run(playback, START + SECOND)
    assert [s.frame for s in samples] == list(range(10, -1, -1))
    statuses = playback.take_statuses()
    assert [s.state.name for s in statuses] == ["PLAYING", "COMPLETE", "READY"]
    assert [s.clock.position for s in statuses] == [0.1, 0.0, 0.1]
    assert statuses[1].message.code == "played_back"


def test_backwards_an_arm_that_stands_elsewhere_moves_to_the_last_frame_first():
    playback = loaded()
    playback.set_rate(0, -2.0)
    playback.take_statuses()
    playback.play(START)
    samples = run(playback, START + SECOND)
    adjusting = [s for s in samples if not s.streamed]
    assert np.array_equal(adjusting[-1].positions, playback.trajectory.positions[-1])
    assert labels(playback) == ["ADJUSTING", "PLAYING", "COMPLETE", "READY"]


def test_backwards_a_loop_moves_back_to_the_last_frame_and_goes_on():
    playback = backwards()
    playback.set_loop(True)
    playback.take_statuses()
    playback.play(START)
    samples = streamed(run(playback, START + 2 * SECOND))
    assert [s.frame for s in samples[:22]] == 2 * list(range(10, -1, -1))
    assert labels(playback)[:3] == ["PLAYING", "ADJUSTING", "PLAYING"]


def test_a_direction_may_change_on_the_way_and_in_a_pause():
    playback = on_start()
    playback.play(START)
    there = run(playback, START + 5 * PERIOD)
    playback.set_rate(START + 5 * PERIOD, -1.0)
    back = run(playback, START + 7 * PERIOD)
    playback.pause(START + 7 * PERIOD)
    playback.set_rate(START + 7 * PERIOD, 1.0)
    playback.play(START + SECOND)
    again = run(playback, START + 9 * SECOND)
    frames = [s.frame for s in there], [s.frame for s in back], [s.frame for s in streamed(again)]
    assert frames == ([0, 1, 2, 3, 4, 5], [4, 3], list(range(4, 11)))
    assert playback.state is State.READY


def test_a_ready_playback_that_is_turned_begins_at_its_other_end():
    playback = on_start()
    playback.set_rate(START, -0.5)
    assert (playback.state, playback.clock.position) == (State.READY, 0.1)
    playback.set_rate(START, -2.0)
    assert playback.clock.position == 0.1
    playback.set_rate(START, 2.0)
    assert playback.clock.position == 0.0
    playback.unload(START)
    playback.set_rate(START, -1.0)
    playback.load(START, make_trajectory())
    assert playback.clock.position == 0.1


def test_a_restart_knows_the_direction():
    playback = backwards(-0.5)
    fresh = make()
    come_back(fresh, START, playback.trajectory, keep(playback))
    assert (fresh.state, fresh.rate, fresh.clock.position) == (State.READY, -0.5, 0.1)
