"""The bridge's port on zenoh itself."""

from __future__ import annotations

import json
from collections import deque
from collections.abc import Callable, Mapping
from functools import partial
from threading import Lock, Semaphore
from typing import Any

import zenoh
from zenoh import ext

from mrlab_ros.adapters import threads
from mrlab_ros.adapters.zenoh.configuration import first_line
from mrlab_ros.adapters.zenoh.diagnostics import ENDPOINT_TAKEN, ZENOH_NOT_OPEN
from mrlab_ros.adapters.zenoh.port import Declared, Publisher, Query
from mrlab_ros.adapters.zenoh.refusals import encoding_of
from mrlab_ros.core.base.diagnostic import Diagnostic, of_text
from mrlab_ros.core.base.errors import Unavailable
from mrlab_ros.core.bridge.guests import Link
from mrlab_ros.core.bridge.rules import Congestion, Reliability, TopicRule

# Threads that answer queries for latched topics, and how many queries may wait for them.
ANSWER_THREADS = 2
ANSWERS_WAITING = 4096
CONGESTION = {
    Congestion.DROP: zenoh.CongestionControl.DROP,
    Congestion.BLOCK: zenoh.CongestionControl.BLOCK,
}
RELIABILITY = {
    Reliability.RELIABLE: zenoh.Reliability.RELIABLE,
    Reliability.BEST_EFFORT: zenoh.Reliability.BEST_EFFORT,
}
# By number, 1 to 7.
PRIORITY = (
    zenoh.Priority.REAL_TIME,
    zenoh.Priority.INTERACTIVE_HIGH,
    zenoh.Priority.INTERACTIVE_LOW,
    zenoh.Priority.DATA_HIGH,
    zenoh.Priority.DATA,
    zenoh.Priority.DATA_LOW,
    zenoh.Priority.BACKGROUND,
)


class ZenohSession:
    """A Session on zenoh itself."""

    def __init__(self, config: zenoh.Config) -> None:
        self._answers = _Answers()
        # The publisher's cache for late joiners orders its messages by time.
        config.insert_json5("timestamping/enabled", "true")
        try:
            self._session = zenoh.open(config)
        except zenoh.ZError as error:
            raise _why_not_open(config, error) from error

    @property
    def zid(self) -> str:
        return str(self._session.zid())

    def publisher(
        self, key: str, rule: TopicRule, cache: int, on_match: Callable[[], None] | None = None
    ) -> Publisher:
        if cache:
            return _LatchedPublisher(self._session, key, rule, cache, self._answers)
        return _Publisher(self._session, key, rule, on_match)

    def subscriber(
        self,
        key: str,
        admit: Callable[[int], bool],
        on_payload: Callable[[bytes], None],
        late: bool,
    ) -> Declared:
        def on_sample(sample: zenoh.Sample) -> None:
            if sample.kind == zenoh.SampleKind.PUT and admit(len(sample.payload)):
                on_payload(sample.payload.to_bytes())

        # Only from other sessions: the bridge must not receive its own messages.
        origin = zenoh.Locality.REMOTE
        if late:
            history = ext.HistoryConfig(detect_late_publishers=True, max_samples=1)
            return ext.declare_advanced_subscriber(
                self._session, key, on_sample, allowed_origin=origin, history=history
            )
        return self._session.declare_subscriber(key, on_sample, allowed_origin=origin)

    def queryable(
        self, key: str, on_query: Callable[[Query], None], quick: bool = False
    ) -> Declared:
        def on_zenoh_query(query: zenoh.Query) -> None:
            on_query(_Query(key, query))

        return self._session.declare_queryable(
            key, zenoh.handlers.Callback(on_zenoh_query, indirect=not quick)
        )

    def token(self, key: str) -> Declared:
        return self._session.liveliness().declare_token(key)

    def follow_tokens(self, key: str, on_token: Callable[[str, bool], None]) -> Declared:
        def on_sample(sample: zenoh.Sample) -> None:
            on_token(str(sample.key_expr), sample.kind == zenoh.SampleKind.PUT)

        return self._session.liveliness().declare_subscriber(
            key, zenoh.handlers.Callback(on_sample, indirect=False), history=True
        )

    def follow_links(self, on_link: Callable[[Link, bool], None]) -> Declared:
        def on_event(event: zenoh.LinkEvent) -> None:
            link = event.link
            found = Link(link.src, link.dst, link.auth_identifier or "")
            on_link(found, event.kind == zenoh.SampleKind.PUT)

        return self._session.info.declare_link_events_listener(on_event)

    def close(self) -> None:
        self._answers.close()
        self._session.close()


class _Answers:
    """Answers queries for latched topics: a thread a topic would be a hundred with ten robots."""

    def __init__(self) -> None:
        self._threads = threads.Pool("zenoh_answers", ANSWER_THREADS)
        self._free = Semaphore(ANSWERS_WAITING)

    def give(self, answer: Callable[[zenoh.Query], None], query: zenoh.Query) -> None:
        """Call `answer` in another thread; a query too many ends without a reply."""
        if not self._free.acquire(blocking=False):
            query.drop()
            return
        try:
            self._threads.send(answer, query).add_done_callback(lambda _: self._free.release())
        except RuntimeError:  # closed meanwhile
            query.drop()

    def close(self) -> None:
        self._threads.shutdown(cancel_futures=True)


