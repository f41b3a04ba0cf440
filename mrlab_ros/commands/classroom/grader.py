"""Hands submissions to a walled-off process of `worker`, one after another."""

from __future__ import annotations

import contextlib
import json
import os
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import threading
import time
from collections.abc import Mapping
from multiprocessing.util import Finalize
from pathlib import Path

import orjson

import mrlab_ros
from mrlab_ros.adapters.workspaces.content import death
from mrlab_ros.commands.classroom import worker
from mrlab_ros.commands.classroom.setup import Setup, Task
from mrlab_ros.core.classroom.result import FAILED, without_marks
from mrlab_ros.core.errors import BadInput

START_LIMIT = 120.0  # s for the process to import and to check the reference, on a busy machine
PARENT_PERIOD = 2.0  # s between two looks whether the class still runs
GRACE = 15.0  # s beyond the kernel's own timer
# The libraries draw nothing from more threads, and forking is safe with one only.
ONE_THREAD = {"OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1", "MKL_NUM_THREADS": "1"}
_graders: dict[bytes, Grader] = {}


class Grader:
    """A process that checks submissions of one class; it starts anew after it was lost."""

    def __init__(self, setup: Setup, scratch: str = "") -> None:
        """scratch: folder for its files, which somebody removes; empty: one of its own."""
        self.setup = setup
        self._scratch = Path(tempfile.mkdtemp(prefix="mrlab-class-", dir=scratch or None))
        (self._scratch / "setup").write_bytes(setup.packed)
        self._process: subprocess.Popen[bytes] | None = None
        self._connection: socket.socket | None = None

    def check(self, task: Task) -> dict[str, bytes]:
        """Return what was found of a submission: files by the names that `worker` gives them.

        Raises BadInput where no submission of the class can be checked.
        """
        folder = Path(tempfile.mkdtemp(dir=self._scratch))
        out = folder / "out"
        out.mkdir()
        try:
            names = self._given(task, folder)
            request = {"folder": str(folder), "out": str(out), "shown": task.shown, "files": names}
            status = self._ask(request)
            found = {p.name: p.read_bytes() for p in sorted(out.iterdir()) if p.is_file()}
            if status == 0 and worker.RESULT in found:
                return found
            words = self._lost(status)
            result = without_marks(self.setup.rubric, FAILED, words, names[0] if names else "")
            return {worker.RESULT: orjson.dumps(result.plain())}
        finally:
            shutil.rmtree(folder, ignore_errors=True)

    def close(self) -> None:
        """End the process and remove what it left."""
        self._stop()
        shutil.rmtree(self._scratch, ignore_errors=True)

    def _given(self, task: Task, folder: Path) -> list[str]:
        """Write the files of a submission side by side; return their names."""
        names: list[str] = []
        for number, (name, content) in enumerate(task.files):
            own = name if name not in (*names, "out") else f"{number}-{name}"
            (folder / own).write_bytes(content)
            names.append(own)
        return names

    def _lost(self, status: int | None) -> str:
        bounds = self.setup.bounds
        if status in (None, -signal.SIGALRM):
            return f"the check was given up after {bounds.wall:.0f} s"
        if status in (-signal.SIGXCPU, -signal.SIGKILL):
            return (
                f"the check was ended: it took more than {bounds.time:.0f} s of a processor, or "
                "the machine had no memory left"
            )
        return f"the check crashed on it ({death(status or 1)}); the file is the reason, no other"

    def _ask(self, request: Mapping[str, object]) -> int | None:
        """Return the exit status of the process that did a request, None past the time limit."""
        connection = self._warm()
        try:
            connection.send(json.dumps(request).encode())
            connection.settimeout(self.setup.bounds.wall + GRACE)
            answer = connection.recv(4096)
        except TimeoutError:
            self._stop()
            return None
        except OSError:
            answer = b""
        if not answer:
            self._stop()
            return -signal.SIGKILL
        return int(json.loads(answer)["status"])

    def _warm(self) -> socket.socket:
        if self._process and self._process.poll() is None and self._connection:
            return self._connection
        self._stop()
        ours, theirs = socket.socketpair(socket.AF_UNIX, socket.SOCK_SEQPACKET)
        package = str(Path(mrlab_ros.__file__).parent.parent)
        environment = os.environ | ONE_THREAD
        environment["PYTHONPATH"] = os.pathsep.join([package, os.environ.get("PYTHONPATH", "")])
        module = "mrlab_ros.commands.classroom.worker"
        self._process = subprocess.Popen(
            [sys.executable, "-m", module, str(theirs.fileno()), str(self._scratch)],
            pass_fds=[theirs.fileno()], stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL, env=environment, start_new_session=True,
        )  # fmt: skip
        theirs.close()
        ours.settimeout(START_LIMIT)
        self._connection = ours
        try:
            ready = ours.recv(worker.MESSAGE_SIZE)
        except OSError:
            ready = b""
        said = json.loads(ready) if ready else {"error": "the process that checks did not start"}
        if "error" in said:
            self._stop()
            raise BadInput(str(said["error"]))
        return ours

    def _stop(self) -> None:
        if self._process:
            # before the connection is closed: a process that lives removes the folder then
            with contextlib.suppress(ProcessLookupError):
                os.killpg(self._process.pid, signal.SIGKILL)
            self._process.wait()
        if self._connection:
            self._connection.close()
        self._process = self._connection = None


def checked(setup: Setup, task: Task, scratch: str = "", owner: int = 0) -> dict[str, bytes]:
    """Check a submission in this process' own grader, which stays for the next one.

    owner: process whose child this one is, and with which it ends; 0: it ends by itself.
    """
    grader = _graders.get(setup.packed)
    if grader is None:
        if not _graders:
            Finalize(None, close_all, exitpriority=10)  # joblib's processes end without atexit
            if owner not in (0, os.getpid()):
                watch = threading.Thread(target=_end_with_parent, args=(owner,), daemon=True)
                watch.start()
        close_all()
        grader = _graders[setup.packed] = Grader(setup, scratch)
    return grader.check(task)


def _end_with_parent(parent: int) -> None:
    """End this process of joblib's, and its grader, when the class was killed: it would wait."""
    while os.getppid() == parent:
        time.sleep(PARENT_PERIOD)
    close_all()
    os._exit(1)


def close_all() -> None:
    """End the graders of this process."""
    while _graders:
        _graders.popitem()[1].close()
