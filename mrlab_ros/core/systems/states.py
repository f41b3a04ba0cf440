"""The seven states of a robot system: one table decides every transition.

`docs/system-states.md` shows the diagram and the table. Setting the rate and the loop
changes no state and is allowed in every state, so these are no events.
"""

from __future__ import annotations

from enum import Enum

from mrlab_ros.core.base.diagnostic import Diagnostic
from mrlab_ros.core.base.state_machine import Table
from mrlab_ros.core.systems import diagnostics as say


class SystemState(Enum):
    """The values are those of mrlab_msgs/RobotSystem."""

    READY = 1
    STAGING = 2
    PLAYING = 3
    PAUSED = 4
    COLLISION_HALT = 5
    COMPLETE = 6
    STOPPING = 7


class SystemEvent(Enum):
    """Events of a system. The value is the verb in "cannot <value> in <STATE>"."""

    STAGE = "play"
    STAGED = "have all members in place"
    PAUSE = "pause"
    STOP = "stop"
    SEEK = "seek"
    STEP = "step"
    SET_MODE = "set the mode"
    COLLIDE = "collide"
    COLLIDE_ALONE = "halt one member alone"
    CLEAR = "be clear again"
    LOSE = "lose a member"
    ABORT = "give up"
    FINISH = "finish"
    REPEAT = "start over"
    REARM = "be ready again"
    STRAND = "miss an answer"
    REST = "have all members at rest"
    RETURN = "come back"
    RETURN_HALTED = "come back in a halt"


S, E = SystemState, SystemEvent
TABLE: Table[SystemState, SystemEvent] = Table(
    initial=S.READY,
    transitions={
        (S.READY, E.STAGE): S.STAGING,
        (S.READY, E.STOP): S.READY,
        (S.READY, E.SEEK): S.PAUSED,
        (S.READY, E.STEP): S.PAUSED,
        (S.READY, E.SET_MODE): S.READY,
        (S.READY, E.ABORT): S.READY,
        (S.STAGING, E.STAGED): S.PLAYING,
        (S.STAGING, E.PAUSE): S.PAUSED,
        (S.STAGING, E.STOP): S.READY,
        (S.STAGING, E.COLLIDE): S.COLLISION_HALT,
        # A staging waits for all members, so one that halts halts it whatever the policy.
        (S.STAGING, E.COLLIDE_ALONE): S.COLLISION_HALT,
        (S.STAGING, E.LOSE): S.PAUSED,
        (S.STAGING, E.ABORT): S.READY,
        (S.PLAYING, E.PAUSE): S.PAUSED,
        (S.PLAYING, E.STOP): S.READY,
        (S.PLAYING, E.SEEK): S.PLAYING,
        (S.PLAYING, E.COLLIDE): S.COLLISION_HALT,
        (S.PLAYING, E.COLLIDE_ALONE): S.PLAYING,
        (S.PLAYING, E.LOSE): S.PAUSED,
        (S.PLAYING, E.ABORT): S.READY,
        (S.PLAYING, E.FINISH): S.COMPLETE,
        (S.PAUSED, E.STAGE): S.STAGING,
        (S.PAUSED, E.PAUSE): S.PAUSED,
        (S.PAUSED, E.STOP): S.READY,
        (S.PAUSED, E.SEEK): S.PAUSED,
        (S.PAUSED, E.STEP): S.PAUSED,
        (S.PAUSED, E.LOSE): S.PAUSED,
        (S.PAUSED, E.ABORT): S.READY,
        (S.COLLISION_HALT, E.STOP): S.COLLISION_HALT,
        (S.COLLISION_HALT, E.SEEK): S.COLLISION_HALT,
        (S.COLLISION_HALT, E.STEP): S.COLLISION_HALT,
        (S.COLLISION_HALT, E.CLEAR): S.PAUSED,
        (S.COLLISION_HALT, E.LOSE): S.COLLISION_HALT,
        (S.COLLISION_HALT, E.ABORT): S.READY,
        (S.COMPLETE, E.REPEAT): S.STAGING,
        (S.COMPLETE, E.REARM): S.READY,
        (S.COMPLETE, E.LOSE): S.READY,
        (S.COMPLETE, E.ABORT): S.READY,
        # A member that was not reached may still move.
        (S.READY, E.STRAND): S.STOPPING,
        (S.STOPPING, E.STOP): S.STOPPING,
        (S.STOPPING, E.REST): S.READY,
        # After a restart of the coordinator, or of a playback.
        (S.READY, E.RETURN): S.PAUSED,
        (S.READY, E.RETURN_HALTED): S.COLLISION_HALT,
        (S.PAUSED, E.RETURN_HALTED): S.COLLISION_HALT,
    },
    # Reports of members in a state that does not wait for them.
    ignored={
        E.STAGED: (S.READY, S.PLAYING, S.PAUSED, S.COLLISION_HALT, S.COMPLETE, S.STOPPING),
        E.COLLIDE: (S.READY, S.PAUSED, S.COLLISION_HALT, S.COMPLETE, S.STOPPING),
        E.COLLIDE_ALONE: (S.READY, S.PAUSED, S.COLLISION_HALT, S.COMPLETE, S.STOPPING),
        E.CLEAR: (S.READY, S.STAGING, S.PLAYING, S.PAUSED, S.COMPLETE, S.STOPPING),
        E.LOSE: (S.READY, S.STOPPING),
        E.REST: (S.READY, S.STAGING, S.PLAYING, S.PAUSED, S.COLLISION_HALT, S.COMPLETE),
    },
    commands=(E.STAGE, E.PAUSE, E.STOP, E.SEEK, E.STEP, E.SET_MODE),
)
# The states in which members move, or may, and time makes something due.
ACTIVE = (S.STAGING, S.PLAYING, S.STOPPING)
del S, E


def reason(state: SystemState, event: SystemEvent) -> Diagnostic | str:
    """Return what a refused command needs first, for the error; may be empty."""
    if state is SystemState.STOPPING:
        return say.REACH_MEMBERS_FIRST()
    if event is SystemEvent.STEP and state in ACTIVE:
        return say.PAUSE_FIRST()
    halted = state is SystemState.COLLISION_HALT
    if halted and event in (SystemEvent.STAGE, SystemEvent.PAUSE):
        return say.STOP_AND_CLEAR_FIRST()
    if event is SystemEvent.SET_MODE:
        return say.CLEAR_AND_STOP_FIRST() if halted else say.STOP_FIRST()
    return ""


class Policy(Enum):
    """Which members a collision of one member halts."""

    HALT_ALL = 0
    HALT_MEMBER = 1


COLLISIONS = {
    Policy.HALT_ALL: SystemEvent.COLLIDE,
    Policy.HALT_MEMBER: SystemEvent.COLLIDE_ALONE,
}
