"""Playback nodes, one for each robot, and the host that makes them."""

from __future__ import annotations

from collections.abc import Callable
from concurrent.futures import Future
from typing import Any

from mrlab_msgs import msg, srv
from rclpy.context import Context
from rclpy.executors import Executor
from rclpy.node import Node
from rclpy.parameter import Parameter
from sensor_msgs.msg import JointState
from std_srvs.srv import SetBool, Trigger

from mrlab_ros.adapters.robots.library import RobotLibrary
from mrlab_ros.adapters.robots.ruckig_planner import RuckigPlanner, StagingLimits
from mrlab_ros.core.errors import LabError, Misuse
from mrlab_ros.core.playback.planner import MotionPlanner
from mrlab_ros.core.playback.playback import Playback, PlaybackStatus
from mrlab_ros.core.playback.states import State
from mrlab_ros.core.playback.stream import Sample
from mrlab_ros.core.robots.model import RobotModel
from mrlab_ros.core.systems.members import Command, Order
from mrlab_ros.core.trajectory.trajectory import Trajectory
from mrlab_ros.messages import qos
from mrlab_ros.messages.joint_states import JointStateEncoder
from mrlab_ros.messages.playback import (
    status_to_message,
    targets_to_message,
    telemetry_to_message,
)
from mrlab_ros.messages.systems import order_from_message, reply_to_message
from mrlab_ros.messages.time import time_to_message
from mrlab_ros.nodes import parameters
from mrlab_ros.nodes.catalogue import CatalogueClient
from mrlab_ros.nodes.parameters import PlaybackParameters
from mrlab_ros.ros import share
from mrlab_ros.ros.answers import answered, create_deferred_service
from mrlab_ros.ros.deadlines import Player, Scheduler
from mrlab_ros.ros.parameters import ParameterNode
from mrlab_ros.ros.spinning import Caller
from mrlab_ros.ros.worker import Worker


