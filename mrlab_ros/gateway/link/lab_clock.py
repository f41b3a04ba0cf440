"""The lab's time: the bridge's clock, as the gateway reads it."""

from __future__ import annotations

import asyncio
import struct
import time
from contextlib import suppress

from mrlab_ros.core.base.errors import LabError
from mrlab_ros.gateway.lab.connection import LabConnection, Phase
from mrlab_ros.gateway.link.clock_offset import ClockOffset, exchange

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
