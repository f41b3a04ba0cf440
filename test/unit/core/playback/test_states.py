"""The table of the seven states."""

from __future__ import annotations

import pytest

from mrlab_ros.core.errors import IllegalEvent
from mrlab_ros.core.playback.states import (
    COMMANDS,
    TRANSITIONS,
    Event,
    State,
    after,
    possible,
)


@pytest.mark.parametrize("event", Event)
@pytest.mark.parametrize("state", State)
def test_every_pair_has_one_answer(state, event):
    if (state, event) in TRANSITIONS:
        assert after(state, event) is TRANSITIONS[state, event]
        return
    with pytest.raises(IllegalEvent) as raised:
        after(state, event)
    text = str(raised.value)
    assert text.startswith(f"cannot {event.value} in {state.name}; possible now: ")
    for command in COMMANDS:
        assert (command.value in text.split("possible now: ")[1].split(", ")) == (
            command in possible(state)
        )


def test_the_design_s_path_is_in_the_table():
    state, path = State.IDLE, []
    for event in (
        Event.LOAD, Event.STAGE, Event.ARRIVED, Event.PAUSE, Event.PLAY, Event.COLLIDED,
        Event.CLEARED, Event.PLAY, Event.FINISHED, Event.REARMED,
    ):  # fmt: skip
        state = after(state, event)
        path.append(state.name)
    assert path == [
        "READY", "ADJUSTING", "PLAYING", "PAUSED", "PLAYING", "COLLISION_HALT", "PAUSED",
        "PLAYING", "COMPLETE", "READY",
    ]  # fmt: skip


def test_only_physics_ends_a_halt_with_motion_possible_again():
    leaving = {e for (s, e), t in TRANSITIONS.items() if s is State.COLLISION_HALT and t is not s}
    assert leaving == {Event.CLEARED}
