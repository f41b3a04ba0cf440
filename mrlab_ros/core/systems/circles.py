"""Waits that can never be met, because members wait for each other."""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from graphlib import CycleError, TopologicalSorter
from typing import Protocol

from mrlab_ros.core.base.diagnostic import Diagnostic
from mrlab_ros.core.systems.diagnostics import ENDS_FIRST, WAITS_AT
from mrlab_ros.core.systems.waits import AfterFrame, Wait

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
            ENDS_FIRST(robot=robot) if wait is None else WAITS_AT(robot=robot, wait=wait.text)
            for robot, wait in circle
        ]
    return []
