"""The lab as the gateway needs it: services, newest values, samples, presence.

The bridge's liveliness tokens, read back into what the lab offers.

Key expressions: keys in which `*` stands for one part and `**` for any parts.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from enum import Enum
from functools import lru_cache
from types import MappingProxyType
from typing import Any, Protocol

from mrlab_ros.core.base.errors import LabError
from mrlab_ros.core.bridge.rules import SLASH
from mrlab_ros.gateway.lab.definitions import Definitions


@lru_cache(maxsize=4096)
def pattern(expression: str) -> re.Pattern[str]:
    """Return the pattern that the keys of an expression match."""
    parts = {"*": "/[^/]+", "**": "(?:/[^/]+)*"}
    return re.compile("".join(parts.get(p, "/" + re.escape(p)) for p in expression.split("/")))


def is_key(text: str) -> bool:
    """Return whether a text names one key: no pattern, no parameters behind a `?`."""
    return bool(text) and not any(each in text for each in "*?#$")


def matches(expression: str, key: str) -> bool:
    """Return whether a key belongs to an expression."""
    return pattern(expression).fullmatch(f"/{key}") is not None


class TokenTable:
    """The tokens that live now. prefix: what every key of the lab begins with."""

    def __init__(self, prefix: str) -> None:
        self._prefix = f"{prefix}/" if prefix else ""
        self._tokens: dict[str, None] = {}

    def add(self, token: str) -> None:
        self._tokens[token] = None

    def remove(self, token: str) -> None:
        self._tokens.pop(token, None)

    def clear(self) -> None:
        self._tokens.clear()

    @property
    def has_bridge(self) -> bool:
        """Return whether a bridge of this lab is there.

        A bridge with a prefix shows itself by the prefix of its keys: its own token has none.
        """
        if not self._prefix:
            return bool(self._tokens)
        keys = self.keys()
        return bool(keys.topics or keys.services)

    def keys(self) -> LabKeys:
        """Return the topics that come out and the services, below the prefix."""
        topics: dict[str, str] = {}
        services: dict[str, str] = {}
        latched: set[str] = set()
        for token in self._tokens:
            # @/<zenoh id>/@ros2_lv/<kind>/<key>/<type>[/<qos>]
            parts = token.split("/")
            if len(parts) < 6:
                continue
            kind, key, type_name = parts[3], _name(parts[4]), _name(parts[5])
            if not key.startswith(self._prefix):
                continue
            key = key[len(self._prefix) :]
            if kind == "MP":
                topics[key] = type_name
                # <keyless>:<reliability>:<durability>:<history>,<depth>
                if len(parts) > 6 and parts[6].split(":")[2:3] == ["1"]:
                    latched.add(key)
            elif kind == "SS":
                services[key] = type_name
        return LabKeys(MappingProxyType(topics), MappingProxyType(services), frozenset(latched))


def _name(chunk: str) -> str:
    return chunk.replace(SLASH, "/")


# s to wait for a response. The bridge ends a call itself, after 60 s at most, and says why.
CALL_TIMEOUT_S = 70.0
GET_TIMEOUT_S = 5.0


class NoAnswer(LabError):
    """Nobody answered: no lab, no such service, or not in time."""


class TimedOut(NoAnswer):
    """Somebody was asked, but did not answer in time."""


class Refused(LabError):
    """The bridge, or the owner of a key, answered that it does not do this; its words."""


class Phase(Enum):
    """How the connection to the lab is."""

    CONNECTING = "connecting"  # no session yet
    OPEN = "open"  # a bridge is there
    LOST = "lost"  # a session, but no bridge


@dataclass(frozen=True, slots=True)
class Sample:
    """A message of a key, or the answer to a get.

    payload: CDR of a message. sequence and published_ns: of its stamps, ns since 1970; 0: none.
    attachment: as it came; of a message these are its stamps.
    """

    key: str
    payload: bytes
    sequence: int = 0
    published_ns: int = 0
    attachment: bytes = b""


@dataclass(frozen=True)
class LabKeys:
    """Keys that the lab offers now: key -> type. latched: topics whose newest message is kept."""

    topics: Mapping[str, str] = field(default_factory=lambda: MappingProxyType({}))
    services: Mapping[str, str] = field(default_factory=lambda: MappingProxyType({}))
    latched: frozenset[str] = frozenset()


Unsubscribe = Callable[[], None]
OnSample = Callable[[Sample], None]
OnStatus = Callable[[], None]


class LabConnection(Protocol):
    """A lab, by the bridge's keys without their prefix. All of it belongs to one event loop."""

    definitions: Definitions

    async def open(self) -> None:
        """Begin to connect; return at once. It heals by itself until `close`."""
        ...

    async def close(self) -> None: ...

    @property
    def connected(self) -> bool:
        """Return whether the lab is connected."""
        ...

    @property
    def phase(self) -> Phase: ...

    @property
    def keys(self) -> LabKeys: ...

    def on_change(self, listener: OnStatus) -> Unsubscribe:
        """Call `listener` whenever phase or keys have changed."""
        ...

    async def call(
        self,
        service: str,
        type_name: str,
        request: Mapping[str, Any] | None = None,
        timeout_s: float = CALL_TIMEOUT_S,
    ) -> Any:
        """Call a service and return its response, with its fields as attributes.

        type_name: such as mrlab_msgs/srv/Trigger. Raises NoAnswer, Refused, or BadInput for a
        request that does not fit the type. `success` of the response is for the caller to check.
        """
        ...

    async def query(
        self, key: str, payload: bytes | None = None, timeout_s: float = CALL_TIMEOUT_S
    ) -> bytes:
        """Return the first answer's payload. Raises NoAnswer or Refused."""
        ...

    async def get(self, key: str, timeout_s: float = GET_TIMEOUT_S) -> Sample | None:
        """Return the newest message of a latched topic, or what a key such as schema delivers.

        key: may have parameters behind a `?`. None: nobody has it. Raises Refused.
        """
        ...

    async def get_all(self, key: str, timeout_s: float = GET_TIMEOUT_S) -> list[Sample]:
        """Return every answer for a key expression such as `*/playback_state`.

        Of each key the oldest comes first: a latched topic may keep several messages.
        """
        ...

    def subscribe(self, key: str, on_sample: OnSample) -> Unsubscribe:
        """Receive the messages of a key expression from now on, in the event loop."""
        ...

    def put(self, key: str, payload: bytes) -> None:
        """Publish on a key that comes in, such as latency/clients; dropped without a lab."""
        ...
