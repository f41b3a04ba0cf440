"""Detects a running replay, during which the lab's own nodes leave the graph."""

from __future__ import annotations

import os
import time

from mrlab_msgs.msg import RecorderState
from rclpy.context import Context

from mrlab_ros.messages import qos
from mrlab_ros.ros.decoding import subscribe
from mrlab_ros.ros.node import HiddenNode
from mrlab_ros.ros.spinning import SpunNode

TOPIC = "/recorder/state"
# How long the state of a discovered recorder may take to arrive, s.
STATE_TIMEOUT_S = 3.0
POLL_PERIOD_S = 0.02


class StandAside:
    """Subscribes to the recorder's state through a hidden node."""

    def __init__(self, context: Context | None = None) -> None:
        self._replays = self._received = False
        node = HiddenNode(f"_stand_aside_{os.getpid()}", context)
        subscribe(node, RecorderState, TOPIC, self._on_state, qos.LATCHED)
        self._spun = SpunNode(node)

    def wait_for_recorder(self, find_timeout: float) -> None:
        """Wait for a recorder's state, or until none was discovered within `find_timeout` s.

        It ends early where the context is shut down.
        """
        began = time.monotonic()
        while not self._received and self._spun.node.context.ok():
            there = self._spun.node.count_publishers(TOPIC) > 0
            if time.monotonic() - began >= find_timeout + STATE_TIMEOUT_S * there:
                return
            time.sleep(POLL_PERIOD_S)

    @property
    def wanted(self) -> bool:
        """True while a recorder is in the graph and replays a bag."""
        return self._replays and self._spun.node.count_publishers(TOPIC) > 0

    def close(self) -> None:
        self._spun.close()

    def _on_state(self, message: RecorderState) -> None:
        self._replays = message.state in (RecorderState.REPLAYING, RecorderState.PAUSED)
        self._received = True
