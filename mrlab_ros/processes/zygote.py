"""One process that imports what the lab's processes need and forks each of them.

What they import they share then, instead of having it once each, and a process that is started
again is there in a moment. The fork happens before rclpy is initialised, before zenoh is opened
and before there is a thread that does anything: LTTng's two, which come with rclpy, wait for a
daemon and are not forked.

A forked process is a child of the supervisor, as if that had started it: it outlives the zygote,
the supervisor reaps it, and the kernel kills it when the supervisor ends. A zygote that was killed
is replaced; where it fails itself, the supervisor starts programs instead.
"""

from __future__ import annotations

import ctypes
import gc
import importlib
import json
import os
import runpy
import shlex
import signal
import socket
import subprocess
import sys
import threading
import time
from collections.abc import Mapping
from pathlib import Path
from typing import IO

from mrlab_ros.adapters.sandbox.warm_process import MESSAGE_SIZE, WarmProcess

# The module that all nodes need first, and the graph with it.
COMMON = "mrlab_ros.processes.node_runner"
# For the imports of a process, on a busy machine, s.
LIMIT_S = 30.0
PR_SET_PDEATHSIG = 1
PR_SET_CHILD_SUBREAPER = 36
# Room for the command line of a forked process, bytes: the zygote is started with an argument of
# this length. The kernel shows a page of it at most.
TITLE = 4000
_kept: list[ctypes.Array[ctypes.c_char]] = []
# Other threads of the zygote come to rest within this time, s; each then waits in the kernel.
REST_S, POLL_S = 1.0, 0.001


class Forked:
    """A process that the zygote forked, as subprocess.Popen shows one."""

    def __init__(self, pid: int, stdout: IO[bytes]) -> None:
        self.pid, self.stdout = pid, stdout

    def wait(self) -> int:
        """Wait for its end and reap it; return its exit code, a negative one for a signal."""
        return os.waitstatus_to_exitcode(os.waitpid(self.pid, 0)[1])


class Zygote:
    """The supervisor's side; a context manager that ends the zygote, not what it forked."""

    def __init__(self) -> None:
        self._process = WarmProcess(
            __name__, (" " * TITLE,), start_limit=LIMIT_S, errors=subprocess.DEVNULL
        )
        self._lock = threading.Lock()
        self._lost = False

    def __enter__(self) -> Zygote:
        self._process.begin()
        return self

    def __exit__(self, *_: object) -> None:
        with self._lock:
            self._lost = True
            self._process.stop()

    def kill(self) -> None:
        """End it for good, from any thread, without waiting; what waits for a fork gets none."""
        self._lost = True
        self._process.kill()

    def fork(
        self,
        module: str,
        argv: tuple[str, ...],
        imports: tuple[str, ...],
        environment: Mapping[str, str],
    ) -> Forked | None:
        """Return a process that runs `module` as `argv` would; None: the zygote has failed.

        imports: modules to import before, to share them with those that follow. environment: what
        it has beside that of this process.
        """
        request = {
            "module": module,
            "argv": argv,
            "imports": imports,
            "environment": dict(environment),
            "parent": os.getpid(),
        }
        with self._lock:
            if self._lost:
                return None
            read, write = os.pipe()
            # A grandchild whose parent ends becomes the child of a subreaper above it. Nobody
            # else is to become ours.
            prctl = ctypes.CDLL(None).prctl
            prctl(PR_SET_CHILD_SUBREAPER, 1)
            try:
                self._process.warm()
                pid = self._process.ask(json.dumps(request).encode(), LIMIT_S, [write])
            except RuntimeError:
                pid = None
            finally:
                prctl(PR_SET_CHILD_SUBREAPER, 0)
                os.close(write)
            if pid is None or pid <= 0:
                self._lost = True
                os.close(read)
                return None
            return Forked(pid, os.fdopen(read, "rb"))


def main() -> None:
    """Fork for each request on the socket whose descriptor is the first argument; see Zygote."""
    # SIGINT stays blocked in what is forked until it has decided what that does.
    signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    connection = socket.socket(fileno=int(sys.argv[1]))
    _show((*sys.orig_argv[:4],))
    # Imports make much that lives on, and little garbage.
    gc.disable()
    module = _serve(connection)
    gc.enable()
    if module:
        runpy._run_module_as_main(module)  # type: ignore[attr-defined]


