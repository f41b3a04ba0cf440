"""The stamps that travel with a message, and the percentiles of a window."""

from __future__ import annotations

import struct
import tracemalloc

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mrlab_ros.core.bridge.latency import (
    SAMPLES,
    TOPICS,
    Ledger,
    Stamps,
    attachment,
    clock_answer,
    stamps,
)

NS = st.integers(-(2**63), 2**63 - 1)


@given(NS, NS, NS, st.binary(max_size=8))
def test_an_attachment_comes_back_whatever_a_later_version_adds(
    sequence, published, bridged, more
):
    data = attachment(sequence, published, bridged)
    assert stamps(data + more) == Stamps(sequence, published, bridged)
    assert bytes(Stamps(sequence, published, bridged)) == data


def test_an_attachment_is_three_little_endian_integers():
    assert attachment(1, 2, 3) == bytes([1, *[0] * 7, 2, *[0] * 7, 3, *[0] * 7])
    assert stamps(b"") is None
    assert stamps(attachment(1, 2, 3)[:-1]) is None
    assert struct.unpack("<qq", clock_answer(5, 6)) == (5, 6)


@given(st.lists(st.integers(0, 10**10), min_size=1, max_size=SAMPLES - 1))
def test_few_delays_give_exact_percentiles(delays):
    ledger = Ledger()
    window = ledger.window("/a")
    for delay in delays:
        window.add(delay)
    everything, only = ledger.report()
    assert (everything.topic, only.topic) == ("", "/a")
    for found in (everything, only):
        levels = np.percentile(delays, [50, 95], method="inverted_cdf") / 1e9
        assert (found.p50, found.p95) == pytest.approx(tuple(levels))
        assert found.max == max(delays) / 1e9
        assert found.count == len(delays)


def test_many_delays_are_thinned_evenly_and_counted_all():
    ledger = Ledger()
    window = ledger.window("/a")
    for delay in range(100_000):
        window.add(delay)
    _, found = ledger.report()
    assert found.count == 100_000
    assert found.max == 99_999 / 1e9
    assert found.p50 == pytest.approx(50_000 / 1e9, rel=0.01)
    assert found.p95 == pytest.approx(95_000 / 1e9, rel=0.01)


def test_all_topics_weigh_each_delay_by_what_it_stands_for():
    ledger = Ledger()
    for _ in range(50 * SAMPLES):
        ledger.window("/fast").add(1_000_000)
    for _ in range(SAMPLES // 2):
        ledger.window("/slow").add(9_000_000)
    everything = ledger.report()[0]
    assert everything.p50 == everything.p95 == 0.001
    assert everything.max == 0.009


def test_a_report_begins_a_new_window_and_forgets_the_silent():
    ledger = Ledger()
    ledger.window("/a").add(1)
    ledger.window("/b").add(1)
    assert [delays.topic for delays in ledger.report()] == ["", "/a", "/b"]
    assert ledger.report() == []
    ledger.forget("/a")
    ledger.window("/b").add(1)
    assert [delays.topic for delays in ledger.report()] == ["", "/b"]


def test_a_report_names_the_slowest_topics_only():
    ledger = Ledger()
    for i in range(3 * TOPICS):
        ledger.window(f"/robot_{i}").add(1_000_000 * i)
    named = ledger.report()
    assert named[0].count == 3 * TOPICS
    assert [delays.topic for delays in named[1:3]] == [
        f"/robot_{3 * TOPICS - 1}",
        f"/robot_{3 * TOPICS - 2}",
    ]
    assert len(named) == 1 + TOPICS


def test_a_window_that_nobody_reads_stays_small():
    window = Ledger().window("/a")
    tracemalloc.start()
    for delay in range(20 * SAMPLES):
        window.add(delay)
    size, _ = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert size < 200 * SAMPLES
