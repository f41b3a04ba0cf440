"""Converts and reads files from outside in the walled-off process of `worker`."""

from __future__ import annotations

import contextlib
import json
import os
import pickle
import signal
import stat
import tempfile
import threading
import weakref
from collections.abc import Callable, Iterator
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any, BinaryIO, TypeVar

from mrlab_ros.adapters.warm_process import WarmProcess
from mrlab_ros.adapters.workspaces import content, results
from mrlab_ros.adapters.workspaces.diagnostics import (
    MISSING,
    READER_DIED,
    TOO_LARGE,
    TOO_SLOW,
    UNREADABLE,
    UNSUPPORTED_FORMAT,
)
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.conversion.options import MOST_ROWS
from mrlab_ros.core.conversion.workspace import Workspace

Result = TypeVar("Result")
MiB = 1 << 20
START_LIMIT = 30.0  # s for the worker to import what it needs, on a busy machine


@dataclass(frozen=True)
class Limits:
    """Bounds on one file. memory, output, file_size: bytes; time: s; rows: of a matrix."""

    memory: int = 1024 * MiB
    time: float = 20.0
    output: int = 1024 * MiB
    file_size: int = 1024 * MiB
    rows: int = MOST_ROWS


class TooSlow(BadInput):
    """A file that was given up at the time limit."""


class _Killed(BadInput):
    """A file whose process was killed from outside."""


class WorkspaceReader:
    """Takes files one after another in a warm worker process; safe from several threads.

    The worker starts with `start()` or the first file, and again after it was lost. A file whose
    process was killed from outside (SIGKILL) is tried once more.
    """

    def __init__(self, limits: Limits | None = None) -> None:
        self.limits = limits or Limits()
        self._lock = threading.Lock()
        self._closed = False
        self._worker = WarmProcess(
            "mrlab_ros.adapters.workspaces.worker", start_limit=START_LIMIT, folder=Path("/")
        )

    def start(self) -> None:
        """Start the worker where there is none, so that the first file need not wait for it."""
        with self._lock:
            self._worker.warm()

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
                    content.compare(status, target, name, batch, self.limits.time)
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
            with os.fdopen(target, "w+b") as answer, tempfile.TemporaryFile() as asked:
                pickle.dump(task, asked)
                asked.seek(0)
                descriptors = [source, target, asked.fileno(), stored.fileno()]
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
        if status is None or status == -signal.SIGALRM:
            raise TooSlow(TOO_SLOW(file=name, limit=self.limits.time))
        if status:
            kind = _Killed if status == -signal.SIGKILL else BadInput
            raise kind(READER_DIED(file=name, **content.death(status)))

    def _ask(self, descriptors: list[int], name: str, **more: Any) -> int | None:
        """Return the exit status of the process that did a request, None past the time limit."""
        limits = self.limits
        message = json.dumps({**asdict(limits), **more, "name": name[-255:]}).encode()
        with self._lock:
            self._worker.warm()
            # the kernel's own timer ends the reading process; this deadline is the last resort
            return self._worker.ask(message, limits.time + 5, descriptors)


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
