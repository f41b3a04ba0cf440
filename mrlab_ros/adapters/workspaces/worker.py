"""The sandboxed process that converts files from outside; started by `reader`.

It waits with everything imported and forks once for each file. Only the fork touches the file's
bytes. It works on a private copy, which nobody can shorten meanwhile, in the sandbox of
`adapters/sandbox` and under limits that the kernel keeps (memory, processor time, wall time,
output, no core dump): it hashes, reads, checks and derives, and writes the trajectory into the
file that it was given. It opens nothing else: where a file needs a reader that is not imported,
the fork ends with a status that names it, and the waiting process imports it and forks again.
Whatever a file does to the fork, the waiting process and the lab see no more than that status.

A request is a JSON message with descriptors. Two of them: the file and a memory file, which gets
the numbers of the variables, then their JSON index, then that index' length (8 bytes,
little-endian). With a third, the memory file of an earlier reading, one matrix of it is compared
with what a second reader finds in the file. Four: the file, a memory file for the result
(`results`), the task (a pickle from the lab), and the empty file for the trajectory, as
`adapters/trajectories/npz_file.py` writes it.
"""

from __future__ import annotations

import codecs
import contextlib
import encodings
import gc
import importlib
import io
import json
import math
import mmap
import os
import pickle
import pkgutil
import resource
import signal
import socket
import sys
import tempfile
import traceback
import warnings
import weakref
from collections.abc import Callable
from pathlib import PurePath
from typing import Any

import numpy as np

from mrlab_ros.adapters.sandbox import restrictions
from mrlab_ros.adapters.sandbox.inert_output import guard
from mrlab_ros.adapters.workspaces import content, results
from mrlab_ros.adapters.workspaces.diagnostics import (
    BAD_TABLE,
    READER_FAILED,
    TOO_LARGE,
    UNREADABLE,
    UNSUPPORTED_FORMAT,
)
from mrlab_ros.adapters.workspaces.file_formats import COMPRESSED, inflate, read
from mrlab_ros.adapters.workspaces.matlab import second_reader
from mrlab_ros.adapters.workspaces.matlab.elements import (
    Damaged,
    NotATable,
    NotAWorkspace,
    TooLarge,
)
from mrlab_ros.adapters.workspaces.matlab.recognition import recognise
from mrlab_ros.adapters.workspaces.sinks import Found
from mrlab_ros.core.base.diagnostic import Diagnostic, plain
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.base.machine import lack
from mrlab_ros.core.conversion.options import Options
from mrlab_ros.core.conversion.picking import is_motion
from mrlab_ros.core.conversion.workspace import Workspace
from mrlab_ros.core.robots.model import Joint, KinematicChain, RobotModel, Segment
from mrlab_ros.core.trajectory.derived_signals import ProxyCoefficients

MOST_VARIABLES = 50_000
MOST_DIMENSIONS = 32  # of an array in numpy before 2.0
MESSAGE_SIZE = 65_536
# what the index says of a variable beside its numbers
FACTS = ("note", "columns", "units", "time", "is_object", "label", "text")
# packages that readers of seldom files need, and the exit status that asks for the first of them
SELDOM = ("matio", "rosbags", "yaml")
ASKED = 64
# how a file of this ending is saved in Python
IN_PYTHON = {
    ".npy": "np.save('traj.npy', q)",
    ".npz": "np.savez('traj.npz', q=q, fs=100)",
    ".json": "json.dump({'q': q.tolist(), 'fs': 100}, file)",
}
whole: set[str] = set()  # those of SELDOM that this process has imported


