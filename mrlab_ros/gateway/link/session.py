"""State of one client across its sockets: subscriptions, queues, calls."""

from __future__ import annotations

import asyncio
from collections import OrderedDict, deque
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

import orjson

from mrlab_ros.core.base.diagnostic import Diagnostic, plain
from mrlab_ros.core.bridge.access import Verb
from mrlab_ros.gateway.lab.connection import Unsubscribe
from mrlab_ros.gateway.link import frames
from mrlab_ros.gateway.link.diagnostics import (
    CALLS_FULL,
    NO_TOPIC_OF_PAGES,
    SUBSCRIPTIONS_FULL,
    TEXTS_WAIT,
)
from mrlab_ros.gateway.link.frames import RecordKind
from mrlab_ros.gateway.link.hub import Hub, Message, Topic
from mrlab_ros.gateway.link.limits import Budget, Credit
from mrlab_ros.gateway.link.queues import Newest, Overflow, ReliableSender
from mrlab_ros.gateway.link.visibility import Visibility
from mrlab_ros.gateway.people.person import Person

# Bytes of a batch. A larger message goes in pieces by the lossless channel, so that it delays
# nothing else on a slow link.
BATCH = 16 * 1024
LARGE = 8 * 1024
# Batches under way, at most, however much credit a client gives.
BATCHES = 8
SUBSCRIPTIONS = 256
# Bytes of text frames that wait for a client which does not read; it comes back and catches up.
MOST_TEXTS = 128 * 1024
# Requests whose numbers are remembered, to do none twice.
REQUESTS = 4096

May = Callable[[Person, Verb, str], bool]


@dataclass
class Subscription:
    """A client's subscription; end: undoes it."""

    expression: str
    end: Unsubscribe


