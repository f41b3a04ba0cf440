from __future__ import annotations

import io
import json
import shutil
from pathlib import Path

import pytest
import trimesh
import yaml
from refusals import refused

from mrlab_ros.adapters.assets.diagnostics import NO_ASSET
from mrlab_ros.adapters.assets.library import Assets
from mrlab_ros.adapters.robots.diagnostics import NO_ROBOT_MODEL
from mrlab_ros.adapters.robots.library import RobotLibrary
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.bridge.assets import Span, key_of_uri

ROOT = Path(__file__).parents[4]
PAIR = {
    "mass": 1.0,
    "color": [0.2, 0.4, 0.6, 1],
    "parts": [
        {"shape": "box", "size": [0.1, 0.1, 0.1], "at": [0, 0, 0.2]},
        {"shape": "cylinder", "size": [0.05, 0.3]},
    ],
}


@pytest.fixture
def share(tmp_path):
    """A share folder with a catalogue that can be changed."""
    (tmp_path / "config" / "objects").mkdir(parents=True)
    shutil.copy(ROOT / "config" / "physics.yaml", tmp_path / "config")
    (tmp_path / "config" / "objects.yaml").write_text(yaml.safe_dump({"objects": {"pair": PAIR}}))
    return tmp_path


@pytest.fixture
def assets(share):
    library = RobotLibrary(ROOT / "robots", share / "imported")
    return Assets(share, library, {"more.json": lambda: b"{}"})


def document(assets, path):
    return json.loads(assets.read(path, Span()).data)


def test_an_object_of_several_parts_without_a_mesh_is_drawn(assets):
    (entry,) = document(assets, "objects.json")["objects"]
    assert entry["shape"] is None
    piece = assets.read(entry["mesh"].removeprefix("assets/"), Span())
    assert piece.whole.media_type == "model/gltf-binary"
    scene = trimesh.load(io.BytesIO(piece.data), file_type="glb")
    assert scene.extents == pytest.approx([0.1, 0.1, 0.4])
    assert entry["mesh"] == key_of_uri("package://mrlab_ros/objects/pair.glb")


def test_a_changed_catalogue_is_read_anew(assets, share):
    assert len(document(assets, "objects.json")["objects"]) == 1
    catalogue = share / "config" / "objects.yaml"
    both = {"pair": PAIR, "cube": {"shape": "box", "size": [0.1] * 3, "mass": 1.0}}
    catalogue.write_text(yaml.safe_dump({"objects": both}))
    found = {entry["id"]: entry for entry in document(assets, "objects.json")["objects"]}
    assert found["cube"]["shape"] == {"kind": "box", "size": [0.1, 0.1, 0.1]}
    assert found["cube"]["mesh"] is None
    with refused(NO_ASSET, BadInput):
        assets.read("mrlab_ros/objects/cube.glb", Span())


def test_a_document_comes_in_pieces_as_a_file_does(assets):
    whole = assets.read("robots.json", Span())
    parts = [assets.read("robots.json", Span(at, 1000)) for at in range(0, whole.whole.size, 1000)]
    assert b"".join(part.data for part in parts) == whole.data
    assert {part.whole.sha256 for part in parts} == {whole.whole.sha256}
    assert assets.read("more.json", Span()).data == b"{}"


def test_a_damaged_robot_hides_no_other(assets, share):
    folder = share / "imported" / "broken"
    folder.mkdir(parents=True)
    (folder / "robot.yaml").write_text("id: broken\n")
    found = document(assets, "robots.json")
    assert len(found["robots"]) == 13
    assert "broken" in found["problems"][0]
    with pytest.raises(BadInput):
        assets.read("robots/broken.urdf", Span())
    with refused(NO_ROBOT_MODEL, BadInput, close="ur5e"):
        assets.read("robots/ur5.urdf", Span())
