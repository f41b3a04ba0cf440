"""The nodes of the lab: they keep nothing of what they destroy, and parts of one may be hidden."""

from __future__ import annotations

import weakref
from typing import Any

from rclpy.context import Context
from rclpy.node import Node


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
    """A node whose memory does not grow with what is created and destroyed."""

    def __init__(self, name: str, **ros: Any) -> None:
        super().__init__(name, **ros)
        group = self.default_callback_group
        earlier, group.entities = group.entities, _Living()
        for reference in earlier:
            group.entities.add(reference)


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
