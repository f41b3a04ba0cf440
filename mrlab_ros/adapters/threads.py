"""Every thread of the lab starts here, so that none ends in silence.

An error that a thread does not handle is named in the log of its process: each cause at once, with
its traceback, and then once a minute. A loop is entered again. One that fails MOST_FAILURES times
in a row ends its process, where the process is one that is started again.
"""

from __future__ import annotations

import os
import sys
import threading
import time
import traceback
from collections.abc import Callable
from concurrent.futures import Future, ThreadPoolExecutor
from typing import Any

from mrlab_ros.core.base.errors import LabError
from mrlab_ros.core.base.machine import lacking
from mrlab_ros.core.runtime.bucket import Occurrences
from mrlab_ros.core.runtime.diagnostics import THREAD_ENDS, THREAD_FAILED

# Pause before a loop is entered again, s; it doubles with each failure in a row.
PAUSE_S, LONGEST_PAUSE_S = 0.05, 1.0
# A loop that ran for so long has not failed in a row, s.
STABLE_S = 10.0
MOST_FAILURES = 20
# EX_SOFTWARE of sysexits.h: an error of the program itself.
FAULT = 70

_named = Occurrences()
_naming = threading.Lock()


def _go_on() -> None:
    """Keep a process that nobody starts again, such as a command's."""


_end_process: Callable[[], None] = _go_on


def end_process_where_a_thread_fails() -> None:
    """Say that this process is started again: its end mends what a thread cannot."""
    global _end_process
    _end_process = _exit


def _exit() -> None:
    os._exit(FAULT)


def name_error(thread: str, error: Exception) -> None:
    """Name an error in the log, unless the same was named within the last minute."""
    frames = traceback.extract_tb(error.__traceback__)[-1:]
    places = [f"{frame.filename}:{frame.lineno}" for frame in frames]
    with _naming:
        count = _named.again((thread, type(error).__name__, *places), time.monotonic())
        first = count == 1
    if count is None:
        return
    known = error.diagnostic if isinstance(error, LabError) else lacking(error)
    why = known or repr(error)
    _write(thread, str(THREAD_FAILED(thread=thread, error=why, again=None if first else count)))
    if first and known is None:
        traceback.print_exception(error)


def _write(thread: str, text: str) -> None:
    # As rclpy writes its own lines; the supervisor puts the process's name before it.
    print(f"[ERROR] [{thread}]: {text}", file=sys.stderr, flush=True)


def _always() -> bool:
    return True


def loop(
    name: str, run: Callable[[], object], wanted: Callable[[], bool] = _always
) -> threading.Thread:
    """Return a thread, not yet started, that calls `run` until it returns.

    wanted: returns whether the loop is still to run; where it is not, an error ends the thread
    unnamed: what the loop used is gone.
    """

    def keep() -> None:
        failures, pause = 0, PAUSE_S
        while True:
            began = time.monotonic()
            try:
                run()
                return
            except Exception as error:
                if not wanted():
                    return
                name_error(name, error)
            if time.monotonic() - began > STABLE_S:
                failures, pause = 0, PAUSE_S
            failures += 1
            if failures == MOST_FAILURES:
                _write(name, str(THREAD_ENDS(thread=name, failures=failures)))
                _end_process()
                failures = 0
            time.sleep(pause)
            pause = min(2 * pause, LONGEST_PAUSE_S)

    return threading.Thread(target=keep, name=name, daemon=True)


def task(name: str, work: Callable[[], object]) -> threading.Thread:
    """Return a thread, not yet started, that calls `work` once."""
    return threading.Thread(target=guarded(name, work), name=name, daemon=True)


def guarded(name: str, work: Callable[..., object]) -> Callable[..., None]:
    """Return what does `work` and names its error, for a result that nobody reads."""

    def run(*arguments: object) -> None:
        try:
            work(*arguments)
        except Exception as error:
            name_error(name, error)

    return run


class Pool(ThreadPoolExecutor):
    """A pool of threads for work whose result nobody reads: its errors are named."""

    def __init__(self, name: str, threads: int) -> None:
        super().__init__(threads, thread_name_prefix=name)
        self._name = name

    def send(self, work: Callable[..., object], *arguments: object) -> Future[Any]:
        """Do `work` in one of the threads; the future ends without an error."""
        return self.submit(guarded(self._name, work), *arguments)
