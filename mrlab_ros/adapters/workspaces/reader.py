"""Reads a file from outside through the walled-off process of `matfile_worker`."""

from __future__ import annotations

import contextlib
import hashlib
import json
import mmap
import os
import signal
import socket
import stat
import subprocess
import sys
import threading
import weakref
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

import mrlab_ros
from mrlab_ros.core.conversion.workspace import Variable, Workspace
from mrlab_ros.core.diagnostics import Refused, finding

MiB = 1 << 20
START_LIMIT = 30.0  # s for the worker to import what it needs, on a busy machine


@dataclass(frozen=True)
class Limits:
    """Bounds on one file. memory, output, file_size: bytes; time: s."""

    memory: int = 1024 * MiB
    time: float = 20.0
    output: int = 1024 * MiB
    file_size: int = 1024 * MiB


class WorkspaceReader:
    """Reads files one after another in a warm worker process; safe from several threads.

    The worker starts with `start()` or the first file, and again after it was lost.
    """

    def __init__(self, limits: Limits | None = None) -> None:
        self.limits = limits or Limits()
        self._lock = threading.Lock()
        self._process: subprocess.Popen[bytes] | None = None
        self._connection: socket.socket | None = None

    def start(self) -> None:
        """Start the worker where there is none, so that the first file need not wait for it."""
        with self._lock:
            self._warm()

    def close(self) -> None:
        """End the worker; a file that is being read is given up at once."""
        process = self._process
        if process is not None:
            _kill(process)
        with self._lock:
            self._stop()

    def __enter__(self) -> WorkspaceReader:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def read_file(self, path: Path) -> Workspace:
        """Read the file at `path`; raise Refused where it is not a whole, fitting workspace."""
        try:
            # a FIFO would wait for a writer that never comes
            source = os.open(path, os.O_RDONLY | os.O_CLOEXEC | os.O_NONBLOCK)
        except FileNotFoundError:
            raise Refused(finding("missing", file=str(path))) from None
        except OSError as error:
            problem = error.strerror or str(error)
            raise Refused(finding("unreadable", file=path.name, problem=problem)) from None
        try:
            if stat.S_ISDIR(os.fstat(source).st_mode):
                raise Refused(finding("unsupported_format", file=path.name, found="a folder"))
            if not stat.S_ISREG(os.fstat(source).st_mode):
                found = "no ordinary file"
                raise Refused(finding("unsupported_format", file=path.name, found=found))
            return self.read(source, path.name)
        finally:
            os.close(source)

    def read_bytes(self, data: bytes | memoryview, name: str) -> Workspace:
        """Read a file's bytes; `name` is what it is called."""
        source = os.memfd_create("workspace", os.MFD_CLOEXEC)
        try:
            view = memoryview(data)
            while len(view):
                view = view[os.write(source, view) :]
            return self.read(source, name)
        finally:
            os.close(source)

    def read(self, source: int, name: str) -> Workspace:
        """Read the regular file behind the descriptor `source`."""
        size = os.fstat(source).st_size
        if size > self.limits.file_size:
            problem = f"{size / MiB:.0f} MiB, the limit is {self.limits.file_size / MiB:.0f} MiB"
            raise Refused(finding("too_large", file=name, problem=problem))
        target = os.memfd_create("variables", os.MFD_CLOEXEC)
        try:
            status = self._ask([source, target], name)
            if status is None or status == -signal.SIGALRM:
                raise Refused(finding("too_slow", file=name, limit=self.limits.time))
            if status:
                raise Refused(finding("reader_died", file=name, problem=_death(status)))
            return self._collect(source, target, size, name)
        finally:
            os.close(target)

    def read_again(self, source: int, numbers: int, name: str, place: list[Any]) -> None:
        """Read one matrix with a second reader; raise Refused unless both find the same bits.

        source, numbers: descriptors of the file and of what was read of it. place: path, shape,
        offset and numpy type of the matrix.
        """
        target = os.memfd_create("second", os.MFD_CLOEXEC)
        try:
            status = self._ask([source, target, numbers], name, again=place)
            if status is None or status == -signal.SIGALRM:
                raise Refused(finding("too_slow", file=name, limit=self.limits.time))
            if status:
                problem = f"the second reader crashed on it ({_death(status)})"
            else:
                answer = _index(target)
                if answer.get("code") == "too_large":
                    raise Refused(finding("too_large", file=name, problem=answer["problem"]))
                problem = answer["problem"]
        finally:
            os.close(target)
        if problem:
            words = {"file": name, "problem": problem}
            raise Refused(finding("readers_disagree", variable=place[0], **words))

    def _ask(self, descriptors: list[int], name: str, **more: Any) -> int | None:
        """Return the exit status of the process that did a request, None past the time limit."""
        limits = self.limits
        request = {"memory": limits.memory, "time": limits.time, "output": limits.output}
        message = json.dumps({**request, **more, "name": name[-255:]}).encode()
        with self._lock:
            connection = self._warm()
            try:
                socket.send_fds(connection, [message], descriptors)
                # the kernel's own timer ends the reading process; this deadline is the last resort
                connection.settimeout(limits.time + 5)
                answer = connection.recv(4096)
            except TimeoutError:
                self._stop()
                return None
            except OSError:
                answer = b""
            if not answer:
                self._stop()
                return -signal.SIGKILL
            status: int = json.loads(answer)["status"]
            return status

    def _collect(self, source: int, target: int, size: int, name: str) -> Workspace:
        index = _index(target)
        if "code" in index:
            found = index["problem"]
            raise Refused(finding(index["code"], file=name, problem=found, found=found))
        numbers = mmap.mmap(target, os.fstat(target).st_size, prot=mmap.PROT_READ)
        variables = tuple(_variable(numbers, *entry) for entry in index["variables"])
        digest = _sha256(source, size)
        confirm = _Confirmation(self, source, target, name, index["variables"])
        return Workspace(index["format"], variables, index["omitted"], digest, confirm)

    def _warm(self) -> socket.socket:
        if self._process and self._process.poll() is None and self._connection:
            return self._connection
        self._stop()
        ours, theirs = socket.socketpair(socket.AF_UNIX, socket.SOCK_SEQPACKET)
        package = str(Path(mrlab_ros.__file__).parent.parent)
        environment = os.environ | {
            "PYTHONPATH": os.pathsep.join([package, os.environ.get("PYTHONPATH", "")]),
            # forking is safe with one thread only
            "OPENBLAS_NUM_THREADS": "1",
            "OMP_NUM_THREADS": "1",
        }
        command = [
            sys.executable,
            "-m",
            "mrlab_ros.adapters.workspaces.worker",
            str(theirs.fileno()),
        ]
        self._process = subprocess.Popen(
            command,
            pass_fds=[theirs.fileno()],
            stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL,
            env=environment,
            cwd="/",
            start_new_session=True,
        )
        theirs.close()
        ours.settimeout(START_LIMIT)
        self._connection = ours
        try:
            ready = ours.recv(4096)
        except OSError:
            ready = b""
        if not ready:
            self._stop()
            raise RuntimeError("the process that reads workspace files did not start")
        return ours

    def _stop(self) -> None:
        if self._connection:
            self._connection.close()
        if self._process:
            _kill(self._process)
            self._process.wait()
        self._process = self._connection = None


