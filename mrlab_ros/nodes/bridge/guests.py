"""Closes the links of people who take more than their share."""

from __future__ import annotations

import time
from collections.abc import Callable
from functools import partial

from mrlab_ros.adapters.zenoh.links import LinkSockets
from mrlab_ros.core.bridge.guests import Cut, Guests, Link
from mrlab_ros.core.bridge.links import LOCAL_PROTOCOL
from mrlab_ros.ros.worker import Worker

# How often the bytes of each link are read, s.
PERIOD_S = 0.2


class GuestWatch:
    """Follows the links of a session; `on_link` is for the session. log: gets a sentence."""

    def __init__(self, guests: Guests, log: Callable[[str], None]) -> None:
        self._guests = guests
        self._log = log
        self._sockets = LinkSockets()
        self._due = 0.0
        self._worker = Worker("bridge_guests", self._read, self._until_due)

    def stop(self) -> None:
        """End; links stay as they are."""
        self._worker.close()

    def on_link(self, link: Link, opened: bool) -> None:
        """Take a link that was opened or closed; this machine's user is no guest."""
        if link.local.startswith(LOCAL_PROTOCOL) or link.remote.startswith(LOCAL_PROTOCOL):
            return
        self._worker.send(partial(self._opened if opened else self._closed, link))

    def _opened(self, link: Link) -> None:
        self._cut(self._guests.opened(link, time.monotonic()))
        self._read_where_due()

    def _closed(self, link: Link) -> None:
        self._guests.closed(link)
        self._sockets.forget(link)
        self._read_where_due()

    def _until_due(self) -> float:
        return max(self._due - time.monotonic(), 0.0)

    def _read_where_due(self) -> None:
        # A client that opens links without end must not keep the bytes from being read.
        if self._until_due() == 0.0:
            self._read()

    def _read(self) -> None:
        now = time.monotonic()
        self._due = now + PERIOD_S
        for cut in self._guests.received(self._sockets.received(self._guests.links), now):
            self._cut(cut)

    def _cut(self, cut: Cut | None) -> None:
        if cut is None:
            return
        for link in cut.links:
            self._sockets.shut(link)
        if cut.words:
            self._log(cut.words)
