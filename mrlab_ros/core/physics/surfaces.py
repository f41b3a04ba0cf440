"""The static surfaces of a room, as a headset detects them, made into bodies."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from mrlab_ros.core.errors import BadInput
from mrlab_ros.core.geometry import Array, Pose
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
            f"the source {source[:80]!r} has {len(source)} characters; expected at most "
            f"{LONGEST_SOURCE} that can be printed, such as an id of the headset"
        )
    if len({surface.name for surface in new}) != len(new):
        raise BadInput("two surfaces have the same name; give each its own")
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
        raise BadInput(f"surface '{name}' has a vertex that is not finite or beyond 1 km")
    if len(triangles):
        if len(triangles) > max_triangles:
            raise BadInput(
                f"surface '{name}' has {len(triangles)} triangles; expected {max_triangles} at "
                "most: simplify the mesh, or send the planes of the room instead"
            )
        if triangles.min() < 0 or triangles.max() >= len(vertices):
            raise BadInput(
                f"surface '{name}' names vertex {triangles.max()} of {len(vertices)}; expected "
                "indices of its own vertices"
            )
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
            raise BadInput(
                f"surface '{name}' has an outline of {len(vertices)} points; expected 3 to "
                f"{MAX_OUTLINE}, or triangles"
            )
        across = vertices - vertices.mean(axis=0)
        if np.linalg.svd(across, compute_uv=False)[1] < 1e-4:
            raise BadInput(f"the outline of surface '{name}' is a line; expected an area")
        behind = vertices - [0.0, 0.0, THICKNESS]
        part = Part(Shape.HULL, vertices=np.concatenate([vertices, behind]))
    return Body((part,), 0.0)
