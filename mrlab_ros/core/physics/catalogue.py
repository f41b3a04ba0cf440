"""The kinds of objects a lab knows, read from config/objects.yaml and checked."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from mrlab_ros.core.errors import BadInput
from mrlab_ros.core.geometry import (
    Array,
    Pose,
    Vector,
    add,
    quaternion_from_rpy,
    rotate,
    subtract,
)
from mrlab_ros.core.naming import NAME
from mrlab_ros.core.physics.engine import Body, Part, Shape

SOLID = (Shape.BOX, Shape.CYLINDER, Shape.SPHERE)
COUNTS = {Shape.BOX: 3, Shape.CYLINDER: 2, Shape.SPHERE: 1}
FIELDS = frozenset(
    (
        "shape",
        "size",
        "parts",
        "mass",
        "fixed",
        "color",
        "mesh",
        "friction",
        "restitution",
        "about",
    )
)
SIZE_RANGE = (0.002, 5.0)
MASS_RANGE = (0.001, 500.0)
# A hull of more corners than this costs time at every step and is no better.
HULL_CORNERS = 128


@dataclass(frozen=True, eq=False)
class Mesh:
    """vertices: (V, 3) m, in the object's frame; triangles: (T, 3) vertex indices."""

    vertices: Array
    triangles: NDArray[np.int32]


class Meshes(Protocol):
    """Where the meshes of a catalogue are. Both raise BadInput where a URI names none."""

    def find(self, uri: str) -> object: ...

    def read(self, uri: str) -> Mesh: ...


@dataclass(frozen=True, eq=False)
class ObjectType:
    """One entry of the catalogue.

    body: its parts about its centre of mass. low, high: corners of its bounding box in its own
    frame, m. color: red, green, blue, alpha, 0 to 1. mesh: URI for displays, or empty.
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
            raise BadInput(
                f"there is no object '{type_id}' in the catalogue; there are: "
                f"{', '.join(self._types)}"
            ) from None


def parse(document: object, meshes: Meshes | None = None) -> Catalogue:
    """Read the catalogue from what the YAML file holds; raise BadInput where it is not one.

    A mesh that collides is read, one for displays alone is only found. Without `meshes` none is
    looked at, and none can be collided with.
    """
    if not isinstance(document, Mapping) or not isinstance(document.get("objects"), Mapping):
        raise BadInput("the object catalogue has no mapping 'objects'; see config/objects.yaml")
    types = {str(k): _type(str(k), v, meshes) for k, v in document["objects"].items()}
    return Catalogue(types)


def _type(type_id: str, entry: object, meshes: Meshes | None) -> ObjectType:
    where = f"object '{type_id}' of the catalogue"
    if not NAME.fullmatch(type_id):
        raise BadInput(f"{where} has no usable id; expected lower-case letters, digits and _")
    if not isinstance(entry, Mapping) or set(entry) - FIELDS:
        found = ", ".join(sorted(set(entry) - FIELDS)) if isinstance(entry, Mapping) else entry
        raise BadInput(f"{where} has {found}; expected {', '.join(sorted(FIELDS))}")
    fixed = entry.get("fixed", False) is True
    mass = _number(where, "mass", entry.get("mass", 0.0), 0.0, MASS_RANGE[1])
    if fixed and mass:
        raise BadInput(f"{where} is fixed and has {mass:g} kg; leave one of the two out")
    if not fixed and mass < MASS_RANGE[0]:
        raise BadInput(
            f"{where} has a mass of {mass:g} kg; expected {MASS_RANGE[0]:g} to "
            f"{MASS_RANGE[1]:g} kg, or fixed: true for what never moves"
        )
    uri = str(entry.get("mesh", ""))
    shaped = "shape" in entry or bool(entry.get("parts"))
    if uri and meshes is not None and not shaped:
        parts = [_of_mesh(meshes.read(uri), fixed)]
    else:
        if uri and meshes is not None:
            meshes.find(uri)
        described = entry.get("parts") or [entry]
        parts = [_part(f"{where}, part {i + 1}", p) for i, p in enumerate(described)]
    boxes = [_bounds(part) for part in parts]
    color = _numbers(where, "color", entry.get("color", (0.7, 0.7, 0.7, 1.0)), 4, 0.0, 1.0)
    return ObjectType(
        id=type_id,
        body=Body(
            tuple(parts),
            mass,
            _number(where, "friction", entry.get("friction", 0.6), 0.0, 5.0),
            _number(where, "restitution", entry.get("restitution", 0.1), 0.0, 1.0),
        ),
        low=_corner(min, [b[0] for b in boxes]),
        high=_corner(max, [b[1] for b in boxes]),
        color=(color[0], color[1], color[2], color[3]),
        mesh=uri,
        about=str(entry.get("about", "")),
    )


def _of_mesh(mesh: Mesh, fixed: bool) -> Part:
    """Return what collides of a mesh: itself where it is fixed, else its corners' convex hull."""
    if fixed:
        return Part(Shape.MESH, vertices=mesh.vertices, triangles=mesh.triangles)
    return Part(Shape.HULL, vertices=_extreme(mesh.vertices))


def _extreme(vertices: Array) -> Array:
    """Return the vertices that reach furthest, each in one of HULL_CORNERS even directions.

    Directions: a Fibonacci lattice on the sphere.
    """
    k = np.arange(HULL_CORNERS) + 0.5
    z = 1 - 2 * k / HULL_CORNERS
    turn = math.pi * (1 + math.sqrt(5)) * k
    across = np.sqrt(1 - z * z)
    directions = np.stack([across * np.cos(turn), across * np.sin(turn), z])
    kept: Array = vertices[np.unique((vertices @ directions).argmax(axis=0))]
    return kept


def _part(where: str, entry: Mapping[str, Any]) -> Part:
    names = {shape.value: shape for shape in SOLID}
    shape = names.get(str(entry.get("shape")))
    if shape is None:
        raise BadInput(f"{where}: shape is {entry.get('shape')!r}; expected {', '.join(names)}")
    size = _numbers(where, "size", entry.get("size"), COUNTS[shape], *SIZE_RANGE)
    at = _numbers(where, "at", entry.get("at", (0.0, 0.0, 0.0)), 3, -5.0, 5.0)
    x, y, z = _numbers(where, "rpy_deg", entry.get("rpy_deg", (0.0, 0.0, 0.0)), 3, -360.0, 360.0)
    turn = quaternion_from_rpy(math.radians(x), math.radians(y), math.radians(z))
    return Part(shape, size, Pose((at[0], at[1], at[2]), turn))


def _number(where: str, field: str, value: object, low: float, high: float) -> float:
    if isinstance(value, bool) or not isinstance(value, int | float) or not low <= value <= high:
        raise BadInput(f"{where}: {field} is {value!r}; expected a number of {low:g} to {high:g}")
    return float(value)


def _numbers(
    where: str, field: str, values: object, count: int, low: float, high: float
) -> tuple[float, ...]:
    if not isinstance(values, Sequence) or isinstance(values, str) or len(values) != count:
        raise BadInput(f"{where}: {field} is {values!r}; expected {count} numbers")
    return tuple(_number(where, field, v, low, high) for v in values)


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
