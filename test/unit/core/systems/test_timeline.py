"""The shares of a timeline, its waits and what is known of its starts. No robot, no clock."""

from __future__ import annotations

import itertools

import pytest
from hypothesis import given
from hypothesis import strategies as st
from refusals import refused

from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.playback.states import State
from mrlab_ros.core.systems.diagnostics import BAD_DWELL
from mrlab_ros.core.systems.timeline import SAME_INSTANT, Member, Mode, Timeline
from mrlab_ros.core.systems.waits import parse


def member(robot: str, duration: float, waits: tuple[str, ...] = (), **fields) -> Member:
    return Member(
        robot, duration=duration, frame_rate=100.0, waits=tuple(map(parse, waits)), **fields
    )


def make(*members: Member, mode: Mode = Mode.PARALLEL) -> Timeline:
    timeline = Timeline(members, mode)
    timeline.check_waits()
    timeline.lay_out()
    return timeline


def starts(timeline: Timeline) -> list[float]:
    return [m.start for m in timeline]


def robots(members) -> list[str]:
    return [m.robot for m in members]


def test_parallel_members_share_the_start_and_sequential_ones_follow_with_their_dwell():
    members = (member("a", 1.0, dwell=0.25), member("b", 0.5), member("c", 2.0))
    parallel = make(*members)
    assert (starts(parallel), parallel.duration) == ([0.0, 0.0, 0.0], 2.0)
    sequential = make(*members, mode=Mode.SEQUENTIAL)
    assert (starts(sequential), sequential.duration) == ([0.0, 1.25, 1.75], 3.75)


@given(
    st.lists(st.tuples(st.floats(0.01, 100), st.floats(0, 10)), min_size=1, max_size=8),
    st.sampled_from(list(Mode)),
    st.floats(0, 1),
)
def test_a_seek_puts_every_member_into_its_share(members, mode, share):
    timeline = make(
        *(member(f"r{i}", d, dwell=dwell) for i, (d, dwell) in enumerate(members)), mode=mode
    )
    position = share * timeline.duration
    timeline.seek(position)
    for m in timeline:
        assert 0 <= m.position <= m.duration
        if position < m.start:
            assert (m.position, m.done) == (0.0, False)
        elif position > m.end + SAME_INSTANT:
            assert (m.position, m.done) == (m.duration, True)
        else:
            assert m.position == pytest.approx(position - m.start, abs=1e-6)
    if mode is Mode.SEQUENTIAL:
        for before, after in itertools.pairwise(timeline):
            assert before.end + before.dwell <= after.start + 1e-9
            assert not (after.done and not before.done)


def test_a_share_that_begins_later_shifts_those_behind_it_but_none_under_way():
    timeline = make(
        member("a", 1.0), member("b", 1.0, dwell=0.5), member("c", 1.0), mode=Mode.SEQUENTIAL
    )
    a, b, c = timeline
    timeline.shift(a, 2.0)
    assert starts(timeline) == [2.0, 3.0, 4.5]
    b.ordered = True
    timeline.shift(a, 5.0)
    assert (b.start, c.start) == (3.0, 4.5)


def test_a_shift_in_parallel_mode_moves_nobody_else():
    timeline = make(member("a", 1.0), member("b", 1.0))
    timeline.shift(timeline.members["a"], 3.0)
    assert starts(timeline) == [3.0, 0.0]
    assert timeline.duration == 4.0


def test_in_sequential_mode_nobody_behind_a_wait_or_a_halt_has_a_known_start():
    timeline = make(
        member("a", 1.0),
        member("b", 1.0, ("frame 50: object cube held by b",)),
        member("c", 1.0),
        mode=Mode.SEQUENTIAL,
    )
    a, b, _ = timeline
    assert robots(timeline.known_starts()) == ["a", "b"]
    b.position = 0.5
    assert robots(timeline.known_starts()) == ["a"]
    timeline.mode = Mode.PARALLEL
    assert robots(timeline.known_starts()) == ["a", "c"]
    a.playback_state = State.COLLISION_HALT
    assert robots(timeline.known_starts()) == ["c"]
    timeline.mode = Mode.SEQUENTIAL
    assert robots(timeline.known_starts()) == []
    a.done = True
    assert robots(timeline.known_starts()) == []


def test_a_wait_for_a_frame_is_met_when_the_other_has_reached_it():
    timeline = make(member("a", 1.0), member("b", 1.0, ("frame 30: after a.frame 60",)))
    a, b = timeline
    assert b.until == 0.3
    a.ordered = b.ordered = True
    assert timeline.meet_waits(0.59) == []
    assert timeline.meet_waits(0.6) == [b]
    assert b.until is None
    assert b.open_waits == []


def test_who_holds_an_object_counts_only_once_the_member_is_there():
    timeline = make(member("a", 1.0, ("frame 50: object cube free",)))
    (a,) = timeline
    a.ordered = True
    assert timeline.meet_waits(0.2) == []
    assert a.until == 0.5
    a.ordered, a.position = False, 0.5
    timeline.grasped("b", "cube")
    timeline.meet_waits(0.5)
    assert a.waiting_for is a.waits[0]
    timeline.grasped("b", None)
    timeline.meet_waits(0.5)
    assert a.waiting_for is None


def test_rewinding_forgets_the_run():
    timeline = make(
        member("a", 1.0), member("b", 1.0, ("frame 10: after a.frame 5",)), mode=Mode.SEQUENTIAL
    )
    b = timeline.members["b"]
    timeline.seek(1.5)
    assert b.met
    timeline.shift(b, 7.0)
    timeline.rewind()
    assert (starts(timeline), [m.position for m in timeline]) == ([0.0, 1.0], [0.0, 0.0])
    assert not any(m.done or m.met for m in timeline)


@pytest.mark.parametrize("dwell", [-0.1, 3600.0, float("nan"), float("inf")])
def test_a_dwell_out_of_range_is_refused(dwell):
    with refused(BAD_DWELL, BadInput, longest=3600.0):
        Member("a", dwell=dwell)
