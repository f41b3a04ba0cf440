"""Bringing one's own URDF: what is taken, and what is refused in which words."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from pathlib import Path

import numpy as np
import pytest
import trimesh
from refusals import refused

from mrlab_ros.adapters.robots import checks, urdf
from mrlab_ros.adapters.robots.diagnostics import (
    DOCUMENT_TYPE,
    ELEMENT_UNNAMED,
    FINITE_COUNT,
    GEOMETRY_EMPTY,
    GEOMETRY_UNKNOWN,
    NAME_UNPRINTABLE,
    NO_SHARED_LINK,
    NO_ZERO,
    NOT_IMPORTED,
    NOT_OF_LIBRARY,
    NOT_XML,
    ROBOT_NO_MESH,
    SHAPE_LACKS,
    SIZES_ABOVE_ZERO,
    URDF_LINK,
)
from mrlab_ros.adapters.robots.importing.diagnostics import (
    BAD_ROBOT_ID,
    MESH_NO_PACKAGE,
    NO_DESCRIPTION,
    ROBOT_ID_TAKEN,
)
from mrlab_ros.adapters.robots.importing.robot import import_robot
from mrlab_ros.adapters.robots.importing.source import MeshFinder, find_description
from mrlab_ros.adapters.robots.library import RobotLibrary
from mrlab_ros.adapters.robots.vendor_meshes import remove, use_meshes
from mrlab_ros.core.base.diagnostic import Code
from mrlab_ros.core.base.diagnostics import BAD_VALUE, EMPTY_VALUE
from mrlab_ros.core.base.errors import BadInput

# Each file is read by a process of its own.
pytestmark = pytest.mark.slow

ROBOTS = Path(__file__).resolve().parents[5] / "robots"

KR6 = "kuka_kr6_r900_sixx"

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
    return {one.code for one in checks.check(text, "arm.urdf", find) if one.severity > 0}


def test_imported_robot_is_a_robot_of_the_lab(arm: Path, library: RobotLibrary) -> None:
    found = import_robot(arm, "mine", library, {"arm": arm.parent / "package"}).findings
    assert checks.errors(found) == ()
    assert "mine" in library.ids()
    model = library.model("mine")
    assert model.joint_names == ("one", "two")
    # Home is 0 where the limits allow it, else their middle.
    assert model.home == pytest.approx([0.0, 1.0])
    text = library.description("mine", "parallel_gripper")
    assert 'link="lower"' in text
    assert library.mesh_path("package://mrlab_ros/robots/mine/meshes/00_box.stl").is_file()


def test_what_other_programs_leave_in_a_description_is_passed_over(
    arm: Path, library: RobotLibrary
) -> None:
    nothing = '<visual><geometry><box size="0 0 0"/></geometry></visual>'
    sensor = '<gazebo><sensor:camera name="rgb"/><plugin xlink:href="x"/></gazebo>'
    text = ARM.replace('<link name="upper"/>', f'<link name="upper">{nothing}</link>')
    arm.write_text(text.replace("</robot>", f"{sensor}</robot>"))
    found = import_robot(arm, "mine", library, {"arm": arm.parent / "package"}).findings
    assert checks.errors(found) == ()
    assert "box" not in library.description("mine").replace("00_box.stl", "")


def test_missing_mesh_is_named(arm: Path, library: RobotLibrary) -> None:
    found = import_robot(arm, "mine", library, {}).findings
    (missing,) = checks.errors(found)
    assert missing.code == ROBOT_NO_MESH.code
    assert missing.values["why"].diagnostic.code == MESH_NO_PACKAGE.code
    assert "mine" not in library.ids()


@pytest.mark.parametrize(
    ("old", "new", "code"),
    [
        ('<limit lower="-1" upper="2" velocity="3" effort="4"/>', "", "robot_no_limits"),
        ('lower="-1" upper="2"', 'lower="2" upper="-1"', "robot_limits"),
        ('lower="-1" upper="2"', 'lower="-170" upper="170"', "robot_degrees"),
        ('upper="2" velocity="3"', 'upper="2" velocity="0"', "robot_velocity"),
        ('xyz="0.5 0 0"', 'xyz="500 0 0"', "robot_millimetres"),
        ('izz="0.01"', 'izz="1"', "robot_inertia"),
        ('mass value="1"', 'mass value="0"', "robot_mass"),
        ('mass value="1"', 'mass value="-1"', "robot_no_mass"),
        ('mass value="1"', 'mass value="1e300"', "robot_no_mass"),
        ("box.stl", "none.stl", "robot_no_mesh"),
        ('child link="lower"', 'child link="hand"', "robot_no_link"),
        ('type="revolute"', 'type="fixed"', "robot_joints"),
        ('box.stl"', 'box.stl" scale="1000 1000 1000"', "robot_millimetres"),
    ],
)
def test_what_is_wrong_is_found(arm: Path, old: str, new: str, code: str) -> None:
    assert old in ARM
    assert code in codes(ARM.replace(old, new), arm)


MESH = '<mesh filename="package://arm/box.stl"/>'


@pytest.mark.parametrize(
    ("old", "new", "code", "values"),
    [
        ('ixx="0.01"', 'ixx="a lot"', FINITE_COUNT, {"count": 1}),
        ('ixx="0.01"', 'ixx="a lot"', URDF_LINK, {"link": "base"}),
        ('mass value="1"', 'mass value="nan"', BAD_VALUE, {"found": "'nan'"}),
        ('box.stl"', 'box.stl" scale=""', FINITE_COUNT, {"count": 3}),
        ('box.stl"', 'box.stl" scale="1 0 1"', NO_ZERO, {}),
        (MESH, "<capsule/>", GEOMETRY_UNKNOWN, {"tag": "capsule"}),
        (MESH, "", GEOMETRY_EMPTY, {}),
        (MESH, '<box size="0.1 -0.1 0.1"/>', SIZES_ABOVE_ZERO, {"count": 3}),
        ('joint name="one"', "joint", ELEMENT_UNNAMED, {"parent": "base", "child": "upper"}),
        (MESH, "<mesh/>", SHAPE_LACKS, {"missing": ["filename"]}),
        ('<link name="upper"/>', "<link/>", ELEMENT_UNNAMED, {"element": "link"}),
        ("<link", "<!DOCTYPE robot><link", DOCUMENT_TYPE, {}),
        ('link name="upper"', 'link name="=1+1"', NAME_UNPRINTABLE, {"name": "=1+1"}),
        ('joint name="one"', 'joint name="a&#10;b"', NAME_UNPRINTABLE, {}),
    ],
)
def test_numbers_and_shapes_are_checked(
    arm: Path, old: str, new: str, code: Code, values: dict[str, object]
) -> None:
    assert old in ARM
    with refused(code, BadInput, **values):
        codes(ARM.replace(old, new), arm)


@pytest.mark.parametrize(
    ("name", "content"),
    [
        ("box.stl", b""),
        ("box.stl", b"not a mesh"),
        ("box.dae", b"<COLLADA></COLLADA>"),
        ("box.obj", b"v 1 2\nf 1 2 3\n"),
        ("box.glb", b"glTF"),
    ],
)
def test_a_mesh_that_cannot_be_read_is_refused(
    arm: Path, library: RobotLibrary, name: str, content: bytes
) -> None:
    (arm.parent / "package" / name).write_bytes(content)
    arm.write_text(ARM.replace("box.stl", name))
    found = checks.errors(
        import_robot(arm, "mine", library, {"arm": arm.parent / "package"}).findings
    )
    assert [one.code for one in found] == ["robot_mesh_unreadable"]
    assert found[0].values["uri"] == f"package://arm/{name}"
    assert "mine" not in library.ids()


def test_a_mesh_with_a_vertex_that_is_nowhere_is_refused(arm: Path) -> None:
    box = trimesh.creation.box((0.1, 0.2, 0.3))
    content = bytearray(trimesh.exchange.stl.export_stl(box))
    content[96:100] = np.float32(np.nan).tobytes()
    (arm.parent / "package" / "box.stl").write_bytes(content)
    assert "robot_mesh_unreadable" in codes(ARM, arm)


def test_a_robot_without_a_name_gets_its_id(arm: Path, library: RobotLibrary) -> None:
    arm.write_text(ARM.replace(' name="two_axis"', ""))
    import_robot(arm, "mine", library, {"arm": arm.parent / "package"})
    assert '<robot name="mine">' in library.description("mine")


@pytest.mark.parametrize(
    ("text", "code", "values"),
    [
        ("", EMPTY_VALUE, {"what": "arm.urdf"}),
        (ARM.replace("</inertial>", ""), NOT_XML, {"why": "mismatched tag", "line": 4}),
        (ARM.replace("</robot>", ""), NOT_XML, {"line": 11}),
    ],
)
def test_where_a_text_is_no_xml_is_shown(
    arm: Path, text: str, code: Code, values: dict[str, object]
) -> None:
    with refused(code, BadInput, **values):
        codes(text, arm)


def test_a_sound_urdf_has_no_findings(arm: Path) -> None:
    assert codes(ARM, arm) == set()


def test_ids_are_checked(arm: Path, library: RobotLibrary) -> None:
    with refused(BAD_ROBOT_ID, BadInput):
        import_robot(arm, "My Robot", library, {})
    with refused(ROBOT_ID_TAKEN, BadInput):
        import_robot(arm, "ur5e", library, {})


def test_sources_that_are_no_urdf_are_refused(tmp_path: Path) -> None:
    with refused(NO_DESCRIPTION, BadInput):
        find_description("no_such_package")
    with refused(NOT_XML, BadInput):
        checks.check("solid box", "box.stl", MeshFinder(tmp_path, {}))


@pytest.fixture
def vendor(tmp_path: Path) -> Path:
    """Return a vendor's URDF of a KR 6: the lab's own joints, a box a link."""
    root = urdf.parse((ROBOTS / KR6 / "robot.urdf").read_text(), KR6)
    (tmp_path / "vendor").mkdir()
    for link in root.iterfind("link"):
        for shape in [*link.findall("visual"), *link.findall("collision")]:
            link.remove(shape)
        if link.get("name") in ("base_link", "link_1", "link_6"):
            name = link.get("name")
            trimesh.creation.box((0.1, 0.1, 0.1)).export(tmp_path / "vendor" / f"{name}.stl")
            visual = ET.SubElement(link, "visual")
            ET.SubElement(visual, "origin", xyz="0 0 0.5")
            geometry = ET.SubElement(visual, "geometry")
            ET.SubElement(geometry, "mesh", filename=f"package://vendor/{name}.stl")
    path = tmp_path / "vendor.urdf"
    path.write_text(ET.tostring(root, encoding="unicode"))
    return path


def test_a_vendors_meshes_replace_ours_and_ours_come_back(
    vendor: Path, library: RobotLibrary
) -> None:
    before = library.description(KR6)
    found = use_meshes(vendor, KR6, library, {"vendor": vendor.parent / "vendor"})
    assert found == ()
    root = urdf.parse(library.description(KR6, "parallel_gripper"), KR6)
    link = next(one for one in root.iterfind("link") if one.get("name") == "link_1")
    (mesh,) = link.findall("visual/geometry/mesh")
    assert trimesh.load_mesh(library.mesh_path(str(mesh.get("filename")))).volume == pytest.approx(
        0.001
    )
    assert link.find("visual/origin").get("xyz") == "0 0 0.5"
    # Joints, masses and hulls are ours, and so is what the vendor has no mesh for.
    ours = urdf.parse(before, KR6)
    assert urdf.joints(ours, KR6) == urdf.joints(urdf.parse(library.description(KR6), KR6), KR6)
    assert len(link.findall("collision")) > 0
    assert library.collision_description(KR6).count("link_2_hull_0.stl") == 1
    assert library.ids().count(KR6) == 1
    remove(KR6, library)
    assert library.description(KR6) == before
    with refused(NOT_IMPORTED, BadInput):
        remove(KR6, library)


def test_meshes_of_another_geometry_are_refused(vendor: Path, library: RobotLibrary) -> None:
    root = urdf.parse(vendor.read_text(), KR6)
    origin = next(j for j in root.iterfind("joint") if j.get("name") == "joint_3").find("origin")
    x, y, z = (float(part) for part in origin.get("xyz").split())
    packages = {"vendor": vendor.parent / "vendor"}
    for shift, kept in ((0.00005, True), (0.0002, False)):
        origin.set("xyz", f"{x + shift} {y} {z}")
        vendor.write_text(ET.tostring(root, encoding="unicode"))
        found = use_meshes(vendor, KR6, library, packages)
        assert (checks.errors(found) == ()) is kept
        assert (library.imported / KR6).is_dir()
    assert [(one.code, one.where) for one in found] == [("robot_frame", "link link_6")]
    assert found[0].values["distance"] == pytest.approx(0.0002)
    with refused(NOT_OF_LIBRARY, BadInput):
        use_meshes(vendor, "mine", library, packages)
    vendor.write_text(ARM)
    with refused(NO_SHARED_LINK, BadInput):
        use_meshes(vendor, KR6, library, packages)
