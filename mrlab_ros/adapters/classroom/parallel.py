"""Runs one function on many tasks in other processes: on this machine, or with dask or ray."""

from __future__ import annotations

import contextlib
import itertools
import os
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures.process import BrokenProcessPool
from typing import Any, TypeVar

from mrlab_ros.adapters.classroom.diagnostics import (
    BACKEND_NOT_INSTALLED,
    SCHEDULER_NEEDS_CLUSTER,
    SCHEDULER_NOT_REACHED,
    UNKNOWN_BACKEND,
)
from mrlab_ros.core.base.diagnostic import Fix
from mrlab_ros.core.base.errors import BadInput, Misuse

Task = TypeVar("Task")
Answer = TypeVar("Answer")

BACKENDS = ("loky", "dask", "ray")
IDLE = 30  # s after which a process ends that nobody gives work
AHEAD = 2  # tasks that wait at each process: their bytes are in memory
EXTRAS = {"dask": "dask distributed", "ray": "ray"}

# What is raised where a process that runs the function died itself.
Broken = BrokenProcessPool


def run(
    function: Callable[[Task], Answer],
    tasks: Iterable[Task],
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
        stack.enter_context(_backend(backend, jobs, scheduler))
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
def _backend(backend: str, jobs: int, scheduler: str) -> Iterator[None]:
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
                stack.enter_context(joblib.parallel_config(backend="dask"))
                yield
        elif backend == "ray":
            import ray
            from ray.util.joblib import register_ray

            register_ray()
            ray.init(address=scheduler or None, num_cpus=None if scheduler else jobs)
            try:
                with joblib.parallel_config(backend="ray", n_jobs=jobs):
                    yield
            finally:
                ray.shutdown()
        else:
            from joblib.externals.loky import get_reusable_executor

            try:
                with joblib.parallel_config(
                    backend="loky", n_jobs=jobs, inner_max_num_threads=1, idle_worker_timeout=IDLE
                ):
                    yield
            finally:
                get_reusable_executor().shutdown(wait=False, kill_workers=True)
    except ImportError as error:
        install = Fix(command=f"pip install {EXTRAS.get(backend, 'joblib')}")
        raise BadInput(
            BACKEND_NOT_INSTALLED(backend=backend, missing=str(error.name), fixes=(install,))
        ) from None
