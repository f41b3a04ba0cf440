"""No thread of the lab ends in silence: each starts by one guard, which names its error."""

from __future__ import annotations

import ast
import threading
from pathlib import Path

import pytest
from graph import wait_for

import mrlab_ros
from mrlab_ros.adapters import threads
from mrlab_ros.core.base.errors import Misuse
from mrlab_ros.core.runtime.bucket import Occurrences
from mrlab_ros.core.runtime.diagnostics import THREAD_FAILED

PACKAGE = Path(mrlab_ros.__file__).parent
# Its results are read where it is used, so that each error has a caller.
WITH_A_CALLER = {"adapters/trajectories/catalogue.py"}
# By file the ways in which its threads start: the list of all threads of the lab.
THREADS = {
    "adapters/parent_exit.py": ["loop"],
    "adapters/workspaces/reader.py": ["loop"],
    "adapters/zenoh/session.py": ["Pool"],
    "app/recorder/stops.py": ["Pool"],
    "classroom/grader.py": ["loop"],
    "commands/demo/lab.py": ["task"],
    "commands/up/lab_run.py": ["loop"],
    "nodes/bridge/assets.py": ["Pool"],
    "nodes/bridge/inward.py": ["Worker"],
    "nodes/bridge/outward.py": ["Worker"],
    "nodes/converter/catalogue.py": ["Worker", "loop"],
    "nodes/converter/node.py": ["Pool"],
    "nodes/coordinator/node.py": ["Worker"],
    "nodes/frames/markers.py": ["Worker"],
    "nodes/lab/restore.py": ["task"],
    "nodes/playback/direct.py": ["Worker"],
    "nodes/playback/node.py": ["Worker"],
    "nodes/recorder/attachments.py": ["Worker"],
    "nodes/recorder/replaying.py": ["Pool", "task"],
    "processes/child_process.py": ["loop", "task"],
    "ros/arrivals.py": ["loop"],
    "ros/deadlines.py": ["loop"],
    "ros/graph_changes.py": ["loop"],
    "ros/graph_node.py": ["loop"],
    "ros/raw_streams.py": ["loop"],
    "ros/spinning.py": ["loop"],
    "ros/worker.py": ["loop"],
}
SITES = sorted({(path, kind) for path, kinds in THREADS.items() for kind in kinds})


def calls(path: Path) -> list[str]:
    """Return the names of all that a file calls, such as `threads.loop`."""
    tree = ast.parse(path.read_text(encoding="utf-8"))
    return [ast.unparse(node.func) for node in ast.walk(tree) if isinstance(node, ast.Call)]


def test_every_thread_is_in_the_list_and_starts_by_the_guard() -> None:
    guarded: dict[str, list[str]] = {}
    bare = set()
    for path in PACKAGE.rglob("*.py"):
        name = path.relative_to(PACKAGE).as_posix()
        for call in calls(path):
            if call in ("threads.loop", "threads.task", "threads.Pool", "Worker"):
                guarded.setdefault(name, []).append(call.removeprefix("threads."))
            elif call.split(".")[-1] in ("Thread", "Timer", "ThreadPoolExecutor"):
                bare.add(name)
    assert {name: sorted(set(kinds)) for name, kinds in guarded.items()} == THREADS
    assert bare == {"adapters/threads.py", *WITH_A_CALLER}


@pytest.fixture
def named(monkeypatch: pytest.MonkeyPatch) -> list[tuple[str, str]]:
    """Return the list of threads and texts as they are named."""
    found: list[tuple[str, str]] = []
    monkeypatch.setattr(threads, "_named", Occurrences())
    monkeypatch.setattr(threads, "_write", lambda thread, text: found.append((thread, text)))
    monkeypatch.setattr(threads, "PAUSE_S", 0.001)
    return found


@pytest.mark.parametrize(("path", "kind"), SITES)
def test_an_error_in_a_thread_is_named_once_and_its_service_goes_on(
    path: str, kind: str, named: list[tuple[str, str]]
) -> None:
    done = threading.Event()
    left = [Misuse(THREAD_FAILED(thread="x", error="y"))] * 3

    def work() -> None:
        if left:
            raise left.pop()
        done.set()

    if kind == "loop":
        threads.loop(path, work).start()
        wait_for(done.is_set, "the loop to go on after its errors")
    elif kind == "task":
        task = threads.task(path, work)
        task.start()
        task.join(10)
    elif kind == "Pool":
        pool = threads.Pool(path, 1)
        for _ in range(4):
            pool.send(work)
        pool.shutdown()
        assert done.is_set()
    else:
        from mrlab_ros.ros.worker import Worker

        worker = Worker(path, work, lambda: 0.001)
        worker.send(work)
        wait_for(done.is_set, "the worker to go on after its errors")
        worker.close()
    assert [thread for thread, _ in named] == [path]


def test_a_loop_that_is_not_wanted_any_more_ends_unnamed(named: list[tuple[str, str]]) -> None:
    def fail() -> None:
        raise RuntimeError("the context is shut down")

    loop = threads.loop("late", fail, lambda: False)
    loop.start()
    loop.join(10)
    assert not loop.is_alive()
    assert named == []


def test_a_loop_that_fails_again_and_again_ends_its_process(
    named: list[tuple[str, str]], monkeypatch: pytest.MonkeyPatch
) -> None:
    ended = threading.Event()
    monkeypatch.setattr(threads, "LONGEST_PAUSE_S", 0.001)
    monkeypatch.setattr(threads, "_end_process", ended.set)

    def fail() -> None:
        raise RuntimeError("no descriptors")

    threads.loop("broken", fail, lambda: not ended.is_set()).start()
    assert ended.wait(10)
    assert [thread for thread, _ in named] == ["broken", "broken"]
    assert str(threads.MOST_FAILURES) in named[-1][1]


def test_a_cause_is_due_at_once_and_then_once_a_minute() -> None:
    occurrences = Occurrences()
    said = [occurrences.again(("a",), t) for t in (0.0, 1.0, 59.0, 60.0, 61.0)]
    assert said == [1, None, None, 3, None]
    assert occurrences.again(("b",), 61.0) == 1
    assert occurrences.lately(100.0) == {("a",): 5, ("b",): 1}
    assert occurrences.lately(130.0) == {}
