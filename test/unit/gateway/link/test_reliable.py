from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.stateful import RuleBasedStateMachine, invariant, rule
from refusals import refused

from mrlab_ros.gateway.link import queues
from mrlab_ros.gateway.link.diagnostics import TOO_MUCH_WAITS
from mrlab_ros.gateway.link.frames import HEAD, LAST_FRAGMENT
from mrlab_ros.gateway.link.queues import FRAGMENT, WINDOW, Overflow, ReliableSender

pytestmark = pytest.mark.fast


class Receiver:
    """The other end, as web/src/link/reliable.ts has it."""

    def __init__(self) -> None:
        self.number = 0
        self.piece = b""
        self.records: list[bytes] = []

    def take(self, frame: bytes) -> None:
        _, flags, _, number = HEAD.unpack_from(frame)
        if number <= self.number:
            return
        assert number == self.number + 1
        self.number = number
        self.piece += frame[HEAD.size :]
        if flags & LAST_FRAGMENT:
            self.records.append(self.piece)
            self.piece = b""


class Connection(RuleBasedStateMachine):
    """Frames get lost with their socket; acknowledgements come late or never."""

    def __init__(self) -> None:
        super().__init__()
        self.sender = ReliableSender()
        self.receiver = Receiver()
        self.pushed: list[bytes] = []
        self.on_the_way: list[bytes] = []

    @rule(size=st.integers(1, 3 * FRAGMENT))
    def push(self, size: int) -> None:
        record = len(self.pushed).to_bytes(4, "little") + bytes(size)
        self.sender.push(record)
        self.pushed.append(record)

    @rule()
    def send(self) -> None:
        frame = self.sender.next()
        if frame is not None:
            self.on_the_way.append(frame)

    @rule(count=st.integers(1, 5))
    def arrive(self, count: int) -> None:
        for _ in range(min(count, len(self.on_the_way))):
            self.receiver.take(self.on_the_way.pop(0))

    @rule()
    def acknowledge(self) -> None:
        self.sender.acknowledge(self.receiver.number)

    @rule()
    def reconnect(self) -> None:
        self.on_the_way.clear()
        self.sender.rewind(self.receiver.number)

    @invariant()
    def each_record_arrives_once_and_in_order(self) -> None:
        assert self.receiver.records == self.pushed[: len(self.receiver.records)]

    @invariant()
    def little_is_under_way(self) -> None:
        assert sum(map(len, self.on_the_way)) <= WINDOW + FRAGMENT + HEAD.size

    def teardown(self) -> None:
        self.reconnect()
        while self.sender.size:
            while (frame := self.sender.next()) is not None:
                self.receiver.take(frame)
            self.acknowledge()
        assert self.receiver.records == self.pushed
        assert self.sender.idle


TestConnection = Connection.TestCase


def test_what_a_client_does_not_take_is_bounded(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(queues, "LARGEST", 100)
    sender = ReliableSender()
    sender.push(bytes(60))
    with refused(TOO_MUCH_WAITS, Overflow, count=1, size=60):
        sender.push(bytes(60))
    assert sender.size == 60


def test_a_record_larger_than_all_room_passes_alone(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(queues, "LARGEST", 100)
    sender = ReliableSender()
    sender.push(bytes(1000))
    assert sender.next() is not None


@given(st.integers(0, 2**32 - 1))
def test_a_wrong_acknowledgement_changes_nothing(number: int) -> None:
    sender = ReliableSender()
    sender.acknowledge(number)
    sender.push(b"a")
    frame = sender.next()
    assert frame is not None
    if number != 1:
        sender.acknowledge(number)
        sender.rewind(0)
        assert sender.next() == frame
