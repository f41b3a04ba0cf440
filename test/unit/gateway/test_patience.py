"""A connection of which nothing comes is ended; one that is in use is not."""

import asyncio
import socket
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager

import pytest
import uvicorn
from refusals import refused
from websockets.asyncio.client import connect
from websockets.exceptions import ConnectionClosedError

from mrlab_ros.gateway.diagnostics import BODY_STOPPED
from mrlab_ros.gateway.errors import TooSlow
from mrlab_ros.gateway.patience import CONTROL_BURST, ReadingSocket, in_time, protocol

WAIT_S = 0.2


async def application(scope, receive, send):
    """Answer later than a head may take; tell a WebSocket something later, too."""
    if scope["type"] == "websocket":
        await receive()
        await send({"type": "websocket.accept"})
        await asyncio.sleep(2 * WAIT_S)
        await send({"type": "websocket.send", "text": "still here"})
        return
    await asyncio.sleep(2 * WAIT_S)
    head = {"type": "http.response.start", "status": 200, "headers": [(b"content-length", b"2")]}
    await send(head)
    await send({"type": "http.response.body", "body": b"ok"})


@asynccontextmanager
async def served() -> AsyncIterator[int]:
    with socket.socket() as listening:
        listening.bind(("127.0.0.1", 0))
        listening.listen()
        config = uvicorn.Config(
            application,
            http=protocol(WAIT_S),
            ws=ReadingSocket,
            lifespan="off",
            log_config=None,
        )
        server = uvicorn.Server(config)
        task = asyncio.create_task(server.serve(sockets=[listening]))
        try:
            yield listening.getsockname()[1]
        finally:
            server.should_exit = True
            await task


async def answer(port: int, *pieces: bytes) -> bytes:
    """Return all that comes until the server ends the connection."""
    reader, writer = await asyncio.open_connection("127.0.0.1", port)
    for piece in pieces:
        writer.write(piece)
        await writer.drain()
    try:
        return await asyncio.wait_for(reader.read(), 20)
    finally:
        writer.close()


@pytest.mark.parametrize("sent", [[], [b"GET / HT"], [b"GET / HTTP/1.1\r\n", b"Host: x\r\n"]])
def test_half_a_head_is_ended(sent):
    async def run():
        async with served() as port:
            return await answer(port, *sent)

    assert asyncio.run(run()) == b""


def test_an_answer_may_take_its_time():
    async def run():
        async with served() as port:
            whole = b"GET / HTTP/1.1\r\nHost: x\r\nConnection: close\r\n\r\n"
            return await answer(port, whole[:9], whole[9:])

    assert asyncio.run(run()).endswith(b"\r\n\r\nok")


def test_a_websocket_stays():
    async def run():
        async with served() as port, connect(f"ws://127.0.0.1:{port}/") as link:
            return await asyncio.wait_for(link.recv(), 20)

    assert asyncio.run(run()) == "still here"


def test_a_body_that_stops_is_given_up():
    async def body():
        yield b"first"
        await asyncio.Event().wait()

    async def run():
        return [piece async for piece in in_time(body(), "q.mat", WAIT_S)]

    with refused(BODY_STOPPED, TooSlow, file="q.mat", wait=0.2):
        asyncio.run(run())


def test_a_whole_body_passes():
    async def body():
        yield b"first"
        yield b"second"

    async def run():
        return [piece async for piece in in_time(body(), "q.mat", WAIT_S)]

    assert asyncio.run(run()) == [b"first", b"second"]


def test_a_socket_that_pings_without_end_is_ended() -> None:
    async def pings() -> int:
        async with served() as port, connect(f"ws://127.0.0.1:{port}", ping_interval=None) as ws:
            for count in range(10 * int(CONTROL_BURST)):
                try:
                    await (await ws.ping())
                except ConnectionClosedError:
                    return count
        return -1

    assert CONTROL_BURST <= asyncio.run(pings()) < 2 * CONTROL_BURST
