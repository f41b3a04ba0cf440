"""Whether a replay wants the lab's own nodes out of the graph."""

from __future__ import annotations

import os

from mrlab_msgs.msg import RecorderState
from rclpy.node import Node

from mrlab_ros import qos
from mrlab_ros.spinning import SpunNode

# These have a part in a replay.
STAYS = frozenset({"bridge", "recorder"})
TOPIC = "/recorder/state"


class StandAside:
    """Listens to the recorder through a hidden node of the default context."""

    def __init__(self) -> None:
        self._replays = False
        node = Node(
            f"_stand_aside_{os.getpid()}",
            start_parameter_services=False,
            enable_rosout=False,
            use_global_arguments=False,
        )
        node.create_subscription(RecorderState, TOPIC, self._on_state, qos.LATCHED)
        self._spun = SpunNode(node)

    @property
    def wanted(self) -> bool:
        """True while a recorder that is there replays a bag."""
        return self._replays and self._spun.node.count_publishers(TOPIC) > 0

    def close(self) -> None:
        self._spun.close()

    def _on_state(self, message: RecorderState) -> None:
        self._replays = message.state in (RecorderState.REPLAYING, RecorderState.PAUSED)
