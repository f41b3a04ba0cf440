"""A node keeps nothing of what it destroys, however much comes and goes."""

from __future__ import annotations

from mrlab_msgs.srv import Trigger
from std_msgs.msg import String

from mrlab_ros.messages import qos
from mrlab_ros.ros.node import HiddenNode


def test_a_node_keeps_no_reference_to_what_it_destroyed(graph):
    node = HiddenNode("_short_lived", graph.client.context)
    try:
        entities = node.default_callback_group.entities
        kept = node.create_subscription(String, "kept", lambda _: None, qos.STREAM)
        before = len(entities)
        for number in range(5):
            node.destroy_subscription(
                node.create_subscription(String, f"a{number}", lambda _: None, qos.STREAM)
            )
            node.destroy_client(node.create_client(Trigger, f"b{number}"))
        assert len(entities) == before
        assert node.default_callback_group.has_entity(kept)
    finally:
        node.destroy_node()


def test_a_node_handles_no_events_that_would_be_under_way_as_it_leaves(graph):
    """The events executor runs Python without its lock then: 139 within 150 nodes."""
    node = HiddenNode("_short_lived", graph.client.context)
    try:
        assert node.create_publisher(String, "a", qos.STREAM).event_handlers == []
        assert node.create_subscription(String, "a", print, qos.STREAM).event_handlers == []
    finally:
        node.destroy_node()
