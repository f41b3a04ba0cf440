"""Scenes as files: the shipped ones, saved ones, and files that are none."""

from __future__ import annotations

import errno
import json
import os
import re
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from refusals import refused

from mrlab_ros.adapters.diagnostics import (
    FILE_UNWRITABLE,
    NO_ROOM_ON_DISK,
    NOT_A_FILE,
    NOT_OF_FORMAT,
)
from mrlab_ros.adapters.robots.library import RobotLibrary
from mrlab_ros.adapters.scenes.diagnostics import BAD_SCENE_NAME, NO_SCENE
from mrlab_ros.adapters.scenes.files import SceneFiles, StateFile, content
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
from mrlab_ros.core.base.errors import BadInput, LabError
from mrlab_ros.core.base.geometry import Pose
from mrlab_ros.core.physics import catalogue
from mrlab_ros.core.scene.diagnostics import NAMED_TWICE
from mrlab_ros.core.scene.document import (
    MemberEntry,
    ObjectEntry,
    RobotEntry,
    SceneDocument,
    SystemEntry,
    parse,
    parse_cell,
    plain,
)
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


WAIT = "frame 0: object a free"
ROBOTS = (
    RobotEntry("ur5e_1", "ur5e", "", Pose((1.0, 0.0, 0.0)), "wave", 0.25, 2.0, True),
    RobotEntry("ur5e_2", "ur5e", "parallel_gripper", Pose((0.0, 2.0, 0.0))),
)
SCENE = SceneDocument(
    robots=ROBOTS,
    objects=(
        ObjectEntry("cube_1", "cube", Pose((0.5, 0.5, 0.5))),
        ObjectEntry("rod_1", "rod", Pose(), held_by="ur5e_2", in_hand=Pose((0.0, 0.0, 0.1))),
    ),
    surfaces=(
        Surface("table", "table", Pose(), np.eye(3), np.array([[0, 1, 2]], np.int32)),
    ),
    systems=(SystemEntry("cell", (MemberEntry("ur5e_2", "wave", 0.5, (WAIT,)),)),),
)  # fmt: skip


def make(path: Path | None, *, whole: bool = True) -> tuple[StateFile, list[str]]:
    log: list[str] = []
    return StateFile(path, log.append, whole=whole), log


def comparable(scene: SceneDocument) -> object:
    return plain(scene)


def test_what_was_saved_is_loaded_and_the_same_is_not_written_twice(tmp_path):
    file, log = make(tmp_path / "state" / "scene.json")
    assert file.load() is None
    assert file.save(SCENE)
    written = (tmp_path / "state" / "scene.json").stat().st_mtime_ns
    assert file.save(SCENE)
    assert (tmp_path / "state" / "scene.json").stat().st_mtime_ns == written
    again, _ = make(tmp_path / "state" / "scene.json")
    assert comparable(again.load()) == comparable(SCENE)
    assert [path.name for path in (tmp_path / "state").iterdir()] == ["scene.json"]
    assert log == []


def test_without_a_path_nothing_is_kept():
    file, log = make(None)
    assert file.load() is None
    assert file.save(SCENE)
    file.keep_copy("why")
    assert log == []


def test_the_list_of_robots_of_an_earlier_lab_is_read(tmp_path):
    path = tmp_path / "scene.json"
    path.write_text(json.dumps([
        {"name": "ur5e_1", "model": "ur5e", "end_effector": None, "position": [1, 0, 0],
         "orientation": [0, 0, 0, 1]},
    ]))  # fmt: skip
    file, log = make(path)
    assert file.load() == SceneDocument((RobotEntry("ur5e_1", "ur5e", "", Pose((1.0, 0, 0))),))
    assert log == []


def cut(path: Path) -> None:
    path.write_bytes(path.read_bytes()[:-40])


def folder(path: Path) -> None:
    path.unlink()
    path.mkdir()
    (path / "something").write_text("x")


def pipe(path: Path) -> None:
    path.unlink()
    os.mkfifo(path)


WHOLE = {
    "truncated": cut,
    "empty": lambda path: path.write_text(""),
    "an empty list": lambda path: path.write_text("[]"),
    "null alone": lambda path: path.write_text("null"),
    "a list of others": lambda path: path.write_text("[7, {}]"),
    "no JSON": lambda path: path.write_text("robots: []"),
    "binary": lambda path: path.write_bytes(bytes(range(256)) * 8),
    "a number": lambda path: path.write_text("7"),
    "a text": lambda path: path.write_text('"robots"'),
    "null": lambda path: path.write_text("null  x"),
    "deep": lambda path: path.write_text("[" * 100_000),
    "a folder": folder,
    "a pipe": pipe,
}


@pytest.mark.parametrize("damage", WHOLE.values(), ids=WHOLE)
def test_a_damaged_file_is_set_aside_and_named(tmp_path, damage):
    path = tmp_path / "scene.json"
    make(path)[0].save(SCENE)
    damage(path)
    file, log = make(path)
    assert file.load() is None
    (aside,) = tmp_path.iterdir()
    assert aside.name.startswith("scene.json.damaged-2")
    (said,) = log
    assert "scene.json" in said
    assert aside.name in said
    assert file.save(SCENE)
    assert comparable(make(path)[0].load()) == comparable(SCENE)


