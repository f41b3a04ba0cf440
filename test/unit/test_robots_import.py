"""Bringing one's own URDF: what is taken, and what is refused in which words."""

from __future__ import annotations

from pathlib import Path

import pytest
import trimesh

from mrlab_ros.adapters import robot_checks
from mrlab_ros.adapters.robot_import import MeshFinder, bring, find_urdf
from mrlab_ros.adapters.robot_library import RobotLibrary
from mrlab_ros.core.errors import BadInput

ROBOTS = Path(__file__).resolve().parents[2] / "robots"

ARM = """<robot name="two_axis">
  <link name="base"><visual><geometry><mesh filename="package://arm/box.stl"/></geometry></visual>
    <inertial><mass value="1"/>
      <inertia ixx="0.01" iyy="0.01" izz="0.01" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <link name="upper"/><link name="lower"/>
  <joint name="one" type="revolute"><parent link="base"/><child link="upper"/>
    <axis xyz="0 0 1"/><limit lower="-1" upper="2" velocity="3" effort="4"/></joint>
  <joint name="two" type="revolute"><parent link="upper"/><child link="lower"/>
    <origin xyz="0.5 0 0"/><axis xyz="0 1 0"/>
    <limit lower="0.5" upper="1.5" velocity="3" effort="4"/></joint>
</robot>"""


@pytest.fixture
def library(tmp_path: Path) -> RobotLibrary:
    return RobotLibrary(ROBOTS, tmp_path / "imported")


@pytest.fixture
def arm(tmp_path: Path) -> Path:
    """Return a URDF whose one mesh lies in package `arm`."""
    (tmp_path / "package").mkdir()
    trimesh.creation.box((0.1, 0.2, 0.3)).export(tmp_path / "package" / "box.stl")
    path = tmp_path / "two_axis.urdf"
    path.write_text(ARM)
    return path


def codes(text: str, arm: Path) -> set[str]:
    """Return the codes of the errors and warnings in a URDF text."""
    find = MeshFinder(arm.parent, {"arm": arm.parent / "package"})
    return {one.code for one in robot_checks.check(text, "arm.urdf", find) if one.severity > 0}


def test_imported_robot_is_a_robot_of_the_lab(arm: Path, library: RobotLibrary) -> None:
    found = bring(arm, "mine", library, {"arm": arm.parent / "package"})
    assert robot_checks.errors(found) == ()
    assert "mine" in library.ids()
    model = library.model("mine")
    assert model.joint_names == ("one", "two")
    # Home is 0 where the limits allow it, else their middle.
    assert model.home == pytest.approx([0.0, 1.0])
    text = library.description("mine", "parallel_gripper")
    assert 'link="lower"' in text
    assert library.mesh_path("package://mrlab_ros/robots/mine/meshes/00_box.stl").is_file()


def test_missing_mesh_is_named(arm: Path, library: RobotLibrary) -> None:
    found = bring(arm, "mine", library, {})
    assert "package 'arm' of mesh package://arm/box.stl" in robot_checks.errors(found)[0].message
    assert "mine" not in library.ids()


@pytest.mark.parametrize(
    ("old", "new", "code"),
    [
        ('<limit lower="-1" upper="2" velocity="3" effort="4"/>', "", "robot.no_limits"),
        ('lower="-1" upper="2"', 'lower="2" upper="-1"', "robot.limits"),
        ('lower="-1" upper="2"', 'lower="-170" upper="170"', "robot.degrees"),
        ('upper="2" velocity="3"', 'upper="2" velocity="0"', "robot.velocity"),
        ('xyz="0.5 0 0"', 'xyz="500 0 0"', "robot.millimetres"),
        ('izz="0.01"', 'izz="1"', "robot.inertia"),
        ('mass value="1"', 'mass value="0"', "robot.mass"),
        ("box.stl", "none.stl", "robot.no_mesh"),
        ('child link="lower"', 'child link="hand"', "robot.no_link"),
        ('type="revolute"', 'type="fixed"', "robot.joints"),
        ('box.stl"', 'box.stl" scale="1000 1000 1000"', "robot.millimetres"),
    ],
)
def test_what_is_wrong_is_found(arm: Path, old: str, new: str, code: str) -> None:
    assert old in ARM
    assert code in codes(ARM.replace(old, new), arm)


def test_a_sound_urdf_has_no_findings(arm: Path) -> None:
    assert codes(ARM, arm) == set()


def test_ids_are_checked(arm: Path, library: RobotLibrary) -> None:
    with pytest.raises(BadInput, match="expected small letters"):
        bring(arm, "My Robot", library, {})
    with pytest.raises(BadInput, match="a robot 'ur5e' already"):
        bring(arm, "ur5e", library, {})


def test_sources_that_are_no_urdf_are_refused(tmp_path: Path) -> None:
    with pytest.raises(BadInput, match="neither a file nor an installed ROS package"):
        find_urdf("no_such_package")
    (tmp_path / "arm.xacro").write_text("")
    with pytest.raises(BadInput, match=r"run `xacro arm\.xacro"):
        find_urdf(str(tmp_path / "arm.xacro"))
    with pytest.raises(BadInput, match="is not XML"):
        robot_checks.check("solid box", "box.stl", MeshFinder(tmp_path, {}))
