"""The client's end of the gateway's socket, without a network: frames in, frames out."""

from __future__ import annotations

import asyncio
import json
import struct
from collections.abc import Callable
from typing import Any

from fastapi import FastAPI

from mrlab_ros.gateway.link.frames import (
    CALL,
    ENTRY,
    HEAD,
    NUMBER,
    RecordKind,
    ToClient,
    ToGateway,
)
from mrlab_ros.gateway.link.socket import PROTOCOL

HOST = "localhost:8080"
# Of a frame, or of the end of a socket, s.
TIMEOUT_S = 30.0


class Closed(Exception):
    """The gateway closed the socket, with this code and reason."""


class Decoder:
    """What a client makes of the frames of the gateway."""

    def __init__(self) -> None:
        self.topics: dict[int, dict[str, Any]] = {}
        self.values: list[tuple[str, bytes]] = []
        # Those of topics by both channels, in the order in which they came.
        self.came: list[tuple[str, bytes]] = []
        self.texts: list[dict[str, Any]] = []
        self.records: list[tuple[int, int, bytes]] = []
        self.batches: list[int] = []
        self.received = 0
        self._piece = b""

    def take_text(self, data: str) -> None:
        text = json.loads(data)
        self.texts.append(text)
        if text["op"] == "topic":
            self.topics[text["id"]] = text

    def take_bytes(self, data: bytes) -> None:
        kind, flags, count, number = HEAD.unpack_from(data)
        if kind == ToClient.FRAGMENT:
            if number != self.received + 1:
                assert number <= self.received
                return
            self.received = number
            self._piece += data[HEAD.size :]
            if flags:
                about, length, _, what = ENTRY.unpack_from(self._piece)
                payload = self._piece[ENTRY.size :][:length]
                self.records.append((what, about, payload))
                if what in (RecordKind.MESSAGE, RecordKind.VALUE):
                    self.came.append((self.topics[about]["key"], payload))
                self._piece = b""
            return
        self.batches.append(number)
        at = HEAD.size
        for _ in range(count):
            topic, length, _, _ = ENTRY.unpack_from(data, at)
            start = at + ENTRY.size
            assert start % 8 == 4
            self.values.append((self.topics[topic]["key"], data[start : start + length]))
            self.came.append(self.values[-1])
            at = -(-(start + length) // 8) * 8
        assert at == len(data)


class LinkSide(Decoder):
    """A socket of an application; it decodes what comes and grants no credit by itself."""

    def __init__(
        self,
        app: FastAPI,
        cookie: str = "",
        protocols: tuple[str, ...] = (PROTOCOL,),
        origin: str = f"http://{HOST}",
    ) -> None:
        super().__init__()
        headers = [("host", HOST), ("origin", origin), ("cookie", cookie)]
        self._scope = {
            "type": "websocket",
            "asgi": {"version": "3.0"},
            "scheme": "ws",
            "path": "/link",
            "raw_path": b"/link",
            "query_string": b"",
            "root_path": "",
            "headers": [(name.encode(), value.encode()) for name, value in headers if value],
            "subprotocols": list(protocols),
            "client": ("127.0.0.1", 40000),
        }
        self._app = app
        self._in: asyncio.Queue[dict[str, Any]] = asyncio.Queue()
        self._out: asyncio.Queue[dict[str, Any]] = asyncio.Queue()
        # Set to let the gateway's sends wait, as they do behind a full socket.
        self.frozen = False
        self.thaw = asyncio.Event()
        self.subprotocol: str | None = None
        self._task = asyncio.create_task(self._run())
        self._in.put_nowait({"type": "websocket.connect"})

    async def _run(self) -> None:
        async def send(message: dict[str, Any]) -> None:
            if self.frozen:
                await self.thaw.wait()
            self._out.put_nowait(message)

        await self._app(self._scope, self._in.get, send)

    def text(self, **message: Any) -> None:
        self._in.put_nowait({"type": "websocket.receive", "text": json.dumps(message)})

    def bytes(self, data: bytes) -> None:
        self._in.put_nowait({"type": "websocket.receive", "bytes": data})

    def hello(self, token: str = "", received: int = 0, **subscriptions: str) -> None:
        wanted = {name.lstrip("_"): key for name, key in subscriptions.items()}
        self.text(op="hello", token=token, received=received, subscriptions=wanted)

    def grant(self, batch: int) -> None:
        self.bytes(NUMBER.pack(ToGateway.CREDIT, 0, 0, 0, batch))

    def acknowledge(self) -> None:
        self.bytes(NUMBER.pack(ToGateway.RECEIVED, 0, 0, 0, self.received))

    def call(self, key: str, request: int, payload: bytes = b"", timeout: float = 5.0) -> None:
        name = key.encode()
        head = CALL.pack(ToGateway.CALL, 0, len(name), request, round(timeout * 1000))
        self.bytes(head + name + payload)

    def put(self, key: str, payload: bytes) -> None:
        name = key.encode()
        self.bytes(CALL.pack(ToGateway.PUT, 0, len(name), 0, 0) + name + payload)

    def leave(self) -> None:
        """Let the connection end as it does when a client vanishes."""
        self._in.put_nowait({"type": "websocket.disconnect", "code": 1006})

    async def ended(self) -> None:
        """Wait until the gateway has done with this socket."""
        await asyncio.wait_for(asyncio.shield(self._task), TIMEOUT_S)

    async def until(self, condition: Callable[[], Any]) -> Any:
        """Take frames until `condition` holds, and return it. Raises Closed."""
        while not (found := condition()):
            self.take(await asyncio.wait_for(self._out.get(), TIMEOUT_S))
        return found

    async def settle(self) -> None:
        """Take what the gateway sends without being asked further."""
        for _ in range(20):
            await asyncio.sleep(0)
        while not self._out.empty():
            self.take(self._out.get_nowait())

    async def welcome(self) -> dict[str, Any]:
        return await self.until(lambda: next(iter(self.of("welcome")), None))

    def of(self, op: str) -> list[dict[str, Any]]:
        return [text for text in self.texts if text["op"] == op]

    def payloads(self, key: str) -> list[bytes]:
        return [payload for each, payload in self.values if each == key]

    def take(self, message: dict[str, Any]) -> None:
        if message["type"] == "websocket.accept":
            self.subprotocol = message.get("subprotocol")
        elif message["type"] == "websocket.close":
            raise Closed(message.get("code"), message.get("reason"))
        elif message.get("text") is not None:
            self.take_text(message["text"])
        else:
            self.take_bytes(message["bytes"])


def error_of(record: tuple[int, int, bytes]) -> dict[str, str]:
    return json.loads(record[2])


def positions(payload: bytes) -> float:
    """Return the last double of a payload."""
    return struct.unpack("<d", payload[-8:])[0]
