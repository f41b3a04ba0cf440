"""A call in the sandbox: it answers with JSON, and reaches nothing that it was not given."""

from __future__ import annotations

import linecache
import operator
import os
import posix
import socket
import time
from pathlib import Path

import pytest
from refusals import refused

from mrlab_ros.adapters.diagnostics import READER_FAILED, READER_MEMORY, READER_SLOW
from mrlab_ros.adapters.sandbox import calls
from mrlab_ros.core.base.errors import BadInput


def test_a_call_answers(tmp_path: Path) -> None:
    (tmp_path / "given").write_text("words\n")
    read = calls.call(linecache.getlines, str(tmp_path / "given"), name="it", read=[tmp_path])
    assert read == ["words\n"]


def test_it_reads_nothing_else(tmp_path: Path) -> None:
    (tmp_path / "kept").write_text("secret\n")
    given = tmp_path / "folder"
    given.mkdir()
    (given / "link").symlink_to(tmp_path / "kept")
    for path in (tmp_path / "kept", given / "link", Path("/etc/passwd"), Path("/proc/1/environ")):
        assert calls.call(linecache.getlines, str(path), name="it", read=[given]) == []


def test_it_gets_no_secret_of_the_environment(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("CLOUD_SECRET_KEY", "secret")
    assert calls.call(os.getenv, "CLOUD_SECRET_KEY", name="it") is None


def test_it_starts_writes_and_signals_nothing(tmp_path: Path) -> None:
    assert calls.call(posix.system, f"touch {tmp_path}/made", name="it", read=[tmp_path]) != 0
    for function, arguments in (
        (posix.mkdir, (str(tmp_path / "made"),)),
        (posix.kill, (os.getpid(), 0)),
        (socket.getaddrinfo, ("localhost", 80)),
        (socket.create_connection, (["127.0.0.1", 9],)),
        (posix.chmod, (str(tmp_path), 0o777)),
        (posix.symlink, ("/etc/passwd", str(tmp_path / "made"))),
        (posix.setsid, ()),
    ):
        with refused(READER_FAILED, BadInput, file="it"):
            calls.call(function, *arguments, name="it", read=[tmp_path])
    assert list(tmp_path.iterdir()) == []


def test_it_ends_in_time_and_in_bounds() -> None:
    began = time.monotonic()
    with refused(READER_SLOW, BadInput, file="it", limit=1):
        calls.call(time.sleep, 600, name="it", seconds=1)
    with refused(READER_MEMORY, BadInput, file="it", limit=2 << 30):
        calls.call(operator.mul, "x", 1 << 33, name="it", seconds=1)
    assert time.monotonic() - began < 100, "a deadline, not a figure"
