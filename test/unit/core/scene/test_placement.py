"""The choice of a place for a robot: floor, viewers, free space."""

from __future__ import annotations

import itertools
import math

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from refusals import refused

from mrlab_ros.core.base.errors import BadInput, Misuse
from mrlab_ros.core.base.geometry import Pose, quaternion_from_rpy, rotate
from mrlab_ros.core.scene.diagnostics import (
    NO_LEVEL_SURFACE,
    NO_PLACE_BEFORE_VIEWER,
    NO_PLACE_ON_SURFACE,
)
from mrlab_ros.core.scene.placement import (
    BASE_RADIUS,
    BESIDE,
    SPACING,
    Standing,
    Support,
    Thing,
    Viewer,
    named_support,
    place_before,
    place_on,
    support_of,
)

REACH = 0.85


def box(x: float, y: float, half: float) -> np.ndarray:
    return np.array(
        [[x - half, y - half], [x + half, y - half], [x + half, y + half], [x - half, y + half]]
    )


def plane(half: float = 0.5) -> np.ndarray:
    return np.column_stack([box(0, 0, half), np.zeros(4)])


def viewer(heading: float = 0.0, down: float = 0.0, x: float = 0.0, y: float = 0.0) -> Viewer:
    return Viewer.of(Pose((x, y, 1.6), quaternion_from_rpy(0, down, heading)))


TABLE = Support("table_1", 0.72, box(1.0, 0.0, 0.5))


@given(st.floats(-math.pi, math.pi), st.floats(-5, 5), st.floats(-5, 5))
def test_it_stands_in_front_and_faces_who_asked(heading, x, y):
    pose = place_before(viewer(heading, x=x, y=y), REACH, (), ())
    to = np.array(pose.position[:2]) - (x, y)
    assert 0.8 < np.hypot(*to) < 1.6
    assert abs(math.remainder(math.atan2(to[1], to[0]) - heading, math.tau)) < 0.2
    ahead = np.array(rotate(pose.orientation, (1, 0, 0)))
    assert ahead[:2] @ to < -0.99 * np.hypot(*to)
    assert pose.position[2] == 0
    assert rotate(pose.orientation, (0, 0, 1))[2] == pytest.approx(1)


def test_a_table_before_the_viewer_is_nearer_than_the_floor_below_it():
    pose = place_before(viewer(down=0.6), REACH, (TABLE,), ())
    assert pose.position[2] == 0.72
    assert TABLE.holds(*pose.position[:2], BASE_RADIUS)


def test_a_table_behind_the_viewer_is_left_alone():
    pose = place_before(viewer(math.pi), REACH, (TABLE,), ())
    assert pose.position[2] == 0
    assert pose.position[0] < 0


def test_nothing_stands_below_a_table_or_on_a_shelf_above_the_eyes():
    shelf = Support("shelf", 1.9, box(1.0, 0.0, 0.2))
    desk = Support("desk", 0.7, box(1.0, 0.0, 0.15))  # too small for a base and its margin
    pose = place_before(viewer(), REACH, (shelf, desk), ())
    assert pose.position[2] in (0, 0.7)
    if pose.position[2] == 0:
        assert not desk.covers(*pose.position[:2], BASE_RADIUS)


def test_robots_keep_clear_of_each_other_until_there_is_no_room():
    standing: list[Standing] = []
    refusal = None
    while refusal is None:
        try:
            pose = place_before(viewer(), REACH, (), standing)
        except Misuse as error:
            refusal = error.diagnostic
        else:
            standing.append(Standing(pose.position, REACH))
    assert refusal == NO_PLACE_BEFORE_VIEWER(distance=3.0)
    assert len(standing) >= 3
    for a, b in itertools.combinations(standing, 2):
        assert math.dist(a.position, b.position) >= SPACING * 2 * REACH - 1e-9


def test_two_robots_fit_on_a_table():
    first = place_before(viewer(), REACH, (TABLE,), (), TABLE)
    second = place_before(viewer(), REACH, (TABLE,), (Standing(first.position, REACH),), TABLE)
    assert second.position[2] == 0.72
    assert math.dist(first.position, second.position) >= BESIDE


