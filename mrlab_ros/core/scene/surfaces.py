"""The static surfaces of a room, as headsets detect them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.base.geometry import Array, Pose
from mrlab_ros.core.scene.diagnostics import BAD_SOURCE, SURFACES_OF_ONE_NAME

FLOOR = "floor"
LONGEST_SOURCE = 64


@dataclass(frozen=True, eq=False)
class Surface:
    """A plane with outline `vertices` (V, 3) m in its own frame, z its normal; or, with
    `triangles` (T, 3), a mesh. Without vertices the plane has no end."""

    name: str
    label: str
    pose: Pose
    vertices: Array
    triangles: NDArray[np.int32]
    source: str = ""  # who measured it; empty: the lab's own

    @property
    def endless(self) -> bool:
        return len(self.vertices) == 0


def floor() -> Surface:
    """Return the endless floor of a lab without detected surfaces."""
    return Surface(FLOOR, FLOOR, Pose(), np.zeros((0, 3)), np.zeros((0, 3), np.int32))


def check_names(surfaces: Sequence[Surface]) -> None:
    """Raise BadInput where two surfaces have the same name."""
    names = set[str]()
    for surface in surfaces:
        if surface.name in names:
            raise BadInput(SURFACES_OF_ONE_NAME(name=surface.name))
        names.add(surface.name)


def of_source(
    source: str, new: Sequence[Surface], before: Mapping[str, Surface]
) -> tuple[Surface, ...]:
    """Return the surfaces of a room once `new` replaces those of one source.

    Those of all others stay. A name that is taken gets a number behind it, so that two headsets
    may each call a table table_1. There is one endless floor, and it is the lab's own. Raises
    BadInput for two new ones of one name.
    """
    if len(source) > LONGEST_SOURCE or not source.isprintable():
        raise BadInput(
            BAD_SOURCE(source=repr(source[:80]), count=len(source), most=LONGEST_SOURCE)
        )
    check_names(new)
    room = {name: surface for name, surface in before.items() if surface.source != source}
    for surface in new:
        if surface.endless and surface.label == FLOOR:
            if not any(each.endless and each.label == FLOOR for each in room.values()):
                room.setdefault(surface.name, replace(surface, source=""))
            continue
        name, number = surface.name, 2
        while name in room:
            name, number = f"{surface.name}_{number}", number + 1
        room[name] = replace(surface, name=name, source=source)
    return tuple(room.values())
