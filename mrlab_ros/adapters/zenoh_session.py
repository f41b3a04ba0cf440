"""zenoh behind a small port: publishers, subscribers, queryables, liveliness tokens."""

from __future__ import annotations

import json
from collections import deque
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any, Protocol

import zenoh
from zenoh import ext

from mrlab_ros.core.bridge.guests import Link
from mrlab_ros.core.bridge.links import (
    LEASE_BEYOND,
    LEASE_WITHIN,
    healing,
    is_local,
)
from mrlab_ros.core.bridge.rules import Congestion, Reliability, TopicRule
from mrlab_ros.core.errors import BadInput, Unavailable

LOOPBACK = ("tcp/127.0.0.1:7447",)
# How long a put waits for a full link, us, before its message is dropped, and before the client of
# that link is disconnected. zenoh's defaults are 1,000 and 5,000,000.
WAIT_BEFORE_DROP = 0
WAIT_BEFORE_CLOSE = 1_000_000
# Size of a link's socket buffer, bytes. Linux alone would let it grow to megabytes, and a client
# that reads slowly would receive motion that is many seconds old.
SEND_BUFFER = 131_072
# The settings in config/zenoh/lab.json5.
LIMITS = (
    "scouting/multicast/enabled",
    "scouting/gossip/enabled",
    "adminspace/enabled",
    "transport/unicast/accept_timeout",
    "transport/unicast/accept_pending",
    "transport/unicast/max_sessions",
    "transport/link/protocols",
    "transport/link/rx/max_message_size",
)
# zenoh's log targets for TLS and for subjects unknown to access control, and for passwords.
LOGINS = "error,zenoh_link_tls=debug,zenoh::net::routing::interceptor::access_control=info"
PASSWORDS = "zenoh_transport::unicast::establishment::accept=debug"
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


class Declared(Protocol):
    """Something declared on a session."""

    def undeclare(self) -> None: ...


class Publisher(Declared, Protocol):
    """A key to publish on."""

    def put(self, payload: bytes, attachment: bytes) -> None: ...

    def has_subscriber(self) -> bool:
        """Return whether the key has a subscriber."""
        ...


class Query(Protocol):
    """A query that waits for its one reply; `payload` is None where it has none.

    key: the queried key expression, perhaps a pattern such as `*/play`. parameters: what stands
    behind the `?` of its selector.
    """

    @property
    def key(self) -> str: ...

    @property
    def parameters(self) -> Mapping[str, str]: ...

    @property
    def size(self) -> int:
        """Bytes of the payload, which is not copied for it."""
        ...

    @property
    def payload(self) -> bytes | None: ...

    def reply(self, payload: bytes) -> None: ...

    def reply_asset(self, payload: bytes, media_type: str, attachment: bytes) -> None:
        """Reply on the queried key, which must not be a pattern."""
        ...

    def refuse(self, reason: str) -> None: ...

    def ignore(self) -> None:
        """End the caller's wait without a reply."""
        ...


class Session(Protocol):
    """What the bridge needs of zenoh. Callbacks run in the session's threads."""

    @property
    def zid(self) -> str: ...

    def publisher(self, key: str, rule: TopicRule, cache: int) -> Publisher:
        """Declare a publisher that keeps the newest `cache` messages for late joiners."""
        ...

    def subscriber(
        self,
        key: str,
        admit: Callable[[int], bool],
        on_payload: Callable[[bytes], None],
        late: bool,
    ) -> Declared:
        """Declare a subscriber to other sessions; `late`: it also gets their cached messages.

        admit: gets a message's size, bytes, and says whether it is to be read at all.
        """
        ...

    def queryable(self, key: str, on_query: Callable[[Query], None]) -> Declared: ...

    def token(self, key: str) -> Declared:
        """Declare a liveliness token."""
        ...

    def follow_links(self, on_link: Callable[[Link, bool], None]) -> Declared:
        """Call `on_link` with every link that is opened (True) or closed (False)."""
        ...

    def close(self) -> None: ...


def configuration(
    file: Path | None = None,
    *,
    mode: str = "peer",
    listen: tuple[str, ...] = LOOPBACK,
    connect: tuple[str, ...] = (),
    base: Path | None = None,
    security: Mapping[str, object] | None = None,
    lease: float = 0.0,
) -> zenoh.Config:
    """Return zenoh's configuration: `file` (json5) where given, else from the other arguments.

    base: a json5 file that the others add to. security: path -> value, such as a keys folder's.
    lease: s after which a silent link counts as broken; 0: by the endpoints. Without a file
    multicast discovery is off. Raises BadInput where zenoh refuses one.
    """
    try:
        if file is not None:
            return zenoh.Config.from_file(str(file))
        config = zenoh.Config() if base is None else zenoh.Config.from_file(str(base))
        config.insert_json5("mode", json.dumps(mode))
        config.insert_json5("listen/endpoints", json.dumps(listen))
        config.insert_json5("connect/endpoints", json.dumps(connect))
        config.insert_json5("scouting/multicast/enabled", "false")
        queue = "transport/link/tx/queue/congestion_control"
        config.insert_json5(f"{queue}/drop/wait_before_drop", json.dumps(WAIT_BEFORE_DROP))
        config.insert_json5(f"{queue}/block/wait_before_close", json.dumps(WAIT_BEFORE_CLOSE))
        if not lease:
            within = all(is_local(endpoint) for endpoint in (*listen, *connect))
            lease = LEASE_WITHIN if within else LEASE_BEYOND
        config.insert_json5("transport/link/tcp/so_sndbuf", json.dumps(SEND_BUFFER))
        config.insert_json5("transport/link/tls/so_sndbuf", json.dumps(SEND_BUFFER))
        for path, value in (healing(lease) | dict(security or {})).items():
            config.insert_json5(path, json.dumps(value))
    except (zenoh.ZError, OSError) as error:
        raise BadInput(
            f"zenoh does not accept {file or f'mode {mode}, listen {listen}, connect {connect}'}: "
            f"{_first_line(error)}; see docs/bridge.md for examples"
        ) from error
    return config


