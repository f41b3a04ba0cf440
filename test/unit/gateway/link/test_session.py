"""A client's session at random: what it must get arrives, whatever happens to its sockets."""

from __future__ import annotations

import asyncio

import pytest
from fake_lab import FakeLab
from hypothesis import settings
from hypothesis import strategies as st
from hypothesis.stateful import RuleBasedStateMachine, invariant, rule
from link_side import Decoder

from mrlab_ros.core.bridge.rules import Role, parse
from mrlab_ros.gateway.link.frames import RecordKind
from mrlab_ros.gateway.link.hub import Hub
from mrlab_ros.gateway.link.limits import Budget, LinkLimits
from mrlab_ros.gateway.link.session import BATCHES, LARGE, LinkSession
from mrlab_ros.gateway.link.visibility import Visibility
from mrlab_ros.gateway.people.person import Person

RULES = parse(
    {
        "topics": [
            {"name": "/*/joint_states", "congestion": "drop", "type": "x/msg/Joints"},
            {"name": "/*/playback_state", "congestion": "drop", "type": "x/msg/State"},
            {"name": "/objects", "congestion": "drop", "type": "x/msg/Objects"},
            {"name": "/events", "congestion": "block", "type": "x/msg/Event"},
        ]
    }
)
LATCHED = {"a/playback_state", "b/playback_state", "objects"}
KEYS = ("a/joint_states", "b/joint_states", "events", *sorted(LATCHED))
EXPRESSIONS = (*KEYS, "*/joint_states", "secret")


