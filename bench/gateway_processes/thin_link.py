"""A way to a server that carries so many bytes a second towards the client, and holds few."""

from __future__ import annotations

import argparse
import asyncio
import socket
import time

# Bytes on the way: those of a small router's queue.
BUFFER = 16 * 1024
PIECE = 1500


async def main(port: int, target: int, rate: float) -> None:
    async def carry(client: socket.socket) -> None:
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

    listening = socket.create_server(("127.0.0.1", port))
    listening.setblocking(False)
    print("ready", flush=True)
    carried = set()
    while True:
        client, _ = await asyncio.get_running_loop().sock_accept(listening)
        client.setblocking(False)
        client.setsockopt(socket.SOL_SOCKET, socket.SO_SNDBUF, BUFFER)
        carried.add(asyncio.create_task(carry(client)))


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--port", type=int, required=True)
    parser.add_argument("--target", type=int, required=True)
    parser.add_argument("--rate", type=float, required=True, help="bytes a second")
    arguments = parser.parse_args()
    asyncio.run(main(arguments.port, arguments.target, arguments.rate))