def limits(file: Path) -> dict[str, object]:
    """Return the settings in config/zenoh/lab.json5, path -> value."""
    config = zenoh.Config.from_file(str(file))
    return {path: json.loads(config.get_json(path)) for path in LIMITS}


def log_logins(*, passwords: bool) -> None:
    """Have zenoh log to stdout who connects and who is refused; RUST_LOG overrides that."""
    zenoh.init_log_from_env_or(f"{LOGINS},{PASSWORDS}" if passwords else LOGINS)


class ZenohSession:
    """A Session on zenoh itself."""

    def __init__(self, config: zenoh.Config) -> None:
        # The publisher's cache for late joiners orders its messages by time.
        config.insert_json5("timestamping/enabled", "true")
        try:
            self._session = zenoh.open(config)
        except zenoh.ZError as error:
            raise _why_not_open(config, error) from error

    @property
    def zid(self) -> str:
        return str(self._session.zid())

    def publisher(self, key: str, rule: TopicRule, cache: int) -> Publisher:
        if cache:
            return _LatchedPublisher(self._session, key, rule, cache)
        return _Publisher(self._session, key, rule)

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

    def queryable(self, key: str, on_query: Callable[[Query], None]) -> Declared:
        return self._session.declare_queryable(key, lambda query: on_query(_Query(key, query)))

    def token(self, key: str) -> Declared:
        return self._session.liveliness().declare_token(key)

    def follow_links(self, on_link: Callable[[Link, bool], None]) -> Declared:
        def on_event(event: zenoh.LinkEvent) -> None:
            link = event.link
            found = Link(link.src, link.dst, link.auth_identifier or "")
            on_link(found, event.kind == zenoh.SampleKind.PUT)

        return self._session.info.declare_link_events_listener(on_event)

    def close(self) -> None:
        self._session.close()


class _Publisher:
    """Publishes a stream: no message is cached."""

    def __init__(self, session: zenoh.Session, key: str, rule: TopicRule) -> None:
        self._publisher = session.declare_publisher(
            key,
            congestion_control=CONGESTION[rule.congestion],
            reliability=RELIABILITY[rule.reliability],
            priority=PRIORITY[rule.priority - 1],
            express=rule.express,
        )

    def put(self, payload: bytes, attachment: bytes) -> None:
        self._publisher.put(payload, attachment=attachment)

    def has_subscriber(self) -> bool:
        try:
            # Its annotation says bool, but it is an object that is always true.
            status: Any = self._publisher.matching_status
        except zenoh.ZError:  # undeclared meanwhile
            return False
        return bool(status.matching)

    def undeclare(self) -> None:
        self._publisher.undeclare()


class _LatchedPublisher:
    """Publishes a state: late joiners get the newest messages from an advanced publisher's cache.

    A plain `get` on the key, without an advanced subscriber, returns the newest message, and with
    consolidation NONE all that are kept: of tf_static each publisher's state counts.
    """

    def __init__(self, session: zenoh.Session, key: str, rule: TopicRule, cache: int) -> None:
        self._key = key
        self._kept: deque[tuple[bytes, bytes, zenoh.Timestamp]] = deque(maxlen=cache)
        self._now = session.new_timestamp
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
        self._queryable = session.declare_queryable(key, self._answer)

    def put(self, payload: bytes, attachment: bytes) -> None:
        stamp = self._now()
        self._kept.append((payload, attachment, stamp))
        self._publisher.put(payload, attachment=attachment, timestamp=stamp)

    def has_subscriber(self) -> bool:
        return self._probe.has_subscriber()

    def _answer(self, query: zenoh.Query) -> None:
        # By their timestamps zenoh consolidates the replies of one key to the newest.
        for payload, attachment, stamp in tuple(self._kept):
            query.reply(self._key, payload, attachment=attachment, timestamp=stamp)

    def undeclare(self) -> None:
        self._queryable.undeclare()
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

    def refuse(self, reason: str) -> None:
        self._query.reply_err(reason.encode(), encoding=zenoh.Encoding.TEXT_PLAIN)
        self._query.drop()

    def ignore(self) -> None:
        self._query.drop()


def _first_line(error: Exception) -> str:
    return str(error).split(" at /", 1)[0].strip()


def _why_not_open(config: zenoh.Config, error: zenoh.ZError) -> Unavailable:
    endpoints = ", ".join(_endpoints(config.get_json("listen/endpoints")))
    if "Address already in use" in str(error):
        return Unavailable(
            f"the bridge cannot listen on {endpoints}: another program has that port, perhaps a "
            "lab that still runs; stop it, or choose another port with the parameter listen"
        )
    return Unavailable(
        f"the bridge cannot open zenoh on {endpoints}: {_first_line(error)}; check the "
        "parameters listen, connect and zenoh_config"
    )


def _endpoints(text: str) -> list[str]:
    """Return the endpoints of zenoh's JSON, a list or one a mode."""
    found = json.loads(text)
    return found if isinstance(found, list) else [e for each in found.values() for e in each or ()]
