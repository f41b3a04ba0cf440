"""What the client says of a run, and how its advice leads on."""

from __future__ import annotations

import pytest

from mrlab_ros.client.course import halted
from mrlab_ros.core.base.diagnostic import of_text
from mrlab_ros.core.playback.diagnostics import AT_POSITION, BACK_AT_BEGIN, HALTED_BY_CONTACT


def touches(other: str):
    return HALTED_BY_CONTACT(link="forearm_link", other=other)


def commands(said) -> list[str]:
    return [fix.command for fix in said.fixes]


def test_a_halt_names_what_ends_it_in_the_order_in_which_it_is_done():
    said = halted("ur5e_1", touches("cube_1"), ["cube_1"])
    assert said.code == "halted"
    assert commands(said) == [
        "stop ur5e_1",
        "objects remove cube_1",
        "place ur5e_1 --at X,Y",
        "resume ur5e_1",
    ]


@pytest.mark.parametrize("why", [BACK_AT_BEGIN(), AT_POSITION(position=1.5)])
def test_a_halted_robot_that_was_taken_elsewhere_is_not_sent_there_again(why):
    said = halted("ur5e_1", why, ["cube_1"])
    assert (said.code, said.values["why"]) == ("still_halted", why)
    assert commands(said) == ["objects list", "place ur5e_1 --at X,Y", "resume ur5e_1"]


def test_a_robot_or_a_surface_is_not_removed():
    for other in ("kuka_1", "floor"):
        said = halted("ur5e_1", touches(other), ["post"])
        assert commands(said) == ["stop ur5e_1", "place ur5e_1 --at X,Y", "resume ur5e_1"]


def test_a_halt_of_which_nothing_is_known_is_one():
    assert halted("ur5e_1", of_text("")).code == "halted"
