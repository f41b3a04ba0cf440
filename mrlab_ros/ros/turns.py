"""Services of one node whose requests are carried out one after another by one worker."""

from __future__ import annotations

import time
from collections import defaultdict
from collections.abc import Callable
from concurrent.futures import Future
from typing import Any

from rclpy.node import Node
from rclpy.service import Service

from mrlab_ros.core.base.diagnostic import Diagnostic
from mrlab_ros.core.base.errors import Misuse
from mrlab_ros.ros.answers import answered, create_deferred_service, end_service
from mrlab_ros.ros.diagnostics import WAITED_TOO_LONG
from mrlab_ros.ros.moves import moves
from mrlab_ros.ros.worker import Worker

# A request that waited longer for its turn is refused, s. A caller over zenoh gives up after 5 s,
# and an order to a host of playbacks takes up to 2 s.
MOST_WAIT_S = 3.0


class Turns:
    """Offers services of `node` that `worker` carries out.

    A request whose turn comes late is refused: its caller may have been told that nobody
    answered. What stops an arm, and what changes nothing, is carried out however late, as
    answers.create_service() says. The node's
    thread takes every request at once, so that the time of waiting is known by its own clock.
    """

    def __init__(self, node: Node, worker: Worker) -> None:
        self._node = node
        self._worker = worker
        # By name of the service.
        self._waiting: defaultdict[str, set[Future[Any]]] = defaultdict(set)

    def offer(self, kind: Any, name: str, action: Callable[[Any, Any], Diagnostic]) -> Service:
        """Create a service whose `action(request, response)` returns what to say."""
        may_be_late = not moves(self._node.resolve_service_name(name), kind)

        @answered
        def in_turn(_: Node, call: tuple[Any, float], response: Any) -> Diagnostic:
            request, came = call
            if not may_be_late:
                _refuse_overdue(time.monotonic() - came)
            return action(request, response)

        def begin(request: Any, response: Any) -> Future[Any]:
            call = request, time.monotonic()
            future = self._worker.later(lambda: in_turn(self._node, call, response))
            waiting = self._waiting[service.srv_name]
            waiting.add(future)
            future.add_done_callback(waiting.discard)
            return future

        service = create_deferred_service(self._node, kind, name, begin)
        return service

    def end(self, service: Service, why: Diagnostic) -> None:
        """Refuse the requests that wait for `service`, then destroy it."""
        for future in list(self._waiting.pop(service.srv_name, ())):
            future.cancel()
        end_service(self._node, service, why)

    def close(self) -> None:
        """Refuse all requests that wait."""
        for waiting in self._waiting.values():
            for future in list(waiting):
                future.cancel()


def _refuse_overdue(waited_s: float) -> None:
    if waited_s > MOST_WAIT_S:
        raise Misuse(WAITED_TOO_LONG(waited=waited_s))
