"""One robot as a command shows it: its state, its progress and its deadline errors."""

from __future__ import annotations

import math
import time
from statistics import median
from typing import Any

from mrlab_msgs import msg
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy

from mrlab_ros.core.base.clock import SECOND
from mrlab_ros.messages import qos
from mrlab_ros.messages.status import unknown_state
from mrlab_ros.messages.time import time_from_message
from mrlab_ros.ros.graph import GraphClient, Watch

# Latched like the publisher, and deep enough to see every state that follows another closely.
EVERY_STATE = QoSProfile(
    depth=100,
    reliability=ReliabilityPolicy.RELIABLE,
    durability=DurabilityPolicy.TRANSIENT_LOCAL,
)


class Follower:
    """Follows one robot's playback_state and telemetry."""

    def __init__(self, graph: GraphClient, robot: str) -> None:
        self.robot = robot
        self.watch: Watch[Any] = Watch(f"/{robot}/playback_state")
        self.states: list[Any] = []
        self.telemetry: Any = None
        # When the robot was heard last, s on the monotonic clock.
        self.heard = time.monotonic()
        # The deadline errors that telemetry reported, s.
        self.errors: list[float] = []
        self.error_max = math.nan
        # When frame 0 of the present run was due, ns on the lab's clock.
        self.start_ns: int | None = None
        graph.subscribe(msg.PlaybackState, self.watch.topic, self._on_state, EVERY_STATE)
        graph.subscribe(msg.Telemetry, f"/{robot}/telemetry", self._on_telemetry, qos.STREAM)

    def _on_state(self, state: Any) -> None:
        if state.state == msg.PlaybackState.PLAYING and state.clock.rate > 0:
            offset = round(state.clock.position / state.clock.rate * SECOND)
            self.start_ns = time_from_message(state.clock.stamp) - offset
        self.heard = time.monotonic()
        self.states.append(state)
        self.watch.set(state)

    def _on_telemetry(self, telemetry: Any) -> None:
        self.heard = time.monotonic()
        if self.telemetry is not None and telemetry.frames_sent < self.telemetry.frames_sent:
            # Another run began; the playback's own maximum begins anew with it, too.
            self.errors.clear()
        self.telemetry = telemetry
        if telemetry.frames_sent:
            self.errors.append(telemetry.deadline_error)
            self.error_max = telemetry.deadline_error_max

    @property
    def state(self) -> Any:
        """The newest playback_state, or an empty one before the first."""
        return self.watch.value or unknown_state()

    @property
    def frame(self) -> int:
        """The newest frame reported: a state does so once a second, telemetry more often."""
        state = self.state
        if state.state == msg.PlaybackState.PLAYING and self.telemetry is not None:
            return int(max(state.frame, self.telemetry.frame))
        return int(state.frame)

    @property
    def frames_lost(self) -> int:
        return int(self.telemetry.frames_lost) if self.telemetry is not None else 0

    @property
    def error_p50(self) -> float:
        """The median of the deadline errors, s; NaN before the first."""
        return median(self.errors) if self.errors else math.nan


def milliseconds(seconds: float) -> str:
    """Write a time in s as ms; a dash where there is none."""
    return "-" if math.isnan(seconds) else f"{seconds * 1e3:.2f} ms"
