"""The recorder's states: what is announced, and the texts of its refusals."""

from __future__ import annotations

import pytest
from refusals import refused

from mrlab_ros.core.base.errors import Misuse
from mrlab_ros.core.base.state_machine import Machine
from mrlab_ros.core.recording.diagnostics import (
    NO_RECORDING,
    NO_REPLAY,
    NOTHING_RUNS,
    RECORDING_RUNS,
    REPLAY_RUNS,
)
from mrlab_ros.core.recording.recorder import TABLE, RecorderEvent, RecorderState, reason


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
    ("before", "event", "code", "possible"),
    [
        ((), RecorderEvent.STOP, NOTHING_RUNS, 2),
        ((), RecorderEvent.SPLIT, NO_RECORDING, 2),
        ((), RecorderEvent.PAUSE, NO_REPLAY, 2),
        ((RecorderEvent.START,), RecorderEvent.SEEK, NO_REPLAY, 2),
        ((RecorderEvent.START,), RecorderEvent.REPLAY, RECORDING_RUNS, 2),
        ((RecorderEvent.REPLAY,), RecorderEvent.START, REPLAY_RUNS, 0),
        (
            (RecorderEvent.REPLAY, RecorderEvent.BEGIN, RecorderEvent.PAUSE),
            RecorderEvent.REPLAY,
            REPLAY_RUNS,
            6,
        ),
    ],
)
def test_a_refusal_says_what_is_under_way(before, event, code, possible):
    machine = machine_after(*before)
    state = machine.state
    bag = {"bag": "class.bag"} if code in (RECORDING_RUNS, REPLAY_RUNS) else {}
    with refused(code, Misuse, **bag) as caught:
        machine.fire(event)
    assert len(caught.value.diagnostic.values.get("possible", ())) == possible
    assert machine.state is state


def test_an_end_that_comes_after_the_stop_changes_nothing():
    machine = machine_after(RecorderEvent.REPLAY, RecorderEvent.BEGIN, RecorderEvent.STOP)
    for late in (RecorderEvent.END, RecorderEvent.FAIL, RecorderEvent.CLOSE):
        assert machine.fire(late) is RecorderState.STOPPED
