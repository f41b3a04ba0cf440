"""An imported robot with a hand of its own picks a cube: fingers that mimic, 0 is closed."""

from __future__ import annotations

import json
import math
from pathlib import Path

import pytest
from in_process import mrlab
from physics_cell import JOINTS, ROOT, Cell, gantry
from refusals import refused

from mrlab_ros.adapters.robots import checks
from mrlab_ros.adapters.robots.importing.diagnostics import NO_ARM_THERE, ROBOT_ID_TAKEN
from mrlab_ros.adapters.robots.importing.end_effector import import_end_effector
from mrlab_ros.adapters.robots.importing.robot import Face, import_robot
from mrlab_ros.adapters.robots.library import RobotLibrary
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.base.geometry import Pose
from mrlab_ros.core.physics.grasp import kinds
from mrlab_ros.core.physics.grasp.states import Grasp

# m: height of the shoulder, length of both arms, from the wrist to the middle of the pads.
SHOULDER, ARM, GRIP = 0.3, 0.4, 0.13


def link(name: str, size: str, at: str) -> str:
    return f"""<link name="{name}"><inertial><mass value="2"/><inertia ixx="0.01" iyy="0.01"
      izz="0.01" ixy="0" ixz="0" iyz="0"/></inertial><collision><origin xyz="{at}"/><geometry>
      <box size="{size}"/></geometry></collision></link>"""


def joint(name: str, kind: str, parent: str, child: str, at: str, axis: str, more: str) -> str:
    return f"""<joint name="{name}" type="{kind}"><parent link="{parent}"/><child link="{child}"/>
      <origin xyz="{at}"/><axis xyz="{axis}"/>{more}</joint>"""


TURN = '<limit lower="-3.1" upper="3.1" velocity="3" effort="90"/>'
SLIDE = '<limit lower="0" upper="0.04" velocity="0.1" effort="40"/>'
ROBOT = "".join([
    '<robot name="own">',
    link("base", "0.1 0.1 0.1", "0 0 0.05"), link("tower", "0.06 0.06 0.1", "0 0 -0.06"),
    link("upper", "0.05 0.05 0.3", "0 0 0.2"), link("fore", "0.05 0.05 0.28", "0 0 0.2"),
    link("palm", "0.04 0.12 0.03", "0 0 0.06"),
    link("left", "0.02 0.01 0.06", "0 0.005 0.03"),
    link("right", "0.02 0.01 0.06", "0 -0.005 0.03"),
    joint("turn", "revolute", "base", "tower", f"0 0 {SHOULDER}", "0 0 1", TURN),
    joint("shoulder", "revolute", "tower", "upper", "0 0 0", "0 1 0", TURN),
    joint("elbow", "revolute", "upper", "fore", f"0 0 {ARM}", "0 1 0", TURN),
    joint("wrist", "revolute", "fore", "palm", f"0 0 {ARM}", "0 1 0", TURN),
    joint("finger_1", "prismatic", "palm", "left", "0 0 0.09", "0 1 0", SLIDE),
    joint("finger_2", "prismatic", "palm", "right", "0 0 0.09", "0 -1 0",
          SLIDE + '<mimic joint="finger_1" multiplier="1" offset="0"/>'),
    "</robot>",
])  # fmt: skip


def reach(x: float, y: float, z: float) -> tuple[float, ...]:
    """Return the joints that hold the pads at a place, pointing down."""
    across, up = math.hypot(x, y), z + GRIP - SHOULDER
    bend = math.acos((across**2 + up**2 - 2 * ARM**2) / (2 * ARM**2))
    lift = math.atan2(across, up) - math.atan2(ARM * math.sin(bend), ARM + ARM * math.cos(bend))
    return (math.atan2(y, x), lift, bend, math.pi - lift - bend)


def blocks(language: str) -> list[str]:
    """Return the blocks of the docs' section on a tool of one's own."""
    text = (ROOT / "docs" / "robots.md").read_text(encoding="utf-8")
    section = text.partition("### A tool of your own")[2].partition("\n## ")[0]
    return [part.partition("```")[0] for part in section.split(f"```{language}\n")[1:]]


def test_a_magnet_made_by_the_docs_lifts_a_carton(tmp_path: Path):
    folder = tmp_path / "end_effectors" / "magnet"
    folder.mkdir(parents=True)
    (folder / "end_effector.yaml").write_text(*blocks("yaml"))
    (folder / "end_effector.urdf").write_text(*blocks("xml"))
    library = gantry(tmp_path)
    assert "magnet" in library.end_effectors()
    cell = Cell(library)
    carton = cell.put("carton", (0.0, 0.0, 0.1))
    text, tool = library.description("gantry", "magnet"), library.hand_facts("gantry", "magnet")
    top = cell.world.object(carton).type.size[2] + 0.012 + 0.06
    at = (0.0, 0.0, top + 0.05, 0.0, 0.0)
    cell.join("a", text, JOINTS, at, library.gripper("gantry", "magnet"), tool)
    cell.go("a", (0.0, 0.0, top - 0.001), 0.4)
    cell.close("a", 0.8)
    cell.go("a", (0.0, 0.0, top + 0.3), 0.6)
    assert cell.grasps("a") == [Grasp.OPEN, Grasp.CLOSING, Grasp.HOLDING]
    assert cell.place(carton)[2] > 0.3
    assert not cell.hits()


