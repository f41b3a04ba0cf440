"""The walled-off process that reads files from outside; started by `matfile_reader`.

It waits with everything imported and forks once for each file. The fork alone touches the file's
bytes, under limits that the kernel keeps (memory, processor time, wall time, output, no core
dump), writes what it found into the memory file it was given, and ends. Whatever a file does to
it, the waiting process and the lab never see more than an exit status.

One request is a JSON message with two descriptors: the file to read, the memory file to fill
with numbers, then the JSON index of them, then that index' length (8 bytes, little-endian). With
a third descriptor, the memory file of an earlier reading, one matrix of it is compared with what
a second reader finds in the file.
"""

from __future__ import annotations

import gzip
import io
import json
import mmap
import os
import resource
import signal
import socket
import sys
import zlib
from typing import Any

import numpy as np

from mrlab_ros.adapters.workspaces import joint_trajectories, mat5, objects, second_reader, tables
from mrlab_ros.adapters.workspaces.mat73 import read_hdf5
from mrlab_ros.adapters.workspaces.object_sinks import ObjectSink
from mrlab_ros.adapters.workspaces.view import View

MOST_VARIABLES = 20_000
MESSAGE_SIZE = 65_536
# what a table may look like before its rows are read
TEXTS = ("a text file", "a file of an unknown kind")


class OutputFile:
    """The sink that appends numbers to a file and keeps their index."""

    def __init__(self, fd: int, limit: int) -> None:
        self.file = os.fdopen(fd, "wb", buffering=1 << 16)
        self.limit = limit
        self.at = 0
        self.index: list[Any] = []
        self.omitted = 0

    def add(
        self,
        path: str,
        kind: str,
        shape: tuple[int, ...],
        data: memoryview | bytes | None = None,
        dtype: str = "",
        *,
        is_object: bool = False,
        note: str = "",
        columns: tuple[str, ...] = (),
        units: tuple[str, ...] = (),
        time: str = "",
        label: str = "",
        text: str = "",
        within_object: bool = False,
    ) -> None:
        if len(self.index) >= MOST_VARIABLES:
            self.omitted += 1
            return
        offset = -1
        if data is not None and len(shape) == 2 and len(data):
            if self.at + len(data) > self.limit:
                raise mat5.TooLarge(f"its matrices hold more than {self.limit / 2**20:.0f} MiB")
            offset = self.at
            self.file.write(data)
            padding = -len(data) % 8
            self.file.write(bytes(padding))
            self.at += len(data) + padding
        facts: dict[str, Any] = {"note": note, "columns": columns, "units": units, "time": time}
        facts |= {"is_object": is_object, "label": label, "text": text}
        self.index.append([path, kind, shape, offset, dtype, within_object, facts])

    def finish(self, **words: Any) -> None:
        words |= {"variables": self.index, "omitted": self.omitted}
        tail = json.dumps(words).encode()
        self.file.write(tail + len(tail).to_bytes(8, "little"))
        self.file.flush()


def inflate(data: memoryview, limit: int) -> bytes:
    """Return the contents of a gzip file; raise Damaged, or TooLarge above `limit` bytes."""
    try:
        with gzip.open(View(data)) as file:
            inflated = file.read(limit + 1)
    except (OSError, EOFError, zlib.error) as error:
        raise mat5.Damaged(f"the gzip file cannot be inflated ({error})") from error
    if len(inflated) > limit:
        raise mat5.TooLarge(f"it inflates to more than {limit / 2**20:.0f} MiB")
    return inflated


def read(data: memoryview, name: str, sink: mat5.Sink, limit: int) -> str:
    """Hand the variables of a file of any known format to the sink; return the format's name."""
    form = mat5.recognise(data)
    if form == "gzip":
        data = memoryview(inflate(data, limit))
        form = mat5.recognise(data)
        name = name.removesuffix(".gz")
    if form in ("mat5", "hdf5"):
        found = ObjectSink(sink)
        if form == "mat5":
            mat5.Mat5Reader(found, limit).read(data)
        else:
            read_hdf5(io.BufferedReader(View(data)), found, limit)
        objects.open_objects(data, found, limit)
        return "MATLAB v5 to v7" if form == "mat5" else "MATLAB v7.3"
    if form == "mat4":
        mat5.read_mat4(data, sink)
        return "MATLAB v4"
    if form in joint_trajectories.SUFFIXES:
        joint_trajectories.read_bag(data, form, sink, limit)
        return "rosbag2"
    if name.lower().endswith(".cdr"):
        joint_trajectories.read_cdr(data, name[: -len(".cdr")], sink)
        return "CDR"
    if name.lower().endswith(".npz"):
        tables.read_npz(data, sink, limit)
        return "NumPy npz"
    if form in TEXTS and name.lower().endswith((".csv", ".txt", ".tsv")):
        tables.read_csv(data, sink)
        return "CSV"
    raise mat5.NotAWorkspace(form)


