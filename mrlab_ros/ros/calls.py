"""Calls of one node's services by another, with a deadline and a plain error."""

from __future__ import annotations

import threading
import time
from collections.abc import Sequence
from typing import Any

from rclpy.client import Client

from mrlab_ros.core.errors import LabError


class NoAnswer(LabError):
    """A node of the lab did not answer in time."""


def call(client: Client, request: Any, timeout: float = 5.0) -> Any:
    """Return the service's answer; raise NoAnswer after `timeout` s.

    The client must be spun by another thread than this one: a `spinning.Caller` has such.
    """
    return call_all([(client, request)], timeout)[0]


def call_all(calls: Sequence[tuple[Client, Any]], timeout: float = 5.0) -> list[Any]:
    """Send every request at once and return the answers in order, as call() does."""
    deadline = time.monotonic() + timeout
    for client, _ in calls:
        if not client.service_is_ready() and not client.wait_for_service(timeout_sec=timeout):
            raise NoAnswer(f"nobody offers {client.srv_name}; is that part of the lab running?")
    pending = []
    for client, request in calls:
        done = threading.Event()
        future = client.call_async(request)
        future.add_done_callback(lambda _, done=done: done.set())
        pending.append((client, future, done))
    answers = []
    for client, future, done in pending:
        if not done.wait(max(deadline - time.monotonic(), 0.0)):
            client.remove_pending_request(future)
            raise NoAnswer(f"{client.srv_name} did not answer within {timeout:g} s; try again")
        answers.append(future.result())
    return answers
