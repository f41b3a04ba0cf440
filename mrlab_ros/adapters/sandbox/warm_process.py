"""Owns a process that has imported what it needs, and forks one for each request it is sent."""

from __future__ import annotations

import contextlib
import json
import os
import signal
import socket
import subprocess
from collections.abc import Sequence
from pathlib import Path
from typing import IO

from mrlab_ros.adapters.sandbox import python_process

# Of one message over the socket, bytes.
MESSAGE_SIZE = 65_536


class WarmProcess:
    """A process of the Python module `module`, with the descriptor of a socket as an argument.

    It says something once it is ready, takes one request after another, and answers each with
    JSON whose `status` is the exit status of the process that did it. It starts with warm() or the
    first request, and again after it was lost. Not safe from several threads, but for kill().
    """

    def __init__(
        self,
        module: str,
        arguments: Sequence[str] = (),
        *,
        start_limit: float,
        folder: Path | None = None,
        errors: int | IO[bytes] | None = None,
    ) -> None:
        """arguments: behind the descriptor. start_limit: s until it is ready, on a busy machine.

        folder: in which it works; None: that of this process. errors: as Popen takes stderr.
        """
        self._module, self._arguments = module, tuple(arguments)
        self._start_limit, self._folder, self._errors = start_limit, folder, errors
        self._process: subprocess.Popen[bytes] | None = None
        self._connection: socket.socket | None = None
        self._ready = False

    @property
    def pid(self) -> int | None:
        """Its process id; None where it does not run."""
        return self._process.pid if self._process else None

    def warm(self) -> bytes:
        """Start it unless it runs; return what it said when it was ready, b"" where it runs.

        Raises RuntimeError where it does not start.
        """
        self.begin()
        if self._ready or self._connection is None:
            return b""
        self._connection.settimeout(self._start_limit)
        try:
            ready = self._connection.recv(MESSAGE_SIZE)
        except OSError:
            ready = b""
        if not ready:
            self.stop()
            raise RuntimeError(f"the process of {self._module} did not start")
        self._ready = True
        return ready

    def begin(self) -> None:
        """Start it unless it runs, and do not wait until it is ready."""
        if self._process and self._process.poll() is None and self._connection:
            return
        self.stop()
        ours, theirs = socket.socketpair(socket.AF_UNIX, socket.SOCK_SEQPACKET)
        environment = os.environ | python_process.ONE_THREAD
        environment["PYTHONPATH"] = python_process.search_path()
        self._process = subprocess.Popen(
            python_process.command(self._module, str(theirs.fileno()), *self._arguments),
            pass_fds=[theirs.fileno()], stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
            stderr=self._errors, env=environment, cwd=self._folder, start_new_session=True,
        )  # fmt: skip
        theirs.close()
        self._connection, self._ready = ours, False

    def ask(
        self, request: bytes, time_limit: float, descriptors: Sequence[int] = ()
    ) -> int | None:
        """Return the exit status of the process that did a request, None past `time_limit` s.

        One that was killed from outside has -SIGKILL. Call warm() before.
        """
        connection = self._connection
        if connection is None:
            return -signal.SIGKILL
        try:
            socket.send_fds(connection, [request], descriptors)
            connection.settimeout(time_limit)
            answer = connection.recv(MESSAGE_SIZE)
        except TimeoutError:
            self.stop()
            return None
        except OSError:
            answer = b""
        if not answer:
            self.stop()
            return -signal.SIGKILL
        return int(json.loads(answer)["status"])

    def kill(self) -> None:
        """End it and the process that works for it, from any thread; a request ends at once."""
        process = self._process
        if process is not None and process.returncode is None:
            with contextlib.suppress(ProcessLookupError):
                os.killpg(process.pid, signal.SIGKILL)

    def stop(self) -> None:
        """End it, and wait for that."""
        # Before the connection is closed: one that lives might tidy up when it notices that.
        self.kill()
        if self._process:
            self._process.wait()
        if self._connection:
            self._connection.close()
        self._process = self._connection = None