class OutputFile:
    """The sink that appends numbers to a file and keeps their index."""

    def __init__(self, fd: int, limit: int) -> None:
        os.ftruncate(fd, 0)
        self.file = os.fdopen(fd, "wb", buffering=1 << 16)
        self.file.seek(0)
        self.limit = limit
        self.at = 0
        self.index: list[Any] = []
        self.omitted = 0

    def add(self, found: Found) -> None:
        if len(self.index) >= MOST_VARIABLES:
            self.omitted += 1
            return
        shape, data = tuple(found.shape), found.data
        offset = -1
        if data is not None and _is_kept(shape) and len(data):
            if self.at + len(data) > self.limit:
                raise TooLarge("numbers", self.limit)
            offset = self.at
            self.file.write(data)
            padding = -len(data) % 8
            self.file.write(bytes(padding))
            self.at += len(data) + padding
        facts = {name: plain(getattr(found, name)) for name in FACTS}
        entry = [found.path, found.kind, shape, offset, found.dtype, found.within_object, facts]
        self.index.append(entry)

    def finish(self, **words: Any) -> None:
        words |= {"variables": self.index, "omitted": self.omitted}
        tail = json.dumps(words).encode()
        self.file.write(tail + len(tail).to_bytes(8, "little"))
        self.file.flush()


def _is_kept(shape: tuple[int, ...]) -> bool:
    """Say whether the numbers of an array are of use: those of a matrix or of transforms."""
    return 2 <= len(shape) <= MOST_DIMENSIONS and (
        is_motion(shape) or (len(shape) == 3 and shape[:2] == (4, 4))
    )


def read_again(
    data: memoryview, numbers: mmap.mmap, places: list[list[Any]]
) -> tuple[str, Diagnostic | None]:
    """Compare matrices that were read before with what the second reader finds in their file.

    numbers: what `read` filled. places: path, shape, offset and numpy type of
    each matrix. Returns the path of the first that differs and what differs, or neither.
    """
    form = recognise(data)
    if form in COMPRESSED:
        data = inflate(data, form, len(data) * COMPRESSED[form] + (1 << 20))
    loaded: dict[str, Any] = {}
    for path, shape, offset, dtype in places:
        flat = np.frombuffer(numbers, np.dtype(dtype), math.prod(shape), offset)
        values = flat.reshape(tuple(shape), order="F")
        problem = second_reader.disagreement(data, path, values, loaded)
        if problem is not None:
            return path, problem
    return "", None


def imported(module: str) -> None:
    """End this process with the status that asks for a package, unless it is imported already."""
    if module not in whole:
        os._exit(ASKED + SELDOM.index(module))


def serve(source: int, target: int, numbers: int | None, request: dict[str, Any]) -> None:
    """Read a file into `target`, which ends with an index that says how it went.

    numbers: the memory file of the first reading, where one matrix is to be read again.
    """
    memory, name = request["memory"], request["name"]
    sink = OutputFile(target, request["output"])
    # An inflated variable is held twice for a moment, while its blocks are joined.
    limit = int(memory / 2.5)
    try:
        size = os.fstat(source).st_size
        data = memoryview(mmap.mmap(source, size, prot=mmap.PROT_READ) if size else b"")
        if numbers is None:
            with restrictions.nothing_opens():
                form = read(data, name, sink, limit, imported, request.get("joints", ()))
            sink.finish(format=form, sha256=content.sha256(source))
        else:
            length = os.fstat(numbers).st_size
            found = mmap.mmap(numbers, length, prot=mmap.PROT_READ)
            with restrictions.nothing_opens():
                path, problem = read_again(data, found, request["again"])
            sink.finish(refused=plain(problem), variable=path)
    except MemoryError:
        sink.finish(refused=plain(TOO_LARGE(file=name, part="reading", limit=memory)))
    except OSError as error:
        why = results.failed_here(name, error) if lack(error) else _refusal(name, error)
        sink.finish(refused=plain(why))
    except Exception as error:
        sink.finish(refused=plain(_refusal(name, error)))


def _refusal(name: str, error: Exception) -> Diagnostic:
    """Return what is said of a file on which a reader raised an error."""
    if isinstance(error, NotAWorkspace):
        form, *details = error.args
        return UNSUPPORTED_FORMAT(file=name, form=form, detail="".join(details))
    if isinstance(error, NotATable):
        return BAD_TABLE(file=name, why=error.args[0])
    if isinstance(error, Damaged):
        python = IN_PYTHON.get(PurePath(name.lower()).suffix)
        return UNREADABLE(file=name, why=error.args[0], python=python)
    if isinstance(error, TooLarge):
        return TOO_LARGE(file=name, part=error.part, limit=error.limit, size=error.size)
    return UNREADABLE(file=name, why=READER_FAILED(error=repr(error)))


