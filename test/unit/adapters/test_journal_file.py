"""A journal in a file: it survives a kill, a full disk and damage."""

from __future__ import annotations

import errno
import os
import signal
import subprocess
import sys

import pytest

from mrlab_ros.adapters.journal_file import Journal
from mrlab_ros.core.runtime import journal_format as form


@pytest.fixture
def said():
    return []


def make(tmp_path, said) -> Journal:
    return Journal(tmp_path / "state" / "a.journal", said.append)


def test_the_last_content_is_read_again(tmp_path, said):
    first = make(tmp_path, said)
    assert first.load() == {}
    for i in range(5):
        assert first.save({"i": i})
    assert make(tmp_path, said).load() == {"i": 4}
    second = make(tmp_path, said)
    assert second.load() == {"i": 4}
    second.save({"i": 5})
    assert make(tmp_path, said).load() == {"i": 5}
    assert said == []


def test_a_larger_content_gets_a_larger_file(tmp_path, said):
    journal = make(tmp_path, said)
    journal.save({"a": "x"})
    journal.save({"a": "x" * 20_000})
    assert make(tmp_path, said).load() == {"a": "x" * 20_000}
    journal.save({"a": "y"})
    assert make(tmp_path, said).load() == {"a": "y"}


def test_without_a_folder_nothing_is_kept(said):
    journal = Journal.of("", "a", said.append)
    assert journal.save({"a": 1})
    assert journal.load() == {}


def test_a_damaged_file_is_set_aside(tmp_path, said):
    path = tmp_path / "state" / "a.journal"
    path.parent.mkdir()
    path.write_bytes(b"nonsense")
    journal = make(tmp_path, said)
    assert journal.load() == {}
    assert "is damaged" in said[0]
    assert journal.save({"a": 1})
    assert make(tmp_path, said).load() == {"a": 1}


def test_a_write_into_the_file_needs_no_space(tmp_path, said, monkeypatch):
    journal = make(tmp_path, said)
    journal.save({"a": 1})

    def full(*arguments):
        raise OSError(errno.ENOSPC, "No space left on device")

    monkeypatch.setattr(os, "posix_fallocate", full)
    assert journal.save({"a": 2})
    assert make(tmp_path, said).load() == {"a": 2}
    assert not journal.save({"a": "x" * form.SMALLEST})
    assert not journal.save({"a": "y" * form.SMALLEST})
    (sentence,) = said
    assert "disk is full" in sentence
    assert make(tmp_path, said).load() == {"a": 2}
    assert journal.save({"a": 3})
    assert make(tmp_path, said).load() == {"a": 3}


WRITER = """
import sys
from pathlib import Path
from mrlab_ros.adapters.journal_file import Journal
journal = Journal(Path(sys.argv[1]), print)
i = 0
while True:
    i += 1
    journal.save({"i": i, "all": [i] * 200})
    if i == 50:
        print("runs", flush=True)
"""


def test_a_writer_that_is_killed_leaves_a_whole_content(tmp_path, said):
    path = tmp_path / "state" / "a.journal"
    for _ in range(3):
        process = subprocess.Popen(
            [sys.executable, "-c", WRITER, str(path)], stdout=subprocess.PIPE
        )
        assert process.stdout is not None
        assert process.stdout.readline() == b"runs\n"
        process.send_signal(signal.SIGKILL)
        process.communicate()
        content = make(tmp_path, said).load()
        assert content["i"] >= 50
        assert content["all"] == [content["i"]] * 200
    assert said == []
