"""Converts and reads files from outside in the sandboxed process of `worker`.

Converts many files at once in several sandboxed processes, none waiting for a slow one.
"""

from __future__ import annotations

import contextlib
import heapq
import itertools
import json
import os
import pickle
import signal
import stat
import threading
import time
import weakref
from collections.abc import Callable, Iterator
from concurrent.futures import Future
from dataclasses import asdict, dataclass, field, replace
from functools import partial
from pathlib import Path
from typing import Any, BinaryIO, TypeVar

from mrlab_ros.adapters import threads
from mrlab_ros.adapters.workspaces import content, results, workers
from mrlab_ros.adapters.workspaces.diagnostics import (
    MISSING,
    READER_DIED,
    TOO_LARGE,
    UNREADABLE,
    UNSUPPORTED_FORMAT,
    WAITING_FILES,
)
from mrlab_ros.core.base.errors import BadInput, Misuse
from mrlab_ros.core.conversion.options import MOST_ROWS
from mrlab_ros.core.conversion.workspace import Workspace

Result = TypeVar("Result")
MiB = 1 << 20
WALL = 10.0


@dataclass(frozen=True)
class Limits:
    """Bounds on one file. memory, output, file_size: bytes; rows: of a matrix.

    time: s of a processor. A file has WALL times as long on a clock, for a busy machine.
    """

    memory: int = 1024 * MiB
    time: float = 20.0
    output: int = 1024 * MiB
    file_size: int = 1024 * MiB
    rows: int = MOST_ROWS

    @property
    def wall(self) -> float:
        """The longest that a file may take on a clock, s."""
        return WALL * self.time


class TooSlow(BadInput):
    """A file that was given up at the time limit."""


class _Killed(BadInput):
    """A file whose process was killed from outside."""


class WorkspaceReader:
    """Takes files one after another in a warm worker process; safe from several threads.

    The worker starts with the first file, and again after it was lost or `rest()`. A file whose
    process was killed from outside (SIGKILL) is tried once more.
    """

    def __init__(self, limits: Limits | None = None) -> None:
        self.limits = limits or Limits()
        self._lock = threading.Lock()
        self._closed = False
        self._worker = workers.take()

    @property
    def runs(self) -> bool:
        """Whether the worker has been started."""
        return self._worker.pid is not None

    def rest(self) -> None:
        """End the worker until there is another file."""
        with self._lock:
            self._worker.stop()

    def close(self) -> None:
        """End the worker; a file that is being read is given up at once."""
        self._closed = True
        self._worker.kill()
        with self._lock:
            self._worker.stop()

    def __enter__(self) -> WorkspaceReader:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def read_file(self, path: Path) -> Workspace:
        """Read the file at `path`; raise BadInput where it is not a whole, fitting workspace."""
        with opened(path) as source:
            return self.read(source, path.name)

    def read_bytes(self, data: bytes | memoryview, name: str) -> Workspace:
        """Read a file's bytes; `name` is what it is called."""
        with in_memory(data) as source:
            return self.read(source, name)

    def read(self, source: int, name: str) -> Workspace:
        """Read the regular file behind the descriptor `source`."""
        self._check_size(source, name)

        def attempt() -> Workspace:
            target = os.memfd_create("variables", os.MFD_CLOEXEC)
            try:
                self._check_status(self._ask([source, target], name), name)
                return content.collect(target, self._second(source, target, name))
            finally:
                os.close(target)

        return self._retried(attempt)

    def _second(
        self, source: int, numbers: int, name: str
    ) -> Callable[[list[content.Place]], None]:
        """Return what reads matrices of the file with a second reader."""
        source, numbers = os.dup(source), os.dup(numbers)

        def again(places: list[content.Place]) -> None:
            for batch in content.batches(places):
                target = os.memfd_create("second", os.MFD_CLOEXEC)
                try:
                    status = self._ask([source, target, numbers], name, again=batch)
                    content.compare(
                        status, target, name, batch, self.limits.time, self.limits.wall
                    )
                finally:
                    os.close(target)

        for descriptor in (source, numbers):
            weakref.finalize(again, os.close, descriptor)
        return again

    def convert(self, source: int, task: results.Task, stored: BinaryIO) -> results.Converted:
        """Convert the regular file behind the descriptor `source`.

        An accepted trajectory is written into `stored`, an empty file, as
        `adapters/trajectories/npz_file.py` writes it. Raises BadInput where the task is wrong, and
        where the file could not be read at all.
        """
        self._check_size(source, task.file)

        def attempt() -> results.Converted:
            stored.seek(0)
            stored.truncate()
            target = os.memfd_create("result", os.MFD_CLOEXEC)
            with os.fdopen(target, "w+b") as answer, in_memory(pickle.dumps(task)) as asked:
                descriptors = [source, target, asked, stored.fileno()]
                self._check_status(self._ask(descriptors, task.read_as or task.file), task.file)
                answer.seek(0)
                try:
                    return results.parse(answer.read())
                except (ValueError, TypeError, LookupError) as error:
                    raise BadInput(READER_DIED(file=task.file, error=repr(error))) from None

        return self._retried(attempt)

    def _check_size(self, source: int, name: str) -> None:
        size = os.fstat(source).st_size
        if size > self.limits.file_size:
            limit = self.limits.file_size
            raise BadInput(TOO_LARGE(file=name, part="file", size=size, limit=limit))

    def _retried(self, attempt: Callable[[], Result]) -> Result:
        try:
            return attempt()
        except _Killed as killed:
            if self._closed:
                raise BadInput(killed.diagnostic) from None
            return attempt()

    def _check_status(self, status: int | None, name: str) -> None:
        slow = content.too_slow(status, name, self.limits.time, self.limits.wall)
        if slow is not None:
            raise TooSlow(slow)
        if status:
            kind = _Killed if status == -signal.SIGKILL else BadInput
            raise kind(READER_DIED(file=name, **content.death(status)))

    def _ask(self, descriptors: list[int], name: str, **more: Any) -> int | None:
        """Return the exit status of the process that did a request, None past the time limit."""
        limits = self.limits
        bounds = asdict(limits) | {"wall": limits.wall}
        message = json.dumps({**bounds, **more, "name": name[-255:]}).encode()
        with self._lock:
            self._worker.warm()
            # the kernel's own timer ends the reading process; this deadline is the last resort
            return self._worker.ask(message, limits.wall + 5, descriptors)


