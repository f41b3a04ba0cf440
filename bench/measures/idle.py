"""What a lab costs that nobody uses: `mrlab up` with one robot, no page open.

The time until its pages answer, which start last; the processor time until SETTLED_S later; then,
while nothing moves, memory in proportion and processor time of each process.
"""

from __future__ import annotations

import contextlib
import os
import subprocess
import time
from collections.abc import Iterator
from typing import Any

import psutil
from partner import Failed, free_endpoint, free_port
from size import Size

from mrlab_ros.adapters.sandbox import python_process
from mrlab_ros.processes.run_file import RunFile
from mrlab_ros.processes.web import gateway_answers

NEEDS = ()
READY_S, SETTLED_S = 60.0, 2.0
SUPERVISOR = "supervisor"


@contextlib.contextmanager
def _lab() -> Iterator[tuple[psutil.Process, float]]:
    """Yield the supervisor of a lab, and after how long its pages answered, s."""
    pages, began = f"127.0.0.1:{free_port()}", time.monotonic()
    endpoints = ("--zenoh-listen", free_endpoint(), "--http", pages)
    command = python_process.command("mrlab_ros.cli", "up", "--robots", "ur5e", *endpoints)
    answers = gateway_answers(f"http://{pages}")
    with subprocess.Popen(command, stdout=subprocess.DEVNULL) as process:
        try:
            while not answers():
                if process.poll() is not None or time.monotonic() - began > READY_S:
                    raise Failed("no lab")
                time.sleep(0.02)
            yield psutil.Process(process.pid), time.monotonic() - began
        finally:
            process.terminate()


def _seconds(process: psutil.Process, *, reaped: bool = False) -> float:
    """Return the processor time of a process. reaped: with that of its children that ended."""
    times = process.cpu_times()
    own = times.user + times.system
    return float(own + times.children_user + times.children_system if reaped else own)


def rest(size: Size) -> list[dict[str, Any]]:
    with _lab() as (supervisor, ready_s):
        time.sleep(SETTLED_S)
        started = sum(
            _seconds(p, reaped=True) for p in (supervisor, *supervisor.children(recursive=True))
        )
        time.sleep(size.of(0.0, 5.0, 10.0))
        facts = RunFile(int(os.environ["ROS_DOMAIN_ID"])).read() or {}
        names = {each["pid"]: each["name"] for each in facts["processes"]}
        names[supervisor.pid] = SUPERVISOR
        found = [supervisor, *supervisor.children(recursive=True)]
        before, began = [_seconds(each) for each in found], time.monotonic()
        time.sleep(size.of(1.0, 5.0, 20.0))
        took = time.monotonic() - began
        rows = [
            {
                "process": names.get(each.pid, "zygote"),
                "PSS MB": each.memory_full_info().pss / 1e6,
                "CPU %": 100 * (_seconds(each) - then) / took,
            }
            for each, then in zip(found, before, strict=True)
        ]
    whole = {key: sum(float(row[key]) for row in rows) for key in ("PSS MB", "CPU %")}
    started_row = {"ready s": ready_s, "CPU s until 2 s later": started}
    return [{"process": "all", **whole, **started_row}, *rows]


TABLES = {"A lab at rest with one robot": rest}
