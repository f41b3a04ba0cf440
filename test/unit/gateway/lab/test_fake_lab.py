from __future__ import annotations

import asyncio

import pytest
from fake_lab import FakeLab
from refusals import refused

from mrlab_ros.gateway.lab.connection import NoAnswer, Phase, Refused, Sample
from mrlab_ros.gateway.lab.diagnostics import CALL_TIMED_OUT, NOBODY_ANSWERS

pytestmark = pytest.mark.fast


def test_messages_reach_those_who_subscribed() -> None:
    lab = FakeLab()
    lab.offer("ur5e_1/joint_states", "sensor_msgs/msg/JointState")
    got: list[Sample] = []
    unsubscribe = lab.subscribe("*/joint_states", got.append)
    lab.publish("ur5e_1/joint_states", {"name": ["a"], "position": [1.0]})
    unsubscribe()
    lab.publish("ur5e_1/joint_states", {})
    (sample,) = got
    assert sample.sequence == 1
    read = lab.definitions.decode("sensor_msgs/msg/JointState", sample.payload)
    assert list(read.position) == [1.0]


def test_the_newest_of_a_latched_topic_is_kept() -> None:
    lab = FakeLab()
    lab.offer("robots", "mrlab_msgs/msg/Robots", latched=True)
    assert asyncio.run(lab.get("robots")) is None
    lab.publish("robots", {})
    lab.publish("robots", {"robots": [{"name": "a"}]})
    sample = asyncio.run(lab.get("robots"))
    assert sample is not None
    assert sample.sequence == 2


def test_services_answer_refuse_or_are_missing() -> None:
    lab = FakeLab()
    lab.serve("a/play", "mrlab_msgs/srv/Trigger", lambda request: {"success": True})

    def refuse(request: object) -> dict[str, object]:
        raise Refused("not now")

    lab.serve("b/play", "mrlab_msgs/srv/Trigger", refuse)
    assert asyncio.run(lab.call("a/play", "mrlab_msgs/srv/Trigger")).success
    with pytest.raises(Refused, match="not now"):
        asyncio.run(lab.call("b/play", "mrlab_msgs/srv/Trigger"))
    with refused(NOBODY_ANSWERS, NoAnswer, key="c/play"):
        asyncio.run(lab.call("c/play", "mrlab_msgs/srv/Trigger"))
    assert [service for service, _ in lab.calls] == ["a/play", "b/play"]


def test_a_held_service_times_out() -> None:
    async def scenario() -> None:
        lab = FakeLab()
        lab.serve("a/play", "mrlab_msgs/srv/Trigger", lambda request: {"success": True})
        release = lab.hold("a/play")
        with refused(CALL_TIMED_OUT, NoAnswer):
            await lab.call("a/play", "mrlab_msgs/srv/Trigger", timeout_s=0.0)
        release()
        assert (await lab.call("a/play", "mrlab_msgs/srv/Trigger")).success

    asyncio.run(scenario())


def test_a_lost_lab_offers_nothing() -> None:
    lab = FakeLab()
    lab.offer("robots", "mrlab_msgs/msg/Robots")
    changes: list[Phase] = []
    lab.on_change(lambda: changes.append(lab.phase))
    lab.set_phase(Phase.LOST)
    assert changes == [Phase.LOST]
    assert not lab.keys.topics
