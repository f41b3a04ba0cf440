from __future__ import annotations

import pytest

from mrlab_ros.core.bridge.rules import (
    Direction,
    TopicQos,
    bridge_token,
    service_token,
    topic_token,
)
from mrlab_ros.gateway.lab.connection import TokenTable

pytestmark = pytest.mark.fast

LATCHED = TopicQos(reliable=True, latched=True, depth=1)
STREAM = TopicQos(reliable=True, latched=False, depth=10)


def test_tokens_say_what_the_lab_offers() -> None:
    table = TokenTable("")
    table.add(bridge_token("a1"))
    table.add(topic_token("a1", Direction.OUT, "robots", "mrlab_msgs/msg/Robots", LATCHED))
    stream = topic_token(
        "a1", Direction.OUT, "ur5e_1/joint_states", "sensor_msgs/msg/JointState", STREAM
    )
    table.add(stream)
    table.add(topic_token("a1", Direction.IN, "latency/clients", "mrlab_msgs/msg/Latency", STREAM))
    table.add(service_token("a1", "ur5e_1/play", "mrlab_msgs/srv/Trigger"))
    keys = table.keys()
    assert table.has_bridge
    assert dict(keys.topics) == {
        "robots": "mrlab_msgs/msg/Robots",
        "ur5e_1/joint_states": "sensor_msgs/msg/JointState",
    }
    assert dict(keys.services) == {"ur5e_1/play": "mrlab_msgs/srv/Trigger"}
    assert keys.latched == {"robots"}
    table.remove(stream)
    assert "ur5e_1/joint_states" not in table.keys().topics


def test_only_keys_below_the_prefix_count() -> None:
    table = TokenTable("campus/lab_1")
    table.add(bridge_token("b2"))
    table.add(service_token("b2", "campus/lab_2/robots", "mrlab_msgs/srv/Trigger"))
    assert not table.has_bridge
    table.add(service_token("b1", "campus/lab_1/converter/list", "mrlab_msgs/srv/Trigger"))
    assert table.has_bridge
    assert list(table.keys().services) == ["converter/list"]


def test_a_token_of_another_kind_is_left_out() -> None:
    table = TokenTable("")
    table.add("@/a1/@ros2_lv/XX/some§key/some§type")
    table.add("@/a1/@ros2_lv/MP/short")
    assert not table.keys().topics
