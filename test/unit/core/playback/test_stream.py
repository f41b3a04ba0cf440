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
