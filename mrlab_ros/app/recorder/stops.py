"""The stops of the bag that is replayed: read beside the replay, published once they are known."""

from __future__ import annotations

import threading
from collections.abc import Callable, Sequence
from concurrent.futures import Future
from concurrent.futures import TimeoutError as FutureTimeout

from mrlab_ros.adapters import threads
from mrlab_ros.adapters.bags.reader import Bag
from mrlab_ros.adapters.bags.session import read_events
from mrlab_ros.core.base.errors import Misuse
from mrlab_ros.core.recording.diagnostics import STOPS_AWAITED
from mrlab_ros.core.recording.stops import Stop, stops_of

# s: a caller over zenoh gives up after 5 s.
TIMEOUT_S = 3.0


class ReplayStops:
    """Gives `publish` the stops of the newest bag, and none after forget()."""

    def __init__(self, publish: Callable[[Sequence[Stop]], None]) -> None:
        self._publish = publish
        self._pool = threads.Pool("stops", 1)
        self._lock = threading.Lock()
        self._bag: Bag | None = None
        self._reading: Future[list[Stop]] = Future()

    def read(self, bag: Bag) -> None:
        """Begin to read the stops of `bag`."""
        with self._lock:
            self._bag = bag
            self._reading = self._pool.submit(self._read, bag)

    def forget(self) -> None:
        """Stop reading: nothing is replayed any more."""
        with self._lock:
            self._bag = None
            self._publish([])

    def known(self, bag: Bag) -> list[Stop]:
        """Return the stops of `bag`, which is being read; raise Misuse where that takes long."""
        try:
            return self._reading.result(TIMEOUT_S)
        except FutureTimeout:
            raise Misuse(STOPS_AWAITED(bag=str(bag.path))) from None

    def close(self) -> None:
        with self._lock:
            self._bag = None
        self._pool.shutdown(wait=False, cancel_futures=True)

    def _read(self, bag: Bag) -> list[Stop]:
        stops = stops_of(read_events(bag, lambda: self._bag is bag))
        with self._lock:
            if self._bag is bag:
                self._publish(stops)
        return stops
