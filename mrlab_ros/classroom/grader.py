"""Hands submissions to a sandboxed process of `worker`, one after another.

`run` does that in several processes: on this machine, or with dask or ray.
"""

from __future__ import annotations

import contextlib
import hashlib
import itertools
import json
import os
import shutil
import signal
import subprocess
import tempfile
import time
from collections.abc import Callable, Iterable, Iterator, Mapping
from concurrent.futures.process import BrokenProcessPool
from functools import partial
from multiprocessing.util import Finalize
from pathlib import Path
from typing import Any, TypeVar

import orjson

import mrlab_ros
from mrlab_ros.adapters import threads
from mrlab_ros.adapters.sandbox.warm_process import WarmProcess
from mrlab_ros.adapters.workspaces.content import cause
from mrlab_ros.classroom import worker
from mrlab_ros.classroom.diagnostics import (
    BACKEND_NOT_INSTALLED,
    GRADER_NOT_STARTED,
    SCHEDULER_NEEDS_CLUSTER,
    SCHEDULER_NOT_REACHED,
    UNKNOWN_BACKEND,
    WORKERS_DIFFER,
)
from mrlab_ros.classroom.marks.diagnostics import (
    SUBMISSION_CRASHED,
    SUBMISSION_ENDED,
    SUBMISSION_GIVEN_UP,
    SUBMISSION_KILLED,
)
from mrlab_ros.classroom.marks.result import FAILED, TO_REPEAT, without_marks
from mrlab_ros.classroom.setup import Setup, Task
from mrlab_ros.core.base.diagnostic import Diagnostic, Fix, from_plain
from mrlab_ros.core.base.errors import BadInput, Misuse

Item = TypeVar("Item")
Answer = TypeVar("Answer")

BACKENDS = ("loky", "dask", "ray")
IDLE = 30  # s after which a process ends that nobody gives work
AHEAD = 2  # tasks that wait at each process: their bytes are in memory
EXTRAS = {"dask": "dask distributed", "ray": "ray"}

# The error of a function whose process died.
Broken = BrokenProcessPool


def run(
    function: Callable[[Item], Answer],
    tasks: Iterable[Item],
    *,
    jobs: int = 0,
    backend: str = "loky",
    scheduler: str = "",
) -> Iterator[Answer]:
    """Yield the answers as they come, in any order.

    jobs: processes, 0: one a processor. scheduler: address of a running dask or ray cluster;
    empty: one of our own on this machine. Raises Misuse for an unknown backend, BadInput where
    one is not installed or reached, Broken where a process died.
    """
    if backend not in BACKENDS:
        raise Misuse(UNKNOWN_BACKEND(backend=backend, known=BACKENDS))
    if scheduler and backend == "loky":
        raise Misuse(SCHEDULER_NEEDS_CLUSTER())
    jobs = jobs or os.cpu_count() or 1
    if jobs == 1 and backend == "loky":
        yield from map(function, tasks)
        return
    import joblib

    with contextlib.ExitStack() as stack:
        jobs = stack.enter_context(_backend(backend, jobs, scheduler))
        call = joblib.delayed(function)
        options: dict[str, Any] = {"batch_size": 1, "pre_dispatch": AHEAD * jobs}
        try:
            parallel = joblib.Parallel(return_as="generator_unordered", **options)
        except ValueError:  # a backend without generators: some at a time
            waiting = iter(tasks)
            while some := list(itertools.islice(waiting, 4 * AHEAD * jobs)):
                yield from joblib.Parallel(**options)(map(call, some))
            return
        answers = parallel(map(call, tasks))
        stack.callback(answers.close)
        yield from answers


