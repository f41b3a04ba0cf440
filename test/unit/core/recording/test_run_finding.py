"""The time of a recorded message."""

from __future__ import annotations

import pytest

from mrlab_ros.core.recording.run_finding import LATEST_S, time_of


@pytest.mark.parametrize(
    ("received", "stamp", "before", "expected"),
    [
        (2.08, 2.0, 1.99, 2.0),  # received late: on a busy machine all of a burst at once
        (2.08, 2.01, 2.0, 2.01),
        (2.0, 2.001, 1.99, 2.001),  # clocks of two machines
        (0.01, -0.02, 0.0, 0.0),  # latched, from before the recording
        (2.0, 2.1 + LATEST_S, 1.99, 2.0),  # simulated time
        (2.0, -1.7e9, 1.99, 2.0),  # no stamp at all
        (2.0, 1.5, 1.9, 1.9),
    ],
)
def test_the_stamp_counts_where_it_is_of_the_recordings_clock(
    received: float, stamp: float, before: float, expected: float
) -> None:
    assert time_of(received, stamp, before) == expected
