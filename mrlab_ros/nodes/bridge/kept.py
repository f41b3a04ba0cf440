"""Keeps the newest messages of topics that zenoh does not carry, for programs of this machine."""

from __future__ import annotations

import base64
import json
import time
from collections import deque
from typing import Any

from rclpy.event_handler import SubscriptionEventCallbacks
from rclpy.node import Node
from rclpy.qos import QoSProfile

from mrlab_ros.adapters.zenoh.port import Query

# Who reports does so once a second; what is older says nothing of now, s.
KEPT_FOR_S = 5.0
# More than a class of clients reports in that time.
MOST = 512


class Kept:
    """The messages of one topic from the last KEPT_FOR_S, as CDR."""

    def __init__(self, node: Node, kind: Any, topic: str, quality: QoSProfile) -> None:
        self._messages: deque[tuple[float, bytes]] = deque(maxlen=MOST)
        # What is not published as `quality` asks is of no program of the lab; rclpy would warn.
        silent = SubscriptionEventCallbacks(incompatible_qos=lambda _: None)
        node.create_subscription(
            kind, topic, self._keep, quality, raw=True, event_callbacks=silent
        )

    def _keep(self, message: bytes) -> None:
        self._messages.append((time.monotonic(), message))

    def answer(self, query: Query) -> None:
        """Reply with a JSON list of [age in s, CDR as base64], the oldest first."""
        now = time.monotonic()
        found = [
            [now - at, base64.b64encode(message).decode()]
            for at, message in list(self._messages)
            if now - at <= KEPT_FOR_S
        ]
        query.reply(json.dumps(found).encode())
