"""A zenoh client of a lab on this machine: keys, payloads and errors, nothing of ROS.

The TCP sockets beneath zenoh's links: what they have received, and how to close one.

zenoh tells which certificate a link has, but can neither count its bytes nor close it alone. The
sockets belong to this process, and Linux lists them in /proc/self/fd.
"""

from __future__ import annotations

import json
import os
import socket
import struct
from collections.abc import Callable, Iterable
from contextlib import suppress

import zenoh

from mrlab_ros.adapters.zenoh.configuration import first_line
from mrlab_ros.adapters.zenoh.diagnostics import NO_LAB_AT, NOTHING_ANSWERS
from mrlab_ros.adapters.zenoh.refusals import refusal
from mrlab_ros.core.base.diagnostic import of_text
from mrlab_ros.core.base.errors import LabError, Unavailable
from mrlab_ros.core.bridge.guests import Link

# Offset of tcpi_bytes_received, u64, in Linux's struct tcp_info.
BYTES_RECEIVED = 128
DESCRIPTORS = "/proc/self/fd"

Address = tuple[str, int]


def address_of(locator: str) -> Address:
    """Return host and port of a locator such as tls/[::1]:7447."""
    host, _, port = locator.partition("/")[2].rpartition(":")
    return host.strip("[]").removeprefix("::ffff:"), int(port)


class LinkSockets:
    """Finds sockets by their links' addresses; a link of another kind, such as QUIC, has none."""

    def __init__(self) -> None:
        # The inode tells whether a descriptor is still the same socket.
        self._found: dict[Link, tuple[int, int]] = {}

    def forget(self, link: Link) -> None:
        self._found.pop(link, None)

    def received(self, links: Iterable[Link]) -> dict[Link, int]:
        """Return the bytes that links have received; those without a socket are left out."""
        totals = {}
        for link in links:
            held = self._open(link)
            if held is not None:
                with held, suppress(OSError):
                    info = held.getsockopt(socket.IPPROTO_TCP, socket.TCP_INFO, BYTES_RECEIVED + 8)
                    (totals[link],) = struct.unpack_from("<Q", info, BYTES_RECEIVED)
        return totals

    def shut(self, link: Link) -> bool:
        """Close a link at once; return whether it was found."""
        held = self._open(link)
        if held is None:
            return False
        with held, suppress(OSError):
            held.shutdown(socket.SHUT_RDWR)
        return True

    def _open(self, link: Link) -> socket.socket | None:
        """Return a descriptor of the link's socket, to be closed by the caller."""
        known = self._found.get(link)
        if known is None:
            self._find(link)
            known = self._found.get(link)
        return None if known is None else _duplicate(*known)

    def _find(self, link: Link) -> None:
        ends = address_of(link.local), address_of(link.remote)
        for name in os.listdir(DESCRIPTORS):
            with suppress(OSError):
                target = os.readlink(f"{DESCRIPTORS}/{name}")
                if not target.startswith("socket:["):
                    continue
                inode = int(target[8:-1])
                held = _duplicate(int(name), inode)
                if held is None:
                    continue
                with held:
                    if held.family in (socket.AF_INET, socket.AF_INET6) and ends == (
                        _plain(held.getsockname()),
                        _plain(held.getpeername()),
                    ):
                        self._found[link] = int(name), inode
                        return


def _duplicate(descriptor: int, inode: int) -> socket.socket | None:
    """Return a duplicate of a descriptor while it still is the socket `inode`, else None."""
    try:
        copy = os.dup(descriptor)
    except OSError:
        return None
    if os.fstat(copy).st_ino != inode:
        os.close(copy)
        return None
    return socket.socket(fileno=copy)


def _plain(address: tuple[str, int]) -> Address:
    return address[0].removeprefix("::ffff:"), address[1]


# A bridge that stands still does not answer a handshake either, ms.
OPEN_TIMEOUT_MS = 700


class Refusal(LabError):
    """The bridge answered a query with an error, which says why."""


class NoQueryable(LabError):
    """Nothing answers the key."""


class ZenohLink:
    """A session with one endpoint. Callbacks run in the session's threads."""

    def __init__(self, endpoint: str) -> None:
        """Connect; raise Unavailable where nothing answers there."""
        zenoh.init_log_from_env_or("off")
        config = zenoh.Config()
        for path, value in {
            "mode": "client",
            "connect/endpoints": [endpoint],
            "connect/timeout_ms": OPEN_TIMEOUT_MS,
            "scouting/multicast/enabled": False,
            "transport/unicast/open_timeout": OPEN_TIMEOUT_MS,
        }.items():
            config.insert_json5(path, json.dumps(value))
        try:
            self._session = zenoh.open(config)
        except zenoh.ZError as error:
            why = of_text(first_line(error))
            raise Unavailable(NO_LAB_AT(endpoint=endpoint, why=why)) from None

    def close(self) -> None:
        self._session.close()

    def subscribe(self, key: str, on_payload: Callable[[bytes], None]) -> Callable[[], None]:
        """Call `on_payload` with every message of `key` from now on; return what ends that."""

        def receive(sample: zenoh.Sample) -> None:
            if sample.kind == zenoh.SampleKind.PUT:
                on_payload(sample.payload.to_bytes())

        undeclare: Callable[[], None] = self._session.declare_subscriber(key, receive).undeclare
        return undeclare

    def query(self, key: str, payload: bytes = b"", timeout: float = 2.0) -> bytes:
        """Return the reply of `key`; timeout: s.

        Raises Refusal where the reply is an error, NoQueryable where none comes.
        """
        for reply in self._session.get(key, payload=payload or None, timeout=timeout):
            if reply.ok is not None:
                return reply.ok.payload.to_bytes()
            if reply.err is not None:
                raise Refusal(refusal(reply.err))
        raise NoQueryable(NOTHING_ANSWERS(key=key))
