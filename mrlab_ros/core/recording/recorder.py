"""The recorder: its states, its journal, and the timeline of a replay.

One table decides every transition; `docs/recorder-states.md` shows the diagram and the table.
A replay that loops starts over within its state, by its timeline, so a new round is no event.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import asdict, dataclass
from enum import Enum
from pathlib import Path
from typing import Any

from mrlab_ros.core.base.clock import PlaybackClock, checked_position
from mrlab_ros.core.base.diagnostic import Diagnostic
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.base.state_machine import Table
from mrlab_ros.core.recording.diagnostics import (
    BAD_REPLAY_RATE,
    ENDING,
    NO_RECORDING,
    NO_REPLAY,
    NOTHING_RUNS,
    RECORDING_RUNS,
    REPLAY_RUNS,
)
from mrlab_ros.core.recording.metadata import Topic


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
    """Events of the recorder. The value is the verb in "cannot <value> in <STATE>"."""

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


@dataclass(frozen=True)
class Entry:
    """A recording under way. split_duration: s after which a new file begins; 0: never.

    lab: the id of the lab that records. closed: its recorder ended in good order, unasked.
    """

    folder: Path
    topics: tuple[str, ...]
    split_duration: float
    lab: str = ""
    closed: bool = False

    def continues_in(self, lab: str) -> bool:
        """Return whether a recorder that starts in `lab` continues the recording.

        It ends with its lab, unless the recorder was killed.
        """
        return not self.closed or (lab != "" and lab == self.lab)


@dataclass(frozen=True)
class StopOrder:
    """An order to end the recording into `bag`, left while no recorder answered.

    bag: empty: the recording that runs when the order is carried out.
    """

    id: str
    bag: str = ""

    def concerns(self, folder: Path) -> bool:
        """Return whether the order is to end the recording into `folder`."""
        return self.bag in ("", str(folder))


def plain(entry: Entry) -> dict[str, Any]:
    """Return the content of the journal."""
    return {**asdict(entry), "folder": str(entry.folder), "topics": list(entry.topics)}


def read(content: Mapping[str, Any]) -> Entry | None:
    """Return what was recorded; None where nothing was."""
    try:
        return Entry(
            Path(content["folder"]),
            tuple(map(str, content["topics"])),
            float(content["split_duration"]),
            str(content.get("lab", "")),
            bool(content.get("closed", False)),
        )
    except (KeyError, TypeError, ValueError):
        return None


RATE_RANGE = (0.1, 10.0)
# Not latched, and yet the present state of something: without it a replay that stands after a
# seek would show robots and objects where they were before.
STATE_TYPES = ("sensor_msgs/msg/JointState", "mrlab_msgs/msg/SceneObjects")


def checked_replay_rate(rate: float) -> float:
    """Return `rate` where it lies in RATE_RANGE; raise BadInput otherwise."""
    low, high = RATE_RANGE
    if not low <= rate <= high:
        raise BadInput(BAD_REPLAY_RATE(rate=rate, low=low, high=high))
    return rate


def is_state(topic: Topic) -> bool:
    """Return whether the topic's newest message before a place says how things are there."""
    return topic.latched or topic.type in STATE_TYPES


class ReplayTimeline:
    """Goes from 0 to `duration` s; stands until the first play().

    Times are ns of whatever clock the caller uses, positions s from the bag's first message.
    """

    def __init__(self, duration: float, rate: float, start: float, loop: bool) -> None:
        self.duration = duration
        self.loop = loop
        self.rate = checked_replay_rate(rate)
        self._clock = PlaybackClock(position=checked_position(start, duration))
        # Where it is to stand again.
        self._until = math.inf

    @property
    def standing(self) -> bool:
        return self._clock.rate == 0

    def position(self, now_ns: int) -> float:
        return min(self._clock.at(now_ns), self.duration, self._until)

    def due_ns(self, position: float) -> int:
        """Return when `position` is due; the timeline must not stand."""
        return self._clock.due(position)

    @property
    def stop_ns(self) -> int | None:
        """Return when the place is due at which it is to stand; None: it plays to the end."""
        return None if math.isinf(self._until) else self.due_ns(self._until)

    def play(self, now_ns: int, until: float = math.inf) -> None:
        """Play; at `until`, s, the caller is to pause it."""
        position = self.position(now_ns)
        self._clock, self._until = PlaybackClock(now_ns, position, self.rate), until

    def pause(self, now_ns: int) -> None:
        self._clock = PlaybackClock(now_ns, self.position(now_ns))
        self._until = math.inf

    def seek(self, now_ns: int, position: float) -> None:
        """Go to `position`, playing or standing as before; raise BadInput where it is outside."""
        checked = checked_position(position, self.duration)
        self._clock, self._until = PlaybackClock(now_ns, checked, self._clock.rate), math.inf

    def set_rate(self, now_ns: int, rate: float) -> None:
        """Go on at `rate`; raise BadInput where it is out of range."""
        self.rate = checked_replay_rate(rate)
        if not self.standing:
            self.play(now_ns, self._until)
