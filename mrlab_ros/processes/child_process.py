"""One process that is kept running: its start, its output, its restarts with back-off.

Should the supervisor be killed, the kernel kills its children: each is started through a few
lines of Python that ask for that (PR_SET_PDEATHSIG) and then become the real program. A hook
between fork and exec would do the same, but is unsafe beside threads. Processes of ours are forked
by a zygote (`zygote.py`) where there is one.
"""

from __future__ import annotations

import contextlib
import os
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import partial
from typing import IO

from mrlab_ros.adapters import threads
from mrlab_ros.core.base.clock import SECOND
from mrlab_ros.core.runtime.bucket import RepeatedLines
from mrlab_ros.core.runtime.process_states import Phase, ProcessState
from mrlab_ros.processes.zygote import Forked, Zygote

FIRST_DELAY_S = 0.1
LONGEST_DELAY_S = 10.0
STABLE_AFTER_S = 10.0
# The last lines of an ended process are read in this time, s.
READ_TIMEOUT_S = 1.0
# The name of the supervisor's own lines.
SELF = "mrlab"
# The mark of zenoh's own lines.
ZENOH = "zenoh"

# Runs as: python -I -S -c GUARDED <pid of the supervisor> <1: unblock SIGINT> program argument...
# It starts with SIGINT blocked: a stop at this moment must not print a traceback. The death signal
# is tied to the thread that forked: Child's own thread, which lives as long.
GUARDED = """
import ctypes, os, signal, sys
ctypes.CDLL(None).prctl(1, signal.SIGKILL)
signal.signal(signal.SIGINT, signal.SIG_DFL)
if sys.argv[2] == "1":
    signal.pthread_sigmask(signal.SIG_UNBLOCK, {signal.SIGINT})
if os.getppid() == int(sys.argv[1]):
    os.execvp(sys.argv[3], sys.argv[3:])
"""


def guarded(argv: tuple[str, ...], *, unblock_sigint: bool = True) -> tuple[str, ...]:
    """Return the command that runs `argv` until its end or that of the thread that starts it."""
    unblock = "1" if unblock_sigint else "0"
    return (sys.executable, "-I", "-S", "-c", GUARDED, str(os.getpid()), unblock, *argv)


@dataclass(frozen=True)
class ProcessSpec:
    """A process to keep: a short name, its command, and what it adds to the environment.

    nodes: the names of its nodes in the graph.
    unblocks_sigint: the program is started with SIGINT blocked and unblocks it once it has decided
    what SIGINT does. Python would otherwise answer a SIGINT during its start with a traceback.
    module: the module that argv runs, where a zygote may fork the process instead; it imports
    `imports` first.
    """

    name: str
    argv: tuple[str, ...]
    env: Mapping[str, str] = field(default_factory=dict)
    unblocks_sigint: bool = False
    nodes: tuple[str, ...] = ()
    module: str = ""
    imports: tuple[str, ...] = ()


# The environment variable with the number of restarts of a process so far.
RESTARTS = "MRLAB_RESTARTS"
# That with how it ended the last time; empty before the first end.
LAST_EXIT = "MRLAB_LAST_EXIT"
# EX_CONFIG of sysexits.h: the configuration is wrong, so a restart would end the same way.
WRONG_CONFIGURATION = 78


class RestartPolicy:
    """Decides how long to wait before a process that ended is started again.

    Delays double from `first` to `longest` (s); a process that ran for `stable` (s) resets them.
    """

    def __init__(
        self,
        first: float = FIRST_DELAY_S,
        longest: float = LONGEST_DELAY_S,
        stable: float = STABLE_AFTER_S,
    ) -> None:
        self._first, self._longest, self._stable = first, longest, stable
        self._next = first
        self._started = 0.0

    def started(self, now: float) -> None:
        """Note that the process was started at `now` (s)."""
        self._started = now

    def ended(self, now: float) -> float:
        """Return the delay, s, after which a process that ended at `now` (s) starts again."""
        if now - self._started >= self._stable:
            self._next = self._first
        delay = self._next
        self._next = min(2 * delay, self._longest)
        return delay


# The phases of a process that ended by itself.
ENDED = (Phase.WAITING, Phase.REFUSED)


