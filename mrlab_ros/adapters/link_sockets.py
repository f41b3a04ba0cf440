"""The TCP sockets beneath zenoh's links: what they have received, and how to close one.

zenoh tells which certificate a link has, but can neither count its bytes nor close it alone. The
sockets belong to this process, and Linux lists them in /proc/self/fd.
"""

from __future__ import annotations

import os
import socket
import struct
from collections.abc import Iterable
from contextlib import suppress

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
