"""TCP ports for the servers of the tests, which no other process of this machine gets."""

from __future__ import annotations

import errno
import random
import socket

# Below those that the kernel hands out to connections and to port 0.
PORTS = range(10_000, 32_000)
ATTEMPTS = 200
# What holds the ports of this process, until it ends.
_HELD: dict[int, socket.socket] = {}


def free_port() -> int:
    """Return a TCP port of the loopback on which nobody listens.

    Other tests of this machine do not get it while this process lives, so a server that a test
    starts later, or anew, finds it free.
    """
    for port in random.choices(PORTS, k=ATTEMPTS):
        if port not in _HELD and _is_free(port) and _hold(port):
            return port
    raise AssertionError(f"none of {ATTEMPTS} ports drawn of {PORTS} is free; end some programs")


def _is_free(port: int) -> bool:
    with socket.socket() as probe:
        # As a server does: what a closed connection left behind is no hindrance.
        probe.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        return _bound(probe, ("", port))


def _hold(port: int) -> bool:
    # An abstract name: the kernel gives it to one process, and takes it back when that ends.
    holder = socket.socket(socket.AF_UNIX)
    if not _bound(holder, f"\0mrlab-test-port-{port}"):
        holder.close()
        return False
    _HELD[port] = holder
    return True


def _bound(found: socket.socket, address: tuple[str, int] | str) -> bool:
    try:
        found.bind(address)
    except OSError as error:
        if error.errno != errno.EADDRINUSE:
            raise
        return False
    return True


def free_endpoint(protocol: str = "tcp", host: str = "127.0.0.1") -> str:
    """Return a zenoh endpoint of the loopback whose port is a free one."""
    return f"{protocol}/{host}:{free_port()}"
