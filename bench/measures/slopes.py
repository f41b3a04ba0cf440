"""Memory that stays behind: how much each process grows with each robot spawned and removed.

A robot is spawned, plays until its first joint state, and is removed, one every PERIOD_S. Each has
a name of its own, so that tables by name show. The first fifth fills caches and is left out.
Fast DDS keeps some 200 bytes of each topic name for ever, so that names used again cost less.
Target: below 0.05 MB a minute with six robots a minute, which is 8 kB a robot.
"""

from __future__ import annotations

import os
import tempfile
import time
from pathlib import Path
from typing import Any

import numpy as np
from lab import MODEL, Lab, running
from mrlab_msgs import srv
from sensor_msgs.msg import JointState
from size import Size

from mrlab_ros.messages import qos

NEEDS = ()
PERIOD_S = 2.0
# How many robots a minute the target is stated for.
ROBOTS_A_MINUTE = 6


def _spawn_and_remove(lab: Lab, name: str) -> None:
    began = time.monotonic()
    lab.ask(srv.SpawnRobot, "/lab/spawn_robot", model=MODEL, name=name, automatic=True)
    arrived: list[Any] = []
    subscription = lab.node.create_subscription(
        JointState, f"/{name}/joint_states", arrived.append, qos.STREAM
    )
    while not arrived and time.monotonic() - began < PERIOD_S:
        time.sleep(0.01)
    lab.node.destroy_subscription(subscription)
    time.sleep(max(0.0, began + PERIOD_S / 2 - time.monotonic()))
    lab.ask(srv.Remove, "/lab/remove_robot", name=name)
    time.sleep(max(0.0, began + PERIOD_S - time.monotonic()))


def _pss_mb(lab: Lab) -> dict[str, float]:
    return {
        name: process.memory_full_info().pss / 1e6 for name, process in lab.processes().items()
    }


def _watched(robots: int) -> list[dict[str, Any]]:
    measured: list[dict[str, float]] = []
    with tempfile.TemporaryDirectory() as folder, running(Path(folder)) as lab:
        lab.client(srv.SpawnRobot, "/lab/spawn_robot").wait_for_service(30.0)
        # The middleware has found nobody yet: what it allocates for that is no growth.
        time.sleep(3.0)
        for number in range(robots):
            _spawn_and_remove(lab, f"robot_{os.getpid()}_{number}")
            measured.append(_pss_mb(lab))
    steady = measured[len(measured) // 5 :]
    return [_row(name, [each[name] for each in steady]) for name in steady[0]]


def _row(process: str, pss_mb: list[float]) -> dict[str, Any]:
    """Return the slope of a straight line through the figures of one process."""
    a_robot = float(np.polyfit(range(len(pss_mb)), pss_mb, 1)[0]) if len(pss_mb) > 2 else np.nan
    return {
        "process": process,
        "robots": len(pss_mb),
        "PSS begin MB": pss_mb[0],
        "PSS end MB": pss_mb[-1],
        "growth kB a robot": a_robot * 1e3,
        f"MB/min at {ROBOTS_A_MINUTE} a min": a_robot * ROBOTS_A_MINUTE,
    }


def short(size: Size) -> list[dict[str, Any]]:
    return _watched(size.of(2, 15, 60))


def soak(size: Size) -> list[dict[str, Any]]:
    return _watched(round(size.soak * 60 / PERIOD_S))


TABLES = {"Growth with robots that come and go": short}
SOAKS = {"Growth over many robots that come and go": soak}
