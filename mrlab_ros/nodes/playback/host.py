"""The playback host: it makes and removes the playback nodes, and knows them after a restart."""

from __future__ import annotations

import threading
import time
import weakref
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any

from mrlab_msgs import msg, srv

from mrlab_ros.adapters import share
from mrlab_ros.adapters.journal_file import Journal
from mrlab_ros.adapters.pose_file import PoseFile
from mrlab_ros.adapters.robots.library import RobotLibrary
from mrlab_ros.adapters.robots.ruckig_planner import RuckigPlanner, StagingLimits
from mrlab_ros.core.base.diagnostic import Diagnostic
from mrlab_ros.core.base.errors import LabError, Misuse
from mrlab_ros.core.playback import saved_state as entries
from mrlab_ros.core.playback.diagnostics import NOT_PLAYED, OF_ROBOT
from mrlab_ros.core.playback.saved_state import Kept
from mrlab_ros.core.robots.model import RobotModel
from mrlab_ros.core.runtime.identity import Identity
from mrlab_ros.core.runtime.process_states import Deaths
from mrlab_ros.core.systems.claims import Leases
from mrlab_ros.core.systems.members import HALTING
from mrlab_ros.core.trajectory.trajectory import Trajectory
from mrlab_ros.messages import qos
from mrlab_ros.messages.status import processes_from_message
from mrlab_ros.messages.systems import order_from_message, reply_to_message
from mrlab_ros.messages.time import time_to_message
from mrlab_ros.nodes import parameters
from mrlab_ros.nodes.converter.catalogue import CatalogueClient
from mrlab_ros.nodes.parameters import PlaybackParameters
from mrlab_ros.nodes.playback.direct import Direct
from mrlab_ros.nodes.playback.node import PlaybackNode
from mrlab_ros.ros.clock import LabClock, every
from mrlab_ros.ros.deadlines import REALTIME, Scheduler, take_precedence
from mrlab_ros.ros.decoding import subscribe
from mrlab_ros.ros.parameters import NodeArguments, ParameterNode
from mrlab_ros.ros.services import answered, create_service
from mrlab_ros.ros.spinning import Caller, SpunNode

if TYPE_CHECKING:
    from typing_extensions import Unpack

# Trajectories that are fetched at the same time.
MOST_LOADS = 4
# Period of writing moving and changed robots into the journal, s: a robot whose
# process was killed stands at most this much behind.
JOURNAL_PERIOD_S = 0.1
# Period of a moving robot's state, s, in as many groups one after another: all at once
# would delay joint states by milliseconds.
STATE_PERIOD_S = 1.0
STATE_TURNS = 10
# How often the claims of robot systems are checked, s.
LEASE_CHECK_S = 0.5
# Period of what the bridge is told of joint states that it did not forward itself, s.
DIRECT_PERIOD_S = 1.0


class Fetches:
    """Fetches trajectories for several robots at once, the same one only once at a time.

    Robots that load the same trajectory one after another share its matrices.
    """

    def __init__(self, fetch: Callable[[str], Trajectory]) -> None:
        self._fetch = fetch
        self._slots = threading.BoundedSemaphore(MOST_LOADS)
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


