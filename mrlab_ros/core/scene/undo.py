"""Destructive acts that can be undone for a while, whoever did them and by which door."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace
from secrets import token_hex

from mrlab_ros.core.base.diagnostic import Diagnostic
from mrlab_ros.core.base.errors import Misuse
from mrlab_ros.core.scene.diagnostics import NO_ACT_TO_UNDO, UNDONE
from mrlab_ros.core.scene.document import ObjectEntry, SceneDocument, SystemEntry
from mrlab_ros.core.scene.restore import AddObjects, Grip, Present, Step, plan_return, plan_scene

# An act can be undone for this long, s.
UNDO_S = 10.0
# More acts than this are not kept.
MOST = 50


@dataclass(frozen=True)
class Act:
    """said: what was done. lost: what it removed. whole: lost is all that there was, and the act
    put something else in its place. until: s, of the caller's clock. back: names that came back
    in a try to undo it that failed."""

    id: str
    said: Diagnostic
    lost: SceneDocument
    whole: bool
    until: float
    back: frozenset[str] = frozenset()


class Acts:
    """The acts of the last UNDO_S, the newest last. now: s, of any clock that never goes back.

    What was removed from a scene that is gone itself is out of reach until that scene is back.
    """

    def __init__(self) -> None:
        self._acts: list[Act] = []

    def note(
        self, said: Diagnostic, lost: SceneDocument, now: float, *, whole: bool = False
    ) -> None:
        """Keep what an act removed; nothing is kept where that is nothing."""
        if lost != SceneDocument():
            self._acts.append(Act(token_hex(6), said, lost, whole, now + UNDO_S))
            del self._acts[:-MOST]

    def newest(self, now: float) -> Act | None:
        """Return the newest act that can be undone; None: there is none."""
        self._acts = [act for act in self._acts if act.until > now]
        return self._acts[-1] if self._acts else None

    def find(self, id: str, now: float) -> Act:
        """Return an act; id: empty for the newest. Raises Misuse where none is within reach."""
        newest = self.newest(now)
        for act in reversed(self._acts):
            if act.id == id or (not id and act is newest):
                return act
            if act.whole:
                break
        raise Misuse(NO_ACT_TO_UNDO(limit=UNDO_S))

    def undone(self, act: Act, now: float, replaced: SceneDocument | None = None) -> None:
        """Forget an act; those that come next can be undone as long as a new one.

        replaced: the whole scene that went as the act was undone. It can be had back, after the
        acts of before: who undoes again and again comes to all scenes there were.
        """
        self._acts = [
            replace(each, until=max(each.until, now + UNDO_S))
            for each in self._acts
            if each.id != act.id
        ]
        self._keep(act, replaced, now)

    def failed(
        self, act: Act, back: Iterable[str], now: float, replaced: SceneDocument | None = None
    ) -> None:
        """Note what came back of an act, which can be tried again; replaced: as for undone()."""
        tried = replace(act, back=act.back.union(back), until=max(act.until, now + UNDO_S))
        self._acts = [tried if each.id == act.id else each for each in self._acts]
        self._keep(act, replaced, now)

    def _keep(self, act: Act, replaced: SceneDocument | None, now: float) -> None:
        if replaced is not None:
            again = Act(token_hex(6), opposite(act.said), replaced, True, now + UNDO_S)
            self._acts.insert(0, again)


def opposite(said: Diagnostic, missing: Diagnostic | None = None) -> Diagnostic:
    """Return what to say where an act is undone; one that undid another does that one again.

    missing: what did not come back.
    """
    act = said.values["act"] if said.code == UNDONE.code else None
    return act if isinstance(act, Diagnostic) else UNDONE(act=said, missing=missing)


def removed_with(
    name: str, scene: SceneDocument, held: Iterable[ObjectEntry] = ()
) -> SceneDocument:
    """Return a robot of the scene, the system that ends as its member goes, what it let go of.

    held: what robots hold.
    """
    return SceneDocument(
        robots=tuple(robot for robot in scene.robots if robot.name == name),
        objects=tuple(thing for thing in held if thing.held_by == name),
        systems=tuple(s for s in scene.systems if name in members(s)),
    )


def members(system: SystemEntry) -> Iterable[str]:
    """Return the robots of a system."""
    return [member.robot for member in system.members]


def plan_undo(act: Act, present: Present) -> tuple[tuple[Step, ...], tuple[str, ...]]:
    """Return the steps that bring back what an act removed, and the names of what they do not.

    Names that were given to something else meanwhile stay with it.
    """
    lost = act.lost
    if act.whole:
        return plan_scene(lost, present), ()

    def free(name: str, taken: Iterable[str]) -> bool:
        return name in act.back or name not in taken

    robots = tuple(r for r in lost.robots if free(r.name, present.robots))
    there = present.robots | {robot.name for robot in robots}
    systems = tuple(
        s for s in lost.systems if there.issuperset(members(s)) and free(s.name, present.systems)
    )
    steps = plan_return(replace(lost, robots=robots, systems=systems), present)
    # What a robot let go of lies in the scene; all else was taken out of it.
    names, ours = ({robot.name for robot in each} for each in (lost.robots, robots))
    held = tuple(thing for thing in lost.objects if thing.held_by in ours)
    # A robot that is away holds nothing, even where physics has not noticed yet.
    holder = {
        name: "" if robot in names - present.robots else robot
        for name, robot in present.objects.items()
    }
    fallen = tuple(thing for thing in held if holder.get(thing.name) == "")
    out = tuple(
        thing if thing.held_by in there else replace(thing, held_by="")
        for thing in lost.objects
        if thing.held_by not in names and present.physics and free(thing.name, present.objects)
    )
    back = ours | {s.name for s in systems}
    back |= {thing.name for thing in (*fallen, *out)}
    back |= {thing.name for thing in held if holder.get(thing.name) == thing.held_by}
    wanted = [r.name for r in lost.robots] + [thing.name for thing in lost.objects]
    wanted += [s.name for s in lost.systems]
    new = tuple(thing for thing in out if thing.name not in present.objects)
    if new:
        steps = (AddObjects(new), *steps)
    if fallen:
        steps = (*steps, Grip(fallen))
    return steps, tuple(name for name in wanted if name not in back)