class PlaybackNode(Node):
    """Publishes one robot's joint states and offers its playback services."""

    def __init__(
        self,
        robot: str,
        model: RobotModel,
        planner: MotionPlanner,
        scheduler: Scheduler,
        fetch: Callable[[str], Trajectory],
        loads: Worker,
        standing_rate: float,
        *,
        host: str,
        context: Context | None = None,
    ) -> None:
        # A lab of fifty robots has fifty of these nodes: each does without rosout and the
        # services for parameters, of which it has none.
        super().__init__(
            "playback",
            namespace=robot,
            context=context,
            start_parameter_services=False,
            enable_rosout=False,
        )
        self.robot = robot
        self.model = model
        self._scheduler = scheduler
        self._fetch = fetch
        self._loads = loads
        self._host = host
        self.playback = Playback(model, planner, standing_rate)
        self._encoder = JointStateEncoder(robot, model.joint_names)
        self._joint_states = self.create_publisher(JointState, "joint_states", qos.STREAM)
        self._state = self.create_publisher(
            msg.PlaybackState, "playback_state", qos.LATCHED_EVENTS
        )
        self._telemetry = self.create_publisher(msg.Telemetry, "telemetry", qos.STREAM)
        self._targets = self.create_publisher(msg.GraspTargets, "targets", qos.LATCHED)
        self.create_subscription(msg.Collision, "collision", self._on_collision, qos.LATCHED)
        for kind, name, callback in (
            (Trigger, "play", self._play),
            (Trigger, "pause", self._pause),
            (Trigger, "stop", self._stop),
            (srv.Seek, "seek", self._seek),
            (srv.SetRate, "set_rate", self._set_rate),
            (SetBool, "set_loop", self._set_loop),
            (Trigger, "clear_halt", self._clear_halt),
        ):
            self.create_service(kind, name, callback, qos_profile=qos.SERVICES)
        create_deferred_service(self, srv.LoadTrajectory, "load", self._begin_load)
        self.player = Player(self.playback, self._send, self._announce)
        scheduler.add(self.player)

    def close(self) -> None:
        """Remove the playback from the scheduler, then the node from the graph."""
        self._scheduler.remove(self.player)
        self.destroy_node()

    def publish_telemetry(self) -> None:
        """Publish the display values of the last joint state, while the robot moves."""
        with self._scheduler.command() as now_ns:
            sample, playback = self.player.last, self.playback
            trajectory = playback.trajectory
            if sample is None or trajectory is None or not playback.moving:
                return
            sent, lost = playback.sent, playback.lost
            errors = self.player.error_ns, self.player.error_max_ns
        self._telemetry.publish(
            telemetry_to_message(
                now_ns,
                self.robot,
                trajectory,
                sample,
                self.model.chain.tool0(sample.positions),
                sent=sent,
                lost=lost,
                error_ns=errors[0],
                error_max_ns=errors[1],
            )
        )

    def publish_state(self) -> None:
        """Publish the present state again, while the robot moves."""
        with self._scheduler.command() as now_ns:
            if self.playback.moving:
                self._announce(now_ns, self.playback.status())

    def _send(self, sample: Sample) -> None:
        self._joint_states.publish(
            self._encoder.encode(sample.due_ns, sample.positions, sample.velocities)
        )

    def _announce(self, now_ns: int, status: PlaybackStatus) -> None:
        self._state.publish(status_to_message(now_ns, self.robot, status, self._host))

    def _announce_targets(self, now_ns: int, trajectory: Trajectory | None) -> None:
        tool0 = self.model.chain.tool0
        self._targets.publish(targets_to_message(now_ns, self.robot, trajectory, tool0))

    def _begin_load(self, request: Any, response: Any) -> Future[Any]:
        """Load on the host's own thread for that: halts and pauses do not wait for files."""
        return self._loads.later(lambda: self._load(request, response))

    @answered
    def _load(self, request: Any, response: Any) -> str:
        trajectory = self._fetch(request.id) if request.id else None
        with self._scheduler.command() as now_ns:
            if trajectory is None:
                self.playback.unload(now_ns)
            else:
                self.playback.load(now_ns, trajectory)
        self._announce_targets(now_ns, trajectory)
        if trajectory is None:
            return "unloaded"
        return (
            f"loaded {trajectory.id}: {trajectory.frame_count} frames, {trajectory.duration:g} s"
        )

    @answered
    def _play(self, request: Any, response: Any) -> str:
        with self._scheduler.command() as now_ns:
            self.playback.play(now_ns)
            moves = self.playback.state is State.ADJUSTING
        return "moves to the start, then plays" if moves else "plays"

    @answered
    def _pause(self, request: Any, response: Any) -> str:
        with self._scheduler.command() as now_ns:
            self.playback.pause(now_ns)
            return f"paused at {self.playback.clock.position:.3f} s"

    @answered
    def _stop(self, request: Any, response: Any) -> str:
        with self._scheduler.command() as now_ns:
            self.playback.stop(now_ns)
        return "stopped"

    @answered
    def _seek(self, request: Any, response: Any) -> str:
        with self._scheduler.command() as now_ns:
            self.playback.seek(now_ns, request.position)
        return f"at {request.position:g} s"

    @answered
    def _set_rate(self, request: Any, response: Any) -> str:
        with self._scheduler.command() as now_ns:
            self.playback.set_rate(now_ns, request.rate)
        return f"rate {request.rate:g}"

    @answered
    def _set_loop(self, request: Any, response: Any) -> str:
        with self._scheduler.command():
            self.playback.set_loop(request.data)
        return "loops" if request.data else "plays once"

    @answered
    def _clear_halt(self, request: Any, response: Any) -> str:
        with self._scheduler.command() as now_ns:
            self.playback.clear_halt(now_ns)
        return "clear; play resumes in place"

    def drive(self, now_ns: int, by: str, order: Order) -> float:
        """Carry out an order of the system `by`; call it inside `scheduler.command()`.

        Returns how long a staging takes, s.
        """
        playback, start_ns = self.playback, order.stamp_ns or None
        if order.command is Command.CLAIM:
            playback.claim(by)
        elif order.command is Command.RELEASE:
            playback.release(now_ns, by)
        elif order.command is Command.STAGE:
            return playback.stage(now_ns, order.position, by)
        elif order.command is Command.PLAY:
            playback.play(now_ns, start_ns, order.rate, order.until, by)
        elif order.command is Command.PAUSE:
            playback.pause(now_ns, by)
        elif order.command is Command.STOP:
            playback.stop(now_ns, by)
        elif order.command is Command.SEEK:
            playback.seek(now_ns, order.position, by)
        elif order.command is Command.SET_RATE:
            playback.set_rate(now_ns, order.rate, start_ns, by)
        else:
            playback.hold_at(order.until, by)
        return 0.0

    def _on_collision(self, message: msg.Collision) -> None:
        with self._scheduler.command() as now_ns:
            if message.colliding:
                contact = message.contact
                self.playback.collide(now_ns, f"{contact.link} touches {contact.other}")
            else:
                self.playback.clear(now_ns)


