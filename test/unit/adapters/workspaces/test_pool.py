"""The pool of converting processes: order, slow files, bounds and the end."""

from __future__ import annotations

import threading

from graph import wait_for
from refusals import refused

from mrlab_ros.adapters.workspaces import reader as pools
from mrlab_ros.adapters.workspaces.diagnostics import TOO_SLOW, WAITING_FILES
from mrlab_ros.adapters.workspaces.reader import ConversionPool, Limits, TooSlow
from mrlab_ros.core.base.errors import Misuse

LONG = 60.0  # s; far above what any of this takes


def too_slow(reader):
    raise TooSlow(TOO_SLOW(file="x.mat", limit=reader.limits.time))


def test_a_slow_file_is_begun_again_with_the_whole_time():
    times = []

    def work(reader):
        times.append(reader.limits.time)
        return too_slow(reader) if len(times) == 1 else "done"

    with ConversionPool(Limits(time=20.0), 2) as pool:
        assert pool.submit(work, 0).result(LONG) == "done"
    assert times == [pools.QUICK_TIME_S, 20.0]


def test_a_process_starts_with_the_first_file_serves_the_next_and_rests():
    def pid(reader):
        reader._worker.warm()
        return reader._worker.pid

    with ConversionPool(Limits(), 2, keep=1.0) as pool:
        assert not any(reader.runs for reader in pool._readers)
        first = pool.submit(pid, 0).result(LONG)
        wait_for(lambda: pool._warm[True], "the thread of the first")
        assert pool.submit(pid, 0).result(LONG) == first
        wait_for(lambda: not any(reader.runs for reader in pool._readers), "its rest")
        assert pool.submit(pid, 0).result(LONG) != first


def test_a_file_that_stays_too_slow_is_answered():
    with ConversionPool(Limits(time=20.0), 2) as pool, refused(TOO_SLOW, TooSlow, limit=20.0):
        pool.submit(too_slow, 0).result(LONG)


def test_stuck_files_do_not_hold_up_quick_ones():
    go_on = threading.Event()

    def stuck(reader):
        if reader.limits.time == pools.QUICK_TIME_S:
            too_slow(reader)
        assert go_on.wait(LONG)

    with ConversionPool(Limits(time=20.0), 2) as pool:
        held = [pool.submit(stuck, 0) for _ in range(5)]
        quick = [pool.submit(lambda _, i=i: i, 0) for i in range(20)]
        assert [f.result(LONG) for f in quick] == list(range(20))
        assert not any(f.done() for f in held)
        go_on.set()
        for future in held:
            future.result(LONG)


def test_smaller_files_pass_a_large_one():
    go_on, order = threading.Event(), []
    with ConversionPool(Limits(), 1) as pool:
        first = pool.submit(lambda _: go_on.wait(LONG), 0)
        rest = [
            pool.submit(lambda _, size=size: order.append(size), size)
            for size in (60 << 20, 1 << 20, 30 << 20)
        ]
        go_on.set()
        for future in [first, *rest]:
            future.result(LONG)
    assert order == [1 << 20, 30 << 20, 60 << 20]


def test_too_much_that_waits_is_refused_and_counted_out_again(monkeypatch):
    monkeypatch.setattr(pools, "MOST_BYTES", 100)
    go_on = threading.Event()
    with ConversionPool(Limits(), 1) as pool:
        first = pool.submit(lambda _: go_on.wait(LONG), 60, 60)
        with refused(WAITING_FILES, Misuse):
            pool.submit(lambda _: None, 60, 60)
        go_on.set()
        first.result(LONG)
        pool.submit(lambda _: None, 60, 60).result(LONG)


def test_what_waits_at_the_end_is_cancelled():
    go_on, begun = threading.Event(), threading.Event()

    def work(reader):
        begun.set()
        go_on.wait(LONG)

    pool = ConversionPool(Limits(), 1)
    running = pool.submit(work, 0)
    assert begun.wait(LONG)
    waiting = pool.submit(lambda _: None, 0)
    closing = threading.Thread(target=pool.close)
    closing.start()
    go_on.set()
    closing.join(LONG)
    assert running.done()
    assert waiting.cancelled()
