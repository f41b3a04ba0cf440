"""Ends connections of which nothing comes, and those that do not read their answers.

uvicorn waits for ever for the first request of a connection and for the rest of a head, so a few
thousand half requests would take every file descriptor of the gateway. It answers every ping of a
WebSocket, so one that sends pings and reads nothing would take its memory.
"""

from __future__ import annotations

import asyncio
from collections.abc import AsyncIterator

import h11
from uvicorn.protocols.http.h11_impl import H11Protocol
from uvicorn.protocols.websockets.websockets_sansio_impl import WebSocketsSansIOProtocol
from websockets.frames import Frame

from mrlab_ros.core.runtime.bucket import Bucket
from mrlab_ros.gateway.diagnostics import BODY_STOPPED
from mrlab_ros.gateway.errors import TooSlow

# Until the whole head of a request is there, and between two pieces of a body, s.
HEAD_S = 20.0
BODY_S = 30.0
# Bytes that may wait in a WebSocket's transport when a ping comes.
MOST_UNREAD = 128 * 1024
# Pings and pongs of one WebSocket, frames/s and frames; a browser sends one pong in 20 s.
CONTROL_RATE, CONTROL_BURST = 5.0, 50.0


class ReadingSocket(WebSocketsSansIOProtocol):
    """uvicorn's WebSocket; ends where the other side pings without end, or does not read."""

    def connection_made(self, transport: asyncio.BaseTransport) -> None:
        super().connection_made(transport)
        self.control = Bucket(CONTROL_RATE, CONTROL_BURST)

    def handle_ping(self) -> None:
        unread = self.transport.get_write_buffer_size()
        if unread > MOST_UNREAD or not self.control.take(1, self.loop.time()):
            self.transport.abort()
        else:
            super().handle_ping()

    def handle_pong(self, event: Frame) -> None:
        if self.control.take(1, self.loop.time()):
            super().handle_pong(event)
        else:
            self.transport.abort()


def protocol(wait: float = HEAD_S) -> type[H11Protocol]:
    """Return uvicorn's HTTP with a bound on the time, s, until the head of a request is whole."""

    class Patient(H11Protocol):
        waiting: asyncio.TimerHandle | None = None
        # Cleared when this connection leaves HTTP.
        wanted = True

        def connection_made(self, transport: asyncio.Transport) -> None:  # type: ignore[override]
            super().connection_made(transport)
            self.wait()

        def data_received(self, data: bytes) -> None:
            super().data_received(data)
            if self.cycle is None or self.cycle.response_complete:
                self.wait()
            else:
                self.stop()

        def handle_websocket_upgrade(self, event: h11.Request) -> None:
            super().handle_websocket_upgrade(event)
            self.stop(for_good=True)

        def connection_lost(self, exc: Exception | None) -> None:
            self.stop(for_good=True)
            super().connection_lost(exc)

        def wait(self) -> None:
            if self.waiting is None and self.wanted:
                self.waiting = self.loop.call_later(wait, self.transport.close)

        def stop(self, for_good: bool = False) -> None:
            if self.waiting is not None:
                self.waiting.cancel()
                self.waiting = None
            self.wanted = self.wanted and not for_good

    return Patient


async def in_time(
    body: AsyncIterator[bytes], file_name: str, wait: float = BODY_S
) -> AsyncIterator[bytes]:
    """Yield the pieces of a file's body; raise TooSlow after `wait` s without one."""
    pieces = body.__aiter__()
    while True:
        try:
            piece = await asyncio.wait_for(pieces.__anext__(), wait)
        except StopAsyncIteration:
            return
        except asyncio.TimeoutError:
            raise TooSlow(BODY_STOPPED(file=file_name, wait=wait)) from None
        yield piece
