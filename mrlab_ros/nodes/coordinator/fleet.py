"""The members of a robot system in the graph, and the hosts that play them.

What is checked of the members of a new system before any robot is touched.
"""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Mapping, Sequence
from typing import Any, Protocol

from mrlab_msgs import msg, srv
from rclpy.client import Client
from rclpy.node import Node

from mrlab_ros.core.base.diagnostic import Diagnostic, heard
from mrlab_ros.core.base.errors import BadInput, Misuse
from mrlab_ros.core.playback.diagnostics import (
    MEMBER_OF_SYSTEM,
    NOT_PLAYED,
    NOT_STANDING,
    OF_ROBOT,
)
from mrlab_ros.core.playback.states import State
from mrlab_ros.core.runtime.process_states import ProcessState
from mrlab_ros.core.systems.diagnostics import (
    NO_STATE_OF_ROBOT,
    NO_TRAJECTORY_LOADED,
    PLAYBACK_SILENT,
)
from mrlab_ros.core.systems.members import Command, Loaded, Order, Reply
from mrlab_ros.core.systems.robot_system import RobotSystem
from mrlab_ros.core.trajectory.trajectory import check_fits
from mrlab_ros.messages import qos
from mrlab_ros.messages.systems import (
    loaded_from_message,
    order_to_message,
    reply_from_message,
)
from mrlab_ros.messages.time import time_from_message
from mrlab_ros.ros.calls import NoAnswer, call_all, call_each
from mrlab_ros.ros.clock import LabClock
from mrlab_ros.ros.decoding import subscribe

# A playback loads a trajectory within this time, and publishes its state within this time, s.
LOAD_TIMEOUT_S = 15.0
FIND_TIMEOUT_S = 4.0
# A host carries out an order within this time, s; otherwise it counts as frozen.
ORDER_TIMEOUT_S = 2.0
RETRY_PERIOD_S = 0.1


class Reports(Protocol):
    """Takes what members publish, in the thread that receives it."""

    def accepts(self, lab: str) -> bool: ...

    def on_state(self, client: MemberClient, message: msg.PlaybackState) -> None: ...

    def on_grasp(self, robot: str, held: str | None) -> None: ...


class MemberClient:
    """The services and topics of one member."""

    def __init__(self, node: Node, robot: str, reports: Reports) -> None:
        self.robot = robot
        # The newest state that the playback published.
        self.state: msg.PlaybackState | None = None
        self._changed = threading.Condition()
        self._node = node
        self._reports = reports
        self.load = self._node.create_client(
            srv.LoadTrajectory, f"/{robot}/load", qos_profile=qos.SERVICES
        )
        self._subscriptions = [
            subscribe(self._node, kind, f"/{robot}/{topic}", callback, qos.LATCHED_EVENTS)
            for kind, topic, callback in (
                (msg.PlaybackState, "playback_state", self._on_state),
                (msg.Grasp, "grasp", self._on_grasp),
            )
        ]

    def wait(self, deadline: float) -> msg.PlaybackState:
        """Return the newest state; raise NoAnswer where none came by `deadline`, monotonic s."""
        with self._changed:
            left = max(deadline - time.monotonic(), 0.0)
            self._changed.wait_for(lambda: self.state is not None, left)
        if self.state is None:
            raise NoAnswer(NO_STATE_OF_ROBOT(robot=self.robot))
        return self.state

    def wait_for_newer(self, known: msg.PlaybackState, timeout: float) -> bool:
        """Return whether a state after `known` came within `timeout` s."""
        with self._changed:
            return self._changed.wait_for(lambda: self.state is not known, timeout)

    def host(self) -> str:
        """Return the node that plays the robot; raise NoAnswer where none publishes its state."""
        return str(self.wait(time.monotonic() + FIND_TIMEOUT_S).host)

    @property
    def known_host(self) -> str:
        """The node that played the robot last; empty: none has published its state."""
        return "" if self.state is None else str(self.state.host)

    def forget(self) -> None:
        """Forget the state of a playback whose process ended: its next one publishes its own."""
        with self._changed:
            self.state = None

    def _on_state(self, message: msg.PlaybackState) -> None:
        if not self._reports.accepts(message.lab):
            return
        with self._changed:
            self.state = message
            self._changed.notify_all()
        self._reports.on_state(self, message)

    def _on_grasp(self, message: msg.Grasp) -> None:
        held = message.object if message.state == msg.Grasp.HOLDING else None
        self._reports.on_grasp(self.robot, held)

    def close(self) -> None:
        for subscription in self._subscriptions:
            self._node.destroy_subscription(subscription)
        self._node.destroy_client(self.load)


