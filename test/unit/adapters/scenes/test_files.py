"""Scenes as files: the shipped ones, saved ones, and files that are none."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from refusals import refused

from mrlab_ros.adapters.diagnostics import FILE_UNWRITABLE, NOT_A_FILE, NOT_OF_FORMAT
from mrlab_ros.adapters.robots.library import RobotLibrary
from mrlab_ros.adapters.scenes.diagnostics import BAD_SCENE_NAME, NO_SCENE
from mrlab_ros.adapters.scenes.files import SceneFiles, content
from mrlab_ros.adapters.yaml_files import read_yaml
from mrlab_ros.core.base.diagnostics import (
    A_MAPPING,
    A_NAME,
    BAD_VALUE,
    COUNTED_NUMBERS,
    EMPTY_VALUE,
    ENTRY,
    FINITE_NUMBERS,
    MISTAKES,
    ROWS_OF_NUMBERS,
    UNKNOWN_FIELD,
)
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.base.geometry import Pose
from mrlab_ros.core.physics import catalogue
from mrlab_ros.core.scene.diagnostics import NAMED_TWICE
from mrlab_ros.core.scene.document import RobotEntry, SceneDocument, parse, parse_cell, plain
from mrlab_ros.core.scene.surfaces import Surface

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
    ("text", "code", "values"),
    [
        ("robots: [{name: A}]", A_NAME, {}),
        ("cows: 1", UNKNOWN_FIELD, {"key": "cows"}),
        ("objects: [{name: a, type: cube, position: [0, 0]}]", COUNTED_NUMBERS, {"count": 3}),
        ("objects: [{name: a, type: cube, position: [0, 0, .nan]}]", FINITE_NUMBERS, {}),
        ("objects: [{name: a, type: cube}, {name: a, type: cube}]", NAMED_TWICE, {"name": "a"}),
        ("surfaces: [{name: a, vertices: [1, 2]}]", ROWS_OF_NUMBERS, {"columns": 3}),
        ("systems: [{name: s, mode: 7}]", ENTRY, {"one": "system"}),
        ("systems: [{name: s, mode: 7, members: [{robot: a}]}]", BAD_VALUE, {"found": "7"}),
        ("robots: [5]\nobjects: 7", MISTAKES, {"count": 2}),
        ("- 5", A_MAPPING, {}),
        ("", EMPTY_VALUE, {"what": "bad.yaml"}),
        ("[]", EMPTY_VALUE, {"what": "bad.yaml"}),
        ("5", BAD_VALUE, {"what": "bad.yaml", "found": "5"}),
        ("[", NOT_OF_FORMAT, {"format": "YAML"}),
        ("a: [1,\nb\n", NOT_OF_FORMAT, {"file": "bad.yaml", "line": 3}),
        ("\x00\x01", NOT_OF_FORMAT, {"file": "bad.yaml"}),
    ],
)
def test_scene_files_that_are_none_are_refused(tmp_path, text, code, values):
    (tmp_path / "bad.yaml").write_text(text)
    with refused(code, BadInput, **values):
        SceneFiles(ROOT, tmp_path).load("bad")


@pytest.mark.parametrize(
    ("name", "code"),
    [("../x", BAD_SCENE_NAME), ("", BAD_SCENE_NAME), ("A", BAD_SCENE_NAME), ("no_such", NO_SCENE)],
)
def test_scene_names_that_are_none_are_refused(tmp_path, name, code):
    with refused(code, BadInput):
        SceneFiles(tmp_path, tmp_path).load(name)


def test_a_folder_in_place_of_a_scene_and_a_folder_that_cannot_be_written(tmp_path):
    (tmp_path / "bad.yaml").mkdir()
    with refused(NOT_A_FILE, BadInput, file="bad.yaml", what="folder"):
        SceneFiles(SHIPPED, tmp_path).load("bad")
    (tmp_path / "file").write_text("")
    with refused(FILE_UNWRITABLE, BadInput):
        SceneFiles(SHIPPED, tmp_path / "file").save("mine", SceneDocument())


def test_a_number_with_an_exponent_is_a_number(tmp_path):
    path = tmp_path / "scene.yaml"
    path.write_text("robots: [{name: a, model: ur5e, position: [1e0, -2e-1, 0]}]")
    assert parse(content(path), path.name).robots[0].pose.position == (1.0, -0.2, 0.0)
