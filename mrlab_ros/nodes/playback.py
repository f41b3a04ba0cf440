"""Playback nodes, one for each robot, and the host that makes them."""

from __future__ import annotations

import threading
import weakref
from collections.abc import Callable
from concurrent.futures import CancelledError, Future, InvalidStateError
from contextlib import suppress
from typing import Any

from mrlab_msgs import msg, srv
from rclpy.context import Context
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
from mrlab_ros.core.systems.members import NOT_PLAYED, Order
from mrlab_ros.core.systems.members import Command as MemberCommand
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
from mrlab_ros.ros.deadlines import Command, Player, Scheduler
from mrlab_ros.ros.parameters import ParameterNode
from mrlab_ros.ros.priority import REALTIME, take_precedence
from mrlab_ros.ros.spinning import Caller, SpunNode
from mrlab_ros.ros.worker import Worker

# Trajectories that are fetched at the same time.
MOST_LOADS = 4


class PlaybackNode(Node):
    """Publishes one robot's joint states and offers its playback services.

    Its callbacks halt and command the arm, so none of them loads, decodes or calls: `load` runs
    in a thread of the robot's own, and the trajectory is swapped in when it is complete.
    """

    def __init__(
        self,
        robot: str,
        model: RobotModel,
        planner: MotionPlanner,
        scheduler: Scheduler,
        fetch: Callable[[str], Trajectory],
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
        self._loads = Worker(f"load {robot}")
        self._loading: set[Future[Any]] = set()
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

    def _command(self) -> Command:
        return self._scheduler.command(self.player)

    def close(self) -> None:
        """Remove the playback from the scheduler, then the node from the graph.

        Loads that are under way are answered; their threads end by themselves.
        """
        self._loads.end()
        for answer in list(self._loading):
            with suppress(InvalidStateError):
                answer.set_exception(CancelledError())
        self._scheduler.remove(self.player)
        self.destroy_node()

    def publish_telemetry(self, now_ns: int) -> None:
        """Publish the display values of the last joint state, while the robot moves."""
        last = self.player.last
        if last is None or last.trajectory is None or not self.playback.moving:
            return
        self._telemetry.publish(
            telemetry_to_message(
                now_ns,
                self.robot,
                last.trajectory,
                last.sample,
                self.model.chain.tool0(last.sample.positions),
                sent=last.sent,
                lost=last.lost,
                error_ns=last.error_ns,
                error_max_ns=last.error_max_ns,
            )
        )

    def publish_state(self) -> None:
        """Publish the present state again, while the robot moves."""
        if not self.playback.moving:
            return
        with self._command() as now_ns:
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
        """Load in the robot's own thread for that: no halt, pause or stop waits for files."""
        answer: Future[Any] = Future()
        self._loading.add(answer)
        answer.add_done_callback(self._loading.discard)

        def work() -> None:
            loaded = self._load(request, response)
            # The robot may have been removed meanwhile: then the answer is given already.
            with suppress(InvalidStateError):
                answer.set_result(loaded)

        self._loads.send(work)
        return answer

    @answered
    def _load(self, request: Any, response: Any) -> str:
        trajectory = self._fetch(request.id) if request.id else None
        if self._loads.ended:
            raise Misuse(f"{self.robot} was removed while it loaded")
        with self._command() as now_ns:
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
        with self._command() as now_ns:
            self.playback.play(now_ns)
            moves = self.playback.state is State.ADJUSTING
        return "moves to the start, then plays" if moves else "plays"

    @answered
    def _pause(self, request: Any, response: Any) -> str:
        with self._command() as now_ns:
            self.playback.pause(now_ns)
            return f"paused at {self.playback.clock.position:.3f} s"

    @answered
    def _stop(self, request: Any, response: Any) -> str:
        with self._command() as now_ns:
            self.playback.stop(now_ns)
        return "stopped"

    @answered
    def _seek(self, request: Any, response: Any) -> str:
        with self._command() as now_ns:
            self.playback.seek(now_ns, request.position)
        return f"at {request.position:g} s"

    @answered
    def _set_rate(self, request: Any, response: Any) -> str:
        with self._command() as now_ns:
            self.playback.set_rate(now_ns, request.rate)
        return f"rate {request.rate:g}"

    @answered
    def _set_loop(self, request: Any, response: Any) -> str:
        with self._command():
            self.playback.set_loop(request.data)
        return "loops" if request.data else "plays once"

    @answered
    def _clear_halt(self, request: Any, response: Any) -> str:
        with self._command() as now_ns:
            self.playback.clear_halt(now_ns)
        return "clear; play resumes in place"

    def drive(self, now_ns: int, by: str, order: Order) -> float:
        """Carry out an order of the system `by`; call it inside `scheduler.command()`.

        Returns how long a staging takes, s.
        """
        playback, start_ns = self.playback, order.stamp_ns or None
        if order.command is MemberCommand.CLAIM:
            playback.claim(now_ns, by)
        elif order.command is MemberCommand.RELEASE:
            playback.release(now_ns, by)
        elif order.command is MemberCommand.STAGE:
            return playback.stage(now_ns, order.position, by)
        elif order.command is MemberCommand.PLAY:
            playback.play(now_ns, start_ns, order.rate, order.until, by)
        elif order.command is MemberCommand.PAUSE:
            playback.pause(now_ns, by)
        elif order.command is MemberCommand.STOP:
            playback.stop(now_ns, by)
        elif order.command is MemberCommand.SEEK:
            playback.seek(now_ns, order.position, by)
        elif order.command is MemberCommand.SET_RATE:
            playback.set_rate(now_ns, order.rate, start_ns, by)
        else:
            playback.hold_at(order.until, by)
        return 0.0

    def _on_collision(self, message: msg.Collision) -> None:
        with self._command() as now_ns:
            if message.colliding:
                contact = message.contact
                self.playback.collide(now_ns, f"{contact.link} touches {contact.other}")
            else:
                self.playback.clear(now_ns)


class Fetches:
    """Fetches trajectories for several robots at once, the same one only once at a time.

    Robots that load the same trajectory one after another share its matrices.
    """

    def __init__(self, fetch: Callable[[str], Trajectory], most: int = MOST_LOADS) -> None:
        self._fetch = fetch
        self._slots = threading.BoundedSemaphore(most)
        self._lock = threading.Lock()
        self._same: weakref.WeakValueDictionary[str, _Turn] = weakref.WeakValueDictionary()

    def __call__(self, trajectory_id: str) -> Trajectory:
        with self._lock:
            turn = self._same.setdefault(trajectory_id, _Turn())
        with turn.lock, self._slots:
            return self._fetch(trajectory_id)


class _Turn:
    """Whose turn it is to fetch a trajectory."""

    def __init__(self) -> None:
        self.lock = threading.Lock()


class PlaybackHostNode(ParameterNode[PlaybackParameters]):
    """Runs one playback node for each robot of the scene, all on one deadline thread.

    The playback nodes and the orders of robot systems have an executor of their own, whose
    callbacks neither load nor call anything. This node makes and removes playbacks and publishes
    telemetry, in another thread.
    """

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
        self._caller = Caller(self)
        self._fetch = Fetches(CatalogueClient(self._caller.node).fetch)
        orders = Node(
            "_playback_host_orders",
            context=context,
            start_parameter_services=False,
            enable_rosout=False,
        )
        self.create_subscription(msg.Robots, "/robots", self._on_robots, qos.LATCHED)
        orders.create_service(
            srv.CommandMembers,
            f"{self.get_fully_qualified_name()}/command_members",
            self._command_members,
            qos_profile=qos.SERVICES,
        )
        self._telemetry_timer = self.create_timer(
            1 / self.parameters.telemetry_rate, self._telemetry
        )
        self.create_timer(1.0, self._states)
        self.scheduler.start()
        self.get_logger().info(f"the deadline thread runs with {self.scheduler.precedence}")
        self._safety = SpunNode(orders, lambda: take_precedence(REALTIME - 1))

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

    def destroy_node(self) -> None:
        self._caller.close()
        self.scheduler.stop()
        for robot in list(self.nodes):
            self._remove(robot)
        self._safety.close()
        super().destroy_node()

    def _on_robots(self, message: msg.Robots) -> None:
        wanted = {r.name: r for r in message.robots if not self._only or r.name in self._only}
        for robot, node in list(self.nodes.items()):
            if robot not in wanted or wanted[robot].model != node.model.id:
                self._remove(robot)
        for robot in wanted.values():
            if robot.name not in self.nodes:
                self._add(robot.name, robot.model)
            node = self.nodes[robot.name]
            with self.scheduler.command(node.player):
                node.playback.end_effector = robot.end_effector

    def _add(self, robot: str, model: str) -> None:
        node = PlaybackNode(
            robot,
            self._library.model(model),
            self._planner,
            self.scheduler,
            self._fetch,
            self.parameters.standing_rate,
            host=self.get_fully_qualified_name(),
            context=self.context,
        )
        self.nodes[robot] = node
        self._safety.executor.add_node(node)
        self.get_logger().info(f"added the playback of {robot} ({model})")

    def _remove(self, robot: str) -> None:
        node = self.nodes.pop(robot)
        self._safety.executor.remove_node(node)
        node.close()

    @answered
    def _command_members(self, request: Any, response: Any) -> str:
        with self.scheduler.command() as now_ns:
            response.stamp = time_to_message(now_ns)
            for order in request.orders:
                node = self.nodes.get(order.robot)
                if node is None:
                    raise Misuse(f"{order.robot}: {NOT_PLAYED}")
                try:
                    duration = node.drive(now_ns, request.system, order_from_message(order))
                except LabError as error:
                    raise Misuse(f"{order.robot}: {error}") from error
                reply = reply_to_message(order.robot, node.playback, duration)
                response.replies.append(reply)
        return "done"

    def _telemetry(self) -> None:
        now_ns = self.scheduler.clock.now_ns()
        for node in self.nodes.values():
            node.publish_telemetry(now_ns)

    def _states(self) -> None:
        for node in self.nodes.values():
            node.publish_state()
