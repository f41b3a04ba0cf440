"""The types of objects that a lab can spawn, read from config/objects.yaml and checked."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from mrlab_ros.core.base.checks import (
    FLAG,
    NAME,
    TEXT,
    Choice,
    Number,
    Numbers,
    Words,
    above,
    between,
    checked,
)
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.base.geometry import (
    Array,
    Pose,
    Vector,
    add,
    quaternion_from_rpy,
    rotate,
    subtract,
)
from mrlab_ros.core.base.names import close_to
from mrlab_ros.core.base.records import Record, every
from mrlab_ros.core.physics.diagnostics import (
    CATALOGUE,
    FIXED_WITH_MASS,
    MASS_OR_FIXED,
    NO_OBJECT_TYPE,
    OBJECT_ENTRY,
    OBJECT_ID,
    SHAPE_AND_PARTS,
)
from mrlab_ros.core.physics.engine import IDENTITY, Body, Part, Shape
from mrlab_ros.core.physics.inertia import mass_properties

SOLID = Choice({shape.value: shape for shape in (Shape.BOX, Shape.CYLINDER, Shape.SPHERE)})
PART_FIELDS = ("shape", "size", "at", "rpy_deg", "density")
FIELDS = ("shape", "size", "parts", "mass", "fixed", "color", "mesh", "friction", "restitution",
          "about")  # fmt: skip
SIZE_LIMITS = between(0.002, 5.0)
# How many numbers the size of a shape has.
SIZES = {
    Shape.BOX: Numbers(3, SIZE_LIMITS, "m: x, y, z"),
    Shape.CYLINDER: Numbers(2, SIZE_LIMITS, "m: radius, length"),
    Shape.SPHERE: Numbers(1, SIZE_LIMITS, "m: radius"),
}
POSITION = Numbers(3, between(-5.0, 5.0), "m")
ANGLES = Numbers(3, between(-360.0, 360.0), "degrees: roll, pitch, yaw")


class _Mass(Number):
    @property
    def expected(self) -> Words:
        return MASS_OR_FIXED(limits=self.limits.words)


MASS = _Mass(between(0.001, 500.0), "kg")
FRICTION = Number(between(0.0, 5.0))
RESTITUTION = Number(between(0.0, 1.0))
DENSITY = Number(above(0.0, 30_000.0))
COLOR = Numbers(4, between(0.0, 1.0), "red, green, blue, alpha")
# URI of the mesh that the lab draws of an object of several parts that has none; see drawing.glb.
DRAWN = "package://mrlab_ros/objects/{}.glb"


@dataclass(frozen=True, eq=False)
class Mesh:
    """vertices: (V, 3) m, in the object's frame; triangles: (T, 3) vertex indices."""

    vertices: Array
    triangles: NDArray[np.int32]


class Meshes(Protocol):
    """Finds and reads the meshes of a catalogue. All raise BadInput for an unknown URI."""

    def find(self, uri: str) -> object: ...

    def read(self, uri: str) -> Mesh: ...

    def hull(self, uri: str) -> Mesh:
        """Read the convex hull of a mesh; its triangles close around it."""
        ...


@dataclass(frozen=True, eq=False)
class ObjectType:
    """One entry of the catalogue.

    body: its parts in its own frame. low, high: corners of its bounding box there, m. color: red,
    green, blue, alpha, 0 to 1. mesh: URI for displays; empty: draw `solid`.
    """

    id: str
    body: Body
    low: Vector
    high: Vector
    color: tuple[float, float, float, float]
    mesh: str
    about: str

    @property
    def size(self) -> Vector:
        return subtract(self.high, self.low)

    @property
    def mass(self) -> float:
        return self.body.mass

    @property
    def solid(self) -> Part | None:
        """Return its shape where that is one box, cylinder or sphere at its origin."""
        return _solid(self.body.parts)


class Catalogue:
    """The object types by id."""

    def __init__(self, types: Mapping[str, ObjectType]) -> None:
        self._types = dict(types)

    @property
    def ids(self) -> tuple[str, ...]:
        return tuple(self._types)

    def get(self, type_id: str) -> ObjectType:
        """Return a type; raise BadInput that names the known ids."""
        try:
            return self._types[type_id]
        except KeyError:
            close = close_to(type_id, self._types)
            raise BadInput(
                NO_OBJECT_TYPE(type=type_id, known=[*self._types], close=close)
            ) from None


