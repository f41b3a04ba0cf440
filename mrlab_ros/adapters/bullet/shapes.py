"""Bodies of the core as Bullet shapes; input that would crash Bullet is refused before."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from mrlab_ros.adapters.bullet.diagnostics import (
    BAD_BODY,
    BAD_MESH,
    BAD_SIZE,
    HOLLOW_MESH,
    MESH_NO_VERTEX,
    NO_SHAPE,
)
from mrlab_ros.adapters.bullet.quiet import pybullet
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.base.geometry import Array, Pose, Vector, relative, rotation
from mrlab_ros.core.physics.engine import IDENTITY, Body, Part, Shape
from mrlab_ros.core.physics.inertia import principal

# Bullet multiplies the coefficients of both bodies, so 1 leaves it to the object.
NEUTRAL = 1.0
# Coefficient of rolling friction, m: the offset of the normal force of a round body.
ROLLING = 0.0008
# The swept sphere's radius as a share of half of the least extent.
SWEPT = 0.8
# Bullet keeps things apart by this margin around hulls and triangles, m.
MARGIN = 0.001
STATIC_GROUP = 2  # Bullet's own collision group of what never moves
ROUND = (Shape.SPHERE, Shape.CYLINDER, Shape.HULL)
# A part that is nearer to its body's frame, m and share of a turn, lies in it.
SAME_PLACE = 1e-9
CENTRED = {
    "collisionFramePosition": IDENTITY.position,
    "collisionFrameOrientation": IDENTITY.orientation,
}
NUMBERS = {Shape.BOX: 3, Shape.CYLINDER: 2, Shape.SPHERE: 1}


def make_shape(client: int, body: Body, frame: Pose = IDENTITY) -> int:
    """Return Bullet's number of a new shape; raise BadInput where the body is none.

    frame: of the shape, in that of the body's parts. pybullet keeps a shape for as long as its
    world lives.
    """
    if not (math.isfinite(body.mass) and body.mass >= 0 and body.parts):
        raise BadInput(BAD_BODY(mass=body.mass, parts=len(body.parts)))
    static = body.mass == 0
    parts = [_shape(part, relative(frame, part.pose), static) for part in body.parts]
    if len(parts) == 1 and _centred(parts[0]):
        part = parts[0]
        del part["collisionFramePosition"], part["collisionFrameOrientation"]
        shape: int = pybullet.createCollisionShape(**part, physicsClientId=client)
    else:
        shape = _compound(client, parts)
    if shape < 0:
        raise BadInput(NO_SHAPE())
    return shape


def mass_frame(body: Body) -> tuple[Pose, Vector | None]:
    """Return the frame of the principal axes at a body's centre of mass, in that of its parts, and
    the moments about them, kg*m^2; None: those that Bullet computes of one solid are right."""
    if len(body.parts) == 1 and body.parts[0].shape in NUMBERS:
        return body.parts[0].pose, None
    if body.inertia is None:
        return IDENTITY, None
    moments, axes = principal(body.inertia)
    return Pose(body.centre, axes), moments


def _centred(part: dict[str, Any]) -> bool:
    """Return whether a shape lies in the body's frame as in its own."""
    numbers = (*part["collisionFramePosition"], *part["collisionFrameOrientation"][:3])
    return all(abs(x) < SAME_PLACE for x in numbers)


def make_body(client: int, body: Body, shape: int, pose: Pose) -> int:
    """Put a body of a shape from make_shape() into the world; return Bullet's number of it."""
    static = body.mass == 0
    # Bodies with edges do not roll, and rolling friction is a constraint of every contact.
    rolls = not static and any(part.shape in ROUND for part in body.parts)
    rolling = ROLLING if rolls else 0.0
    made: int = pybullet.createMultiBody(
        body.mass,
        shape,
        -1,
        pose.position,
        pose.orientation,
        useMaximalCoordinates=True,
        physicsClientId=client,
    )
    if any(part.shape is Shape.MESH for part in body.parts):
        # Triangles have no known outer side to be drawn in from, as hulls are.
        pybullet.changeDynamics(made, -1, collisionMargin=0.0, physicsClientId=client)
    if not static:
        # A sphere inside the body is swept along its way, so that what is fast stops at a thin
        # surface.
        radius = SWEPT * min(least(part) for part in body.parts)
        pybullet.changeDynamics(made, -1, ccdSweptSphereRadius=radius, physicsClientId=client)
    pybullet.changeDynamics(
        made,
        -1,
        lateralFriction=NEUTRAL if static else body.friction,
        restitution=NEUTRAL if static else body.restitution,
        rollingFriction=rolling,
        spinningFriction=rolling,
        physicsClientId=client,
    )
    if static:
        # Otherwise the contacts of all that lies on it would be computed in every step.
        pybullet.changeDynamics(
            made, -1, activationState=pybullet.ACTIVATION_STATE_SLEEP, physicsClientId=client
        )
    return made


