"""A thread that does what may have to wait for a client, so that nobody else waits for it."""

from __future__ import annotations

import threading
from collections import deque
from collections.abc import Callable

# Bytes that wait at most; beyond, the oldest is lost, so that the newest state still arrives.
ROOM = 64 * 1024 * 1024
# How long a sender that is stopped goes on with what waits, s.
PATIENCE = 2.0


class Sender:
    """Does one task after the other, in the order in which they came.

    warn_once: says a text once.
    """

    def __init__(self, name: str, warn_once: Callable[[str], None], room: int = ROOM) -> None:
        self._complain = warn_once
        self._room = room
        self._changed = threading.Condition()
        self._tasks: deque[tuple[Callable[[], None], int]] = deque()
        self._bytes = 0
        self._stopping = False
        self._thread = threading.Thread(target=self._run, name=name, daemon=True)
        self._thread.start()

    def send(self, task: Callable[[], None], size: int) -> None:
        """Have `task` done; it holds `size` bytes until then."""
        lost = 0
        with self._changed:
            self._tasks.append((task, size))
            self._bytes += size
            while self._bytes > self._room and len(self._tasks) > 1:
                self._bytes -= self._tasks.popleft()[1]
                lost += 1
            self._changed.notify()
        if lost:
            self._complain(
                f"a client takes its messages too slowly: more than {self._room / 1e6:g} MB "
                "waited, and the oldest were lost; look at the client's network"
            )

    def stop(self) -> None:
        """Do what waits, for PATIENCE seconds at most, and end."""
        with self._changed:
            self._stopping = True
            self._changed.notify()
        self._thread.join(PATIENCE)
        with self._changed:
            self._tasks.clear()
        self._thread.join()

    def _run(self) -> None:
        while True:
            with self._changed:
                while not (self._tasks or self._stopping):
                    self._changed.wait()
                if not self._tasks:
                    return
                task, size = self._tasks.popleft()
                self._bytes -= size
            try:
                task()
            except Exception as error:  # the client, or the topic, may have gone meanwhile
                self._complain(f"a message was lost: {type(error).__name__}: {error}")
