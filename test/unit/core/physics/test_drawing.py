from __future__ import annotations

import io
import math

import numpy as np
import pytest
import trimesh

from mrlab_ros.core.base.geometry import Pose, quaternion_from_rpy
from mrlab_ros.core.physics.drawing import glb, surface
from mrlab_ros.core.physics.engine import Part, Shape

SOLIDS = {
    Shape.BOX: ((0.1, 0.2, 0.3), 0.006, (0.1, 0.2, 0.3)),
    Shape.CYLINDER: ((0.05, 0.2), math.pi * 0.05**2 * 0.2, (0.1, 0.1, 0.2)),
    Shape.SPHERE: ((0.1,), 4 / 3 * math.pi * 0.1**3, (0.2, 0.2, 0.2)),
}


def load(data):
    return trimesh.load(io.BytesIO(data), file_type="glb")


@pytest.mark.parametrize("shape", SOLIDS)
def test_a_part_has_its_size_and_faces_outward(shape):
    size, volume, extents = SOLIDS[shape]
    points, normals, faces = surface(Part(shape, size))
    mesh = trimesh.Trimesh(points, faces, process=False)
    assert mesh.volume == pytest.approx(volume, rel=0.02)
    assert np.ptp(points, axis=0) == pytest.approx(extents, rel=0.01)
    assert np.linalg.norm(normals, axis=1) == pytest.approx(1.0)
    corners, across = normals[faces].mean(axis=1), mesh.face_normals
    assert (np.sum(corners * across, axis=1)[mesh.area_faces > 1e-9] > 0.9).all()


def test_parts_lie_where_they_are_in_the_object():
    turn = quaternion_from_rpy(0.0, 0.0, math.pi / 2)
    parts = [
        Part(Shape.BOX, (0.2, 0.1, 0.1)),
        Part(Shape.BOX, (0.2, 0.1, 0.1), Pose((1, 2, 3), turn)),
    ]
    scene = load(glb(parts, (1.0, 0.5, 0.0, 0.5), "pair"))
    assert scene.bounds.tolist() == [
        pytest.approx([-0.1, -0.05, -0.05]),
        pytest.approx([1.05, 2.1, 3.05]),
    ]
    material = next(iter(scene.geometry.values())).visual.material
    assert material.alphaMode == "BLEND"
    assert glb(parts, (1.0, 0.5, 0.0, 0.5), "pair") == glb(parts, (1.0, 0.5, 0.0, 0.5), "pair")
