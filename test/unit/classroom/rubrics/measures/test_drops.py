"""The height from which an object falls."""

from __future__ import annotations

import pytest
from made_motions import checked, outcome, recorded, thing

from mrlab_ros.core.checking.rehearsal_record import Course

HELD = [(1.0, "HOLDING", "cube_1"), (3.0, "OPEN", "")]


def dropped(height, grasps=HELD):
    record = recorded(grasps)
    heights = (0.025 + height, 0.025 + height, 0.025, 0.025)
    record.objects["cube_1"] = Course(
        [1.0, 3.0, 4.0, 4.5], [[0.3, 0.1, z, 0, 0, 0, 1] for z in heights], [(0.0, "")]
    )
    return checked(record=record, objects={"cube_1": thing()})


def test_the_drop_is_from_the_release_to_the_rest():
    assert outcome("drop of cube_1 < 10 mm", dropped(0.009)).share == 1.0
    lost = outcome("drop of cube_1 < 10 mm", dropped(0.135), partial="until 260 mm")
    assert lost.found.value == pytest.approx(0.135)
    assert (lost.share, lost.time, lost.found.code) == (pytest.approx(0.5), 3.0, "falls")


def test_what_was_never_let_go_earns_nothing():
    assert outcome("drop of cube_1 < 10 mm", dropped(0.0, HELD[:1])).share == 0.0
    assert outcome("drop of cube_1 < 10 mm", dropped(0.0, ())).share == 0.0