PARTIAL = [
    ("robots", 0, "model", 7, "robot 1: model is 7"),
    ("robots", 0, "position", [float("nan"), 0, 0], "robot 1: position is"),
    ("robots", 0, "position", [1e400, 0, 0], "robot 1: position is"),
    ("robots", 0, "orientation", [0, 0, 0, 0], "robot 1: .*unit quaternion"),
    ("robots", 0, "at", -1, "robot 1: at is -1"),
    ("robots", 0, "rate", 1e9, "robot 1: rate is"),
    ("robots", 0, "loop", "yes", "robot 1: loop is 'yes'"),
    ("robots", 0, "name", "ur5e_2", "names the robot ur5e_2 twice"),
    ("robots", 0, "name", "lab", "'lab' is a name of the lab's own"),
    ("objects", 1, "in_hand", None, "held_by and in_hand belong together"),
    ("objects", 1, "held_by", "ghost", "rod_1 names the robot 'ghost'"),
    ("surfaces", 0, "vertices", [[1, 2]], "surface 1: vertices is"),
    ("systems", 0, "members", [], "system 1: members is empty"),
    ("systems", 0, "mode", 9, "system 1: mode is 9"),
]


@pytest.mark.parametrize(("part", "entry", "key", "value", "says"), PARTIAL)
def test_one_bad_entry_leaves_only_that_one_out(tmp_path, part, entry, key, value, says):
    path = tmp_path / "scene.json"
    content = plain(SCENE)
    content[part][entry][key] = value
    path.write_text(json.dumps(content))
    file, log = make(path)
    scene = file.load()
    assert scene is not None
    (said,) = log
    assert re.search(says, said), said
    for other in ("robots", "objects", "surfaces", "systems"):
        lost = len(getattr(SCENE, other)) - len(getattr(scene, other))
        assert lost == (1 if other == part else 0)
    # The damaged file is still there to be looked into.
    assert len(list(tmp_path.glob("scene.json.damaged-*"))) == 1


def test_a_part_that_is_no_list_leaves_the_others(tmp_path):
    path = tmp_path / "scene.json"
    path.write_text(json.dumps({**plain(SCENE), "objects": 7, "cows": [1]}))
    file, log = make(path)
    scene = file.load()
    assert scene is not None
    assert (len(scene.robots), len(scene.objects), len(scene.systems)) == (2, 0, 1)
    assert "'cows' is unknown" in log[0]
    assert "objects is 7" in log[0]


def test_two_damaged_files_of_one_second_are_both_kept(tmp_path):
    path = tmp_path / "scene.json"
    for _ in range(3):
        path.write_text("{")
        assert make(path)[0].load() is None
    assert len(list(tmp_path.iterdir())) == 3


def test_a_folder_that_cannot_be_written_is_logged_once(tmp_path):
    (tmp_path / "file").write_text("")
    file, log = make(tmp_path / "file" / "scene.json")
    assert file.load() is None
    assert not file.save(SCENE)
    assert not file.save(SCENE)
    (said,) = log
    assert "cannot be written, a restart will not know" in said


def test_a_disk_without_room_is_found_before_anything_changes(tmp_path, monkeypatch):
    file = StateFile(tmp_path / "state" / "scene.json", lambda said: None, whole=True)
    file.check_room()
    assert list((tmp_path / "state").iterdir()) == []

    def full(*arguments):
        raise OSError(errno.ENOSPC, "No space left on device")

    monkeypatch.setattr(os, "posix_fallocate", full)
    with refused(NO_ROOM_ON_DISK, LabError):
        file.check_room()
    assert list((tmp_path / "state").iterdir()) == []
    StateFile(None, lambda said: None, whole=True).check_room()


@settings(max_examples=150, deadline=None)
@given(st.data())
@pytest.mark.slow
def test_no_mutation_of_the_bytes_raises_or_is_lost(tmp_path_factory, data):
    folder = tmp_path_factory.mktemp("state")
    path = folder / "scene.json"
    make(path)[0].save(SCENE)
    content = bytearray(path.read_bytes())
    for _ in range(data.draw(st.integers(1, 4))):
        where = data.draw(st.integers(0, len(content) - 1))
        size = data.draw(st.integers(0, 12))
        content[where : where + size] = data.draw(st.binary(max_size=12))
        if not content:
            break
    path.write_bytes(bytes(content))
    file, log = make(path)
    scene = file.load()
    asides = list(folder.glob("scene.json.damaged-*"))
    if log:
        assert [aside.read_bytes() for aside in asides] == [bytes(content)]
    else:
        assert not asides
        assert scene is not None


KEYS = (
    "robots objects surfaces systems about name model type position at rate loop members robot "
    "waits holds held_by in_hand vertices triangles mode policy"
)
JSON = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats() | st.text(max_size=8),
    lambda inner: (
        st.lists(inner, max_size=4)
        | st.dictionaries(st.sampled_from(KEYS.split()) | st.text(max_size=4), inner, max_size=5)
    ),
    max_leaves=25,
)


@settings(max_examples=150, deadline=None)
@given(JSON, st.booleans())
@pytest.mark.slow
def test_no_content_raises(tmp_path_factory, content, whole):
    path = tmp_path_factory.mktemp("state") / "scene.json"
    path.write_text(json.dumps(content))
    make(path, whole=whole)[0].load()
