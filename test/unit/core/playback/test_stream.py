"""The joint states of one robot and their deadlines, without commands and states."""

from __future__ import annotations

import numpy as np
import pytest
from fakes import SECOND, StraightMotion, make_trajectory
from hypothesis import given
from hypothesis import strategies as st

from mrlab_ros.core.playback.stream import LOST_AFTER_NS, Stream

PERIOD = SECOND // 100
START = 3 * SECOND


def make(frames: int = 11, standing_rate: float = 0.0) -> Stream:
    stream = Stream(np.zeros(2), standing_rate)
    stream.trajectory = make_trajectory(np.arange(2.0 * frames).reshape(frames, 2))
    return stream


def take(stream: Stream, count: int) -> list:
    return [stream.trajectory_sample(stream.next_ns) for _ in range(count)]


def test_a_run_ends_on_its_last_frame_or_where_it_is_told_to():
    stream = make()
    stream.follow(START, 0.0)
    assert [s.frame for s in take(stream, 10)] == list(range(10))
    assert not stream.ended
    take(stream, 1)
    assert stream.ended
    stream = make()
    stream.follow(START, 0.0)
    stream.end_at(0.035)
    samples = take(stream, 5)
    assert [s.position for s in samples] == pytest.approx([0.0, 0.01, 0.02, 0.03, 0.035])
    assert (stream.held, stream.ended) == (True, False)
    assert samples[-1].due_ns == START + 35 * SECOND // 1000


def test_a_halt_keeps_the_place_and_following_goes_on_with_the_next_frame():
    stream = make()
    stream.follow(START, 0.0)
    take(stream, 4)
    stream.halt(START + SECOND)
    assert (stream.clock.rate, stream.clock.position, stream.frame) == (0.0, 0.03, 3)
    stream.follow(START + 2 * SECOND, 0.03)
    assert [s.frame for s in take(stream, 2)] == [4, 5]
    assert stream.sent == 6
    stream.jump(START + 3 * SECOND, 0.0)
    stream.follow(START + 3 * SECOND, 0.0)
    take(stream, 1)
    assert stream.sent == 1


def test_an_approach_ends_exactly_at_its_goal():
    stream = make()
    goal = stream.trajectory.positions[0]
    stream.approach(START, StraightMotion(np.ones(2), goal, 0.05), 0.0)
    samples = []
    while not stream.arrived:
        samples.append(stream.approach_sample(stream.next_ns))
    assert len(samples) == 6
    assert np.array_equal(samples[-1].positions, goal)
    assert not any(s.streamed for s in samples)
    assert stream.is_at(0.0)


def test_a_standing_pose_is_repeated_at_its_rate():
    stream = make(standing_rate=4.0)
    stream.stand(START, 0.0)
    assert stream.next_ns == START
    stream.standing_sample(START)
    assert stream.next_ns == START + SECOND // 4
    stream.stand(START, 0.0, sent=True)
    assert stream.next_ns == START + SECOND // 4
    silent = make(standing_rate=0.0)
    silent.stand(START, 0.0, sent=True)
    assert silent.next_ns is None