def least(part: Part) -> float:
    """Return half of the least extent of a part, m."""
    if part.shape is Shape.BOX:
        return min(part.size) / 2
    if part.shape is Shape.CYLINDER:
        return min(part.size[0], part.size[1] / 2)
    if part.shape is Shape.SPHERE:
        return part.size[0]
    assert part.vertices is not None
    return float((part.vertices.max(axis=0) - part.vertices.min(axis=0)).min()) / 2


def _compound(client: int, parts: list[dict[str, Any]]) -> int:
    def column(key: str, default: Any) -> list[Any]:
        return [part.get(key, default) for part in parts]

    made: int = pybullet.createCollisionShapeArray(
        shapeTypes=column("shapeType", 0),
        halfExtents=column("halfExtents", [0.0, 0.0, 0.0]),
        radii=column("radius", 0.0),
        lengths=column("height", 0.0),
        collisionFramePositions=column("collisionFramePosition", (0.0, 0.0, 0.0)),
        collisionFrameOrientations=column("collisionFrameOrientation", (0.0, 0.0, 0.0, 1.0)),
        physicsClientId=client,
    )
    return made


def _shape(part: Part, pose: Pose, static: bool) -> dict[str, Any]:
    """Return the arguments of createCollisionShape; raise BadInput where the part is no shape.

    pose: of the part.
    """
    size, count = part.size, NUMBERS.get(part.shape, 0)
    if len(size) != count or not all(1e-4 <= s <= 1000 for s in size):
        raise BadInput(BAD_SIZE(shape=part.shape.value, size=[*size], count=count))
    result: dict[str, Any] = {
        "collisionFramePosition": pose.position,
        "collisionFrameOrientation": pose.orientation,
    }
    if part.shape is Shape.BOX:
        result.update(shapeType=pybullet.GEOM_BOX, halfExtents=[s / 2 for s in size])
    elif part.shape is Shape.CYLINDER:
        result.update(shapeType=pybullet.GEOM_CYLINDER, radius=size[0], height=size[1])
    elif part.shape is Shape.SPHERE:
        result.update(shapeType=pybullet.GEOM_SPHERE, radius=size[0])
    else:
        result.update(_mesh(part, pose, static))
    return result


def _mesh(part: Part, pose: Pose, static: bool) -> dict[str, Any]:
    """Return the arguments of a hull or a mesh, whose corners are moved to where the part is."""
    vertices, triangles = part.vertices, part.triangles
    if vertices is None or len(vertices) < 3 or not np.isfinite(vertices).all():
        raise BadInput(BAD_MESH())
    if part.shape is Shape.HULL:
        corners = _placed(_within_margin(vertices), pose)
        return {"shapeType": pybullet.GEOM_MESH, "vertices": corners.tolist(), **CENTRED}
    if not static:
        raise BadInput(HOLLOW_MESH())
    if triangles is None or not (
        len(triangles) and triangles.min() >= 0 and triangles.max() < len(vertices)
    ):
        raise BadInput(MESH_NO_VERTEX())
    return {
        "shapeType": pybullet.GEOM_MESH,
        "vertices": _placed(vertices, pose).tolist(),
        "indices": triangles.ravel().tolist(),
        "flags": pybullet.GEOM_FORCE_CONCAVE_TRIMESH,
        **CENTRED,
    }


def _placed(vertices: Array, pose: Pose) -> Array:
    turned: Array = vertices @ rotation(pose.orientation).T + pose.position
    return turned


def _within_margin(vertices: Array) -> Array:
    """Return corners of a hull, (V, 3) m, whose extents are right once Bullet adds its margin.

    Otherwise what stands on a flat surface would stand a millimetre above it.
    """
    low, high = vertices.min(axis=0), vertices.max(axis=0)
    half = (high - low) / 2
    scale = np.where(half > 2 * MARGIN, 1 - MARGIN / np.maximum(half, MARGIN), 1.0)
    within: Array = (low + high) / 2 + (vertices - (low + high) / 2) * scale
    return within
