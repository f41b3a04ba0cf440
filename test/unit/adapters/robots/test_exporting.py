"""What RViz, Foxglove and MoveIt get: every link has a frame, every mesh a file, names that agree.

The frames of all links, chained from `world`, are compared with the forward kinematics and with
yourdfpy's, which reads the same URDF by itself.
"""

from __future__ import annotations

import io
import xml.etree.ElementTree as ET
from pathlib import Path

import numpy as np
import pytest
import yourdfpy
from refusals import refused

from mrlab_ros.adapters.robots import urdf
from mrlab_ros.adapters.robots.diagnostics import ROOT_LINKS
from mrlab_ros.adapters.robots.library import RobotLibrary
from mrlab_ros.adapters.robots.publishing import published, together
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.base.geometry import Array, Pose, compose
from mrlab_ros.core.robots.frames import LinkFrames, without_frames

ROOT = Path(__file__).parents[4]
LIBRARY = RobotLibrary(ROOT / "robots", Path("/nowhere"))
# Every robot bare, and every end effector once.
CARRIED = [
    *((robot, "") for robot in LIBRARY.ids()),
    *(("ur5e", end_effector) for end_effector in LIBRARY.end_effectors()),
]


def from_root(frames: LinkFrames, positions: dict[str, float]) -> dict[str, Pose]:
    """Return T_root_link of every link, as a listener of tf chains the transforms."""
    rows = frames.at(positions).tolist()
    moving = [
        (*pair, Pose(tuple(row[:3]), tuple(row[3:])))
        for pair, row in zip(frames.moving, rows, strict=True)
    ]
    above = {c: (p, pose) for p, c, pose in moving}
    above |= {frame.child: (frame.parent, frame.pose) for frame in frames.fixed}
    found = {frames.root: Pose()}

    def place(link: str) -> Pose:
        if link not in found:
            parent, pose = above[link]
            found[link] = compose(place(parent), pose)
        return found[link]

    for link in above:
        place(link)
    return found


def matrix(pose: Pose) -> Array:
    x, y, z, w = pose.orientation
    result = np.eye(4)
    result[:3, :3] = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
    ]
    result[:3, 3] = pose.position
    return result


@pytest.mark.parametrize(("robot", "end_effector"), CARRIED)
def test_the_frames_are_those_of_the_kinematics(robot: str, end_effector: str) -> None:
    text = LIBRARY.description(robot, end_effector)
    shown = published(text, "arm_1")
    frames = urdf.frames(urdf.parse(shown, robot), robot)
    other = yourdfpy.URDF.load(
        io.BytesIO(text.encode()), build_scene_graph=True, load_meshes=False
    )
    positions = {
        name: 0.3 + 0.1 * number for number, name in enumerate(other.actuated_joint_names)
    }
    other.update_cfg(list(positions.values()))
    found = from_root(frames, positions)
    root = frames.root.removeprefix("arm_1/")
    links = {element.get("name") for element in ET.fromstring(text).iterfind("link")}
    assert set(found) == {f"arm_1/{link}" for link in links}
    for link in links:
        expected = other.get_transform(link, root)
        assert matrix(found[f"arm_1/{link}"]) == pytest.approx(expected, abs=1e-9), link
    model = LIBRARY.model(robot)
    arm = model.chain.tool0(np.array([positions[joint] for joint in model.joint_names]))
    assert matrix(found["arm_1/tool0"]) == pytest.approx(arm, abs=1e-9)


@pytest.mark.parametrize(("robot", "end_effector"), CARRIED)
def test_every_mesh_resolves_to_a_file_of_the_installed_package(
    robot: str, end_effector: str
) -> None:
    """setup.py installs robots/ below share/mrlab_ros, to which package://mrlab_ros leads."""
    root = ET.fromstring(published(LIBRARY.description(robot, end_effector), "arm_1"))
    meshes = {mesh.get("filename", "") for mesh in root.iter("mesh")}
    assert meshes
    for uri in meshes:
        assert uri.startswith("package://mrlab_ros/")
        file = ROOT / uri.removeprefix("package://mrlab_ros/")
        assert file.is_file(), uri
        # The kinds that foxglove_bridge hands out and that RViz reads.
        assert file.suffix in (".glb", ".stl", ".dae", ".obj")


def test_the_joints_keep_their_names_and_the_prefix_comes_off_again() -> None:
    text = LIBRARY.description("ur5e", "parallel_gripper")
    shown = published(text, "ur5e_1")
    names = [joint.get("name") for joint in ET.fromstring(text).iterfind("joint")]
    assert [joint.get("name") for joint in ET.fromstring(shown).iterfind("joint")] == names
    plain = ET.canonicalize(without_frames(shown, "ur5e_1"), strip_text=True)
    assert plain == ET.canonicalize(text, strip_text=True)


def test_one_urdf_holds_all_robots() -> None:
    robots = {"ur5e_1": ("ur5e", "parallel_gripper"), "ur5e_2": ("ur5e", "")}
    descriptions = {
        name: published(LIBRARY.description(*what), name) for name, what in robots.items()
    }
    root = ET.fromstring(together(descriptions))
    links = [link.get("name") for link in root.iterfind("link")]
    joints = [joint.get("name") for joint in root.iterfind("joint")]
    assert len(set(links)) == len(links)
    assert len(set(joints)) == len(joints)
    assert links[0] == "world"
    children = {child.get("link") for child in root.iterfind("joint/child")}
    assert set(links) - children == {"world"}
    for mimic in root.iterfind("joint/mimic"):
        assert mimic.get("joint") in joints
    for name, text in descriptions.items():
        parts = urdf.frames(urdf.parse(text, name), name)
        assert {parts.root, *(f.child for f in parts.fixed)} <= set(links)
    assert [e.tag for e in ET.fromstring(together({}))] == ["link"]


def test_two_trees_are_refused() -> None:
    with refused(ROOT_LINKS, BadInput, links=["a", "b"]):
        urdf.frames(urdf.parse("<robot><link name='a'/><link name='b'/></robot>", "x"), "x")