def parse(document: object, meshes: Meshes | None = None) -> Catalogue:
    """Read the catalogue from the content of config/objects.yaml.

    A mesh that collides is read; a mesh for displays alone must only exist. Without `meshes` no
    mesh is checked, and none can collide. Raises BadInput that names all mistakes.
    """
    place = CATALOGUE()
    entries = Record(document, place, ("objects",)).mapping("objects")
    types = every(lambda entry: _type(*entry, meshes), entries.items(), place)
    return Catalogue({kind.id: kind for kind in types})


def _type(name: object, value: object, meshes: Meshes | None) -> ObjectType:
    type_id = checked(OBJECT_ID(), name, NAME)
    entry = Record(value, OBJECT_ENTRY(object=type_id), FIELDS)
    fixed = entry.value("fixed", FLAG, False)
    if fixed and entry.value("mass", Number(), 0.0):
        raise entry.error(FIXED_WITH_MASS())
    mass = 0.0 if fixed else entry.required("mass", MASS)
    uri = entry.value("mesh", TEXT, "")
    described = entry.records("parts", PART_FIELDS, "part")
    if "shape" in entry and described:
        raise entry.error(SHAPE_AND_PARTS())
    if uri and meshes is not None and "shape" not in entry and not described:
        mesh = meshes.read(uri) if fixed else meshes.hull(uri)
        shape = Shape.MESH if fixed else Shape.HULL
        parts = [Part(shape, vertices=mesh.vertices, triangles=mesh.triangles)]
    else:
        if uri and meshes is not None:
            meshes.find(uri)
        parts = [_part(part) for part in described or [entry]]
    boxes = [_bounds(part) for part in parts]
    centre, inertia = mass_properties(parts, mass) if mass else ((0.0, 0.0, 0.0), None)
    red, green, blue, alpha = entry.value("color", COLOR, (0.7, 0.7, 0.7, 1.0))
    return ObjectType(
        id=type_id,
        body=Body(
            tuple(parts),
            mass,
            entry.value("friction", FRICTION, 0.6),
            entry.value("restitution", RESTITUTION, 0.1),
            centre,
            inertia,
        ),
        low=_corner(min, [b[0] for b in boxes]),
        high=_corner(max, [b[1] for b in boxes]),
        color=(red, green, blue, alpha),
        mesh=uri or ("" if _solid(parts) else DRAWN.format(type_id)),
        about=entry.value("about", TEXT, ""),
    )


def _solid(parts: Sequence[Part]) -> Part | None:
    only = parts[0] if len(parts) == 1 else None
    return only if only and only.shape in SIZES and only.pose == IDENTITY else None


def _part(entry: Record) -> Part:
    shape = entry.required("shape", SOLID)
    size = entry.required("size", SIZES[shape])
    x, y, z = entry.value("at", POSITION, (0.0, 0.0, 0.0))
    roll, pitch, yaw = map(math.radians, entry.value("rpy_deg", ANGLES, (0.0, 0.0, 0.0)))
    pose = Pose((x, y, z), quaternion_from_rpy(roll, pitch, yaw))
    return Part(shape, size, pose, density=entry.value("density", DENSITY, 1.0))


def _half(part: Part) -> Vector:
    size = part.size
    if part.shape is Shape.BOX:
        return (size[0] / 2, size[1] / 2, size[2] / 2)
    if part.shape is Shape.CYLINDER:
        return (size[0], size[0], size[1] / 2)
    return (size[0], size[0], size[0])


def _bounds(part: Part) -> tuple[Vector, Vector]:
    """Return the corners of a box around the part, in the object's frame."""
    if part.vertices is not None:
        (x, y, z), (a, b, c) = (
            part.vertices.min(axis=0).tolist(),
            part.vertices.max(axis=0).tolist(),
        )
        return (x, y, z), (a, b, c)
    half = _half(part)
    reach = [0.0, 0.0, 0.0]
    for axis in range(3):
        side = rotate(
            part.pose.orientation,
            (half[0] * (axis == 0), half[1] * (axis == 1), half[2] * (axis == 2)),
        )
        for i in range(3):
            reach[i] += abs(side[i])
    around = (reach[0], reach[1], reach[2])
    return subtract(part.pose.position, around), add(part.pose.position, around)


def _corner(choose: Any, corners: Sequence[Vector]) -> Vector:
    return (
        choose(c[0] for c in corners),
        choose(c[1] for c in corners),
        choose(c[2] for c in corners),
    )
