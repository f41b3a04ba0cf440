from __future__ import annotations

import pytest

from mrlab_ros.core.runtime.bucket import BURST, KINDS, PERIOD_S, Bucket, RepeatedLines

pytestmark = pytest.mark.fast


def test_a_bucket_gives_its_burst_then_its_rate() -> None:
    bucket = Bucket(rate=2.0, burst=3.0)
    assert [bucket.take(1, 10.0) for _ in range(4)] == [True, True, True, False]
    assert bucket.take(1, 10.5)
    assert not bucket.take(1, 10.5)
    assert bucket.take(3, 100.0)
    assert not bucket.take(1, 100.0)


def refused(port):
    return f"WARN zenoh_link_tls::unicast: peer 10.0.0.7:{port} sent no certificates"


def test_a_flood_of_one_kind_is_thinned_out_and_counted():
    lines = RepeatedLines()
    shown = [lines.passed(refused(i), 0.0) for i in range(1000)]
    assert sum(line is not None for line in shown) == BURST
    later = lines.passed(refused(7), PERIOD_S)
    assert later == f"{refused(7)} ({1000 - BURST} lines like this one were left out)"
    assert lines.passed(refused(8), 2 * PERIOD_S) == refused(8)


def test_lines_of_another_kind_pass():
    lines = RepeatedLines()
    for i in range(100):
        lines.passed(refused(i), 0.0)
    assert lines.passed("WARN zenoh_link_tls: CertificateExpired", 0.0)


def test_kinds_do_not_fill_the_memory():
    lines = RepeatedLines()
    for i in range(10 * KINDS):
        lines.passed(f"zenoh {'x' * i}", 0.0)
    assert len(lines._kinds) == KINDS
