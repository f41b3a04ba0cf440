"""The gateway's connection to a lab, against a bridge-like zenoh session."""

from __future__ import annotations

import asyncio
import json
from collections.abc import Callable

from own_port import free_endpoint
from refusals import refused

from mrlab_ros.adapters.zenoh.configuration import configuration
from mrlab_ros.adapters.zenoh.port import Publisher, Query
from mrlab_ros.adapters.zenoh.session import ZenohSession
from mrlab_ros.core.bridge.latency import attachment
from mrlab_ros.core.bridge.rules import (
    Direction,
    TopicQos,
    TopicRule,
    bridge_token,
    service_token,
    topic_token,
)
from mrlab_ros.gateway.lab.connection import NoAnswer, Phase, Refused, Sample
from mrlab_ros.gateway.lab.definitions import Definitions, installed_definitions
from mrlab_ros.gateway.lab.diagnostics import LAB_UNCONNECTED, NOBODY_ANSWERS, UNKNOWN_TYPE
from mrlab_ros.gateway.lab.zenoh_lab import ZenohLab
from mrlab_ros.gateway.link.diagnostics import CALLS_FULL

TRIGGER = "mrlab_msgs/srv/Trigger"
TRIGGER_TEXT = "---\nbool success\nstring message\n"

LATCHED = TopicQos(reliable=True, latched=True, depth=1)


class Bridge:
    """A session that shows itself as the bridge does; declared things live while it holds them."""

    def __init__(self, endpoint: str, prefix: str) -> None:
        self.session = ZenohSession(configuration(listen=(endpoint,)))
        self.prefix = prefix
        self.held = [self.session.token(bridge_token(self.session.zid))]

    def close(self) -> None:
        """End the session: left open, it would keep the whole test run from ending."""
        self.session.close()

    def topic(self, key: str, type_name: str, history: int = 1) -> Publisher:
        key, zid = f"{self.prefix}/{key}", self.session.zid
        self.held.append(
            self.session.token(topic_token(zid, Direction.OUT, key, type_name, LATCHED))
        )
        return self.session.publisher(key, TopicRule(name=f"/{key}"), history)

    def schema(self, messages: dict[str, str]) -> None:
        services = {TRIGGER: TRIGGER_TEXT}
        document = json.dumps({"messages": messages, "services": services}).encode()
        key = f"{self.prefix}/schema"
        self.held.append(self.session.queryable(key, lambda query: query.reply(document)))

    def service(self, key: str, type_name: str, answer: Callable[[Query], None]) -> None:
        key, zid = f"{self.prefix}/{key}", self.session.zid
        self.held.append(self.session.token(service_token(zid, key, type_name)))
        self.held.append(self.session.queryable(key, answer))


async def until(condition: Callable[[], object]) -> None:
    async def poll() -> None:
        while not condition():
            await asyncio.sleep(0.01)

    await asyncio.wait_for(poll(), 20)


def test_topics_services_and_presence() -> None:
    prefix = "campus/lab_1"

    async def scenario() -> None:
        endpoint, definitions = free_endpoint(), installed_definitions()
        config = configuration(mode="client", listen=(), connect=(endpoint,))
        lab = ZenohLab(config, Definitions({}), prefix)
        got: list[Sample] = []
        lab.subscribe("robots", got.append)
        await lab.open()
        assert lab.phase is Phase.CONNECTING
        with refused(LAB_UNCONNECTED, NoAnswer):
            await lab.call("a/play", TRIGGER)

        bridge = Bridge(endpoint, prefix)
        try:
            bridge.schema({"mrlab_msgs/msg/Fix": "string option\nstring value\n"})
            robots = bridge.topic("robots", "mrlab_msgs/msg/Robots")
            done = definitions.encode(f"{TRIGGER}_Response", {"success": True})
            bridge.service("a/play", TRIGGER, lambda query: query.reply(done))
            bridge.service("b/play", TRIGGER, lambda query: query.refuse(CALLS_FULL()))
            await until(lambda: lab.phase is Phase.OPEN and "b/play" in lab.keys.services)
            await until(lambda: lab.keys.latched == {"robots"})
            await until(lambda: "mrlab_msgs/msg/Fix" in lab.definitions.store.fielddefs)

            assert (await lab.call("a/play", TRIGGER)).success
            full = UNKNOWN_TYPE(type="é/x")
            bridge.service("d/play", TRIGGER, lambda query: query.refuse(full))
            with refused(CALLS_FULL, Refused):
                await lab.call("b/play", TRIGGER)
            await until(lambda: "d/play" in lab.keys.services)
            with refused(UNKNOWN_TYPE, Refused, type="é/x") as caught:
                await lab.call("d/play", TRIGGER)
            assert str(caught.value) == str(full)
            with refused(NOBODY_ANSWERS, NoAnswer, key="c/play"):
                await lab.call("c/play", TRIGGER, timeout_s=2.0)

            robots.put(definitions.encode("mrlab_msgs/msg/Robots", {}), attachment(7, 8, 9))
            await until(lambda: got)
            assert (got[0].key, got[0].sequence, got[0].published_ns) == ("robots", 7, 8)
            newest = await lab.get("robots")
            assert newest is not None
            assert newest.sequence == 7

            # Each publisher's state counts, and a plain get returns the newest all the same.
            frames = bridge.topic("tf_static", "tf2_msgs/msg/TFMessage", history=3)
            for number in range(1, 6):
                frames.put(
                    definitions.encode("tf2_msgs/msg/TFMessage", {}), attachment(number, 8, 9)
                )
            kept = await lab.get_all("tf_static")
            assert [sample.sequence for sample in kept] == [3, 4, 5]
            newest = await lab.get("tf_static")
            assert newest is not None
            assert newest.sequence == 5

            bridge.close()
            await until(lambda: lab.phase is Phase.LOST)
            assert not lab.keys.services
        finally:
            await lab.close()
            bridge.close()

    asyncio.run(scenario())
