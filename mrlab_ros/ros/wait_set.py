"""One thread that takes raw messages, without an executor between.

An executor of rclpy spends some 140 us of CPU on a message, this loop about 23 us.
"""

from __future__ import annotations

import threading
from collections.abc import Callable
from contextlib import ExitStack
from typing import Any

from rclpy.context import Context
from rclpy.exceptions import InvalidHandle
from rclpy.guard_condition import GuardCondition
from rclpy.impl.implementation_singleton import rclpy_implementation
from rclpy.subscription import Subscription

# How long to wait, ns, before looking whether the context still lives.
PATIENCE_NS = 200_000_000
# Taken from one subscription before the others have their turn.
BATCH = 16
# By pointer: a subscription's handle, and what takes a message from it if there is one.
Takers = dict[int, tuple[Any, Callable[[], bool]]]


class WaitSetThread:
    """Waits for subscriptions and hands on what they receive.

    They must belong to a node that no executor spins. `turn` runs once in every round of the loop
    and returns how long the next wait may be, ns. What a callback raises goes to `on_error`.
    """

    def __init__(
        self,
        context: Context,
        name: str,
        turn: Callable[[], int],
        on_error: Callable[[Exception], None],
    ) -> None:
        self._context = context
        self._turn = turn
        self._on_error = on_error
        self._lock = threading.Lock()
        self._subscriptions: dict[Subscription, Callable[[bytes], None]] = {}
        self._changed = True
        self._stopped = False
        self._guard = GuardCondition(None, None, context=context)
        self._thread = threading.Thread(target=self._run, name=name, daemon=True)

    def start(self) -> None:
        self._thread.start()

    def stop(self) -> None:
        """End the thread and wait for it."""
        self._stopped = True
        self._wake()
        self._thread.join()
        self._guard.destroy()

    def add_subscription(self, entity: Subscription, on_message: Callable[[bytes], None]) -> None:
        """Hand every message of a raw subscription to `on_message`, as CDR."""
        with self._lock:
            self._subscriptions[entity] = on_message
        self._change()

    def remove(self, entity: Subscription) -> None:
        """Wait for `entity` no more. It may be destroyed at once: its handle outlives the wait."""
        with self._lock:
            self._subscriptions.pop(entity, None)
        self._change()

    def _change(self) -> None:
        self._changed = True
        self._wake()

    def _wake(self) -> None:
        if self._thread.is_alive() and self._context.ok():
            self._guard.trigger()

    def _run(self) -> None:
        while not self._stopped and self._context.ok():
            with ExitStack() as stack:
                self._changed = False
                with self._lock:
                    subscriptions = dict(self._subscriptions)
                takers = _takers(stack, subscriptions)
                stack.enter_context(self._guard.handle)
                alive: Any = self._context.handle
                stack.enter_context(alive)
                wait_set = rclpy_implementation.WaitSet(len(subscriptions), 1, 0, 0, 0, 0, alive)
                while not self._changed and not self._stopped and self._context.ok():
                    self._round(wait_set, takers)

    def _round(self, wait_set: Any, takers: Takers) -> None:
        patience = self._turn()
        wait_set.clear_entities()
        wait_set.add_guard_condition(self._guard.handle)
        for handle, _ in takers.values():
            wait_set.add_subscription(handle)
        wait_set.wait(min(patience, PATIENCE_NS))
        for pointer in wait_set.get_ready_entities("subscription"):
            self._drain(takers[pointer][1])

    def _drain(self, take: Callable[[], bool]) -> None:
        for _ in range(BATCH):
            try:
                if not take():
                    return
            except Exception as error:  # one bad message must not end the thread
                self._on_error(error)


def _takers(stack: ExitStack, wanted: dict[Subscription, Callable[[bytes], None]]) -> Takers:
    """Return each subscription's handle, kept alive until `stack` ends, and how to take from it.

    One that is gone is left out.
    """
    found: Takers = {}
    for subscription, on_message in wanted.items():
        handle: Any = subscription.handle
        try:
            stack.enter_context(handle)
        except InvalidHandle:
            continue
        found[handle.pointer] = (handle, _taker(handle, subscription.msg_type, on_message))
    return found


def _taker(handle: Any, kind: Any, on_message: Callable[[bytes], None]) -> Callable[[], bool]:
    def take() -> bool:
        taken = handle.take_message(kind, True)
        if taken is None:
            return False
        on_message(taken[0])
        return True

    return take