@given(late=st.integers(0, 3 * LOST_AFTER_NS // PERIOD), at=st.integers(0, 50))
def test_every_joint_state_is_sent_or_counted_as_lost(late, at):
    stream = make(6000)
    stream.follow(START, 0.0)
    take(stream, at)
    sample = stream.trajectory_sample(stream.next_ns + late * PERIOD)
    assert stream.sent + stream.lost == sample.frame + 1
    assert (stream.lost > 0) == (late * PERIOD > LOST_AFTER_NS)


@given(rate=st.floats(0.1, 4.0), steps=st.lists(st.floats(0.1, 4.0), max_size=5))
def test_positions_only_grow_whatever_rate_is_set_on_the_way(rate, steps):
    stream = make(101)
    stream.set_rate(0, rate)
    stream.follow(START, 0.0)
    samples = take(stream, 3)
    for new in steps:
        stream.set_rate(stream.next_ns - PERIOD // 3, new)
        samples += take(stream, 2)
    positions = [s.position for s in samples]
    assert all(np.diff(positions) > 0)
    assert all(np.diff([s.due_ns for s in samples]) > 0)


@pytest.mark.parametrize("rate", [0.25, 4.0])
def test_joint_states_that_are_late_when_the_rate_changes_leave_as_scheduled(rate):
    stream = make(1001)
    stream.follow(START, 0.0)
    samples = take(stream, 10)
    now = START + 2 * SECOND + 1
    stream.set_rate(now, rate)
    stream.set_rate(now + 50 * PERIOD, 1.0)
    while samples[-1].due_ns < now + 51 * PERIOD:
        samples.append(stream.trajectory_sample(max(stream.next_ns, now)))
    assert [s.frame for s in samples[:201]] == list(range(201))
    assert all(np.diff([s.due_ns for s in samples]) > 0)
    changed = 2.0 + 0.5 * rate
    assert samples[-1].position == pytest.approx(changed + 0.01, abs=0.011)
    assert stream.sent == len(samples)


def test_a_rate_that_holds_since_a_while_sends_no_stamp_back():
    stream = make(1001)
    stream.follow(START, 0.0)
    samples = take(stream, 101)
    stream.set_rate(START + SECOND // 2, 4.0)
    samples += take(stream, 3)
    assert all(np.diff([s.due_ns for s in samples]) > 0)
    assert samples[-1].position == pytest.approx(
        0.5 + 4 * (samples[-1].due_ns - START - SECOND // 2) / SECOND
    )


def test_what_is_too_late_is_counted_over_a_change_of_rate():
    stream = make(6001)
    stream.follow(START, 0.0)
    take(stream, 1)
    stream.set_rate(START + SECOND, 2.0)
    sample = stream.trajectory_sample(START + LOST_AFTER_NS + 2 * SECOND)
    # 100 of the first second, then every other frame.
    assert stream.sent + stream.lost == 100 + (sample.frame - 100) // 2 + 1


def backwards(rate: float = -1.0, frames: int = 11) -> Stream:
    stream = make(frames)
    stream.set_rate(0, rate)
    return stream


def test_backwards_every_frame_is_sent_once_with_its_exact_values_in_the_reverse_order():
    stream = backwards()
    assert (stream.begin, stream.end) == (0.1, 0.0)
    stream.follow(START, stream.begin)
    samples = take(stream, 11)
    assert [s.frame for s in samples] == list(range(10, -1, -1))
    assert np.array_equal([s.positions for s in samples], stream.trajectory.positions[::-1])
    assert [s.due_ns for s in samples] == [START + i * PERIOD for i in range(11)]
    assert stream.ended
    assert samples[-1].position == 0.0


@given(rate=st.floats(-4.0, -0.1))
def test_backwards_at_any_rate_the_first_and_the_last_frame_are_sent(rate):
    stream = backwards(rate)
    stream.follow(START, stream.begin)
    samples = []
    while not stream.ended:
        samples += take(stream, 1)
    assert [samples[0].position, samples[-1].position] == [0.1, 0.0]
    assert all(np.diff([s.position for s in samples]) < 0)
    assert samples[-1].due_ns == START + round(0.1 / -rate * SECOND)


def test_backwards_a_velocity_is_negative():
    stream = backwards(-2.0)
    stream.trajectory.channels.velocities.flags.writeable = True
    stream.trajectory.channels.velocities[:] = 3.0
    stream.follow(START, stream.begin)
    assert take(stream, 1)[0].velocities.tolist() == [-6.0, -6.0]


@given(
    rates=st.lists(st.floats(0.1, 4.0).flatmap(lambda r: st.sampled_from([r, -r])), max_size=8),
    late=st.floats(0, 1),
)
def test_a_turn_goes_back_through_the_poses_just_sent_and_never_off_the_trajectory(rates, late):
    stream = make(101)
    stream.follow(START, 0.0)
    samples = take(stream, 50)
    for rate in rates:
        before = stream.streamed
        stream.set_rate(samples[-1].due_ns + round(late * PERIOD), rate)
        sample = stream.trajectory_sample(stream.next_ns)
        moved = sample.position - before
        assert moved * rate >= 0
        assert abs(moved) <= 2 * abs(rate) / 100 + 0.04 * late + 1e-9
        assert 0 <= sample.position <= 1.0
        samples.append(sample)
    assert all(np.diff([s.due_ns for s in samples]) >= 0)


def test_backwards_what_is_too_late_is_left_out_and_the_first_frame_is_still_sent():
    stream = backwards(frames=6001)
    stream.follow(START, stream.begin)
    take(stream, 5)
    sample = stream.trajectory_sample(stream.next_ns + LOST_AFTER_NS + PERIOD)
    assert stream.sent + stream.lost == 6000 - sample.frame + 1
    assert stream.lost > 0
    sample = stream.trajectory_sample(START + 3600 * SECOND)
    assert (sample.frame, sample.position, stream.ended) == (0, 0.0, True)


def test_a_new_stream_sends_its_pose_at_once_and_has_sent_nothing():
    stream = Stream(np.ones(2), 10.0)
    assert (stream.sent, stream.lost, stream.next_ns, stream.frame) == (0, 0, 0, 0)


def test_who_stands_has_sent_nothing_of_the_trajectory_and_ends_nowhere_before_its_end():
    stream = make()
    stream.follow(START, 0.0)
    stream.end_at(0.03)
    take(stream, 3)
    stream.stand(START + SECOND, 0.02)
    assert (stream.streamed, stream.until, stream.position) == (None, None, 0.02)
    stream.follow(START + 2 * SECOND, 0.02)
    assert [s.frame for s in take(stream, 9)] == list(range(2, 11))


def test_where_an_arm_comes_back_it_stands_and_goes_on_behind_what_was_sent():
    stream = make()
    stream.come_back(START, 0.04, stream.trajectory.positions[4])
    sample = stream.standing_sample(START)
    assert sample.positions == pytest.approx(stream.trajectory.positions[4])
    stream.follow(START, 0.04)
    assert take(stream, 1)[0].frame == 5
    away = make()
    away.come_back(START, 0.04, np.full(2, 7.5))
    assert away.arm == pytest.approx([7.5, 7.5])
    away.follow(START, 0.04)
    assert take(away, 1)[0].frame == 4


def test_a_rate_set_before_anything_was_sent_sends_the_first_frame_too():
    stream = make()
    stream.follow(START, 0.0)
    stream.set_rate(START, 2.0)
    assert [s.frame for s in take(stream, 3)] == [0, 2, 4]


def test_a_goal_taken_up_in_motion_counts_the_pose_that_left():
    stream = make()
    stream.arm = stream.trajectory.positions[0]
    stream.go_on_from(START)
    stream.follow(START, 0.0)
    samples = take(stream, 10)
    assert [s.frame for s in samples] == list(range(1, 11))
    assert (stream.sent, stream.lost) == (11, 0)


def test_an_end_set_on_the_way_holds_for_the_joint_state_that_is_next():
    stream = make()
    stream.follow(START, 0.0)
    take(stream, 3)
    stream.end_at(0.0225)
    assert stream.next_ns == START + 22_500_000
    (sample,) = take(stream, 1)
    assert sample.position == 0.0225
    assert stream.held
