"""The time of a lab: it follows a source that may be stepped, and says by how much it was shifted.

The wall clock of a machine may be set while a robot plays. What is scheduled then must neither
wait nor hurry: a step shifts the time and everything scheduled by it alike, and nothing moves.
"""

from __future__ import annotations

from mrlab_ros.core.clock import SECOND

# A difference to the wall clock from which on the time is shifted at once, ns; a smaller one is
# slewed.
STEP_NS = SECOND // 10
# ns of correction for each ns: deadlines at 100 Hz then lie 50 us closer or further apart.
SLEW = 0.005
# A difference that stays, ns: two clocks are never read at exactly one instant.
AGREED_NS = SECOND // 1000


class LabTime:
    """Time in ns that advances steadily and agrees with its source. All arguments are ns.

    shifted_ns: the sum of all shifts; what was scheduled before a shift is moved by it.
    """

    def __init__(self, steady_ns: int, wall_ns: int) -> None:
        self.shifted_ns = 0
        self._offset_ns = wall_ns - steady_ns
        self._slewed_ns = steady_ns
        # The newest time that /clock gave; None: the wall clock is followed.
        self._simulated_ns: int | None = None

    @property
    def simulated(self) -> bool:
        """Whether it follows /clock."""
        return self._simulated_ns is not None

    def follow_wall(self, steady_ns: int, wall_ns: int) -> int:
        """Return the time; a step of the wall clock shifts it."""
        if self._simulated_ns is not None:
            # use_sim_time was switched off.
            self.shifted_ns += wall_ns - self._simulated_ns
            self._simulated_ns = None
            self._offset_ns, self._slewed_ns = wall_ns - steady_ns, steady_ns
        error_ns = wall_ns - steady_ns - self._offset_ns
        if abs(error_ns) >= STEP_NS:
            self.shifted_ns += error_ns
            self._offset_ns += error_ns
            self._slewed_ns = steady_ns
        else:
            most_ns = int(SLEW * (steady_ns - self._slewed_ns))
            if most_ns > 0:
                excess_ns = error_ns - max(-AGREED_NS, min(AGREED_NS, error_ns))
                self._offset_ns += max(-most_ns, min(most_ns, excess_ns))
                self._slewed_ns = steady_ns
        return steady_ns + self._offset_ns

    def follow_clock(self, clock_ns: int, steady_ns: int) -> int:
        """Return the time of /clock; one that goes back shifts it, one that goes on is passed.

        clock_ns: 0 before the first message. Going on from 0, and from the wall clock, shifts too.
        """
        before_ns = self._simulated_ns
        if before_ns is None:
            before_ns = steady_ns + self._offset_ns
            self.shifted_ns += clock_ns - before_ns
        elif clock_ns < before_ns or before_ns == 0:
            self.shifted_ns += clock_ns - before_ns
        self._simulated_ns = clock_ns
        return clock_ns