def _serve(connection: socket.socket) -> str:
    """Answer requests until the connection closes; in a forked process return its module."""
    connection.send(b"{}")
    from mrlab_ros.ros.environment import load_type_supports, skip_generator

    skip_generator()
    importlib.import_module(COMMON)
    while True:
        try:
            message, [output], _, _ = socket.recv_fds(connection, MESSAGE_SIZE, 1)
        except (ConnectionError, ValueError):
            return ""
        request = json.loads(message)
        for name in request["imports"]:
            importlib.import_module(name)
        load_type_supports()
        # What the collector does not visit stays shared.
        gc.freeze()
        _rest()
        pid = _fork()
        if pid is None:
            connection.close()
            _become(request, output)
            return str(request["module"])
        os.close(output)
        connection.send(json.dumps({"status": pid}).encode())


def _rest() -> None:
    """Wait until no other thread of this process runs: one might hold a lock."""
    deadline = time.monotonic() + REST_S
    own = str(threading.get_native_id())
    others = [p for p in Path("/proc/self/task").iterdir() if p.name != own]
    for other in others:
        while time.monotonic() < deadline:
            try:
                state = (other / "stat").read_text().rpartition(")")[2].split()[0]
            except OSError:
                break
            if state == "S":
                break
            time.sleep(POLL_S)


def _fork() -> int | None:
    """Fork a process of which a subreaper is the parent; return its id, None within it."""
    told, tell = os.pipe()
    begun, begin = os.pipe()
    between = os.fork()
    if between == 0:
        child = os.fork()
        if child:
            os.write(tell, str(child).encode())
            os._exit(0)
        for descriptor in (told, tell, begin):
            os.close(descriptor)
        if not os.read(begun, 1):  # until the one between is gone; nothing: the zygote is, too
            os._exit(0)
        os.close(begun)
        return None
    os.waitpid(between, 0)
    child = int(os.read(told, 32))
    os.write(begin, b"1")
    for descriptor in (told, tell, begun, begin):
        os.close(descriptor)
    return child


def _become(request: dict[str, object], output: int) -> None:
    """Make this process what the supervisor would have started."""
    os.setsid()
    ctypes.CDLL(None).prctl(PR_SET_PDEATHSIG, signal.SIGKILL)
    if os.getppid() != request["parent"]:
        os._exit(0)
    for number in (1, 2):
        os.dup2(output, number)
    os.close(output)
    # A stream remembers whether one can seek in it: the zygote's are of another kind.
    encoding = getattr(sys.stdout, "encoding", None)
    sys.stdout = open(1, "w", 1, encoding, closefd=False)  # noqa: SIM115
    sys.stderr = open(2, "w", 1, encoding, "backslashreplace", closefd=False)  # noqa: SIM115
    environment, argv = request["environment"], request["argv"]
    assert isinstance(environment, dict)
    assert isinstance(argv, list)
    os.environ.update(environment)
    _show(argv)
    sys.argv = ["", *argv[argv.index(request["module"]) + 1 :]]


def _show(argv: tuple[str, ...] | list[str]) -> None:
    """Let `ps` show this command line in place of the zygote's."""
    # What names the program to libraries lies in the memory that is overwritten.
    for name in ("program_invocation_name", "program_invocation_short_name"):
        known = ctypes.c_void_p.in_dll(ctypes.CDLL(None), name)
        _kept.append(ctypes.create_string_buffer(ctypes.string_at(known.value or 0)))
        known.value = ctypes.addressof(_kept[-1])
    fields = Path("/proc/self/stat").read_text(errors="replace").rpartition(")")[2].split()
    begin, end = int(fields[45]), int(fields[46])
    shown = shlex.join(argv).encode()[: end - begin - 2]
    # A last byte that is not 0 tells the kernel that the text ends at the first 0.
    ctypes.memmove(begin, shown.ljust(end - begin - 1, b"\0") + b"\1", end - begin)


if __name__ == "__main__":
    main()
