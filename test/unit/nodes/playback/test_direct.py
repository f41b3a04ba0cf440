"""What playback puts on zenoh, with a session and a bridge of the test's own."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from queue import Queue
from typing import Any

import pytest

from mrlab_ros.adapters.zenoh.diagnostics import NO_LAB_AT
from mrlab_ros.core.base.diagnostic import of_text
from mrlab_ros.core.base.errors import Unavailable
from mrlab_ros.core.bridge.direct import GRANTS, OFFERS, REPORTS, grant, reported
from mrlab_ros.core.bridge.latency import stamps
from mrlab_ros.core.bridge.rules import Congestion, TopicRule
from mrlab_ros.nodes.playback import direct
from mrlab_ros.nodes.playback.direct import Direct, Stream

TOPIC = "/ur5e_1/joint_states"
RULE = TopicRule(TOPIC, priority=2, congestion=Congestion.DROP)
GRANT = grant(TOPIC, RULE)[1:]
DEADLINE_S = 20.0


class Zenoh:
    """A session whose publishers keep what they get; `heard`: whether there is a subscriber."""

    zid = "ab"

    def __init__(self) -> None:
        self.tokens: list[str] = []
        self.put: dict[str, list[tuple[bytes, bytes]]] = {}
        self.heard = True
        self.matched: Callable[[], None] = lambda: None
        self.granting: Callable[[str, bool], None] = lambda key, there: None
        # Undeclaring waits for it, as zenoh's may for a link.
        self.flowing = threading.Event()
        self.flowing.set()

    def token(self, key: str) -> Any:
        self.tokens.append(key)
        return Undeclared(lambda: self.tokens.remove(key))

    def follow_tokens(self, key: str, on_token: Callable[[str, bool], None]) -> Any:
        assert key == f"{GRANTS[1:]}/**"
        self.granting = on_token
        return Undeclared(lambda: None)

    def publisher(self, key: str, rule: TopicRule, cache: int, on_match: Any = None) -> Any:
        assert not cache
        if on_match is not None:
            assert rule == RULE
            self.matched = on_match
        return Publisher(self, self.put.setdefault(key, []))

    def close(self) -> None: ...


class Undeclared:
    def __init__(self, undeclare: Callable[[], object]) -> None:
        self.undeclare = undeclare


class Publisher:
    def __init__(self, session: Zenoh, got: list[tuple[bytes, bytes]]) -> None:
        self._session, self._got = session, got

    def put(self, payload: bytes, attachment: bytes) -> None:
        self._got.append((payload, attachment))

    def has_subscriber(self) -> bool:
        return self._session.heard

    def undeclare(self) -> None:
        self._session.flowing.wait(DEADLINE_S)


def until(condition: Callable[[], Any]) -> None:
    end = time.monotonic() + DEADLINE_S
    while not condition():
        assert time.monotonic() < end
        time.sleep(0.005)


@pytest.fixture
def session() -> Zenoh:
    return Zenoh()


@pytest.fixture
def opened(session: Zenoh, tmp_path: Path) -> Iterator[Direct]:
    (tmp_path / "sock").touch()
    made = Direct(str(tmp_path / "sock"), "", lambda _: session)  # type: ignore[arg-type, return-value]
    yield made
    session.flowing.set()
    made.close()


@pytest.fixture
def heard() -> Queue[bool]:
    """Return what gets an entry when the stream is heard again."""
    return Queue()


@pytest.fixture
def stream(opened: Direct, session: Zenoh, heard: Queue[bool]) -> Stream:
    made = opened.stream(TOPIC, lambda: heard.put(True))
    until(lambda: session.tokens == [f"{OFFERS[1:]}{TOPIC}"])
    return made


def test_nothing_is_put_before_the_grant_and_after_its_end(
    stream: Stream, session: Zenoh, heard: Queue[bool]
) -> None:
    got = session.put.setdefault(TOPIC[1:], [])
    stream.put(b"early", 1)
    session.granting(GRANT, True)
    heard.get(timeout=DEADLINE_S)
    assert heard.empty()
    stream.put(b"state", 7)
    session.granting(GRANT, False)
    session.granting(GRANT, True)
    heard.get(timeout=DEADLINE_S)
    stream.put(b"again", 9)
    assert [payload for payload, _ in got] == [b"state", b"again"]
    numbered = [found for _, each in got if (found := stamps(each))]
    assert [(each.sequence, each.published_ns) for each in numbered] == [(1, 7), (1, 9)]


def test_the_deadline_thread_waits_for_no_publisher_that_is_closed(
    stream: Stream, session: Zenoh, heard: Queue[bool]
) -> None:
    session.granting(GRANT, True)
    heard.get(timeout=DEADLINE_S)
    session.flowing.clear()
    session.granting(GRANT, False)

    def dropped() -> bool:
        before = len(session.put[TOPIC[1:]])
        began = time.monotonic()
        stream.put(b"state", 1)
        assert time.monotonic() - began < DEADLINE_S / 2
        return len(session.put[TOPIC[1:]]) == before

    until(dropped)


def test_what_nobody_hears_is_not_put(stream: Stream, session: Zenoh, heard: Queue[bool]) -> None:
    session.granting(GRANT, True)
    heard.get(timeout=DEADLINE_S)
    session.heard = False
    session.matched()

    def unheard() -> bool:
        before = len(session.put[TOPIC[1:]])
        stream.put(b"state", 1)
        return len(session.put[TOPIC[1:]]) == before

    until(unheard)
    session.heard = True
    session.matched()
    heard.get(timeout=DEADLINE_S)


def test_what_was_put_is_reported_once(
    opened: Direct, stream: Stream, session: Zenoh, heard: Queue[bool]
) -> None:
    session.granting(GRANT, True)
    heard.get(timeout=DEADLINE_S)
    for _ in range(3):
        stream.put(b"state", time.time_ns())
    opened.report()
    reports = session.put[REPORTS[1:]]
    until(lambda: reports)
    opened.report()
    opened.remove(stream)
    until(lambda: not session.tokens)
    ((payload, _),) = reports
    found = reported(payload)
    assert (found.name, found.bytes, len(found.delays_ns)) == (TOPIC, 15, 3)


def test_it_waits_for_the_bridge(
    session: Zenoh, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(direct, "LOOK_S", 0.01)
    monkeypatch.setattr(direct, "RETRY_S", 0.01)
    refused = []

    def open_third(socket: str) -> Any:
        refused.append(socket)
        if len(refused) < 3:
            raise Unavailable(NO_LAB_AT(endpoint=socket, why=of_text("asleep")))
        return session

    path = tmp_path / "sock"
    made = Direct(str(path), "", open_third)
    made.stream(TOPIC)
    assert not refused
    path.touch()
    until(lambda: session.tokens)
    made.close()
