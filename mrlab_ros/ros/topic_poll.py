"""One thread that looks at many raw subscriptions again and again.

A recorder may have its messages late, as long as each brings the time at which it was received.
So it needs no wait set, whose making costs as much as the messages: a look at a subscription
without a message takes 1 us, taking a message 10 us.
"""

from __future__ import annotations

import threading
import time
from collections.abc import Callable
from contextlib import ExitStack
from typing import Any, NamedTuple

from rclpy.exceptions import InvalidHandle
from rclpy.subscription import Subscription


class Received(NamedTuple):
    """A message as it came from the graph: CDR, and two times of ROS's clock, ns.

    sequence counts the messages of its publisher.
    """

    received_ns: int
    topic: str
    data: bytes
    published_ns: int
    sequence: int


class TopicPoll:
    """Takes what subscriptions received and hands it on in the order in which it was received.

    The subscriptions must be raw and belong to a node that no executor spins. `on_messages` gets
    what came since the last time, maybe nothing; once it returns False, the thread ends.
    """

    def __init__(
        self, name: str, period: float, on_messages: Callable[[list[Received]], bool]
    ) -> None:
        self._period = period
        self._on_messages = on_messages
        self._lock = threading.Lock()
        self._subscriptions: dict[Subscription, str] = {}
        self._changed = True
        self._stop = threading.Event()
        self._thread = threading.Thread(target=self._run, name=name, daemon=True)

    def start(self) -> None:
        self._thread.start()

    def stop(self) -> None:
        """Take what is there, end the thread and wait for it."""
        self._stop.set()
        if self._thread is not threading.current_thread():
            self._thread.join()

    def add(self, subscription: Subscription, topic: str) -> None:
        with self._lock:
            self._subscriptions[subscription] = topic
            self._changed = True

    def remove(self, subscription: Subscription) -> None:
        with self._lock:
            self._subscriptions.pop(subscription, None)
            self._changed = True

    def _run(self) -> None:
        later: list[Received] = []
        while True:
            with ExitStack() as stack:
                with self._lock:
                    self._changed = False
                    subscriptions = list(self._subscriptions.items())
                takers = [taker for s in subscriptions if (taker := _taker(stack, *s))]
                while not self._changed:
                    last = self._stop.is_set()
                    later, ready = self._look(takers, later, last)
                    if not self._on_messages(ready) or last:
                        return
                    self._stop.wait(self._period)

    def _look(
        self, takers: list[tuple[Any, Any, str]], found: list[Received], last: bool
    ) -> tuple[list[Received], list[Received]]:
        """Take what there is; return what belongs to the next look, and what is ready.

        What was received after this look began may be preceded by what a later look finds.
        """
        began_ns = time.time_ns()
        for handle, kind, topic in takers:
            while (taken := handle.take_message(kind, True)) is not None:
                data, info = taken
                found.append(
                    Received(
                        info["received_timestamp"] or began_ns,
                        topic,
                        data,
                        info["source_timestamp"],
                        info["publication_sequence_number"] or 0,
                    )
                )
        found.sort(key=_received)
        if last:
            return [], found
        end = len(found)
        while end and found[end - 1].received_ns > began_ns:
            end -= 1
        return found[end:], found[:end]


def _received(message: Received) -> int:
    return message.received_ns


def _taker(
    stack: ExitStack, subscription: Subscription, topic: str
) -> tuple[Any, Any, str] | None:
    handle = subscription.handle
    try:
        stack.enter_context(handle)
    except InvalidHandle:
        return None
    return handle, subscription.msg_type, topic
