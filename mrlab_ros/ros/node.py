"""The nodes of the lab: they keep nothing of what they destroy, and parts of one may be hidden."""

from __future__ import annotations

import weakref
from typing import Any

from rclpy.context import Context
from rclpy.event_handler import PublisherEventCallbacks, SubscriptionEventCallbacks
from rclpy.node import Node
from rclpy.publisher import Publisher
from rclpy.subscription import Subscription


class _Living(set[Any]):
    """Weak references, each of which is discarded with what it refers to.

    rclpy's callback groups keep them: a node that subscribes for each robot that comes and goes
    would have one for each that ever was.
    """

    def add(self, reference: weakref.ref[Any]) -> None:
        entity = reference()
        if entity is not None:
            super().add(weakref.ref(entity, self.discard))


class LeanNode(Node):
    """A node that may leave while its process goes on, and keeps nothing of what it destroys.

    It handles no events, such as incompatible qualities of service, unless it is asked to: with
    one under way as a node leaves the events executor, that runs Python without the interpreter's
    lock, and the process crashes. Tools of ROS warn on their own side.
    """

    def __init__(self, name: str, **ros: Any) -> None:
        super().__init__(name, **ros)
        group = self.default_callback_group
        earlier, group.entities = group.entities, _Living()
        for reference in earlier:
            group.entities.add(reference)

    def create_publisher(self, *args: Any, **more: Any) -> Publisher:
        more.setdefault("event_callbacks", PublisherEventCallbacks(use_default_callbacks=False))
        return super().create_publisher(*args, **more)

    def create_subscription(self, *args: Any, **more: Any) -> Subscription:
        more.setdefault("event_callbacks", SubscriptionEventCallbacks(use_default_callbacks=False))
        return super().create_subscription(*args, **more)


class HiddenNode(LeanNode):
    """A node without parameters and log, for a part of a process; its name begins with `_`.

    remapped: the names that the process was started with apply to it.
    """

    def __init__(self, name: str, context: Context | None, *, remapped: bool = False) -> None:
        super().__init__(
            name,
            context=context,
            start_parameter_services=False,
            enable_rosout=False,
            use_global_arguments=remapped,
        )