def test_what_stands_on_a_table_is_not_stood_on():
    cube = Thing.of(Pose((1.0, 0.0, 0.745)), (0.05, 0.05, 0.05))
    pose = place_on(TABLE, (TABLE,), (), (cube,))
    assert math.dist(pose.position[:2], (1.0, 0.0)) >= BASE_RADIUS + 0.025
    before = place_before(viewer(), REACH, (TABLE,), (), TABLE, (cube,))
    assert math.dist(before.position[:2], (1.0, 0.0)) >= BASE_RADIUS + 0.025
    everywhere = Thing.of(Pose((1.0, 0.0, 0.745)), (5.0, 5.0, 0.05))
    with refused(NO_PLACE_ON_SURFACE, Misuse, surface="table_1"):
        place_on(TABLE, (TABLE,), (), (everywhere,))


def test_a_thing_is_as_wide_as_it_lies():
    lying = Thing.of(Pose((1, 2, 0.1), (0.0, math.sqrt(0.5), 0.0, math.sqrt(0.5))), (0.1, 0.2, 2))
    assert (lying.low, lying.high) == pytest.approx((0.05, 0.15))
    assert lying.radius == pytest.approx(math.hypot(1.0, 0.1))
    # A low one: only the base must be clear of it. A tall one: the arm at home too.
    flat, tall = Thing(0, 0, 0.1, 0, 0.05), Thing(0, 0, 0.1, 0, 0.8)
    assert flat.leaves(0.3, 0, 0.0, 0.85)
    assert not flat.leaves(0.2, 0, 0.0, 0.85)
    assert tall.leaves(0.62, 0, 0.0, 0.85)
    assert not tall.leaves(0.5, 0, 0.0, 0.85)
    # What lies in the floor or hangs far above is not in the way.
    assert Thing(0, 0, 1, -0.1, 0.0).leaves(0, 0, 0.0, 0.85)
    assert Thing(0, 0, 1, 2.0, 2.2).leaves(0, 0, 0.0, 0.85)


def test_a_named_surface_is_taken_even_behind_the_viewer_or_without_one():
    assert place_before(viewer(math.pi), REACH, (TABLE,), (), TABLE).position[2] == 0.72
    pose = place_on(TABLE, (TABLE,), ())
    assert pose.position == pytest.approx((1.0, 0.0, 0.72))
    with refused(NO_PLACE_ON_SURFACE, Misuse, surface="tray"):
        place_on(Support("tray", 0.9, box(0, 0, 0.1)), (), ())


def test_a_surface_is_found_by_its_name():
    assert named_support("table_1", [TABLE]) is TABLE
    assert named_support("", [TABLE]).height == 0
    with refused(NO_LEVEL_SURFACE, BadInput, known=["table_1", "floor"], close="table_1"):
        named_support("tabel_1", [TABLE])


@pytest.mark.parametrize(
    ("label", "roll", "mesh", "found"),
    [
        ("table", 0.0, False, True),
        ("table", math.pi, False, True),
        ("table", 0.1, False, True),
        ("table", 0.3, False, False),
        ("table", 0.0, True, False),
        ("wall", math.pi / 2, False, False),
        ("ceiling", math.pi, False, False),
        ("floor", 0.0, False, False),
    ],
)
def test_a_robot_stands_on_what_is_level(label, roll, mesh, found):
    pose = Pose((1.0, 2.0, 0.7), quaternion_from_rpy(roll, 0, 0))
    support = support_of("s", label, pose, plane(), mesh)
    assert (support is not None) is found
    if support is not None:
        assert support.height == pytest.approx(0.7)
        assert support.holds(1.4, 2.3, 0.05)
        assert not support.holds(1.4, 2.6, 0.0)


@given(st.floats(-0.49, 0.49), st.floats(-0.49, 0.49))
def test_the_margin_is_kept_from_every_edge(x, y):
    table = Support("t", 1.0, box(0, 0, 0.5))
    farthest = max(abs(x), abs(y))
    assume(abs(farthest - 0.4) > 1e-12)
    assert table.holds(x, y, 0.1) == (farthest < 0.4)
