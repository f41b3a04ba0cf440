"""Surroundings of a lab: the range of its graph, its folder for state, the signals that end it."""

from __future__ import annotations

import os
import signal
import tempfile
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from mrlab_ros.adapters import private_folder
from mrlab_ros.ros import environment

# Any of these says that the user has chosen whom the graph can see.
DISCOVERY = (
    environment.RANGE,
    "ROS_DISCOVERY_SERVER",
    "ROS_LOCALHOST_ONLY",
    "ROS_STATIC_PEERS",
)


def graph_range(asked: str = "localhost") -> dict[str, str]:
    """Return the variables that say who finds and reaches the graph; none where the user has.

    asked: localhost, or subnet: everybody on this network, without a key.
    """
    if asked == "localhost" and any(os.environ.get(name) for name in DISCOVERY):
        return {}
    reach = {environment.RANGE: asked.upper()}
    return reach | environment.settings({**os.environ, **reach})


def stay_on_this_machine() -> None:
    """Keep the graph off the network unless the user has chosen otherwise."""
    os.environ.update(graph_range())


@contextmanager
def folder_for_state(chosen: Path | None) -> Iterator[Path]:
    """Make the folder for scene and trajectories, for one lab at a time; a temporary one goes
    with the lab. Raises BadInput where it cannot be made, Misuse where another lab has it.
    """
    if chosen is not None:
        folder = private_folder.make(chosen)
        lock = private_folder.hold(folder)
        try:
            yield folder
        finally:
            if lock is not None:
                os.close(lock)
        return
    with tempfile.TemporaryDirectory(prefix="mrlab-", ignore_cleanup_errors=True) as made:
        yield Path(made)


@contextmanager
def stop_signals() -> Iterator[threading.Event]:
    """Yield an event that Ctrl-C, SIGTERM and a closed terminal set."""
    stop = threading.Event()
    numbers = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)
    before = {number: signal.signal(number, lambda *_: stop.set()) for number in numbers}
    try:
        yield stop
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)
