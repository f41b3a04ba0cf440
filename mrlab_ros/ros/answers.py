"""Answers of services: failures as `success = false` with the reason, and deferred answers."""

from __future__ import annotations

import contextlib
import functools
from collections.abc import Callable
from concurrent.futures import CancelledError, Future
from typing import Any, TypeVar

from rclpy.impl.implementation_singleton import rclpy_implementation
from rclpy.node import Node

from mrlab_ros.core.errors import LabError
from mrlab_ros.messages import qos

Response = TypeVar("Response")


def answered(callback: Callable[..., str | None]) -> Callable[..., Any]:
    """Wrap `callback(self, request, response) -> message` as a rclpy service callback.

    The response says success with the message returned, or failure with the LabError's text.
    """

    @functools.wraps(callback)
    def wrapped(self: Any, request: Any, response: Response) -> Response:
        answer: Any = response
        try:
            answer.message = callback(self, request, response) or ""
            answer.success = True
        except LabError as error:
            answer.success, answer.message = False, str(error)
        except Exception as error:
            self.get_logger().error(f"{callback.__name__}: {error!r}")
            answer.success = False
            answer.message = (
                f"the lab failed at {callback.__name__} ({error!r}); its log has the details"
            )
        return response

    return wrapped


def create_deferred_service(
    node: Node, kind: Any, name: str, begin: Callable[[Any, Any], Future[Any]], **options: Any
) -> Any:
    """Create a service whose `begin(request, response)` returns a future of the response.

    The executor goes on at once; the response is sent by the thread that completes the future,
    or not at all where the future is cancelled. A coroutine would be polled by the executor
    without pause, and a callback that waits would block the other callbacks of its thread.
    """
    service = node.create_service(kind, name, begin, **options, qos_profile=qos.SERVICES)
    send = service.send_response

    def send_when_done(future: Future[Any], header: Any) -> None:
        def forward(done: Future[Any]) -> None:
            # InvalidHandle: the service was destroyed meanwhile, nobody waits for the answer
            with contextlib.suppress(CancelledError, rclpy_implementation.InvalidHandle):
                if node.context.ok():
                    send(done.result(), header)

        future.add_done_callback(forward)

    service.send_response = send_when_done  # type: ignore[method-assign, assignment]
    return service
