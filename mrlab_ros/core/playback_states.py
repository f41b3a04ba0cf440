"""The seven states of a robot's playback, in one table that nothing else decides.

`docs/playback.md` shows the diagram that `mermaid()` draws from the table.
"""

from __future__ import annotations

from enum import Enum

from mrlab_ros.core.errors import IllegalEvent


class State(Enum):
    """The states; the values are those of mrlab_msgs/PlaybackState."""

    IDLE = 0
    READY = 1
    ADJUSTING = 2
    PLAYING = 3
    PAUSED = 4
    COLLISION_HALT = 5
    COMPLETE = 6


class Event(Enum):
    """What can happen to a playback. The value says it as a person would."""

    LOAD = "load"
    UNLOAD = "unload"
    STAGE = "move to the start"
    PLAY = "play"
    ARRIVED = "arrive at the start"
    PAUSE = "pause"
    STOP = "stop"
    SEEK = "seek"
    COLLIDED = "collide"
    CLEARED = "become clear"
    FINISHED = "finish"
    REARMED = "be ready again"


S, E = State, Event
TRANSITIONS: dict[tuple[State, Event], State] = {
    (S.IDLE, E.LOAD): S.READY,
    (S.READY, E.LOAD): S.READY,
    (S.READY, E.UNLOAD): S.IDLE,
    (S.READY, E.STAGE): S.ADJUSTING,
    (S.READY, E.PLAY): S.PLAYING,
    (S.READY, E.STOP): S.READY,
    (S.READY, E.SEEK): S.PAUSED,
    (S.ADJUSTING, E.ARRIVED): S.PLAYING,
    (S.ADJUSTING, E.STOP): S.READY,
    (S.ADJUSTING, E.COLLIDED): S.COLLISION_HALT,
    (S.PLAYING, E.PAUSE): S.PAUSED,
    (S.PLAYING, E.STOP): S.READY,
    (S.PLAYING, E.SEEK): S.PLAYING,
    (S.PLAYING, E.COLLIDED): S.COLLISION_HALT,
    (S.PLAYING, E.FINISHED): S.COMPLETE,
    (S.PAUSED, E.PLAY): S.PLAYING,
    (S.PAUSED, E.STAGE): S.ADJUSTING,
    (S.PAUSED, E.PAUSE): S.PAUSED,
    (S.PAUSED, E.STOP): S.READY,
    (S.PAUSED, E.SEEK): S.PAUSED,
    (S.PAUSED, E.LOAD): S.READY,
    (S.PAUSED, E.UNLOAD): S.IDLE,
    (S.COLLISION_HALT, E.CLEARED): S.PAUSED,
    (S.COLLISION_HALT, E.STOP): S.COLLISION_HALT,
    (S.COMPLETE, E.REARMED): S.READY,
}
del S, E
