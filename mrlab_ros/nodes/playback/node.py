"""The playback node of one robot."""

from __future__ import annotations

import time
from collections.abc import Callable
from concurrent.futures import CancelledError, Future, InvalidStateError
from contextlib import suppress
from typing import Any

from mrlab_msgs import msg, srv
from mrlab_msgs.srv import SetLoop, Trigger
from rclpy.context import Context
from rclpy.parameter import Parameter
from sensor_msgs.msg import JointState

from mrlab_ros.adapters.pose_file import PoseFile
from mrlab_ros.core.base.diagnostic import Diagnostic
from mrlab_ros.core.base.errors import LabError, Misuse
from mrlab_ros.core.playback import diagnostics as say
from mrlab_ros.core.playback.execution import PlaybackStatus
from mrlab_ros.core.playback.planner import MotionPlanner
from mrlab_ros.core.playback.playback import Playback
from mrlab_ros.core.playback.saved_state import Kept, come_back, keep
from mrlab_ros.core.playback.states import State
from mrlab_ros.core.playback.stream import Sample
from mrlab_ros.core.robots.model import RobotModel
from mrlab_ros.core.systems.members import Command as MemberCommand
from mrlab_ros.core.systems.members import Order
from mrlab_ros.core.trajectory.trajectory import Trajectory
from mrlab_ros.messages import qos
from mrlab_ros.messages.joint_states import JointStateEncoder
from mrlab_ros.messages.playback import (
    TelemetryEncoder,
    status_to_message,
    targets_to_message,
)
from mrlab_ros.nodes.playback.commanders import Commanders
from mrlab_ros.nodes.playback.controller import Controller
from mrlab_ros.nodes.playback.direct import Direct, Stream
from mrlab_ros.ros.calls import NoAnswer
from mrlab_ros.ros.deadlines import Command, Player, Scheduler
from mrlab_ros.ros.decoding import subscribe
from mrlab_ros.ros.node import LeanNode
from mrlab_ros.ros.raw_streams import raw_publish
from mrlab_ros.ros.services import answered, create_deferred_service, create_service
from mrlab_ros.ros.worker import Worker

# For what a robot had before a restart, the catalogue is asked this long, s.
RETURN_TIMEOUT_S = 60.0


