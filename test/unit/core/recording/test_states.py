"""The recorder's states: what is announced, and the texts of its refusals."""

from __future__ import annotations

import pytest

from mrlab_ros.core.errors import Misuse
from mrlab_ros.core.recording.states import TABLE, RecorderEvent, RecorderState, reason
from mrlab_ros.core.state_machine import Machine


def machine_after(*events: RecorderEvent) -> Machine:
    machine = Machine(TABLE, lambda state, event: reason(state, event, "class.bag"))
    for event in events:
        machine.fire(event)
    return machine


def test_a_replay_is_announced_before_it_begins():
    machine, announced = machine_after(), []
    for event in (
        RecorderEvent.REPLAY,
        RecorderEvent.BEGIN,
        RecorderEvent.PAUSE,
        RecorderEvent.RESUME,
        RecorderEvent.END,
    ):
        announced.append(machine.fire(event).announced.name)
    assert announced == ["REPLAYING", "REPLAYING", "PAUSED", "REPLAYING", "STOPPED"]


@pytest.mark.parametrize(
    ("before", "event", "says"),
    [
        ((), RecorderEvent.STOP, "nothing is recorded or replayed"),
        ((), RecorderEvent.SPLIT, "nothing is recorded; start a recording first"),
        ((), RecorderEvent.PAUSE, "nothing is replayed; start a replay first"),
        ((RecorderEvent.START,), RecorderEvent.SEEK, "nothing is replayed"),
        (
            (RecorderEvent.START,),
            RecorderEvent.REPLAY,
            "cannot start a replay in RECORDING; a recording into class.bag runs; stop it first: "
            "mrlab record --stop; possible now: split the recording and stop",
        ),
        (
            (RecorderEvent.REPLAY,),
            RecorderEvent.START,
            "class.bag is being replayed; stop that first",
        ),
        (
            (RecorderEvent.REPLAY, RecorderEvent.BEGIN, RecorderEvent.PAUSE),
            RecorderEvent.REPLAY,
            "class.bag is being replayed; stop that first",
        ),
    ],
)
def test_a_refusal_says_what_is_under_way_and_what_to_do(before, event, says):
    machine = machine_after(*before)
    state = machine.state
    with pytest.raises(Misuse) as raised:
        machine.fire(event)
    assert says in str(raised.value)
    assert machine.state is state


def test_an_end_that_comes_after_the_stop_changes_nothing():
    machine = machine_after(RecorderEvent.REPLAY, RecorderEvent.BEGIN, RecorderEvent.STOP)
    for late in (RecorderEvent.END, RecorderEvent.FAIL, RecorderEvent.CLOSE):
        assert machine.fire(late) is RecorderState.STOPPED
