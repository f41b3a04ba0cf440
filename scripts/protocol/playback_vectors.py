"""Test vectors of the playback: what Python computes, the pages must compute too."""

from __future__ import annotations

import json
from typing import Any

import numpy as np

from mrlab_ros.core.base.clock import SECOND, PlaybackClock
from mrlab_ros.core.trajectory.derived_signals import Channels
from mrlab_ros.core.trajectory.trajectory import Source, Trajectory

# Hz; 1/3 and 1/7 of a second have no exact double: a frame must be found all the same.
RATES = (3.0, 7.0, 100.0, 1000.0 / 3)


def current() -> str:
    """Return web/test/playback/vectors.json."""
    document = {"clocks": _clocks(), "courses": [_course(rate) for rate in RATES]}
    return json.dumps(document, indent=1) + "\n"


def _clocks() -> list[dict[str, Any]]:
    found = []
    for stamp in (0.0, 12.5):
        for position in (0.0, 3.25):
            for rate in (-4.0, -0.5, 0.0, 0.25, 1.0, 4.0):
                clock = PlaybackClock(round(stamp * SECOND), position, rate)
                for now in (0.0, 12.5, 13.75):
                    at = clock.at(round(now * SECOND))
                    found.append(
                        {"stamp": stamp, "position": position, "rate": rate, "now": now, "at": at}
                    )
    return found


def _course(rate: float) -> dict[str, Any]:
    random = np.random.default_rng(7)
    positions = np.round(random.uniform(-3, 3, (9, 2)), 6)
    gripper = np.array([0, 0, 1, 1, 1, 0, 1, 0, 0], dtype=bool)
    zero = np.zeros_like(positions)
    trajectory = Trajectory(
        "t", "r", None, ("a", "b"), rate, positions, gripper, Channels(zero, zero.copy()),
        Source("", "", ""),
    )  # fmt: skip
    on = [frame / rate for frame in range(9)]
    times = [-1.0, *on, *(t + 0.37 / rate for t in on), on[3] - 1e-9 / rate, on[-1] + 5]
    samples = [
        {
            "time": time,
            "frame": trajectory.frame_at(time),
            "positions": trajectory.sample(time).tolist(),
            "closed": trajectory.gripper_at(time),
        }
        for time in times
    ]
    return {
        "frame_rate": rate,
        "positions": positions.tolist(),
        "gripper": gripper.astype(int).tolist(),
        "duration": trajectory.duration,
        "samples": samples,
    }