@contextlib.contextmanager
def opened(path: Path) -> Iterator[int]:
    """Open the regular file at `path`; raise BadInput where there is none."""
    try:
        # a FIFO would wait for a writer that never comes
        source = os.open(path, os.O_RDONLY | os.O_CLOEXEC | os.O_NONBLOCK)
    except FileNotFoundError:
        raise BadInput(MISSING(file=str(path))) from None
    except (OSError, ValueError) as error:
        why = getattr(error, "strerror", None) or str(error)
        raise BadInput(UNREADABLE(file=path.name, why=why)) from None
    try:
        mode = os.fstat(source).st_mode
        if not stat.S_ISREG(mode):
            form = "folder" if stat.S_ISDIR(mode) else "special"
            raise BadInput(UNSUPPORTED_FORMAT(file=path.name, form=form))
        yield source
    finally:
        os.close(source)


@contextlib.contextmanager
def in_memory(data: bytes | memoryview) -> Iterator[int]:
    """Put bytes into a memory file and yield its descriptor."""
    source = os.memfd_create("workspace", os.MFD_CLOEXEC)
    try:
        view = memoryview(data)
        while len(view):
            view = view[os.write(source, view) :]
        yield source
    finally:
        os.close(source)


# A file that is not done after this long, s, goes on among the slow ones.
QUICK_TIME_S = 2.0
# A file of this size, bytes, is slow from the start.
LARGE = 64 * MiB
# For the order: bytes that are converted in a second. What waits is taken in the order of its
# arrival plus its expected time, so a large file lets smaller ones pass, but not for ever.
BYTES_PER_S = 10 * MiB
# A worker without a file ends after this long, s: it holds some 40 MB.
KEEP_S = 60.0
# Most waiting files, and bytes of those that were sent and not named.
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

    def __init__(self, limits: Limits, workers: int = 0, keep: float = KEEP_S) -> None:
        """Start the threads; workers: 0 for one a processor, at least two.

        keep: s that a process stays after its last file.
        """
        self._keep = keep
        # By queue: how many threads wait with a process that runs.
        self._warm = {True: 0, False: 0}
        count = workers or max(2, os.cpu_count() or 1)
        self.limits = limits
        self._changed = threading.Condition()
        self._queues: dict[bool, list[_Job]] = {True: [], False: []}
        self._held = 0
        self._numbers = itertools.count()
        self._closed = False
        self._readers = [WorkspaceReader(limits) for _ in range(count + max(1, count - 1))]
        self._threads = [
            threads.loop(f"convert_{i}", partial(self._run, reader, i < count))
            for i, reader in enumerate(self._readers)
        ]
        for thread in self._threads:
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
        while (job := self._next(reader, quick)) is not None:
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

    def _next(self, reader: WorkspaceReader, quick: bool) -> _Job | None:
        """Return the next file; one whose process runs goes before one that must start it."""
        with self._changed:
            warm = reader.runs
            self._warm[quick] += warm
            try:
                while not self._closed:
                    if len(self._queues[quick]) > (0 if warm else self._warm[quick]):
                        return heapq.heappop(self._queues[quick])
                    if not self._changed.wait(self._keep) and warm:
                        reader.rest()
                        self._warm[quick] -= 1
                        warm = False
            finally:
                self._warm[quick] -= warm
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
