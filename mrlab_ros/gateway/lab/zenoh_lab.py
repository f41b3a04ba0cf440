"""The lab over a real zenoh session."""

from __future__ import annotations

import asyncio
import json
import logging
from collections import deque
from collections.abc import Callable, Mapping
from contextlib import suppress
from functools import partial
from pathlib import Path
from typing import Any

import zenoh

from mrlab_ros.adapters.zenoh.configuration import LOOPBACK, configuration, first_line
from mrlab_ros.adapters.zenoh.refusals import refusal
from mrlab_ros.core.base.diagnostic import Diagnostic, Fix
from mrlab_ros.core.base.errors import LabError
from mrlab_ros.core.bridge.latency import stamps
from mrlab_ros.gateway.lab.connection import (
    CALL_TIMEOUT_S,
    GET_TIMEOUT_S,
    LabKeys,
    NoAnswer,
    OnSample,
    OnStatus,
    Phase,
    Refused,
    Sample,
    TimedOut,
    TokenTable,
    Unsubscribe,
)
from mrlab_ros.gateway.lab.definitions import Definitions, learning_definitions
from mrlab_ros.gateway.lab.diagnostics import CALL_TIMED_OUT, LAB_UNCONNECTED, NOBODY_ANSWERS

SCHEMA = "schema"
TOKENS = "@/*/@ros2_lv/**"
# s between two attempts to open the session.
RETRY_S = 0.5
# zenoh's own answer after a time-out.
ZENOH_TIMEOUT = "Timeout"
log = logging.getLogger(__name__)