class _Publisher:
    """Publishes a stream: no message is cached."""

    def __init__(
        self,
        session: zenoh.Session,
        key: str,
        rule: TopicRule,
        on_match: Callable[[], None] | None = None,
    ) -> None:
        self._publisher = session.declare_publisher(
            key,
            congestion_control=CONGESTION[rule.congestion],
            reliability=RELIABILITY[rule.reliability],
            priority=PRIORITY[rule.priority - 1],
            express=rule.express,
        )
        # zenoh's object is borrowed by each call, and cannot be undeclared meanwhile.
        self._use = Lock()
        self._listener: Declared | None = None
        if on_match is not None:

            def on_status(_: zenoh.MatchingStatus) -> None:
                on_match()

            self._listener = self._publisher.declare_matching_listener(
                zenoh.handlers.Callback(on_status, indirect=False)
            )

    def put(self, payload: bytes, attachment: bytes) -> None:
        with self._use:
            self._publisher.put(payload, attachment=attachment)

    def has_subscriber(self) -> bool:
        try:
            with self._use:
                # Its annotation says bool, but it is an object that is always true.
                status: Any = self._publisher.matching_status
        except zenoh.ZError:  # undeclared meanwhile
            return False
        return bool(status.matching)

    def undeclare(self) -> None:
        if self._listener is not None:
            self._listener.undeclare()
        with self._use:
            self._publisher.undeclare()


class _LatchedPublisher:
    """Publishes a state: late joiners get the newest messages from an advanced publisher's cache.

    A plain `get` on the key, without an advanced subscriber, returns the newest message, and with
    consolidation NONE all that are kept: of tf_static each publisher's state counts.
    """

    def __init__(
        self, session: zenoh.Session, key: str, rule: TopicRule, cache: int, answers: _Answers
    ) -> None:
        self._key = key
        self._kept: deque[tuple[bytes, bytes, zenoh.Timestamp]] = deque(maxlen=cache)
        self._now = session.new_timestamp
        self._use = Lock()
        # An advanced publisher does not report whether it has subscribers; this plain one does.
        self._probe = _Publisher(session, key, rule)
        self._publisher = ext.declare_advanced_publisher(
            session,
            key,
            congestion_control=CONGESTION[rule.congestion],
            reliability=RELIABILITY[rule.reliability],
            priority=PRIORITY[rule.priority - 1],
            express=rule.express,
            cache=ext.CacheConfig(cache),
            publisher_detection=True,
        )
        give = partial(answers.give, self._answer)
        self._queryable = session.declare_queryable(
            key, zenoh.handlers.Callback(give, indirect=False)
        )

    def put(self, payload: bytes, attachment: bytes) -> None:
        stamp = self._now()
        self._kept.append((payload, attachment, stamp))
        with self._use:
            self._publisher.put(payload, attachment=attachment, timestamp=stamp)

    def has_subscriber(self) -> bool:
        return self._probe.has_subscriber()

    def _answer(self, query: zenoh.Query) -> None:
        # By their timestamps zenoh consolidates the replies of one key to the newest.
        for payload, attachment, stamp in tuple(self._kept):
            query.reply(self._key, payload, attachment=attachment, timestamp=stamp)
        # zenoh ends the caller's wait only when the query is dropped.
        query.drop()

    def undeclare(self) -> None:
        self._queryable.undeclare()
        with self._use:
            self._publisher.undeclare()
        self._probe.undeclare()


class _Query:
    def __init__(self, key: str, query: zenoh.Query) -> None:
        self._key = key
        self._query = query

    @property
    def key(self) -> str:
        return str(self._query.key_expr)

    @property
    def parameters(self) -> Mapping[str, str]:
        found: dict[str, str] = dict(self._query.parameters)  # type: ignore[call-overload]
        return found

    @property
    def size(self) -> int:
        payload = self._query.payload
        return 0 if payload is None else len(payload)

    @property
    def payload(self) -> bytes | None:
        payload = self._query.payload
        return None if payload is None else payload.to_bytes()

    def reply(self, payload: bytes) -> None:
        self._query.reply(self._key, payload)
        # zenoh ends the caller's wait only when the query is dropped.
        self._query.drop()

    def reply_asset(self, payload: bytes, media_type: str, attachment: bytes) -> None:
        self._query.reply(
            self._query.key_expr,
            payload,
            encoding=media_type,
            attachment=attachment,
        )
        self._query.drop()

    def refuse(self, reason: Diagnostic) -> None:
        self._query.reply_err(str(reason).encode(), encoding=encoding_of(reason))
        self._query.drop()

    def ignore(self) -> None:
        self._query.drop()


def _why_not_open(config: zenoh.Config, error: zenoh.ZError) -> Unavailable:
    endpoints = _endpoints(config.get_json("listen/endpoints"))
    # zenoh tells by its text alone.
    if "Address already in use" in str(error):
        return Unavailable(ENDPOINT_TAKEN(endpoints=endpoints))
    return Unavailable(ZENOH_NOT_OPEN(endpoints=endpoints, why=of_text(first_line(error))))


def _endpoints(text: str) -> list[str]:
    """Return the endpoints of zenoh's JSON, a list or one a mode."""
    found = json.loads(text)
    return found if isinstance(found, list) else [e for each in found.values() for e in each or ()]
