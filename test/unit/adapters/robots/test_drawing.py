"""Pictures, pages and glTF files of robots."""

from __future__ import annotations

import os
from pathlib import Path

import numpy as np
import pytest
import trimesh
from PIL import Image
from refusals import refused
from typer.testing import CliRunner

from mrlab_ros.adapters.robots import checks, drawing, sheet, urdf
from mrlab_ros.adapters.robots.diagnostics import (
    DOCUMENT_TYPE,
    ELEMENT_LACKS,
    FINITE_COUNT,
    JOINT_AXIS,
    LINK_CIRCLE,
    NOT_ASSEMBLED,
    NOT_URDF,
    NOT_XML,
    ROBOT_NO_LINK,
    ROBOT_NO_MESH,
    ROOT_LINKS,
    SHEET_FORMAT,
    STILL_XACRO,
    TWICE_IN_URDF,
)
from mrlab_ros.adapters.robots.drawing import Assembly
from mrlab_ros.adapters.robots.importing.robot import import_robot
from mrlab_ros.adapters.robots.library import RobotLibrary
from mrlab_ros.commands.robots import app
from mrlab_ros.core.base.diagnostic import Code
from mrlab_ros.core.base.errors import BadInput

ROBOTS = Path(__file__).resolve().parents[4] / "robots"
LIBRARY = RobotLibrary(ROBOTS, ROBOTS / "none imported")
ORANGE = (1.0, 0.467, 0.125)


def near(picture: Path, colour: tuple[float, float, float]) -> float:
    """Return the share of a picture's pixels whose hue is about that of `colour`, sRGB."""
    with Image.open(picture) as image:
        pixels = np.asarray(image.convert("RGB"), dtype=float).reshape(-1, 3)
    size = np.linalg.norm(pixels, axis=1) * np.linalg.norm(colour)
    return float((pixels @ np.array(colour) > 0.985 * np.maximum(size, 1)).mean())


@pytest.mark.slow
def test_a_picture_shows_the_robot_in_its_colour(tmp_path: Path) -> None:
    robot = drawing.bodies(LIBRARY, "kuka_kr6_r900_sixx")
    drawing.write(robot, tmp_path / "new" / "kr6.png")
    assert 0.03 < near(tmp_path / "new" / "kr6.png", ORANGE) < 0.5


def test_a_page_and_a_gltf_file_hold_the_robot_upright(tmp_path: Path) -> None:
    robot = drawing.bodies(LIBRARY, "ur5e", "vacuum_cup")
    _, high = trimesh.Scene(robot).bounds
    drawing.write(robot, tmp_path / "ur5e.glb")
    made = trimesh.load_scene(tmp_path / "ur5e.glb").bounds
    assert made[1, 1] == pytest.approx(high[2], abs=1e-6)
    assert made[0, 2] == pytest.approx(-high[1], abs=1e-6)
    drawing.write(robot, tmp_path / "ur5e.html")
    page = (tmp_path / "ur5e.html").read_text()
    assert "THREE" in page
    assert "src=" not in page.replace("srcdoc", "").split("<script>")[0]
    with refused(SHEET_FORMAT, BadInput, file="ur5e.gif"):
        drawing.write(robot, tmp_path / "ur5e.gif")


def test_joint_positions_count_and_hulls_are_larger() -> None:
    home = trimesh.Scene(drawing.bodies(LIBRARY, "ur5e")).bounds
    names = LIBRARY.model("ur5e").joint_names
    up = dict.fromkeys(names, 0.0) | {names[1]: -np.pi / 2}
    stretched = trimesh.Scene(drawing.bodies(LIBRARY, "ur5e", positions=up)).bounds
    assert stretched[1, 2] > 0.9 > home[1, 2]
    hulls = trimesh.Scene(drawing.bodies(LIBRARY, "ur5e", collision=True)).bounds
    assert np.abs(hulls - home).max() < 0.021


HULL = '<collision><geometry><box size="0.1 0.1 0.5"/></geometry></collision>'


@pytest.mark.parametrize(("hull", "high"), [(HULL, 0.65), ("", 0.4)])
def test_without_anything_to_see_hulls_are_drawn_and_else_bars(hull, high, tmp_path: Path) -> None:
    limit = '<limit lower="-1" upper="1" velocity="1" effort="1"/>'
    source = tmp_path / "bare.urdf"
    source.write_text(
        f'<robot name="bare"><link name="base"/><link name="arm">{hull}</link>'
        f'<joint name="turn" type="revolute"><parent link="base"/><child link="arm"/>'
        f'<origin xyz="0 0 0.4"/>{limit}</joint></robot>'
    )
    library = RobotLibrary(ROBOTS, tmp_path / "imported")
    assert not checks.errors(import_robot(source, "bare", library, {}).findings)
    parts = drawing.bodies(library, "bare")
    assert max(part.bounds[1, 2] for part in parts) == pytest.approx(high)
    for name in ("bare.png", "bare.html", "bare.glb"):
        drawing.write(parts, tmp_path / name)
    sheet.write(library, "bare", tmp_path / "sheet.html")


