"""The coordinator node: systems of robots that are staged and then play as one."""

from __future__ import annotations

from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from typing import Any

from mrlab_msgs import msg, srv
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup, ReentrantCallbackGroup
from rclpy.client import Client
from rclpy.context import Context
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.service import Service
from rclpy.subscription import Subscription
from std_srvs.srv import Trigger

from mrlab_ros import conversions, host, qos
from mrlab_ros.core.clock import PlaybackClock
from mrlab_ros.core.errors import BadInput, LabError, Misuse
from mrlab_ros.core.playback_states import State
from mrlab_ros.core.robot_systems import Member, RobotSystem, SystemEvent, Systems, SystemState
from mrlab_ros.nodes.answers import answered
from mrlab_ros.nodes.calls import call, call_all

Drive = srv.Drive.Request
# A common start lies this far ahead, so that every member knows of it in time, s.
LEAD = 0.1


class Link:
    """What the coordinator holds of one member: its services and its newest state."""

    def __init__(self, node: CoordinatorNode, robot: str) -> None:
        self.robot = robot
        self.state: msg.PlaybackState | None = None
        # States older than the last order say nothing of how it went, ns.
        self.ordered_ns = 0
        self._node = node
        group = node.client_group
        self.load: Client = node.create_client(
            srv.LoadTrajectory, f"/{robot}/load", callback_group=group
        )
        self.drive: Client = node.create_client(srv.Drive, f"/{robot}/drive", callback_group=group)
        self._subscription: Subscription = node.create_subscription(
            msg.PlaybackState,
            f"/{robot}/playback_state",
            self._on_state,
            qos.LATCHED,
            callback_group=node.state_group,
        )

    def _on_state(self, message: msg.PlaybackState) -> None:
        self.state = message
        self._node.member_changed(self.robot)

    def close(self) -> None:
        self._node.destroy_subscription(self._subscription)
        self._node.destroy_client(self.load)
        self._node.destroy_client(self.drive)


