"""Folders of end effectors: what is wrong in one is named, wherever it is listed or taken."""

from __future__ import annotations

from pathlib import Path

import pytest

from mrlab_ros.adapters import share
from mrlab_ros.adapters.assets import documents
from mrlab_ros.adapters.assets.files import AssetFiles
from mrlab_ros.adapters.robots.library import RobotLibrary
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.physics.grasp import kinds

FACTS = """id: hook
name: Hook
class: magnet
gripper: magnet
force: 80.0
lip_radius: 0.02
"""
URDF = """<robot name="hook"><link name="hook_base"><inertial><mass value="0.3"/>
<inertia ixx="0.0002" ixy="0" ixz="0" iyy="0.0002" iyz="0" izz="0.0001"/></inertial></link>
<link name="hook_tcp"/><joint name="hook_end" type="fixed"><parent link="hook_base"/>
<child link="hook_tcp"/></joint></robot>"""


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    made = tmp_path / "end_effectors" / "hook"
    made.mkdir(parents=True)
    (made / "end_effector.yaml").write_text(FACTS)
    (made / "end_effector.urdf").write_text(URDF)
    return made


@pytest.fixture
def library(tmp_path: Path) -> RobotLibrary:
    return RobotLibrary(share.directory() / "robots", tmp_path)


def test_a_sound_one_is_listed_and_carried(folder: Path, library: RobotLibrary) -> None:
    sound, problems = library.sound_end_effectors()
    assert "hook" in sound
    assert problems == []
    assert "hook_base" in library.description("ur5e", "hook")
    assert library.gripper("ur5e", "hook") is kinds.MAGNET
    assert library.hand_facts("ur5e", "hook").lip_radius == 0.02


@pytest.mark.parametrize(
    ("file", "before", "after", "said"),
    [
        ("yaml", "gripper: magnet", "gripper: hook", ["gripper is 'hook'", "cup or magnet"]),
        ("yaml", "lip_radius: 0.02", "lip_radius: abc", ["lip_radius is 'abc'", "from 0 to 1"]),
        ("yaml", "lip_radius: 0.02", "", ["lip_radius is 0", "above 0"]),
        ("yaml", "force: 80.0", "force: -5", ["force is -5", "N"]),
        ("yaml", "force: 80.0", "forces: 80.0", ["'forces' is unknown", "force is missing"]),
        ("yaml", "id: hook", "id: other", ["id is 'other'", "expected hook"]),
        ("yaml", "class: magnet", "class: [", ["end_effector.yaml"]),
        ("yaml", "gripper: magnet", "gripper: fingers", ["No joint", "cup, magnet or none"]),
        ("urdf", 'value="0.3"', 'value="-1"', ["hook_base", "-1"]),
        ("urdf", "hook_tcp", "hook_end", ["no frame tcp", "hook_end"]),
        ("urdf", "hook_base", "base_link", ["base_link", "ur5e"]),
        ("urdf", "hook_base", "adapter_plate", ["adapter_plate", "the lab puts"]),
        ("urdf", '<child link="hook_tcp"/>', '<child link="away"/>', ["away"]),
        ("urdf", "</robot>", "", ["end_effector.urdf"]),
    ],
)  # fmt: skip
def test_what_is_wrong_is_named(
    folder: Path, library: RobotLibrary, file: str, before: str, after: str, said: list[str]
) -> None:
    path = folder / f"end_effector.{file}"
    assert before in path.read_text()
    path.write_text(path.read_text().replace(before, after))
    with pytest.raises(BadInput) as refusal:
        library.description("ur5e", "hook")
    for words in said:
        assert words in str(refusal.value)
    if "ur5e" in said:
        return  # another robot can carry it
    for take in (library.gripper, library.hand_facts):
        with pytest.raises(BadInput):
            take("ur5e", "hook")
    read = documents.robots(library, AssetFiles(share.directory(), library))
    assert "hook" not in [each["id"] for each in read["end_effectors"]]
    assert all("hook" not in robot["end_effectors"] for robot in read["robots"])
    (problem,) = read["problems"]
    assert "hook" in problem