class PlaybackHostNode(ParameterNode[PlaybackParameters]):
    """Runs one playback node for each robot of the scene, all on one deadline thread."""

    def __init__(
        self,
        *,
        context: Context | None = None,
        parameter_overrides: list[Parameter] | None = None,
    ) -> None:
        super().__init__(
            "playback_host",
            PlaybackParameters,
            parameters.ALL,
            context=context,
            parameter_overrides=parameter_overrides,
        )
        self._only = set(self.parameters.robots)
        self._planner = RuckigPlanner(self._staging_limits())
        self._library = RobotLibrary(share.directory() / "robots")
        self.scheduler = Scheduler(self.context.ok)
        self.nodes: dict[str, PlaybackNode] = {}
        self._executor: Executor | None = None
        self._caller = Caller(self)
        self._trajectories = CatalogueClient(self._caller.node)
        self._loads = Worker("loads")
        self.create_subscription(msg.Robots, "/robots", self._on_robots, qos.LATCHED)
        self.create_service(
            srv.CommandMembers,
            "~/command_members",
            self._command_members,
            qos_profile=qos.SERVICES,
        )
        self._telemetry_timer = self.create_timer(
            1 / self.parameters.telemetry_rate, self._telemetry
        )
        self.create_timer(1.0, self._states)
        self.scheduler.start()

    def parameters_changed(self) -> None:
        with self.scheduler.command() as now_ns:
            for node in self.nodes.values():
                node.playback.set_standing_rate(now_ns, self.parameters.standing_rate)
        self._planner.limits = self._staging_limits()
        self.destroy_timer(self._telemetry_timer)
        self._telemetry_timer = self.create_timer(
            1 / self.parameters.telemetry_rate, self._telemetry
        )

    def _staging_limits(self) -> StagingLimits:
        values = self.parameters
        return StagingLimits(values.velocity_share, values.acceleration, values.jerk)

    def adopt(self, executor: Executor) -> None:
        """Have `executor` spin all playback nodes too, present and future."""
        self._executor = executor
        for node in self.nodes.values():
            executor.add_node(node)

    def destroy_node(self) -> None:
        self._loads.close()
        self._caller.close()
        self.scheduler.stop()
        for robot in list(self.nodes):
            self._remove(robot)
        super().destroy_node()

    def _on_robots(self, message: msg.Robots) -> None:
        wanted = {r.name: r for r in message.robots if not self._only or r.name in self._only}
        for robot, node in list(self.nodes.items()):
            if robot not in wanted or wanted[robot].model != node.model.id:
                self._remove(robot)
        for robot in wanted.values():
            if robot.name not in self.nodes:
                self._add(robot.name, robot.model)
            with self.scheduler.command():
                self.nodes[robot.name].playback.end_effector = robot.end_effector

    def _add(self, robot: str, model: str) -> None:
        node = PlaybackNode(
            robot,
            self._library.model(model),
            self._planner,
            self.scheduler,
            self._trajectories.fetch,
            self._loads,
            self.parameters.standing_rate,
            host=self.get_fully_qualified_name(),
            context=self.context,
        )
        self.nodes[robot] = node
        if self._executor is not None:
            self._executor.add_node(node)
        self.get_logger().info(f"added the playback of {robot} ({model})")

    def _remove(self, robot: str) -> None:
        node = self.nodes.pop(robot)
        if self._executor is not None:
            self._executor.remove_node(node)
        node.close()

    @answered
    def _command_members(self, request: Any, response: Any) -> str:
        with self.scheduler.command() as now_ns:
            response.stamp = time_to_message(now_ns)
            for order in request.orders:
                node = self.nodes.get(order.robot)
                if node is None:
                    raise Misuse(f"{order.robot}: has no playback here; is it still in the scene?")
                try:
                    duration = node.drive(now_ns, request.system, order_from_message(order))
                except LabError as error:
                    raise Misuse(f"{order.robot}: {error}") from error
                reply = reply_to_message(order.robot, node.playback, duration)
                response.replies.append(reply)
        return "done"

    def _telemetry(self) -> None:
        for node in self.nodes.values():
            node.publish_telemetry()

    def _states(self) -> None:
        for node in self.nodes.values():
            node.publish_state()
