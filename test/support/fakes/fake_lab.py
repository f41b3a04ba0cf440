"""A lab in memory, for tests: what is published, offered and answered is set by hand."""

from __future__ import annotations

import asyncio
from collections import deque
from collections.abc import Callable, Mapping
from dataclasses import replace
from functools import partial
from types import MappingProxyType
from typing import Any

from mrlab_ros.gateway.lab.connection import (
    CALL_TIMEOUT_S,
    GET_TIMEOUT_S,
    LabKeys,
    NoAnswer,
    OnSample,
    OnStatus,
    Phase,
    Sample,
    TimedOut,
    Unsubscribe,
    matches,
)
from mrlab_ros.gateway.lab.definitions import Definitions, installed_definitions
from mrlab_ros.gateway.lab.diagnostics import CALL_TIMED_OUT, NOBODY_ANSWERS

# Gets the decoded request, returns the fields of the response; raises Refused or NoAnswer.
Handler = Callable[[Any], Mapping[str, Any]]


class FakeLab:
    """A LabConnection without zenoh.

    calls: (service, decoded request) of every call. sent: (key, payload) of every put.
    held: services that do not answer until `release`.
    """

    def __init__(self, definitions: Definitions | None = None) -> None:
        self.definitions = definitions or installed_definitions()
        self.calls: list[tuple[str, Any]] = []
        self.sent: list[tuple[str, bytes]] = []
        self.held: dict[str, asyncio.Event] = {}
        self._phase = Phase.OPEN
        self._keys = LabKeys()
        self._handlers: dict[str, tuple[str, Handler]] = {}
        self._newest: dict[str, deque[Sample]] = {}
        self._sequence: dict[str, int] = {}
        self._listeners: dict[object, OnStatus] = {}
        self._subscribers: dict[object, tuple[str, OnSample]] = {}

    async def open(self) -> None: ...

    async def close(self) -> None: ...

    @property
    def connected(self) -> bool:
        return self._phase is Phase.OPEN

    @property
    def phase(self) -> Phase:
        return self._phase

    @property
    def keys(self) -> LabKeys:
        return self._keys

    def on_change(self, listener: OnStatus) -> Unsubscribe:
        entry = object()
        self._listeners[entry] = listener
        return partial(self._listeners.__delitem__, entry)

    def set_phase(self, phase: Phase) -> None:
        """Change the phase; without a bridge all keys go."""
        self._phase = phase
        if phase is not Phase.OPEN:
            self._keys = LabKeys()
        self._tell()

    def offer(self, key: str, type_name: str, *, latched: bool = False, history: int = 1) -> None:
        """Announce a topic; history: messages that a latched one keeps."""
        self._newest[key] = deque(maxlen=history)
        topics = {**self._keys.topics, key: type_name}
        held = self._keys.latched | {key} if latched else self._keys.latched - {key}
        self._keys = replace(self._keys, topics=MappingProxyType(topics), latched=held)
        self._tell()

    def withdraw(self, key: str) -> None:
        """Take a topic or a service away."""
        self._newest.pop(key, None)
        self._handlers.pop(key, None)
        self._keys = LabKeys(
            MappingProxyType({k: v for k, v in self._keys.topics.items() if k != key}),
            MappingProxyType({k: v for k, v in self._keys.services.items() if k != key}),
            self._keys.latched - {key},
        )
        self._tell()

    def serve(self, service: str, type_name: str, handler: Handler) -> None:
        """Answer a service from now on."""
        self._handlers[service] = type_name, handler
        services = {**self._keys.services, service: type_name}
        self._keys = replace(self._keys, services=MappingProxyType(services))
        self._tell()

    def hold(self, service: str) -> Callable[[], None]:
        """Let calls of a service wait until the returned function is called."""
        self.held[service] = event = asyncio.Event()
        return event.set

    def publish(
        self, key: str, message: bytes | Mapping[str, Any], *, published_ns: int = 0
    ) -> None:
        """Deliver a message: CDR, or the fields of the type that the key was offered with."""
        if not isinstance(message, bytes):
            message = self.definitions.encode(self._keys.topics[key], message)
        self._sequence[key] = self._sequence.get(key, 0) + 1
        sample = Sample(key, message, self._sequence[key], published_ns)
        if key in self._keys.latched:
            self._newest[key].append(sample)
        for pattern, on_sample in list(self._subscribers.values()):
            if matches(pattern, key):
                on_sample(sample)

    async def call(
        self,
        service: str,
        type_name: str,
        request: Mapping[str, Any] | None = None,
        timeout_s: float = CALL_TIMEOUT_S,
    ) -> Any:
        payload = self.definitions.encode(f"{type_name}_Request", request or {})
        answer = await self.query(service, payload, timeout_s)
        return self.definitions.decode(f"{type_name}_Response", answer)

    async def query(
        self, key: str, payload: bytes | None = None, timeout_s: float = CALL_TIMEOUT_S
    ) -> bytes:
        if key not in self._handlers:
            raise NoAnswer(NOBODY_ANSWERS(key=key))
        type_name, handler = self._handlers[key]
        asked = f"{type_name}_Request"
        request = self.definitions.decode(asked, payload or self.definitions.encode(asked, {}))
        self.calls.append((key, request))
        if key in self.held:
            try:
                await asyncio.wait_for(self.held[key].wait(), timeout_s)
            except asyncio.TimeoutError:
                raise TimedOut(CALL_TIMED_OUT(key=key, timeout=timeout_s)) from None
        return self.definitions.encode(f"{type_name}_Response", handler(request))

    async def get(self, key: str, timeout_s: float = GET_TIMEOUT_S) -> Sample | None:
        return next(reversed(await self.get_all(key, timeout_s)), None)

    async def get_all(self, key: str, timeout_s: float = GET_TIMEOUT_S) -> list[Sample]:
        pattern = key.partition("?")[0]
        return [
            sample
            for name, kept in self._newest.items()
            if matches(pattern, name)
            for sample in kept
        ]

    def subscribe(self, key: str, on_sample: OnSample) -> Unsubscribe:
        entry = object()
        self._subscribers[entry] = key, on_sample
        return lambda: self._subscribers.pop(entry, None) and None

    def put(self, key: str, payload: bytes) -> None:
        self.sent.append((key, payload))

    def _tell(self) -> None:
        for listener in list(self._listeners.values()):
            listener()
