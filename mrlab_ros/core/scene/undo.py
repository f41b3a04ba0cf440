"""Destructive acts that can be undone for a while, whoever did them and by which door."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace

from mrlab_ros.core.base.diagnostic import Diagnostic
from mrlab_ros.core.base.errors import Misuse
from mrlab_ros.core.scene.diagnostics import NO_ACT_TO_UNDO
from mrlab_ros.core.scene.document import SceneDocument, SystemEntry
from mrlab_ros.core.scene.restore import AddObjects, Present, Step, plan_return, plan_scene

# An act can be undone for this long, s.
UNDO_S = 10.0


@dataclass(frozen=True)
class Act:
    """said: what was done. lost: what it removed. whole: lost is all that there was, and the act
    put something else in its place. until: s, of the caller's clock."""

    id: str
    said: Diagnostic
    lost: SceneDocument
    whole: bool
    until: float


class Acts:
    """The acts of the last UNDO_S, the newest last. now: s, of any clock that never goes back."""

    def __init__(self) -> None:
        self._acts: list[Act] = []
        self._count = 0

    def note(
        self, said: Diagnostic, lost: SceneDocument, now: float, *, whole: bool = False
    ) -> None:
        """Keep what an act removed; nothing is kept where that is nothing."""
        if whole:
            # Earlier acts removed parts of a scene that is gone itself.
            self._acts.clear()
        if lost == SceneDocument():
            return
        self._count += 1
        self._acts.append(Act(str(self._count), said, lost, whole, now + UNDO_S))

    def newest(self, now: float) -> Act | None:
        """Return the newest act that can be undone; None: there is none."""
        self._acts = [act for act in self._acts if act.until > now]
        return self._acts[-1] if self._acts else None

    def take(self, id: str, now: float) -> Act:
        """Return an act, which can be undone no more; id: empty for the newest.

        Raises Misuse where there is none.
        """
        newest = self.newest(now)
        found = [act for act in self._acts if act.id == id] if id else [newest]
        if newest is None or not found or found[0] is None:
            raise Misuse(NO_ACT_TO_UNDO(limit=UNDO_S))
        self._acts.remove(found[0])
        return found[0]

    def give_back(self, act: Act) -> None:
        """Keep an act that was taken and could not be undone, as long as it would have been."""
        self._acts = sorted([*self._acts, act], key=lambda each: each.until)


def removed_with(name: str, scene: SceneDocument) -> SceneDocument:
    """Return a robot of the scene, and the system that ends as its member goes."""
    return SceneDocument(
        robots=tuple(robot for robot in scene.robots if robot.name == name),
        systems=tuple(s for s in scene.systems if name in members(s)),
    )


def members(system: SystemEntry) -> Iterable[str]:
    """Return the robots of a system."""
    return [member.robot for member in system.members]


def plan_undo(act: Act, present: Present) -> tuple[Step, ...]:
    """Return the steps that bring back what an act removed.

    Names that were given to something else meanwhile stay with it.
    """
    if act.whole:
        return plan_scene(act.lost, present)
    robots = tuple(r for r in act.lost.robots if r.name not in present.robots)
    there = present.robots | {robot.name for robot in robots}
    systems = tuple(s for s in act.lost.systems if there.issuperset(members(s)))
    steps = plan_return(replace(act.lost, robots=robots, systems=systems), present)
    if act.lost.objects and present.physics:
        objects = tuple(
            thing if thing.held_by in there else replace(thing, held_by="")
            for thing in act.lost.objects
        )
        steps = (AddObjects(objects), *steps)
    return steps
