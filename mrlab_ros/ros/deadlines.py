"""One thread that publishes every playback's joint states at their deadlines.

Timers of an executor share a wait set with every service and topic of the process; here a
deadline depends on this loop alone.

Gives the thread that asks for it precedence over the machine's other work.

SCHED_RR comes first: such a thread runs as soon as it is ready. The kernel grants it to root, to
CAP_SYS_NICE and where `ulimit -r` says so (`@GROUP - rtprio 20` in /etc/security/limits.conf).
Where it does not, a nice level below 0 is asked for, which `ulimit -e` grants.
"""

from __future__ import annotations

import contextlib
import ctypes
import os
import sys
import threading
import time
from collections.abc import Callable
from typing import NamedTuple

from mrlab_ros.adapters import threads
from mrlab_ros.core.base.clock import SECOND
from mrlab_ros.core.playback.execution import PlaybackStatus
from mrlab_ros.core.playback.playback import Playback
from mrlab_ros.core.playback.stream import LOST_AFTER_NS, Sample
from mrlab_ros.core.runtime.freezes import Freezes
from mrlab_ros.core.trajectory.trajectory import Trajectory
from mrlab_ros.ros.clock import LabClock

# Above ordinary work, below the kernel's own threads and audio servers.
REALTIME = 10
NICE = -10


def take_precedence(realtime: int = REALTIME) -> str:
    """Raise the calling thread's priority as far as permitted; return in words what it has.

    What the thread starts has ordinary priority again.
    """
    with contextlib.suppress(OSError, AttributeError):
        os.sched_setscheduler(0, os.SCHED_RR | os.SCHED_RESET_ON_FORK, os.sched_param(realtime))
        return f"SCHED_RR {realtime}"
    with contextlib.suppress(OSError):
        os.setpriority(os.PRIO_PROCESS, threading.get_native_id(), NICE)
        return f"nice {NICE}"
    return (
        "ordinary priority: neither SCHED_RR (ulimit -r) nor a nice level (ulimit -e) is permitted"
    )


PR_SET_TIMERSLACK = 29
# The longest the thread sleeps without a deadline, s.
IDLE_SLEEP_S = 1.0
# How often /clock is read where it gives the time and something is scheduled, s.
TICK_S = 0.002
# A sleep ends about WAKE_NS late, and preparing a joint state takes about PREPARE_NS: the thread
# wakes earlier by their sum and publishes when they are due.
WAKE_NS = 100_000
PREPARE_NS = 12_000
# Another thread that runs Python delays the deadline thread by at most this time, s. Python's own
# 5 ms would be half a period at 100 Hz.
SWITCH_INTERVAL_S = 0.0005


class Report(NamedTuple):
    """A joint state that was sent, and the run that it belongs to.

    sent, lost: frames of the run. error_ns, error_max_ns: how late this joint state was
    published, and the latest of the run.
    """

    sample: Sample
    trajectory: Trajectory | None
    sent: int
    lost: int
    error_ns: int
    error_max_ns: int


class Player:
    """A playback, the callbacks for its output, and what it sent last.

    last: may be read by any thread without the scheduler's lock; it is replaced as a whole.
    """

    def __init__(
        self,
        playback: Playback,
        send: Callable[[Sample], None],
        announce: Callable[[int, PlaybackStatus], None],
    ) -> None:
        self.playback = playback
        self._send = send
        self._announce = announce
        self.last: Report | None = None
        self._error_ns = self._error_max_ns = 0

    def prepare(self, due_ns: int, now_ns: int, *, simulated: bool = False) -> Sample | None:
        """Return the joint state that is due at `due_ns`, maybe moments ahead; None without one.

        simulated: the time goes in ticks. What a tick makes due leaves at once and is not late.
        """
        late = now_ns - due_ns > (LOST_AFTER_NS if simulated else 0)
        return self.playback.tick(now_ns if late else due_ns)

    def send(self, sample: Sample, ahead_ns: int) -> None:
        """Publish a prepared joint state; keep its deadline error.

        ahead_ns: by how much instants are ahead of the monotonic clock.
        """
        self._send(sample)
        trajectory, sent, lost = self.playback.progress()
        if sample.streamed:
            self._error_ns = time.monotonic_ns() + ahead_ns - sample.due_ns
            longest = 0 if sent <= 1 else self._error_max_ns
            self._error_max_ns = max(longest, self._error_ns)
        self.last = Report(sample, trajectory, sent, lost, self._error_ns, self._error_max_ns)

    def announce(self, now_ns: int) -> None:
        for status in self.playback.take_statuses():
            self._announce(now_ns, status)


def _due(item: tuple[int, Player]) -> int:
    return item[0]