class RosFleet:
    """The members of one system, commanded through the hosts that play them."""

    def __init__(
        self, system: str, members: Mapping[str, MemberClient], hosts: Hosts, clock: LabClock
    ) -> None:
        self._system = system
        self._members = members
        self._hosts = hosts
        self._clock = clock

    def claim(self, robots: Sequence[str]) -> list[Loaded]:
        """Make the robots members of the system; wait for a host that is just starting."""
        orders = [Order(robot, Command.CLAIM) for robot in robots]
        deadline = time.monotonic() + FIND_TIMEOUT_S
        while True:
            try:
                sent = self._send(orders)
                break
            except Misuse as error:
                if error.diagnostic.code != NOT_PLAYED.code or time.monotonic() > deadline:
                    raise
            time.sleep(RETRY_PERIOD_S)
        return [loaded_from_message(reply, stamp_ns) for reply, stamp_ns in sent]

    def release(self, robots: Sequence[str]) -> None:
        """Let the robots leave the system."""
        self._send([Order(robot, Command.RELEASE) for robot in robots])

    def load(self, trajectories: Mapping[str, str]) -> None:
        """Load trajectories on robots that are no members; raise Misuse where one is refused."""
        calls = [
            (self._members[robot].load, srv.LoadTrajectory.Request(id=trajectory_id))
            for robot, trajectory_id in trajectories.items()
        ]
        answers = call_all(calls, LOAD_TIMEOUT_S)
        for robot, answer in zip(trajectories, answers, strict=True):
            if not answer.success:
                raise Misuse(OF_ROBOT(robot=robot, why=heard(answer)))

    def drive(self, orders: Sequence[Order]) -> list[Reply]:
        return [reply_from_message(reply, stamp_ns) for reply, stamp_ns in self._send(orders)]

    def leave(self, orders: Sequence[Order]) -> None:
        by_host: dict[str, list[Order]] = {}
        for order in orders:
            by_host.setdefault(self._members[order.robot].known_host, []).append(order)
        calls = [(self._hosts.client(host), self._request(part)) for host, part in by_host.items()]
        call_each(calls, 0.0)

    def reach(self, orders: Sequence[Order], timeout: float | None = None) -> list[Reply | None]:
        """Send each order in a request of its own, all at once."""
        hosts = [self._members[order.robot].known_host for order in orders]
        calls = [
            (self._hosts.client(host), self._request([order]))
            for host, order in zip(hosts, orders, strict=True)
            if host
        ]
        limit = ORDER_TIMEOUT_S if timeout is None else timeout
        answers = iter(call_each(calls, limit, self._hosts.gone_from_now_on()))
        return [self._reply(next(answers)) if host else None for host in hosts]

    def _request(self, orders: Sequence[Order]) -> srv.CommandMembers.Request:
        shifted_ns = self._clock.shifted_ns
        return srv.CommandMembers.Request(
            system=self._system, orders=[order_to_message(order, shifted_ns) for order in orders]
        )

    def _send(self, orders: Sequence[Order]) -> list[tuple[msg.DriveReply, int]]:
        """Send each host its members' orders, all hosts at once.

        Returns for each order its reply and the instant, ns, when it was carried out.
        """
        by_host: dict[str, list[Order]] = {}
        for order in orders:
            by_host.setdefault(self._members[order.robot].host(), []).append(order)
        answers = call_each(
            [(self._hosts.client(host), self._request(part)) for host, part in by_host.items()],
            ORDER_TIMEOUT_S,
            self._hosts.gone_from_now_on(),
        )
        replies = {}
        for part, answer in zip(by_host.values(), answers, strict=True):
            if isinstance(answer, NoAnswer):
                robots = [order.robot for order in part]
                silent = PLAYBACK_SILENT(robots=robots, timeout=ORDER_TIMEOUT_S)
                raise NoAnswer(silent) from answer
            if not answer.success:
                raise Misuse(heard(answer))
            stamp_ns = self._clock.instant(time_from_message(answer.stamp))
            replies.update({reply.robot: (reply, stamp_ns) for reply in answer.replies})
        return [replies[order.robot] for order in orders]

    def _reply(self, answer: Any) -> Reply | None:
        """Return what a robot that was asked by itself replies; None: it did not answer."""
        if isinstance(answer, NoAnswer):
            return None
        stamp_ns = self._clock.instant(time_from_message(answer.stamp))
        if not answer.success:
            return Reply(State.IDLE, 0.0, stamp_ns=stamp_ns)
        return reply_from_message(answer.replies[0], stamp_ns)


