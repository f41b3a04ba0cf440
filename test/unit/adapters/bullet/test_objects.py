"""The catalogue's meshes."""

from __future__ import annotations

import importlib.util
from pathlib import Path

import numpy as np
import pytest
import trimesh
from generated_meshes import assert_same_body
from refusals import refused

from mrlab_ros.adapters.bullet.engine import BulletEngine
from mrlab_ros.adapters.scenes.diagnostics import (
    OBJECT_MESH_FLAT,
    OBJECT_MESH_MISSING,
    OBJECT_MESH_SIZE,
    OBJECT_MESH_TOO_FINE,
    OBJECT_MESH_UNREADABLE,
    OBJECT_MESH_URI,
)
from mrlab_ros.adapters.scenes.object_meshes import HULL_CORNERS, ObjectMeshes
from mrlab_ros.adapters.yaml_files import read_yaml
from mrlab_ros.core.base.clock import SECOND
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.base.geometry import Pose
from mrlab_ros.core.physics import catalogue
from mrlab_ros.core.physics.engine import Shape
from mrlab_ros.core.physics.settings import Settings
from mrlab_ros.core.physics.world import World

ROOT = Path(__file__).parents[4]
SHIPPED = sorted((ROOT / "config" / "objects").glob("*.glb"))
MESHES = ObjectMeshes(ROOT, 20_000)
TYPES = catalogue.parse(read_yaml(ROOT / "config" / "objects.yaml"), MESHES)
URI = "package://mrlab_ros/"


def test_every_shipped_mesh_is_an_objects_and_every_object_finds_its_mesh():
    named = {TYPES.get(i).mesh for i in TYPES.ids} - {""}
    assert named == {f"{URI}config/objects/{path.name}" for path in SHIPPED}


@pytest.mark.parametrize("path", SHIPPED, ids=lambda path: path.stem)
def test_a_shipped_mesh_is_small_and_as_large_as_what_it_collides_with(path):
    assert path.stat().st_size < 60_000
    kind = TYPES.get(path.stem)
    vertices = MESHES.read(kind.mesh).vertices
    assert vertices.min(axis=0) == pytest.approx(kind.low, abs=0.002)
    assert vertices.max(axis=0) == pytest.approx(kind.high, abs=0.002)


@pytest.mark.slow
def test_the_script_makes_every_shipped_mesh(tmp_path, monkeypatch):
    monkeypatch.syspath_prepend(ROOT / "scripts" / "bodies")
    path = ROOT / "scripts" / "bodies" / "objects.py"
    spec = importlib.util.spec_from_file_location("object_bodies", path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    assert set(module.OBJECTS) == {path.stem for path in SHIPPED}
    monkeypatch.setattr(module, "FOLDER", tmp_path)
    assert_same_body(module.make("hole"), ROOT / "config" / "objects" / "hole.glb")


def entry(**fields) -> dict:
    return {"objects": {"thing": fields}}


@pytest.fixture
def folder(tmp_path):
    """A folder with meshes of a person's own."""
    trimesh.creation.torus(0.05, 0.02).export(tmp_path / "ring.stl")
    trimesh.creation.icosphere(6, 0.1).export(tmp_path / "fine.stl")
    trimesh.creation.icosphere(1, 100.0).export(tmp_path / "millimetres.stl")
    sheet = trimesh.Trimesh([[0, 0, 0], [0.1, 0, 0], [0.1, 0.1, 0], [0, 0.1, 0]], [[0, 1, 2]])
    sheet.export(tmp_path / "flat.stl")
    (tmp_path / "broken.glb").write_bytes(b"glTF")
    return tmp_path


def test_an_object_of_ones_own_collides_with_its_mesh(folder):
    meshes = ObjectMeshes(folder, 20_000)
    held = catalogue.parse(entry(mesh=f"{URI}ring.stl", mass=0.2), meshes).get("thing")
    (part,) = held.body.parts
    assert part.shape is Shape.HULL
    assert len(part.vertices) <= HULL_CORNERS
    assert held.size == pytest.approx((0.14, 0.14, 0.04), abs=0.004)
    fixed = catalogue.parse(entry(mesh=f"{URI}ring.stl", fixed=True), meshes)
    (part,) = fixed.get("thing").body.parts
    assert part.shape is Shape.MESH

    engine = BulletEngine(lambda uri: folder)
    world = World(
        engine, catalogue.parse(entry(mesh=f"{URI}ring.stl", mass=0.2), meshes), Settings()
    )
    ring = world.spawn("thing", pose=Pose((0.0, 0.0, 0.3))).name
    for i in range(60):
        world.advance(i * SECOND // 30)
    assert world.motion(ring).pose.position[2] == pytest.approx(0.02, abs=0.003)
    engine.close()


@pytest.mark.parametrize(
    ("uri", "code", "values"),
    [
        (f"{URI}fine.stl", OBJECT_MESH_TOO_FINE, {"count": 81920, "most": 20_000}),
        (f"{URI}millimetres.stl", OBJECT_MESH_SIZE, {"size": 200.0, "low": 0.002}),
        (f"{URI}broken.glb", OBJECT_MESH_UNREADABLE, {}),
        (f"{URI}nothing.stl", OBJECT_MESH_MISSING, {}),
        (f"{URI}flat.stl", OBJECT_MESH_FLAT, {}),
        (f"{URI}../../etc/passwd", OBJECT_MESH_URI, {}),
        ("http://elsewhere/ring.stl", OBJECT_MESH_URI, {}),
    ],
)
def test_a_mesh_that_cannot_be_an_object_is_refused(folder, uri, code, values):
    with refused(code, BadInput, **values):
        catalogue.parse(entry(mesh=uri, mass=0.2), ObjectMeshes(folder, 20_000))


def test_a_mesh_that_is_only_looked_at_must_be_there(folder):
    shown = {"shape": "box", "size": [0.1, 0.1, 0.1], "mass": 0.2}
    meshes = ObjectMeshes(folder, 20_000)
    assert catalogue.parse(entry(mesh=f"{URI}fine.stl", **shown), meshes).get("thing").mesh
    with refused(OBJECT_MESH_MISSING, BadInput):
        catalogue.parse(entry(mesh=f"{URI}nothing.stl", **shown), meshes)


def test_the_hull_of_a_mesh_reaches_as_far_as_the_mesh(folder):
    trimesh.creation.icosphere(4, 0.1).export(folder / "ball.stl")
    meshes = ObjectMeshes(folder, 20_000)
    kind = catalogue.parse(entry(mesh=f"{URI}ball.stl", mass=1.0), meshes).get("thing")
    corners = kind.body.parts[0].vertices
    assert len(corners) > HULL_CORNERS / 2
    assert np.linalg.norm(corners, axis=1) == pytest.approx(0.1, rel=1e-6)
    assert kind.size == pytest.approx((0.2, 0.2, 0.2), abs=0.004)
    assert np.diag(kind.body.inertia) == pytest.approx(0.4 * 0.1**2, rel=0.1)