def test_colours_are_those_of_the_materials() -> None:
    plain = trimesh.creation.box()
    plain.visual.face_colors = (255, 0, 51, 255)
    assert drawing.colour(plain) == pytest.approx((1.0, 0.0, 0.2))
    shiny = trimesh.creation.box()
    # glTF's factors are linear: 0.216 is the middle of sRGB.
    material = trimesh.visual.material.PBRMaterial(baseColorFactor=[0.216, 0.0, 1.0, 1.0])
    shiny.visual = trimesh.visual.TextureVisuals(material=material)
    assert drawing.colour(shiny) == pytest.approx((0.5, 0.0, 1.0), abs=0.01)


def test_show_writes_what_its_options_say(tmp_path: Path) -> None:
    file = tmp_path / "arm.glb"
    arguments = ["show", "ur5e", "--joints", "0,-90,0,0,0,0", "--out", str(file), "--no-open"]
    done = CliRunner().invoke(app, arguments, env=dict(os.environ))
    assert done.exit_code == 0, done.output
    assert done.output.strip() == str(file)
    assert trimesh.load_scene(file).bounds[1, 1] > 0.9
    done = CliRunner().invoke(app, ["show", "ur5e", "--joints", "0,1", "--out", str(file)])
    assert done.exception.diagnostic.code == "bad_angles"


