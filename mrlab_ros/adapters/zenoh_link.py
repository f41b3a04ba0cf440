"""A zenoh client of a lab on this machine: keys, payloads and errors, nothing of ROS."""

from __future__ import annotations

import json
from collections.abc import Callable

import zenoh

from mrlab_ros.adapters.zenoh.configuration import first_line
from mrlab_ros.adapters.zenoh.diagnostics import NO_LAB_AT, NOTHING_ANSWERS
from mrlab_ros.adapters.zenoh.refusals import refusal
from mrlab_ros.core.base.diagnostic import of_text
from mrlab_ros.core.base.errors import LabError, Unavailable

# A bridge that stands still does not answer a handshake either, ms.
OPEN_TIMEOUT_MS = 700


class Refusal(LabError):
    """The bridge answered a query with an error, which says why."""


class NoQueryable(LabError):
    """Nothing answers the key."""


class ZenohLink:
    """A session with one endpoint. Callbacks run in the session's threads."""

    def __init__(self, endpoint: str) -> None:
        """Connect; raise Unavailable where nothing answers there."""
        zenoh.init_log_from_env_or("off")
        config = zenoh.Config()
        for path, value in {
            "mode": "client",
            "connect/endpoints": [endpoint],
            "connect/timeout_ms": OPEN_TIMEOUT_MS,
            "scouting/multicast/enabled": False,
            "transport/unicast/open_timeout": OPEN_TIMEOUT_MS,
        }.items():
            config.insert_json5(path, json.dumps(value))
        try:
            self._session = zenoh.open(config)
        except zenoh.ZError as error:
            why = of_text(first_line(error))
            raise Unavailable(NO_LAB_AT(endpoint=endpoint, why=why)) from None

    def close(self) -> None:
        self._session.close()

    def subscribe(self, key: str, on_payload: Callable[[bytes], None]) -> Callable[[], None]:
        """Call `on_payload` with every message of `key` from now on; return what ends that."""

        def receive(sample: zenoh.Sample) -> None:
            if sample.kind == zenoh.SampleKind.PUT:
                on_payload(sample.payload.to_bytes())

        undeclare: Callable[[], None] = self._session.declare_subscriber(key, receive).undeclare
        return undeclare

    def query(self, key: str, payload: bytes = b"", timeout: float = 2.0) -> bytes:
        """Return the reply of `key`; timeout: s.

        Raises Refusal where the reply is an error, NoQueryable where none comes.
        """
        for reply in self._session.get(key, payload=payload or None, timeout=timeout):
            if reply.ok is not None:
                return reply.ok.payload.to_bytes()
            if reply.err is not None:
                raise Refusal(refusal(reply.err))
        raise NoQueryable(NOTHING_ANSWERS(key=key))
