"""The baseline: a WebSocket server that sends each sample at once as a message of its own.

A message is the sample's stamp (s, a little-endian double), 4 bytes, and the CDR.
"""

from __future__ import annotations

import argparse
import asyncio
import struct

import websockets

from mrlab_ros.gateway.lab.connection import Sample
from mrlab_ros.gateway.lab.zenoh_lab import lab_at


async def serve(endpoint: str, port: int) -> None:
    lab = lab_at(endpoint, None, "")
    await lab.open()
    queues: set[asyncio.Queue[bytes]] = set()

    def on_sample(sample: Sample) -> None:
        message = struct.pack("<dI", sample.published_ns / 1e9, sample.sequence) + sample.payload
        for queue in queues:
            queue.put_nowait(message)

    lab.subscribe("*/joint_states", on_sample)

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

    async with websockets.serve(client, "127.0.0.1", port, compression=None):
        print("ready", flush=True)
        await asyncio.Future()


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--endpoint", required=True)
    parser.add_argument("--port", type=int, required=True)
    arguments = parser.parse_args()
    asyncio.run(serve(arguments.endpoint, arguments.port))
