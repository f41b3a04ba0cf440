"""The clock by which nodes stamp and schedule: wall time without steps, or /clock.

Timers by the monotonic clock: neither a clock that is set nor /clock stops them.

A timer of rclpy goes by its node's clock. A wall clock that is set back by an hour would silence
it for an hour: signs of life, journals and leases would end.

When this process did not run, and which requests of services waited meanwhile.
"""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any, cast

from rclpy.callback_groups import CallbackGroup
from rclpy.clock import Clock, ROSClock
from rclpy.clock_type import ClockType
from rclpy.node import Node
from rclpy.timer import Timer

from mrlab_ros.core.base.clock import SECOND, LabTime
from mrlab_ros.core.base.diagnostic import Diagnostic
from mrlab_ros.core.runtime.freezes import Freezes

# Two clocks are read at one instant where that takes no longer, ns: otherwise the thread was
# interrupted in between.
ONE_INSTANT_NS = 100_000
# Readings until the shortest is taken as it is.
MOST_READINGS = 20


class LabClock:
    """Time in ns. With the parameter use_sim_time of `node`, /clock gives it; else the wall clock.

    A step of the wall clock, or a jump back of /clock, changes `shifted_ns`. Messages carry
    stamps, which follow it; a node stores and schedules instants, which no set clock moves.
    """

    def __init__(
        self,
        node: Node | None = None,
        *,
        wall_ns: Callable[[], int] = time.time_ns,
        steady_ns: Callable[[], int] = time.monotonic_ns,
    ) -> None:
        self._ros = None if node is None else cast(ROSClock, node.get_clock())
        self._wall_ns, self._steady_ns = wall_ns, steady_ns
        self._lock = threading.Lock()
        self._time = LabTime(*self._read())

    @property
    def shifted_ns(self) -> int:
        """By how much stamps are ahead of instants: the sum of all shifts so far."""
        return self._time.shifted_ns

    @property
    def simulated(self) -> bool:
        """Return whether /clock gives the time."""
        return self._time.simulated

    def now_ns(self) -> int:
        """Return the present stamp."""
        return self.stamp(self.instant_ns())

    def instant_ns(self) -> int:
        """Return the present instant."""
        return self.reading()[0]

    def stamp(self, instant_ns: int) -> int:
        """Return the stamp of an instant, by the newest reading of the clock."""
        return instant_ns + self._time.shifted_ns

    def instant(self, stamp_ns: int) -> int:
        """Return the instant of a stamp that was made shortly before it arrived, which is now."""
        return self._time.instant(stamp_ns, self.instant_ns())

    def reading(self) -> tuple[int, int]:
        """Return the present instant, and the monotonic clock's time of it, both ns."""
        ros, lab = self._ros, self._time
        with self._lock:
            if ros is not None and ros.ros_time_is_active:
                steady_ns = self._steady_ns()
                now_ns = lab.follow_clock(ros.now().nanoseconds, steady_ns)
            else:
                steady_ns, wall_ns = self._read()
                now_ns = lab.follow_wall(steady_ns, wall_ns)
            return now_ns - lab.shifted_ns, steady_ns

    def _read(self) -> tuple[int, int]:
        """Return steady and wall time of one instant."""
        best: tuple[int, int, int] | None = None
        before = self._steady_ns()
        for _ in range(MOST_READINGS):
            wall, after = self._wall_ns(), self._steady_ns()
            if best is None or after - before < best[0]:
                best = (after - before, before, wall)
            if best[0] <= ONE_INSTANT_NS:
                break
            before = after
        assert best is not None
        return best[1], best[2]


STEADY = Clock(clock_type=ClockType.STEADY_TIME)


def every(
    node: Node, period: float, callback: Callable[[], object], group: CallbackGroup | None = None
) -> Timer:
    """Call `callback` in the node's executor every `period` s.

    What it raises because the context was shut down beneath it is no mistake, and the executor
    would log it as a fatal one.
    """

    def call() -> None:
        try:
            callback()
        except Exception:
            if node.context.ok():
                raise

    return node.create_timer(period, call, callback_group=group, clock=STEADY)


# Every thread that spins a node says that the process runs.
PROCESS = Freezes("lab", time.process_time)
LOCK = threading.Lock()


def look() -> None:
    """Note that this process runs."""
    with LOCK:
        PROCESS.look(time.monotonic())


@contextmanager
def watching() -> Iterator[None]:
    """Say that this thread calls look() again and again."""
    with LOCK:
        PROCESS.begin()
    try:
        yield
    finally:
        with LOCK:
            PROCESS.end()


def why_late(header: Any) -> Diagnostic | None:
    """Return why a request is refused that came with `header`; None: it came in time.

    Its age is by the wall clock, as its sender stamps it.
    """
    age_s = (time.time_ns() - header.source_timestamp) / SECOND
    with LOCK:
        now = time.monotonic()
        return PROCESS.why_late(now - age_s, now)


def why_doubtful() -> Diagnostic | None:
    """Return why something without a stamp of its sender is refused; None: it is not."""
    with LOCK:
        return PROCESS.why_doubtful(time.monotonic())
