"""A bounded run of the fuzz target for MATLAB's objects; the long one is by hand."""

import signal

import pytest

pytest.importorskip("matio", reason="mat-io needs Python 3.11")

import fuzz_objects

pytestmark = pytest.mark.slow


def test_damaged_objects_are_read_or_refused_within_their_limits():
    ends = fuzz_objects.compare(150, seed=3)
    assert ends["read"] > 20
    assert ends["refused"] > 40
    # a parser that crashes ends its own process; nothing else may happen to it
    assert set(ends) <= {"read", "refused", signal.SIGSEGV.name, signal.SIGABRT.name}
    assert ends[signal.SIGSEGV.name] + ends[signal.SIGABRT.name] <= 5
