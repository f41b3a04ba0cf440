"""Times, waits and the mode of a cell."""

from __future__ import annotations

import numpy as np
import pytest
from made_motions import QUINTIC, ROBOT, checked, outcome, reach, recorded


@pytest.mark.parametrize(
    "sentence",
    ["ends at home", "cycle < 9 s", "passes within 9 m of [0, 0, 0]", "path length < 9 m",
     "within 100% of limits"],
)  # fmt: skip
def test_a_robot_that_waits_for_ever_has_not_played_its_motion(sentence):
    back = reach(progress=np.concatenate([QUINTIC, QUINTIC[::-1]]))
    stuck = recorded(stuck={"ur5e_1": "frame 0: after kr6_1.frame 9"})
    assert outcome(sentence, checked(back)).share == 1.0
    lost = outcome(sentence, checked(back, record=stuck))
    assert lost.share == 0.0
    assert lost.found.code == "member_waits_forever"
    assert lost.found.values["wait"] == "frame 0: after kr6_1.frame 9"


def test_times_are_lost_from_the_limit_on():
    found = checked(record=recorded(duration=6.0))
    cycle = reach().figures.cycle
    assert outcome("cycle < 5 s", found).share == 1.0
    lost = outcome("cycle < 3 s", found, partial="until 5 s")
    assert lost.share == pytest.approx((5 - cycle) / 2)
    assert lost.time == 3.0
    assert outcome("total time < 5 s", found).found.value == 6.0
    assert outcome("total time < 6 s", found).share == 1.0


def test_the_mode_of_a_cell():
    cell = checked(extras={"system": {"mode": "parallel"}})
    assert outcome("parallel mode used", cell).share == 1.0
    assert outcome("sequential mode used", cell).found.code == "other_mode"
    assert outcome("parallel mode used", checked()).found.code == "no_cell"


def test_a_robot_without_a_motion_is_named():
    found = outcome("ends at rest by kr6_1", checked()).found
    assert (found.code, found.robot) == ("no_motion_of", "kr6_1")
    assert found.values["robots"] == ["ur5e_1"]
    assert ROBOT.name == "ur5e_1"
