"""A robot in a file is compared with the chosen one, whatever its base, tool and notation are."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from fakes import make_model

from mrlab_ros.adapters.robots.library import RobotLibrary
from mrlab_ros.core.conversion.kinematics_match import findings, match, robots_in
from mrlab_ros.core.conversion.workspace import Variable, Workspace
from mrlab_ros.core.robots.model import KinematicChain, Segment

ROBOTS_FOLDER = Path(__file__).parents[4] / "robots"
ROBOTS = RobotLibrary(ROBOTS_FOLDER)
UR5E = ROBOTS.model("ur5e")
KR6 = ROBOTS.model("kuka_kr6_r900_sixx")
# a, d, alpha of the UR5e, from Universal Robots' page on DH parameters
UR5E_DH = [
    (0, 0.1625, np.pi / 2),
    (-0.425, 0, 0),
    (-0.3922, 0, 0),
    (0, 0.1333, np.pi / 2),
    (0, 0.0997, -np.pi / 2),
    (0, 0.0996, 0),
]


def var(path, value):
    if isinstance(value, str):
        return Variable(path, "char", (1, len(value)), text=value)
    values = np.atleast_2d(np.asarray(value, float))
    return Variable(path, "double", values.shape, values)


def serial_link(rows, path="robot", scale=1.0, place="{path}.links({n})", **more):
    """Return the variables of a SerialLink with rows of a, d, alpha."""
    found = [var(f"{path}.name", "my arm"), var(f"{path}.mdh", 0)]
    for n, (a, d, alpha) in enumerate(rows, 1):
        link = place.format(path=path, n=n)
        parts = {"a": a * scale, "d": d * scale, "alpha": alpha, "theta": np.zeros((0, 0))}
        for name, value in ({**parts, "jointtype": "R"} | more).items():
            found.append(var(f"{link}.{name}", value))
    return found


def workspace(*variables):
    return Workspace("fake", tuple(variables))


def turned(axis, angle, xyz=(0, 0, 0)):
    cos, sin = np.cos(angle), np.sin(angle)
    i, j = [(1, 2), (2, 0), (0, 1)][axis]
    pose = np.eye(4)
    pose[i, i], pose[i, j], pose[j, i], pose[j, j] = cos, -sin, sin, cos
    pose[:3, 3] = xyz
    return pose


def only(found):
    (one,) = found
    return one


def test_the_dh_parameters_of_a_robot_agree_with_it():
    found = only(findings(workspace(*serial_link(UR5E_DH)), UR5E))
    assert found.code == "kinematics_agree"
    assert (found.variable, found.values["title"]) == ("robot", "my arm")
    assert match(only(robots_in(workspace(*serial_link(UR5E_DH)))).chain, UR5E).distance < 1e-3


@pytest.mark.parametrize(
    "variables",
    [
        serial_link(UR5E_DH, scale=1000),
        serial_link(UR5E_DH, place="{path}.link{{{n}}}"),
        serial_link(UR5E_DH, place="{path}({n})"),
        [*serial_link(UR5E_DH), var("robot.base", turned(1, 2.0, (1, 2, 3)))],
        [*serial_link(UR5E_DH), var("robot.tool", turned(0, -1.0, (0.1, 0, 0.3)))],
    ],
    ids=["mm", "old toolbox", "links alone", "base", "tool"],
)
def test_units_notation_base_and_tool_do_not_count(variables):
    assert only(findings(workspace(*variables), UR5E)).code == "kinematics_agree"


def test_another_robot_is_a_warning():
    found = only(findings(workspace(*serial_link(UR5E_DH)), KR6))
    assert found.code == "kinematics_differ"
    assert found.values["distance"] > 0.01
    longer = [(a * 1.1, d, alpha) for a, d, alpha in UR5E_DH]
    assert only(findings(workspace(*serial_link(longer)), UR5E)).code == "kinematics_differ"
    fewer = only(findings(workspace(*serial_link(UR5E_DH[:4])), UR5E))
    assert (fewer.values["count"], fewer.values["joints"]) == (4, 6)


def test_another_zero_position_or_direction_is_a_warning():
    shifted = [*serial_link(UR5E_DH), var("robot.links(2).offset", np.pi / 2)]
    assert only(findings(workspace(*shifted), UR5E)).code == "kinematics_differ"
    flip = Variable("robot.links(3).flip", "logical", (1, 1), text="true")
    assert only(findings(workspace(*serial_link(UR5E_DH), flip), UR5E)).code == "kinematics_differ"


def test_one_robot_of_several_that_agrees_is_enough():
    other = serial_link(UR5E_DH[:3], path="other")
    found = only(findings(workspace(*other, *serial_link(UR5E_DH)), UR5E))
    assert (found.code, found.variable) == ("kinematics_agree", "robot")


def test_modified_parameters_follow_craig():
    """The same arm in both notations: the frame moves from behind the link to before it."""
    modified = []
    for n in range(6):
        a, alpha = (UR5E_DH[n - 1][0], UR5E_DH[n - 1][2]) if n else (0, 0)
        modified.append((a, UR5E_DH[n][1], alpha))
    variables = [*serial_link(modified)[:1], var("robot.mdh", 1), *serial_link(modified)[2:]]
    assert only(findings(workspace(*variables), UR5E)).code == "kinematics_agree"


def tree(chain, path="robot", extra=()):
    """Return the variables of a rigidBodyTree with the segments of a chain."""
    found = []
    segments = [*((s, i) for i, s in enumerate(chain.segments)), *extra]
    for n, (segment, parent) in enumerate(segments, 1):
        place = f"{path}.Bodies{{{n}}}"
        kind = (
            "fixed" if segment.axis is None else "prismatic" if segment.prismatic else "revolute"
        )
        found += [
            var(f"{place}.ParentIndex", parent),
            var(f"{place}.Joint.Type", kind),
            var(f"{place}.Joint.JointAxis", np.zeros(3) if segment.axis is None else segment.axis),
            var(f"{place}.Joint.JointToParentTransform", segment.T_parent_joint),
            var(f"{place}.Joint.ChildToJointTransform", np.eye(4)),
        ]
    return found


@pytest.mark.parametrize("robot", [UR5E, KR6], ids=lambda robot: robot.id)
def test_a_rigid_body_tree_of_the_robot_agrees(robot):
    fingers = [
        (Segment(f"f{i}", np.eye(4), np.array([0.0, 1.0, 0.0]), True), len(robot.chain.segments))
        for i in range(2)
    ]
    for variables in (tree(robot.chain), tree(robot.chain, extra=fingers)):
        one = only(robots_in(workspace(*variables)))
        found = match(one.chain, robot)
        assert found.distance < 1e-9
        assert found.angle < 1e-6


def test_every_robot_of_the_library_agrees_with_itself_and_no_other_shape():
    names = [p.parent.name for p in ROBOTS_FOLDER.glob("*/robot.yaml")]
    models = {name: ROBOTS.model(name) for name in names}
    for model in models.values():
        assert match(model.chain, model).agrees
        if len(model.joints) == 6 and model.id != "ur5e":
            assert not match(model.chain, UR5E).agrees


def test_parallel_axes_leave_no_freedom_too_much():
    """A SCARA: all axes are parallel, so the common normals decide how it is turned."""
    segments = tuple(
        Segment(f"l{i}", turned(2, 0.0, (0.3, 0, 0)), np.array([0, 0, 1.0]), i == 3)
        for i in range(4)
    )
    chain = KinematicChain("base", segments)
    moved = KinematicChain(
        "base",
        (
            Segment(
                "l0", turned(1, 0.7, (1, 2, 3)) @ segments[0].T_parent_joint, segments[0].axis
            ),
            *segments[1:],
        ),
    )
    robot = replace(make_model(4), chain=chain)
    assert match(moved, robot).distance < 1e-9


@pytest.mark.parametrize(
    "change",
    [
        lambda v: [x for x in v if x.path != "robot.links(3).alpha"],
        lambda v: [x for x in v if not x.path.endswith(".d")],
        lambda v: [x for x in v if not x.path.endswith("jointtype")],
        lambda v: [*v[:4], var("robot.links(1).alpha", np.nan), *v[5:]],
    ],
)
def test_what_is_no_whole_robot_is_passed_over(change):
    assert findings(workspace(*change(serial_link(UR5E_DH))), UR5E) == []
