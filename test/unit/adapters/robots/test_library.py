"""The library against independent readers of the same URDFs."""

from __future__ import annotations

from io import StringIO
from pathlib import Path

import numpy as np
import pytest
import yourdfpy
from refusals import refused

from mrlab_ros.adapters.robots.diagnostics import NO_END_EFFECTOR, NO_ROBOT_MODEL
from mrlab_ros.adapters.robots.library import RobotLibrary
from mrlab_ros.core.base.errors import BadInput

ROBOTS = Path(__file__).resolve().parents[4] / "robots"
LIBRARY = RobotLibrary(ROBOTS, ROBOTS / "none imported")
IDS = (
    "kuka_kr10_r900_2",
    "kuka_kr120_r2500_pro",
    "kuka_kr150_r2700_2",
    "kuka_kr16_r1610_2",
    "kuka_kr20_r1810_2",
    "kuka_kr300_r2700_2",
    "kuka_kr3_r540",
    "kuka_kr50_r2100",
    "kuka_kr560_r3100_2",
    "kuka_kr6_r900_sixx",
    "kuka_kr70_r2100",
    "kuka_lbr_iisy15_r930",
    "ur5e",
)


def read(text: str) -> yourdfpy.URDF:
    """Return the URDF as yourdfpy reads it, without its meshes."""
    return yourdfpy.URDF.load(StringIO(text), load_meshes=False, build_scene_graph=True)


def test_all_models_of_the_table_are_there() -> None:
    assert LIBRARY.ids() == IDS


@pytest.mark.parametrize("robot", IDS)
def test_chain_agrees_with_yourdfpy(robot: str) -> None:
    model = LIBRARY.model(robot)
    other = read(LIBRARY.description(robot))
    low = [joint.lower for joint in model.joints]
    high = [joint.upper for joint in model.joints]
    assert tuple(other.actuated_joint_names) == model.joint_names
    for positions in np.random.default_rng(7).uniform(low, high, (20, len(low))):
        other.update_cfg(positions)
        for link, pose in model.chain.links(positions).items():
            np.testing.assert_allclose(pose, other.get_transform(link), atol=1e-12)


@pytest.mark.parametrize("robot", IDS)
def test_home_is_inside_the_limits(robot: str) -> None:
    model = LIBRARY.model(robot)
    for joint, position in zip(model.joints, model.home, strict=True):
        assert joint.lower <= position <= joint.upper
        assert joint.max_velocity > 0


@pytest.mark.parametrize("end_effector", LIBRARY.end_effectors())
@pytest.mark.parametrize("robot", ["ur5e", "kuka_kr560_r3100_2"])
def test_robot_and_end_effector_make_one_tree(robot: str, end_effector: str) -> None:
    both = read(LIBRARY.description(robot, end_effector))
    assert both.base_link == "base_link"
    assert "tcp" in both.link_map
    # The arm's joints come first and keep their order.
    names = LIBRARY.model(robot).joint_names
    assert tuple(both.actuated_joint_names[: len(names)]) == names
    tcp = both.get_transform("tcp", "tool0")
    assert tcp[2, 3] > 0.05


def test_empty_end_effector_is_the_bare_robot() -> None:
    assert LIBRARY.description("ur5e", "") == LIBRARY.description("ur5e")


def test_unknown_ids_are_answered_with_the_known_ones() -> None:
    with refused(NO_ROBOT_MODEL, BadInput, robot="ur6", close="ur5e"):
        LIBRARY.model("ur6")
    with refused(NO_END_EFFECTOR, BadInput, end_effector="hook", close=None):
        LIBRARY.description("ur5e", "hook")
    with refused(NO_END_EFFECTOR, BadInput, close="vacuum_cup"):
        LIBRARY.description("ur5e", "vacuum-cups")


def test_how_an_end_effector_holds_is_stated_in_its_file() -> None:
    held = {tool: LIBRARY.gripper("ur5e", tool).name for tool in LIBRARY.end_effectors()}
    assert held == {
        "centric_gripper": "fingers",
        "holding_magnet": "magnet",
        "parallel_gripper": "fingers",
        "vacuum_cup": "cup",
    }
