"""Messages of a second lab on the same domain."""

from __future__ import annotations

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
