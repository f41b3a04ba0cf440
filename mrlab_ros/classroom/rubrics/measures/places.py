"""Measures of what lies on or in what at the end."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import product
from typing import Any

import numpy as np

from mrlab_ros.classroom.rubrics.diagnostics import (
    LIES_ELSEWHERE,
    LIES_IN_PLACE,
    LIES_ON_ITSELF,
    NO_OBJECT_CHECKED,
)
from mrlab_ros.classroom.rubrics.measures.contacts import recording
from mrlab_ros.classroom.rubrics.measures.grasps import at_the_end, let_go
from mrlab_ros.classroom.rubrics.rubric import Ground, Measure, Outcome
from mrlab_ros.classroom.rubrics.sentences import Form, Gaps, Given
from mrlab_ros.core.base.diagnostic import Diagnostic
from mrlab_ros.core.base.geometry import Array, Pose, add, inverse, rotate
from mrlab_ros.core.checking.check_record import Checked
from mrlab_ros.core.physics.catalogue import ObjectType
from mrlab_ros.core.scene.surfaces import FLOOR

# An object this near to the top of another, m, lies on it.
ON = 0.015


def _corners(kind: ObjectType, values: Sequence[float]) -> Array:
    """Return the corners, (8, 3) m in world, of an object's bounding box at x, y, z, qx .. qw."""
    pose = _pose(values)
    xs, ys, zs = zip(kind.low, kind.high, strict=True)
    return np.array([add(pose.position, rotate(pose.orientation, c)) for c in product(xs, ys, zs)])


def _pose(values: Sequence[float]) -> Pose:
    x, y, z, qx, qy, qz, qw = values
    return Pose((x, y, z), (qx, qy, qz, qw))


@dataclass(frozen=True)
class Places:
    """An object that was held lies at rest on `place`, or in it, at the end."""

    thing: str
    place: str
    inside: bool

    def assess(self, checked: Checked, reference: Checked | None) -> Outcome:
        found = let_go(checked, self.thing)
        if isinstance(found, Outcome):
            return found
        time, rests = found
        kind = checked.objects.get(self.thing)
        if kind is None:
            return Outcome(0.0, NO_OBJECT_CHECKED(object=self.thing), time)
        of: dict[str, Any] = {"object": self.thing, "other": self.place, "side": self._side}
        corners = _corners(kind, rests.values)
        if self._lies(checked, np.array(rests.values[:3]), corners):
            return Outcome(1.0, LIES_IN_PLACE(**of))
        return Outcome(0.0, LIES_ELSEWHERE(**of, point=rests.values[:3]), time)

    @property
    def _side(self) -> str:
        return "in" if self.inside else "on"

    def _lies(self, checked: Checked, centre: Array, corners: Array) -> bool:
        low = float(corners[:, 2].min())
        kind = checked.objects.get(self.place)
        there = at_the_end(recording(checked), self.place)
        if kind is not None and there is not None:
            if self.inside:
                back = inverse(_pose(there.values))
                x, y, z = (float(v) for v in centre)
                local = add(back.position, rotate(back.orientation, (x, y, z)))
                return all(a <= v <= b for a, v, b in zip(kind.low, local, kind.high, strict=True))
            box = _corners(kind, there.values)
            return abs(low - float(box[:, 2].max())) <= ON and _above(centre, box)
        for surface in checked.scene.surfaces:
            if surface.name != self.place:
                continue
            if surface.endless:
                return abs(low - surface.pose.position[2]) <= ON
            box = np.array(
                [
                    add(
                        surface.pose.position, rotate(surface.pose.orientation, (v[0], v[1], v[2]))
                    )
                    for v in surface.vertices.tolist()
                ]
            )
            return abs(low - float(box[:, 2].max())) <= ON and _above(centre, box)
        return self.place == FLOOR and abs(low) <= ON

    def flaws(self, ground: Ground) -> Iterator[Diagnostic]:
        yield from ground.graspable_flaws(self.thing)
        if self.inside:
            yield from ground.object_flaws(self.place)
        else:
            yield from ground.thing_flaws(self.place)
        if self.place == self.thing:
            yield LIES_ON_ITSELF(object=self.thing, side=self._side)


def _above(centre: Array, box: Array) -> bool:
    return bool(
        (centre[:2] >= box[:, :2].min(axis=0)).all()
        and (centre[:2] <= box[:, :2].max(axis=0)).all()
    )


def _places(gaps: Gaps, given: Given, *, inside: bool) -> Measure:
    return Places(gaps["object"], gaps["thing"], inside)


FAMILY = "places"
FORMS = (
    Form(
        "places OBJECT on [the] THING", lambda gaps, given: _places(gaps, given, inside=False),
        "Let go, at rest at the end, on top of an object, a surface or the floor.",
    ),
    Form(
        "places OBJECT in [the] THING", lambda gaps, given: _places(gaps, given, inside=True),
        "Let go, at rest at the end, its centre inside the bounding box of another object.",
    ),
)  # fmt: skip
