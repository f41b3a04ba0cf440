"""The coordinator node: robot systems and their services."""

from __future__ import annotations

import secrets
import threading
import time
from collections.abc import Callable
from functools import partial
from typing import TYPE_CHECKING, Any

from mrlab_msgs import msg, srv
from mrlab_msgs.srv import SetLoop, Trigger
from rclpy.duration import Duration
from rclpy.service import Service

from mrlab_ros.adapters import threads
from mrlab_ros.adapters.journal_file import Journal
from mrlab_ros.core.base.diagnostic import Diagnostic
from mrlab_ros.core.base.errors import BadInput, LabError
from mrlab_ros.core.playback import diagnostics as playback
from mrlab_ros.core.playback.states import State
from mrlab_ros.core.runtime.bucket import Occurrences
from mrlab_ros.core.runtime.identity import Identity
from mrlab_ros.core.runtime.process_states import Deaths, ProcessState, Thaws
from mrlab_ros.core.systems import diagnostics as say
from mrlab_ros.core.systems import registry
from mrlab_ros.core.systems.members import Command, Order
from mrlab_ros.core.systems.registry import Systems
from mrlab_ros.core.systems.robot_system import RobotSystem
from mrlab_ros.core.systems.states import Policy, SystemState
from mrlab_ros.core.systems.timeline import Mode
from mrlab_ros.messages import qos
from mrlab_ros.messages.status import processes_from_message
from mrlab_ros.messages.systems import (
    member_from_message,
    system_to_message,
    systems_to_message,
)
from mrlab_ros.messages.time import time_from_message
from mrlab_ros.nodes import parameters
from mrlab_ros.nodes.coordinator.fleet import Hosts, MemberChecks, MemberClient, RosFleet
from mrlab_ros.nodes.parameters import CoordinatorParameters
from mrlab_ros.ros.calls import NoAnswer
from mrlab_ros.ros.clock import LabClock, every
from mrlab_ros.ros.decoding import subscribe
from mrlab_ros.ros.parameters import NodeArguments, ParameterNode
from mrlab_ros.ros.services import Turns
from mrlab_ros.ros.spinning import Caller
from mrlab_ros.ros.worker import Worker

if TYPE_CHECKING:
    from typing_extensions import Unpack

# Period at which an active system is polled, s.
POLL_PERIOD_S = 0.02
# How often the systems are published again, s.
RENEWAL_PERIOD_S = 1.0
# How long a message about systems waits for subscribers that have not received the last one.
ARRIVAL = Duration(seconds=0.05)


