"""Messages of a second lab on the same domain."""

from __future__ import annotations

import pytest

from mrlab_ros.core.base.diagnostic import Diagnostic
from mrlab_ros.core.runtime.diagnostics import LAB_WITHOUT_ID, OTHER_LAB, SHARED_SERVICE
from mrlab_ros.core.runtime.identity import PRESENT_S, Identity, Neighbours


def test_another_lab_is_named_once_and_ignored():
    said: list[Diagnostic] = []
    own = Identity("a1", said.append)
    assert own.accepts("a1")
    assert not own.accepts("b2")
    assert not own.accepts("b2")
    assert said == [OTHER_LAB(other_lab="b2", lab="a1")]
    assert own.others == {"b2"}


def test_what_names_no_lab_is_accepted():
    said: list[Diagnostic] = []
    assert Identity("a1", said.append).accepts("")
    assert Identity("", said.append).accepts("b2")
    assert said == []


def test_a_list_that_names_no_lab_removes_no_robots():
    said: list[Diagnostic] = []
    own = Identity("a1", said.append)
    assert own.obeys("a1")
    assert not own.obeys("")
    assert not own.obeys("")
    assert said == [LAB_WITHOUT_ID(lab="a1")]
    assert Identity("", said.append).obeys("")


@pytest.mark.parametrize(
    ("lab", "namespace"), [("", ""), ("a1b2", "/lab_a1b2"), ("my lab/1", "/lab_mylab1")]
)
def test_a_name_in_the_graph_can_hold_the_id(lab, namespace):
    assert Identity(lab, lambda text: None).namespace == namespace


def test_what_another_lab_would_carry_out_too_is_not_called():
    neighbours = Neighbours("a1")
    neighbours.notice("a1", 0.0)
    assert neighbours.why_not("/lab/spawn_robot", 2, 0.0) is None
    neighbours.notice("b2", 1.0)
    said = neighbours.why_not("/lab/spawn_robot", 2, 1.0)
    assert said == SHARED_SERVICE(service="/lab/spawn_robot", labs=["b2"])
    # What that lab does not have is this one's alone.
    assert neighbours.why_not("/ur5e_1/play", 1, 1.0) is None
    assert neighbours.why_not("/lab/spawn_robot", 2, 1.0 + PRESENT_S) is None


def test_a_lab_without_an_id_has_no_neighbours():
    neighbours = Neighbours("")
    neighbours.notice("b2", 0.0)
    assert neighbours.why_not("/lab/spawn_robot", 2, 0.0) is None
