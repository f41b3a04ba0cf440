"""How a run of one robot goes, read off the states that follow `play`."""

from __future__ import annotations

import re
from collections.abc import Callable, Collection
from typing import Any

from mrlab_msgs import msg

from mrlab_ros.core.errors import LabError, Misuse

# What a halt says of its contact.
CONTACT = re.compile(r"touches (\S+)")


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
            raise Misuse(halted(self._robot, state.message, self._objects()))
        elif state.state == kind.IDLE and self.moving:
            raise LabError(
                f"the playback of {self._robot} was restarted, or stood aside for a replay; where "
                f"it stands: mrlab status; play on from there with: mrlab resume {self._robot}"
            )
        elif state.state == kind.READY and self.moving and not self.complete:
            raise Misuse(
                f"{self._robot} ended before its last frame: {state.message or 'stopped'}"
            )


def halted(robot: str, why: str, objects: Collection[str] = ()) -> str:
    """Return what is said of a robot that a collision halted, with the commands that end it.

    objects: the names of those in the scene, which can be removed.
    """
    contact = CONTACT.search(why)
    if why and contact is None:
        # It was taken elsewhere already; what it touches there is not said.
        return (
            f"{robot} is still in its collision halt ({why}), which ends once its arm has been "
            "clear for a moment. Where the arm touches something there too, take that away: "
            f"mrlab objects list, or place the robot elsewhere: mrlab place {robot} --at X,Y. "
            f"Then play on with: mrlab resume {robot}"
        )
    other = contact.group(1) if contact else ""
    away = f"place the robot elsewhere: mrlab place {robot} --at X,Y"
    if other in objects:
        away = f"take {other} away: mrlab objects remove {other}, or {away}"
    return (
        f"{robot} was halted by a collision: {why or 'its arm touches something'}. Its arm goes "
        f"back to the first frame with: mrlab stop {robot}. So that it does not happen again, "
        f"{away}. Then play on with: mrlab resume {robot}"
    )