def test_an_imported_arm_says_that_it_holds_with_a_cup(tmp_path: Path):
    source = tmp_path / "own.urdf"
    source.write_text(ROBOT.partition('<joint name="finger_1"')[0] + "</robot>")
    text = source.read_text()
    for link_name in ("left", "right"):
        start = text.index(f'<link name="{link_name}"')
        text = text[:start] + text[text.index("</link>", start) + len("</link>") :]
    source.write_text(text)
    library = RobotLibrary(ROOT / "robots", tmp_path / "imported")
    found = import_robot(source, "own", library, {}, face=Face("cup", 40.0, 0.01)).findings
    assert checks.errors(found) == ()
    assert library.gripper("own", "") is kinds.CUP
    cell = Cell(library)
    carton = cell.put("carton", (0.5, 0.0, 0.0))
    height = cell.world.object(carton).type.size[2]
    cell.world.move(
        carton, Pose((0.5, 0.0, height / 2)), (0.0, 0.0, 0.0), (0.0, 0.0, 0.0), held=False
    )
    # The pads' place is 55 mm ahead of the palm's face.
    above = reach(0.5, 0.0, height - 0.055 + 0.05)
    names = library.model("own").joint_names
    tool = library.hand_facts("own", "")
    cell.join("a", library.description("own"), names, above, library.gripper("own", ""), tool)
    cell.go("a", reach(0.5, 0.0, height - 0.055 - 0.001), 0.5)
    cell.close("a", 0.8)
    cell.go("a", above, 0.5)
    assert cell.grasps("a") == [Grasp.OPEN, Grasp.CLOSING, Grasp.HOLDING]
    assert cell.place(carton)[2] > height / 2 + 0.04


def test_an_imported_hand_picks_a_cube_and_sets_it_down(tmp_path: Path):
    source = tmp_path / "own.urdf"
    source.write_text(ROBOT)
    library = RobotLibrary(ROOT / "robots", tmp_path / "imported")
    found = import_robot(source, "own", library, {}).findings
    assert checks.errors(found) == ()
    assert library.hand("own") == {"finger_1", "finger_2"}
    model = library.model("own")
    cell = Cell(library)
    cube = cell.put("cube", (0.5, 0.0, 0.025))
    tool = library.hand_facts("own", "")
    above = reach(0.5, 0.0, 0.15)
    cell.join("a", library.description("own"), model.joint_names, above, kinds.FINGERS, tool)
    cell.wait(0.1)
    for position in cell.world.fingers("a").values():
        assert abs(position) == pytest.approx(0.04, abs=1e-4), "it begins open"
    cell.go("a", reach(0.5, 0.0, 0.025), 0.5)
    cell.close("a", 0.8)
    cell.go("a", above, 0.5)
    assert cell.grasps("a") == [Grasp.OPEN, Grasp.CLOSING, Grasp.HOLDING]
    assert cell.place(cube)[2] > 0.13
    # One finger follows the other, and each is where the cube's side is.
    one, two = cell.world.fingers("a").values()
    assert one == pytest.approx(two, abs=1e-6)
    assert cell.world.robot("a").holding.load.payload == 0.0
    cell.go("a", reach(0.4, 0.3, 0.15), 0.6)
    cell.go("a", reach(0.4, 0.3, 0.026), 0.5)
    cell.open("a", 0.4)
    cell.go("a", reach(0.4, 0.3, 0.15), 0.5)
    assert not cell.hits()
    assert cell.place(cube) == pytest.approx((0.4, 0.3, 0.025), abs=0.004)
    cell.engine.close()


PINCH = """<robot name="pinch">
  <link name="base_link">{inertial}<collision><origin xyz="0 0 0.03"/>
    <geometry><box size="0.04 0.12 0.06"/></geometry></collision></link>
  <link name="left">{inertial}<collision><origin xyz="0 0 0.03"/>
    <geometry><box size="0.02 0.01 0.06"/></geometry></collision></link>
  <link name="right">{inertial}<collision><origin xyz="0 0 0.03"/>
    <geometry><box size="0.02 0.01 0.06"/></geometry></collision></link>
  <joint name="slide" type="prismatic"><parent link="base_link"/><child link="left"/>
    <origin xyz="0 0.005 0.065"/><axis xyz="0 1 0"/>
    <limit lower="0" upper="0.045" velocity="0.1" effort="40"/></joint>
  <joint name="follow" type="prismatic"><parent link="base_link"/><child link="right"/>
    <origin xyz="0 -0.005 0.065"/><axis xyz="0 -1 0"/>
    <limit lower="0" upper="0.045" velocity="0.1" effort="40"/><mimic joint="slide"/></joint>
</robot>""".format(
    inertial='<inertial><mass value="0.1"/><inertia ixx="0.0001" ixy="0" ixz="0" iyy="0.0001" '
    'iyz="0" izz="0.0001"/></inertial>'
)


