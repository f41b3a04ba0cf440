"""How a run of one robot goes, read off the states that follow `play`."""

from __future__ import annotations

from collections.abc import Callable, Collection
from typing import Any

from mrlab_msgs import msg

from mrlab_ros.client import diagnostics as say
from mrlab_ros.core.base.diagnostic import Diagnostic, Fix, heard
from mrlab_ros.core.base.errors import LabError, Misuse
from mrlab_ros.core.playback.diagnostics import HALTED_BY_CONTACT


class Course:
    """Reads a run off its states: how it stands, and how it ended."""

    def __init__(self, robot: str, objects: Callable[[], Collection[str]] = tuple) -> None:
        """objects: returns the names of the objects of the scene."""
        self._robot = robot
        self._objects = objects
        self.moving = False
        self.complete = False

    def take(self, state: Any) -> None:
        """Take the next state; raise LabError where it says that the run will not complete."""
        kind = msg.PlaybackState
        if state.state in (kind.ADJUSTING, kind.PLAYING):
            self.moving = True
        elif state.state == kind.COMPLETE:
            self.complete = True
        elif state.state == kind.COLLISION_HALT:
            raise Misuse(halted(self._robot, heard(state), self._objects()))
        elif state.state == kind.IDLE and self.moving:
            raise LabError(say.PLAYBACK_GONE(robot=self._robot))
        elif state.state == kind.READY and self.moving and not self.complete:
            why = heard(state) if state.message else None
            raise Misuse(say.ENDED_EARLY(robot=self._robot, why=why))


def halted(robot: str, why: Diagnostic, objects: Collection[str] = ()) -> Diagnostic:
    """Return what is said of a robot that a collision halted, with the commands that end it.

    why: what its state says. objects: the names of those in the scene, which can be removed.
    """
    place, resume = Fix(command=f"place {robot} --at X,Y"), Fix(command=f"resume {robot}")
    reason = why if why.message else None
    if why.message and why.code != HALTED_BY_CONTACT.code:
        # It was taken elsewhere already; what it touches there is not said.
        fixes = (Fix(command="objects list"), place, resume)
        return say.STILL_HALTED(robot=robot, why=reason, fixes=fixes)
    other = why.values.get("other", "")
    remove = (Fix(command=f"objects remove {other}"),) if other in objects else ()
    fixes = (Fix(command=f"stop {robot}"), *remove, place, resume)
    return say.HALTED(robot=robot, why=reason, fixes=fixes)
