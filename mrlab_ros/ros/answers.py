"""Turns what a service callback raises into the answer `success = false` with the reason."""

from __future__ import annotations

import functools
from collections.abc import Callable
from typing import Any, TypeVar

from mrlab_ros.core.errors import LabError

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
