"""An action server whose goals are ended by whoever watches them, not by a callback that waits."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress
from typing import Any

from rclpy.action.server import ActionServer, CancelResponse, GoalResponse
from rclpy.impl.implementation_singleton import rclpy_implementation
from rclpy.node import Node

Goal = Any


class GoalServer:
    """Accepts every goal and hands it on; finish() ends it with a result.

    rclpy's own way is a coroutine a goal, which the events executor would poll without pause.
    accepted: gets the goal's handle; cancel: a handle whose client wants it to end, which the
    server then finishes.
    """

    def __init__(
        self,
        node: Node,
        kind: Any,
        name: str,
        accepted: Callable[[Goal], None],
        cancel: Callable[[Goal], None],
    ) -> None:
        self._accepted = accepted
        self._cancel = cancel
        self._kind = kind
        self._server = ActionServer(
            node,
            kind,
            name,
            execute_callback=_never,
            goal_callback=lambda request: GoalResponse.ACCEPT,
            handle_accepted_callback=self._on_accepted,
            cancel_callback=self._on_cancel,
        )

    def close(self) -> None:
        self._server.destroy()

    def finish(self, goal: Goal, result: Any, how: str) -> None:
        """End a goal: `how` is "succeed", "abort" or "canceled"; send the result to who asks."""
        with suppress(rclpy_implementation.RCLError, rclpy_implementation.InvalidHandle):
            getattr(goal, how)()
        response = self._kind.Impl.GetResultService.Response()
        response.status = goal.status
        response.result = result
        future = self._server._result_futures.get(bytes(goal.goal_id.uuid))
        if future is not None and not future.done():
            with suppress(rclpy_implementation.RCLError, rclpy_implementation.InvalidHandle):
                future.set_result(response)

    def _on_accepted(self, goal: Goal) -> None:
        goal._update_state(rclpy_implementation.GoalEvent.EXECUTE)
        self._accepted(goal)

    def _on_cancel(self, goal: Goal) -> CancelResponse:
        self._cancel(goal)
        return CancelResponse.ACCEPT


def _never(goal: Goal) -> None:
    """Required by rclpy; goals are not executed by it."""