def work(descriptors: list[int], request: dict[str, Any]) -> None:
    """Do what one request asks, in the forked process."""
    _limit_time(request["time"], request["wall"])
    source, target = descriptors[:2]
    changed: BadInput | None = None
    try:
        copy = content.copied(source, request["file_size"], request["name"])
    except BadInput as error:
        changed = error
    asked = _task(descriptors[2]) if len(descriptors) == 4 else None
    # the stored trajectory has three matrices for each one of the file
    restrictions.confine(
        memory=request["memory"],
        seconds=request["time"],
        file_size=4 * request["output"] + (1 << 26),
    )
    restrictions.shut()
    if asked is None:
        if changed is not None:
            OutputFile(target, 0).finish(refused=plain(changed))
        else:
            serve(copy, target, next(iter(descriptors[2:]), None), request)
        return

    def found() -> Workspace:
        if changed is not None:
            raise changed
        return workspace(copy, {**request, "joints": asked.robot.joint_names})

    with os.fdopen(target, "wb") as reply, os.fdopen(descriptors[3], "wb") as trajectory:
        reply.write(results.run(asked, found, request["memory"], trajectory, request["rows"]))


def _limit_time(processor: float, wall: float) -> None:
    """Let the kernel end this process after s of a processor, or s on a clock."""
    signal.setitimer(signal.ITIMER_PROF, processor)
    signal.setitimer(signal.ITIMER_REAL, wall)


def _task(descriptor: int) -> results.Task:
    """Return what is asked: a pickle from the lab, not from the file."""
    os.lseek(descriptor, 0, os.SEEK_SET)
    with os.fdopen(descriptor, "rb") as file:
        task: results.Task = pickle.load(file)
    return task


def workspace(copy: int, request: dict[str, Any]) -> Workspace:
    """Return what the file behind the descriptor `copy` holds; raise BadInput where it is none.

    In a sandboxed process: the second reader runs in one of its own, the first in this
    one. request: memory, output: bytes; time: s; name of the file.
    """
    name = request["name"]

    def again(places: list[content.Place]) -> None:
        answer = os.memfd_create("second", os.MFD_CLOEXEC)
        status = forked(lambda: serve(copy, os.dup(answer), numbers, {**request, "again": places}))
        content.compare(status, answer, name, places, request["time"], request["wall"])

    numbers = os.memfd_create("variables", os.MFD_CLOEXEC)
    serve(copy, os.dup(numbers), None, request)
    found = content.collect(numbers, again)
    # the memory file goes with the last who may read it again
    weakref.finalize(found.confirm, os.close, numbers)
    return found


def forked(do: Callable[[], None]) -> int:
    """Run `do` in a process of its own, which scipy may bring down; return its exit status."""
    timers = (signal.ITIMER_PROF, signal.ITIMER_REAL)
    # 0 s: there is no such limit
    processor, wall = (signal.getitimer(timer)[0] for timer in timers)
    child = os.fork()
    if child == 0:
        try:
            # a fork inherits the limits, but not the timers
            _limit_time(processor, wall)
            _, most = resource.getrlimit(resource.RLIMIT_AS)
            resource.setrlimit(resource.RLIMIT_AS, (most, most))
            do()
            os._exit(0)
        finally:
            os._exit(1)
    return os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])


def import_whole(package: str) -> None:
    """Import a package with all its modules: in the sandbox none could be opened."""
    found = importlib.import_module(package)
    for module in pkgutil.walk_packages(found.__path__, f"{package}."):
        with contextlib.suppress(ImportError):  # it needs what is not installed
            importlib.import_module(module.name)
    whole.add(package)