class Scheduler:
    """Serves players at their deadlines; commands run between two of them.

    Use `with scheduler.command(player) as now_ns:` around every use of a playback. All times are
    instants of `clock`, which gives the stamps that messages carry. What a player
    raises is named in the log while `connected()`: a failure after the shutdown of the context is
    expected.

    precedence: in words which priority the deadline thread got; empty before start().
    """

    def __init__(
        self, connected: Callable[[], bool] = lambda: True, clock: LabClock | None = None
    ) -> None:
        self.clock = clock or LabClock()
        # The shift of the clock with which states were announced.
        self._shifted_ns = self.clock.shifted_ns
        self._connected = connected
        self._changed = threading.Condition(threading.Lock())
        self._players: list[Player] = []
        self._running = True
        self.precedence = ""
        self._prepared = threading.Event()
        self._thread = threads.loop("deadlines", self._run, connected)

    def start(self) -> None:
        sys.setswitchinterval(SWITCH_INTERVAL_S)
        self._thread.start()
        self._prepared.wait()

    def stop(self) -> None:
        """Stop the thread and wait for it."""
        with self._changed:
            self._running = False
            self._changed.notify()
        if self._thread.is_alive():
            self._thread.join()

    def add(self, player: Player) -> None:
        with self._changed:
            self._players.append(player)
            self._changed.notify()

    def remove(self, player: Player) -> None:
        """Serve `player` no more; one that was never added is left alone."""
        with self._changed:
            if player in self._players:
                self._players.remove(player)

    def command(self, *players: Player) -> Command:
        """Return the lock for a command to `players` (default: all); enter it to know the time."""
        return Command(self, players)

    def _run(self) -> None:
        # The kernel rounds a sleep up by 50 us unless asked not to.
        ctypes.CDLL(None).prctl(PR_SET_TIMERSLACK, 1, 0, 0, 0)
        self.precedence = take_precedence()
        self._prepared.set()
        freezes = Freezes("playback", time.process_time)
        freezes.begin()
        with self._changed:
            while self._running:
                now_ns, steady_ns = self._reading()
                if freezes.thawed(steady_ns / SECOND):
                    self._thaw(now_ns)
                simulated = self.clock.simulated
                # Simulated time may advance late; do not busy-wait.
                early_ns = 0 if simulated else WAKE_NS + PREPARE_NS * len(self._players)
                horizon_ns = now_ns + early_ns
                batch = []
                for player in self._players:
                    due_ns = player.playback.due_ns()
                    if due_ns is not None and due_ns <= horizon_ns:
                        batch.append((due_ns, player))
                ahead_ns = now_ns - steady_ns
                if batch:
                    self._serve(batch, now_ns, ahead_ns, simulated=simulated)
                next_ns = self._next_ns()
                if next_ns is None:
                    left = IDLE_SLEEP_S
                elif simulated:
                    left = TICK_S if next_ns > now_ns else 0.0
                else:
                    left = (next_ns - early_ns - ahead_ns - time.monotonic_ns()) / SECOND
                self._changed.wait(max(min(left, IDLE_SLEEP_S), 0.0))

    def _next_ns(self) -> int | None:
        """Return when the next joint state is due; None: not before something changes."""
        due = [player.playback.due_ns() for player in self._players]
        return min((ns for ns in due if ns is not None), default=None)

    def _reading(self) -> tuple[int, int]:
        """Return the present instant and the monotonic clock's time; hold the lock.

        Where the clock was set, states are announced again, with their new stamps.
        """
        now_ns, steady_ns = self.clock.reading()
        if self.clock.shifted_ns != self._shifted_ns:
            self._shifted_ns = self.clock.shifted_ns
            for player in self._players:
                player.playback.announce_again()
                try:
                    player.announce(now_ns)
                except Exception as error:
                    self._name_error(error)
        return now_ns, steady_ns

    def _thaw(self, now_ns: int) -> None:
        """Let members of systems stand, before what is late is served."""
        for player in self._players:
            try:
                player.playback.thaw(now_ns)
                player.announce(now_ns)
            except Exception as error:
                self._name_error(error)

    def _serve(
        self, batch: list[tuple[int, Player]], now_ns: int, ahead_ns: int, *, simulated: bool
    ) -> None:
        """Prepare all joint states that are due, then publish each at its deadline.

        ahead_ns: by how much the instant `now_ns` is ahead of the monotonic clock. The batch goes
        by the latter, which costs little to read.
        """
        steady_ns = time.monotonic_ns
        ready = []
        batch.sort(key=_due)
        for due_ns, player in batch:
            try:
                sample = player.prepare(due_ns, now_ns, simulated=simulated)
            except Exception as error:
                self._name_error(error)
                continue
            if sample is not None:
                ready.append((due_ns - ahead_ns, player, sample))
        for at_ns, player, sample in ready:
            while steady_ns() < at_ns:
                pass
            try:
                player.send(sample, ahead_ns)
            except Exception as error:
                self._name_error(error)
        now_ns = steady_ns() + ahead_ns
        for _, player in batch:
            try:
                player.announce(now_ns)
            except Exception as error:
                self._name_error(error)

    def _name_error(self, error: Exception) -> None:
        """Name an error: one robot's failure must not stop the others."""
        if self._connected():
            threads.name_error("deadlines", error)


class Command:
    """Locks the deadline thread out while a command runs; then announces what it changed.

    players: those that the command is for; none: all.
    """

    def __init__(self, scheduler: Scheduler, players: tuple[Player, ...] = ()) -> None:
        self._scheduler = scheduler
        self._players = players

    def __enter__(self) -> int:
        self._scheduler._changed.acquire()
        return self._scheduler._reading()[0]

    def __exit__(self, *exception: object) -> None:
        scheduler = self._scheduler
        now_ns = scheduler.clock.instant_ns()
        try:
            for player in self._players or scheduler._players:
                player.announce(now_ns)
        finally:
            scheduler._changed.notify()
            scheduler._changed.release()
