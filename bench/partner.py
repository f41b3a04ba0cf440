"""Work in processes of its own: a function and a pipe, or a program that ends with its user."""

from __future__ import annotations

import multiprocessing
import os
import signal
import socket
import sys
import time
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager, suppress
from multiprocessing.connection import Connection
from typing import Any, TypeVar

import psutil

Value = TypeVar("Value")
# For an answer of a partner that was told nothing else, s.
ANSWER_S = 120.0
# For a case in a process of its own, s.
CASE_S = 3600.0
HOST = (sys.executable, "-m", "mrlab_ros.processes.host")


class Failed(Exception):
    """What was to be measured did not happen."""


class LeftOut(Exception):
    """What cannot be measured on this machine, and why."""


class Partner:
    """A function in a process of its own; it gets its end of a pipe, then the arguments."""

    def __init__(
        self,
        function: Callable[..., None],
        *arguments: Any,
        env: Mapping[str, str] | None = None,
    ) -> None:
        spawn = multiprocessing.get_context("spawn")
        self._pipe, theirs = spawn.Pipe()
        self._name = function.__name__
        self._process = spawn.Process(
            target=_run, args=(theirs, dict(env or {}), function, arguments)
        )
        self._process.start()
        theirs.close()
        self.pid = self._process.pid or 0

    def send(self, value: Any = None) -> None:
        self._pipe.send(value)

    def receive(self, seconds: float = ANSWER_S) -> Any:
        """Return what the function sends next; raise Failed where nothing comes."""
        if not self._pipe.poll(seconds):
            raise Failed(f"nothing came from {self._name} within {seconds:g} s")
        try:
            return self._pipe.recv()
        except EOFError:
            raise Failed(f"the process of {self._name} has ended") from None

    def ask(self, value: Any = None) -> Any:
        self.send(value)
        return self.receive()

    def __enter__(self) -> Partner:
        return self

    def __exit__(self, *_: object) -> None:
        self._process.kill()
        self._process.join()
        self._pipe.close()


def _run(
    pipe: Connection, env: dict[str, str], function: Callable[..., None], arguments: Any
) -> None:
    os.environ |= env
    function(pipe, *arguments)
    pipe.close()
    # Threads of nodes and engines are not waited for.
    sys.stdout.flush()
    os._exit(0)


def in_process(function: Callable[..., Value], *arguments: Any) -> Value:
    """Run a function in a process of its own and return what it returns."""
    with Partner(_case, function, arguments) as partner:
        found: Value = partner.receive(CASE_S)
        return found


def _case(pipe: Connection, function: Callable[..., Any], arguments: tuple[Any, ...]) -> None:
    pipe.send(function(*arguments))


@contextmanager
def program(*command: object, patience: float = 10.0, **options: Any) -> Iterator[psutil.Popen]:
    """Run a program; end it with SIGINT, and kill it where that takes longer than `patience` s."""
    process = psutil.Popen([str(word) for word in command], **options)
    try:
        yield process
    finally:
        with suppress(psutil.Error):
            process.send_signal(signal.SIGINT)
            process.wait(patience)
        with suppress(psutil.Error):
            process.kill()
            process.wait()


def cpu_s(process: psutil.Process | psutil.Popen | int) -> float:
    """Return the processor time that a process has used so far, s."""
    found = psutil.Process(process) if isinstance(process, int) else process
    return float(sum(found.cpu_times()[:2]))


def until(condition: Callable[[], Value], what: str, seconds: float = 60.0) -> Value:
    """Return the first true value of a condition; raise Failed where none comes in time."""
    end = time.monotonic() + seconds
    while not (found := condition()):
        if time.monotonic() > end:
            raise Failed(f"waited {seconds:g} s in vain for {what}")
        time.sleep(0.002)
    return found


def free_port() -> int:
    """Return a TCP port of the loopback on which nobody listens now."""
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return int(probe.getsockname()[1])


def free_endpoint() -> str:
    """Return an endpoint of zenoh on which nobody listens now."""
    return f"tcp/127.0.0.1:{free_port()}"


def await_listener(endpoint: str) -> None:
    """Wait until somebody listens on an endpoint of zenoh."""
    host, port = endpoint.removeprefix("tcp/").split(":")

    def listens() -> bool:
        with socket.socket() as probe:
            return probe.connect_ex((host, int(port))) == 0

    until(listens, f"a listener on {endpoint}")
