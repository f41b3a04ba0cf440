"""One subscription to the lab for all clients, and the newest message of latched topics."""

from __future__ import annotations

import asyncio
import logging
from collections import deque
from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from functools import partial
from itertools import groupby
from math import nan
from operator import attrgetter
from typing import Any, Protocol

from mrlab_ros.core.base.errors import LabError
from mrlab_ros.core.bridge.rules import Congestion, Direction, Rules, TopicRule
from mrlab_ros.gateway.lab.connection import LabConnection, Phase, Sample, Unsubscribe, matches
from mrlab_ros.gateway.link import frames, presence

SECOND = 1_000_000_000
log = logging.getLogger("mrlab.gateway")


@dataclass(slots=True, eq=False)
class Topic:
    """A topic of the lab as its clients know it.

    id: its number on every socket of this gateway. each: each message counts; otherwise the newest
    alone. history: of a latched topic the newest messages that late joiners get.
    """

    id: int
    key: str
    type: str
    priority: int
    latched: bool
    each: bool
    history: deque[Message]
    # What clients are told of it, as JSON.
    facts: dict[str, Any] = field(init=False)

    def __post_init__(self) -> None:
        named = ("id", "key", "type", "latched", "each")
        self.facts = {"op": "topic", **{name: getattr(self, name) for name in named}}


@dataclass(slots=True, eq=False)
class Message:
    """A message on its way; it is encoded once for all clients."""

    topic: Topic
    sample: Sample
    entry: bytes = field(default=b"")

    @property
    def stream(self) -> int | tuple[int, str]:
        """Return the topic, or display's presence, whose older message a newer one replaces."""
        if self.topic.key != presence.KEY:
            return self.topic.id
        return self.topic.id, presence.display(self.sample.payload)

    @property
    def stamp(self) -> float:
        published = self.sample.published_ns
        return published / SECOND if published else nan

    def with_payload(self, payload: bytes) -> Message:
        """Return the message with another payload."""
        return Message(self.topic, replace(self.sample, payload=payload))

    def encoded(self) -> bytes:
        """Return the message as it stands in a batch."""
        if not self.entry:
            sample = self.sample
            self.entry = frames.entry(self.topic.id, self.stamp, sample.sequence, sample.payload)
        return self.entry


class Target(Protocol):
    """A receiver of messages of topics."""

    def take(self, message: Message) -> None: ...


@dataclass(eq=False)
class _Feed:
    """The subscription for one rule; there is one while somebody wants its topics."""

    expression: str
    rule: TopicRule
    end: Unsubscribe
    wanted: int = 0


