"""The timeline of a replay: where it is, how fast it goes, and what is published again."""

from __future__ import annotations

from mrlab_ros.core.base.clock import PlaybackClock, checked_position
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.recording.diagnostics import BAD_REPLAY_RATE
from mrlab_ros.core.recording.metadata import Topic

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

    @property
    def standing(self) -> bool:
        return self._clock.rate == 0

    def position(self, now_ns: int) -> float:
        return min(self._clock.at(now_ns), self.duration)

    def due_ns(self, position: float) -> int:
        """Return when `position` is due; the timeline must not stand."""
        return self._clock.due(position)

    def play(self, now_ns: int) -> None:
        self._clock = PlaybackClock(now_ns, self.position(now_ns), self.rate)

    def pause(self, now_ns: int) -> None:
        self._clock = PlaybackClock(now_ns, self.position(now_ns))

    def seek(self, now_ns: int, position: float) -> None:
        """Go to `position`, playing or standing as before; raise BadInput where it is outside."""
        checked = checked_position(position, self.duration)
        self._clock = PlaybackClock(now_ns, checked, self._clock.rate)

    def set_rate(self, now_ns: int, rate: float) -> None:
        """Go on at `rate`; raise BadInput where it is out of range."""
        self.rate = checked_replay_rate(rate)
        if not self.standing:
            self.play(now_ns)
