"""The catalogue's meshes, and scenes as documents."""

from __future__ import annotations

import importlib.util
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
import trimesh
from generated_meshes import assert_same_body

from mrlab_ros.adapters.bullet.engine import BulletEngine
from mrlab_ros.adapters.scenes.object_meshes import ObjectMeshes
from mrlab_ros.adapters.yaml_files import read_yaml
from mrlab_ros.core.clock import SECOND
from mrlab_ros.core.errors import BadInput
from mrlab_ros.core.geometry import Pose
from mrlab_ros.core.physics import catalogue
from mrlab_ros.core.physics.catalogue import HULL_CORNERS
from mrlab_ros.core.physics.engine import Shape
from mrlab_ros.core.physics.settings import Settings
from mrlab_ros.core.physics.world import World
from mrlab_ros.core.scene.document import (
    MemberEntry,
    ObjectEntry,
    RobotEntry,
    SceneDocument,
    SystemEntry,
    parse,
    plain,
)

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


def test_the_script_makes_every_shipped_mesh(tmp_path, monkeypatch):
    monkeypatch.syspath_prepend(ROOT / "scripts" / "robots")
    path = ROOT / "scripts" / "robots" / "objects.py"
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
    ("uri", "says"),
    [
        (f"{URI}fine.stl", "has 81920 triangles; expected 20000 at most"),
        (f"{URI}millimetres.stl", "measures 200 m; expected 0.002 to 5 m"),
        (f"{URI}broken.glb", "cannot be read"),
        (f"{URI}nothing.stl", "does not exist"),
        (f"{URI}../../etc/passwd", "expected a URI that begins with"),
        ("http://elsewhere/ring.stl", "expected a URI that begins with"),
    ],
)
def test_a_mesh_that_cannot_be_an_object_is_refused(folder, uri, says):
    with pytest.raises(BadInput, match=says):
        catalogue.parse(entry(mesh=uri, mass=0.2), ObjectMeshes(folder, 20_000))


def test_a_mesh_that_is_only_looked_at_must_be_there(folder):
    shown = {"shape": "box", "size": [0.1, 0.1, 0.1], "mass": 0.2}
    meshes = ObjectMeshes(folder, 20_000)
    assert catalogue.parse(entry(mesh=f"{URI}fine.stl", **shown), meshes).get("thing").mesh
    with pytest.raises(BadInput, match="does not exist"):
        catalogue.parse(entry(mesh=f"{URI}nothing.stl", **shown), meshes)


def test_a_scene_is_the_same_after_it_was_written_and_read():
    turned = Pose((0.1, 0.2, 0.3), (0.0, 0.0, 0.6, 0.8))
    scene = SceneDocument(
        robots=(
            RobotEntry("a", "ur5e", "parallel_gripper", turned, "run", 1.25),
            RobotEntry("b", "ur5e", "", Pose((1.0, 0.0, 0.0))),
        ),
        objects=(
            ObjectEntry("cube_1", "cube", turned, held_by="a", in_hand=Pose((0.0, 0.0, 0.17))),
            ObjectEntry("cube_2", "cube", turned, automatic=True),
        ),
        systems=(
            SystemEntry(
                "cell",
                (MemberEntry("a", "run", 0.5), MemberEntry("b", "go", 0.0, ("frame 3: object "
                 "cube_1 held by a",))),
                mode=1,
                policy=1,
                loop=True,
                rate=0.5,
                at=2.5,
            ),
        ),
    )  # fmt: skip
    assert parse(plain(scene), "scene") == scene


ROBOT = {"name": "a", "model": "ur5e"}


@pytest.mark.parametrize(
    ("document", "says"),
    [
        ({"robots": [{**ROBOT, "at": -1}]}, "at is -1; expected a number of 0"),
        ({"robots": [{**ROBOT, "speed": 1}]}, r"robots\[0\] has speed; expected name, model"),
        ({"robots": [{**ROBOT, "name": "lab"}]}, "'lab' is a name of the lab's own"),
        ({"robots": [ROBOT], "objects": [{"name": "a", "type": "cube"}]}, "object a twice"),
        ({"objects": [{"name": "c", "type": "cube", "held_by": "a"}]}, "belong together"),
        (
            {"objects": [{"name": "c", "type": "cube", "held_by": "a", "in_hand": {}}]},
            "c names the robot 'a'; the robots of the scene: none",
        ),
        (
            {
                "robots": [ROBOT],
                "objects": [
                    {"name": n, "type": "cube", "held_by": "a", "in_hand": {}} for n in "cd"
                ],
            },
            "a holds two objects",
        ),
        (
            {
                "robots": [ROBOT],
                "systems": [
                    {"name": n, "members": [{"robot": "a", "trajectory": "t"}]} for n in "st"
                ],
            },
            "a is a member twice",
        ),
        ({"systems": [{"name": "s"}]}, "has no members"),
        (
            {"robots": [ROBOT], "systems": [{"name": "s", "members": [{"robot": "a"}]}]},
            "trajectory is None; expected an id",
        ),
        (
            {
                "robots": [ROBOT],
                "systems": [
                    {
                        "name": "s",
                        "members": [{"robot": "a", "trajectory": "t", "waits": ["tea"]}],
                    }
                ],
            },
            "'tea' is no wait",
        ),
        (
            {
                "robots": [ROBOT],
                "systems": [
                    {"name": "s", "rate": 9, "members": [{"robot": "a", "trajectory": "t"}]}
                ],
            },
            "rate is 9; expected a number of 0.1 to 4",
        ),
    ],
)
def test_a_scene_that_contradicts_itself_is_refused(document, says):
    with pytest.raises(BadInput, match=says):
        parse(document, "scene")


def test_the_hull_of_a_mesh_reaches_as_far_as_the_mesh():
    ball = trimesh.creation.icosphere(4, 0.1)
    mesh = catalogue.Mesh(np.array(ball.vertices), np.array(ball.faces, dtype=np.int32))
    meshes = SimpleNamespace(read=lambda uri: mesh)
    kind = catalogue.parse(entry(mesh="ball", mass=1.0), meshes).get("thing")
    corners = kind.body.parts[0].vertices
    assert len(corners) > HULL_CORNERS / 2
    assert np.linalg.norm(corners, axis=1) == pytest.approx(0.1, rel=1e-6)
    assert kind.size == pytest.approx((0.2, 0.2, 0.2), abs=0.004)
