"""A thread that waits for changes of a real graph."""

from __future__ import annotations

import pytest
from graph import wait_for
from rclpy.node import Node
from std_msgs.msg import String

from mrlab_ros.messages import qos
from mrlab_ros.ros.graph_changes import GraphChanges


@pytest.fixture
def watch(graph):
    """Return a function that starts a watch with the wait that its turns ask for."""
    made = []
    node = Node("watcher", context=graph.context)

    def start(wait):
        turns = []

        def turn(changed):
            turns.append(changed)
            return wait

        made.append(GraphChanges(node, "test", turn))
        return made[-1], turns

    yield start
    for each in made:
        each.close()
    node.destroy_node()


def test_a_new_topic_is_a_change_and_its_end_another(graph, watch):
    _, turns = watch(60.0)
    publisher = graph.client.create_publisher(String, "new", qos.STREAM)
    wait_for(lambda: True in turns, "the new topic")
    graph.client.destroy_publisher(publisher)
    del turns[:]
    graph.client.create_publisher(String, "newer", qos.STREAM)
    wait_for(lambda: True in turns, "the next one")


def test_who_wakes_it_gets_a_turn_without_waiting(watch):
    changes, turns = watch(60.0)
    wait_for(lambda: turns, "the first turn")
    for _ in range(50):
        del turns[:]
        changes.wake()
        wait_for(lambda: turns, "a turn")


def test_turns_come_as_often_as_they_ask_for(watch):
    _, turns = watch(0.001)
    wait_for(lambda: len(turns) > 20, "turns")
