"""A thread that does one thing after another, and something small in between."""

from __future__ import annotations

import queue
import threading
from collections.abc import Callable
from concurrent.futures import CancelledError, Future
from typing import Any


class Worker:
    """Runs work in the order in which it was given; no two pieces ever at once.

    `idle` is called whenever nothing came for `patience()` s; patience None means never.
    """

    def __init__(
        self, name: str, idle: Callable[[], None], patience: Callable[[], float | None]
    ) -> None:
        self._idle = idle
        self._patience = patience
        self._queue: queue.Queue[tuple[Callable[[], Any], Future[Any]] | None] = queue.Queue()
        self._thread = threading.Thread(target=self._run, name=name, daemon=True)
        self._thread.start()

    def do(self, work: Callable[[], Any]) -> Any:
        """Run `work` in its turn and return what it returns, or raise what it raises."""
        return self.later(work).result()

    def later(self, work: Callable[[], Any]) -> Future[Any]:
        """Run `work` in its turn."""
        future: Future[Any] = Future()
        self._queue.put((work, future))
        return future

    def close(self) -> None:
        """Finish the work at hand and stop; what still waits is cancelled."""
        self._queue.put(None)
        self._thread.join()
        while not self._queue.empty():
            item = self._queue.get()
            if item is not None:
                item[1].set_exception(CancelledError())

    def _run(self) -> None:
        while True:
            try:
                item = self._queue.get(timeout=self._patience())
            except queue.Empty:
                self._idle()
                continue
            if item is None:
                return
            work, future = item
            try:
                future.set_result(work())
            except Exception as error:
                future.set_exception(error)
