"""A thread that takes raw messages the moment they arrive, without an executor.

rclpy offers no callback for an arrival before its release 10, but rcl does: it calls a C function
with a pointer and the number of new messages. libc's `eventfd_write(descriptor, count)` takes
these two, so the middleware's thread wakes ours by a file descriptor and runs no Python.
"""

from __future__ import annotations

import ctypes
import os
import select
from collections.abc import Callable
from typing import Any

from rclpy.subscription import Subscription

from mrlab_ros.adapters import threads
from mrlab_ros.core.base.errors import Unavailable
from mrlab_ros.ros.diagnostics import NO_ARRIVALS

# Gets a message's CDR and when it was published, ns since 1970.
OnMessage = Callable[[bytes, int], None]
# The most messages taken from one subscription before the others are served.
BATCH = 64

_rcl = ctypes.CDLL("librcl.so")
_rcl.rcl_subscription_set_on_new_message_callback.argtypes = [ctypes.c_void_p] * 3
_EVENTFD_WRITE = ctypes.cast(ctypes.CDLL(None).eventfd_write, ctypes.c_void_p)


def _announce(subscription: Subscription, descriptor: int | None) -> None:
    """Have the middleware write to `descriptor` at each arrival; None ends that."""
    handle: Any = subscription.handle
    with handle:
        failed = _rcl.rcl_subscription_set_on_new_message_callback(
            handle.pointer, _EVENTFD_WRITE if descriptor is not None else None, descriptor
        )
    if failed:
        raise Unavailable(NO_ARRIVALS(topic=subscription.topic_name, error=failed))


class _Taker:
    """The taker of a subscription's messages; next: its publisher's next number, 0: unknown."""

    __slots__ = ("kind", "next", "on_gap", "on_message", "take")

    def __init__(
        self,
        take: Callable[[Any, bool], Any],
        kind: Any,
        on_message: OnMessage,
        on_gap: Callable[[int], None],
    ) -> None:
        self.take, self.kind = take, kind
        self.on_message, self.on_gap = on_message, on_gap
        self.next = 0


class Arrivals:
    """Hands each message of its raw subscriptions, as CDR, to a callback in one thread.

    The subscriptions belong to a node that no executor spins. What a callback raises goes to
    `on_error`.
    """

    def __init__(self, name: str, on_error: Callable[[Exception], None]) -> None:
        self._on_error = on_error
        self._epoll = select.epoll()
        self._stopped = False
        self._wake = os.eventfd(0)
        self._epoll.register(self._wake, select.EPOLLIN)
        self._descriptors: dict[Subscription, int] = {}
        self._takers: dict[int, _Taker] = {}
        self._thread = threads.loop(name, self._run)
        self._thread.start()

    def add(
        self,
        subscription: Subscription,
        on_message: OnMessage,
        on_gap: Callable[[int], None] = lambda _: None,
    ) -> None:
        """Take the messages of `subscription` from now on, also those that have already come.

        on_gap: gets how many numbers of the publisher are missing before a message. Of several
        publishers the numbers alternate, and gaps mean nothing.
        """
        descriptor = os.eventfd(0)
        handle: Any = subscription.handle
        self._descriptors[subscription] = descriptor
        self._takers[descriptor] = _Taker(
            handle.take_message, subscription.msg_type, on_message, on_gap
        )
        # Edge-triggered: each write is an event, and nobody needs to read the descriptor.
        self._epoll.register(descriptor, select.EPOLLIN | select.EPOLLET)
        _announce(subscription, descriptor)

    def remove(self, subscription: Subscription) -> None:
        """Take no more from `subscription`, which may be destroyed at once."""
        descriptor = self._descriptors.pop(subscription)
        _announce(subscription, None)
        del self._takers[descriptor]
        self._epoll.unregister(descriptor)
        os.close(descriptor)

    def close(self) -> None:
        """Remove all subscriptions, end the thread and wait for it."""
        for subscription in list(self._descriptors):
            self.remove(subscription)
        self._stopped = True
        os.eventfd_write(self._wake, 1)
        self._thread.join()
        self._epoll.close()
        os.close(self._wake)

    def _run(self) -> None:
        # All are looked at first: after an error nobody knows which had messages.
        unfinished = list(self._takers)
        while True:
            arrived = self._epoll.poll(0 if unfinished else None)
            if self._stopped:
                return
            ready = [*unfinished, *(descriptor for descriptor, _ in arrived)]
            unfinished = [each for each in dict.fromkeys(ready) if self._take(each)]

    def _take(self, descriptor: int) -> bool:
        """Take up to BATCH messages; return whether there may be more."""
        taker = self._takers.get(descriptor)
        if taker is None:  # removed meanwhile
            return False
        take, kind, on_message = taker.take, taker.kind, taker.on_message
        for _ in range(BATCH):
            try:
                taken = take(kind, True)
                if taken is None:
                    return False
                data, info = taken
                number = info["publication_sequence_number"] or 0
                if number > taker.next > 0:
                    taker.on_gap(number - taker.next)
                taker.next = number + 1
                on_message(data, info["source_timestamp"])
            except Exception as error:
                # Destroyed meanwhile; the next subscription may have the same descriptor.
                if self._takers.get(descriptor) is not taker:
                    return False
                self._on_error(error)
        return True
