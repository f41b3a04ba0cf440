"""Hands submissions to a walled-off process of `worker`, one after another."""

from __future__ import annotations

import json
import os
import shutil
import signal
import subprocess
import tempfile
import threading
import time
from collections.abc import Mapping
from multiprocessing.util import Finalize
from pathlib import Path

import orjson

from mrlab_ros.adapters.warm_process import WarmProcess
from mrlab_ros.adapters.workspaces.content import death
from mrlab_ros.commands.classroom import worker
from mrlab_ros.commands.classroom.diagnostics import GRADER_NOT_STARTED
from mrlab_ros.commands.classroom.setup import Setup, Task
from mrlab_ros.core.base.diagnostic import Diagnostic, from_plain
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.classroom.diagnostics import (
    SUBMISSION_CRASHED,
    SUBMISSION_ENDED,
    SUBMISSION_GIVEN_UP,
)
from mrlab_ros.core.classroom.result import FAILED, without_marks

START_LIMIT = 120.0  # s for the process to import and to check the reference, on a busy machine
PARENT_PERIOD = 2.0  # s between two looks whether the class still runs
GRACE = 15.0  # s beyond the kernel's own timer
_graders: dict[bytes, Grader] = {}


class Grader:
    """A process that checks submissions of one class; it starts anew after it was lost."""

    def __init__(self, setup: Setup, scratch: str = "") -> None:
        """scratch: folder for its files, which somebody removes; empty: one of its own."""
        self.setup = setup
        self._scratch = Path(tempfile.mkdtemp(prefix="mrlab-class-", dir=scratch or None))
        (self._scratch / "setup").write_bytes(setup.packed)
        self._worker = WarmProcess(
            "mrlab_ros.commands.classroom.worker",
            [str(self._scratch)],
            start_limit=START_LIMIT,
            errors=subprocess.DEVNULL,
        )

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
            why = self._lost(status)
            result = without_marks(self.setup.rubric, FAILED, why, names[0] if names else "")
            return {worker.RESULT: orjson.dumps(result.plain())}
        finally:
            shutil.rmtree(folder, ignore_errors=True)

    def close(self) -> None:
        """End the process and remove what it left."""
        self._worker.stop()
        shutil.rmtree(self._scratch, ignore_errors=True)

    def _given(self, task: Task, folder: Path) -> list[str]:
        """Write the files of a submission side by side; return their names."""
        names: list[str] = []
        for number, (name, content) in enumerate(task.files):
            own = name if name not in (*names, "out") else f"{number}-{name}"
            (folder / own).write_bytes(content)
            names.append(own)
        return names

    def _lost(self, status: int | None) -> Diagnostic:
        bounds = self.setup.bounds
        if status in (None, -signal.SIGALRM):
            return SUBMISSION_GIVEN_UP(limit=bounds.wall)
        if status in (-signal.SIGXCPU, -signal.SIGKILL):
            return SUBMISSION_ENDED(limit=bounds.time)
        return SUBMISSION_CRASHED(why=death(status or 1))

    def _ask(self, request: Mapping[str, object]) -> int | None:
        """Return the exit status of the process that did a request, None past the time limit."""
        try:
            ready = self._worker.warm()
        except RuntimeError:
            raise BadInput(GRADER_NOT_STARTED()) from None
        if ready and "error" in (said := json.loads(ready)):
            self._worker.stop()
            raise BadInput(from_plain(said["error"]))
        return self._worker.ask(json.dumps(request).encode(), self.setup.bounds.wall + GRACE)


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
