"""The parameter use_sim_time: /clock drives playback and systems."""

from __future__ import annotations

from collections.abc import Callable

import pytest
import small_lab
from graph import Graph, wait_for
from mrlab_msgs import msg
from mrlab_msgs.srv import Trigger
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import JointState
from small_lab import listen_state, make_system, spawn

from mrlab_ros.core.base.clock import SECOND
from mrlab_ros.messages import qos
from mrlab_ros.messages.time import time_from_message, time_to_message

Tick = Callable[[int], None]


@pytest.fixture
def tick(graph: Graph) -> Tick:
    """Publish a time, ns, on /clock."""
    clock = graph.client.create_publisher(Clock, "/clock", 10)
    # A short motion, which a system stages and plays by the clock alone.
    small_lab.start(graph, use_sim_time=True)
    wait_for(lambda: clock.get_subscription_count() >= 2, "the nodes that follow /clock")
    return lambda now_ns: clock.publish(Clock(clock=time_to_message(now_ns)))


def test_clock_drives_a_system_at_its_own_rate_and_pauses_it(graph: Graph, tick: Tick) -> None:
    robot = spawn(graph)
    states = listen_state(graph, robot)
    joints = graph.listen(JointState, f"/{robot}/joint_states", qos.STREAM)
    systems = graph.listen(msg.RobotSystems, "/systems", qos.EVENTS)
    now = 1000 * SECOND
    tick(now)
    assert make_system(graph, {robot: "wave"}).success
    answer = graph.call(Trigger, "/cell/play")
    assert answer.success, answer.message

    def label() -> str:
        return systems[-1].systems[0].label if systems and systems[-1].systems else ""

    assert wait_for(lambda: label() == "STAGING", "the staging")
    # No time passes without /clock: what is under way stands.
    count = len(joints)

    def go_on() -> bool:
        nonlocal now
        now += SECOND // 50
        tick(now)
        return label() == "READY"

    wait_for(go_on, "the end")
    played = [s for s in states if s.label == "PLAYING"]
    start = time_from_message(played[0].clock.stamp)
    assert 1000 * SECOND < start < now
    stamps = [time_from_message(j.header.stamp) for j in joints[count:]]
    frames = [stamp for stamp in stamps if start <= stamp <= start + 590_000_000]
    assert [stamp - start for stamp in frames][:60] == [i * 10_000_000 for i in range(60)]
