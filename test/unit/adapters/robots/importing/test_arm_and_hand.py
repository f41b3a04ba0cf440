"""Telling a robot's arm from its hand, and open from closed."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from pathlib import Path

import numpy as np
import pytest
from refusals import refused

from mrlab_ros.adapters.robots import urdf
from mrlab_ros.adapters.robots.diagnostics import (
    HAND_OF_ITS_OWN,
    LINK_CIRCLE,
    NAME_TOO_LONG,
    NO_LINK_IN_FILE,
    TOO_MANY_LINKS,
    TWICE_IN_URDF,
)
from mrlab_ros.adapters.robots.importing.arm_and_hand import Finger, Groups, Split, fingers, split
from mrlab_ros.adapters.robots.importing.diagnostics import (
    ARM_MIMICS,
    ARMS_BRANCH,
    BAD_XACRO_ARGUMENT,
    HAND_LIMITS,
    NO_ARM_THERE,
    PACKAGE_DESCRIPTIONS,
    TIP_OF_GROUP,
    XACRO_REFUSED,
)
from mrlab_ros.adapters.robots.importing.robot import import_robot
from mrlab_ros.adapters.robots.importing.source import find_description
from mrlab_ros.adapters.robots.library import RobotLibrary
from mrlab_ros.core.base.diagnostic import Code
from mrlab_ros.core.base.errors import BadInput

# Each file is read by a process of its own.
pytestmark = pytest.mark.slow

ROBOTS = Path(__file__).resolve().parents[5] / "robots"
Y = "0 1 0"


def joint(name: str, parent: str, child: str, kind: str = "revolute", more: str = "") -> str:
    """Return a joint that turns about y between -1 and 2; `more` replaces its axis and limits."""
    limits = f'<axis xyz="{Y}"/><limit lower="-1" upper="2" velocity="3" effort="4"/>'
    inside = more if more or kind == "fixed" else limits
    return (
        f'<joint name="{name}" type="{kind}"><parent link="{parent}"/><child link="{child}"/>'
        f'<origin xyz="0 0 0.2"/>{inside}</joint>'
    )


def slide(name: str, child: str, y: float, axis: str, limits: str, more: str = "") -> str:
    """Return a sliding finger at `y` on the palm."""
    return (
        f'<joint name="{name}" type="prismatic"><parent link="palm"/><child link="{child}"/>'
        f'<origin xyz="0 {y} 0.1"/><axis xyz="{axis}"/><limit {limits} velocity="0.1" effort="5"/>'
        f"{more}</joint>"
    )


def robot(*joints: str) -> ET.Element:
    """Return a robot with these joints and the links that they name."""
    text = "".join(joints)
    root = ET.fromstring(f'<robot name="tried">{text}</robot>')
    names = {str(e.get("link")) for tag in ("parent", "child") for e in root.iter(tag)}
    for name in sorted(names, reverse=True):
        root.insert(0, ET.Element("link", name=name))
    return root


def arm(count: int, last: str = "palm") -> list[str]:
    links = ["base", *(f"link_{i}" for i in range(1, count)), last]
    return [joint(f"axis_{i + 1}", links[i], links[i + 1]) for i in range(count)]


# As most grippers have it: 0 is closed, the upper limit open.
OPENING = 'lower="0" upper="0.04"'
TWO_FINGERS = (
    slide("finger_1", "left", 0.0, Y, OPENING),
    slide("finger_2", "right", 0.0, "0 -1 0", OPENING, '<mimic joint="finger_1"/>'),
)


def names(parts: Split) -> tuple[list[str], list[str]]:
    return [j.name for j in parts.arm], [j.name for j in parts.hand]


def test_seven_joints_and_two_fingers_are_an_arm_and_a_hand() -> None:
    parts = split(robot(*arm(7), *TWO_FINGERS), "tried")
    assert names(parts) == ([f"axis_{i}" for i in range(1, 8)], ["finger_1", "finger_2"])
    assert parts.tip == "palm"
    assert parts.still == ()


def test_a_tool_frame_is_the_tip() -> None:
    frames = (joint("a", "palm", "camera", "fixed"), joint("b", "palm", "hand_tcp", "fixed"))
    assert split(robot(*arm(6), *frames), "tried").tip == "hand_tcp"
    flange = (joint("a", "palm", "flange", "fixed"), joint("b", "flange", "tool0", "fixed"))
    assert split(robot(*arm(6), *flange), "tried").tip == "tool0"
    assert split(robot(*arm(6), *flange), "tried", tip="flange").tip == "flange"


def test_a_jaw_at_the_end_of_the_chain_is_the_hand() -> None:
    jaw = joint("jaw_joint", "palm", "moving_jaw")
    assert names(split(robot(*arm(5), jaw), "tried"))[1] == ["jaw_joint"]
    # Also behind a fixed joint of the gripper.
    base = joint("gripper_base", "palm", "gripper", "fixed")
    jaw = joint("drive", "gripper", "knuckle")
    assert names(split(robot(*arm(5), base, jaw), "tried"))[1] == ["drive"]


def test_five_fingers_of_any_name_are_a_hand() -> None:
    chains = [
        joint(f"J{finger}{k}", f"f{finger}{k - 1}" if k else "palm", f"f{finger}{k}")
        for finger in range(5)
        for k in range(4)
    ]
    parts = split(robot(*arm(6), *chains), "tried")
    assert (len(parts.arm), len(parts.hand)) == (6, 20)
    # A torso that branches into longer chains than its own is asked about.
    with refused(ARMS_BRANCH, BadInput, first=4, second=4):
        split(robot(*arm(2), *chains), "tried")


def test_a_wrist_that_turns_a_link_named_gripper_is_of_the_arm() -> None:
    jaw = joint("jaw", "gripper_link", "moving_jaw")
    parts = split(robot(*arm(5, last="gripper_link"), jaw), "tried")
    assert names(parts) == ([f"axis_{i}" for i in range(1, 6)], ["jaw"])
    # Where nothing moves in it, it is the hand itself.
    assert names(split(robot(*arm(5, last="gripper_link")), "tried"))[1] == ["axis_5"]


def test_a_gear_that_turns_endlessly_in_a_hand_stands_still() -> None:
    gear = joint("gripper", "palm", "propeller", "continuous", f'<axis xyz="{Y}"/>')
    parts = split(robot(*arm(6), gear, *TWO_FINGERS), "tried")
    assert names(parts)[1] == ["finger_1", "finger_2"]
    assert [j.name for j in parts.still] == ["gripper"]
    assert [f.name for f in fingers(parts.below, {}, "tried")] == ["finger_1", "finger_2"]
    with refused(HAND_LIMITS, BadInput, joint="gripper", lower=0.0, upper=0.0):
        hand_of(gear)


def test_a_slide_at_the_end_of_an_arm_is_its_last_axis() -> None:
    quill = (
        '<joint name="quill" type="prismatic"><parent link="palm"/><child link="flange"/>'
        '<axis xyz="0 0 1"/><limit lower="0" upper="0.2" velocity="1" effort="4"/></joint>'
    )
    assert names(split(robot(*arm(3), quill), "tried")) == (
        ["axis_1", "axis_2", "axis_3", "quill"],
        [],
    )


def test_what_hangs_beside_the_arm_stands_still() -> None:
    wheel = joint("wheel", "base", "tyre")
    parts = split(robot(*arm(6), wheel), "tried")
    assert len(parts.arm) == 6
    assert [j.name for j in parts.still] == ["wheel"]


def test_two_arms_are_asked_about() -> None:
    left = [joint(f"left_{i}", f"l{i}" if i else "base", f"l{i + 1}") for i in range(6)]
    right = [joint(f"right_{i}", f"r{i}" if i else "base", f"r{i + 1}") for i in range(6)]
    both = robot(*left, *right)
    with refused(ARMS_BRANCH, BadInput, first=6, second=6, tip="l6"):
        split(both, "tried")
    parts = split(both, "tried", tip="r6")
    assert names(parts)[0] == [f"right_{i}" for i in range(6)]
    assert len(parts.still) == 6


def test_a_gripper_alone_is_no_arm() -> None:
    with refused(NO_ARM_THERE, BadInput, link="palm"):
        split(robot(*TWO_FINGERS), "tried")
    with refused(NO_LINK_IN_FILE, BadInput, link="nowhere"):
        split(robot(*arm(2)), "tried", tip="nowhere")


def test_the_groups_of_an_srdf_name_the_arm() -> None:
    srdf = """<robot name="tried">
      <group name="short"><chain base_link="base" tip_link="link_2"/></group>
      <group name="manipulator"><chain base_link="base" tip_link="link_4"/></group>
      <group name="hand"><chain base_link="link_4" tip_link="palm"/></group>
      <end_effector name="hand" parent_link="link_4" group="hand"/></robot>"""
    parts = split(robot(*arm(6)), "tried", groups=Groups(srdf, "tried.srdf"))
    assert parts.tip == "link_4"
    assert names(parts) == ([f"axis_{i}" for i in range(1, 5)], ["axis_5", "axis_6"])
    assert parts.why == TIP_OF_GROUP(group="manipulator")


def test_an_arm_joint_that_mimics_is_refused() -> None:
    passive = joint("rod", "palm", "end", more=f'<axis xyz="{Y}"/><mimic joint="axis_1"/>')
    with refused(ARM_MIMICS, BadInput, joint="rod", other="axis_1"):
        split(robot(*arm(4), passive), "tried")


def hand_of(*joints: str) -> dict[str, Finger]:
    parts = split(robot(*arm(6), *joints), "tried")
    return {f.name: f for f in fingers(parts.below, {}, "tried")}


def test_fingers_close_from_the_lower_to_the_upper_limit() -> None:
    found = hand_of(*TWO_FINGERS)
    for finger in found.values():
        assert (finger.lower, finger.upper) == (-0.04, 0.0)
        assert finger.flipped
    follower = found["finger_2"]
    assert (follower.mimics, follower.multiplier, follower.offset) == ("finger_1", 1.0, 0.0)


def test_fingers_that_close_upwards_stay_as_they_are() -> None:
    closing = 'lower="0" upper="0.04"'
    found = hand_of(
        slide("finger_1", "left", -0.05, Y, closing),
        slide("finger_2", "right", 0.05, "0 -1 0", closing),
    )
    assert not any(f.flipped for f in found.values())
    assert [(f.lower, f.upper) for f in found.values()] == [(0.0, 0.04)] * 2


def test_fingers_side_by_side_close_towards_the_palm_and_the_thumb() -> None:
    """Bending one of them alone takes its end away from those of the others."""
    sway = '<axis xyz="1 0 0"/><limit lower="-0.5" upper="0.5" velocity="3" effort="4"/>'
    bends = '<axis xyz="{}"/><limit lower="{}" upper="{}" velocity="3" effort="4"/>'

    def finger(name: str, x: float, y: float, *bent: object) -> list[str]:
        bend = bends.format(*bent)
        made = (
            joint(f"{name}_sway", "palm", f"{name}_1", more=sway),
            joint(f"{name}_root", f"{name}_1", f"{name}_2", more=bend),
            joint(f"{name}_bend", f"{name}_2", f"{name}_end", more=bend),
            joint(f"{name}_nail", f"{name}_end", f"{name}_nail", "fixed"),
        )
        return [made[0].replace("0 0 0.2", f"{x} {y} 0.1"), *made[1:]]

    inwards, backwards, thumb = (Y, -0.3, 1.6), ("0 -1 0", -1.6, 0.3), ("0 -1 0", -0.3, 1.6)
    row = [*finger("a", -0.2, -0.1, *inwards), *finger("b", -0.2, 0.0, *inwards)]
    row += [*finger("c", -0.2, 0.1, *backwards), *finger("d", 0.2, 0, *thumb)]
    palm = robot(*arm(6), *row)
    parts = split(palm, "tried")
    assert [j.name for j in parts.still] == [f"{name}_sway" for name in "abcd"]
    centres = {f"{name}_end": np.array([0.0, 0.0, 0.1]) for name in "abcd"}
    found = {f.name: f.flipped for f in fingers(parts.below, centres, "tried")}
    assert found == {
        **dict.fromkeys(["a_root", "a_bend", "b_root", "b_bend"], False),
        **dict.fromkeys(["c_root", "c_bend"], True),
        **dict.fromkeys(["d_root", "d_bend"], False),
    }


def test_multiplier_and_offset_of_a_chain_of_mimics() -> None:
    """third = -0.5 * (2 * finger_1 + 0.01) = -finger_1 - 0.005, which turned round rises."""
    found = hand_of(
        slide("finger_1", "left", -0.05, Y, OPENING),
        slide(
            "second", "right", 0.15, Y, OPENING,
            '<mimic joint="finger_1" multiplier="2" offset="0.01"/>',
        ),
        slide("third", "middle", 0.15, Y, OPENING, '<mimic joint="second" multiplier="-0.5"/>'),
    )  # fmt: skip
    third = found["third"]
    assert third.mimics == "finger_1"
    assert third.flipped != found["second"].flipped
    leader = found["finger_1"]
    for share in (0.0, 0.3, 1.0):
        at = leader.lower + share * (leader.upper - leader.lower)
        own = third.multiplier * at + third.offset
        authored = (-at if leader.flipped else at) * -1.0 - 0.005
        assert (-own if third.flipped else own) == pytest.approx(authored)
    assert third.multiplier > 0


def test_a_finger_without_a_range_is_refused() -> None:
    with refused(HAND_LIMITS, BadInput, joint="finger_1"):
        hand_of(
            slide("finger_1", "left", 0.0, Y, 'lower="0" upper="0"'),
            slide("finger_2", "right", 0.0, Y, OPENING),
        )


@pytest.fixture
def library(tmp_path: Path) -> RobotLibrary:
    return RobotLibrary(ROBOTS, tmp_path / "imported")


def test_an_arm_with_a_hand_takes_one_column_a_joint_of_the_arm(
    tmp_path: Path, library: RobotLibrary
) -> None:
    file = tmp_path / "panda.urdf"
    file.write_text(ET.tostring(robot(*arm(7), *TWO_FINGERS), encoding="unicode"))
    found = import_robot(file, "panda", library, {})
    assert found.split is not None
    model = library.model("panda")
    assert len(model.joints) == 7
    assert library.hand("panda") == {"finger_1", "finger_2"}
    # The tip is the last joint's frame, and the reach is that of joints 2 to 7, 0.2 m apart.
    assert library.facts("panda")["reach"] == pytest.approx(1.0, abs=1e-3)
    with refused(HAND_OF_ITS_OWN, BadInput, robot="panda"):
        library.description("panda", "parallel_gripper")
    written = urdf.joints(urdf.parse(library.description("panda"), "panda"), "panda")
    finger = next(j for j in written if j.name == "finger_1")
    assert finger.limit is not None
    assert (finger.limit["lower"], finger.limit["upper"]) == (-0.04, 0.0)
    assert np.allclose(finger.axis, [0, -1, 0])


def test_a_continuous_joint_may_leave_its_limits_out(
    tmp_path: Path, library: RobotLibrary
) -> None:
    endless = joint("turn", "palm", "flange", "continuous", f'<axis xyz="{Y}"/>')
    file = tmp_path / "endless.urdf"
    file.write_text(ET.tostring(robot(*arm(3), endless), encoding="unicode"))
    found = import_robot(file, "endless", library, {}).findings
    assert {one.code for one in found} == {"robot_speed", "robot_effort"}
    speed = next(one for one in found if one.code == "robot_speed")
    assert (speed.value, speed.unit) == (pytest.approx(np.pi), "rad/s")
    assert library.model("endless").joints[3].max_velocity == pytest.approx(np.pi)


def test_a_speed_that_is_not_stated_can_be_given(tmp_path: Path, library: RobotLibrary) -> None:
    text = ET.tostring(robot(*arm(3)), encoding="unicode").replace('velocity="3"', 'velocity="0"')
    file = tmp_path / "slow.urdf"
    file.write_text(text)
    found = import_robot(file, "slow", library, {}).findings
    assert {one.code for one in found} == {"robot_velocity"}
    assert "slow" not in library.ids()
    import_robot(file, "slow", library, {}, speed=1.5)
    assert library.model("slow").joints[0].max_velocity == 1.5


XACRO = """<robot name="made" xmlns:xacro="http://www.ros.org/wiki/xacro">
  <xacro:arg name="hand" default="false"/>
  <xacro:include filename="$(find parts)/axis.xacro"/>
  <link name="base"/>
  <xacro:axis number="1" parent="base" child="palm"/>
  <xacro:if value="$(arg hand)">
    <xacro:axis number="2" parent="palm" child="left_finger"/>
    <xacro:axis number="3" parent="palm" child="right_finger"/>
  </xacro:if>
