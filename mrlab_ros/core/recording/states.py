"""The states of the recorder: one table decides every transition.

`docs/recorder.md` shows the diagram and the table. A replay that loops starts over within its
state, which its timeline decides, so a new round is no event.
"""

from __future__ import annotations

from enum import Enum

from mrlab_ros.core.base.diagnostic import Diagnostic
from mrlab_ros.core.base.state_machine import Table
from mrlab_ros.core.recording.diagnostics import (
    ENDING,
    NO_RECORDING,
    NO_REPLAY,
    NOTHING_RUNS,
    RECORDING_RUNS,
    REPLAY_RUNS,
)


class RecorderState(Enum):
    """The values are those of mrlab_msgs/RecorderState, but for PREPARING."""

    STOPPED = 0
    RECORDING = 1
    REPLAYING = 2
    PAUSED = 3
    # The lab's nodes leave the graph before the replay begins.
    PREPARING = 4

    @property
    def announced(self) -> RecorderState:
        """The state that is published: the lab's nodes leave when they receive REPLAYING."""
        return RecorderState.REPLAYING if self is RecorderState.PREPARING else self


class RecorderEvent(Enum):
    """What can happen to the recorder. The value is the verb in "cannot <value> in <STATE>"."""

    START = "start a recording"
    SPLIT = "split the recording"
    REPLAY = "start a replay"
    BEGIN = "begin the replay"
    PAUSE = "pause the replay"
    RESUME = "resume the replay"
    SEEK = "seek in the replay"
    SET_RATE = "set the rate"
    SET_LOOP = "set the loop"
    STOP = "stop"
    END = "reach the end"
    FAIL = "fail"
    CLOSE = "shut down"


S, E = RecorderState, RecorderEvent
TABLE: Table[RecorderState, RecorderEvent] = Table(
    initial=S.STOPPED,
    transitions={
        (S.STOPPED, E.START): S.RECORDING,
        (S.STOPPED, E.REPLAY): S.PREPARING,
        (S.RECORDING, E.SPLIT): S.RECORDING,
        (S.RECORDING, E.STOP): S.STOPPED,
        (S.RECORDING, E.FAIL): S.STOPPED,
        (S.RECORDING, E.CLOSE): S.STOPPED,
        (S.PREPARING, E.BEGIN): S.REPLAYING,
        (S.PREPARING, E.FAIL): S.STOPPED,
        (S.PREPARING, E.CLOSE): S.STOPPED,
        (S.REPLAYING, E.PAUSE): S.PAUSED,
        (S.REPLAYING, E.RESUME): S.REPLAYING,
        (S.REPLAYING, E.SEEK): S.REPLAYING,
        (S.REPLAYING, E.SET_RATE): S.REPLAYING,
        (S.REPLAYING, E.SET_LOOP): S.REPLAYING,
        (S.REPLAYING, E.STOP): S.STOPPED,
        (S.REPLAYING, E.END): S.STOPPED,
        (S.REPLAYING, E.FAIL): S.STOPPED,
        (S.REPLAYING, E.CLOSE): S.STOPPED,
        (S.PAUSED, E.PAUSE): S.PAUSED,
        (S.PAUSED, E.RESUME): S.REPLAYING,
        (S.PAUSED, E.SEEK): S.PAUSED,
        (S.PAUSED, E.SET_RATE): S.PAUSED,
        (S.PAUSED, E.SET_LOOP): S.PAUSED,
        (S.PAUSED, E.STOP): S.STOPPED,
        # The last message may leave while a pause is on its way.
        (S.PAUSED, E.END): S.STOPPED,
        (S.PAUSED, E.FAIL): S.STOPPED,
        (S.PAUSED, E.CLOSE): S.STOPPED,
    },
    # A recording or a replay may end by itself at the moment in which it is stopped.
    ignored={E.END: (S.STOPPED,), E.FAIL: (S.STOPPED,), E.CLOSE: (S.STOPPED,)},
    commands=(
        E.START, E.SPLIT, E.REPLAY, E.PAUSE, E.RESUME, E.SEEK, E.SET_RATE, E.SET_LOOP, E.STOP,
    ),
)  # fmt: skip
del S, E


def reason(state: RecorderState, event: RecorderEvent, bag: str) -> Diagnostic:
    """Return why `event` is refused in `state`.

    bag: what is recorded or replayed; empty: nothing.
    """
    if event in (RecorderEvent.START, RecorderEvent.REPLAY):
        if state is RecorderState.RECORDING:
            return RECORDING_RUNS(bag=bag, fixes=ENDING)
        return REPLAY_RUNS(bag=bag)
    if event is RecorderEvent.SPLIT:
        return NO_RECORDING()
    if event is RecorderEvent.STOP:
        return NOTHING_RUNS()
    return NO_REPLAY()