@contextlib.contextmanager
def _backend(backend: str, jobs: int, scheduler: str) -> Iterator[int]:
    """Yield how many processors there are, while joblib uses them. Raises BadInput."""
    import joblib

    try:
        if backend == "dask":
            from distributed import Client, LocalCluster

            with contextlib.ExitStack() as stack:
                where: Any = scheduler
                if not scheduler:
                    where = stack.enter_context(
                        LocalCluster(  # type: ignore[no-untyped-call]
                            n_workers=jobs, threads_per_worker=1, dashboard_address=None
                        )
                    )
                try:
                    client = Client(where, timeout=20)  # type: ignore[no-untyped-call]
                except (OSError, TimeoutError, ValueError) as error:
                    raise BadInput(
                        SCHEDULER_NOT_REACHED(address=scheduler, why=str(error))
                    ) from None
                stack.enter_context(client)
                _check_versions(client, scheduler)
                stack.enter_context(joblib.parallel_config(backend="dask"))
                yield sum(client.nthreads().values()) or jobs
        elif backend == "ray":
            import ray
            from ray.util.joblib import register_ray

            register_ray()
            ray.init(address=scheduler or None, num_cpus=None if scheduler else jobs)
            try:
                with joblib.parallel_config(backend="ray", n_jobs=jobs):
                    yield jobs
            finally:
                ray.shutdown()
        else:
            from joblib.externals.loky import get_reusable_executor

            try:
                with joblib.parallel_config(
                    backend="loky", n_jobs=jobs, inner_max_num_threads=1, idle_worker_timeout=IDLE
                ):
                    yield jobs
            finally:
                get_reusable_executor().shutdown(wait=False, kill_workers=True)
    except ImportError as error:
        install = Fix(command=f"pip install {EXTRAS.get(backend, 'joblib')}")
        raise BadInput(
            BACKEND_NOT_INSTALLED(backend=backend, missing=str(error.name), fixes=(install,))
        ) from None


def fingerprint() -> str:
    """Return the sha256 of this package's own modules, by which a changed copy is known."""
    found = hashlib.sha256()
    for path in sorted(Path(mrlab_ros.__file__).parent.rglob("*.py")):
        found.update(path.read_bytes())
    return found.hexdigest()


def _check_versions(client: Any, address: str) -> None:
    """Raise BadInput where a worker of dask has another mrlab_ros, or none."""
    try:
        found = client.run(fingerprint)
    except (ImportError, AttributeError) as error:
        raise BadInput(WORKERS_DIFFER(address=address, why=str(error))) from None
    own = fingerprint()
    if others := sorted(worker for worker, said in found.items() if said != own):
        raise BadInput(WORKERS_DIFFER(address=address, workers=others))


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
            "mrlab_ros.classroom.worker",
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
            request = {
                "folder": str(folder), "out": str(out), "shown": task.shown, "files": names,
                "changes": dict(task.changes), "comment": task.comment, "late": task.late,
            }  # fmt: skip
            if task.evidence:
                (folder / worker.GIVEN).write_bytes(task.evidence)
            status = self._ask(request)
            if status == -signal.SIGKILL:  # from outside: once more
                status = self._ask(request)
            found = {p.name: p.read_bytes() for p in sorted(out.iterdir()) if p.is_file()}
            if status == 0 and worker.RESULT in found:
                return found
            outcome, why = self._lost(status)
            result = without_marks(self.setup.rubric, outcome, why, names[0] if names else "")
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

    def _lost(self, status: int | None) -> tuple[str, Diagnostic]:
        """Return the outcome of a check that did not come to its end, and why."""
        bounds = self.setup.bounds
        if status in (None, -signal.SIGALRM):
            return TO_REPEAT, SUBMISSION_GIVEN_UP(limit=bounds.wall)
        if status == -signal.SIGKILL:
            return TO_REPEAT, SUBMISSION_KILLED()
        if status == -signal.SIGXCPU:
            return FAILED, SUBMISSION_ENDED(limit=bounds.time)
        return FAILED, SUBMISSION_CRASHED(why=cause(status or 1))

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
                threads.loop("parent", partial(_end_with_parent, owner)).start()
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