class CoordinatorNode(Node):
    """Creates and dissolves systems; plays, pauses and stops each as one."""

    def __init__(
        self,
        *,
        context: Context | None = None,
        parameter_overrides: list[Parameter] | None = None,
    ) -> None:
        super().__init__(
            "coordinator", context=context, parameter_overrides=parameter_overrides or []
        )
        self.client_group = ReentrantCallbackGroup()
        self.state_group = MutuallyExclusiveCallbackGroup()
        self._systems = Systems()
        self._links: dict[str, Link] = {}
        self._offered: dict[str, list[Service]] = {}
        self._robots: frozenset[str] = frozenset()
        # All decisions are made in one thread, one after another: no locks, no races.
        self._work = ThreadPoolExecutor(1, "coordinator")
        self._topic = self.create_publisher(msg.RobotSystems, "/systems", qos.LATCHED)
        self.create_subscription(
            msg.Robots, "/robots", self._on_robots, qos.LATCHED, callback_group=self.state_group
        )
        group = MutuallyExclusiveCallbackGroup()
        self.create_service(
            srv.CreateSystem, "~/create_system", self._create, callback_group=group
        )
        self.create_service(srv.Remove, "~/dissolve_system", self._dissolve, callback_group=group)
        self._publish()

    def destroy_node(self) -> None:
        self._work.shutdown(cancel_futures=True)
        super().destroy_node()

    def member_changed(self, robot: str) -> None:
        self._later(lambda: self._follow(robot))

    # services -------------------------------------------------------------------------------

    @answered
    def _create(self, request: Any, response: Any) -> str:
        return self._now(lambda: self._do_create(request, response))

    @answered
    def _dissolve(self, request: Any, response: Any) -> str:
        return self._now(lambda: self._do_dissolve(request.name, "dissolved"))

    def _do_create(self, request: Any, response: Any) -> str:
        if request.mode != msg.RobotSystem.PARALLEL:
            raise BadInput(f"mode {request.mode} is unknown to this lab; expected 0, parallel")
        if request.policy != msg.RobotSystem.HALT_ALL:
            raise BadInput(f"policy {request.policy} is unknown to this lab; expected 0, halt all")
        if request.loop:
            raise BadInput("this lab's systems play once; create the system without loop")
        members = [Member(m.robot, m.trajectory_id) for m in request.members]
        system = self._systems.create(request.name, members, self._robots)
        try:
            for member in members:
                link = self._links[member.robot] = Link(self, member.robot)
                if member.trajectory_id:
                    self._checked(
                        member.robot,
                        call(link.load, srv.LoadTrajectory.Request(id=member.trajectory_id), 15.0),
                    )
                self._order(system, [member], Drive.CLAIM)
        except LabError:
            self._do_dissolve(system.name, "could not be created")
            raise
        self._offered[system.name] = [
            self.create_service(
                Trigger, f"/{system.name}/{name}", self._trigger(system.name, action)
            )
            for name, action in (
                ("play", self._play),
                ("pause", self._pause),
                ("stop", self._stop),
            )
        ]
        response.system = self._message(system)
        self._publish()
        return f"{system.name} drives {', '.join(system.members)}"

    def _trigger(
        self, name: str, action: Callable[[RobotSystem], str]
    ) -> Callable[[Any, Any], Any]:
        @answered
        def callback(node: Any, request: Any, response: Any) -> str:
            return self._now(lambda: action(self._systems.get(name)))

        return lambda request, response: callback(self, request, response)

    def _do_dissolve(self, name: str, why: str) -> str:
        system = self._systems.dissolve(name)
        for robot in system.members:
            link = self._links.pop(robot, None)
            if link is None:
                continue
            if robot in self._robots:
                try:
                    self._ask(link, system, Drive.RELEASE)
                except LabError as error:
                    self.get_logger().warning(f"{robot} was not released: {error}")
            link.close()
        for service in self._offered.pop(name, []):
            self.destroy_service(service)
        self._publish()
        self.get_logger().info(f"system {name}: {why}")
        return f"{name} is dissolved"

    def _play(self, system: RobotSystem) -> str:
        if system.state is SystemState.PAUSED:
            system.fire(SystemEvent.RESUME)
            self._start(system)
            return "plays on"
        system.fire(SystemEvent.STAGE, "members move to their starts")
        missing = [r for r in system.members if not self._state(r).trajectory_id]
        if missing:
            system.fire(SystemEvent.ABORT)
            raise Misuse(f"{', '.join(missing)} has no trajectory; load one, then play again")
        for member in system.members.values():
            member.trajectory_id = self._state(member.robot).trajectory_id
            member.duration = self._state(member.robot).duration
            self._links[member.robot].ordered_ns = self.get_clock().now().nanoseconds
            member.state = State.ADJUSTING.value
        system.clock = PlaybackClock(self.get_clock().now().nanoseconds, 0.0, 0.0)
        try:
            answers = self._order(system, list(system.members.values()), Drive.STAGE)
        except LabError:
            self._abort(system, "a member could not move to its start")
            raise
        self._publish()
        longest = max(answer.duration for answer in answers)
        return f"stages for {longest:.1f} s, then plays {system.duration:g} s"

    def _pause(self, system: RobotSystem) -> str:
        system.fire(SystemEvent.PAUSE)
        now_ns = self.get_clock().now().nanoseconds
        system.clock = PlaybackClock(now_ns, min(system.clock.at(now_ns), system.duration), 0.0)
        playing = [m for m in system.members.values() if m.state == State.PLAYING.value]
        self._order(system, playing, Drive.PAUSE)
        self._publish()
        return f"paused at {system.clock.position:.3f} s"

    def _stop(self, system: RobotSystem) -> str:
        system.fire(SystemEvent.STOP, "stopped")
        system.clock = PlaybackClock(self.get_clock().now().nanoseconds, 0.0, 0.0)
        self._order(system, list(system.members.values()), Drive.STOP)
        self._publish()
        return "stopped"

    # what members do ------------------------------------------------------------------------

    def _follow(self, robot: str) -> None:
        """Move the system on when its members have arrived, ended or collided."""
        link, system = self._links.get(robot), self._systems.of(robot)
        if link is None or link.state is None or system is None:
            return
        if conversions.to_ns(link.state.header.stamp) < link.ordered_ns:
            return
        system.members[robot].state = link.state.state
        states = {State(m.state) for m in system.members.values()}
        if State.COLLISION_HALT in states:
            self._halt(system, robot)
        elif system.state is SystemState.COLLISION_HALT:
            system.fire(SystemEvent.CLEAR, "clear again")
        elif system.state is SystemState.STAGING and states == {State.PAUSED}:
            system.fire(SystemEvent.START)
            self._start(system)
        elif system.state is SystemState.PLAYING and states == {State.READY}:
            system.clock = PlaybackClock(self.get_clock().now().nanoseconds, system.duration, 0.0)
            system.fire(SystemEvent.FINISH, "played to the end")
            self._publish()
            system.fire(SystemEvent.REARM, "played to the end")
        self._publish()

    def _halt(self, system: RobotSystem, robot: str) -> None:
        if system.state not in (SystemState.STAGING, SystemState.PLAYING):
            return
        system.fire(SystemEvent.COLLIDE, f"{robot} collided")
        now_ns = self.get_clock().now().nanoseconds
        system.clock = PlaybackClock(now_ns, min(system.clock.at(now_ns), system.duration), 0.0)
        others = [
            m
            for m in system.members.values()
            if m.state in (State.PLAYING.value, State.ADJUSTING.value)
        ]
        self._order(system, others, Drive.PAUSE)

    def _start(self, system: RobotSystem) -> None:
        """Let every member that has not reached its end play from one common stamp on."""
        start_ns = self.get_clock().now().nanoseconds + round(LEAD * 1e9)
        system.clock = PlaybackClock(start_ns, system.clock.position, 1.0)
        waiting = [m for m in system.members.values() if m.state == State.PAUSED.value]
        try:
            self._order(system, waiting, Drive.PLAY, stamp=conversions.stamp(start_ns))
        except LabError as error:
            self.get_logger().error(f"system {system.name}: {error}")
            self._abort(system, str(error))
        self._publish()

    def _abort(self, system: RobotSystem, why: str) -> None:
        """Bring every member to rest after one of them failed."""
        event = SystemEvent.ABORT if system.state is SystemState.STAGING else SystemEvent.STOP
        system.fire(event, why)
        for member in system.members.values():
            try:
                self._ask(self._links[member.robot], system, Drive.STOP)
            except LabError as error:
                self.get_logger().warning(f"{member.robot} was not stopped: {error}")
        self._publish()

    def _on_robots(self, message: msg.Robots) -> None:
        robots = frozenset(robot.name for robot in message.robots)
        self._later(lambda: self._set_robots(robots))

    def _set_robots(self, robots: frozenset[str]) -> None:
        self._robots = robots
        for system in self._systems:
            gone = [robot for robot in system.members if robot not in robots]
            if gone:
                self._do_dissolve(system.name, f"{', '.join(gone)} left the scene")

    # plumbing -------------------------------------------------------------------------------

    def _now(self, work: Callable[[], str]) -> str:
        return self._work.submit(work).result()

    def _later(self, work: Callable[[], None]) -> None:
        def guarded() -> None:
            try:
                work()
            except Exception as error:
                self.get_logger().error(f"coordinator: {error!r}")

        try:
            self._work.submit(guarded)
        except RuntimeError:
            self.get_logger().debug("shutting down")

    def _state(self, robot: str) -> msg.PlaybackState:
        state = self._links[robot].state
        if state is None:
            raise Misuse(f"{robot} has not told its state yet; try again")
        return state

    def _checked(self, robot: str, answer: Any) -> Any:
        if not answer.success:
            raise Misuse(f"{robot}: {answer.message}")
        return answer

    def _request(self, system: RobotSystem, command: int, **fields: Any) -> Any:
        return srv.Drive.Request(system=system.name, command=command, rate=1.0, **fields)

    def _ask(self, link: Link, system: RobotSystem, command: int) -> None:
        self._checked(link.robot, call(link.drive, self._request(system, command)))

    def _order(
        self, system: RobotSystem, members: list[Member], command: int, **fields: Any
    ) -> list[Any]:
        """Give all `members` one command at once; raise where one refuses."""
        request = self._request(system, command, **fields)
        answers = call_all([self._links[m.robot].drive for m in members], request)
        return [self._checked(m.robot, a) for m, a in zip(members, answers, strict=True)]

    def _message(self, system: RobotSystem) -> msg.RobotSystem:
        return msg.RobotSystem(
            name=system.name,
            members=[
                msg.SystemMember(
                    robot=m.robot,
                    trajectory_id=m.trajectory_id,
                    duration=m.duration,
                    state=m.state,
                )
                for m in system.members.values()
            ],
            mode=msg.RobotSystem.PARALLEL,
            policy=msg.RobotSystem.HALT_ALL,
            state=system.state.value,
            label=system.state.name,
            message=system.message,
            clock=conversions.clock_to_message(system.clock),
            duration=system.duration,
            rate=1.0,
        )

    def _publish(self) -> None:
        now_ns = self.get_clock().now().nanoseconds
        self._topic.publish(
            msg.RobotSystems(
                header=conversions.header(now_ns),
                systems=[self._message(system) for system in self._systems],
            )
        )


def main() -> None:
    host.main(["coordinator"])
