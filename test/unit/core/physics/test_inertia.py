"""Centre of mass and inertia, beside what trimesh integrates."""

from __future__ import annotations

import numpy as np
import pytest
import trimesh

from mrlab_ros.core.base.geometry import Pose, quaternion_from_rpy, rotation
from mrlab_ros.core.physics.engine import Part, Shape
from mrlab_ros.core.physics.inertia import mass_properties, principal

TURNED = quaternion_from_rpy(0.4, -0.7, 1.1)


def as_mesh(part: Part) -> trimesh.Trimesh:
    if part.shape is Shape.BOX:
        mesh = trimesh.creation.box(part.size)
    elif part.shape is Shape.CYLINDER:
        mesh = trimesh.creation.cylinder(*part.size, sections=512)
    elif part.shape is Shape.SPHERE:
        mesh = trimesh.creation.icosphere(5, *part.size)
    else:
        mesh = trimesh.Trimesh(part.vertices, part.triangles, process=False)
    place = np.eye(4)
    place[:3, :3], place[:3, 3] = rotation(part.pose.orientation), part.pose.position
    return mesh.apply_transform(place)


def test_parts_weigh_as_their_volumes_and_densities():
    ring = trimesh.creation.annulus(0.02, 0.05, 0.03)
    parts = [
        Part(Shape.BOX, (0.1, 0.2, 0.3), Pose((0.1, 0.0, 0.2), TURNED)),
        Part(Shape.CYLINDER, (0.05, 0.4), Pose((-0.2, 0.1, 0.0), TURNED), density=7.0),
        Part(Shape.SPHERE, (0.08,), Pose((0.0, 0.3, 0.0)), density=0.5),
        Part(Shape.MESH, (), Pose((0.0, 0.0, -0.3), TURNED), ring.vertices, ring.faces),
    ]
    centre, inertia = mass_properties(parts, 3.0)
    meshes = [as_mesh(part) for part in parts]
    for mesh, part in zip(meshes, parts, strict=True):
        mesh.density = part.density
    masses = np.array([mesh.mass for mesh in meshes]) * 3.0 / sum(mesh.mass for mesh in meshes)
    places = np.array([mesh.center_mass for mesh in meshes])
    middle = masses @ places / 3.0
    about = np.zeros((3, 3))
    for mesh, mass, way in zip(meshes, masses, places - middle, strict=True):
        about += mesh.moment_inertia * mass / mesh.mass
        about += mass * (way @ way * np.eye(3) - np.outer(way, way))
    assert centre == pytest.approx(middle, abs=1e-5)
    np.testing.assert_allclose(inertia, about, rtol=2e-3, atol=1e-6)

    moments, turn = principal(inertia)
    axes = rotation(turn)
    np.testing.assert_allclose(axes @ np.diag(moments) @ axes.T, inertia, atol=1e-12)
