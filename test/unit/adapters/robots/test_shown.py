"""Robots as a page needs them."""

from pathlib import Path

import pytest

from mrlab_ros.adapters.robots.library import RobotLibrary, from_library, shown_robot
from mrlab_ros.core.base.errors import BadInput

LIBRARY = RobotLibrary(Path(__file__).parents[4] / "robots", imported=Path("/nonexistent"))


@pytest.mark.parametrize("model", LIBRARY.ids())
def test_every_robot_of_the_library_can_be_shown(model):
    found = from_library(LIBRARY, model, "parallel_gripper")
    assert tuple(joint.name for joint in found.joints) == LIBRARY.model(model).joint_names
    assert all(joint.velocity for joint in found.joints)
    assert "adapter_plate" in found.urdf


def test_a_continuous_joint_has_no_limits():
    text = (
        "<robot name='r'><link name='base'/><link name='tool0'/>"
        "<joint name='j' type='continuous'><parent link='base'/><child link='tool0'/>"
        "<limit velocity='2' effort='1'/></joint></robot>"
    )
    (joint,) = shown_robot("r", "", text).joints
    assert (joint.kind, joint.lower, joint.upper, joint.velocity) == ("continuous", None, None, 2)


def test_what_is_no_urdf_is_refused():
    with pytest.raises(BadInput):
        shown_robot("r", "", "<html/>")