class Hosts:
    """Clients of the playback hosts' command_members services, one a host."""

    def __init__(self, node: Node) -> None:
        self._node = node
        self._clients: dict[str, Client] = {}
        # By service when the process behind it ended or froze last, ns of the monotonic clock.
        self._down_ns: dict[str, int] = {}

    def go_down(self, process: ProcessState) -> None:
        """Note that the hosts of a process ended or froze; from any thread."""
        for host in list(self._clients):
            if process.holds(host):
                self._down_ns[self._clients[host].srv_name] = process.down_steady_ns

    def gone_from_now_on(self) -> Callable[[Client], bool]:
        """Return what finds the clients whose host ends or freezes after this call."""
        began_ns = time.monotonic_ns()
        return lambda client: self._down_ns.get(client.srv_name, 0) > began_ns

    def client(self, host: str) -> Client:
        if host not in self._clients:
            service = f"{host}/command_members"
            self._clients[host] = self._node.create_client(
                srv.CommandMembers, service, qos_profile=qos.SERVICES
            )
        return self._clients[host]


# The converter answers what it has of a trajectory within this time, s.
CATALOGUE_TIMEOUT_S = 4.0
# A robot that a system takes stands, and nothing waits to be cleared.
FREE = (State.IDLE, State.READY, State.PAUSED)
# A new subscription receives the last states of a robot one after another: one that refuses the
# robot counts once no newer one has followed for this time, s.
SETTLED_S = 0.25


class MemberChecks:
    """Checks that robots are free, that their trajectories exist and fit, and the waits.

    node: is spun by another thread than the one that checks.
    """

    def __init__(self, node: Node) -> None:
        self._get = node.create_client(
            srv.GetTrajectory, "/converter/get_any", qos_profile=qos.SERVICES
        )

    def check(
        self,
        system: RobotSystem,
        clients: Mapping[str, MemberClient],
        robots: Mapping[str, msg.Robot],
    ) -> None:
        """Raise LabError where `system` cannot be made of its members; nothing is changed."""
        deadline = time.monotonic() + FIND_TIMEOUT_S
        wanted: dict[str, str] = {}
        for member in system.members.values():
            robot, client = member.robot, clients[member.robot]
            while True:
                state = client.wait(deadline)
                why = _not_free(robot, state, system.name, member.trajectory_id)
                if why is None:
                    break
                if not client.wait_for_newer(state, SETTLED_S):
                    raise Misuse(why)
            if member.trajectory_id not in ("", state.trajectory_id):
                wanted[robot] = member.trajectory_id
            else:
                member.duration, member.frame_rate = state.duration, state.frame_rate
        known = self._trajectories(set(wanted.values()))
        for robot, trajectory_id in wanted.items():
            trajectory, placed = known[trajectory_id], robots[robot]
            info = trajectory.info
            check_fits(
                info.id,
                (info.robot_model, tuple(trajectory.joint_names), info.end_effector),
                (placed.model, tuple(placed.joint_names), placed.end_effector),
            )
            member = system.members[robot]
            member.duration, member.frame_rate = info.duration, info.frame_rate
        system.check()

    def _trajectories(self, ids: set[str]) -> dict[str, Any]:
        """Return what the catalogue has; raise BadInput where it lacks one."""
        requests = [srv.GetTrajectory.Request(id=name, file_only=True) for name in sorted(ids)]
        found = {}
        answers = call_all([(self._get, request) for request in requests], CATALOGUE_TIMEOUT_S)
        for request, answer in zip(requests, answers, strict=True):
            if not answer.success:
                raise BadInput(heard(answer))
            found[request.id] = answer.trajectory
        return found


def _not_free(
    robot: str, state: msg.PlaybackState, system: str, trajectory: str
) -> Diagnostic | None:
    """Return why a robot cannot become a member of `system`; None: it can.

    trajectory: what it shall load; empty: it plays what it has.
    """
    if not (trajectory or state.trajectory_id):
        return NO_TRAJECTORY_LOADED(robot=robot)
    if state.system == system:
        # This coordinator has no system of that name: it died, and its claim has not run out yet.
        return None
    if state.system:
        return MEMBER_OF_SYSTEM(robot=robot, system=state.system)
    if State(state.state) not in FREE:
        return NOT_STANDING(robot=robot, state=state.label)
    return None
