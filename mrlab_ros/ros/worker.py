"""A thread that runs one piece of work after another."""

from __future__ import annotations

import threading
import time
from collections import deque
from collections.abc import Callable
from concurrent.futures import Future
from functools import partial
from typing import Any, NamedTuple, TypeVar

from mrlab_ros.adapters import threads

Result = TypeVar("Result")
Work = Callable[[], Any]


# Pause before idle is called again after an error, s: the error may come again at once.
RETRY_S = 0.1


class _Task(NamedTuple):
    """A piece of work, the bytes that it holds, and where its result goes, if anywhere."""

    work: Work
    size: int
    future: Future[Any] | None


class Worker:
    """Runs work in the order in which it was given, no two pieces at once, in its own thread.

    idle: called whenever no work came for `idle_after()` s; None of it: never. capacity: bytes
    of sent work that may wait; beyond it the oldest work is dropped, so that the newest state
    still arrives. on_drop: called after that. on_error: gets what sent work and idle raised;
    without it the error is named in the log.
    """

    def __init__(
        self,
        name: str,
        idle: Callable[[], None] = lambda: None,
        idle_after: Callable[[], float | None] = lambda: None,
        *,
        capacity: int | None = None,
        on_drop: Callable[[], None] = lambda: None,
        on_error: Callable[[Exception], None] | None = None,
    ) -> None:
        self._idle, self._idle_after = idle, idle_after
        self._capacity, self._on_drop = capacity, on_drop
        self._on_error = on_error or partial(threads.name_error, name)
        self._changed = threading.Condition()
        self._tasks: deque[_Task] = deque()
        self._bytes = 0
        self._closed = False
        self._thread = threads.loop(name, self._run)
        self._thread.start()

    def do(self, work: Work) -> Any:
        """Run `work` after what waits; return what it returns or raise what it raises."""
        return self.later(work).result()

    def later(self, work: Work) -> Future[Any]:
        """Run `work` after what waits, unless the future is cancelled before its turn.

        The worker cancels it where it is closed. An error is for the caller; where nobody reads
        the future, send() is to be used.
        """
        future: Future[Any] = Future()
        if not self._put(_Task(work, 0, future)):
            future.cancel()
        return future

    def send(self, work: Work, size: int = 0) -> None:
        """Run `work` after what waits, without a result; it holds `size` bytes until then."""
        self._put(_Task(work, size, None))

    def close(self, timeout: float | None = None) -> None:
        """Run what waits, for `timeout` s at most (None: all of it), drop the rest, and end."""
        with self._changed:
            self._closed = True
            self._changed.notify()
        self._thread.join(timeout)
        with self._changed:
            dropped = list(self._tasks)
            self._tasks.clear()
        for task in dropped:
            if task.future is not None:
                task.future.cancel()
        self._thread.join()

    def end(self) -> None:
        """Run what waits, then end; nobody waits for it."""
        with self._changed:
            self._closed = True
            self._changed.notify()

    @property
    def ended(self) -> bool:
        """Return whether no further work is taken."""
        return self._closed

    def _put(self, task: _Task) -> bool:
        dropped = False
        with self._changed:
            if self._closed:
                return False
            self._tasks.append(task)
            self._bytes += task.size
            if self._capacity is not None:
                while self._bytes > self._capacity and len(self._tasks) > 1:
                    self._bytes -= self._tasks.popleft().size
                    dropped = True
            self._changed.notify()
        if dropped:
            self._on_drop()
        return True

    def _run(self) -> None:
        while True:
            task = self._next()
            if task is None:
                return
            if task.future is not None and not task.future.set_running_or_notify_cancel():
                continue
            try:
                result = task.work()
            except Exception as error:
                if task.future is None:
                    self._on_error(error)
                else:
                    task.future.set_exception(error)
            else:
                if task.future is not None:
                    task.future.set_result(result)

    def _next(self) -> _Task | None:
        """Wait for the next task, with a call of idle where it is due; None at the end."""
        pause = 0.0
        retry: float | None = RETRY_S
        while True:
            wait = self._attempt(self._idle_after, retry)
            deadline = None if wait is None else time.monotonic() + max(wait, pause)
            with self._changed:
                while not (self._tasks or self._closed):
                    left = None if deadline is None else deadline - time.monotonic()
                    if left is not None and left <= 0:
                        break
                    self._changed.wait(left)
                if self._tasks:
                    task = self._tasks.popleft()
                    self._bytes -= task.size
                    return task
                if self._closed:
                    return None
            pause = 0.0 if self._attempt(self._idled, False) else RETRY_S

    def _idled(self) -> bool:
        self._idle()
        return True

    def _attempt(self, work: Callable[[], Result], failed: Result) -> Result:
        """Return what `work` returns, or `failed` where it raises."""
        try:
            return work()
        except Exception as error:
            self._on_error(error)
            return failed
