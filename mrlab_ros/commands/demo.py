"""`mrlab demo`: the whole lab once, from a workspace file to frames received over zenoh."""

from __future__ import annotations

import json
import math
import os
import random
import socket
import sys
import threading
import time
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from mrlab_ros.commands.up import (
    COLOURS,
    Speaker,
    checked_config,
    folder_for_state,
    lab_is_missing,
    lab_processes,
    stay_on_this_machine,
    stop_signals,
)
from mrlab_ros.core.errors import BadInput, LabError, Misuse
from mrlab_ros.supervisor import SELF, RunFile, Supervisor, domain_id

if TYPE_CHECKING:
    from rich.console import Console

    from mrlab_ros.commands.follow import Follower
    from mrlab_ros.graph_client import Graph, Watch

SYSTEM = "demo"
ZENOH_PORT = 7447
# Domains above need ports that Linux hands out to anybody.
DOMAINS = range(102)
START_TIMEOUT = 30.0
# How long the robots may take beyond their own motion, s, on a machine that is busy.
PATIENCE = 30.0
# The way from a joint state's leaving to zenoh's subscriber takes milliseconds; s.
LAST_FRAME_TIMEOUT = 5.0
PROGRESS_PERIOD = 1.0


@dataclass(frozen=True)
class Part:
    """A workspace file and the robot that plays it: base at x (m), turned by yaw (rad)."""

    file: Path
    model: str
    end_effector: str = ""
    x: float = 0.0
    yaw: float = 0.0


def handover(examples: Path) -> list[Part]:
    """Return the shipped two-robot example, placed as its MATLAB script says."""
    tool = "parallel_gripper"
    return [
        Part(examples / "two_robot_handover_ur5e.mat", "ur5e", tool),
        Part(examples / "two_robot_handover_kr6.mat", "kuka_kr6_r900_sixx", tool, 1.2, math.pi),
    ]


class Stopped(Exception):
    """Ctrl-C, or a signal that says the same."""


@dataclass
class RobotSummary:
    """What became of one robot's run; errors in s."""

    robot: str
    trajectory: str
    frames_expected: int
    frames_received: int
    frames_lost: int
    deadline_error_p50: float
    deadline_error_max: float
    zenoh_messages: int
    zenoh_bytes: int
    warnings: list[str] = field(default_factory=list)
    # What kept the frames from arriving once each, in order, as the file has them.
    faults: list[str] = field(default_factory=list)


def demo(
    once: Annotated[
        bool, typer.Option("--once", help="End when the run is over, with its verdict.")
    ] = False,
    file: Annotated[
        Path | None, typer.Option(help="Play this workspace file on one robot instead.")
    ] = None,
    robot: Annotated[str, typer.Option(help="The robot that --file is for.")] = "ur5e",
    end_effector: Annotated[str, typer.Option(help="Its end effector; empty: none.")] = "",
    config: Annotated[
        Path | None, typer.Option(help="ROS parameter file; the shipped lab.yaml if not given.")
    ] = None,
    as_json: Annotated[
        bool, typer.Option("--json", help="Print the summary as JSON; all else goes to stderr.")
    ] = False,
) -> None:
    """Show the whole lab at work: a MATLAB file becomes robots that move.

    Starts a lab of its own on a free ROS domain and a free zenoh port, converts the shipped
    hand-over, puts two robots in the scene, lets them play as one system, and counts what arrives
    over zenoh. It stays up until Ctrl-C.

    Ends with 0 when every frame arrived, 1 when anything failed, 130 when interrupted before.
    """
    from rich.console import Console

    from mrlab_ros import share

    parts = handover(share.directory() / "examples")
    if file is not None:
        parts = [Part(file.resolve(), robot, end_effector)]
    for part in parts:
        if not part.file.is_file():
            raise BadInput(f"there is no file {part.file}; name a workspace file with --file")
    console = Console(stderr=as_json, highlight=False)
    with ExitStack() as stack:
        stop = stack.enter_context(stop_signals())
        try:
            stage = stack.enter_context(_lab(console, config))
            summaries = Run(console, stage, parts, stop).run()
        except Stopped:
            raise typer.Exit(130) from None
        if as_json:
            sys.stdout.write(json.dumps(_facts(stage, summaries), indent=2) + "\n")
            sys.stdout.flush()
        else:
            _print_summary(console, summaries)
        _judge(summaries)
        took = time.monotonic() - stage.begin
        console.print(f"[bold green]Every frame arrived.[/] The demo took {took:.0f} s.")
        if not once:
            _print_next_steps(console, stage, summaries)
            stage.log.speak = True
            stop.wait()


