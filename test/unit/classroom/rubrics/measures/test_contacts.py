"""What touches, what is near, and when first."""

from __future__ import annotations

import pytest
from made_motions import checked, outcome, recorded

from mrlab_ros.core.checking.rehearsal_record import Collision, Distances
from mrlab_ros.core.physics.engine import Kind, Near


def hit(time, other="pillar_1", kind=Kind.OBJECT, robot="ur5e_1"):
    return Collision(time, robot, "wrist_3_link", kind, other, "", (0, 0, 0), 0.01)


def test_a_collision_counts_where_it_is_meant_and_at_its_first_instant():
    found = checked(record=recorded(collisions=[hit(2.0), hit(1.2, "upper_arm", Kind.SELF)]))
    lost = outcome("no collision", found)
    assert (lost.share, lost.time, lost.found.values["more"]) == (0.0, 1.2, 1)
    assert outcome("no collision with pillar_1", found).time == 2.0
    assert outcome("no collision with itself", found).time == 1.2
    assert outcome("no collision with the floor", found).share == 1.0
    assert outcome("no collision of ur5e_1", found).share == 0.0
    assert outcome("no collision", checked()).share == 1.0


def test_two_robots_that_touch_are_told_of_both():
    found = checked(record=recorded(collisions=[hit(1.0, "ur5e_1", Kind.ROBOT, "kr6_1")]))
    assert outcome("no collision of ur5e_1", found).share == 0.0
    assert outcome("no collision of ur5e_1 with kr6_1", found).share == 0.0
    assert outcome("no collision of ur5e_1 with pillar_1", found).share == 1.0


def test_to_begin_inside_a_surface_is_a_collision():
    found = checked(record=recorded(begins_inside={"ur5e_1": ("floor",)}))
    assert outcome("no collision", found).time == 0.0
    assert outcome("no collision with the floor", found).share == 0.0


def test_the_least_distance_and_when_it_is_first_too_small():
    series = Distances()
    for value in (0.4, 0.09, 0.05, 0.2):
        series.add(Near(value, "wrist_3_link"))
    found = checked(
        record=recorded(
            times=[0.0, 1.0, 2.0, 3.0], distances={("ur5e_1", (Kind.OBJECT, "bin_1")): series}
        )
    )
    assert outcome("distance to bin_1 > 4 cm", found).share == 1.0
    lost = outcome("distance to bin_1 > 10 cm", found)
    assert (lost.share, lost.time, lost.found.value) == (0.0, 1.0, 0.05)
    assert outcome("distance > 10 cm", found, partial="until 0 mm").share == pytest.approx(0.5)
    assert outcome("distance to everything but bin_1 > 10 cm", found).share == 0.0
    assert outcome("distance to cube_1 > 1 cm", found).found.code == "no_distance"


def test_what_is_picked_up_is_left_out_of_the_distance():
    series = Distances()
    for value, held in ((0.4, ""), (0.0, "cube_1"), (0.3, "cube_1"), (0.2, "")):
        series.add(Near(value, "finger_link", held))
    series.arm[1] = Near(0.02, "finger_link")
    series.arm[2] = None
    record = recorded(
        times=[0.0, 1.0, 2.0, 3.0], distances={("ur5e_1", (Kind.SURFACE, "floor")): series}
    )
    found = checked(record=record)
    assert outcome("distance > 1 mm", found).found.value == 0.0
    kept = outcome("distance to everything but cube_1 > 1 mm", found)
    assert (kept.share, kept.found.value) == (1.0, 0.02)
    lost = outcome("distance to everything but cube_1 > 10 cm", found)
    assert (lost.share, lost.time) == (0.0, 1.0)
    at = {"link": "finger_link", "value": 0.02, "kind": "surface", "other": "floor", "time": 1.0}
    assert lost.found.code == "least_distance"
    assert {name: lost.found.values[name] for name in at} == at
    assert outcome("distance to everything but bin_1 > 1 mm", found).share == 0.0
