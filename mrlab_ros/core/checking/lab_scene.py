"""The scene of a running lab as a check takes it: what stands where, and what has moved since."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field

from mrlab_ros.core.base.diagnostic import Diagnostic
from mrlab_ros.core.base.geometry import Pose
from mrlab_ros.core.checking.diagnostics import (
    APPEARED,
    DISAPPEARED,
    HELD_BY_ANOTHER,
    IN_LAB,
    MOVED,
    OTHER_MODEL,
    STANDS_ELSEWHERE,
    SURFACES_CHANGED,
    WAS_LET_GO,
)
from mrlab_ros.core.scene.document import SceneDocument

# A smaller motion counts as none: m, and rad of an orientation or a joint.
SAME_PLACE, SAME_ANGLE = 0.002, 0.02


@dataclass(frozen=True, eq=False)
class LabScene:
    """A lab at one instant.

    stands: (J,) rad of each robot whose joint states are known, in its joints' order. in_tool:
    T_tool0_object of what a robot holds, by object.
    """

    document: SceneDocument
    stands: Mapping[str, tuple[float, ...]] = field(default_factory=dict)
    in_tool: Mapping[str, Pose] = field(default_factory=dict)

    @property
    def shown(self) -> Diagnostic:
        """Return what a motion goes through."""
        return IN_LAB(objects=len(self.document.objects), robots=len(self.document.robots))


def changed(before: LabScene, now: LabScene, robot: str) -> Diagnostic | None:
    """Return what differs for a motion of `robot`; None: nothing.

    Where the robot itself stands does not count: the motion begins at its first frame.
    """
    was, now_there = before.document, now.document
    robots = {r.name: r for r in was.robots}, {r.name: r for r in now_there.robots}
    objects = {o.name: o for o in was.objects}, {o.name: o for o in now_there.objects}
    for old, new in (robots, objects):
        for name in sorted(old.keys() ^ new.keys()):
            return (APPEARED if name in new else DISAPPEARED)(name=name)
    for name, one in robots[0].items():
        other = robots[1][name]
        if (one.model, one.end_effector) != (other.model, other.end_effector):
            return OTHER_MODEL(name=name)
        if not same_place(one.pose, other.pose):
            return MOVED(name=name)
        if name != robot and _moved(before.stands.get(name), now.stands.get(name)):
            return STANDS_ELSEWHERE(name=name)
    for name, thing in objects[0].items():
        found = objects[1][name]
        if (thing.type, thing.held_by) != (found.type, found.held_by):
            return (HELD_BY_ANOTHER if found.held_by else WAS_LET_GO)(name=name)
        # what is held moves with its robot
        if not thing.held_by and not same_place(thing.pose, found.pose):
            return MOVED(name=name)
    surfaces = [[(s.name, s.label, len(s.vertices)) for s in d.surfaces] for d in (was, now_there)]
    if surfaces[0] != surfaces[1] or any(
        not same_place(a.pose, b.pose)
        for a, b in zip(was.surfaces, now_there.surfaces, strict=True)
    ):
        return SURFACES_CHANGED()
    return None


def same_place(a: Pose, b: Pose) -> bool:
    """Return whether two poses are one for a check."""
    if math.dist(a.position, b.position) > SAME_PLACE:
        return False
    along = abs(sum(x * y for x, y in zip(a.orientation, b.orientation, strict=True)))
    return 2.0 * math.acos(min(along, 1.0)) <= SAME_ANGLE


def _moved(before: tuple[float, ...] | None, now: tuple[float, ...] | None) -> bool:
    if before is None or now is None:
        return False
    return len(before) != len(now) or any(
        abs(a - b) > SAME_ANGLE for a, b in zip(before, now, strict=True)
    )