class ZenohLab:
    """A LabConnection that opens its session when it can, and again after a failure.

    config: zenoh's, as configuration() of the adapters returns it. prefix: of the lab's keys.
    zenoh calls back in threads of its own; one deque and one wake-up bring a burst of samples
    into the event loop.
    """

    def __init__(self, config: zenoh.Config, definitions: Definitions, prefix: str = "") -> None:
        self.definitions = definitions
        self._config = config
        self._root = f"{prefix}/" if prefix else ""
        self._tokens = TokenTable(prefix)
        self._keys = LabKeys()
        self._phase = Phase.CONNECTING
        self._listeners: dict[object, OnStatus] = {}
        self._wanted: dict[object, tuple[str, OnSample]] = {}
        self._declared: dict[object, zenoh.Subscriber[None]] = {}
        self._session: zenoh.Session | None = None
        self._loop: asyncio.AbstractEventLoop | None = None
        self._opening: asyncio.Task[None] | None = None
        self._learning: asyncio.Task[None] | None = None
        self._arrived: deque[Callable[[], None]] = deque()
        self._woken = False
        self._changed = False

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

    @property
    def connected(self) -> bool:
        return self._phase is Phase.OPEN

    async def open(self) -> None:
        """Begin to connect, in the running event loop; return at once."""
        self._loop = asyncio.get_running_loop()
        self._opening = asyncio.create_task(self._open())

    async def close(self) -> None:
        """Close the session."""
        for task in (self._opening, self._learning):
            if task is not None:
                task.cancel()
                with suppress(asyncio.CancelledError):
                    await task
        session, self._session = self._session, None
        if session is not None:
            await asyncio.to_thread(session.close)

    async def call(
        self,
        service: str,
        type_name: str,
        request: Mapping[str, Any] | None = None,
        timeout_s: float = CALL_TIMEOUT_S,
    ) -> Any:
        self._connection()
        payload = self.definitions.encode(f"{type_name}_Request", request or {})
        answer = await self.query(service, payload, timeout_s)
        return self.definitions.decode(f"{type_name}_Response", answer)

    def _connection(self) -> tuple[zenoh.Session, asyncio.AbstractEventLoop]:
        if self._session is None or self._loop is None:
            raise NoAnswer(LAB_UNCONNECTED())
        return self._session, self._loop

    async def query(
        self, key: str, payload: bytes | None = None, timeout_s: float = CALL_TIMEOUT_S
    ) -> bytes:
        replies = await self._ask(key, payload, timeout_s)
        if not replies:
            raise NoAnswer(NOBODY_ANSWERS(key=key))
        return replies[0].payload

    async def get(self, key: str, timeout_s: float = GET_TIMEOUT_S) -> Sample | None:
        replies = await self._ask(key, None, timeout_s)
        return replies[0] if replies else None

    async def get_all(self, key: str, timeout_s: float = GET_TIMEOUT_S) -> list[Sample]:
        found = await self._ask(key, None, timeout_s, consolidation=zenoh.ConsolidationMode.NONE)
        return sorted(found, key=lambda sample: (sample.key, sample.sequence))

    def subscribe(self, key: str, on_sample: OnSample) -> Unsubscribe:
        entry = object()
        self._wanted[entry] = key, on_sample
        if self._session is not None:
            self._declare(entry, key, on_sample)

        def unsubscribe() -> None:
            self._wanted.pop(entry, None)
            declared = self._declared.pop(entry, None)
            if declared is not None and self._session is not None:
                declared.undeclare()

        return unsubscribe

    def put(self, key: str, payload: bytes) -> None:
        if self._session is not None:
            self._session.put(
                f"{self._root}{key}", payload, congestion_control=zenoh.CongestionControl.DROP
            )

    async def _open(self) -> None:
        told = False
        while self._session is None:
            try:
                self._session = await asyncio.to_thread(zenoh.open, self._config)
            except zenoh.ZError as error:
                if not told:
                    log.warning("no connection to the lab yet: %s; trying on", first_line(error))
                    told = True
                await asyncio.sleep(RETRY_S)
        for entry, (key, on_sample) in list(self._wanted.items()):
            self._declare(entry, key, on_sample)
        # Kept by the session: a subscriber with a callback lives as long as it.
        self._session.liveliness().declare_subscriber(
            TOKENS, self._into_loop(self._on_token), history=True
        )
        self._set_phase()

    def _declare(self, entry: object, key: str, on_sample: OnSample) -> None:
        assert self._session is not None
        arrived, wake, root = self._arrived, self._wake, len(self._root)

        def on_put(sample: zenoh.Sample) -> None:
            found = _read(sample, root)
            arrived.append(lambda: on_sample(found) if entry in self._wanted else None)
            wake()

        self._declared[entry] = self._session.declare_subscriber(f"{self._root}{key}", on_put)

    def _on_token(self, sample: zenoh.Sample) -> None:
        token = str(sample.key_expr)
        if sample.kind == zenoh.SampleKind.PUT:
            self._tokens.add(token)
        else:
            self._tokens.remove(token)
        # Many come at once: read them when all are there.
        if not self._changed and self._loop is not None:
            self._changed = True
            self._loop.call_soon(self._read_tokens)

    def _read_tokens(self) -> None:
        self._changed = False
        self._keys = self._tokens.keys()
        self._set_phase()

    def _set_phase(self) -> None:
        before = self._phase
        self._phase = Phase.OPEN if self._tokens.has_bridge else Phase.LOST
        if self._phase is Phase.OPEN and before is not Phase.OPEN:
            self._learning = asyncio.create_task(self._learn())
        for listener in list(self._listeners.values()):
            listener()

    async def _learn(self) -> None:
        """Take the definitions from the lab that this machine does not have."""
        try:
            answer = await self.get(SCHEMA)
            document = json.loads(answer.payload) if answer is not None else {}
            others = self.definitions.learn(
                {**document.get("messages", {}), **document.get("services", {})}
            )
        except (LabError, ValueError) as error:
            log.warning("the lab's definitions are not known: %s", error)
            return
        if others:
            log.warning(
                "the lab defines %s otherwise than this machine; install the same version on both",
                ", ".join(others),
            )

    async def _ask(
        self,
        key: str,
        payload: bytes | None,
        timeout_s: float,
        consolidation: zenoh.ConsolidationMode = zenoh.ConsolidationMode.AUTO,
    ) -> list[Sample]:
        """Return the answers of a query; raise Refused where all are errors."""
        session, loop = self._connection()
        done = asyncio.Event()
        answers: list[Sample] = []
        refusals: list[Diagnostic | None] = []
        root = len(self._root)

        def on_reply(reply: zenoh.Reply) -> None:
            if reply.ok is not None:
                answers.append(_read(reply.ok, root))
            elif reply.err is not None:
                refusals.append(_refusal(reply.err))

        def on_end() -> None:
            with suppress(RuntimeError):  # the loop is closed
                loop.call_soon_threadsafe(done.set)

        handler = zenoh.handlers.Callback(on_reply, on_end, indirect=False)
        session.get(
            f"{self._root}{key}",
            handler,
            payload=payload,
            timeout=timeout_s,
            consolidation=consolidation,
        )
        await done.wait()
        if refusals and not answers:
            if refusals[0] is None:
                fixes = (Fix(command="mrlab status"),)
                raise TimedOut(CALL_TIMED_OUT(key=key, timeout=timeout_s, fixes=fixes))
            raise Refused(refusals[0])
        return answers

    def _into_loop(self, take: Callable[[Any], None]) -> Callable[[Any], None]:
        def on_value(value: Any) -> None:
            self._arrived.append(lambda: take(value))
            self._wake()

        return on_value

    def _wake(self) -> None:
        if not self._woken and self._loop is not None:
            self._woken = True
            with suppress(RuntimeError):  # the loop is closed
                self._loop.call_soon_threadsafe(self._drain)

    def _drain(self) -> None:
        # Before the deque is read: what comes meanwhile wakes again.
        self._woken = False
        arrived = self._arrived
        for _ in range(len(arrived)):
            arrived.popleft()()


def _refusal(error: zenoh.ReplyError) -> Diagnostic | None:
    """Return why a query is refused; None: nobody answered in time."""
    return None if error.payload.to_string() == ZENOH_TIMEOUT else refusal(error)


def _read(sample: zenoh.Sample, root: int) -> Sample:
    held = sample.attachment
    attached = b"" if held is None else held.to_bytes()
    known = stamps(attached)
    return Sample(
        str(sample.key_expr)[root:],
        sample.payload.to_bytes(),
        known.sequence if known else 0,
        known.published_ns if known else 0,
        attached,
    )


def lab_at(endpoint: str, file: Path | None, prefix: str) -> ZenohLab:
    """Return a connection that is not open yet: to `endpoint`, with the settings of `file`.

    file: a zenoh client's, which holds its key. endpoint: empty for that of the file, or without a
    file for LOOPBACK. Raises BadInput where zenoh does not accept one of them.
    """
    connect = (endpoint,) if endpoint else LOOPBACK
    config = configuration(file, mode="client", listen=(), connect=connect)
    if file is not None and endpoint:
        config.insert_json5("connect/endpoints", json.dumps([endpoint]))
    return ZenohLab(config, learning_definitions(), prefix)
