from __future__ import annotations

import struct

import pytest
from hypothesis import given
from hypothesis import strategies as st
from refusals import refused

from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.gateway.link import frames
from mrlab_ros.gateway.link.diagnostics import FRAME_LENGTH
from mrlab_ros.gateway.link.frames import Call, Credit, Received

pytestmark = pytest.mark.fast
NUMBERS = st.integers(0, 2**32 - 1)


CODES = ("frame_kind", "frame_length", "frame_short", "key_too_long", "key_not_text")


@given(st.lists(st.tuples(NUMBERS, st.floats(allow_nan=False), NUMBERS, st.binary(max_size=99))))
def test_a_batch_holds_its_entries_with_payloads_at_four_of_eight(
    messages: list[tuple[int, float, int, bytes]],
) -> None:
    frame = frames.batch(7, [frames.entry(*message) for message in messages])
    assert frames.HEAD.unpack_from(frame) == (1, 0, len(messages), 7)
    found, at = [], frames.HEAD.size
    for _ in messages:
        topic, length, stamp, sequence = frames.ENTRY.unpack_from(frame, at)
        start = at + frames.ENTRY.size
        assert start % 8 == 4
        found.append((topic, stamp, sequence, frame[start : start + length]))
        at = -(-(start + length) // 8) * 8
    assert found == messages
    assert at == len(frame)


@given(st.binary())
def test_whatever_a_client_sends_is_read_or_refused(frame: bytes) -> None:
    try:
        found = frames.from_client(frame)
    except BadInput as error:
        assert error.diagnostic.code in CODES  # noqa: PT017
    else:
        assert isinstance(found, Call | Credit | Received)


@given(st.text(max_size=50), NUMBERS, st.binary(max_size=99))
def test_a_call_is_what_was_sent(key: str, request: int, payload: bytes) -> None:
    name = key.encode()
    frame = struct.pack("<BBHII", 1, 0, len(name), request, 2500) + name + payload
    assert frames.from_client(frame) == Call(False, key, payload, request, 2.5)


def test_credit_and_acknowledgement_have_eight_bytes() -> None:
    assert frames.from_client(b"\3\0\0\0\5\0\0\0") == Credit(5)
    assert frames.from_client(b"\4\0\0\0\6\0\0\0") == Received(6)
    with refused(FRAME_LENGTH, BadInput, frame=3, size=5, expected=8):
        frames.from_client(b"\3\0\0\0\5")