def _kill(process: subprocess.Popen[bytes]) -> None:
    """End a worker and the process that reads for it."""
    if process.returncode is None:
        with contextlib.suppress(ProcessLookupError):
            os.killpg(process.pid, signal.SIGKILL)


class _Confirmation:
    """Reads matrices of a file again, as long as the workspace that holds this exists."""

    def __init__(
        self, reader: WorkspaceReader, source: int, numbers: int, name: str, index: list[Any]
    ) -> None:
        self._reader = reader
        self._name = name
        self._places: dict[str, list[Any]] = {}
        for path, _, shape, offset, dtype, within_object, _ in index:
            if offset >= 0 and not within_object:
                self._places.setdefault(path, [path, shape, offset, dtype])
        self._descriptors = os.dup(source), os.dup(numbers)
        for descriptor in self._descriptors:
            weakref.finalize(self, os.close, descriptor)

    def __call__(self, path: str) -> None:
        place = self._places.get(path)
        if place is not None:
            self._reader.read_again(*self._descriptors, self._name, place)


def _index(target: int) -> dict[str, Any]:
    """Return the index at the end of a memory file that a worker filled."""
    length = os.fstat(target).st_size
    with mmap.mmap(target, length, prot=mmap.PROT_READ) as tail:
        end = int.from_bytes(tail[length - 8 :], "little")
        index: dict[str, Any] = json.loads(tail[length - 8 - end : length - 8])
    return index


def _variable(
    numbers: mmap.mmap,
    path: str,
    kind: str,
    shape: list[int],
    offset: int,
    dtype: str,
    _within_object: bool,
    facts: dict[str, Any],
) -> Variable:
    values = None
    if offset >= 0:
        flat = np.frombuffer(numbers, np.dtype(dtype), shape[0] * shape[1], offset)
        values = flat.reshape(tuple(shape), order="F")
    facts |= {name: tuple(facts[name]) for name in ("columns", "units")}
    return Variable(path, kind, tuple(shape), values, **facts)


def _sha256(source: int, size: int) -> str:
    if not size:
        return hashlib.sha256().hexdigest()
    with mmap.mmap(source, size, prot=mmap.PROT_READ) as data:
        return hashlib.sha256(data).hexdigest()


def _death(status: int) -> str:
    """Say how a process with this exit status ended."""
    if status > 0:
        return f"exit code {status}"
    try:
        return f"signal {-status}, {signal.strsignal(-status)}"
    except ValueError:
        return f"signal {-status}"
