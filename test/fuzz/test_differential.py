"""A bounded run of the comparison of readers; the long one is by hand."""

import os

import differential
import pytest

pytestmark = pytest.mark.slow


def test_what_we_read_of_damaged_files_scipy_and_h5py_read_alike():
    totals = differential.compare(1500, seed=3)
    assert totals.differences == []
    assert totals.agreed > 150
    assert totals.refused > 700


def test_whole_files_agree():
    for data in differential.seeds():
        found = differential.read(data)
        assert found
        assert differential.verdict(data, found) == ""


def test_a_crash_of_the_second_reader_is_counted_and_the_next_file_judged(monkeypatch):
    def verdict(data, found):
        if data == b"crash":
            os.abort()
        return data.decode()

    monkeypatch.setattr(differential, "verdict", verdict)
    files = [(data, differential.Matrices()) for data in (b"one", b"crash", b"two", b"")]
    assert list(differential.verdicts(files)) == ["one", None, "two", ""]
