"""What the client says of a run, and how its advice leads on."""

from __future__ import annotations

import pytest

from mrlab_ros.client.course import halted


def test_a_halt_names_what_ends_it_in_the_order_in_which_it_is_done():
    text = halted("ur5e_1", "upper_arm_link touches cube_1", ["cube_1"])
    steps = ["mrlab stop ur5e_1", "mrlab objects remove cube_1", "mrlab resume ur5e_1"]
    places = [text.index(step) for step in steps]
    assert places == sorted(places)


@pytest.mark.parametrize(
    "why", ["back where it began, waits until it is clear", "stands at 1.5 s"]
)
def test_a_halted_robot_that_was_taken_elsewhere_is_not_sent_there_again(why):
    text = halted("ur5e_1", why, ["cube_1"])
    assert why in text
    assert "mrlab stop" not in text
    assert text.index("mrlab place ur5e_1") < text.index("mrlab resume ur5e_1")


def test_a_named_object_can_be_removed_and_a_robot_or_a_surface_cannot():
    named = halted("ur5e_1", "forearm_link touches post", ["post"])
    assert "mrlab objects remove post" in named
    for other in ("kuka_1", "floor"):
        text = halted("ur5e_1", f"forearm_link touches {other}", ["post"])
        assert "remove" not in text
        assert "mrlab place ur5e_1" in text
