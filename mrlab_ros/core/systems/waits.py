"""The conditions for which a member of a robot system waits before it plays past a frame.

A wait is written as `frame 0: after kr6_1.frame 120`, `frame 200: object cube_1 held by ur5e_1` or
`frame 310: object cube_1 free`.
"""

from __future__ import annotations

import itertools
import re
from collections.abc import Sequence
from dataclasses import dataclass
from graphlib import CycleError, TopologicalSorter
from typing import Protocol

from mrlab_ros.core.base.diagnostic import Diagnostic
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.systems import diagnostics as say

GRAMMAR = re.compile(
    r"frame (?P<frame>\d+): (?:"
    r"after (?P<other>\w+)\.frame (?P<number>\d+)"
    r"|object (?P<held>\w+) held by (?P<holder>\w+)"
    r"|object (?P<free>\w+) free"
    r")"
)


@dataclass(frozen=True)
class AfterFrame:
    """True once `robot`, a member of the same system, has reached its source frame."""

    robot: str
    frame: int


@dataclass(frozen=True)
class Held:
    """True while `robot` holds `object`; with robot None: while no robot holds it."""

    object: str
    robot: str | None


@dataclass(frozen=True)
class Wait:
    """The condition must have been true once before the member plays past `frame`."""

    frame: int
    condition: AfterFrame | Held
    text: str


def parse(text: str) -> Wait:
    """Parse the text of a wait; raise BadInput where it does not follow the grammar."""
    match = GRAMMAR.fullmatch(" ".join(text.split()))
    if match is None:
        raise BadInput(say.BAD_WAIT(wait=text))
    condition: AfterFrame | Held
    if match["other"]:
        condition = AfterFrame(match["other"], int(match["number"]))
    elif match["held"]:
        condition = Held(match["held"], match["holder"])
    else:
        condition = Held(match["free"], None)
    return Wait(int(match["frame"]), condition, " ".join(text.split()))


# A wait of a member, or with None the member's end.
Step = tuple[str, Wait | None]


class Waiting(Protocol):
    """A member of a system: its name and what it waits for."""

    @property
    def robot(self) -> str: ...

    @property
    def waits(self) -> tuple[Wait, ...]: ...


def waiting_circle(members: Sequence[Waiting], *, sequential: bool) -> list[Diagnostic]:
    """Return the steps of a circle in which each waits for the next one; empty: there is none.

    sequential: a member begins when the one before it has ended. Waits for objects depend on
    physics and are left out.
    """
    by_robot = {member.robot: member for member in members}
    before = {after.robot: first.robot for first, after in itertools.pairwise(members)}
    needs: dict[Step, set[Step]] = {}
    for member in members:
        end: set[Step] = {(member.robot, wait) for wait in member.waits}
        if sequential and member.robot in before:
            end.add((before[member.robot], None))
        needs[member.robot, None] = end
        for wait in member.waits:
            condition = wait.condition
            # A member stands at its first frame from the beginning.
            if not isinstance(condition, AfterFrame) or condition.frame == 0:
                continue
            other = by_robot.get(condition.robot)
            if other is None:
                continue
            # To reach a frame, a member must have passed its waits before that frame.
            frame = condition.frame
            passed: set[Step] = {(other.robot, w) for w in other.waits if w.frame < frame}
            if sequential and other.robot in before:
                passed.add((before[other.robot], None))
            needs[member.robot, wait] = passed
    try:
        TopologicalSorter(needs).prepare()
    except CycleError as error:
        # The sorter names a step after the one that needs it, and the first one twice.
        circle: list[Step] = error.args[1][:0:-1]
        return [
            say.ENDS_FIRST(robot=robot)
            if wait is None
            else say.WAITS_AT(robot=robot, wait=wait.text)
            for robot, wait in circle
        ]
    return []