</robot>"""
AXIS = """<robot xmlns:xacro="http://www.ros.org/wiki/xacro">
  <xacro:macro name="axis" params="number parent child">
    <link name="${child}"><visual><geometry>
      <mesh filename="file://$(find parts)/box.stl"/></geometry></visual></link>
    <joint name="axis_${number}" type="revolute"><parent link="${parent}"/>
      <child link="${child}"/><axis xyz="0 1 0"/>
      <limit lower="-1" upper="1" velocity="1" effort="1"/></joint>
  </xacro:macro>
</robot>"""


@pytest.fixture
def made(tmp_path: Path) -> Path:
    """Return a xacro in the source tree of two packages."""
    import trimesh

    for package in ("made_description", "parts"):
        folder = tmp_path / "src" / package
        folder.mkdir(parents=True)
        (folder / "package.xml").write_text(f"<package><name>{package}</name></package>")
    (tmp_path / "src" / "parts" / "axis.xacro").write_text(AXIS)
    trimesh.creation.box((0.1, 0.1, 0.1)).export(tmp_path / "src" / "parts" / "box.stl")
    file = tmp_path / "src" / "made_description" / "made.urdf.xacro"
    file.write_text(XACRO)
    return file


def test_a_xacro_is_expanded_with_its_arguments(made: Path, library: RobotLibrary) -> None:
    import_robot(made, "bare", library, {})
    assert library.hand("bare") == frozenset()
    import_robot(made, "handed", library, {}, arguments=("hand:=true",))
    assert library.hand("handed") == {"axis_2", "axis_3"}
    assert (library.imported / "handed" / "meshes").is_dir()


def test_what_xacro_refuses_is_said(made: Path, library: RobotLibrary) -> None:
    with refused(BAD_XACRO_ARGUMENT, BadInput, argument="hand=true"):
        import_robot(made, "handed", library, {}, arguments=("hand=true",))
    made.write_text(XACRO.replace("$(find parts)", "$(find nobody_has_it)"))
    with refused(XACRO_REFUSED, BadInput, hint="package"):
        import_robot(made, "handed", library, {})


def test_a_package_with_several_descriptions_lists_them(
    made: Path, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    index = tmp_path / "share" / "ament_index" / "resource_index" / "packages"
    index.mkdir(parents=True)
    (index / "made_description").touch()
    (tmp_path / "share" / "made_description").symlink_to(made.parent)
    monkeypatch.setenv("AMENT_PREFIX_PATH", str(tmp_path))
    assert find_description("made_description").name == "made.urdf.xacro"
    (made.parent / "other.urdf.xacro").touch()
    with refused(PACKAGE_DESCRIPTIONS, known=["made.urdf.xacro", "other.urdf.xacro"]):
        find_description("made_description")
    assert find_description("made_description/made.urdf.xacro").is_file()


@pytest.mark.parametrize(
    ("joints", "code", "values"),
    [
        (
            (joint("a", "base", "b"), joint("b", "b", "c"), joint("c", "c", "b")),
            TWICE_IN_URDF,
            {"what": "child", "name": "b"},
        ),
        ((joint("a", "base", "b"), joint("b", "c", "d"), joint("c", "d", "c")), LINK_CIRCLE, {}),
        (
            (joint("a", "base", "b"), joint("a", "b", "c")),
            TWICE_IN_URDF,
            {"what": "joint", "name": "a"},
        ),
        ((joint("a" * 5000, "base", "b"),), NAME_TOO_LONG, {"count": 5000}),
        (
            tuple(joint(f"j{i}", f"l{i}", f"l{i + 1}", "fixed") for i in range(400)),
            TOO_MANY_LINKS,
            {"count": 401, "most": 300},
        ),
    ],
)
def test_what_is_no_tree_is_refused(
    joints: tuple[str, ...],
    code: Code,
    values: dict[str, object],
    tmp_path: Path,
    library: RobotLibrary,
) -> None:
    file = tmp_path / "wrong.urdf"
    file.write_text(ET.tostring(robot(*joints), encoding="unicode"))
    with refused(code, BadInput, **values):
        import_robot(file, "wrong", library, {})
    assert "wrong" not in library.ids()


def test_a_huge_mesh_collides_as_its_hull(tmp_path: Path, library: RobotLibrary) -> None:
    import trimesh

    trimesh.creation.icosphere(subdivisions=6, radius=0.1).export(tmp_path / "ball.stl")
    root = robot(*arm(3))
    shape = '<collision><geometry><mesh filename="ball.stl"/></geometry></collision>'
    next(e for e in root.iterfind("link") if e.get("name") == "palm").append(ET.fromstring(shape))
    (tmp_path / "round.urdf").write_text(ET.tostring(root, encoding="unicode"))
    import_robot(tmp_path / "round.urdf", "round", library, {})
    (file,) = (library.imported / "round" / "meshes").iterdir()
    hull = trimesh.load_mesh(file)
    assert len(hull.faces) < 1200
    assert hull.volume == pytest.approx(4 / 3 * np.pi * 0.1**3, rel=0.03)
