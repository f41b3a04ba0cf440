"""Joint states that go to zenoh where they are made, beside the graph; see core.bridge.direct.

A thread opens the session with the bridge of this machine and follows what it grants. Without a
bridge, or without its grant, nothing is put: the bridge then forwards what is in the graph.
"""

from __future__ import annotations

import threading
import time
from collections import deque
from collections.abc import Callable
from functools import partial
from pathlib import Path

from mrlab_ros.adapters.zenoh.configuration import configuration
from mrlab_ros.adapters.zenoh.port import Declared, Publisher, Session
from mrlab_ros.core.base.errors import LabError
from mrlab_ros.core.bridge import direct
from mrlab_ros.core.bridge.latency import attachment
from mrlab_ros.core.bridge.links import key_of, local_endpoint
from mrlab_ros.core.bridge.rules import Congestion, TopicRule
from mrlab_ros.ros.deadlines import REALTIME, take_precedence
from mrlab_ros.ros.worker import Worker

# Between two looks for the bridge's socket, and between two attempts to connect to it, s.
LOOK_S, RETRY_S = 0.5, 5.0


def _opened(socket: str) -> Session:
    # Here: a playback without a bridge needs no zenoh.
    from mrlab_ros.adapters.zenoh.session import ZenohSession

    endpoint = local_endpoint(socket)
    return ZenohSession(configuration(mode="client", listen=(), connect=(endpoint,)))


class Stream:
    """One topic. put() is for one thread, which it never keeps; all else is for that of Direct.

    zenoh takes a message into a link's buffer, or drops it where that is full: 5 us, and 0.2 ms
    beside much other work, also while the bridge stands still. name: the topic's.
    """

    def __init__(
        self,
        name: str,
        later: Callable[[Callable[[], None]], None],
        on_heard: Callable[[], None],
    ) -> None:
        """later: has the thread of Direct do something. on_heard: see Direct.stream()."""
        self.name = name
        self.offer: Declared | None = None
        self._later = later
        self._on_heard = on_heard
        self._publisher: Publisher | None = None
        # Held while the publisher is used or exchanged, not while it is closed.
        self._use = threading.Lock()
        self._heard = False
        self._sequence = 0
        # Sizes and delays of what was put since the last report.
        self._carried: deque[tuple[int, int]] = deque()

    def put(self, payload: bytes, published_ns: int) -> None:
        """Put a message where anybody hears it. published_ns: in the graph, just now."""
        if not self._heard or not self._use.acquire(blocking=False):
            return
        try:
            if self._publisher is not None:
                self._sequence += 1
                now_ns = time.time_ns()
                self._publisher.put(payload, attachment(self._sequence, published_ns, now_ns))
                self._carried.append((len(payload), now_ns - published_ns))
        finally:
            self._use.release()

    def begin(self, session: Session, key: str, rule: TopicRule) -> None:
        """Put messages by `rule` from now on."""
        self._exchange(session.publisher(key, rule, 0, partial(self._later, self._look)))
        self._look()

    def end(self) -> None:
        """Put no further messages."""
        self._exchange(None)

    def take(self) -> direct.Carried:
        """Return what was put since the last call."""
        carried = [self._carried.popleft() for _ in range(len(self._carried))]
        return direct.Carried(
            self.name, sum(size for size, _ in carried), [delay_ns for _, delay_ns in carried]
        )

    def _exchange(self, publisher: Publisher | None) -> None:
        with self._use:
            former, self._publisher = self._publisher, publisher
            self._heard, self._sequence = False, 0
        if former is not None:
            former.undeclare()

    def _look(self) -> None:
        before = self._heard
        self._heard = self._publisher is not None and self._publisher.has_subscriber()
        if self._heard and not before:
            self._on_heard()


class Direct:
    """Puts the topics of one process on zenoh; all methods return at once.

    socket: the bridge's. prefix: what its keys begin with.
    """

    def __init__(
        self, socket: str, prefix: str, opened: Callable[[str], Session] = _opened
    ) -> None:
        self._socket = Path(socket)
        self._prefix = prefix
        self._opened = opened
        self._session: Session | None = None
        self._streams: dict[str, Stream] = {}
        self._grants: dict[str, TopicRule] = {}
        # When to connect next, s.
        self._next = 0.0
        self._worker = Worker("direct", self._try, self._until_due)
        # While it runs Python the deadline thread waits for it.
        self._worker.send(partial(take_precedence, REALTIME - 2))

    def stream(self, topic: str, on_heard: Callable[[], None] = lambda: None) -> Stream:
        """Offer a topic, and return what puts its messages.

        on_heard: called in a thread of this object's own when somebody hears it and nobody did
        before; it must not wait.
        """
        stream = Stream(topic, self._worker.send, on_heard)
        self._worker.send(partial(self._add, stream))
        return stream

    def remove(self, stream: Stream) -> None:
        """Offer a topic no more."""
        self._worker.send(partial(self._remove, stream))

    def report(self) -> None:
        """Tell the bridge what was put since the last report."""
        # One by one: between two the deadline thread may run Python.
        for stream in tuple(self._streams.values()):
            self._worker.send(partial(self._report, stream))

    def close(self) -> None:
        """End, with all streams, and wait for it."""
        self._worker.close()
        if self._session is not None:
            self._session.close()

    def _until_due(self) -> float | None:
        return None if self._session is not None else max(self._next - time.monotonic(), 0.0)

    def _try(self) -> None:
        """Connect where there is a bridge."""
        wait = LOOK_S
        if self._socket.exists():
            try:
                self._connect()
            except LabError:
                wait = RETRY_S
        self._next = time.monotonic() + wait

    def _connect(self) -> None:
        session = self._opened(str(self._socket))
        reports = TopicRule(direct.REPORTS, congestion=Congestion.DROP)
        self._reports = session.publisher(self._key(direct.REPORTS), reports, 0)
        grants = f"{self._key(direct.GRANTS)}/**"
        self._following = session.follow_tokens(
            grants, lambda key, there: self._worker.send(partial(self._on_grant, key, there))
        )
        self._session = session
        for stream in self._streams.values():
            self._offer(session, stream)

    def _key(self, name: str) -> str:
        return key_of(name, self._prefix)

    def _offer(self, session: Session, stream: Stream) -> None:
        stream.offer = session.token(self._key(direct.OFFERS + stream.name))

    def _add(self, stream: Stream) -> None:
        self._streams[stream.name] = stream
        if self._session is not None:
            self._offer(self._session, stream)
        self._settle(stream.name)

    def _remove(self, stream: Stream) -> None:
        del self._streams[stream.name]
        stream.end()
        if stream.offer is not None:
            stream.offer.undeclare()

    def _on_grant(self, key: str, there: bool) -> None:
        rule = direct.granted("/" + key.removeprefix(self._key("/")))
        if there:
            self._grants[rule.name] = rule
        else:
            self._grants.pop(rule.name, None)
        self._settle(rule.name)

    def _settle(self, topic: str) -> None:
        stream, rule = self._streams.get(topic), self._grants.get(topic)
        if stream is not None and rule is not None and self._session is not None:
            stream.begin(self._session, self._key(topic), rule)
        elif stream is not None:
            stream.end()

    def _report(self, stream: Stream) -> None:
        carried = stream.take()
        if carried.delays_ns:
            self._reports.put(direct.report(carried), b"")
