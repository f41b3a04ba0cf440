"""The coordinator node: systems of robots that play as one."""

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
from mrlab_ros.core.systems.members import Loaded, Order, Reply
from mrlab_ros.core.systems.registry import Systems
from mrlab_ros.core.systems.robot_system import Policy, RobotSystem
from mrlab_ros.core.systems.states import SystemState
from mrlab_ros.core.systems.timeline import Member, Mode
from mrlab_ros.core.systems.waits import parse
from mrlab_ros.messages import qos
from mrlab_ros.messages.playback import clock_to_message
from mrlab_ros.messages.time import make_header, time_from_message, time_to_message
from mrlab_ros.processes import host
from mrlab_ros.ros.answers import answered
from mrlab_ros.ros.calls import NoAnswer, call, call_all
from mrlab_ros.ros.spinning import Caller
from mrlab_ros.ros.worker import Worker

Claim = msg.DriveOrder
# How often a moving system looks for what time has made due, s.
POLL = 0.02
LOAD_TIMEOUT = 15.0
FIND_TIMEOUT = 5.0


class MemberClient:
    """What the coordinator holds of one robot: its services and its newest state."""

    def __init__(self, coordinator: CoordinatorNode, robot: str) -> None:
        self.robot = robot
        self.state: msg.PlaybackState | None = None
        self._known = threading.Event()
        # A state from before the last reply says nothing of how things are now.
        self.replied_ns = 0
        self._coordinator = coordinator
        self._node = coordinator.caller.node
        self.load = self._node.create_client(srv.LoadTrajectory, f"/{robot}/load")
        self._subscriptions = [
            self._node.create_subscription(kind, f"/{robot}/{topic}", callback, qos.LATCHED_EVENTS)
            for kind, topic, callback in (
                (msg.PlaybackState, "playback_state", self._on_state),
                (msg.Grasp, "grasp", self._on_grasp),
            )
        ]

    def host(self) -> str:
        """Return the node that plays the robot; raise NoAnswer where none says it does."""
        if not self._known.wait(FIND_TIMEOUT) or self.state is None:
            raise NoAnswer(
                f"no playback tells the state of {self.robot}; is the playback running?"
            )
        return str(self.state.host)

    def _on_state(self, message: msg.PlaybackState) -> None:
        self.state = message
        self._known.set()
        self._coordinator.worker.later(lambda: self._coordinator.follow(self, message))

    def _on_grasp(self, message: msg.Grasp) -> None:
        held = message.object if message.state == msg.Grasp.HOLDING else None
        self._coordinator.worker.later(lambda: self._coordinator.grasped(self.robot, held))

    def close(self) -> None:
        for subscription in self._subscriptions:
            self._node.destroy_subscription(subscription)
        self._node.destroy_client(self.load)


class RosFleet:
    """The members of one system, reached through the hosts that play them."""

    def __init__(self, system: str, links: dict[str, MemberClient], hosts: Hosts) -> None:
        self._system = system
        self._links = links
        self._hosts = hosts

    def prepare(self, robot: str, trajectory_id: str) -> Loaded:
        reply = self._send([msg.DriveOrder(robot=robot, command=Claim.CLAIM)])[0]
        if trajectory_id not in ("", reply.trajectory_id):
            # A member loads nothing by itself: it is let go for that.
            self.release(robot)
            request = srv.LoadTrajectory.Request(id=trajectory_id)
            answer = call(self._links[robot].load, request, LOAD_TIMEOUT)
            if not answer.success:
                raise Misuse(f"{robot}: {answer.message}")
            reply = self._send([msg.DriveOrder(robot=robot, command=Claim.CLAIM)])[0]
        if not reply.trajectory_id:
            raise Misuse(f"{robot} has no trajectory; load one, or name one for the system")
        return Loaded(reply.trajectory_id, reply.trajectory_duration, reply.frame_rate)

    def release(self, robot: str) -> None:
        self._send([msg.DriveOrder(robot=robot, command=Claim.RELEASE)])

    def drive(self, orders: Sequence[Order]) -> list[Reply]:
        replies = self._send(
            [
                msg.DriveOrder(
                    robot=order.robot,
                    command=order.command.value,
                    stamp=time_to_message(order.stamp_ns),
                    position=order.position,
                    rate=order.rate,
                    until=order.until or 0.0,
                )
                for order in orders
            ]
        )
        return [Reply(State(r.state), r.position, r.duration) for r in replies]

    def _send(self, orders: Sequence[msg.DriveOrder]) -> list[msg.DriveReply]:
        """Give each host its members' orders, all hosts at once; return the replies in order."""
        by_host: dict[str, list[msg.DriveOrder]] = {}
        for order in orders:
            by_host.setdefault(self._links[order.robot].host(), []).append(order)
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
            for reply in answer.replies:
                self._links[reply.robot].replied_ns = time_from_message(answer.stamp)
                replies[reply.robot] = reply
        for answer in answers:
            if not answer.success:
                raise Misuse(answer.message)
        return [replies[order.robot] for order in orders]


class Hosts:
    """Clients of the playback hosts' command_members services, one a host."""

    def __init__(self, node: Node) -> None:
        self._node = node
        self._clients: dict[str, Client] = {}

    def client(self, host: str) -> Client:
        if host not in self._clients:
            service = f"{host}/command_members"
            self._clients[host] = self._node.create_client(srv.CommandMembers, service)
        return self._clients[host]


