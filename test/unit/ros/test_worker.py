"""The worker thread: order, results, bounds, an end."""

from __future__ import annotations

import threading
from concurrent.futures import CancelledError

import pytest
from graph import wait_for

from mrlab_ros.core.base.errors import Misuse
from mrlab_ros.ros.worker import Worker


@pytest.fixture
def held():
    """Hold up a worker until the event is set: `hold(worker)` returns once it is busy."""
    free = threading.Event()

    def hold(worker: Worker) -> None:
        busy = threading.Event()
        worker.send(lambda: (busy.set(), free.wait(20)), 1)
        wait_for(busy.is_set, "the worker to be busy")

    hold.free = free
    yield hold
    free.set()


def test_work_runs_in_order_in_one_thread_and_returns_its_result():
    worker, seen = Worker("test"), []
    for i in range(100):
        worker.later(lambda i=i: seen.append((i, threading.current_thread().name)))
    assert worker.do(lambda: 42) == 42
    assert seen == [(i, "test") for i in range(100)]

    def refuse():
        raise Misuse("not now")

    with pytest.raises(Misuse, match="not now"):
        worker.do(refuse)
    assert worker.do(lambda: "still there") == "still there"
    worker.close()


def test_idle_runs_while_no_work_comes():
    looked = threading.Event()
    worker = Worker("test", looked.set, lambda: 0.001)
    assert looked.wait(10)
    assert worker.do(lambda: 1) == 1
    worker.close()


def test_idle_never_runs_where_nothing_is_due():
    looked = []
    worker = Worker("test", lambda: looked.append(1), lambda: None)
    assert worker.do(lambda: looked) == []
    worker.close()
    assert looked == []


def test_close_runs_what_waits():
    worker, seen = Worker("test"), []
    for i in range(20):
        worker.send(lambda i=i: seen.append(i))
    worker.close()
    assert seen == list(range(20))


def test_close_drops_what_takes_too_long_and_cancels_its_results(held):
    worker, seen = Worker("test"), []
    held(worker)
    late = worker.later(lambda: seen.append(1))
    closing = threading.Thread(target=worker.close, args=(0.01,))
    closing.start()
    wait_for(late.done, "the late work to be cancelled")
    held.free.set()
    closing.join(10)
    assert not closing.is_alive()
    assert seen == []
    with pytest.raises(CancelledError):
        late.result()
    with pytest.raises(CancelledError):
        worker.do(lambda: 1)


def test_the_oldest_is_dropped_where_more_waits_than_there_is_room_for(held):
    drops, seen = [], []
    worker = Worker("test", capacity=1000, on_drop=lambda: drops.append(1))
    held(worker)
    for i in range(50):
        worker.send(lambda i=i: seen.append(i), 100)
    held.free.set()
    worker.close()
    assert seen == list(range(40, 50))
    assert len(drops) == 40


def test_work_larger_than_the_room_is_done_all_the_same(held):
    seen = []
    worker = Worker("test", capacity=10)
    held(worker)
    worker.send(lambda: seen.append("small"), 1)
    worker.send(lambda: seen.append("large"), 100)
    held.free.set()
    worker.close()
    assert seen == ["large"]


def test_what_sent_work_raises_is_reported_and_the_next_runs():
    errors, seen = [], []
    worker = Worker("test", on_error=errors.append)

    def fails():
        raise RuntimeError("gone")

    worker.send(fails)
    worker.send(lambda: seen.append(1))
    worker.close()
    assert [str(error) for error in errors] == ["gone"]
    assert seen == [1]