class Walk(RuleBasedStateMachine):
    """A lab that publishes, a client that subscribes, reads late, freezes and comes back."""

    def __init__(self) -> None:
        super().__init__()
        self.loop = asyncio.new_event_loop()
        asyncio.set_event_loop(self.loop)
        self.lab = FakeLab()
        for key in KEYS:
            self.lab.offer(key, "x/msg/Any", latched=key in LATCHED)
        self.budget = Budget(LinkLimits())
        self.hub = self.run(self.made())
        self.session = LinkSession(
            "token",
            Person("Pat", Role.OPERATOR),
            self.hub,
            Visibility(self.lab.definitions),
            lambda person, verb, expression: expression != "secret",
            self.budget,
        )
        self.client = Decoder()
        self.under_way: list[bytes | str] = []
        self.wanted: dict[int, str] = {}
        self.granted = 0
        self.count = 0
        # What the client must get: of each key the newest, of events all, of requests an answer.
        self.newest: dict[str, int] = {}
        self.events: list[int] = []
        self.asked: list[int] = []

    async def made(self) -> Hub:
        return Hub(self.lab, RULES)

    def run(self, work):
        return self.loop.run_until_complete(work)

    def settle(self) -> None:
        self.run(asyncio.sleep(0))
        self.run(asyncio.sleep(0))

    def follows(self, key: str) -> bool:
        return any(self.covers(expression, key) for expression in self.wanted.values())

    @staticmethod
    def covers(expression: str, key: str) -> bool:
        ours, theirs = expression.split("/"), key.split("/")
        return len(ours) == len(theirs) and all(
            a in ("*", b) for a, b in zip(ours, theirs, strict=True)
        )

    # the lab ----------------------------------------------------------------------------------

    @rule(key=st.sampled_from(KEYS), large=st.booleans())
    def publish(self, key: str, large: bool) -> None:
        self.count += 1
        size = LARGE + 8 if large else 16
        self.lab.publish(key, self.count.to_bytes(8, "little") + bytes(size))
        if key in LATCHED or self.follows(key):
            self.newest[key] = self.count
        if key == "events" and self.follows(key):
            self.events.append(self.count)

    @rule()
    def answer(self) -> None:
        self.count += 1
        if self.session.is_new(self.count):
            self.asked.append(self.count)
            self.session.respond(self.count, b"answer")
        assert not self.session.is_new(self.count)

    # the client -------------------------------------------------------------------------------

    @rule(number=st.integers(1, 4), expression=st.sampled_from(EXPRESSIONS))
    def subscribe(self, number: int, expression: str) -> None:
        async def work() -> None:
            self.session.subscribe(number, expression)

        before = {key for key in KEYS if self.follows(key)}
        self.run(work())
        self.settle()
        self.wanted.pop(number, None)
        if expression != "secret":
            self.wanted[number] = expression
        self.forget(before)

    @rule(number=st.integers(1, 4))
    def unsubscribe(self, number: int) -> None:
        before = {key for key in KEYS if self.follows(key)}
        self.session.unsubscribe(number)
        self.wanted.pop(number, None)
        self.forget(before)

    def forget(self, before: set[str]) -> None:
        """Expect no more of a stream that was given up, until it comes anew."""
        for key in before - {key for key in KEYS if self.follows(key)} - LATCHED:
            self.newest.pop(key, None)

    @rule(frames=st.integers(1, 6))
    def send(self, frames: int) -> None:
        for _ in range(frames):
            frame = self.session.next_frame()
            if frame is not None:
                self.under_way.append(frame)

    @rule(frames=st.integers(1, 6))
    def read(self, frames: int) -> None:
        for _ in range(min(frames, len(self.under_way))):
            frame = self.under_way.pop(0)
            if isinstance(frame, str):
                self.client.take_text(frame)
            else:
                self.client.take_bytes(frame)

    @rule(ahead=st.integers(1, BATCHES))
    def grant(self, ahead: int) -> None:
        self.granted = max(self.granted, len(self.client.batches) + ahead)
        self.session.grant(self.granted)

    @rule()
    def acknowledge(self) -> None:
        self.session.acknowledge(self.client.received)

    @rule()
    def reconnect(self) -> None:
        """Lose what is under way, with the socket."""
        self.under_way.clear()
        self.client.batches.clear()
        self.granted = 0
        self.run(self.session.attach(self.client.received, dict(self.wanted)))
        self.settle()

    # what always holds ------------------------------------------------------------------------

    @invariant()
    def the_budget_counts_what_waits(self) -> None:
        assert self.budget.queued == self.session.size
        assert self.session.failed is None

    @invariant()
    def batches_are_granted_and_numbered(self) -> None:
        assert self.client.batches == list(range(1, len(self.client.batches) + 1))
        assert len(self.client.batches) <= self.granted

    @invariant()
    def events_and_answers_come_once_and_in_order(self) -> None:
        assert self.got_events() == self.events[: len(self.got_events())]
        answers = [about for kind, about, _ in self.client.records if kind == RecordKind.RESPONSE]
        assert answers == self.asked[: len(answers)]

    def got_events(self) -> list[int]:
        return [
            int.from_bytes(payload[:8], "little")
            for kind, about, payload in self.client.records
            if kind == RecordKind.MESSAGE and self.client.topics[about]["key"] == "events"
        ]

    def teardown(self) -> None:
        for _ in range(200):
            self.grant(BATCHES)
            self.send(6)
            self.read(6)
            self.acknowledge()
        shown = {key: number for key, number in self.shown().items() if self.follows(key)}
        expected = {
            key: number
            for key, number in self.newest.items()
            if self.follows(key) and key != "events"
        }
        assert {key: shown.get(key) for key in expected} == expected
        assert self.got_events() == self.events
        assert sum(kind == RecordKind.RESPONSE for kind, _, _ in self.client.records) == len(
            self.asked
        )
        self.session.close()
        self.hub.close()
        assert self.budget.queued == 0
        self.loop.close()

    def shown(self) -> dict[str, int]:
        """Return by key what the client has last."""
        return {key: int.from_bytes(payload[:8], "little") for key, payload in self.client.came}


TestWalk = Walk.TestCase
TestWalk.settings = settings(max_examples=30, stateful_step_count=40, deadline=None)
pytestmark = pytest.mark.fast
