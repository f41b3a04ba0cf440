"""The set of robots: names, places, refusals that change nothing."""

from __future__ import annotations

import itertools
import math

import pytest
from hypothesis import given
from hypothesis import strategies as st
from refusals import refused

from mrlab_ros.core.base.diagnostics import (
    BAD_NAME,
    BAD_QUATERNION,
    BAD_VECTOR,
    NAME_TAKEN,
    NO_ROBOT_IN_SCENE,
    POSE_NOT_FINITE,
    RESERVED_NAME,
)
from mrlab_ros.core.base.errors import BadInput, Misuse
from mrlab_ros.core.base.geometry import Pose
from mrlab_ros.core.base.names import RESERVED
from mrlab_ros.core.scene.placement import BASE_RADIUS, SPACING, Thing
from mrlab_ros.core.scene.robots import PlacedRobot, Scene


def robot(scene: Scene, reach: float = 0.9, name: str = "", pose: Pose | None = None):
    return PlacedRobot(
        name or scene.free_name("ur5e"), "ur5e", None, pose or scene.free_pose(reach), reach, ()
    )


@given(st.lists(st.floats(0.3, 3.2), max_size=8))
def test_robots_placed_automatically_keep_their_distance(reaches):
    scene = Scene()
    for reach in reaches:
        scene.spawn(robot(scene, reach))
    for a, b in itertools.combinations(scene.robots, 2):
        distance = math.dist(a.pose.position, b.pose.position)
        assert distance >= SPACING * (a.reach + b.reach) - 1e-9


@given(st.lists(st.tuples(st.floats(-1, 1), st.floats(-1, 1), st.floats(0.01, 1)), max_size=8))
def test_robots_placed_automatically_stand_in_no_object(cylinders):
    things = [Thing(x, y, 0.1, 0.0, high) for x, y, high in cylinders]
    x, y, _ = Scene().free_pose_on(0.9, "", None, (), things).position
    for thing in things:
        assert math.dist((x, y), (thing.x, thing.y)) >= 0.1 + BASE_RADIUS


def test_names_are_given_in_order_and_given_back():
    scene = Scene()
    for expected in ("ur5e_1", "ur5e_2", "ur5e_3"):
        assert scene.spawn(robot(scene)).name == expected
    scene.remove("ur5e_2")
    assert scene.spawn(robot(scene)).name == "ur5e_2"


@pytest.mark.parametrize("name", ["", "UR5e", "1st", "a b", "a/b", "a__b", "a_", "ä", "x" * 64])
def test_a_name_that_cannot_be_a_namespace_is_refused(name):
    scene = Scene()
    placed = PlacedRobot(name, "ur5e", None, Pose(), 0.9, ())
    with refused(BAD_NAME, BadInput, name=name, what="robot"):
        scene.spawn(placed)
    assert scene.robots == ()


@pytest.mark.parametrize("name", sorted(RESERVED))
def test_the_lab_s_own_names_are_refused(name):
    with refused(RESERVED_NAME, BadInput, name=name):
        Scene().spawn(PlacedRobot(name, "ur5e", None, Pose(), 0.9, ()))


def test_a_taken_name_is_refused():
    scene = Scene()
    scene.spawn(robot(scene, name="arm"))
    with refused(NAME_TAKEN, BadInput, name="arm"):
        scene.spawn(robot(scene, name="arm"))


@pytest.mark.parametrize("change", ["robot", "remove", "place", "set_end_effector"])
def test_an_unknown_robot_is_named_with_those_that_are_there(change):
    scene = Scene()
    scene.spawn(robot(scene, name="arm"))
    arguments = {"place": (Pose(),), "set_end_effector": (None,)}.get(change, ())
    with refused(NO_ROBOT_IN_SCENE, Misuse, robot="leg", known=["arm"]):
        getattr(scene, change)("leg", *arguments)


@pytest.mark.parametrize(
    ("position", "orientation", "code"),
    [
        ((math.nan, 0, 0), (0, 0, 0, 1), POSE_NOT_FINITE),
        ((0, math.inf, 0), (0, 0, 0, 1), POSE_NOT_FINITE),
        ((0, 0, 0), (0, 0, 0, 0), BAD_QUATERNION),
        ((0, 0, 0), (1, 1, 1, 1), BAD_QUATERNION),
    ],
)
def test_a_pose_that_is_none_is_refused(position, orientation, code):
    with refused(code, BadInput):
        Pose(position, orientation)


@pytest.mark.parametrize("position", [(1e6, 0, 0), (0, -100.5, 0), (0, 0, 1e300)])
def test_a_robot_outside_the_room_is_refused(position):
    scene = Scene()
    arm = scene.spawn(robot(scene, name="arm"))
    with refused(BAD_VECTOR, BadInput, what="position", limit=100.0):
        scene.place("arm", Pose(position))
    with refused(BAD_VECTOR, BadInput, what="position", limit=100.0):
        scene.spawn(robot(scene, name="leg", pose=Pose(position)))
    assert scene.robots == (arm,)


def test_a_robot_follows_the_hand_that_carries_it_and_no_other():
    scene = Scene()
    name = scene.spawn(robot(scene)).name
    here, there = Pose((1.0, 0.0, 0.0)), Pose((2.0, 0.0, 0.0))
    assert not scene.follow(name, "", 1, there)
    scene.place(name, here, "left")
    assert scene.follow(name, "left", 2, there)
    assert scene.robot(name).pose == there
    assert not scene.follow(name, "left", 2, here)
    assert not scene.follow(name, "right", 3, here)
    with pytest.raises(BadInput):
        scene.follow(name, "left", 3, Pose((1e9, 0.0, 0.0)))
    scene.place(name, here)
    assert not scene.follow(name, "left", 4, there)
    scene.remove(name)
    assert not scene.follow(name, "left", 5, there)