@dataclass
class Stage:
    """The lab that the demo has started."""

    domain: int
    endpoint: str
    log: Log
    begin: float


class Log:
    """Has every line of the nodes: shows trouble at once, and all of it when told to speak."""

    def __init__(self, console: Console) -> None:
        self._say = Speaker(console)
        self.speak = False
        # What processes say of their own end is no trouble.
        self.stopping = False
        self.trouble: list[str] = []

    def __call__(self, name: str, line: str) -> None:
        known = line.startswith(("[INFO]", "[DEBUG]")) or not line.strip()
        quiet = known or self.stopping
        if not quiet:
            self.trouble.append(f"{name}: {line}")
        if self.speak or not quiet:
            self._say(name, line)


@contextmanager
def _lab(console: Console, config: Path | None) -> Iterator[Stage]:
    """Run a lab on a free ROS domain and zenoh port."""
    begin = time.monotonic()
    stay_on_this_machine()
    with folder_for_state(None) as folder:
        endpoint = f"tcp/127.0.0.1:{free_port(ZENOH_PORT)}"
        run_file, domain = claim_free_domain(state_dir=str(folder), zenoh=endpoint)
        os.environ["ROS_DOMAIN_ID"] = str(domain)
        log = Log(console)
        try:
            specs = lab_processes(
                config=checked_config(config), robots=(), listen=endpoint, state_dir=folder
            )
            with Supervisor(specs, log, run_file.write):
                console.print(f"Lab on ROS domain {domain}, zenoh at {endpoint}", style="bold")
                try:
                    yield Stage(domain, endpoint, log, begin)
                finally:
                    log.stopping = True
        finally:
            run_file.release()


def free_port(preferred: int) -> int:
    """Return a TCP port of the loopback that nobody listens on, `preferred` where it is free."""
    for port in (preferred, 0):
        with socket.socket() as probe:
            # As a server does: what a closed connection left behind is no hindrance.
            probe.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
            try:
                probe.bind(("127.0.0.1", port))
            except OSError:
                continue
            return int(probe.getsockname()[1])
    raise LabError("no TCP port is free on this machine; end some programs, then try again")


def domain_is_free(domain: int) -> bool:
    """Return whether none of the first ten participants that DDS allows in `domain` exists."""
    for participant in range(10):
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
            try:
                probe.bind(("", 7400 + 250 * domain + 10 + 2 * participant))
            except OSError:
                return False
    return True


def claim_free_domain(**facts: object) -> tuple[RunFile, int]:
    """Take a ROS domain that nobody uses: ROS_DOMAIN_ID's where that is free."""
    wanted = [domain_id()] if os.environ.get("ROS_DOMAIN_ID") else []
    others = random.sample(DOMAINS, len(DOMAINS))
    for domain in wanted + others:
        if not domain_is_free(domain):
            continue
        run_file = RunFile(domain)
        try:
            run_file.claim(**facts)
        except Misuse:
            continue
        return run_file, domain
    raise LabError("every ROS domain is in use on this machine; end some labs, then try again")


class Arrivals:
    """What arrives over zenoh on one robot's joint_states: every payload, in order."""

    def __init__(self, session: Any, robot: str) -> None:
        self.key = f"{robot}/joint_states"
        self.payloads: list[bytes] = []
        self.bytes = 0
        self._subscriber = session.declare_subscriber(self.key, self._take)

    def _take(self, sample: Any) -> None:
        payload = sample.payload.to_bytes()
        self.payloads.append(payload)
        self.bytes += len(payload)


def frames_in_order(
    payloads: list[bytes], trajectory: Any, start_ns: int
) -> tuple[int, list[str]]:
    """Count the source frames among `payloads`; say what is wrong with their order or values.

    A frame counts once, when its stamp is its deadline and its positions are the trajectory's
    own, bit for bit. `start_ns` is the deadline of frame 0.
    """
    import numpy as np
    from rclpy.serialization import deserialize_message
    from sensor_msgs.msg import JointState

    from mrlab_ros import conversions

    source = conversions.trajectory_from_message(trajectory)
    expected, found, wrong = 0, 0, []
    for payload in payloads:
        message = deserialize_message(payload, JointState)
        share = (conversions.to_ns(message.header.stamp) - start_ns) * 1e-9 * source.frame_rate
        frame = round(share)
        if not 0 <= frame < source.frame_count or abs(share - frame) > 1e-3:
            continue
        if frame != expected:
            wrong.append(f"frame {frame} came where frame {expected} was due")
        positions = np.array(message.position[: len(source.joint_names)])
        if not np.array_equal(positions, source.positions[frame]):
            wrong.append(f"frame {frame} has other positions than the file")
        elif frame >= expected:
            found += 1
        expected = max(expected, frame + 1)
    return found, wrong


