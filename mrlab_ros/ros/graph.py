"""A client of the graph for commands: call services, watch topics, each with a time-out."""

from __future__ import annotations

import threading
import time
from abc import ABC, abstractmethod
from collections.abc import Callable, Collection
from types import TracebackType
from typing import TYPE_CHECKING, Generic, TypeVar

from mrlab_msgs import msg, srv
from rclpy.qos import QoSProfile

from mrlab_ros.core.base.diagnostic import Answer, Fix, heard
from mrlab_ros.core.base.diagnostics import NO_ROBOT_IN_SCENE
from mrlab_ros.core.base.errors import Misuse
from mrlab_ros.core.base.names import close_to
from mrlab_ros.messages import qos
from mrlab_ros.ros.calls import NoAnswer
from mrlab_ros.ros.decoding import undecoded
from mrlab_ros.ros.diagnostics import NO_LAB_ANSWERS, NOT_AS_AWAITED, NOTHING_CAME

if TYPE_CHECKING:
    from message_bases import Service

T = TypeVar("T")
Request = TypeVar("Request")
Response = TypeVar("Response")
Said = TypeVar("Said", bound=Answer)
C = TypeVar("C", bound="GraphClient")
# How long a command waits for the lab to be found, s: discovery takes up to 3 s.
FIND_TIMEOUT_S = 6.0
CALL_TIMEOUT_S = 15.0
# The messages that a latched topic keeps for late joiners arrive oldest first, with pauses shorter
# than this, s.
LATCHED_BURST_S = 0.5


class Watch(Generic[T]):
    """The newest message of one topic, and a way to wait for one with a property."""

    def __init__(self, topic: str) -> None:
        self.topic = topic
        self.value: T | None = None
        self._changed = threading.Condition()

    def set(self, value: T) -> None:
        with self._changed:
            self.value = value
            self._changed.notify_all()

    def wait(self, wanted: Callable[[T], bool], timeout: float) -> T:
        """Return the present value or the first later one for which `wanted` is true.

        Raises NoAnswer after `timeout` s.
        """
        deadline = time.monotonic() + timeout
        with self._changed:
            while self.value is None or not wanted(self.value):
                if not self._changed.wait(max(deadline - time.monotonic(), 0.0)):
                    code = NOTHING_CAME if self.value is None else NOT_AS_AWAITED
                    raise NoAnswer(code(topic=self.topic, timeout=timeout))
            return self.value


class GraphClient(ABC):
    """A client of a running lab; use it as a context manager.

    domain: the lab's ROS domain. prompt: a watch of a latched topic has its value at once, and
    what is not there then was never published.
    """

    domain: int
    prompt = False

    @abstractmethod
    def close(self) -> None:
        """End every subscription and free what the client holds."""

    def __enter__(self: C) -> C:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self.close()

    @abstractmethod
    def subscribe(
        self, kind: type[T], topic: str, callback: Callable[[T], None], quality: QoSProfile
    ) -> None:
        """Call `callback` with every message of `topic`, in a thread of the client's own.

        quality: what is asked for; a topic that offers less is heard as it is offered.
        """

    def watch(self, kind: type[T], topic: str, quality: QoSProfile = qos.LATCHED) -> Watch[T]:
        """Follow `topic`, latched unless `quality` says otherwise."""
        watch: Watch[T] = Watch(topic)
        self.subscribe(kind, topic, watch.set, quality)
        return watch

    @abstractmethod
    def call(
        self,
        kind: type[Service[Request, Response]],
        service: str,
        request: Request,
        timeout: float = CALL_TIMEOUT_S,
        find_timeout: float = FIND_TIMEOUT_S,
    ) -> Response:
        """Return the service's answer, whatever it says; raise NoAnswer where none comes."""

    @abstractmethod
    def node_names(self) -> Collection[str]:
        """Return the names of the nodes in the graph."""

    @abstractmethod
    def is_published(self, topic: str) -> bool:
        """Return whether `topic` has a publisher."""

    @abstractmethod
    def is_offered(self, service: str) -> bool:
        """Return whether `service` has a server, after waiting for discovery where need be."""

    def kept(self, kind: type[T], topic: str) -> list[tuple[float, T]]:
        """Return the age in s, and the message, of each that a prompt client gets no stream of."""
        return []

    def order(
        self,
        kind: type[Service[Request, Said]],
        service: str,
        request: Request,
        timeout: float = CALL_TIMEOUT_S,
    ) -> Said:
        """Call a service and return its answer; raise Misuse with its message where it refuses."""
        answer = self.call(kind, service, request, timeout)
        if not answer.success:
            raise Misuse(heard(answer))
        return answer

    def robots(self, timeout: float = FIND_TIMEOUT_S) -> list[msg.Robot]:
        """Return the robots of the scene; raise NoAnswer where no lab publishes any."""
        watch = self.watch(msg.Robots, "/robots")
        try:
            robots = watch.wait(lambda _: True, timeout).robots
        except NoAnswer:
            for foreign in undecoded():
                if foreign.values["topic"] == "/robots":
                    raise NoAnswer(foreign) from None
            raise NoAnswer(NO_LAB_ANSWERS(domain=self.domain, fixes=self.advice())) from None
        return robots

    def robot(self, name: str) -> msg.Robot:
        """Return the robot called `name`; raise Misuse that names the others."""
        robots = self.robots()
        for robot in robots:
            if robot.name == name:
                return robot
        known = [robot.name for robot in robots]
        raise Misuse(
            NO_ROBOT_IN_SCENE(
                robot=name,
                known=known,
                close=close_to(name, known),
                fixes=() if known else (Fix(command="mrlab spawn ur5e"),),
            )
        )

    def catalogue(self) -> list[msg.TrajectoryInfo]:
        """Return what there is to load; raise Misuse where the store does not say it."""
        answer = self.order(
            srv.ListTrajectories, "/converter/list_any", srv.ListTrajectories.Request()
        )
        return answer.trajectories

    def advice(self) -> tuple[Fix, ...]:
        """Return what to do where a part of the lab does not answer."""
        return (Fix(command="mrlab status" if "lab" in self.node_names() else "up"),)
