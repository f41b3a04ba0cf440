"""What a playback host writes into its journal, and what a restarted playback makes of it."""

from __future__ import annotations

import json

import numpy as np
import pytest
from fakes import SECOND, StraightPlanner, make_model, make_trajectory

from mrlab_ros.core.playback import saved_state
from mrlab_ros.core.playback.playback import Playback
from mrlab_ros.core.playback.saved_state import Kept, come_back, keep
from mrlab_ros.core.playback.states import State

START = 5 * SECOND


def make() -> Playback:
    return Playback(make_model(), StraightPlanner(), 0.0)


def run(playback: Playback, seconds: float) -> None:
    end = START + round(seconds * SECOND)
    while (due := playback.due_ns()) is not None and due <= end:
        playback.tick(due)


def on_its_way(seconds: float) -> Playback:
    """A playback that has played for a while."""
    playback = make()
    playback.load(START, make_trajectory(np.arange(200.0).reshape(100, 2) * 1e-3))
    playback.seek(START, 0.0)
    playback.set_loop(True)
    playback.play(START)
    run(playback, seconds)
    return playback


def again(kept: Kept | None) -> Kept:
    assert kept is not None
    content = {saved_state.ROBOTS: {"a": saved_state.plain("m", kept)}}
    ((model, read),) = saved_state.read(json.loads(json.dumps(content))).values()
    assert model == "m"
    return read


def test_a_restarted_playback_goes_on_with_the_next_frame():
    before = on_its_way(0.305)
    kept = again(keep(before))
    after = make()
    after.stand_at(START, kept.arm)
    come_back(after, START, before.trajectory, kept)
    assert (after.state, after.rate, after.loop) == (State.PAUSED, 1.0, True)
    assert after.clock.position == before.clock.at(START) or after.frame == before.frame
    assert np.array_equal(after.arm, before.arm)
    after.play(START)
    sample = after.tick(after.due_ns())
    assert sample is not None
    assert sample.frame == before.frame + 1


@pytest.mark.parametrize(
    ("reported", "state"),
    [(None, State.COLLISION_HALT), (True, State.COLLISION_HALT), (False, State.PAUSED)],
)
def test_a_halt_comes_back_unless_the_arm_was_cleared_meanwhile(reported, state):
    before = on_its_way(0.3)
    before.collide(START, "touches")
    after = make()
    if reported is not None:
        (after.collide if reported else after.clear)(START, *["touches"] * reported)
    come_back(after, START, before.trajectory, again(keep(before)))
    assert after.state is state


def test_one_that_had_not_begun_is_ready_for_the_first_frame():
    before = make()
    before.load(START, make_trajectory())
    after = make()
    come_back(after, START, before.trajectory, again(keep(before)))
    assert after.state is State.READY
    assert np.array_equal(after.arm, before.arm)


def test_without_a_trajectory_nothing_is_kept():
    assert keep(make()) is None


@pytest.mark.parametrize("broken", [{"rate": "x"}, {"arm": None}, {"arm": "y"}, {"arm": [[1.0]]}])
def test_an_entry_of_another_form_is_left_out(broken):
    kept = keep(on_its_way(0.1))
    assert kept is not None
    assert (
        saved_state.read({saved_state.ROBOTS: {"a": saved_state.plain("m", kept) | broken}}) == {}
    )


@pytest.mark.parametrize(
    ("position", "joints", "taken"),
    [
        (0.31, [0.062, 0.063], True),
        # Another run, or another robot, has left it.
        (0.3 + saved_state.MOST_BEHIND_S + 0.01, [0.062, 0.063], False),
        (0.31, [0.062], False),
    ],
)
def test_the_last_pose_is_newer_than_the_journal_where_it_is_of_its_run(position, joints, taken):
    kept = Kept("wave", 1, 0.3, 1.0, loop=False, halted=False, begun=True, arm=np.zeros(2))
    found = saved_state.with_pose(kept, position, joints)
    expected = (position, joints) if taken else (0.3, [0.0, 0.0])
    assert (found.position, found.arm.tolist()) == expected


def test_a_member_of_a_system_stands_after_a_freeze_and_an_independent_robot_goes_on():
    alone, member = on_its_way(0.305), on_its_way(0.305)
    member.system = "cell"
    for playback in (alone, member):
        playback.thaw(START + 30 * SECOND)
    assert (alone.state, member.state) == (State.PLAYING, State.PAUSED)
    assert member.clock.position == 0.3
