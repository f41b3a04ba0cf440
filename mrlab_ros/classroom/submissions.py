"""Reads the export of a class through the sandboxed process of `unpacking`.

This process takes from it a listing and bytes within limits, and parses no archive. An archive at
which that process ends is skipped, and its student has a row that says so.
"""

from __future__ import annotations

import contextlib
import json
import os
import signal
import subprocess
from collections.abc import Mapping
from multiprocessing.connection import Connection, Pipe
from pathlib import Path
from typing import Any

from mrlab_ros.adapters.sandbox import python_process
from mrlab_ros.adapters.workspaces.content import cause
from mrlab_ros.classroom.diagnostics import NO_EXPORT, UNPACKING_ENDED, UNPACKING_NOT_STARTED
from mrlab_ros.classroom.marks.exports import Entry
from mrlab_ros.classroom.unpacking import CONTENT, LISTED, MOST_BYTES, OPENS, PROBLEM
from mrlab_ros.core.base.diagnostic import Diagnostic, from_plain, plain
from mrlab_ros.core.base.errors import BadInput

MOST_LISTED = 256 << 20  # bytes
PATIENCE = 120.0  # s for one answer, on a busy machine
MOST_SKIPPED = 100


class Export:
    """The files of an export. problems: path and why of what is not read; metadata: Gradescope's
    submission_metadata.yml, empty where there is none."""

    def __init__(self, path: Path) -> None:
        """List what is there; raise BadInput where it is neither a folder nor a zip archive."""
        if not path.exists():
            raise BadInput(NO_EXPORT(file=str(path)))
        self.path = path
        self.metadata: Mapping[str, Any] = {}
        self.entries: list[Entry] = []
        self.problems: list[tuple[str, Diagnostic]] = []
        self._skipped: dict[str, Diagnostic] = {}
        self._process: subprocess.Popen[bytes] | None = None
        self._connection: Connection | None = None
        self._begin()

    def read(self, path: str) -> bytes:
        """Return the bytes of an entry; raise BadInput where they cannot be read."""
        if self._process is None:
            self._begin()
        answer = self._asked(path.encode("utf-8", "surrogatepass"), MOST_BYTES)
        if answer is None:
            raise BadInput(UNPACKING_ENDED(file=path, why=self._ended()))
        if answer[:1] == CONTENT:
            return answer[1:]
        raise BadInput(from_plain(json.loads(answer[1:])))

    def close(self) -> None:
        if self._process is not None:
            self._ended()

    def __enter__(self) -> Export:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def _begin(self) -> None:
        """Start the process and take its listing, without what it ends at."""
        while True:
            self._start()
            at = self._listing()
            if at is None:
                return
            how = self._ended()
            if not at or len(self._skipped) == MOST_SKIPPED:
                raise BadInput(UNPACKING_ENDED(file=self.path.name, why=how))
            self._skipped[at] = UNPACKING_ENDED(file=at, why=how)

    def _start(self) -> None:
        ours, theirs = Pipe()
        environment = os.environ | python_process.ONE_THREAD
        environment["PYTHONPATH"] = python_process.search_path()
        number = str(theirs.fileno())
        command = python_process.command(
            "mrlab_ros.classroom.unpacking", number, str(self.path.absolute())
        )
        try:
            self._process = subprocess.Popen(
                command, pass_fds=[theirs.fileno()], stdin=subprocess.DEVNULL,
                stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, env=environment, cwd="/",
                start_new_session=True,
            )  # fmt: skip
        except OSError as error:
            raise BadInput(UNPACKING_NOT_STARTED(why=error.strerror)) from None
        theirs.close()
        self._connection = ours

    def _listing(self) -> str | None:
        """Take the listing; return the archive at which the process ended, empty: at none."""
        at = ""
        skipped = {name: plain(why) for name, why in self._skipped.items()}
        answer = self._asked(json.dumps(skipped).encode(), MOST_LISTED)
        while answer is not None and answer[:1] == OPENS:
            at = json.loads(answer[1:])
            answer = self._asked(b"", MOST_LISTED)
        if answer is None:
            return at
        found = json.loads(answer[1:])
        if answer[:1] == PROBLEM:
            self._ended()
            raise BadInput(from_plain(found))
        assert answer[:1] == LISTED
        self.metadata = found["metadata"]
        self.entries = [Entry(path, size, tuple(when)) for path, size, when in found["entries"]]
        self.problems = [(path, from_plain(why)) for path, why in found["problems"]]
        return None

    def _asked(self, request: bytes, most: int) -> bytes | None:
        """Return the next answer, after a request that is not empty; None: there is none."""
        assert self._connection is not None
        with contextlib.suppress(EOFError, OSError):
            if request:
                self._connection.send_bytes(request)
            if self._connection.poll(PATIENCE):
                return self._connection.recv_bytes(most + 1)
        return None

    def _ended(self) -> str:
        """End the process; return how it ended, as `cause` does."""
        process, self._process = self._process, None
        assert process is not None
        if self._connection is not None:
            self._connection.close()
        with contextlib.suppress(subprocess.TimeoutExpired):
            process.wait(1.0)
        with contextlib.suppress(ProcessLookupError):
            os.killpg(process.pid, signal.SIGKILL)
        return cause(process.wait() or 1)
