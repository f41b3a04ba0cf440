"""The table of the seven states."""

from __future__ import annotations

from mrlab_ros.core.base.diagnostics import ILLEGAL_EVENT
from mrlab_ros.core.base.state_machine import Machine
from mrlab_ros.core.playback.states import TABLE, Event, State


def test_the_path_of_a_run_is_in_the_table():
    machine, path = Machine(TABLE), []
    for event in (
        Event.LOAD, Event.STAGE, Event.ARRIVED, Event.PAUSE, Event.PLAY, Event.COLLIDED,
        Event.CLEARED, Event.PLAY, Event.FINISHED, Event.REARMED,
    ):  # fmt: skip
        path.append(machine.fire(event).name)
    assert path == [
        "READY", "ADJUSTING", "PLAYING", "PAUSED", "PLAYING", "COLLISION_HALT", "PAUSED",
        "PLAYING", "COMPLETE", "READY",
    ]  # fmt: skip


def test_only_a_clear_arm_ends_a_halt():
    leaving = {
        event
        for (state, event), target in TABLE.rows.items()
        if state is State.COLLISION_HALT and target is not state
    }
    assert leaving == {Event.CLEARED, Event.CLEAR_HALT}


def test_a_loop_never_leaves_the_moving_states():
    assert TABLE.rows[State.PLAYING, Event.REPEATED] is State.PLAYING
    assert TABLE.rows[State.PLAYING, Event.RETURNED] is State.ADJUSTING
    assert {state for state, event in TABLE.rows if event in (Event.REPEATED, Event.RETURNED)} == {
        State.PLAYING
    }


def test_a_refusal_says_what_is_possible():
    refusal = TABLE.refused(State.IDLE, Event.PLAY).diagnostic
    assert refusal.code == ILLEGAL_EVENT.code
    assert refusal.values == {"event": "play", "state": "IDLE", "possible": ["load"]}
    assert TABLE.refused(State.COMPLETE, Event.PLAY).diagnostic.values["possible"] == []
