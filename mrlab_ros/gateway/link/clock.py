"""The lab's time: the bridge's clock, as the gateway reads it.

The offset between two clocks: the exchange with the least round trip of a sliding window.

web/src/link/clock_offset.ts is the same for the browser; test vectors hold both together.
"""

from __future__ import annotations

import asyncio
import math
import struct
import time
from contextlib import suppress
from dataclasses import dataclass

from mrlab_ros.core.base.errors import LabError
from mrlab_ros.gateway.lab.connection import LabConnection, Phase

# s: a round trip that is older says little about a clock that drifts.
WINDOW_S = 30.0
# s of correction a second: a clock that is read for motion must not jump.
SLEW = 0.05
# An error from which on it jumps all the same, s, as after a sleep of the machine.
JUMP_S = 0.5
# Two exchanges that differ by more than their round trips explain, and by this, s, have one of the
# clocks set between them: the older one says nothing any more, and the offset jumps.
SET_S = 0.05


@dataclass(frozen=True)
class Exchange:
    """One question and answer. at: s on the own clock; offset: s, theirs minus own."""

    at: float
    round_trip: float
    offset: float


def exchange(asked: float, came: float, answered: float, back: float) -> Exchange:
    """Return the exchange of four times, s: own, theirs, theirs, own."""
    offset = ((came - asked) + (answered - back)) / 2
    return Exchange(back, (back - asked) - (answered - came), offset)


def _agree(older: Exchange, newer: Exchange) -> bool:
    """Return whether no clock was set between two exchanges."""
    explained = (older.round_trip + newer.round_trip) / 2 + SET_S
    return abs(older.offset - newer.offset) <= explained


class ClockOffset:
    """Slews from one estimate to the next; `offset` at a time never runs backwards."""

    def __init__(self) -> None:
        self._window: list[Exchange] = []
        self._target = math.nan
        self._held = math.nan
        self._held_at = 0.0

    @property
    def known(self) -> bool:
        return not math.isnan(self._held)

    @property
    def round_trip(self) -> float:
        """The least of the window, s; NaN where there is none."""
        return min((each.round_trip for each in self._window), default=math.nan)

    def add(self, found: Exchange) -> None:
        """Take another exchange into account."""
        current = self.offset(found.at)
        recent = [each for each in self._window if each.at >= found.at - WINDOW_S]
        agreeing = [each for each in recent if _agree(each, found)]
        self._window = [*agreeing, found]
        self._target = min(self._window, key=lambda each: each.round_trip).offset
        was_set = len(agreeing) < len(recent)
        jumps = was_set or math.isnan(current) or abs(self._target - current) > JUMP_S
        self._held = self._target if jumps else current
        self._held_at = found.at

    def offset(self, at: float) -> float:
        """Return the offset to add to the own clock at `at`, s; NaN before the first exchange."""
        if math.isnan(self._held):
            return math.nan
        most = SLEW * max(0.0, at - self._held_at)
        return self._held + max(-most, min(most, self._target - self._held))

    def clear(self) -> None:
        """Forget the exchanges: the other clock is another one now."""
        self._window.clear()
        self._target = self._held = math.nan


KEY = "@mrlab/bridge/clock"
PERIOD_S = 2.0
SECOND = 1_000_000_000
ANSWER = struct.Struct("<qq")


class LabClock:
    """Says the lab's time; this machine's while the lab has not said its own."""

    def __init__(self, lab: LabConnection) -> None:
        self._lab = lab
        self._offset = ClockOffset()

    def now(self) -> float:
        """Return the lab's time, s since 1970."""
        now = time.time()
        return now + self._offset.offset(now) if self._offset.known else now

    async def follow(self) -> None:
        """Ask the bridge for its time, until cancelled."""
        while True:
            if self._lab.phase is Phase.OPEN:
                with suppress(LabError, struct.error):
                    asked = time.time()
                    answer = await self._lab.query(KEY, None, PERIOD_S)
                    back = time.time()
                    came, answered = (each / SECOND for each in ANSWER.unpack_from(answer))
                    self._offset.add(exchange(asked, came, answered, back))
            await asyncio.sleep(PERIOD_S)
