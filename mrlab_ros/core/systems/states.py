"""The six states of a robot system, in one table that nothing else decides.

`docs/systems.md` shows the diagram that is drawn from the table.
"""

from __future__ import annotations

from enum import Enum

from mrlab_ros.core.errors import IllegalEvent


class SystemState(Enum):
    """The values are those of mrlab_msgs/RobotSystem."""

    READY = 1
    STAGING = 2
    PLAYING = 3
    PAUSED = 4
    COLLISION_HALT = 5
    COMPLETE = 6


class SystemEvent(Enum):
    """What can happen to a system. The value says it as a person would."""

    STAGE = "play"
    START = "start"
    ABORT = "give up"
    PAUSE = "pause"
    STOP = "stop"
    SEEK = "seek"
    FINISH = "finish"
    REARM = "be ready again"
    COLLIDE = "collide"
    CLEAR = "be clear again"


S, E = SystemState, SystemEvent
TRANSITIONS: dict[tuple[SystemState, SystemEvent], SystemState] = {
    (S.READY, E.STAGE): S.STAGING,
    (S.READY, E.STOP): S.READY,
    (S.READY, E.SEEK): S.PAUSED,
    (S.READY, E.ABORT): S.READY,
    (S.STAGING, E.START): S.PLAYING,
    (S.STAGING, E.ABORT): S.READY,
    (S.STAGING, E.PAUSE): S.PAUSED,
    (S.STAGING, E.STOP): S.READY,
    (S.STAGING, E.COLLIDE): S.COLLISION_HALT,
    (S.PLAYING, E.PAUSE): S.PAUSED,
    (S.PLAYING, E.STOP): S.READY,
    (S.PLAYING, E.SEEK): S.PLAYING,
    (S.PLAYING, E.FINISH): S.COMPLETE,
    (S.PLAYING, E.COLLIDE): S.COLLISION_HALT,
    (S.PLAYING, E.ABORT): S.READY,
    (S.PAUSED, E.STAGE): S.STAGING,
    (S.PAUSED, E.PAUSE): S.PAUSED,
    (S.PAUSED, E.STOP): S.READY,
    (S.PAUSED, E.SEEK): S.PAUSED,
    (S.PAUSED, E.ABORT): S.READY,
    (S.COLLISION_HALT, E.STOP): S.COLLISION_HALT,
    (S.COLLISION_HALT, E.SEEK): S.COLLISION_HALT,
    (S.COLLISION_HALT, E.CLEAR): S.PAUSED,
    (S.COLLISION_HALT, E.ABORT): S.READY,
    (S.COMPLETE, E.REARM): S.READY,
}
COMMANDS = (E.STAGE, E.PAUSE, E.STOP, E.SEEK)
del S, E


def after(state: SystemState, event: SystemEvent) -> SystemState:
    """Return the state that `event` leads to; raise IllegalEvent where the table has none."""
    try:
        return TRANSITIONS[state, event]
    except KeyError:
        allowed = ", ".join(e.value for e in COMMANDS if (state, e) in TRANSITIONS)
        raise IllegalEvent(
            f"cannot {event.value} in {state.name}; possible now: {allowed or 'only waiting'}"
        ) from None