def read_again(data: memoryview, numbers: int, place: list[Any]) -> str:
    """Compare a matrix that was read before with what the second reader finds in its file.

    numbers: the memory file that `read` filled. place: path, shape, offset and numpy type of the
    matrix. Returns what differs, or nothing.
    """
    path, shape, offset, dtype = place
    if mat5.recognise(data) == "gzip":
        data = memoryview(inflate(data, len(data) * 1100 + (1 << 20)))
    size = os.fstat(numbers).st_size
    with_numbers = mmap.mmap(numbers, size, prot=mmap.PROT_READ)
    flat = np.frombuffer(with_numbers, np.dtype(dtype), shape[0] * shape[1], offset)
    return second_reader.disagreement(data, path, flat.reshape(tuple(shape), order="F"))


def serve(source: int, target: int, numbers: int | None, request: dict[str, Any]) -> None:
    """Do one request, in the forked process; ends with an index that says how it went.

    numbers: the memory file of the first reading, where the request is to read a matrix again.
    """
    memory, seconds, output = request["memory"], request["time"], request["output"]
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    resource.setrlimit(resource.RLIMIT_FSIZE, (output + (1 << 26), output + (1 << 26)))
    used = address_space()
    resource.setrlimit(resource.RLIMIT_AS, (used + memory, used + memory))
    whole = int(seconds) + 2
    resource.setrlimit(resource.RLIMIT_CPU, (whole, whole))
    signal.setitimer(signal.ITIMER_REAL, seconds)
    sink = OutputFile(target, output)
    # An inflated variable is held twice for a moment, while its blocks are joined.
    limit = int(memory / 2.5)
    try:
        size = os.fstat(source).st_size
        data = memoryview(mmap.mmap(source, size, prot=mmap.PROT_READ) if size else b"")
        if numbers is None:
            sink.finish(format=read(data, request["name"], sink, limit))
        else:
            sink.finish(problem=read_again(data, numbers, request["again"]))
    except mat5.NotAWorkspace as error:
        sink.finish(code="unsupported_format", problem=str(error))
    except mat5.Damaged as error:
        sink.finish(code="unreadable", problem=str(error))
    except mat5.TooLarge as error:
        sink.finish(code="too_large", problem=str(error))
    except MemoryError:
        sink.finish(
            code="too_large", problem=f"reading it needs more than {memory / 2**20:.0f} MiB"
        )
    except Exception as error:
        sink.finish(code="unreadable", problem=f"the reader failed on it ({error!r})")


def address_space() -> int:
    """Return the size, bytes, of this process' address space."""
    with open("/proc/self/statm") as file:
        return int(file.read().split()[0]) * mmap.PAGESIZE


def main() -> None:
    """Serve requests from the socket whose descriptor is the first argument, until it closes."""
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, signal.SIG_IGN if number == signal.SIGINT else signal.SIG_DFL)
    np.zeros(1).sum()
    import scipy.io  # noqa: F401  the second reader's, loaded once for all files

    connection = socket.socket(fileno=int(sys.argv[1]))
    connection.send(b"{}")
    while True:
        message, descriptors, _, _ = socket.recv_fds(connection, MESSAGE_SIZE, 3)
        if not message:
            return
        child = os.fork()
        if child == 0:
            connection.close()
            try:
                source, target, *numbers = descriptors
                serve(source, target, next(iter(numbers), None), json.loads(message))
                os._exit(0)
            finally:
                os._exit(1)
        for descriptor in descriptors:
            os.close(descriptor)
        _, status = os.waitpid(child, 0)
        connection.send(json.dumps({"status": os.waitstatus_to_exitcode(status)}).encode())


if __name__ == "__main__":
    main()