class PlaybackHostNode(
    ParameterNode[PlaybackParameters],
    name="playback_host",
    kind=PlaybackParameters,
    others=parameters.ALL,
):
    """Runs one playback node for each robot of the scene, all on one deadline thread.

    The playback nodes and the orders of robot systems have an executor of their own, whose
    callbacks neither load nor call anything. This node makes and removes playbacks and publishes
    telemetry, in another thread.
    """

    def __init__(self, **ros: Unpack[NodeArguments]) -> None:
        super().__init__(**ros)
        log = self.get_logger()
        self._identity = Identity(self.parameters.lab_id, lambda said: log.warning(str(said)))
        self._only = set(self.parameters.robots)
        self._planner = RuckigPlanner(self._staging_limits())
        self._library = RobotLibrary(share.directory() / "robots")
        self.scheduler = Scheduler(self.context.ok, LabClock(self))
        self.nodes: dict[str, PlaybackNode] = {}
        self._caller = Caller(self)
        self._fetch = Fetches(CatalogueClient(self._caller.node).fetch)
        self._journal = Journal.of(
            self.parameters.state_dir, self.get_name(), self.get_logger().error
        )
        # State of robots before a restart, until they are in the scene again; None: all are.
        self._kept: dict[str, tuple[str, Kept]] = entries.read(self._journal.load())
        # Written each period, and by whoever loaded something.
        self._writing = threading.Lock()
        # By robot what is in the journal.
        self._written: dict[str, dict[str, Any]] = {}
        # Diagnostics of state that could not be brought back.
        self.lost: list[Diagnostic] = []
        self._leases = Leases()
        self._direct: Direct | None = None
        if self.parameters.direct and self.parameters.socket:
            self._direct = Direct(self.parameters.socket, self.parameters.prefix)
            every(self, DIRECT_PERIOD_S, self._direct.report)
        orders = self.hidden_node("orders", remapped=True)
        subscribe(self, msg.Robots, "/robots", self._on_robots, qos.LATCHED)
        # Named by the lab too: the coordinator of another one on the same domain must not drive
        # robots that happen to have the names of its own.
        self._host = f"{self.get_fully_qualified_name()}{self._identity.namespace}"
        create_service(
            orders,
            srv.CommandMembers,
            f"{self._host}/command_members",
            self._command_members,
            halts=lambda request: all(
                order_from_message(order).command in HALTING for order in request.orders
            ),
        )
        self._telemetry_timer = every(self, 1 / self.parameters.telemetry_rate, self._telemetry)
        self._turn = 0
        every(self, STATE_PERIOD_S / STATE_TURNS, self._states)
        every(self, JOURNAL_PERIOD_S, self._write_journal)
        every(self, LEASE_CHECK_S, self._check_leases)
        subscribe(self, msg.RobotSystems, "/systems", self._on_systems, qos.LATCHED)
        self._deaths = Deaths(time.monotonic_ns())
        subscribe(self, msg.LabProcesses, "/processes", self._on_processes, qos.LATCHED)
        self.scheduler.start()
        self.get_logger().info(f"the deadline thread runs with {self.scheduler.precedence}")
        self._safety = SpunNode(orders, lambda: take_precedence(REALTIME - 1))

    @staticmethod
    def prepare_thread() -> None:
        """Give the thread that spins this node precedence too; call it in that thread.

        Its callbacks are short, and while one runs Python the deadline thread waits for it: on a
        busy machine an ordinary thread would not come to its end for long.
        """
        take_precedence(REALTIME - 2)

    def parameters_changed(self) -> None:
        with self.scheduler.command() as now_ns:
            for node in self.nodes.values():
                node.playback.set_standing_rate(now_ns, self.parameters.standing_rate)
        self._planner.limits = self._staging_limits()
        self.destroy_timer(self._telemetry_timer)
        self._telemetry_timer = every(self, 1 / self.parameters.telemetry_rate, self._telemetry)

    def _staging_limits(self) -> StagingLimits:
        values = self.parameters
        return StagingLimits(values.velocity_share, values.acceleration, values.jerk)

    def destroy_node(self) -> None:
        self._write_journal()
        self._journal.close()
        self._caller.close()
        self.scheduler.stop()
        for robot in list(self.nodes):
            self._remove(robot)
        if self._direct is not None:
            self._direct.close()
        self._safety.close()
        super().destroy_node()

    def _on_robots(self, message: msg.Robots) -> None:
        if not self._identity.obeys(message.lab):
            return
        wanted = {r.name: r for r in message.robots if not self._only or r.name in self._only}
        for robot, node in list(self.nodes.items()):
            if robot not in wanted or wanted[robot].model != node.model.id:
                self._remove(robot)
        for name, entry in wanted.items():
            if name not in self.nodes:
                try:
                    self._add(entry)
                except LabError as error:
                    self.get_logger().error(f"{name} has no playback: {error}")
                continue
            node = self.nodes[name]
            with self.scheduler.command(node.player):
                node.playback.end_effector = entry.end_effector
        for name in [name for name in self._kept if name in self.nodes]:
            del self._kept[name]
            self.nodes[name].come_back(self._came_back)
        # The list is the lab's own from now on: what it does not name is gone.
        self._kept.clear()

    def _came_back(self, lost: Diagnostic | None) -> None:
        if lost is not None and self.context.ok():
            self.get_logger().warning(str(lost))
            self.lost.append(lost)

    # after a restart ------------------------------------------------------------------------

    def _write_journal(self) -> None:
        with self._writing:
            nodes = list(self.nodes.items())
            changed = [name for name, node in nodes if node.changed]
            if self._kept or not (changed or self._written.keys() - self.nodes.keys()):
                return
            known = self._written
            self._written = {
                name: entries.plain(node.model.id, kept) if name in changed else known[name]
                for name, node in nodes
                if (name in changed or name in known) and (kept := node.kept()) is not None
            }
            self._journal.save({entries.ROBOTS: self._written})

    # claims ---------------------------------------------------------------------------------

    def _on_systems(self, message: msg.RobotSystems) -> None:
        if not self._identity.accepts(message.lab):
            return
        self._leases.renew([system.name for system in message.systems], time.monotonic())

    def _on_processes(self, message: msg.LabProcesses) -> None:
        """Let the members of systems stand at once where their coordinator died."""
        if not self._identity.accepts(message.lab):
            return
        for process in self._deaths.new(processes_from_message(message)):
            if process.frozen or not process.holds("/coordinator"):
                continue
            with self.scheduler.command() as now_ns:
                for node in self.nodes.values():
                    playback = node.playback
                    if playback.system and playback.moving:
                        playback.pause(now_ns, by=playback.system)

    def _check_leases(self) -> None:
        """Let robots go whose system nobody keeps any more."""
        claimed = {
            name: system for name, node in self.nodes.items() if (system := node.playback.system)
        }
        for system in self._leases.expired(set(claimed.values()), time.monotonic()):
            robots = [name for name, owner in claimed.items() if owner == system]
            self.get_logger().warning(
                f"nobody keeps the system {system} any more: {', '.join(robots)} stand, "
                "independent again"
            )
            for name in robots:
                node = self.nodes[name]
                with self.scheduler.command(node.player) as now_ns:
                    node.playback.release(now_ns, system)

    def _kept_of(self, robot: str, model: str) -> Kept | None:
        """Return what the robot had before a restart; None where it was another one."""
        had, kept = self._kept.get(robot, ("", None))
        fits = kept is not None and len(kept.arm) == len(self._library.model(model).joints)
        return kept if fits and had == model else None

    def _pose_file(self, robot: str, model: RobotModel) -> PoseFile | None:
        """Return the file of a robot's last pose; None: nothing is kept."""
        if not self.parameters.state_dir:
            return None
        path = Path(self.parameters.state_dir) / f"{robot}.pose"
        try:
            return PoseFile(path, len(model.joints))
        except OSError as error:
            self.get_logger().error(
                f"{path} cannot be written, a restart will know the pose of {robot} less exactly: "
                f"{error.strerror}"
            )
            return None

    def _add(self, robot: msg.Robot) -> None:
        model = self._library.model(robot.model)
        pose_file = self._pose_file(robot.name, model)
        kept = self._kept_of(robot.name, robot.model)
        if kept is not None and pose_file is not None and (last := pose_file.get()) is not None:
            kept = entries.with_pose(kept, *last)
        node = PlaybackNode(
            robot.name,
            model,
            self._planner,
            self.scheduler,
            self._fetch,
            self.parameters.standing_rate,
            host=self._host,
            lab=self._identity.lab,
            kept=kept,
            pose_file=pose_file,
            keep=self._write_journal,
            warn=self.get_logger().warning,
            direct=self._direct,
            context=self.context,
        )
        with self.scheduler.command(node.player):
            # Before the executor's thread answers the first call.
            node.playback.end_effector = robot.end_effector
        self.nodes[robot.name] = node
        self._safety.executor.add_node(node)
        self.get_logger().info(f"added the playback of {robot.name} ({robot.model})")

    def _remove(self, robot: str) -> None:
        node = self.nodes.pop(robot)
        self._safety.executor.remove_node(node)
        node.close()

    @answered
    def _command_members(
        self, request: srv.CommandMembers.Request, response: srv.CommandMembers.Response
    ) -> None:
        with self.scheduler.command() as now_ns:
            response.stamp = time_to_message(self.scheduler.clock.stamp(now_ns))
            for order in request.orders:
                node = self.nodes.get(order.robot)
                if node is None:
                    raise Misuse(NOT_PLAYED(robot=order.robot))
                try:
                    duration = node.drive(now_ns, request.system, order_from_message(order))
                except LabError as error:
                    raise Misuse(OF_ROBOT(robot=order.robot, why=error)) from error
                reply = reply_to_message(order.robot, node.playback, duration)
                response.replies.append(reply)

    def _telemetry(self) -> None:
        now_ns = self.scheduler.clock.now_ns()
        for node in self.nodes.values():
            node.welcome()
            node.publish_telemetry(now_ns)

    def _states(self) -> None:
        self._turn = (self._turn + 1) % STATE_TURNS
        for node in list(self.nodes.values())[self._turn :: STATE_TURNS]:
            node.publish_state()
