"""The format of journals: what was written last is read, whatever tore the write after it."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from mrlab_ros.core.runtime import journal_format

VALUES = st.recursive(
    st.none() | st.integers(-(2**53), 2**53) | st.floats(allow_nan=False) | st.text(),
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(st.text(), inner, max_size=3),
    max_leaves=10,
)  # fmt: skip


def file(first: bytes, second: bytes, size: int) -> bytes:
    return first.ljust(size, b"\0") + second.ljust(size, b"\0")


@given(st.dictionaries(st.text(), VALUES, max_size=5))
def test_what_is_packed_is_unpacked(content):
    slot = journal_format.pack(7, content)
    assert journal_format.unpack(slot) == (7, content)
    assert journal_format.unpack(slot + bytes(100)) == (7, content)


@given(st.data())
def test_a_torn_write_leaves_the_one_before(data):
    before, after = (
        journal_format.pack(4, {"a": 1}),
        journal_format.pack(5, {"a": 2, "b": [1, 2, 3]}),
    )
    size = journal_format.slot_size(len(after))
    torn = after[: data.draw(st.integers(0, len(after) - 1))]
    assert journal_format.newest(file(before, torn, size)) == (4, {"a": 1})
    assert journal_format.newest(file(before, after, size)) == (5, {"a": 2, "b": [1, 2, 3]})


@pytest.mark.parametrize("content", [b"", b"x", bytes(8192), b"mrlab.j1" * 1000])
def test_a_file_without_a_write_holds_nothing(content):
    assert journal_format.newest(content) is None


def test_a_slot_has_room_to_grow():
    assert journal_format.slot_size(10) == journal_format.SMALLEST
    assert journal_format.slot_size(journal_format.SMALLEST + 1) == 2 * journal_format.SMALLEST