def test_show_without_out_prints_the_robot_and_writes_nothing(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    done = CliRunner().invoke(app, ["show", "ur5e"], env=dict(os.environ))
    assert done.exit_code == 0, done.output
    assert "Universal Robots UR5e" in done.output
    assert "shoulder_pan_joint" in done.output
    assert "payload 5 kg" in done.output
    assert not list(tmp_path.iterdir())


GRIPPER = """<?xml version="1.0" encoding="ISO-8859-1"?>
<robot name="gripper">
  <!-- made by hand -->
  <gazebo reference="palm"><material>Gazebo/Grey</material></gazebo>
  <link name="palm">
    <visual><origin xyz="0 0 0.1"/><geometry><box size="0.1 0.2 0.3"/></geometry>
      <material name="red"><color rgba="1 0 0 1"/></material></visual>
    <collision><geometry><sphere radius="0.2"/></geometry></collision>
  </link>
  <link name="left"><visual><geometry>
    <mesh filename="package://hand/finger.stl" scale="2 1 1"/></geometry></visual></link>
  <link name="right"/><link name="wheel"/>
  <joint name="slide" type="prismatic"><parent link="palm"/><child link="left"/>
    <axis xyz="0 2 0"/><limit lower="0" upper="0.1" velocity="1" effort="1"/></joint>
  <joint name="follow" type="prismatic"><parent link="palm"/><child link="right"/>
    <axis xyz="0 1 0"/><limit lower="-1" upper="1" velocity="1" effort="1"/>
    <mimic joint="slide" multiplier="-2" offset="0.01"/></joint>
  <joint name="spin" type="continuous"><parent link="palm"/><child link="wheel"/>
    <origin xyz="0 0 0.5" rpy="0 0 1.5707963267948966"/><axis xyz="0 0 3"/></joint>
  <transmission name="t"><joint name="slide"/></transmission>
</robot>"""


@pytest.fixture
def resolve(tmp_path: Path):
    trimesh.creation.box((0.02, 0.02, 0.02)).export(tmp_path / "finger.stl")

    def find(uri: str) -> Path:
        return tmp_path / Path(uri).name

    return find


def test_joints_move_and_followers_follow(resolve) -> None:
    robot = Assembly(urdf.parse(GRIPPER, "gripper.urdf"), "gripper.urdf", resolve)
    robot.move({"slide": 0.05, "spin": 0.5, "no joint of this one": 3.0})
    poses = robot.poses()
    assert poses["left"][:3, 3] == pytest.approx([0, 0.05, 0])
    assert poses["right"][:3, 3] == pytest.approx([0, -0.09, 0])
    turned = trimesh.transformations.rotation_matrix(np.pi / 2 + 0.5, [0, 0, 1])
    turned[2, 3] = 0.5
    np.testing.assert_allclose(poses["wheel"], turned, atol=1e-12)
    robot.move({"slide": 0.0})
    assert robot.poses()["right"][:3, 3] == pytest.approx([0, 0.01, 0])
    assert robot.poses()["wheel"] == pytest.approx(poses["wheel"])


def test_shapes_and_meshes_have_their_sizes_and_places(resolve) -> None:
    root = urdf.parse(GRIPPER, "gripper.urdf")
    robot = Assembly(root, "gripper.urdf", resolve)
    robot.move({"slide": 0.05})
    bounds = {
        link: mesh.copy().apply_transform(pose).bounds for link, mesh, pose in robot.meshes()
    }
    assert set(bounds) == {"palm", "left"}
    colours = {link: tuple(mesh.visual.main_color) for link, mesh, _ in robot.meshes()}
    assert colours["palm"] == (255, 0, 0, 255)
    np.testing.assert_allclose(bounds["palm"], [[-0.05, -0.1, -0.05], [0.05, 0.1, 0.25]])
    np.testing.assert_allclose(bounds["left"], [[-0.02, 0.04, -0.01], [0.02, 0.06, 0.01]])
    ((link, ball, _),) = Assembly(root, "gripper.urdf", resolve, collision=True).meshes()
    assert link == "palm"
    assert ball.volume == pytest.approx(4 / 3 * np.pi * 0.2**3, rel=0.02)


@pytest.mark.parametrize("tool", LIBRARY.end_effectors())
def test_the_whole_robot_agrees_with_the_chain(tool: str) -> None:
    model = LIBRARY.model("ur5e")
    robot = Assembly(urdf.parse(LIBRARY.description("ur5e", tool), "ur5e"), "ur5e")
    robot.move(dict(zip(model.joint_names, model.home, strict=True)))
    poses = robot.poses()
    for link, pose in model.chain.links(model.home).items():
        np.testing.assert_allclose(poses[link], pose, atol=1e-12)
    # Meshes are left out without a resolver; the adapter plate is a shape.
    assert [link for link, _, _ in robot.meshes()] == ["adapter_plate"]


@pytest.mark.parametrize(
    ("old", "new", "code", "values"),
    [
        ("finger.stl", "thumb.stl", ROBOT_NO_MESH, {"uri": "package://hand/thumb.stl"}),
        ('child link="right"', 'child link="thumb"', ROBOT_NO_LINK, {"link": "thumb"}),
        ('child link="right"', 'child link="left"', TWICE_IN_URDF, {"name": "left"}),
        (
            '<link name="wheel"/>',
            '<link name="wheel"/><link name="nut"/>',
            ROOT_LINKS,
            {"links": ["nut", "palm"]},
        ),
        (
            'parent link="palm"/><child link="left"',
            'parent link="left"/><child link="left"',
            LINK_CIRCLE,
            {"link": "left"},
        ),
        ('axis xyz="0 2 0"', 'axis xyz="0 0 0"', JOINT_AXIS, {"axis": "0 0 0"}),
        ('axis xyz="0 2 0"', 'axis xyz="0 nan 1"', FINITE_COUNT, {"count": 3}),
        ('radius="0.2"', 'radius="wide"', NOT_ASSEMBLED, {}),
        ('<box size="0.1 0.2 0.3"/>', "", NOT_ASSEMBLED, {}),
        (
            '<parent link="palm"/><child link="wheel"/>',
            "",
            ELEMENT_LACKS,
            {"name": "spin", "tag": "parent", "attribute": "link"},
        ),
    ],
)
def test_what_is_wrong_is_named(
    resolve, old: str, new: str, code: Code, values: dict[str, object]
) -> None:
    assert old in GRIPPER
    text = GRIPPER.replace(old, new)
    with refused(code, BadInput, **values):
        Assembly(urdf.parse(text, "g.urdf"), "g.urdf", resolve)


LAUGHS = "".join(f'<!ENTITY l{i + 1} "{f"&l{i};" * 10}">' for i in range(9))


@pytest.mark.parametrize(
    ("text", "code"),
    [
        (f'<!DOCTYPE robot [<!ENTITY l0 "ha">{LAUGHS}]><robot name="&l9;"/>', DOCUMENT_TYPE),
        (
            '<!DOCTYPE r [<!ENTITY f SYSTEM "file:///etc/passwd">]><robot>&f;</robot>',
            DOCUMENT_TYPE,
        ),
        ("<robot name='a'><link name='b'>", NOT_XML),
        ("<sdf/>", NOT_URDF),
        (
            '<robot xmlns:xacro="http://www.ros.org/wiki/xacro"><xacro:arm/></robot>',
            STILL_XACRO,
        ),
    ],
    ids=["billion_laughs", "external_entity", "damaged", "sdf", "xacro"],
)
def test_text_that_is_no_plain_urdf_is_refused(text: str, code: Code) -> None:
    with refused(code, BadInput):
        urdf.parse(text, "my.urdf")
