"""The reach of the shipped robots by each vendor's definition."""

from __future__ import annotations

import pytest
from refusals import refused

from mrlab_ros.adapters import share
from mrlab_ros.adapters.robots.library import RobotLibrary
from mrlab_ros.core.base.diagnostics import BAD_VALUE
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.robots.diagnostics import NO_SPHERICAL_WRIST
from mrlab_ros.core.robots.reach import reach, wrist_centre

LIBRARY = RobotLibrary(share.directory() / "robots")


@pytest.mark.parametrize(
    ("model", "definition", "metres"),
    [("kuka_kr3_r540", "wrist_centre", 0.541), ("kuka_kr6_r900_sixx", "wrist_centre", 0.9015)],
)
def test_a_reach_is_the_one_of_the_data_sheet(model: str, definition: str, metres: float) -> None:
    assert reach(LIBRARY.model(model), definition) == pytest.approx(metres, abs=0.002)


def test_the_flange_gets_further_than_where_all_joints_are_at_zero() -> None:
    model = LIBRARY.model("kuka_kr3_r540")
    assert reach(model, "flange") > reach(model, "stretched")


def test_an_arm_whose_last_axes_do_not_meet_has_no_wrist_centre() -> None:
    with refused(NO_SPHERICAL_WRIST, BadInput):
        wrist_centre(LIBRARY.model("ur5e").chain)


def test_an_unknown_definition_is_refused() -> None:
    with refused(BAD_VALUE, BadInput):
        reach(LIBRARY.model("ur5e"), "furthest")
