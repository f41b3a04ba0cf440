"""Small meshes: the same shape within a sixty-thousandth, fewer bytes."""

import io
from pathlib import Path

import numpy as np
import pytest
import trimesh
from refusals import refused

from mrlab_ros.adapters.robots import mesh_files as module
from mrlab_ros.adapters.robots.diagnostics import ROBOT_MESH_UNREADABLE
from mrlab_ros.adapters.robots.mesh_files import quantised
from mrlab_ros.core.base.errors import BadInput

ROBOTS = Path(__file__).parents[4] / "robots"
MESHES = sorted(ROBOTS.glob("ur5e/meshes/*.glb")) + sorted(
    ROBOTS.glob("end_effectors/*/meshes/*.glb")
)


def points_of(data):
    """Return the positions of a GLB in metres, by its nodes, as a reader of glTF computes them."""
    head, binary = module._parts(data, Path("mesh.glb"))
    found = []

    def walk(number, scale, offset):
        node = head["nodes"][number]
        offset = offset + scale * np.array(node.get("translation", [0, 0, 0]))
        scale = scale * np.array(node.get("scale", [1, 1, 1]))
        for primitive in head["meshes"][node["mesh"]]["primitives"] if "mesh" in node else ():
            accessor = head["accessors"][primitive["attributes"]["POSITION"]]
            values = module._values(accessor, head, binary).astype(np.float64)
            values /= 32767 if accessor.get("normalized") else 1
            found.append(values * scale + offset)
        for child in node.get("children", ()):
            walk(child, scale, offset)

    for root in head["scenes"][0]["nodes"]:
        walk(root, np.ones(3), np.zeros(3))
    return np.concatenate(found)


@pytest.mark.parametrize("path", MESHES, ids=lambda path: path.stem)
def test_the_shape_stays_and_the_file_shrinks(path):
    data = quantised(path)
    before, after = points_of(path.read_bytes()), points_of(data)
    assert np.abs(before - after).max() <= np.ptp(before, axis=0).max() / 60_000
    assert len(data) < 0.7 * path.stat().st_size


def test_every_view_begins_at_a_multiple_of_four():
    head, binary = module._parts(quantised(MESHES[0]), MESHES[0])
    assert all(view["byteOffset"] % 4 == 0 for view in head["bufferViews"])
    assert head["buffers"][0]["byteLength"] == len(binary)
    assert head["extensionsRequired"] == ["KHR_mesh_quantization"]


def test_an_stl_becomes_a_small_glb(tmp_path):
    path = tmp_path / "ball.stl"
    ball = trimesh.creation.icosphere(subdivisions=3)
    path.write_bytes(ball.export(file_type="stl"))
    data = quantised(path)
    assert data[:4] == b"glTF"
    np.testing.assert_allclose(np.ptp(points_of(data), axis=0), ball.extents, atol=1e-3)


def test_textures_are_kept(tmp_path):
    from PIL import Image

    image = Image.fromarray(np.arange(48, dtype=np.uint8).reshape(4, 4, 3))
    plane = trimesh.creation.box((1, 1, 1))
    plane.visual = trimesh.visual.TextureVisuals(uv=np.zeros((8, 2)), image=image)
    path = tmp_path / "textured.glb"
    path.write_bytes(plane.export(file_type="glb"))
    head, binary = module._parts(quantised(path), path)
    view = head["bufferViews"][head["images"][0]["bufferView"]]
    stored = binary[view["byteOffset"] : view["byteOffset"] + view["byteLength"]]
    assert np.array_equal(np.asarray(Image.open(io.BytesIO(stored)))[..., :3], np.asarray(image))


@pytest.mark.parametrize("content", [b"glTF", b"glTF" + bytes(30), b"solid nothing"])
def test_what_cannot_be_read_is_named(tmp_path, content):
    path = tmp_path / "broken.glb"
    path.write_bytes(content)
    with refused(ROBOT_MESH_UNREADABLE, BadInput, uri="broken.glb"):
        quantised(path)
