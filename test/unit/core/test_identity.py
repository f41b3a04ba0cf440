"""Messages of a second lab on the same domain."""

from __future__ import annotations

import pytest

from mrlab_ros.core.identity import Identity


def test_another_lab_is_named_once_and_ignored():
    said: list[str] = []
    own = Identity("a1", said.append)
    assert own.accepts("a1")
    assert not own.accepts("b2")
    assert not own.accepts("b2")
    (sentence,) = said
    assert "another lab (b2)" in sentence
    assert own.others == {"b2"}


def test_what_names_no_lab_is_accepted():
    said: list[str] = []
    assert Identity("a1", said.append).accepts("")
    assert Identity("", said.append).accepts("b2")
    assert said == []


@pytest.mark.parametrize(
    ("lab", "namespace"), [("", ""), ("a1b2", "/lab_a1b2"), ("my lab/1", "/lab_mylab1")]
)
def test_a_name_in_the_graph_can_hold_the_id(lab, namespace):
    assert Identity(lab, lambda text: None).namespace == namespace
