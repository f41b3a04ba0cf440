"""What stands around the gateway while it is measured; each says "ready" once it works."""

from __future__ import annotations

import asyncio
import socket
import struct
import time
from typing import Any

import websockets

from mrlab_ros.adapters.zenoh.configuration import configuration
from mrlab_ros.adapters.zenoh.session import ZenohSession
from mrlab_ros.core.bridge.latency import attachment, clock_answer
from mrlab_ros.core.bridge.rules import (
    Congestion,
    Direction,
    TopicQos,
    TopicRule,
    bridge_token,
    topic_token,
)
from mrlab_ros.gateway.lab.connection import Sample
from mrlab_ros.gateway.lab.definitions import installed_definitions
from mrlab_ros.gateway.lab.zenoh_lab import lab_at

JOINTS = "sensor_msgs/msg/JointState"
NAMES = [
    f"{joint}_joint"
    for joint in ("shoulder_pan", "shoulder_lift", "elbow", "wrist_1", "wrist_2", "wrist_3")
]
QOS = TopicQos(reliable=True, latched=False, depth=10)
# Bytes on the way: those of a small router's queue.
BUFFER, PIECE = 16 * 1024, 1500


def zenoh_side(pipe: Any, endpoint: str, robots: int, rate: float) -> None:
    """Publish joint states over zenoh with the bridge's stamps, as a lab does; rate: Hz."""
    session = ZenohSession(configuration(listen=(endpoint,)))
    keys = [f"bench_{i}/joint_states" for i in range(robots)]
    zid, rule = session.zid, TopicRule("/any", priority=2, congestion=Congestion.DROP)
    held = [session.token(bridge_token(zid))]
    held += [session.token(topic_token(zid, Direction.OUT, key, JOINTS, QOS)) for key in keys]

    def answer(query: Any) -> None:
        now = time.time_ns()
        query.reply(clock_answer(now, now))

    held.append(session.queryable("@mrlab/bridge/clock", answer))
    publishers = [session.publisher(key, rule, 0) for key in keys]
    values = {"name": NAMES, "position": [0.5] * 6, "velocity": [0.1] * 6}
    payload = installed_definitions().encode(JOINTS, values)
    pipe.send("ready")
    due, sequence = time.perf_counter(), 0
    while not pipe.poll():
        due += 1 / rate
        sequence += 1
        for publisher in publishers:
            now = time.time_ns()
            publisher.put(payload, attachment(sequence, now, now))
        time.sleep(max(0.0, due - time.perf_counter()))
    session.close()
    pipe.send("closed")


def plain_server(pipe: Any, endpoint: str, port: int) -> None:
    """The baseline: a WebSocket server that sends each sample at once as a message of its own.

    A message is the sample's stamp (s, a little-endian double), 4 bytes, and the CDR.
    """
    asyncio.run(_serve(pipe, endpoint, port))


async def _serve(pipe: Any, endpoint: str, port: int) -> None:
    lab = lab_at(endpoint, None, "")
    await lab.open()
    queues: set[asyncio.Queue[bytes]] = set()

    def on_sample(sample: Sample) -> None:
        message = struct.pack("<dI", sample.published_ns / 1e9, sample.sequence) + sample.payload
        for queue in queues:
            queue.put_nowait(message)

    async def client(socket: websockets.ServerConnection) -> None:
        queue: asyncio.Queue[bytes] = asyncio.Queue()
        queues.add(queue)
        try:
            while True:
                await socket.send(await queue.get())
        except websockets.ConnectionClosed:
            pass
        finally:
            queues.discard(queue)

    lab.subscribe("*/joint_states", on_sample)
    async with websockets.serve(client, "127.0.0.1", port, compression=None):
        pipe.send("ready")
        await asyncio.Future()


def thin_link(pipe: Any, port: int, target: int, rate: float) -> None:
    """A way to a server that carries `rate` bytes a second to the client, and holds few."""
    asyncio.run(_carry_all(pipe, port, target, rate))


async def _carry_all(pipe: Any, port: int, target: int, rate: float) -> None:
    listening = socket.create_server(("127.0.0.1", port))
    listening.setblocking(False)
    pipe.send("ready")
    carried = set()
    while True:
        client, _ = await asyncio.get_running_loop().sock_accept(listening)
        client.setblocking(False)
        client.setsockopt(socket.SOL_SOCKET, socket.SO_SNDBUF, BUFFER)
        carried.add(asyncio.create_task(_carry(client, target, rate)))


async def _carry(client: socket.socket, target: int, rate: float) -> None:
    loop = asyncio.get_running_loop()
    server = socket.socket()
    server.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, BUFFER)
    server.setblocking(False)
    await loop.sock_connect(server, ("127.0.0.1", target))
    client.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)

    async def up() -> None:
        while data := await loop.sock_recv(client, 65536):
            await loop.sock_sendall(server, data)
        server.shutdown(socket.SHUT_WR)

    async def down() -> None:
        due = time.perf_counter()
        while data := await loop.sock_recv(server, PIECE):
            due = max(due, time.perf_counter()) + len(data) / rate
            await asyncio.sleep(max(0.0, due - time.perf_counter()))
            await loop.sock_sendall(client, data)

    tasks = [asyncio.create_task(up()), asyncio.create_task(down())]
    await asyncio.wait(tasks, return_when=asyncio.FIRST_COMPLETED)
    for task in tasks:
        task.cancel()
    await asyncio.gather(*tasks, return_exceptions=True)
    client.close()
    server.close()
