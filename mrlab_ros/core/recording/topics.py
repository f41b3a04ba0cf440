"""Which topics a recording and a replay take, and when a recording continues in a new file."""

from __future__ import annotations

import math
import re
from collections.abc import Iterable
from dataclasses import dataclass

from mrlab_ros.core.base.clock import SECOND
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.recording.diagnostics import (
    BAD_SPLIT_DURATION,
    BAD_SPLIT_SIZE,
    BAD_TOPIC_PATTERN,
)

PATTERN = re.compile(r"(?:/(?:[A-Za-z_][A-Za-z0-9_]*|\*{1,2}))+")
# Topics of the lab: motion, state, events, and measurements.
LAB_TOPICS = (
    "/robots",
    "/systems",
    "/trajectories",
    "/trajectories/converted",
    "/objects",
    "/objects/removed",
    "/surfaces",
    "/overlaps",
    "/place",
    "/contacts",
    "/latency",
    "/latency/clients",
    "/presence",
    "/look_here",
    "/moves",
    "/diagnostics",
    "/tf",
    "/tf_static",
    "/rosout",
    "/*/joint_states",
    "/*/playback_state",
    "/*/telemetry",
    "/*/targets",
    "/*/collision",
    "/*/grasp",
    "/*/finger_states",
    "/*/robot_description",
    "/robot_description",
    "/markers/**",
)
# About the live processes, not the session; never replayed.
OF_THE_PRESENT = (
    "/rosout",
    "/parameter_events",
    "/latency",
    "/latency/clients",
    "/presence",
    "/look_here",
    "/moves",
    "/diagnostics",
    "/recorder/**",
)


def _expression(pattern: str) -> re.Pattern[str]:
    if PATTERN.fullmatch(pattern) is None:
        raise BadInput(BAD_TOPIC_PATTERN(pattern=pattern))
    parts = {"**": ".+", "*": "[^/]+"}
    return re.compile("".join("/" + parts.get(part, part) for part in pattern.split("/")[1:]))


class Topics:
    """A set of topics, given by patterns: `*` is one part of a name, `**` any parts."""

    def __init__(self, patterns: Iterable[str]) -> None:
        self.patterns = tuple(patterns)
        self._expressions = [_expression(pattern) for pattern in self.patterns]

    def __contains__(self, name: str) -> bool:
        return any(expression.fullmatch(name) for expression in self._expressions)


@dataclass(frozen=True)
class Split:
    """When a recording continues in a new file: after `duration` s or `size` bytes; 0 is never."""

    duration: float = 0.0
    size: int = 0

    def __post_init__(self) -> None:
        if not (math.isfinite(self.duration) and (self.duration == 0 or self.duration >= 1)):
            raise BadInput(BAD_SPLIT_DURATION(duration=self.duration))
        if self.size < 0:
            raise BadInput(BAD_SPLIT_SIZE(size=self.size))

    def due(self, began_ns: int, now_ns: int, size: int) -> bool:
        """Return whether a file that began at `began_ns` and holds `size` bytes is full."""
        old = 0 < self.duration * SECOND <= now_ns - began_ns
        return old or 0 < self.size <= size