class Run:
    """One performance: every step in order, then what became of it."""

    def __init__(
        self, console: Console, stage: Stage, parts: list[Part], stop: threading.Event
    ) -> None:
        self._console, self._stage, self._parts, self._stop = console, stage, parts, stop

    def run(self) -> list[RobotSummary]:
        """Convert, spawn, load, stage, play; raise LabError where a step fails."""
        from mrlab_ros.graph_client import Graph

        with ExitStack() as stack:
            graph = stack.enter_context(Graph())
            self._wait_for_lab(graph)
            session = stack.enter_context(self._zenoh())
            trajectories = [self._convert(graph, part) for part in self._parts]
            robots = [self._spawn(graph, part) for part in self._parts]
            arrivals = [Arrivals(session, robot) for robot in robots]
            followers = self._follow(graph, robots, arrivals)
            self._play(graph, robots, trajectories, followers, arrivals)
            return [
                self._summarise(graph, follower, trajectory, arrived)
                for follower, trajectory, arrived in zip(
                    followers, trajectories, arrivals, strict=True
                )
            ]

    def _say(self, step: str, text: str) -> None:
        self._console.print(f"[bold]{step:<8}[/] ", end="")
        self._console.print(text, markup=False, soft_wrap=True)

    def _pause(self, seconds: float) -> None:
        if self._stop.wait(seconds):
            raise Stopped

    def _until(self, condition: Any, timeout: float, what: str) -> None:
        deadline = time.monotonic() + timeout
        while not condition():
            if time.monotonic() > deadline:
                raise LabError(f"waited {timeout:g} s for {what}; {self._last_trouble()}")
            self._pause(0.02)

    def _last_trouble(self) -> str:
        trouble = self._stage.log.trouble
        return f"its last complaint: {trouble[-1]}" if trouble else "nothing complained"

    def _wait_for_lab(self, graph: Graph) -> None:
        missing = lab_is_missing(graph, robots=0, bridge=True)
        self._until(lambda: not missing(), START_TIMEOUT, "all parts of the lab")
        self._say("start", f"the lab is ready after {time.monotonic() - self._stage.begin:.1f} s")

    @contextmanager
    def _zenoh(self) -> Iterator[Any]:
        import zenoh

        config = zenoh.Config()
        config.insert_json5("mode", '"client"')
        config.insert_json5("connect/endpoints", json.dumps([self._stage.endpoint]))
        config.insert_json5("scouting/multicast/enabled", "false")
        try:
            session = zenoh.open(config)
        except zenoh.ZError as error:
            raise LabError(
                f"no zenoh session to the bridge at {self._stage.endpoint}: {error}"
            ) from None
        with session:
            yield session

    def _convert(self, graph: Graph, part: Part) -> Any:
        from mrlab_msgs import srv

        request = srv.ConvertTrajectory.Request(
            path=str(part.file), robot_model=part.model, end_effector=part.end_effector
        )
        answer = graph.order(srv.ConvertTrajectory, "/converter/convert", request, timeout=60.0)
        self._say("convert", answer.message)
        fetch = srv.GetTrajectory.Request(id=answer.trajectory.id)
        return graph.order(srv.GetTrajectory, "/converter/get", fetch).trajectory

    def _spawn(self, graph: Graph, part: Part) -> str:
        from mrlab_msgs import srv

        request = srv.SpawnRobot.Request(model=part.model, end_effector=part.end_effector)
        request.pose.position.x = part.x
        request.pose.orientation.z = math.sin(part.yaw / 2)
        request.pose.orientation.w = math.cos(part.yaw / 2)
        answer = graph.order(srv.SpawnRobot, "/lab/spawn_robot", request)
        self._say("spawn", answer.message)
        return str(answer.robot.name)

    def _follow(self, graph: Graph, robots: list[str], arrivals: list[Arrivals]) -> list[Follower]:
        """Follow the robots; wait until each speaks on the graph and over zenoh."""
        from mrlab_ros.commands.follow import Follower

        followers = [Follower(graph, robot) for robot in robots]
        for follower, arrived in zip(followers, arrivals, strict=True):
            robot = follower.robot
            self._until(
                lambda f=follower: f.watch.value is not None,
                START_TIMEOUT,
                f"the playback of {robot}",
            )
            self._until(lambda a=arrived: a.payloads, START_TIMEOUT, f"{arrived.key} over zenoh")
            self._say("zenoh", f"{arrived.key} arrives, {len(arrived.payloads[0])} bytes a frame")
        return followers

    def _play(
        self,
        graph: Graph,
        robots: list[str],
        trajectories: list[Any],
        followers: list[Follower],
        arrivals: list[Arrivals],
    ) -> None:
        from mrlab_msgs import msg, srv
        from std_srvs.srv import Trigger

        systems = graph.watch(msg.RobotSystems, "/systems")
        members = [
            msg.SystemMember(robot=robot, trajectory_id=trajectory.info.id)
            for robot, trajectory in zip(robots, trajectories, strict=True)
        ]
        create = srv.CreateSystem.Request(name=SYSTEM, members=members)
        answer = graph.order(
            srv.CreateSystem, "/coordinator/create_system", create, timeout=PATIENCE
        )
        self._say("load", answer.message)
        answer = graph.order(Trigger, f"/{SYSTEM}/play", Trigger.Request(), timeout=PATIENCE)
        self._say("play", answer.message)
        longest = max(trajectory.info.duration for trajectory in trajectories)
        deadline = time.monotonic() + longest + PATIENCE
        course = SystemCourse(systems)
        with Display(self._console, followers, arrivals) as display:
            while not course.complete():
                if time.monotonic() > deadline:
                    raise LabError(
                        f"the run of {longest:g} s did not end in time; {self._last_trouble()}"
                    )
                display.show(course.label)
                self._pause(0.1)
            display.finish()

    def _summarise(
        self, graph: Graph, follower: Follower, trajectory: Any, arrived: Arrivals
    ) -> RobotSummary:
        start_ns, count = follower.start_ns, trajectory.info.frame_count
        if start_ns is None:
            raise LabError(f"{follower.robot} never said that it plays; {self._last_trouble()}")
        found, wrong = 0, [""]

        def complete() -> bool:
            nonlocal found, wrong
            found, wrong = frames_in_order(arrived.payloads, trajectory, start_ns)
            return bool(found >= count)

        end = time.monotonic() + LAST_FRAME_TIMEOUT
        while not complete() and time.monotonic() < end:
            self._pause(0.2)
        if found < count:
            wrong.append(f"{count - found} of {count} frames did not arrive")
        return RobotSummary(
            robot=follower.robot,
            trajectory=trajectory.info.id,
            frames_expected=count,
            frames_received=found,
            frames_lost=follower.frames_lost,
            deadline_error_p50=follower.error_p50,
            deadline_error_max=follower.error_max,
            zenoh_messages=len(arrived.payloads),
            zenoh_bytes=arrived.bytes,
            warnings=[warning.message for warning in trajectory.info.warnings],
            faults=wrong,
        )