class PlaybackNode(LeanNode):
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
        lab: str = "",
        kept: Kept | None = None,
        pose_file: PoseFile | None = None,
        keep: Callable[[], object] = lambda: None,
        warn: Callable[[str], None] = lambda said: None,
        direct: Direct | None = None,
        context: Context | None = None,
    ) -> None:
        """Make the node; the scheduler serves its playback from now on.

        host, lab: the node that plays the robot, and the id of its lab. warn: takes a sentence of
        what was refused where nobody can be answered. kept: what the robot had
        before the process was restarted; come_back() loads it. pose_file: gets each pose that is
        sent. keep: journals what was loaded, before that is answered. direct: puts its joint
        states on zenoh; None: only the bridge does.
        """
        # A lab of fifty robots has fifty of these nodes: each does without rosout and the
        # services for parameters, of which it has none. It is hidden: `ros2 param list` waits 5 s
        # for each visible node without those services.
        super().__init__(
            "_playback",
            namespace=robot,
            context=context,
            start_parameter_services=False,
            enable_rosout=False,
            # rcl keeps 42 kB of each such service for ever, and robots come and go.
            parameter_overrides=[Parameter("start_type_description_service", value=False)],
        )
        self.robot = robot
        self.model = model
        self._scheduler = scheduler
        self._fetch = fetch
        self._loads = Worker(f"load {robot}")
        self._loading: set[Future[Any]] = set()
        self._host = host
        self._lab = lab
        self.playback = Playback(model, planner, standing_rate)
        self.player = Player(self.playback, self._send, self._announce)
        self._grasp: msg.Grasp | None = None
        self._back = kept
        self._pose_file = pose_file
        self._keep = keep
        self._announced = True
        self._commanders: Commanders | None = None
        self._controller: Controller | None = None
        self._direct = direct
        self._stream: Stream | None = None
        try:
            self._offer(warn)
        except BaseException:
            # Half made, it would stay in the graph until the garbage collector comes.
            self.close()
            raise

    def _offer(self, warn: Callable[[str], None]) -> None:
        """Create the topics and services, and begin to play."""
        self._encoder = JointStateEncoder(self.robot, self.model.joint_names)
        self._telemetry_encoder = TelemetryEncoder(self.robot, self.model.joint_names)
        self._joint_states = self.create_publisher(JointState, "joint_states", qos.STREAM)
        self._publish_joint_state = raw_publish(self._joint_states)
        self._subscribers = 0
        if self._direct is not None:
            self._stream = self._direct.stream(self._joint_states.topic_name, self._repeat)
        self._state = self.create_publisher(
            msg.PlaybackState, "playback_state", qos.LATCHED_EVENTS
        )
        self._telemetry = self.create_publisher(msg.Telemetry, "telemetry", qos.STREAM)
        self._targets = self.create_publisher(msg.GraspTargets, "targets", qos.LATCHED)
        subscribe(self, msg.Collision, "collision", self._on_collision, qos.LATCHED)
        self._grasps = subscribe(self, msg.Grasp, "grasp", self._on_grasp, qos.LATCHED)
        for kind, name, callback in (
            (Trigger, "play", self._play),
            (Trigger, "pause", self._pause),
            (Trigger, "stop", self._stop),
            (srv.Seek, "seek", self._seek),
            (srv.SetRate, "set_rate", self._set_rate),
            (SetLoop, "set_loop", self._set_loop),
            (Trigger, "clear_halt", self._clear_halt),
        ):
            create_service(self, kind, name, callback)
        create_deferred_service(self, srv.LoadTrajectory, "load", self._begin_load)
        if self._back is not None:
            with self._scheduler.command() as now_ns:
                self.playback.stand_at(now_ns, self._back.arm)
        self._scheduler.add(self.player)
        self._commanders = Commanders(
            self,
            self.robot,
            self.playback,
            self.player,
            self._scheduler.clock,
            self._command,
            self._driven,
            warn,
        )
        self._controller = Controller(
            self, self.robot, self.playback, self._scheduler.clock, self._command
        )

    def come_back(self, done: Callable[[Diagnostic | None], None]) -> None:
        """Load what the robot had before the restart, in its own thread, and stand there.

        done: gets what was lost; None: nothing. A command that came before wins.
        """
        kept = self._back
        if kept is not None:
            self._loads.send(lambda: done(self._do_come_back(kept)))

    def kept(self) -> Kept | None:
        """Return what a restart has to know again; before it is back, what it was.

        Takes no lock: place and pose of an arm that plays are those of one joint state.
        """
        kept, last = keep(self.playback), self.player.last
        if kept is None:
            return self._back
        if last is not None and last.sample.streamed and self.playback.state is State.PLAYING:
            return kept._replace(position=last.sample.position, arm=last.sample.positions)
        return kept

    @property
    def changed(self) -> bool:
        """Return whether it moves, or its state changed since the last call."""
        announced, self._announced = self._announced, False
        return announced or self.playback.moving

    def _do_come_back(self, kept: Kept) -> Diagnostic | None:
        if not kept.version:
            # It was in no catalogue.
            self._back = None
            return say.GOAL_LOST(robot=self.robot)
        deadline = time.monotonic() + RETURN_TIMEOUT_S
        while True:
            try:
                trajectory = self._fetch(kept.trajectory_id)
                if trajectory.version != kept.version:
                    trajectory = self._fetch(f"{kept.trajectory_id}@{kept.version}")
                with self._command() as now_ns:
                    if self.playback.state is State.IDLE:
                        come_back(self.playback, now_ns, trajectory, kept)
                self._back = None
                self._announce_targets(now_ns, trajectory)
                return None
            except NoAnswer as error:
                # The converter may be starting too.
                if time.monotonic() > deadline or self._loads.ended:
                    return self._lost(kept, error)
            except LabError as error:
                self._back = None
                return self._lost(kept, error)

    def _lost(self, kept: Kept, why: LabError) -> Diagnostic:
        lost = kept.trajectory_id
        return say.TRAJECTORY_LOST(robot=self.robot, trajectory=lost, why=why)

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
        if self._commanders is not None:
            self._commanders.close()
        self._scheduler.remove(self.player)
        if self._direct is not None and self._stream is not None:
            self._direct.remove(self._stream)
        if self._pose_file is not None:
            self._pose_file.close()
        self.destroy_node()

    def publish_telemetry(self, now_ns: int) -> None:
        """Publish the display values of the last joint state, while the robot moves.

        And its state as a controller, also while it stands. now_ns: the stamp.
        """
        last = self.player.last
        if last is None:
            return
        if self._controller is not None and self._commanders is not None:
            self._controller.publish(now_ns, last.sample, self._commanders.seen)
        if last.trajectory is None or not self.playback.moving:
            return
        self._telemetry.publish(
            self._telemetry_encoder.encode(
                now_ns,
                last.trajectory,
                last.sample,
                self.model.chain.tip(last.sample.positions.tolist()),
                self._grasp,
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
        # Remarks on a grasp end with the physics that published them.
        if not self._grasps.get_publisher_count():
            self._grasp = None
        with self._command() as now_ns:
            if self.playback.moving:
                self._announce(now_ns, self.playback.status())

    def _send(self, sample: Sample) -> None:
        stamp_ns = self._scheduler.clock.stamp(sample.due_ns)
        payload = self._encoder.encode(stamp_ns, sample.positions, sample.velocities)
        published_ns = time.time_ns()
        self._publish_joint_state(payload)
        if self._stream is not None:
            self._stream.put(payload, published_ns)
        if self._pose_file is not None:
            self._pose_file.put(self.playback.stream.position, sample.positions.tolist())

    def _announce(self, now_ns: int, status: PlaybackStatus) -> None:
        self._announced = True
        shifted_ns = self._scheduler.clock.shifted_ns
        self._state.publish(
            status_to_message(now_ns, self.robot, status, self._host, self._lab, shifted_ns)
        )
        if self._commanders is not None:
            self._commanders.note(status)

    def _driven(self, now_ns: int, trajectory: Trajectory | None) -> None:
        """Take that a goal or a stream stands in for what was loaded."""
        self._back = None
        self._announce_targets(now_ns, trajectory)

    def _announce_targets(self, now_ns: int, trajectory: Trajectory | None) -> None:
        tool0 = self.model.chain.tool0
        stamp_ns = self._scheduler.clock.stamp(now_ns)
        self._targets.publish(targets_to_message(stamp_ns, self.robot, trajectory, tool0))

    def _begin_load(
        self, request: srv.LoadTrajectory.Request, response: srv.LoadTrajectory.Response
    ) -> Future[Any]:
        """Load in the robot's own thread for that: no halt, pause or stop waits for files."""
        answer: Future[srv.LoadTrajectory.Response] = Future()
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
    def _load(
        self, request: srv.LoadTrajectory.Request, response: srv.LoadTrajectory.Response
    ) -> Diagnostic | None:
        trajectory = self._fetch(request.id) if request.id else None
        if self._loads.ended:
            raise Misuse(say.ROBOT_GONE(robot=self.robot))
        with self._command() as now_ns:
            if trajectory is None:
                self.playback.unload(now_ns)
            else:
                self.playback.load(now_ns, trajectory)
            self._back = None
            done = self.playback.status().message
        self._keep()
        self._announce_targets(now_ns, trajectory)
        return done

    @answered
    def _play(self, request: Trigger.Request, response: Trigger.Response) -> Diagnostic:
        with self._command() as now_ns:
            self.playback.play(now_ns)
            return self.playback.status().message or say.PLAYS()

    @answered
    def _pause(self, request: Trigger.Request, response: Trigger.Response) -> Diagnostic | None:
        with self._command() as now_ns:
            self.playback.pause(now_ns)
            return self.playback.status().message

    @answered
    def _stop(self, request: Trigger.Request, response: Trigger.Response) -> Diagnostic | None:
        with self._command() as now_ns:
            self.playback.stop(now_ns)
            return self.playback.status().message

    @answered
    def _seek(self, request: srv.Seek.Request, response: srv.Seek.Response) -> Diagnostic:
        with self._command() as now_ns:
            self.playback.seek(now_ns, request.position)
        return say.AT_POSITION(position=request.position)

    @answered
    def _set_rate(
        self, request: srv.SetRate.Request, response: srv.SetRate.Response
    ) -> Diagnostic | None:
        with self._command() as now_ns:
            self.playback.set_rate(now_ns, request.rate)
            return self.playback.status().message

    @answered
    def _set_loop(self, request: SetLoop.Request, response: SetLoop.Response) -> Diagnostic | None:
        with self._command():
            self.playback.set_loop(request.loop)
            return self.playback.status().message

    @answered
    def _clear_halt(
        self, request: Trigger.Request, response: Trigger.Response
    ) -> Diagnostic | None:
        with self._command() as now_ns:
            self.playback.clear_halt(now_ns)
            return self.playback.status().message

    def drive(self, now_ns: int, by: str, order: Order) -> float:
        """Carry out an order of the system `by`; call it inside `scheduler.command()`.

        The order's stamp is that of its message. Returns how long a staging takes, s.
        """
        playback = self.playback
        start_ns = self._scheduler.clock.instant(order.stamp_ns) if order.stamp_ns else None
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

    def welcome(self) -> None:
        """Send the pose of an arm that stands to who has just come; it is repeated seldom.

        The count is looked at: a LeanNode handles no events.
        """
        before, self._subscribers = self._subscribers, self._joint_states.get_subscription_count()
        if self._subscribers > before:
            self._repeat()

    def _repeat(self) -> None:
        with self._command() as now_ns:
            self.playback.repeat(now_ns)

    def _on_collision(self, message: msg.Collision) -> None:
        with self._command() as now_ns:
            if message.colliding:
                contact = message.contact
                link = None if contact.held else contact.link
                touches = say.HALTED_BY_CONTACT(held=contact.held, link=link, other=contact.other)
                self.playback.collide(now_ns, touches)
            else:
                self.playback.clear(now_ns)

    def _on_grasp(self, message: msg.Grasp) -> None:
        self._grasp = message