class Hub:
    """Connects clients with the lab, in the gateway's event loop."""

    def __init__(self, lab: LabConnection, rules: Rules) -> None:
        self._lab = lab
        self._rules = [
            rule
            for rule in rules.topics
            if rule.direction is Direction.OUT or rule.name[1:] in presence.SHARED
        ]
        self._feeds: dict[str, _Feed] = {}
        self._topics: dict[str, Topic] = {}
        self._numbers: dict[str, int] = {}
        self._targets: dict[object, tuple[str, Target]] = {}
        # By key: who gets its messages. Computed at the first message after a change.
        self._routes: dict[str, tuple[Target, ...]] = {}
        self._latched: frozenset[str] = frozenset()
        self._tasks: set[asyncio.Task[None]] = set()
        self._stop = lab.on_change(self._on_change)

    def close(self) -> None:
        """End all subscriptions."""
        self._stop()
        for feed in self._feeds.values():
            feed.end()
        self._feeds.clear()
        for task in self._tasks:
            task.cancel()

    def subscribe(self, expression: str, target: Target) -> Unsubscribe:
        """Let `target` take the messages of a key expression, latched ones from before first."""
        entry = object()
        self._targets[entry] = expression, target
        self._routes.clear()
        feeds = [self._feed(rule) for rule in self._fitting(expression)]
        for feed in feeds:
            feed.wanted += 1
        self.replay(expression, target, each=True)

        def unsubscribe() -> None:
            del self._targets[entry]
            self._routes.clear()
            for feed in feeds:
                feed.wanted -= 1
                if not feed.wanted:
                    self._end(feed)

        return unsubscribe

    def replay(self, expression: str, target: Target, *, each: bool) -> None:
        """Give the newest messages of latched topics of an expression once more.

        each: also those of topics of which each message counts, such as tf_static.
        """
        for topic in list(self._topics.values()):
            wanted = topic.latched and (each or not topic.each)
            if wanted and matches(expression, topic.key):
                for message in topic.history:
                    target.take(message)

    def _fitting(self, expression: str) -> Iterator[TopicRule]:
        for rule in self._rules:
            if rule.pattern.fullmatch(f"/{expression}") or matches(expression, rule.name[1:]):
                yield rule

    def _feed(self, rule: TopicRule) -> _Feed:
        expression = rule.name[1:]
        feed = self._feeds.get(expression)
        if feed is None:
            end = self._lab.subscribe(expression, partial(self._on_sample, rule))
            feed = self._feeds[expression] = _Feed(expression, rule, end)
            self._fetch(expression, rule)
        return feed

    def _end(self, feed: _Feed) -> None:
        del self._feeds[feed.expression]
        feed.end()
        for key in [key for key in self._topics if matches(feed.expression, key)]:
            del self._topics[key]

    def _on_sample(self, rule: TopicRule, sample: Sample) -> None:
        key = sample.key
        topic = self._topics.get(key) or self._new_topic(rule, key)
        message = Message(topic, sample)
        if topic.latched:
            topic.history.append(message)
        routes = self._routes.get(key)
        if routes is None:
            wanting = [
                target for pattern, target in self._targets.values() if matches(pattern, key)
            ]
            routes = self._routes[key] = tuple(dict.fromkeys(wanting))
        for target in routes:
            target.take(message)

    def _new_topic(self, rule: TopicRule, key: str) -> Topic:
        latched = key in self._lab.keys.latched
        each = rule.congestion is Congestion.BLOCK and (not latched or rule.history > 1)
        number = self._numbers.setdefault(key, len(self._numbers) + 1)
        topic = Topic(
            number,
            key,
            self._lab.keys.topics.get(key, rule.type),
            rule.priority,
            latched,
            each,
            deque(maxlen=rule.history),
        )
        self._topics[key] = topic
        return topic

    def _fetch(self, expression: str, rule: TopicRule) -> None:
        """Get the newest messages of the latched topics of an expression."""
        if self._lab.phase is not Phase.OPEN:
            return

        async def fetch() -> None:
            try:
                samples = await self._lab.get_all(expression)
            except LabError as error:
                log.warning("the newest messages of %s are missing: %s", expression, error)
                return
            if expression in self._feeds:
                for key, kept in groupby(samples, key=attrgetter("key")):
                    self._on_history(rule, key, list(kept))

        task = asyncio.get_running_loop().create_task(fetch())
        self._tasks.add(task)
        task.add_done_callback(self._tasks.discard)

    def _on_history(self, rule: TopicRule, key: str, kept: list[Sample]) -> None:
        """Take what a latched topic keeps, oldest first; newer messages may be here already."""
        topic = self._topics.get(key)
        known = {message.sample.sequence for message in topic.history} if topic else set()
        missed = [sample for sample in kept if sample.sequence not in known]
        if topic is not None and known and rule.history > 1:
            # All once more in their order: an older message must not replace a newer one.
            missed += [message.sample for message in topic.history]
            missed.sort(key=attrgetter("sequence"))
            topic.history.clear()
        elif known:
            missed = [sample for sample in missed if sample.sequence > max(known)]
        for sample in missed:
            self._on_sample(rule, sample)

    def _on_change(self) -> None:
        """Forget topics that have gone; fetch what latched ones say that are new."""
        keys = self._lab.keys
        for key in [key for key in self._topics if key not in keys.topics]:
            del self._topics[key]
        for key, topic in list(self._topics.items()):
            if topic.latched != (key in keys.latched):
                # Its first message came before its token.
                del self._topics[key]
        fresh, self._latched = keys.latched - self._latched, keys.latched
        for feed in list(self._feeds.values()):
            if any(matches(feed.expression, key) for key in fresh):
                self._fetch(feed.expression, feed.rule)
