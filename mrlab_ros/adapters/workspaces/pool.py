"""Converts many files at once in several walled-off processes, none waiting for a slow one."""

from __future__ import annotations

import contextlib
import heapq
import itertools
import os
import threading
import time
from collections.abc import Callable
from concurrent.futures import Future
from dataclasses import dataclass, field, replace
from typing import Any

from mrlab_ros.adapters.workspaces.diagnostics import WAITING_FILES
from mrlab_ros.adapters.workspaces.reader import Limits, MiB, TooSlow, WorkspaceReader
from mrlab_ros.core.base.errors import Misuse

# A file that is not done after this long, s, goes on among the slow ones.
QUICK_TIME_S = 2.0
# A file of this size, bytes, is slow from the start.
LARGE = 64 * MiB
# For the order: bytes that are converted in a second. What waits is taken in the order of its
# arrival plus its expected time, so a large file lets smaller ones pass, but not for ever.
BYTES_PER_S = 10 * MiB
# What may wait: files, and bytes of those that were sent and not named.
MOST_WAITING, MOST_BYTES = 1000, 1024 * MiB

Work = Callable[[WorkspaceReader], Any]


@dataclass(order=True)
class _Job:
    rank: float
    number: int
    work: Work = field(compare=False)
    size: int = field(compare=False)
    held: int = field(compare=False)
    future: Future[Any] = field(compare=False)


class ConversionPool:
    """Runs work on `workers` processes for quick files, and on one less (at least one) for slow.

    Each file begins among the quick ones, where it has QUICK_TIME_S; one that takes longer is
    begun again among the slow ones, with the whole time limit. So a file that is stuck or huge
    holds up other slow ones at most. Files of one client do not hold up those of another beyond
    the time of their size: rclpy does not say who calls, so the order goes by size and arrival.
    """

    def __init__(self, limits: Limits, workers: int = 0) -> None:
        """Start the threads; workers: 0 for one a processor, at least two."""
        count = workers or max(2, os.cpu_count() or 1)
        self.limits = limits
        self._changed = threading.Condition()
        self._queues: dict[bool, list[_Job]] = {True: [], False: []}
        self._held = 0
        self._numbers = itertools.count()
        self._closed = False
        self._readers = [WorkspaceReader(limits) for _ in range(count + max(1, count - 1))]
        self._threads = [
            threading.Thread(target=self._run, args=(reader, i < count), name=f"convert_{i}")
            for i, reader in enumerate(self._readers)
        ]
        for thread in self._threads:
            thread.daemon = True
            thread.start()

    def submit(self, work: Work, size: int, held: int = 0) -> Future[Any]:
        """Run `work(reader)` for a file of `size` bytes; `held` of them wait in memory.

        The work may be run twice; it must change nothing before its reader has answered. Raises
        Misuse where too much waits already.
        """
        quick = size < LARGE
        with self._changed:
            waiting = sum(map(len, self._queues.values()))
            if waiting >= MOST_WAITING or (held and self._held + held > MOST_BYTES):
                raise Misuse(WAITING_FILES(count=waiting, size=self._held))
            rank = time.monotonic() + size / BYTES_PER_S
            job = _Job(rank, next(self._numbers), work, size, held, Future())
            heapq.heappush(self._queues[quick], job)
            self._held += held
            self._changed.notify_all()
        return job.future

    def close(self) -> None:
        """Cancel what waits, give up what runs, and end the processes."""
        with self._changed:
            self._closed = True
            waiting = [job for queue in self._queues.values() for job in queue]
            for queue in self._queues.values():
                queue.clear()
            self._changed.notify_all()
        for job in waiting:
            job.future.cancel()
        for reader in self._readers:
            reader.close()
        for thread in self._threads:
            thread.join()
        for reader in self._readers:
            reader.close()

    def __enter__(self) -> ConversionPool:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def _run(self, reader: WorkspaceReader, quick: bool) -> None:
        if quick:
            # where it does not start now, the first file tries again and says so
            with contextlib.suppress(RuntimeError, OSError):
                reader.start()
        while (job := self._next(quick)) is not None:
            limits = self.limits
            short = quick and limits.time > QUICK_TIME_S
            reader.limits = replace(limits, time=QUICK_TIME_S) if short else limits
            try:
                answer = job.work(reader)
            except TooSlow as error:
                if short and self._again(job):
                    continue
                self._done(job, error=error)
            except BaseException as error:
                self._done(job, error=error)
            else:
                self._done(job, answer=answer)

    def _next(self, quick: bool) -> _Job | None:
        with self._changed:
            while not self._closed:
                if self._queues[quick]:
                    return heapq.heappop(self._queues[quick])
                self._changed.wait()
        return None

    def _again(self, job: _Job) -> bool:
        with self._changed:
            if not self._closed:
                heapq.heappush(self._queues[False], job)
                self._changed.notify_all()
            return not self._closed

    def _done(self, job: _Job, answer: Any = None, error: BaseException | None = None) -> None:
        with self._changed:
            self._held -= job.held
        if error is not None:
            job.future.set_exception(error)
        else:
            job.future.set_result(answer)