class SystemCourse:
    """Reads the run off the states of the demo's system."""

    def __init__(self, systems: Watch[Any]) -> None:
        self._systems = systems
        self._played = False
        self.label = ""

    def complete(self) -> bool:
        """Return whether the run is over; raise LabError where it ended too early."""
        from mrlab_msgs import msg

        found = [
            s for s in (self._systems.value or msg.RobotSystems()).systems if s.name == SYSTEM
        ]
        if not found:
            return False
        system, kind = found[0], msg.RobotSystem
        self.label = system.label
        if system.state == kind.COLLISION_HALT:
            raise LabError(f"the run was halted: {system.message}")
        if system.state == kind.PLAYING:
            self._played = True
        if system.state in (kind.READY, kind.COMPLETE) and self._played:
            if system.message == "played to the end":
                return True
            raise LabError(f"the run ended too early: {system.message or system.label}")
        return False


class Display:
    """Shows the robots' progress: live on a terminal, a line now and then elsewhere."""

    def __init__(
        self, console: Console, followers: list[Follower], arrivals: list[Arrivals]
    ) -> None:
        from rich.progress import BarColumn, Progress, TextColumn

        self._console = console
        self._rows = list(zip(followers, arrivals, strict=True))
        self._next = 0.0
        self._live = Progress(
            TextColumn("{task.description}"),
            BarColumn(),
            TextColumn("{task.fields[words]}"),
            console=console,
            disable=not console.is_terminal,
        )
        self._tasks = [
            self._live.add_task(follower.robot, words="", total=1) for follower in followers
        ]

    def __enter__(self) -> Display:
        self._live.start()
        return self

    def __exit__(self, *_: object) -> None:
        self._live.stop()

    def show(self, system: str) -> None:
        """Show the present state of every robot, and of the system."""
        from mrlab_ros.commands.follow import milliseconds

        lines = []
        for (follower, arrived), task in zip(self._rows, self._tasks, strict=True):
            state = follower.state
            late = milliseconds(follower.errors[-1]) if follower.errors else "-"
            words = (
                f"{state.label:<9} frame {follower.frame:>4} of {state.frame_count}, late {late}, "
                f"{len(arrived.payloads)} over zenoh"
            )
            total = max(state.frame_count - 1, 1)
            self._live.update(task, completed=follower.frame, total=total, words=words)
            lines.append(f"{follower.robot}: {words}")
        if not self._console.is_terminal and time.monotonic() >= self._next:
            self._next = time.monotonic() + PROGRESS_PERIOD
            for line in lines:
                self._console.print(f"{system.lower():<8} {line}", markup=False, soft_wrap=True)

    def finish(self) -> None:
        """Show every robot at its last frame: READY, which follows, counts from the first."""
        for (follower, arrived), task in zip(self._rows, self._tasks, strict=True):
            words = f"COMPLETE, {len(arrived.payloads)} messages over zenoh"
            count = follower.state.frame_count
            self._live.update(task, completed=count, total=count, words=words)


