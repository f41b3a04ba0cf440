"""The coordinator node: robot systems and their services."""

from __future__ import annotations

import threading
from collections.abc import Callable, Sequence
from functools import partial
from typing import Any

from mrlab_msgs import msg, srv
from rclpy.client import Client
from rclpy.context import Context
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.service import Service
from std_srvs.srv import SetBool, Trigger

from mrlab_ros.core.errors import BadInput, LabError, Misuse
from mrlab_ros.core.playback.states import State
from mrlab_ros.core.systems.members import Command, Loaded, Order, Reply
from mrlab_ros.core.systems.registry import Systems
from mrlab_ros.core.systems.robot_system import Policy, RobotSystem
from mrlab_ros.core.systems.timeline import Mode
from mrlab_ros.messages import qos
from mrlab_ros.messages.systems import (
    loaded_from_message,
    member_from_message,
    order_to_message,
    reply_from_message,
    system_to_message,
    systems_to_message,
)
from mrlab_ros.messages.time import time_from_message
from mrlab_ros.nodes import parameters
from mrlab_ros.nodes.parameters import CoordinatorParameters
from mrlab_ros.ros.answers import answered
from mrlab_ros.ros.calls import NoAnswer, call, call_all
from mrlab_ros.ros.parameters import ParameterNode
from mrlab_ros.ros.spinning import Caller
from mrlab_ros.ros.worker import Worker

# Period at which an active system is polled, s.
POLL_PERIOD_S = 0.02
# A playback loads a trajectory within this time, and publishes its state within this time, s.
LOAD_TIMEOUT_S = 15.0
FIND_TIMEOUT_S = 5.0


class MemberClient:
    """The services and topics of one member."""

    def __init__(self, coordinator: CoordinatorNode, robot: str) -> None:
        self.robot = robot
        self._host = ""
        self._known = threading.Event()
        self._coordinator = coordinator
        self._node = coordinator.caller.node
        self.load = self._node.create_client(
            srv.LoadTrajectory, f"/{robot}/load", qos_profile=qos.SERVICES
        )
        self._subscriptions = [
            self._node.create_subscription(kind, f"/{robot}/{topic}", callback, qos.LATCHED_EVENTS)
            for kind, topic, callback in (
                (msg.PlaybackState, "playback_state", self._on_state),
                (msg.Grasp, "grasp", self._on_grasp),
            )
        ]

    def host(self) -> str:
        """Return the node that plays the robot; raise NoAnswer where none publishes its state."""
        if not self._known.wait(FIND_TIMEOUT_S):
            raise NoAnswer(
                f"no playback publishes the state of {self.robot}; is the playback running?"
            )
        return self._host

    def _on_state(self, message: msg.PlaybackState) -> None:
        self._host = str(message.host)
        self._known.set()
        self._coordinator.worker.later(lambda: self._coordinator.on_state(self, message))

    def _on_grasp(self, message: msg.Grasp) -> None:
        held = message.object if message.state == msg.Grasp.HOLDING else None
        self._coordinator.worker.later(lambda: self._coordinator.on_grasp(self.robot, held))

    def close(self) -> None:
        for subscription in self._subscriptions:
            self._node.destroy_subscription(subscription)
        self._node.destroy_client(self.load)


class RosFleet:
    """The members of one system, commanded through the hosts that play them."""

    def __init__(self, system: str, members: dict[str, MemberClient], hosts: Hosts) -> None:
        self._system = system
        self._members = members
        self._hosts = hosts

    def claim(self, robot: str) -> Loaded:
        """Make the robot a member of the system."""
        [(reply, stamp_ns)] = self._send([Order(robot, Command.CLAIM)])
        return loaded_from_message(reply, stamp_ns)

    def release(self, robot: str) -> None:
        """Let the robot leave the system."""
        self._send([Order(robot, Command.RELEASE)])

    def load(self, robot: str, trajectory_id: str) -> None:
        """Load a trajectory on a robot that is no member; raise Misuse where it is refused."""
        request = srv.LoadTrajectory.Request(id=trajectory_id)
        answer = call(self._members[robot].load, request, LOAD_TIMEOUT_S)
        if not answer.success:
            raise Misuse(f"{robot}: {answer.message}")

    def drive(self, orders: Sequence[Order]) -> list[Reply]:
        return [reply_from_message(reply, stamp_ns) for reply, stamp_ns in self._send(orders)]

    def _send(self, orders: Sequence[Order]) -> list[tuple[msg.DriveReply, int]]:
        """Send each host its members' orders, all hosts at once.

        Returns for each order its reply and when it was carried out, ns.
        """
        by_host: dict[str, list[msg.DriveOrder]] = {}
        for order in orders:
            by_host.setdefault(self._members[order.robot].host(), []).append(
                order_to_message(order)
            )
        answers = call_all(
            [
                (
                    self._hosts.client(host),
                    srv.CommandMembers.Request(system=self._system, orders=part),
                )
                for host, part in by_host.items()
            ]
        )
        replies = {}
        for answer in answers:
            if not answer.success:
                raise Misuse(answer.message)
            stamp_ns = time_from_message(answer.stamp)
            replies.update({reply.robot: (reply, stamp_ns) for reply in answer.replies})
        return [replies[order.robot] for order in orders]


