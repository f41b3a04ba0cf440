"""Services: failures as `success = false` with the reason, deferred answers, late requests.

Services of one node can share a worker that carries their requests out one after another.
"""

from __future__ import annotations

import contextlib
import functools
import time
from collections import defaultdict
from collections.abc import Callable
from concurrent.futures import CancelledError, Future
from typing import TYPE_CHECKING, Any, TypeAlias, TypeVar

from rclpy.impl.implementation_singleton import rclpy_implementation
from rclpy.node import Node
from rclpy.service import Service

from mrlab_ros.core.base.diagnostic import Diagnostic
from mrlab_ros.core.base.errors import LabError, Misuse
from mrlab_ros.messages import qos
from mrlab_ros.messages.texts import tell
from mrlab_ros.ros import clock
from mrlab_ros.ros.diagnostics import (
    FAULT,
    SERVICE_ENDED,
    WAITED_TOO_LONG,
)
from mrlab_ros.ros.moves import moves
from mrlab_ros.ros.worker import Worker

if TYPE_CHECKING:
    from message_bases import Service as TypeOfService

Request = TypeVar("Request")
Response = TypeVar("Response")
# A service, its request and its response are of any type here.
ServiceType: TypeAlias = "type[TypeOfService[Any, Any]]"
ServiceCallback: TypeAlias = Callable[[Any, Any], Any]
DeferredCallback: TypeAlias = "Callable[[Any, Any], Future[Any]]"
Send: TypeAlias = Callable[[Any], None]

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

    def offer(self, kind: ServiceType, name: str, action: ServiceCallback) -> Service:
        """Create a service whose `action(request, response)` returns what to say."""
        may_be_late = not moves(self._node.resolve_service_name(name), kind)

        @answered
        def in_turn(_: Node, call: tuple[Request, float], response: Response) -> Diagnostic:
            request, came = call
            if not may_be_late:
                _refuse_overdue(time.monotonic() - came)
            said: Diagnostic = action(request, response)
            return said

        def begin(request: Request, response: Response) -> Future[Response]:
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


def answered(callback: Callable[..., Diagnostic | str | None]) -> Callable[..., Any]:
    """Wrap `callback(self, request, response) -> what to say` as a rclpy service callback.

    The response says success with what is returned, or failure with what the LabError says.
    """

    @functools.wraps(callback)
    def wrapped(self: Node, request: object, response: Response) -> Response:
        try:
            tell(response, True, callback(self, request, response))
        except LabError as error:
            tell(response, False, error.diagnostic)
        except Exception as error:
            self.get_logger().error(f"{callback.__name__}: {error!r}")
            tell(response, False, FAULT(service=callback.__name__, error=repr(error)))
        return response

    return wrapped


def refusal(kind: Any, why: Diagnostic) -> Any:
    """Return a response of a service of type `kind` that says failure; None: it cannot say so."""
    response = kind.Response()
    if not hasattr(response, "success"):
        return None
    tell(response, False, why)
    return response


def end_service(node: Node, service: Any, why: Diagnostic) -> None:
    """Refuse the requests that wait for `service` with `why`, then destroy it.

    A request in the queue of a service that is destroyed would never be answered.
    """
    gone = rclpy_implementation.InvalidHandle, rclpy_implementation.RCLError
    answer = refusal(service.srv_type, why)
    with contextlib.suppress(*gone), service.handle:
        while answer is not None:
            _, header = service.handle.service_take_request(service.srv_type.Request)
            if header is None:
                break
            Service.send_response(service, answer, header)
    node.destroy_service(service)


def create_service(
    node: Node,
    kind: ServiceType,
    name: str,
    callback: ServiceCallback,
    halts: Callable[[Any], bool] = lambda request: False,
) -> Service:
    """Create a service whose `callback(request, response)` returns the response.

    A request that waited while this process did not run is refused: its caller was told that
    nobody answered. What stops an arm, and what changes nothing, is carried out however late:
    services that config/bridge.yaml declares with `moves: false`, and requests of which `halts`
    says so.
    """

    def work(request: Request, response: Response, send: Send) -> None:
        send(callback(request, response))

    return _offer(node, kind, name, work, halts)


def create_deferred_service(
    node: Node, kind: ServiceType, name: str, begin: DeferredCallback, **options: Any
) -> Service:
    """Create a service whose `begin(request, response)` returns a future of the response.

    The executor goes on at once; the response is sent by the thread that completes the future.
    Where the future is cancelled, the answer says that the service ended. A coroutine would be
    polled by the executor without pause, and a callback that waits would block the other
    callbacks of its thread. Late requests are refused as by create_service().
    """

    def work(request: Request, response: Response, send: Send) -> None:
        def forward(done: Future[Response]) -> None:
            try:
                answer = done.result()
            except CancelledError:
                answer = refusal(kind, SERVICE_ENDED(service=service.srv_name))
            # InvalidHandle: the service was destroyed meanwhile, nobody waits for the answer
            with contextlib.suppress(rclpy_implementation.InvalidHandle):
                if answer is not None and node.context.ok():
                    send(answer)

        begin(request, response).add_done_callback(forward)

    service = _offer(node, kind, name, work, lambda request: False, **options)
    return service


def _offer(
    node: Node,
    kind: ServiceType,
    name: str,
    work: Callable[[Any, Any, Send], None],
    halts: Callable[[Any], bool],
    **options: Any,
) -> Service:
    """Create a service whose work(request, response, send) is done where its response is sent.

    Only there rclpy hands out the header, which says when the request was sent.
    """
    service = node.create_service(
        kind, name, lambda *taken: taken, **options, qos_profile=qos.SERVICES
    )

    may_be_late = not moves(node.resolve_service_name(name), kind)

    def carry_out(taken: tuple[Any, Any], header: Any) -> None:
        def send(answer: Any) -> None:
            Service.send_response(service, answer, header)

        why = None if may_be_late or halts(taken[0]) else clock.why_late(header)
        refused = None if why is None else refusal(kind, why)
        if refused is None:
            work(*taken, send)
            return
        node.get_logger().warning(f"{service.srv_name}: {why}")
        send(refused)

    service.send_response = carry_out  # type: ignore[method-assign, assignment]
    return service
