"""The static surfaces of a room, as a headset detects them, made into bodies."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.base.geometry import Array, Pose
from mrlab_ros.core.physics.diagnostics import (
    BAD_SOURCE,
    SURFACE_BEYOND,
    SURFACE_IS_LINE,
    SURFACE_NO_VERTEX,
    SURFACE_OUTLINE,
    SURFACE_TOO_FINE,
    SURFACES_OF_ONE_NAME,
)
from mrlab_ros.core.physics.engine import Body, Part, Shape

# A detected plane gets this thickness behind it, m: a headset sees no back side.
THICKNESS = 0.02
FLOOR_SIZE = 200.0  # m
MAX_OUTLINE = 1000
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


def body(surface: Surface, max_triangles: int) -> Body:
    """Return the surface as a static body; raise BadInput where it is none.

    A plane becomes a slab behind its front: the convex hull of its outline.
    """
    name, vertices, triangles = surface.name, surface.vertices, surface.triangles
    if not np.isfinite(vertices).all() or (len(vertices) and np.abs(vertices).max() > 1000):
        raise BadInput(SURFACE_BEYOND(surface=name))
    if len(triangles):
        if len(triangles) > max_triangles:
            raise BadInput(
                SURFACE_TOO_FINE(surface=name, count=len(triangles), most=max_triangles)
            )
        if triangles.min() < 0 or triangles.max() >= len(vertices):
            vertex = int(triangles.max() if triangles.min() >= 0 else triangles.min())
            raise BadInput(SURFACE_NO_VERTEX(surface=name, vertex=vertex, count=len(vertices)))
        # Unused vertices would enlarge the bounding box.
        named, places = np.unique(triangles, return_inverse=True)
        part = Part(
            Shape.MESH,
            vertices=vertices[named],
            triangles=places.reshape(-1, 3).astype(np.int32),
        )
    elif surface.endless:
        part = Part(Shape.BOX, (FLOOR_SIZE, FLOOR_SIZE, 1.0), Pose((0.0, 0.0, -0.5)))
    else:
        if not 3 <= len(vertices) <= MAX_OUTLINE:
            raise BadInput(SURFACE_OUTLINE(surface=name, count=len(vertices), most=MAX_OUTLINE))
        across = vertices - vertices.mean(axis=0)
        if np.linalg.svd(across, compute_uv=False)[1] < 1e-4:
            raise BadInput(SURFACE_IS_LINE(surface=name))
        behind = vertices - [0.0, 0.0, THICKNESS]
        part = Part(Shape.HULL, vertices=np.concatenate([vertices, behind]))
    return Body((part,), 0.0)
