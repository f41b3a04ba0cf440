"""The seven states of a robot's playback, in one table that nothing else decides.

`docs/playback.md` shows the diagram that is drawn from the table.
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
    ARRIVED = "arrive"
    STAGED = "arrive and wait"
    PAUSE = "pause"
    STOP = "stop"
    SEEK = "seek"
    COLLIDED = "collide"
    CLEARED = "be clear again"
    FINISHED = "finish"
    REARMED = "be ready again"


TRANSITIONS: dict[tuple[State, Event], State] = {
    (State.IDLE, Event.LOAD): State.READY,
    (State.READY, Event.LOAD): State.READY,
    (State.READY, Event.UNLOAD): State.IDLE,
    (State.READY, Event.STAGE): State.ADJUSTING,
    (State.READY, Event.PLAY): State.PLAYING,
    (State.READY, Event.STOP): State.READY,
    (State.READY, Event.SEEK): State.PAUSED,
    (State.ADJUSTING, Event.ARRIVED): State.PLAYING,
    (State.ADJUSTING, Event.STAGED): State.PAUSED,
    (State.ADJUSTING, Event.PAUSE): State.PAUSED,
    (State.ADJUSTING, Event.STOP): State.READY,
    (State.ADJUSTING, Event.SEEK): State.PAUSED,
    (State.ADJUSTING, Event.COLLIDED): State.COLLISION_HALT,
    (State.PLAYING, Event.PAUSE): State.PAUSED,
    (State.PLAYING, Event.STOP): State.READY,
    (State.PLAYING, Event.SEEK): State.PLAYING,
    (State.PLAYING, Event.STAGE): State.ADJUSTING,
    (State.PLAYING, Event.COLLIDED): State.COLLISION_HALT,
    (State.PLAYING, Event.FINISHED): State.COMPLETE,
    (State.PAUSED, Event.LOAD): State.READY,
    (State.PAUSED, Event.UNLOAD): State.IDLE,
    (State.PAUSED, Event.STAGE): State.ADJUSTING,
    (State.PAUSED, Event.PLAY): State.PLAYING,
    (State.PAUSED, Event.PAUSE): State.PAUSED,
    (State.PAUSED, Event.STOP): State.READY,
    (State.PAUSED, Event.SEEK): State.PAUSED,
    (State.COLLISION_HALT, Event.STOP): State.COLLISION_HALT,
    (State.COLLISION_HALT, Event.SEEK): State.COLLISION_HALT,
    (State.COLLISION_HALT, Event.CLEARED): State.PAUSED,
    (State.COMPLETE, Event.REARMED): State.READY,
}

# What a person can ask for; the other events come from the motion itself or from physics.
COMMANDS = (Event.LOAD, Event.UNLOAD, Event.PLAY, Event.PAUSE, Event.STOP, Event.SEEK)


def possible(state: State) -> tuple[Event, ...]:
    """Return the commands that `state` allows, in the order of COMMANDS."""
    return tuple(event for event in COMMANDS if (state, event) in TRANSITIONS)


def after(state: State, event: Event) -> State:
    """Return the state that `event` leads to; raise IllegalEvent where the table has none."""
    try:
        return TRANSITIONS[state, event]
    except KeyError:
        allowed = ", ".join(e.value for e in possible(state)) or "nothing but waiting"
        raise IllegalEvent(
            f"cannot {event.value} in {state.name}; possible now: {allowed}"
        ) from None
