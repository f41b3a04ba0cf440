"""Subscriptions whose messages are decoded here, so that foreign bytes break no view.

rclpy raises an error without a topic where a message cannot be decoded, in the middle of an
executor. What cannot be decoded is counted by topic, and said once a minute with its publishers.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from threading import Lock
from typing import TYPE_CHECKING, Any

from rclpy.serialization import deserialize_message

from mrlab_ros.core.base.diagnostic import Diagnostic
from mrlab_ros.core.runtime.bucket import Occurrences
from mrlab_ros.core.runtime.diagnostics import UNDECODABLE

if TYPE_CHECKING:
    from rclpy.node import Node
    from rclpy.qos import QoSProfile
    from rclpy.subscription import Subscription

Callback = Callable[[Any], None]

# How rmw calls a node that it has not discovered yet.
UNKNOWN = "_NODE_NAME_UNKNOWN_"

_undecoded = Occurrences()
_lock = Lock()


def subscribe(
    node: Node,
    kind: Any,
    topic: str,
    callback: Callback,
    quality: QoSProfile | int,
    **options: Any,
) -> Subscription:
    """Create a subscription as the node does; what cannot be decoded is counted and dropped."""
    decode = decoder(kind, node.resolve_topic_name(topic), callback, node)
    return node.create_subscription(kind, topic, decode, quality, raw=True, **options)


def decoder(
    kind: Any, topic: str, callback: Callback, node: Node | None = None
) -> Callable[[bytes], None]:
    """Return what decodes CDR for `callback`.

    node: logs what cannot be decoded, once a minute, and knows who publishes it; None: a command,
    which shows undecoded().
    """
    type_name = f"{kind.__module__.split('.')[0]}/{kind.__name__}"

    def take(data: bytes) -> None:
        try:
            message = deserialize_message(data, kind)
        # rmw's error is a RuntimeError, a text that is no UTF-8 a ValueError.
        except (RuntimeError, ValueError, MemoryError):
            ends = [] if node is None else node.get_publishers_info_by_topic(topic)
            cause = (
                topic,
                type_name,
                *sorted({_name(end) for end in ends if end.node_name != UNKNOWN}),
            )
            with _lock:
                count = _undecoded.again(cause, time.monotonic())
            if count is not None and node is not None:
                node.get_logger().warning(str(_said(cause, count)))
            return
        callback(message)

    return take


def undecoded() -> list[Diagnostic]:
    """Return what could not be decoded in this process, of each topic that had such lately."""
    with _lock:
        totals = _undecoded.lately(time.monotonic())
    return [_said(cause, count) for cause, count in totals.items()]


def _name(end: Any) -> str:
    return f"{end.node_namespace.rstrip('/')}/{end.node_name}"


def _said(cause: tuple[str, ...], count: int) -> Diagnostic:
    topic, type_name, *ends = cause
    return UNDECODABLE(topic=topic, type=type_name, count=count, publishers=ends or None)
