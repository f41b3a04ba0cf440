"""The clock by which nodes stamp and schedule: wall time without steps, or /clock."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable
from typing import cast

from rclpy.clock import ROSClock
from rclpy.node import Node

from mrlab_ros.core.base.clock import LabTime

# Two clocks are read at one instant where that takes no longer, ns: otherwise the thread was
# interrupted in between.
ONE_INSTANT_NS = 100_000
# Readings until the shortest is taken as it is.
MOST_READINGS = 20


class LabClock:
    """Time in ns. With the parameter use_sim_time of `node`, /clock gives it; else the wall clock.

    A step of the wall clock, or a jump back of /clock, changes `shifted_ns`: whoever schedules by
    this clock moves what is scheduled by as much.
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
        """The sum of all shifts so far."""
        return self._time.shifted_ns

    @property
    def simulated(self) -> bool:
        """Whether /clock gives the time."""
        return self._time.simulated

    def now_ns(self) -> int:
        return self.reading()[0]

    def reading(self) -> tuple[int, int]:
        """Return the time, and the monotonic clock's of the same instant, both ns."""
        ros = self._ros
        with self._lock:
            if ros is not None and ros.ros_time_is_active:
                steady_ns = self._steady_ns()
                return self._time.follow_clock(ros.now().nanoseconds, steady_ns), steady_ns
            steady_ns, wall_ns = self._read()
            return self._time.follow_wall(steady_ns, wall_ns), steady_ns

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
