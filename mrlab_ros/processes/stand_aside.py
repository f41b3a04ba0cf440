"""Whether a replay wants the lab's own nodes out of the graph."""

from __future__ import annotations

import os
import time

from mrlab_msgs.msg import RecorderState
from rclpy.context import Context
from rclpy.node import Node

from mrlab_ros.messages import qos
from mrlab_ros.ros.spinning import SpunNode

# These have a part in a replay.
STAYS = frozenset({"bridge", "recorder"})
TOPIC = "/recorder/state"
# How long a recorder that was found may take to be heard, s.
HEAR_TIMEOUT = 3.0
LOOK = 0.02


class StandAside:
    """Listens to the recorder through a hidden node."""

    def __init__(self, context: Context | None = None) -> None:
        self._replays = self._heard = False
        node = Node(
            f"_stand_aside_{os.getpid()}",
            context=context,
            start_parameter_services=False,
            enable_rosout=False,
            use_global_arguments=False,
        )
        node.create_subscription(RecorderState, TOPIC, self._on_state, qos.LATCHED)
        self._spun = SpunNode(node)

    def hear(self, find_timeout: float) -> None:
        """Wait until a recorder was heard, or until none was found within `find_timeout` s."""
        began = time.monotonic()
        while not self._heard:
            there = self._spun.node.count_publishers(TOPIC) > 0
            if time.monotonic() - began >= find_timeout + HEAR_TIMEOUT * there:
                return
            time.sleep(LOOK)

    @property
    def wanted(self) -> bool:
        """True while a recorder that is there replays a bag."""
        return self._replays and self._spun.node.count_publishers(TOPIC) > 0

    def close(self) -> None:
        self._spun.close()

    def _on_state(self, message: RecorderState) -> None:
        self._replays = message.state in (RecorderState.REPLAYING, RecorderState.PAUSED)
        self._heard = True
