"""Threads that take raw messages from subscriptions without an executor.

An executor of rclpy spends about 140 us of CPU on a message. A WaitSetThread spends about 23 us
and has each message at once. A TopicPoll spends about 10 us on a message, and 1 us on a
subscription without one, but has the messages late; each carries the time at which it was
received. The subscriptions must be raw and belong to a node that no executor spins.

Publishes CDR without the checks of rclpy's publisher, which take as long as the publishing.
"""

from __future__ import annotations

import threading
import time
from collections.abc import Callable
from contextlib import ExitStack
from operator import attrgetter
from typing import Any, Generic, NamedTuple, TypeVar

from rclpy.context import Context
from rclpy.exceptions import InvalidHandle
from rclpy.guard_condition import GuardCondition
from rclpy.impl.implementation_singleton import rclpy_implementation
from rclpy.publisher import Publisher
from rclpy.subscription import Subscription

from mrlab_ros.adapters import threads
from mrlab_ros.core.base.clock import SECOND

# The longest wait before a WaitSetThread checks that the context still lives, ns.
MAX_WAIT_NS = 200_000_000
# The most messages taken from one subscription before the others are served.
BATCH = 16
# Pause of a thread after an error, s: the error may come again at once.
RETRY_S = 0.1

# State that a thread keeps for each subscription.
Kept = TypeVar("Kept")


class _RawThread(Generic[Kept]):
    """A thread that serves a set of raw subscriptions, which may change while it runs.

    on_error gets, in the thread, every error; the thread then continues after RETRY_S.
    """

    def __init__(self, name: str, on_error: Callable[[Exception], None]) -> None:
        self._on_error = on_error
        self._lock = threading.Lock()
        self._subscriptions: dict[Subscription, Kept] = {}
        self._changed = True
        self._stopped = threading.Event()
        self._thread = threads.loop(name, self._run)

    def start(self) -> None:
        self._thread.start()

    def stop(self) -> None:
        """End the thread and wait for it."""
        self._stopped.set()
        self._wake()
        if self._thread.is_alive() and self._thread is not threading.current_thread():
            self._thread.join()

    def add(self, subscription: Subscription, kept: Kept) -> None:
        """Take the messages of `subscription` from now on."""
        with self._lock:
            self._subscriptions[subscription] = kept
            self._changed = True
        self._wake()

    def remove(self, subscription: Subscription) -> None:
        """Take no more from `subscription`, which may be destroyed at once."""
        with self._lock:
            self._subscriptions.pop(subscription, None)
            self._changed = True
        self._wake()

    def _wake(self) -> None:
        """End a wait of the thread."""

    def _run(self) -> None:
        more = True
        while more:
            try:
                more = self._serve_present()
            except Exception as error:
                self._on_error(error)
                more = not self._stopped.wait(RETRY_S)

    def _serve_present(self) -> bool:
        """Serve the present subscriptions until they change; return False to end the thread."""
        # The handles outlive what another thread destroys until the next round.
        with ExitStack() as stack:
            with self._lock:
                self._changed = False
                wanted = list(self._subscriptions.items())
            found = []
            for subscription, kept in wanted:
                handle: Any = subscription.handle
                try:
                    stack.enter_context(handle)
                except InvalidHandle:  # destroyed a moment ago
                    continue
                found.append((handle, subscription.msg_type, kept))
            return self._serve(stack, found)

    def _serve(self, stack: ExitStack, found: list[tuple[Any, Any, Kept]]) -> bool:
        """Serve handles until the subscriptions change; return False to end the thread."""
        raise NotImplementedError


