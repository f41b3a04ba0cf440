"""Messages of a second lab on the same domain."""

from __future__ import annotations

import pytest

from mrlab_ros.core.identity import PRESENT_S, Identity, Neighbours


def test_another_lab_is_named_once_and_ignored():
    said: list[str] = []
    own = Identity("a1", said.append)
    assert own.accepts("a1")
    assert not own.accepts("b2")
    assert not own.accepts("b2")
    (sentence,) = said
    assert "another lab, b2," in sentence
    assert own.others == {"b2"}


def test_what_names_no_lab_is_accepted():
    said: list[str] = []
    assert Identity("a1", said.append).accepts("")
    assert Identity("", said.append).accepts("b2")
    assert said == []


def test_a_list_that_names_no_lab_removes_no_robots():
    said: list[str] = []
    own = Identity("a1", said.append)
    assert own.obeys("a1")
    assert not own.obeys("")
    assert not own.obeys("")
    (sentence,) = said
    assert "a lab node without an id" in sentence
    assert Identity("", said.append).obeys("")


@pytest.mark.parametrize(
    ("lab", "namespace"), [("", ""), ("a1b2", "/lab_a1b2"), ("my lab/1", "/lab_mylab1")]
)
def test_a_name_in_the_graph_can_hold_the_id(lab, namespace):
    assert Identity(lab, lambda text: None).namespace == namespace


def test_what_another_lab_would_carry_out_too_is_not_called():
    neighbours = Neighbours("a1")
    neighbours.notice("a1", 0.0)
    assert neighbours.why_not("/lab/spawn_robot", 2, 0.0) == ""
    neighbours.notice("b2", 1.0)
    said = neighbours.why_not("/lab/spawn_robot", 2, 1.0)
    assert "/lab/spawn_robot was not called" in said
    assert "b2. Start one of the labs again with another ROS_DOMAIN_ID" in said
    # What that lab does not have is this one's alone; what stops an arm, or asks, may reach both.
    assert neighbours.why_not("/ur5e_1/play", 1, 1.0) == ""
    for harmless in ("/ur5e_1/pause", "/cell/stop", "/converter/list_any", "/physics/get_objects"):
        assert neighbours.why_not(harmless, 2, 1.0) == ""
    for other in ("/ur5e_1/play", "/physics/set_objects", "/lab/remove_robot"):
        assert neighbours.why_not(other, 2, 1.0)
    assert neighbours.why_not("/lab/spawn_robot", 2, 1.0 + PRESENT_S) == ""


def test_a_lab_without_an_id_has_no_neighbours():
    neighbours = Neighbours("")
    neighbours.notice("b2", 0.0)
    assert neighbours.why_not("/lab/spawn_robot", 2, 0.0) == ""
