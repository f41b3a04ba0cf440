"""Calls of one node's services by another, with a deadline and a plain error."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any

from mrlab_ros.core.base.errors import Unreached
from mrlab_ros.ros.diagnostics import NO_ANSWER_IN_TIME, NOT_OFFERED, SERVICE_ENDED

if TYPE_CHECKING:
    from rclpy.client import Client

# How often a call that waits checks whether its service is there, s.
PRESENCE_PERIOD_S = 0.05


class NoAnswer(Unreached):
    """A node of the lab did not answer in time."""


def call(client: Client, request: Any, timeout: float = 5.0) -> Any:
    """Return the service's answer; raise NoAnswer after `timeout` s.

    The client must be spun by another thread than this one: a `spinning.Caller` has such.
    """
    return call_all([(client, request)], timeout)[0]


def call_all(calls: Sequence[tuple[Client, Any]], timeout: float = 5.0) -> list[Any]:
    """Send every request at once and return the answers in order, as call() does."""
    answers = call_each(calls, timeout)
    for answer in answers:
        if isinstance(answer, NoAnswer):
            raise answer
    return answers


def call_each(
    calls: Sequence[tuple[Client, Any]],
    timeout: float = 5.0,
    gone: Callable[[Client], bool] = lambda client: False,
) -> list[Any]:
    """Send every request at once; return the answers in order, a NoAnswer where there is none.

    All of it takes `timeout` s at most. A service that is not there yet gets its request when it
    comes, one that leaves the graph before it answers is noticed at once; neither delays others.
    gone: whether the process behind a client is known not to answer any more.
    """
    deadline = time.monotonic() + timeout
    changed = threading.Event()
    pending = [_Call(client, request, changed) for client, request in calls]
    while True:
        changed.clear()
        waiting = [one for one in pending if one.waits(gone)]
        left = deadline - time.monotonic()
        if not waiting or left <= 0:
            return [one.answer(timeout) for one in pending]
        changed.wait(min(left, PRESENCE_PERIOD_S))


class _Call:
    """One request and what became of it."""

    def __init__(self, client: Client, request: Any, changed: threading.Event) -> None:
        self._client, self._request, self._changed = client, request, changed
        self._future: Any = None
        self._gone = False

    def waits(self, gone: Callable[[Client], bool]) -> bool:
        """Send the request where its service is there; return whether an answer may come."""
        ready = self._client.service_is_ready()
        if self._future is None:
            if ready:
                self._future = self._client.call_async(self._request)
                self._future.add_done_callback(lambda _: self._changed.set())
        elif not ready and not self._future.done():
            self._gone = True
        if gone(self._client):
            self._gone = True
        return not self._gone and (self._future is None or not self._future.done())

    def answer(self, timeout: float) -> Any:
        """Return the answer, or the NoAnswer that says why there is none."""
        name = self._client.srv_name
        if self._future is None:
            return NoAnswer(NOT_OFFERED(service=name))
        if self._future.done():
            return self._future.result()
        self._client.remove_pending_request(self._future)
        if self._gone:
            return NoAnswer(SERVICE_ENDED(service=name))
        return NoAnswer(NO_ANSWER_IN_TIME(service=name, timeout=timeout))
