"""Scenes as files: the shipped ones, saved ones, and files that are none."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from mrlab_ros.adapters.robots.library import RobotLibrary
from mrlab_ros.adapters.scenes.files import SceneFiles, content
from mrlab_ros.adapters.yaml_files import read_yaml
from mrlab_ros.core.errors import BadInput
from mrlab_ros.core.geometry import Pose
from mrlab_ros.core.physics import catalogue
from mrlab_ros.core.physics.surfaces import Surface
from mrlab_ros.core.scene.document import RobotEntry, SceneDocument, parse, parse_cell, plain

ROOT = Path(__file__).parents[4]
SHIPPED = ROOT / "config" / "scenes"


def test_the_shipped_scenes_hold_known_robots_and_objects_and_survive_saving(tmp_path):
    library = RobotLibrary(ROOT / "robots")
    types = catalogue.parse(read_yaml(ROOT / "config" / "objects.yaml"))
    files = SceneFiles(SHIPPED, tmp_path)
    assert files.names() == ("empty", "handover", "obstacle_course", "pick_and_place", "table")
    for name in files.names():
        scene = files.load(name)
        assert {r.model for r in scene.robots} <= set(library.ids())
        assert {o.type for o in scene.objects} <= set(types.ids)
        assert parse(plain(scene), name) == scene
    corners = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0.0]])
    # As a headset may call it.
    room = Surface("Wall 7", "wall", Pose((1, 0, 0)), corners, np.zeros((0, 3), np.int32), "quest")
    files.save("mine", SceneDocument(surfaces=(room,)))
    (again,) = files.load("mine").surfaces
    assert np.array_equal(again.vertices, corners)
    assert (again.name, again.pose, again.source) == ("Wall 7", room.pose, "quest")


def test_the_shipped_cell_is_a_document_with_one_system():
    (system,) = parse_cell(content(ROOT / "examples" / "handover_cell.yaml"), "cell")
    assert [m.robot for m in system.members] == ["ur5e_1", "kuka_kr6_r900_sixx_1"]


def test_a_saved_scene_hides_the_shipped_one_and_leaves_no_other_file(tmp_path):
    files = SceneFiles(SHIPPED, tmp_path)
    scene = SceneDocument((RobotEntry("a", "ur5e", "", Pose()),), about="mine")
    for _ in range(2):
        files.save("empty", scene)
    assert files.load("empty") == scene
    assert [path.name for path in tmp_path.iterdir()] == ["empty.yaml"]


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("robots: [{name: A}]", "robot 1: name is 'A'"),
        ("cows: 1", "'cows' is unknown; expected about, robots"),
        ("objects: [{name: a, type: cube, position: [0, 0]}]", "expected a list of 3 numbers"),
        ("objects: [{name: a, type: cube, position: [0, 0, .nan]}]", "position is"),
        ("objects: [{name: a, type: cube}, {name: a, type: cube}]", "names the object a twice"),
        ("surfaces: [{name: a, vertices: [1, 2]}]", "expected a list of rows of 3 numbers"),
        ("systems: [{name: s, mode: 7}]", "members is empty"),
        ("systems: [{name: s, mode: 7, members: [{robot: a}]}]", "mode is 7; expected parallel"),
        ("robots: [5]\nobjects: 7", "has 2 mistakes"),
        ("- 5", "expected a mapping with the fields"),
        ("", "bad.yaml is empty; expected a mapping"),
        ("[]", "bad.yaml is empty; expected a mapping"),
        ("5", "is 5; expected a mapping"),
        ("[", "is not YAML"),
        ("a: [1,\nb\n", r"is not YAML: [^<>]* in line 3, column 1"),
        ("\x00\x01", "is not YAML"),
    ],
)
def test_scene_files_that_are_none_are_refused(tmp_path, text, says):
    (tmp_path / "bad.yaml").write_text(text)
    with pytest.raises(BadInput, match=says):
        SceneFiles(ROOT, tmp_path).load("bad")


@pytest.mark.parametrize("name", ["../x", "", "A", "no_such"])
def test_scene_names_that_are_none_are_refused(tmp_path, name):
    with pytest.raises(BadInput):
        SceneFiles(tmp_path, tmp_path).load(name)


def test_a_folder_in_place_of_a_scene_and_a_folder_that_cannot_be_written(tmp_path):
    (tmp_path / "bad.yaml").mkdir()
    with pytest.raises(BadInput, match="bad.yaml cannot be read: it is a folder"):
        SceneFiles(SHIPPED, tmp_path).load("bad")
    (tmp_path / "file").write_text("")
    with pytest.raises(BadInput, match="cannot be written: "):
        SceneFiles(SHIPPED, tmp_path / "file").save("mine", SceneDocument())


def test_a_number_with_an_exponent_is_a_number(tmp_path):
    path = tmp_path / "scene.yaml"
    path.write_text("robots: [{name: a, model: ur5e, position: [1e0, -2e-1, 0]}]")
    assert parse(content(path), path.name).robots[0].pose.position == (1.0, -0.2, 0.0)