class LinkSession:
    """One client. A new socket goes on with what the last one left.

    wake: called when there may be something to send.
    """

    def __init__(
        self,
        token: str,
        person: Person,
        hub: Hub,
        visibility: Visibility,
        may: May,
        budget: Budget,
    ) -> None:
        self.token = token
        self.person = person
        self.budget = budget
        self.wake: Callable[[], None] = _nothing
        self.failed: Diagnostic | None = None
        self._hub = hub
        self._visibility = visibility
        self._may = may
        self._subscriptions: dict[int, Subscription] = {}
        self._newest = Newest()
        self._large: dict[int, Message] = {}
        # Topics with messages in the lossless channel that may be unacknowledged.
        self._in_pieces: set[int] = set()
        self._reliable = ReliableSender(budget)
        self._credit = Credit(BATCHES)
        self._texts: deque[bytes] = deque()
        self._texts_size = 0
        # What the client was told of each topic.
        self._announced: dict[int, Mapping[str, Any]] = {}
        self._lab = b""
        self._requests: OrderedDict[int, None] = OrderedDict()
        self._batch_is_next = True

    @property
    def size(self) -> int:
        """Bytes of the lossless channel that wait."""
        return self._reliable.size

    def close(self) -> None:
        """End all subscriptions."""
        for subscription in self._subscriptions.values():
            subscription.end()
        self._subscriptions.clear()
        self._reliable.close()

    # ---- a new socket ----

    async def attach(self, received: int, wanted: Mapping[int, str]) -> None:
        """Begin on a new socket: the client has fragments up to `received`.

        wanted: its subscriptions, number -> key expression; states that may have been lost on the
        way are given again. Others have their turn between two subscriptions, and pages of one
        person begin one after another.
        """
        async with self.budget.begins:
            await self._attach(received, wanted)

    async def _attach(self, received: int, wanted: Mapping[int, str]) -> None:
        self._credit = Credit(BATCHES)
        self._texts.clear()
        self._texts_size = 0
        for facts in self._announced.values():
            self.text(facts)
        self._reliable.rewind(received)
        for number in [n for n, s in self._subscriptions.items() if wanted.get(n) != s.expression]:
            self.unsubscribe(number)
        for subscription in list(self._subscriptions.values()):
            self._hub.replay(subscription.expression, self, each=False)
            await asyncio.sleep(0)
        for number, expression in wanted.items():
            if number not in self._subscriptions:
                self.subscribe(number, expression)
                await asyncio.sleep(0)

    # ---- from the client ----

    def subscribe(self, number: int, expression: str) -> None:
        """Subscribe, or send why not."""
        if number in self._subscriptions:
            self.unsubscribe(number)
        why_not = self._why_not(expression)
        if why_not is not None:
            self.text({"op": "refused", "id": number, "key": expression, **told(*why_not)})
            return
        # Before the first message: there may be one at once.
        self._subscriptions[number] = Subscription(expression, _nothing)
        self._subscriptions[number].end = self._hub.subscribe(expression, self)

    def unsubscribe(self, number: int) -> None:
        """End a subscription; nothing happens where there is none."""
        subscription = self._subscriptions.pop(number, None)
        if subscription is not None:
            subscription.end()

    def grant(self, batch: int) -> None:
        """Let batches up to this number be sent."""
        self._credit.grant(batch)
        self.wake()

    def acknowledge(self, fragment: int) -> None:
        """Drop the fragments up to this number."""
        self._reliable.acknowledge(fragment)
        self.wake()

    def is_new(self, request: int) -> bool:
        """Note a request; return whether it is the first time that it comes."""
        if request in self._requests:
            return False
        self._requests[request] = None
        if len(self._requests) > REQUESTS:
            self._requests.popitem(last=False)
        return True

    # ---- to the client ----

    def take(self, message: Message) -> None:
        """Let a message wait for the client."""
        topic = message.topic
        if self._visibility.concerns(topic.key):
            limited = self._visibility.message(self.person, topic.key, message.sample.payload)
            if limited is None:
                return
            if limited is not message.sample.payload:
                message = message.with_payload(limited)
        if topic.each:
            self._push(topic, RecordKind.MESSAGE, message)
        elif len(message.sample.payload) > LARGE or (
            (self._in_pieces or self._large) and self._goes_in_pieces(topic.id)
        ):
            self._newest.forget(message.stream)
            self._large[topic.id] = message
        else:
            self._newest.offer(message.stream, topic.priority, message.encoded())
        # By the object: to compare all fields would be a fifth of this method.
        if self._announced.get(topic.id) is not topic.facts:
            self._announced[topic.id] = topic.facts
            self.text(topic.facts)
        self.wake()

    def _goes_in_pieces(self, topic: int) -> bool:
        """Return whether an older message of a topic goes in pieces: a batch would overtake it."""
        if not self._reliable.size:
            self._in_pieces.clear()
        return topic in self._in_pieces or topic in self._large

    def respond(self, request: int, payload: bytes) -> None:
        """Send a service's response; an error where too much waits for this person's pages."""
        if self.budget.has_room(len(payload)):
            self._push_record(frames.record(RecordKind.RESPONSE, request, 0.0, payload))
        else:
            self.fail(request, "too_many", CALLS_FULL())

    def fail(self, request: int, code: str, why: Diagnostic) -> None:
        """Send why a request has no response; code: a coarse word for programs."""
        error = orjson.dumps(told(code, why))
        self._push_record(frames.record(RecordKind.ERROR, request, 0.0, error))

    def text(self, message: Mapping[str, Any]) -> None:
        """Send a text frame; it is not repeated after a reconnect."""
        text = orjson.dumps(message)
        if self._texts_size + len(text) > MOST_TEXTS:
            self.failed = TEXTS_WAIT(size=self._texts_size + len(text))
        else:
            self._texts.append(text)
            self._texts_size += len(text)
        self.wake()

    def show_lab(self, state: bytes) -> None:
        """Send how the lab is, as JSON; only the newest counts."""
        self._lab = state
        self.wake()

    def next_frame(self) -> bytes | str | None:
        """Return the next frame to send, None where nothing may be sent now.

        Texts go first; batches and fragments take turns.
        """
        if self._texts:
            text = self._texts.popleft()
            self._texts_size -= len(text)
            return text.decode()
        if self._lab:
            state, self._lab = self._lab, b""
            return state.decode()
        for _ in range(2):
            self._batch_is_next = not self._batch_is_next
            frame = self._fragment() if self._batch_is_next else self._batch()
            if frame is not None:
                return frame
        return None

    def _batch(self) -> bytes | None:
        if not self._credit.left or not self._newest:
            return None
        entries = self._newest.take(BATCH)
        return frames.batch(self._credit.take(), entries)

    def _fragment(self) -> bytes | None:
        # One at a time: what waits behind it may be replaced by a newer one.
        if self._large and self._reliable.idle:
            topic, message = next(iter(self._large.items()))
            del self._large[topic]
            self._in_pieces.add(topic)
            self._push(message.topic, RecordKind.VALUE, message)
        return self._reliable.next()

    def _push(self, topic: Topic, kind: RecordKind, message: Message) -> None:
        self._push_record(frames.record(kind, topic.id, message.stamp, message.sample.payload))

    def _push_record(self, record: bytes) -> None:
        try:
            self._reliable.push(record)
        except Overflow as error:
            self.failed = error.diagnostic
        self.wake()

    def _why_not(self, expression: str) -> tuple[str, Diagnostic] | None:
        if len(self._subscriptions) >= SUBSCRIPTIONS:
            return "too_many", SUBSCRIPTIONS_FULL(count=SUBSCRIPTIONS)
        if not self._may(self.person, Verb.RECEIVE, expression):
            return "not_allowed", NO_TOPIC_OF_PAGES(key=expression)
        return None


def told(code: str, why: Diagnostic) -> dict[str, Any]:
    """Return the fields that say why something was not done.

    code: a coarse word that clients steer by. message: English, for clients that only print.
    """
    return {"code": code, "message": str(why), "diagnostic": plain(why)}


def _nothing() -> None:
    """Do nothing."""