def _judge(summaries: list[RobotSummary]) -> None:
    """Raise LabError where a frame did not arrive as it should."""
    for s in summaries:
        if s.faults:
            raise LabError(
                f"{s.robot}: {s.frames_received} of {s.frames_expected} frames arrived over zenoh "
                f"in order and as the file has them, {s.frames_lost} were left out by the "
                f"playback; first fault: {s.faults[0]}"
            )


def _facts(stage: Stage, summaries: list[RobotSummary]) -> dict[str, Any]:
    robots = [asdict(s) for s in summaries]
    for robot in robots:
        for key, value in robot.items():
            if isinstance(value, float) and math.isnan(value):
                robot[key] = None
    return {
        "success": not any(s.faults for s in summaries),
        "domain": stage.domain,
        "zenoh": stage.endpoint,
        "robots": robots,
        "complaints": stage.log.trouble,
    }


def _print_summary(console: Console, summaries: list[RobotSummary]) -> None:
    from rich.table import Table

    from mrlab_ros.commands.follow import milliseconds

    table = Table(box=None, padding=(0, 2, 0, 0), pad_edge=False)
    table.add_column("robot", no_wrap=True)
    for column in ("frames", "late p50", "max", "messages", "bytes", "warnings"):
        table.add_column(column, justify="right")
    for s in summaries:
        table.add_row(
            s.robot,
            f"{s.frames_received}/{s.frames_expected}",
            milliseconds(s.deadline_error_p50),
            milliseconds(s.deadline_error_max),
            f"{s.zenoh_messages:,}",
            f"{s.zenoh_bytes:,}",
            str(len(s.warnings)),
        )
    console.print()
    console.print(table)
    console.print()
    for s in summaries:
        for warning in s.warnings:
            console.print(f"{s.robot}: {warning}", style=COLOURS[SELF], markup=False)


def _print_next_steps(console: Console, stage: Stage, summaries: list[RobotSummary]) -> None:
    environment = ""
    script = Path(os.environ.get("VIRTUAL_ENV", "/nowhere")) / "mrlab.sh"
    if script.is_file():
        environment = f". {os.path.relpath(script)}; "
    first = summaries[0]
    client = "examples/clients/python/mrlab_client.py"
    watch = (
        f"python {client} watch {first.robot}/joint_states sensor_msgs/msg/JointState "
        f"--connect {stage.endpoint}"
    )
    lines = [
        "",
        "The lab stays up until Ctrl-C. In another terminal:",
        f"  {environment}export ROS_DOMAIN_ID={stage.domain}",
        "  mrlab status",
        f"  mrlab play {first.robot} YOUR.mat",
        "What a headset or your own program receives, with nothing of the lab but zenoh:",
        f"  {watch}",
        "Where ROS itself is installed:",
        f"  ros2 topic echo /{first.robot}/joint_states",
        "",
    ]
    for line in lines:
        console.print(line, markup=False, soft_wrap=True)
