"""Calls of one node's services by another, with a deadline and a plain error."""

from __future__ import annotations

import threading
import time
from collections.abc import Sequence
from typing import Any

from rclpy.client import Client

from mrlab_ros.core.errors import LabError

# How often a call that waits checks whether its service is still there, s.
PRESENCE_PERIOD_S = 0.1


class NoAnswer(LabError):
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


def call_each(calls: Sequence[tuple[Client, Any]], timeout: float = 5.0) -> list[Any]:
    """Send every request at once; return the answers in order, a NoAnswer where there is none.

    All of it takes `timeout` s at most. A service that leaves the graph before it answers is
    noticed at once.
    """
    deadline = time.monotonic() + timeout
    pending = [_begin(client, request, deadline) for client, request in calls]
    return [
        begun if isinstance(begun, NoAnswer) else _finish(*begun, deadline, timeout)
        for begun in pending
    ]


def _begin(
    client: Client, request: Any, deadline: float
) -> NoAnswer | tuple[Client, Any, threading.Event]:
    left = max(deadline - time.monotonic(), 0.0)
    if not client.service_is_ready() and not client.wait_for_service(timeout_sec=left):
        return NoAnswer(f"nobody offers {client.srv_name}; is that part of the lab running?")
    done = threading.Event()
    future = client.call_async(request)
    future.add_done_callback(lambda _: done.set())
    return client, future, done


def _finish(
    client: Client, future: Any, done: threading.Event, deadline: float, timeout: float
) -> Any:
    while not done.wait(min(max(deadline - time.monotonic(), 0.0), PRESENCE_PERIOD_S)):
        gone = not client.service_is_ready()
        if not gone and time.monotonic() < deadline:
            continue
        # The answer may have come in this moment.
        if done.is_set():
            break
        client.remove_pending_request(future)
        if gone:
            return NoAnswer(f"{client.srv_name} ended before it answered; try again")
        return NoAnswer(f"{client.srv_name} did not answer within {timeout:g} s; try again")
    return future.result()
