"""A callback for raw subscriptions: the message as CDR, and when it was published."""

from __future__ import annotations

import inspect
from collections.abc import Callable
from typing import Any

# Gets a message's CDR and when it was published, ns since 1970.
OnMessage = Callable[[bytes, int], None]


class Stamped:
    """Makes an OnMessage the callback of a subscription with raw=True.

    The events executor passes message and info as one tuple, which a callback of two parameters
    does not accept; rclpy's other executors pass two arguments. rclpy passes the info only where
    `__signature__` has two parameters.
    """

    __signature__ = inspect.Signature(
        [
            inspect.Parameter(name, inspect.Parameter.POSITIONAL_ONLY)
            for name in ("message", "info")
        ]
    )

    def __init__(self, on_message: OnMessage) -> None:
        self._on_message = on_message

    def __call__(self, *taken: Any) -> None:
        payload, info = taken[0] if len(taken) == 1 else taken
        self._on_message(payload, info["source_timestamp"])