def test_a_hand_alone_is_imported_by_a_command(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setenv("MRLAB_ROBOTS", str(tmp_path))
    source = tmp_path / "pinch.urdf"
    source.write_text(PINCH)
    for wrong in (("--force", "nan"), ("--speed", "inf"), ("--tip", "left"), ("--id", "../x")):
        assert mrlab("robots", "import", source, "--as-tool", *wrong).returncode
    assert not list(tmp_path.glob("end_effectors/*"))
    done = mrlab("robots", "import", source, "--as-tool", "--json")
    assert json.loads(done.stdout)["hand"] == ["pinch_slide", "pinch_follow"]
    assert RobotLibrary(ROOT / "robots").gripper("ur5e", "pinch") is kinds.FINGERS


def test_a_hand_alone_comes_in_as_an_end_effector_and_picks_a_cube(tmp_path: Path):
    source = tmp_path / "pinch.urdf"
    source.write_text(PINCH)
    library = gantry(tmp_path)
    with refused(NO_ARM_THERE, BadInput):
        import_robot(source, "pinch", library, {})
    done = import_end_effector(source, "pinch", library, {})
    assert not checks.errors(done.findings)
    # It opens to its upper limit: turned round.
    assert [(f.name, f.lower, f.upper, f.flipped) for f in done.fingers] == [
        ("pinch_slide", -0.045, 0.0, True),
        ("pinch_follow", -0.045, 0.0, True),
    ]
    assert library.gripper("gantry", "pinch") is kinds.FINGERS
    # The robot has a link of the same name as the hand.
    assert "pinch_base_link" in library.description("ur5e", "pinch")
    # It was made to hang from its flange, which the root's z points out of.
    turned = PINCH.replace("0 0.005 0.065", "0 0.005 -0.065").replace("0 -0.005 0.065", "0 0 -0.1")
    (tmp_path / "hanging.urdf").write_text(turned)
    found = import_end_effector(tmp_path / "hanging.urdf", "hanging", library, {}).findings
    assert [one.values["behind"] for one in found if one.code == "hand_backwards"] == [
        pytest.approx(0.0825, abs=1e-4)
    ]
    with refused(ROBOT_ID_TAKEN, BadInput, robot="pinch"):
        import_end_effector(source, "pinch", library, {})
    cell = Cell(library)
    cube = cell.put("cube", (0.0, 0.0, 0.025))
    # The ends of its fingers stay a centimetre above the floor.
    pads = 0.012 + 0.065 + 0.045
    cell.add("a", "pinch", at=(0.0, 0.0, 0.025 + pads + 0.15))
    cell.go("a", (0.0, 0.0, 0.025 + pads), 0.5)
    cell.close("a", 0.9)
    cell.go("a", (0.0, 0.0, 0.025 + pads + 0.15), 0.5)
    assert cell.grasps("a") == [Grasp.OPEN, Grasp.CLOSING, Grasp.HOLDING]
    assert cell.place(cube)[2] == pytest.approx(0.175, abs=0.002)
    assert not cell.hits()


IDLE = """<link name="{name}"/><joint name="{name}" type="prismatic"><parent link="base_link"/>
  <child link="{name}"/><axis xyz="0 1 0"/><origin xyz="0.1 0 0"/>
  <limit lower="0" upper="0.045" velocity="0.1" effort="40"/><mimic joint="slide"/></joint>"""


def test_joints_of_a_linkage_that_touch_nothing_push_no_finger_into_what_it_holds(tmp_path: Path):
    source = tmp_path / "linkage.urdf"
    idle = "".join(IDLE.format(name=f"idle_{i}") for i in range(4))
    source.write_text(PINCH.replace("</robot>", f"{idle}</robot>"))
    library = gantry(tmp_path)
    import_end_effector(source, "linkage", library, {})
    cell = Cell(library)
    cube = cell.put("cube", (0.0, 0.002, 0.025))
    cell.add("a", "linkage", at=(0.0, 0.0, 0.147))
    cell.close("a", 0.0)
    furthest = -0.045
    for _ in range(150):
        cell.wait(0.01)
        furthest = max(furthest, *cell.world.fingers("a").values())
    assert cell.grasps("a")[-1] is Grasp.HOLDING
    # The cube is 50 mm wide.
    assert furthest == pytest.approx(-0.025, abs=0.001)
    assert cell.place(cube) == pytest.approx((0.0, 0.0, 0.025), abs=0.002)
    cell.engine.close()