def describe_exit(code: int) -> str:
    """Describe how a process ended; negative codes are signals."""
    if code == WRONG_CONFIGURATION:
        return "wrong configuration"
    return f"exit code {code}" if code >= 0 else exit_name(code)


def exit_name(code: int) -> str:
    """Return the name of the signal that ended a process, or its exit code, for programs."""
    if code >= 0:
        return str(code)
    try:
        return signal.Signals(-code).name
    except ValueError:
        return f"signal {-code}"


def _why_not(error: OSError) -> str:
    if isinstance(error, FileNotFoundError):
        return (
            f"there is no {error.filename}; if the lab's folder was moved, stop this lab and set "
            "it up where it is now: make demo"
        )
    return str(error)


Emit = Callable[[str, str], None]


class Child:
    """One process, kept by a thread of its own; its output goes line by line to `emit`."""

    def __init__(
        self,
        spec: ProcessSpec,
        policy: RestartPolicy,
        emit: Emit,
        changed: Callable[[], None],
        zygote: Zygote | None = None,
    ) -> None:
        self.spec = spec
        self._zygote = zygote
        self._policy = policy
        # A full disk, say, must not end the thread: the process would end with it.
        self._emit = threads.guarded(spec.name, emit)
        self._changed = threads.guarded(spec.name, changed)
        self._phase, self._since = Phase.STARTING, time.time()
        self._restarts, self._last_exit = 0, ""
        self._last_code: int | None = None
        # When it ended or froze last: s of wall time, ns of the monotonic clock.
        self._down, self._down_steady_ns = 0.0, 0
        # From its last end to the next start, s.
        self._delay = 0.0
        self._process: subprocess.Popen[bytes] | Forked | None = None
        # Guards _process: while it is set, its process group exists and belongs to this child.
        self._lock = threading.Lock()
        self._stop = threading.Event()
        # Set while there is no process: end the wait for the next start.
        self._start_now = threading.Event()
        self._thread = threads.loop(spec.name, self._keep)

    @property
    def state(self) -> ProcessState:
        process = self._process
        return ProcessState(
            self.spec.name,
            self._phase.value,
            process.pid if process and self._phase not in ENDED else None,
            self._restarts,
            self._since,
            self._last_exit,
            self._last_code or 0,
            self.spec.nodes,
            self._down,
            self._down_steady_ns,
            self._delay if self._phase is Phase.WAITING else 0.0,
        )

    def start(self) -> None:
        self._thread.start()

    def stop(self, number: signal.Signals) -> None:
        """Send the whole process group a signal and do not start the process again."""
        self._stop.set()
        with self._lock:
            self._start_now.set()
            if self._process is not None:
                _signal_group(self._process.pid, number)

    def restart(self) -> None:
        """End the process, which then starts again; start it at once where it does not run."""
        with self._lock:
            if self._process is None or self._phase in ENDED:
                self._start_now.set()
            else:
                _signal_group(self._process.pid, signal.SIGINT)

    def join(self, timeout: float) -> bool:
        """Wait up to `timeout` (s) for the end; return whether it came."""
        self._thread.join(max(timeout, 0.0))
        return not self._thread.is_alive()

    def _enter(self, phase: Phase, since: float | None = None) -> None:
        self._phase, self._since = phase, time.time() if since is None else since
        self._changed()

    def _goes_down(self, phase: Phase) -> None:
        """Announce that the process ended or froze at this instant."""
        self._down, self._down_steady_ns = time.time(), time.monotonic_ns()
        self._enter(phase)

    def _keep(self) -> None:
        # The child inherits this thread's mask, so it starts with SIGINT blocked.
        signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
        self._end_process()  # where an error began this anew
        while not self._stop.is_set():
            self._run_once()
            if self._stop.is_set():
                break
            self._say_end()
            left = self._delay - (time.monotonic() - self._down_steady_ns / SECOND)
            self._start_now.wait(None if self._phase is Phase.REFUSED else max(left, 0.0))
            if not self._stop.is_set():
                self._restarts += 1
        self._enter(Phase.STOPPED)

    def _ended(self, code: int | None, how: str) -> None:
        """Take how the process ended, and announce it unless that was wanted."""
        self._last_code, self._last_exit = code, how
        if self._stop.is_set():
            return
        refused = code == WRONG_CONFIGURATION
        self._delay = 0.0 if refused else self._policy.ended(time.monotonic())
        self._goes_down(Phase.REFUSED if refused else Phase.WAITING)

    def _say_end(self) -> None:
        ended = f"{self.spec.name} ended ({self._last_exit})"
        if self._phase is Phase.REFUSED:
            ended += " and is not started again; correct what it named, then start the lab again"
        else:
            ended += f"; restarts in {self._delay:g} s"
        self._emit(SELF, ended)

    def _run_once(self) -> None:
        """Run the process to its end."""
        before = self._last_code
        environment = {
            **self.spec.env,
            RESTARTS: str(self._restarts),
            LAST_EXIT: "" if before is None else exit_name(before),
        }
        # Before the start: a program that cannot be started has not run since the one before it.
        self._policy.started(time.monotonic())
        with self._lock:
            if self._stop.is_set():
                self._last_exit = "not started"
                return
            try:
                process = self._forked(environment) or self._started(environment)
            except OSError as error:
                failed = f"could not be started: {_why_not(error)}"
            else:
                failed = ""
                self._process = process
                self._start_now.clear()
        if failed:
            self._ended(None, failed)
            return
        self._enter(Phase.RUNNING)
        assert process.stdout is not None
        reader = threads.task(f"{self.spec.name} output", partial(self._read, process.stdout))
        reader.start()
        code = self._until_its_end(process.pid)
        self._ended(code, describe_exit(code))
        self._end_process()
        # A process outside the group may still hold the pipe; its reader then runs on alone.
        reader.join(READ_TIMEOUT_S)

    def _forked(self, environment: Mapping[str, str]) -> Forked | None:
        """Return the process as the zygote forks it; None where it does not."""
        spec = self.spec
        if self._zygote is None or not spec.module:
            return None
        return self._zygote.fork(spec.module, spec.argv, spec.imports, environment)

    def _started(self, environment: Mapping[str, str]) -> subprocess.Popen[bytes]:
        return subprocess.Popen(
            guarded(self.spec.argv, unblock_sigint=not self.spec.unblocks_sigint),
            env={**os.environ, **environment},
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            start_new_session=True,
        )

    def _end_process(self) -> None:
        """End what is left of the process and its group, and reap it."""
        with self._lock:
            process, self._process = self._process, None
            if process is not None:
                _signal_group(process.pid, signal.SIGKILL)
                process.wait()

    def _until_its_end(self, pid: int) -> int:
        """Return the exit code of the process when it ends; it is not reaped.

        Its id cannot be reused before its group is gone. Meanwhile announce when a signal stops
        it, and when it runs again.
        """
        changes = os.WSTOPPED | os.WCONTINUED
        running_since = self._since
        while True:
            found = os.waitid(os.P_PID, pid, os.WEXITED | os.WNOWAIT | changes)
            if found is not None and found.si_code == os.CLD_EXITED:
                return found.si_status
            if found is not None and found.si_code in (os.CLD_KILLED, os.CLD_DUMPED):
                return -found.si_status
            # Take this change, or a newer one, so that it is not reported again.
            found = os.waitid(os.P_PID, pid, changes | os.WNOHANG)
            if found is not None and found.si_code == os.CLD_STOPPED:
                if self._phase is Phase.RUNNING:
                    running_since = self._since
                self._goes_down(Phase.FROZEN)
            elif found is not None and found.si_code == os.CLD_CONTINUED:
                # It has run since its start, not since this freeze.
                self._enter(Phase.RUNNING, running_since)

    def _read(self, stream: IO[bytes]) -> None:
        repeated = RepeatedLines()
        with stream:
            for raw in stream:
                line: str | None = raw.decode(errors="replace").rstrip()
                # zenoh logs each refused handshake, however many a guest tries.
                if line and ZENOH in line:
                    line = repeated.passed(line, time.monotonic())
                if line is not None:
                    self._emit(self.spec.name, line)


def _signal_group(leader: int, number: signal.Signals) -> None:
    # A group whose members have all ended may refuse.
    with contextlib.suppress(ProcessLookupError, PermissionError):
        os.killpg(leader, number)