class CoordinatorNode(
    ParameterNode[CoordinatorParameters],
    name="coordinator",
    kind=CoordinatorParameters,
    others=parameters.ALL,
):
    """Creates and dissolves systems, and offers the services of each below its name."""

    def __init__(self, **ros: Unpack[NodeArguments]) -> None:
        super().__init__(**ros)
        log = self.get_logger()
        self.caller = Caller(self)
        self._identity = Identity(self.parameters.lab_id, lambda said: log.warning(str(said)))
        # After a restart another one.
        self._holder = secrets.token_hex(4)
        self._lab_clock = LabClock(self)
        # The shift of the clock with which the systems were published.
        self._shifted_ns = self._lab_clock.shifted_ns
        self._hosts = Hosts(self.caller.node)
        self._systems = Systems()
        self._members: dict[str, MemberClient] = {}
        self._fleets: dict[str, RosFleet] = {}
        self._publishing = threading.Lock()
        self._failures = Occurrences()
        # Diagnostics of state that could not be brought back.
        self.lost: list[Diagnostic] = []
        self._offered: dict[str, list[Service]] = {}
        self._robots: dict[str, msg.Robot] = {}
        self._checks = MemberChecks(self.caller.node)
        # Every use of a system runs in this one thread, one after another.
        self.worker = Worker("coordinator", self._poll, self._poll_period, on_error=self._named)
        self._turns = Turns(self, self.worker)
        self._topic = self.create_publisher(msg.RobotSystems, "/systems", qos.LATCHED)
        subscribe(self, msg.Robots, "/robots", self._on_robots, qos.LATCHED)
        self._deaths, self._thaws = Deaths(time.monotonic_ns()), Thaws()
        # Not in this node's thread either: what waits for a process that died must end.
        subscribe(
            self.caller.node, msg.LabProcesses, "/processes", self._on_processes, qos.LATCHED
        )
        self._turns.offer(srv.CreateSystem, "~/create_system", self._create)
        self._turns.offer(srv.Remove, "~/dissolve_system", self._dissolve)
        self._journal = Journal.of(self.parameters.state_dir, self.get_name(), log.error)
        self.worker.do(self._restore)
        self._publish()
        # Not in this node's thread, which waits for the worker: claims must not expire meanwhile.
        every(self.caller.node, RENEWAL_PERIOD_S, self._renew)

    def destroy_node(self) -> None:
        self._turns.close()
        self.worker.close()
        self.caller.close()
        self._journal.close()
        super().destroy_node()

    # services -------------------------------------------------------------------------------

    def _create(
        self, request: srv.CreateSystem.Request, response: srv.CreateSystem.Response
    ) -> Diagnostic:
        mode = _mode(request.mode)
        try:
            policy = Policy(request.policy)
        except ValueError:
            raise BadInput(say.BAD_POLICY(policy=request.policy)) from None
        members = [member_from_message(member) for member in request.members]
        robots = [member.robot for member in members]
        name = self._systems.check(request.name, robots, frozenset(self._robots))
        clients = {robot: MemberClient(self.caller.node, robot, self) for robot in robots}
        fleet = RosFleet(name, clients, self._hosts, self._lab_clock)
        system = RobotSystem(name, members, fleet, mode, policy, request.loop, self._publish)
        try:
            # Everything that can be refused is, before any robot is touched.
            self._checks.check(system, clients, self._robots)
            system.prepare()
        except Exception:
            for client in clients.values():
                client.close()
            raise
        self._adopt(system, clients, fleet)
        self._publish()
        response.system = system_to_message(system, self._lab_clock.shifted_ns)
        return say.SYSTEM_CREATED(
            system=name, robots=robots, duration=system.duration, mode=mode.name.lower()
        )

    def _dissolve(self, request: srv.Remove.Request, response: srv.Remove.Response) -> Diagnostic:
        return self._do_dissolve(request.name, "dissolved")

    def _adopt(
        self, system: RobotSystem, clients: dict[str, MemberClient], fleet: RosFleet
    ) -> None:
        """Keep a system, and offer its services below its name."""
        name = system.name
        self._systems.add(system)
        self._members.update(clients)
        self._fleets[name] = fleet
        self._offered[name] = [
            self._turns.offer(kind, f"/{name}/{service}", self._callback(name, action))
            for kind, service, action in (
                (Trigger, "play", self._play),
                (Trigger, "pause", self._pause),
                (Trigger, "stop", self._stop),
                (srv.Seek, "seek", self._seek),
                (srv.Step, "step", self._step),
                (srv.SetRate, "set_rate", self._set_rate),
                (srv.SetMode, "set_mode", self._set_mode),
                (SetLoop, "set_loop", self._set_loop),
            )
        ]

    def _callback(
        self, name: str, action: Callable[[RobotSystem, Any], Diagnostic]
    ) -> Callable[[Any, Any], Diagnostic]:
        def callback(request: object, response: object) -> Diagnostic:
            try:
                return action(self._systems.get(name), request)
            finally:
                self._publish()

        return callback

    def _do_dissolve(self, name: str, why: str) -> Diagnostic:
        system = self._systems.dissolve(name)
        fleet = self._fleets.pop(name)
        there = [robot for robot in system.members if robot in self._robots]
        orders = [Order(robot, Command.RELEASE) for robot in there]
        for robot, reply in zip(there, fleet.reach(orders), strict=True):
            if reply is None:
                self.get_logger().warning(
                    f"{robot} did not answer when {name} let it go; it is free once its playback "
                    "finds that the system is gone"
                )
        for robot in system.members:
            self._members.pop(robot).close()
        for service in self._offered.pop(name, []):
            self._turns.end(service, say.SYSTEM_GONE(system=name))
        self._publish()
        if why:
            self.get_logger().info(f"system {name}: {why}")
        return say.DISSOLVED(system=name)

    def _play(self, system: RobotSystem, request: Trigger.Request) -> Diagnostic:
        staging = system.play(self._now_ns())
        return say.STAGES(duration=staging) if staging else playback.PLAYS()

    def _pause(self, system: RobotSystem, request: Trigger.Request) -> Diagnostic:
        return system.pause(self._now_ns())

    def _stop(self, system: RobotSystem, request: Trigger.Request) -> Diagnostic:
        system.stop(self._now_ns())
        if system.state is SystemState.STOPPING and system.message is not None:
            raise NoAnswer(system.message)
        return playback.STOPPED()

    def _seek(self, system: RobotSystem, request: srv.Seek.Request) -> Diagnostic:
        system.seek(self._now_ns(), request.position)
        return playback.AT_POSITION(position=request.position)

    def _step(self, system: RobotSystem, request: srv.Step.Request) -> Diagnostic:
        position = system.step(self._now_ns(), request.frames)
        return playback.AT_POSITION(position=position)

    def _set_rate(self, system: RobotSystem, request: srv.SetRate.Request) -> Diagnostic:
        system.set_rate(self._now_ns(), request.rate)
        return playback.RATE_SET(rate=request.rate)

    def _set_mode(self, system: RobotSystem, request: srv.SetMode.Request) -> Diagnostic:
        mode = _mode(request.mode)
        system.set_mode(mode)
        return say.MODE_SET(mode=mode.name.lower(), duration=system.duration)

    def _set_loop(self, system: RobotSystem, request: SetLoop.Request) -> Diagnostic:
        system.loop = request.loop
        return playback.LOOPS() if request.loop else playback.PLAYS_ONCE()

    # reports --------------------------------------------------------------------------------

    def accepts(self, lab: str) -> bool:
        """Return whether a message that names `lab` is of this one."""
        return self._identity.accepts(lab)

    def on_state(self, client: MemberClient, message: msg.PlaybackState) -> None:
        """Pass a member's published state on to its system, in the worker's thread."""
        self.worker.send(lambda: self._member_changed(client, message))

    def on_grasp(self, robot: str, held: str | None) -> None:
        """Pass on what `robot` holds to every system: a wait may name another system's robot."""
        self.worker.send(lambda: self._grasped(robot, held))

    def _on_processes(self, message: msg.LabProcesses) -> None:
        """Take which processes ended or froze; calls that wait for one end at once."""
        if not self._identity.accepts(message.lab):
            return
        states = processes_from_message(message)
        for process in self._deaths.new(states):
            self._hosts.go_down(process)
            clients = self._played_by(process)
            if not process.frozen:
                for client in clients:
                    client.forget()
            self.worker.later(partial(self._go_down, process, clients))
        for process in self._thaws.new(states):
            self.worker.later(partial(self._run_again, self._played_by(process)))

    def _played_by(self, process: ProcessState) -> list[MemberClient]:
        clients = list(self._members.values())
        return [client for client in clients if process.holds(client.known_host)]

    def _go_down(self, process: ProcessState, clients: list[MemberClient]) -> None:
        now_ns, steady_ns = self._lab_clock.reading()
        at_ns = now_ns - (steady_ns - process.down_steady_ns)
        how = "" if process.frozen else process.last_exit
        for system, robots in self._members_of(clients):
            self._logged(partial(system.members_down, now_ns, at_ns, robots, process.name, how))

    def _run_again(self, clients: list[MemberClient]) -> None:
        for system, robots in self._members_of(clients):
            self._logged(partial(system.members_run, self._now_ns(), robots))

    def _members_of(self, clients: list[MemberClient]) -> list[tuple[RobotSystem, list[str]]]:
        """Return the systems with those of their members that are meant."""
        found = [(s, [c.robot for c in clients if c.robot in s.members]) for s in self._systems]
        return [(system, robots) for system, robots in found if robots]

    def _member_changed(self, client: MemberClient, message: msg.PlaybackState) -> None:
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
                self._lab_clock.instant(time_from_message(message.header.stamp)),
                message.system,
                message.trajectory_id,
            )
        )

    def _grasped(self, robot: str, held: str | None) -> None:
        for system in self._systems:
            self._logged(partial(system.grasped, self._now_ns(), robot, held))

    def _poll(self) -> None:
        for system in self._systems:
            self._logged(partial(system.poll, self._now_ns()))

    def _poll_period(self) -> float | None:
        return POLL_PERIOD_S if any(system.active for system in self._systems) else None

    def _logged(self, work: Callable[[], None]) -> None:
        """Do something without a caller: no error of one system stops the others."""
        try:
            work()
        except LabError as error:
            # It is in the system's message too. Systems are polled many times a second.
            if self._failures.again((str(error),), time.monotonic()) is not None:
                self.get_logger().warning(str(error))
        except Exception as error:
            self._named(error)

    def _named(self, error: Exception) -> None:
        """Name an error in the log, unless the graph was left meanwhile, which is no fault."""
        if self.context.ok():
            threads.name_error("coordinator", error)

    def _on_robots(self, message: msg.Robots) -> None:
        if not self._identity.obeys(message.lab):
            return
        robots = {robot.name: robot for robot in message.robots}
        self.worker.send(lambda: self._set_robots(robots))

    def _set_robots(self, robots: dict[str, msg.Robot]) -> None:
        self._robots = robots
        for system, missing in self._systems.without_members(frozenset(robots)):
            self._do_dissolve(system.name, f"{', '.join(missing)} left the scene")

    # messages -------------------------------------------------------------------------------

    def _now_ns(self) -> int:
        """Return the present instant; where the clock was set, publish the new stamps."""
        now_ns = self._lab_clock.instant_ns()
        if self._lab_clock.shifted_ns != self._shifted_ns:
            self._shifted_ns = self._lab_clock.shifted_ns
            self._publish()
        return now_ns

    def _renew(self) -> None:
        """Name the systems once a second: that keeps the claims on their robots.

        Without systems it is a sign of life for another lab on this domain.
        """
        if any(self._systems) or self._identity.others:
            self._publish()

    def _restore(self) -> None:
        """Bring back the systems of a coordinator that was killed, each where it stood."""
        for name, robots, entry in registry.read(self._journal.load()):
            clients = {robot: MemberClient(self.caller.node, robot, self) for robot in robots}
            fleet = RosFleet(name, clients, self._hosts, self._lab_clock)
            system = registry.restore(entry, fleet, self._publish, self._now_ns())
            if system is None:
                self.lost.append(say.SYSTEM_LOST(system=name))
                self.get_logger().error(str(self.lost[-1]))
                for client in clients.values():
                    client.close()
                continue
            self._adopt(system, clients, fleet)
            self.get_logger().info(f"the system {name} is back, {system.state.name}")

    def _publish(self) -> None:
        with self._publishing:
            now_ns = self._lab_clock.instant_ns()
            shifted_ns = self._lab_clock.shifted_ns
            # First: a coordinator that ends here comes back with it.
            self._journal.save(registry.plain(self._systems, now_ns))
            # Only the newest is kept for late joiners; the others must have arrived before.
            self._topic.wait_for_all_acked(ARRIVAL)
            self._topic.publish(
                systems_to_message(
                    now_ns, self._systems, self._identity.lab, self._holder, shifted_ns
                )
            )


def _mode(number: int) -> Mode:
    try:
        return Mode(number)
    except ValueError:
        raise BadInput(say.BAD_MODE(mode=number)) from None