def load_encodings() -> None:
    """Import the encodings of texts in any file, each of which Python imports on its first use."""
    for module in pkgutil.iter_modules(encodings.__path__):
        with contextlib.suppress(LookupError, ImportError):  # those of another system
            codecs.lookup(module.name)


def warm_up() -> None:
    """Convert a small workspace of our own, so that no fork pays for what is done but once.

    Libraries load and cache on their first call; a fork would do it again for each file.
    """
    second_reader.import_scipy()
    import scipy.io

    load_encodings()
    joints = 6
    rows = np.linspace(0, 0.5, 60)[:, np.newaxis] ** 2 * np.linspace(0.2, 1, joints)
    saved = io.BytesIO()
    scipy.io.savemat(saved, {"q": rows, "fs": 100.0}, do_compression=True)
    axis, offset = np.array([0.0, 0.0, 1.0]), np.eye(4)
    segments = tuple(Segment(f"link_{i + 1}", offset, axis) for i in range(joints))
    robot = RobotModel(
        id="warm_up",
        manufacturer="",
        product="",
        robot_class="",
        payload=1.0,
        reach=1.0,
        joints=tuple(Joint(f"joint_{i + 1}", -3.0, 3.0, 3.0) for i in range(joints)),
        home=np.zeros(joints),
        chain=KinematicChain("base_link", segments),
    )
    ones = (1.0,) * joints
    coefficients = ProxyCoefficients(ones, ones, ones, ones, 10.0)
    task = results.Task("q.mat", Options(), robot, coefficients, None, "", 0, 100.0)
    request = {"memory": 1 << 30, "output": 1 << 20, "name": "q.mat"}
    numbers, answer = os.memfd_create("variables"), os.memfd_create("second")
    with tempfile.TemporaryFile() as source, tempfile.TemporaryFile() as stored:
        source.write(saved.getvalue())
        source.flush()

        def again(places: list[content.Place]) -> None:
            serve(source.fileno(), os.dup(answer), numbers, {**request, "again": places})
            content.compare(0, answer, "q.mat", places, 0.0, 0.0)

        def found() -> Workspace:
            serve(source.fileno(), os.dup(numbers), None, request)
            return content.collect(numbers, again)

        results.run(task, found, 1 << 30, stored)
    os.close(numbers)
    os.close(answer)


def main() -> None:
    """Serve requests from the socket whose descriptor is the first argument, until it closes."""
    guard()
    warnings.simplefilter("ignore", RuntimeWarning)  # of numbers too large, which are findings
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, signal.SIG_IGN if number == signal.SIGINT else signal.SIG_DFL)
    warm_up()
    restrictions.layers(), restrictions.filter_program(opens=False)  # made once for all forks
    # objects that the collector does not visit stay shared with the forks
    gc.collect()
    gc.freeze()
    connection = socket.socket(fileno=int(sys.argv[1]))
    # The lab was killed: there is nobody left to work for.
    with contextlib.suppress(ConnectionError):
        answer(connection)


def answer(connection: socket.socket) -> None:
    """Answer one request after another until the connection is closed."""
    connection.send(b"{}")
    while True:
        message, descriptors, _, _ = socket.recv_fds(connection, MESSAGE_SIZE, 4)
        if not message:
            return
        status = done(connection, descriptors, json.loads(message))
        while 0 <= status - ASKED < len(SELDOM) and SELDOM[status - ASKED] not in whole:
            import_whole(SELDOM[status - ASKED])
            status = done(connection, descriptors, json.loads(message))
        for descriptor in descriptors:
            os.close(descriptor)
        connection.send(json.dumps({"status": status}).encode())


def done(connection: socket.socket, descriptors: list[int], request: dict[str, Any]) -> int:
    """Do what one request asks in a fork, and return its exit status."""
    child = os.fork()
    if child == 0:
        connection.close()
        try:
            work(descriptors, request)
            os._exit(0)
        except BaseException:
            traceback.print_exc()
        finally:
            os._exit(1)
    return os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])


if __name__ == "__main__":
    main()
