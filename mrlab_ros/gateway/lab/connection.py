"""What the gateway needs of the lab: services, newest values, samples, presence."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from enum import Enum
from types import MappingProxyType
from typing import Any, Protocol

from mrlab_ros.core.base.errors import LabError
from mrlab_ros.gateway.lab.definitions import Definitions

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
    """What the lab offers now: key -> type. latched: topics whose newest message is kept."""

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
        """Whether the lab is there now."""
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
