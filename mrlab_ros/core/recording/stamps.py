"""When what a message says was so: by its stamp, where that is of the recording's clock."""

from __future__ import annotations

# A recorder on a busy machine receives this late at most, s. A stamp that is further from the
# receipt is of another clock: simulated time, or a replay's.
LATEST_S = 1.0


def time_of(received: float, stamp: float, before: float) -> float:
    """Return the time of a message, s of the session; never earlier than that of the one before.

    received, stamp: when the recorder received it and what its header says, s of the session.
    """
    return max(stamp if abs(stamp - received) <= LATEST_S else received, before)