class Hosts:
    """Clients of the playback hosts' command_members services, one a host."""

    def __init__(self, node: Node) -> None:
        self._node = node
        self._clients: dict[str, Client] = {}

    def client(self, host: str) -> Client:
        if host not in self._clients:
            service = f"{host}/command_members"
            self._clients[host] = self._node.create_client(
                srv.CommandMembers, service, qos_profile=qos.SERVICES
            )
        return self._clients[host]


class CoordinatorNode(ParameterNode[CoordinatorParameters]):
    """Creates and dissolves systems, and offers the services of each below its name."""

    def __init__(
        self,
        *,
        context: Context | None = None,
        parameter_overrides: list[Parameter] | None = None,
    ) -> None:
        super().__init__(
            "coordinator",
            CoordinatorParameters,
            parameters.ALL,
            context=context,
            parameter_overrides=parameter_overrides,
        )
        self.caller = Caller(self)
        self._hosts = Hosts(self.caller.node)
        self._systems = Systems()
        self._members: dict[str, MemberClient] = {}
        self._fleets: dict[str, RosFleet] = {}
        self._offered: dict[str, list[Service]] = {}
        self._robots: frozenset[str] = frozenset()
        # Every use of a system runs in this one thread, one after another.
        self.worker = Worker("coordinator", self._poll, self._poll_period)
        self._topic = self.create_publisher(msg.RobotSystems, "/systems", qos.LATCHED_EVENTS)
        self.create_subscription(msg.Robots, "/robots", self._on_robots, qos.LATCHED)
        self.create_service(
            srv.CreateSystem, "~/create_system", self._create, qos_profile=qos.SERVICES
        )
        self.create_service(
            srv.Remove, "~/dissolve_system", self._dissolve, qos_profile=qos.SERVICES
        )
        self._publish()

    def destroy_node(self) -> None:
        self.worker.close()
        self.caller.close()
        super().destroy_node()

    # services -------------------------------------------------------------------------------

    @answered
    def _create(self, request: Any, response: Any) -> str:
        return str(self.worker.do(lambda: self._do_create(request, response)))

    @answered
    def _dissolve(self, request: Any, response: Any) -> str:
        return str(self.worker.do(lambda: self._do_dissolve(request.name, "dissolved")))

    def _do_create(self, request: Any, response: Any) -> str:
        try:
            mode, policy = Mode(request.mode), Policy(request.policy)
        except ValueError:
            raise BadInput(
                f"mode {request.mode} with policy {request.policy} is unknown; expected 0 "
                "(parallel) or 1 (sequential), and 0 (halt all) or 1 (halt member)"
            ) from None
        members = [member_from_message(member) for member in request.members]
        robots = [member.robot for member in members]
        name = self._systems.check(request.name, robots, self._robots)
        fleet = self._fleets[name] = RosFleet(name, self._members, self._hosts)
        system = RobotSystem(name, members, fleet, mode, policy, request.loop, self._publish)
        self._systems.add(system)
        try:
            for robot in robots:
                self._members[robot] = MemberClient(self, robot)
            system.prepare()
        except Exception:
            self._do_dissolve(name, "")  # the answer says why
            raise
        self._offered[name] = [
            self.create_service(
                kind, f"/{name}/{service}", self._callback(name, action), qos_profile=qos.SERVICES
            )
            for kind, service, action in (
                (Trigger, "play", self._play),
                (Trigger, "pause", self._pause),
                (Trigger, "stop", self._stop),
                (srv.Seek, "seek", self._seek),
                (srv.Step, "step", self._step),
                (srv.SetRate, "set_rate", self._set_rate),
                (srv.SetMode, "set_mode", self._set_mode),
                (SetBool, "set_loop", self._set_loop),
            )
        ]
        self._publish()
        response.system = system_to_message(system)
        return f"{name} drives {', '.join(robots)}: {system.duration:g} s, {mode.name.lower()}"

    def _callback(
        self, name: str, action: Callable[[RobotSystem, Any], str]
    ) -> Callable[[Any, Any], Any]:
        def work(request: Any) -> str:
            try:
                return action(self._systems.get(name), request)
            finally:
                self._publish()

        @answered
        def callback(node: Any, request: Any, response: Any) -> str:
            return str(self.worker.do(lambda: work(request)))

        return lambda request, response: callback(self, request, response)

    def _do_dissolve(self, name: str, why: str) -> str:
        system = self._systems.dissolve(name)
        fleet = self._fleets.pop(name)
        for robot in system.members:
            client = self._members.get(robot)
            if client is None:
                continue
            if robot in self._robots:
                try:
                    fleet.release(robot)
                except LabError as error:
                    self.get_logger().warning(f"{robot} was not released: {error}")
            client.close()
            del self._members[robot]
        for service in self._offered.pop(name, []):
            self.destroy_service(service)
        self._publish()
        if why:
            self.get_logger().info(f"system {name}: {why}")
        return f"{name} is dissolved"

    def _play(self, system: RobotSystem, request: Any) -> str:
        staging = system.play(self._now_ns())
        return f"stages for {staging:.1f} s, then plays" if staging else "plays"

    def _pause(self, system: RobotSystem, request: Any) -> str:
        system.pause(self._now_ns())
        return f"paused at {system.clock.position:.3f} s"

    def _stop(self, system: RobotSystem, request: Any) -> str:
        system.stop(self._now_ns())
        return "stopped"

    def _seek(self, system: RobotSystem, request: Any) -> str:
        system.seek(self._now_ns(), request.position)
        return f"at {request.position:g} s"

    def _step(self, system: RobotSystem, request: Any) -> str:
        return f"at {system.step(self._now_ns(), request.frames):g} s"

    def _set_rate(self, system: RobotSystem, request: Any) -> str:
        system.set_rate(self._now_ns(), request.rate)
        return f"rate {request.rate:g}"

    def _set_mode(self, system: RobotSystem, request: Any) -> str:
        try:
            mode = Mode(request.mode)
        except ValueError:
            raise BadInput(
                f"mode {request.mode} is unknown; expected 0 (parallel) or 1 (sequential)"
            ) from None
        system.set_mode(mode)
        return f"{mode.name.lower()}, {system.duration:g} s"

    def _set_loop(self, system: RobotSystem, request: Any) -> str:
        system.loop = request.data
        return "loops" if request.data else "plays once"

    # reports, in the worker's thread --------------------------------------------------------

    def on_state(self, client: MemberClient, message: msg.PlaybackState) -> None:
        """Pass a member's published state on to its system."""
        system = self._systems.of(client.robot)
        if system is None or self._members.get(client.robot) is not client:
            return
        self._logged(
            partial(
                system.member_changed,
                self._now_ns(),
                client.robot,
                State(message.state),
                message.clock.position,
                time_from_message(message.header.stamp),
            )
        )

    def on_grasp(self, robot: str, held: str | None) -> None:
        """Pass on what `robot` holds to every system: a wait may name another system's robot."""
        for system in self._systems:
            self._logged(partial(system.grasped, self._now_ns(), robot, held))

    def _poll(self) -> None:
        for system in self._systems:
            self._logged(partial(system.poll, self._now_ns()))

    def _poll_period(self) -> float | None:
        return POLL_PERIOD_S if any(system.active for system in self._systems) else None

    def _logged(self, work: Callable[[], None]) -> None:
        """Do something without a caller: a failure is logged, and in the system's message."""
        try:
            work()
        except LabError as error:
            self.get_logger().warning(str(error))

    def _on_robots(self, message: msg.Robots) -> None:
        robots = frozenset(robot.name for robot in message.robots)
        self.worker.later(lambda: self._set_robots(robots))

    def _set_robots(self, robots: frozenset[str]) -> None:
        self._robots = robots
        for system, missing in self._systems.without_members(robots):
            self._do_dissolve(system.name, f"{', '.join(missing)} left the scene")

    # messages -------------------------------------------------------------------------------

    def _now_ns(self) -> int:
        return int(self.get_clock().now().nanoseconds)

    def _publish(self) -> None:
        self._topic.publish(systems_to_message(self._now_ns(), self._systems))