class WaitSetThread(_RawThread[Callable[[bytes], None]]):
    """Waits for raw subscriptions and hands each message, as CDR, to the subscription's callback.

    `turn` runs once in every round of the loop and returns how long the next wait may be, ns.
    What a callback raises goes to `on_error`. A round takes some 60 us and more with many
    subscriptions, so that rounds begin at least `spacing_ns` apart: what comes after a pause is
    there at once, and of a thousand messages a second several come in each round.
    """

    def __init__(
        self,
        context: Context,
        name: str,
        turn: Callable[[], int],
        on_error: Callable[[Exception], None],
        spacing_ns: int = 0,
    ) -> None:
        super().__init__(name, on_error)
        self._context = context
        self._turn = turn
        self._spacing_ns = spacing_ns
        self._next_ns = 0
        self._guard = GuardCondition(None, None, context=context)

    def stop(self) -> None:
        """End the thread and wait for it."""
        super().stop()
        self._guard.destroy()

    def _wake(self) -> None:
        if self._thread.is_alive() and self._context.ok():
            self._guard.trigger()

    def _serve(self, stack: ExitStack, found: list[tuple[Any, Any, Any]]) -> bool:
        if self._stopped.is_set() or not self._context.ok():
            return False
        takers = {handle.pointer: (handle, kind, use) for handle, kind, use in found}
        context: Any = self._context.handle
        guard = self._guard.handle
        stack.enter_context(context)
        stack.enter_context(guard)
        wait_set = rclpy_implementation.WaitSet(len(takers), 1, 0, 0, 0, 0, context)
        while not self._changed and not self._stopped.is_set() and self._context.ok():
            wait_ns = self._turn()
            pause_ns = min(self._next_ns - time.monotonic_ns(), wait_ns)
            if pause_ns > 0:
                time.sleep(pause_ns / SECOND)
                wait_ns -= pause_ns
            wait_set.clear_entities()
            wait_set.add_guard_condition(guard)
            for handle, _, _ in found:
                wait_set.add_subscription(handle)
            wait_set.wait(min(wait_ns, MAX_WAIT_NS))
            self._next_ns = time.monotonic_ns() + self._spacing_ns
            if self._changed:
                break  # what was removed meanwhile gets nothing more; the rest is still there
            for pointer in wait_set.get_ready_entities("subscription"):
                self._drain(*takers[pointer])
        return True

    def _drain(self, handle: Any, kind: Any, on_message: Callable[[bytes], None]) -> None:
        for _ in range(BATCH):
            try:
                taken = handle.take_message(kind, True)
                if taken is None:
                    return
                on_message(taken[0])
            except Exception as error:  # one bad message must not end the thread
                self._on_error(error)


class Received(NamedTuple):
    """A message as it came from the graph: CDR, and two times, ns.

    received_ns: on a clock that began with the wall clock and never goes back or jumps.
    published_ns: on the wall clock. sequence counts the messages of its publisher.
    """

    received_ns: int
    topic: str
    data: bytes
    published_ns: int
    sequence: int


# Messages received while others are taken, ns, are younger than the reading of the clock.
LONGEST_TAKE_NS = SECOND


def age_ns(now_ns: int, received_ns: int, longest_ns: int) -> int:
    """Return how long ago a message was received, negative: after `now_ns`; all by the wall clock.

    received_ns: 0 where it is unknown. longest_ns: since messages were taken last. An age that
    cannot be is of a message from before the clock was set.
    """
    age = now_ns - (received_ns or now_ns)
    return age if -LONGEST_TAKE_NS < age <= longest_ns else longest_ns


class TopicPoll(_RawThread[str]):
    """Polls raw subscriptions and hands their messages on in the order in which they came.

    Each subscription is kept with its topic's name. Every `period` s, which `on_messages` may
    change, it gets what has come since the last time, maybe nothing; once it returns False, the
    thread ends. stop() takes what has come before it ends the thread.
    """

    def __init__(
        self,
        name: str,
        period: float,
        on_messages: Callable[[list[Received]], bool],
        on_error: Callable[[Exception], None],
    ) -> None:
        super().__init__(name, on_error)
        self.period = period
        self._on_messages = on_messages
        self._early: list[Received] = []
        self._base_ns = time.time_ns() - time.monotonic_ns()
        self._taken_ns = time.monotonic_ns()

    def _serve(self, stack: ExitStack, found: list[tuple[Any, Any, str]]) -> bool:
        while not self._changed:
            last = self._stopped.is_set()
            if not self._on_messages(self._take(found, last)) or last:
                return False
            self._stopped.wait(self.period)
        return True

    def _take(self, found: list[tuple[Any, Any, str]], last: bool) -> list[Received]:
        """Take what has come; keep back what came after this call began, unless it is the last.

        The next call may find messages that were received before those.
        """
        wall_ns, steady_ns = time.time_ns(), time.monotonic_ns()
        began_ns = self._base_ns + steady_ns
        longest_ns, self._taken_ns = steady_ns - self._taken_ns, steady_ns
        messages = self._early
        for handle, kind, topic in found:
            while (taken := handle.take_message(kind, True)) is not None:
                data, info = taken
                messages.append(
                    Received(
                        began_ns - age_ns(wall_ns, info["received_timestamp"], longest_ns),
                        topic,
                        data,
                        info["source_timestamp"],
                        info["publication_sequence_number"] or 0,
                    )
                )
        messages.sort(key=attrgetter("received_ns"))
        end = len(messages)
        while not last and end and messages[end - 1].received_ns > began_ns:
            end -= 1
        self._early = messages[end:]
        return messages[:end]


def raw_publish(publisher: Publisher) -> Callable[[bytes], None]:
    """Return what publishes the CDR of a message; end its use before the publisher's node."""
    return publisher.handle.publish_raw  # type: ignore[no-any-return]
