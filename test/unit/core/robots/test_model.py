"""Forward kinematics: closed forms, group properties, and batch against single."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from refusals import refused

from mrlab_ros.core.base.errors import Misuse
from mrlab_ros.core.base.geometry import (
    inverse_transform,
    pose_from_transform,
    transform_from_xyz_rpy,
)
from mrlab_ros.core.robots.diagnostics import POSITION_COUNT
from mrlab_ros.core.robots.model import KinematicChain, Segment

ANGLES = st.floats(-7.0, 7.0)


def planar(*lengths: float) -> KinematicChain:
    """Return a planar arm about z whose links have the lengths, m, along x."""
    segments = [Segment("link_1", np.eye(4), np.array([0.0, 0.0, 1.0]))]
    for number, length in enumerate(lengths[:-1], start=2):
        place = transform_from_xyz_rpy([length, 0, 0], [0, 0, 0])
        segments.append(Segment(f"link_{number}", place, np.array([0.0, 0.0, 1.0])))
    segments.append(Segment("tool0", transform_from_xyz_rpy([lengths[-1], 0, 0], [0, 0, 0])))
    return KinematicChain("base_link", tuple(segments))


@given(ANGLES, ANGLES)
def test_planar_arm_has_its_closed_form(a: float, b: float) -> None:
    pose = planar(0.4, 0.3).tool0(np.array([a, b]))
    expected = [0.4 * np.cos(a) + 0.3 * np.cos(a + b), 0.4 * np.sin(a) + 0.3 * np.sin(a + b), 0]
    np.testing.assert_allclose(pose[:3, 3], expected, atol=1e-12)
    np.testing.assert_allclose(pose[0, 0], np.cos(a + b), atol=1e-12)


@given(st.tuples(ANGLES, ANGLES, ANGLES), st.tuples(ANGLES, ANGLES, ANGLES))
def test_transform_is_rigid_and_inverse_undoes_it(xyz: tuple, rpy: tuple) -> None:
    pose = transform_from_xyz_rpy(xyz, rpy)
    np.testing.assert_allclose(pose @ inverse_transform(pose), np.eye(4), atol=1e-12)
    assert np.linalg.det(pose[:3, :3]) == pytest.approx(1.0)


def test_rpy_turns_about_fixed_axes_x_then_y_then_z() -> None:
    turned = transform_from_xyz_rpy([0, 0, 0], [np.pi / 2, 0, np.pi / 2])[:3, :3] @ [0.0, 1.0, 0.0]
    # About x: y becomes z; about z: z stays.
    np.testing.assert_allclose(turned, [0, 0, 1], atol=1e-15)


@given(ANGLES)
def test_any_axis_turns_as_rodrigues_says(angle: float) -> None:
    axis = np.array([1.0, -2.0, 0.5]) / np.linalg.norm([1.0, -2.0, 0.5])
    chain = KinematicChain("base_link", (Segment("tool0", np.eye(4), axis),))
    cross = np.cross(axis, np.eye(3)).T
    expected = np.eye(3) + np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross
    np.testing.assert_allclose(chain.tool0(np.array([angle]))[:3, :3], expected, atol=1e-12)


def test_prismatic_joint_moves_along_its_axis() -> None:
    place = transform_from_xyz_rpy([0, 0, 1.0], [0, np.pi / 2, 0])
    rail = Segment("tool0", place, np.array([0.0, 0.0, 1.0]), prismatic=True)
    pose = KinematicChain("base_link", (rail,)).tool0(np.array([0.25]))
    np.testing.assert_allclose(pose[:3, 3], [0.25, 0, 1.0], atol=1e-15)


def test_batch_equals_single_and_keeps_the_leading_shape() -> None:
    chain = planar(0.4, 0.3, 0.1)
    positions = np.random.default_rng(1).uniform(-3, 3, (4, 5, 3))
    poses = chain.tool0(positions)
    links = chain.links(positions)
    assert poses.shape == (4, 5, 4, 4)
    assert tuple(links) == ("base_link", "link_1", "link_2", "link_3", "tool0")
    for index in np.ndindex(4, 5):
        np.testing.assert_allclose(poses[index], chain.tool0(positions[index]), atol=1e-15)
    np.testing.assert_array_equal(links["tool0"], poses)
    np.testing.assert_array_equal(links["base_link"][2, 3], np.eye(4))


def test_wrong_number_of_positions_is_named() -> None:
    with refused(POSITION_COUNT, Misuse, count=2, joints=3):
        planar(1, 1, 1).tool0(np.zeros(2))


def test_moving_one_joint_leaves_the_links_before_it() -> None:
    chain = planar(0.4, 0.3, 0.1)
    before, after = chain.links(np.zeros(3)), chain.links(np.array([0.0, 0.0, 1.0]))
    np.testing.assert_array_equal(before["link_2"], after["link_2"])
    assert np.abs(before["tool0"] - after["tool0"]).max() > 0.05


@given(st.lists(ANGLES, min_size=4, max_size=4))
def test_the_tip_is_where_tool0_says(positions: list[float]) -> None:
    tilted = np.array([1.0, -2.0, 0.5]) / np.linalg.norm([1.0, -2.0, 0.5])
    places = [transform_from_xyz_rpy([0.1 * i, 0.2, -0.3], [0.4 * i, 1.0, -2.0]) for i in range(6)]
    chain = KinematicChain(
        "base_link",
        (
            Segment("a", places[0], np.array([0.0, 0.0, 1.0])),
            Segment("b", places[1], tilted),
            Segment("c", places[2]),
            Segment("d", places[3], np.array([0.0, -1.0, 0.0]), prismatic=True),
            Segment("e", places[4], np.array([1.0, 0.0, 0.0])),
            Segment("tool0", places[5]),
        ),
    )
    expected = pose_from_transform(chain.tool0(np.array(positions)))
    found = chain.tip(positions)
    np.testing.assert_allclose(found.position, expected.position, atol=1e-12)
    same = np.dot(found.orientation, expected.orientation)
    assert abs(same) == pytest.approx(1.0, abs=1e-12)


def test_a_tip_needs_all_positions() -> None:
    with refused(POSITION_COUNT, Misuse, count=1, joints=2):
        planar(0.4, 0.3).tip([0.0])