class CoordinatorNode(Node):
    """Creates and dissolves systems and offers each one's services below its name."""

    def __init__(
        self,
        *,
        context: Context | None = None,
        parameter_overrides: list[Parameter] | None = None,
    ) -> None:
        super().__init__(
            "coordinator", context=context, parameter_overrides=parameter_overrides or []
        )
        self.caller = Caller(self)
        self._hosts = Hosts(self.caller.node)
        self._systems = Systems()
        self._links: dict[str, MemberClient] = {}
        self._fleets: dict[str, RosFleet] = {}
        self._offered: dict[str, list[Service]] = {}
        self._robots: frozenset[str] = frozenset()
        # All decisions are made in one thread, one after another.
        self.worker = Worker("coordinator", self._poll, self._patience)
        self._topic = self.create_publisher(msg.RobotSystems, "/systems", qos.LATCHED_EVENTS)
        self.create_subscription(msg.Robots, "/robots", self._on_robots, qos.LATCHED)
        self.create_service(srv.CreateSystem, "~/create_system", self._create)
        self.create_service(srv.Remove, "~/dissolve_system", self._dissolve)
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
        members = [
            Member(m.robot, m.trajectory_id, self._dwell(m.dwell), tuple(map(parse, m.waits)))
            for m in request.members
        ]
        robots = [member.robot for member in members]
        name = self._systems.check(request.name, robots, self._robots)
        fleet = self._fleets[name] = RosFleet(name, self._links, self._hosts)
        system = RobotSystem(name, members, fleet, mode, policy, request.loop)
        self._systems.add(system)
        try:
            for robot in robots:
                self._links[robot] = MemberClient(self, robot)
            system.prepare()
        except LabError:
            self._do_dissolve(name, "could not be created")
            raise
        self._offered[name] = [
            self.create_service(kind, f"/{name}/{service}", self._callback(name, action))
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
        response.system = self._message(system)
        return f"{name} drives {', '.join(robots)}: {system.duration:g} s, {mode.name.lower()}"

    @staticmethod
    def _dwell(dwell: float) -> float:
        if not 0 <= dwell < 3600:
            raise BadInput(f"the dwell is {dwell} s; expected 0 to 3600 s")
        return float(dwell)

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
            link = self._links.get(robot)
            if link is None:
                continue
            if robot in self._robots:
                try:
                    fleet.release(robot)
                except LabError as error:
                    self.get_logger().warning(f"{robot} was not released: {error}")
            link.close()
            del self._links[robot]
        for service in self._offered.pop(name, []):
            self.destroy_service(service)
        self._publish()
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

    # what happens, in the worker's thread ---------------------------------------------------

    def follow(self, link: MemberClient, message: msg.PlaybackState) -> None:
        """Take a member's state as its playback tells it."""
        system = self._systems.of(link.robot)
        stamp_ns = time_from_message(message.header.stamp)
        if system is None or link.robot not in self._links or stamp_ns < link.replied_ns:
            return
        before = system.state, system.message, self._held(system)
        self._guarded(
            lambda: system.member_changed(
                self._now_ns(), link.robot, State(message.state), message.clock.position
            )
        )
        self._announce(system, before)

    def grasped(self, robot: str, held: str | None) -> None:
        """Tell every system what `robot` holds: a wait may name a robot of another system."""
        for system in self._systems:
            before = system.state, system.message, self._held(system)
            self._guarded(partial(system.grasped, self._now_ns(), robot, held))
            self._announce(system, before)

    def _poll(self) -> None:
        for system in self._systems:
            before = system.state, system.message, self._held(system)
            self._guarded(partial(system.poll, self._now_ns()))
            self._announce(system, before)

    def _patience(self) -> float | None:
        active = (SystemState.STAGING, SystemState.PLAYING)
        return POLL if any(system.state in active for system in self._systems) else None

    def _guarded(self, work: Callable[[], None]) -> None:
        """Do something nobody waits for: a refusal is in the system's message, and logged."""
        try:
            work()
        except LabError as error:
            self.get_logger().warning(str(error))

    def _announce(self, system: RobotSystem, before: Any) -> None:
        if system.state is SystemState.COMPLETE:
            self._publish()
            self._guarded(lambda: system.rearm(self._now_ns()))
        if (system.state, system.message, self._held(system)) != before:
            self._publish()

    def _on_robots(self, message: msg.Robots) -> None:
        robots = frozenset(robot.name for robot in message.robots)
        self.worker.later(lambda: self._set_robots(robots))

    def _set_robots(self, robots: frozenset[str]) -> None:
        self._robots = robots
        for system in self._systems:
            gone = [robot for robot in system.members if robot not in robots]
            if gone:
                self._do_dissolve(system.name, f"{', '.join(gone)} left the scene")

    # messages -------------------------------------------------------------------------------

    def _now_ns(self) -> int:
        return int(self.get_clock().now().nanoseconds)

    @staticmethod
    def _held(system: RobotSystem) -> list[str]:
        return [w.text if (w := m.held_by) else "" for m in system.members.values()]

    def _message(self, system: RobotSystem) -> msg.RobotSystem:
        playing = system.state is SystemState.PLAYING
        return msg.RobotSystem(
            name=system.name,
            members=[
                msg.SystemMember(
                    robot=m.robot,
                    trajectory_id=m.trajectory_id,
                    start=m.start,
                    duration=m.duration,
                    dwell=m.dwell,
                    state=m.state.value,
                    position=m.position,
                    waits=[wait.text for wait in m.waits],
                    waiting_for=m.held_by.text if playing and m.held_by else "",
                )
                for m in system.members.values()
            ],
            mode=system.mode.value,
            policy=system.policy.value,
            state=system.state.value,
            label=system.state.name,
            message=system.message,
            clock=clock_to_message(system.clock),
            duration=system.duration,
            rate=system.rate,
            loop=system.loop,
        )

    def _publish(self) -> None:
        self._topic.publish(
            msg.RobotSystems(
                header=make_header(self._now_ns()),
                systems=[self._message(system) for system in self._systems],
            )
        )


def main() -> None:
    host.main(["coordinator"])
