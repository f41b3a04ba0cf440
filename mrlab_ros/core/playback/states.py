"""The seven states of a robot's playback: one table decides every transition.

`docs/playback.md` shows the diagram and the table. Setting the rate, the loop, a hold or the
owner changes no state and is allowed in every state, so these are no events.
"""

from __future__ import annotations

from enum import Enum

from mrlab_ros.core.base.state_machine import Table


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
    """Events of a playback. The value is the verb in "cannot <value> in <STATE>"."""

    LOAD = "load"
    UNLOAD = "unload"
    STAGE = "move to the start"
    IN_PLACE = "stay at the start"
    PLAY = "play"
    ARRIVED = "arrive"
    STAGED = "arrive and wait"
    PAUSE = "pause"
    HELD = "reach a hold"
    STOP = "stop"
    SEEK = "seek"
    COLLIDED = "collide"
    CLEARED = "be clear again"
    CLEAR_HALT = "clear the halt"
    RELEASED = "leave the system"
    REPEATED = "start over"
    RETURNED = "move back to the start"
    FINISHED = "finish"
    REARMED = "be ready again"
    RETURNED_PAUSED = "come back"
    RETURNED_HALTED = "come back in a halt"


TABLE: Table[State, Event] = Table(
    initial=State.IDLE,
    transitions={
        (State.IDLE, Event.LOAD): State.READY,
        # After a restart of the process.
        (State.IDLE, Event.RETURNED_PAUSED): State.PAUSED,
        (State.IDLE, Event.RETURNED_HALTED): State.COLLISION_HALT,
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
        (State.ADJUSTING, Event.RELEASED): State.PAUSED,
        (State.PLAYING, Event.PAUSE): State.PAUSED,
        (State.PLAYING, Event.HELD): State.PAUSED,
        (State.PLAYING, Event.STOP): State.READY,
        (State.PLAYING, Event.SEEK): State.PLAYING,
        (State.PLAYING, Event.STAGE): State.ADJUSTING,
        (State.PLAYING, Event.COLLIDED): State.COLLISION_HALT,
        (State.PLAYING, Event.RELEASED): State.PAUSED,
        (State.PLAYING, Event.REPEATED): State.PLAYING,
        (State.PLAYING, Event.RETURNED): State.ADJUSTING,
        (State.PLAYING, Event.FINISHED): State.COMPLETE,
        (State.PAUSED, Event.LOAD): State.READY,
        (State.PAUSED, Event.UNLOAD): State.IDLE,
        (State.PAUSED, Event.STAGE): State.ADJUSTING,
        (State.PAUSED, Event.IN_PLACE): State.PAUSED,
        (State.PAUSED, Event.PLAY): State.PLAYING,
        (State.PAUSED, Event.PAUSE): State.PAUSED,
        (State.PAUSED, Event.STOP): State.READY,
        (State.PAUSED, Event.SEEK): State.PAUSED,
        (State.COLLISION_HALT, Event.STOP): State.COLLISION_HALT,
        (State.COLLISION_HALT, Event.SEEK): State.COLLISION_HALT,
        (State.COLLISION_HALT, Event.CLEARED): State.PAUSED,
        (State.COLLISION_HALT, Event.CLEAR_HALT): State.PAUSED,
        (State.COMPLETE, Event.REARMED): State.READY,
    },
    # An arm that stands still does not halt, and only a halt ends when the arm is clear.
    ignored={
        Event.COLLIDED: (
            State.IDLE, State.READY, State.PAUSED, State.COLLISION_HALT, State.COMPLETE,
        ),
        Event.CLEARED: (
            State.IDLE, State.READY, State.ADJUSTING, State.PLAYING, State.PAUSED, State.COMPLETE,
        ),
        Event.RELEASED: (
            State.IDLE, State.READY, State.PAUSED, State.COLLISION_HALT, State.COMPLETE,
        ),
    },
    commands=(
        Event.LOAD, Event.UNLOAD, Event.PLAY, Event.PAUSE, Event.STOP, Event.SEEK,
        Event.CLEAR_HALT,
    ),
)  # fmt: skip

# The states in which the arm moves.
MOVING = (State.ADJUSTING, State.PLAYING)
