"""One performance of the demo: convert, spawn, play, and compare what arrives over zenoh."""

from __future__ import annotations

import json
import math
import threading
import time
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from mrlab_ros.commands import diagnostics as say
from mrlab_ros.commands.demo.arrivals import Arrivals, frames_in_order
from mrlab_ros.commands.demo.report import Display, RobotSummary
from mrlab_ros.core.base.diagnostic import heard, of_text
from mrlab_ros.core.base.errors import LabError
from mrlab_ros.core.playback.diagnostics import PLAYED_TO_END
from mrlab_ros.core.runtime.identity import Identity
from mrlab_ros.processes.lab import lab_nodes
from mrlab_ros.processes.readiness import Readiness
from mrlab_ros.processes.web import gateway_answers

if TYPE_CHECKING:
    from rich.console import Console

    from mrlab_ros.client.follow import Follower
    from mrlab_ros.commands.demo.lab import Stage
    from mrlab_ros.ros.graph import Watch
    from mrlab_ros.ros.graph_node import Graph

SYSTEM = "demo"
START_TIMEOUT_S = 30.0
# How long the robots may take beyond their own motion, s, on a machine that is busy.
RUN_TIMEOUT_S = 30.0
# The way from a joint state's leaving to zenoh's subscriber takes milliseconds; s.
LAST_FRAME_TIMEOUT_S = 5.0


@dataclass(frozen=True)
class DemoRobot:
    """A workspace file and the robot that plays it: base at x (m), turned by yaw (rad)."""

    file: Path
    model: str
    end_effector: str = ""
    x: float = 0.0
    yaw: float = 0.0


def handover(examples: Path) -> list[DemoRobot]:
    """Return the shipped two-robot example, placed as its MATLAB script says."""
    tool = "parallel_gripper"
    return [
        DemoRobot(examples / "two_robot_handover_ur5e.mat", "ur5e", tool),
        DemoRobot(
            examples / "two_robot_handover_kr6.mat", "kuka_kr6_r900_sixx", tool, 1.2, math.pi
        ),
    ]


class Stopped(Exception):
    """Ctrl-C, or a signal that says the same."""


class Run:
    """One performance: every step in order, then what became of it."""

    def __init__(
        self, console: Console, stage: Stage, parts: list[DemoRobot], stop: threading.Event
    ) -> None:
        self._console, self._stage, self._parts, self._stop = console, stage, parts, stop

    def run(self) -> list[RobotSummary]:
        """Convert, spawn, load, stage, play; raise LabError where a step fails."""
        from mrlab_ros.ros.graph_node import Graph

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
        self._console.print(f"{step:<8} ", style="bold", end="")
        self._console.print(text, soft_wrap=True)

    def _pause(self, seconds: float) -> None:
        if self._stop.wait(seconds):
            raise Stopped

    def _until(self, condition: Any, timeout: float, part: str, name: str = "") -> None:
        deadline = time.monotonic() + timeout
        while not condition():
            if time.monotonic() > deadline:
                complaint = self._last_trouble()
                raise LabError(
                    say.WAITED_IN_DEMO(timeout=timeout, part=part, name=name, complaint=complaint)
                )
            self._pause(0.02)

    def _last_trouble(self) -> str | None:
        trouble = self._stage.log.trouble
        return trouble[-1] if trouble else None

    def _wait_for_lab(self, graph: Graph) -> None:
        options = self._stage.options
        identity = Identity(options.lab_id, lambda said: self._say("start", str(said)))
        lab = Readiness(graph, lab_nodes(options), 0, identity)
        self._until(lambda: not lab.missing(), START_TIMEOUT_S, "lab")
        gateway = gateway_answers(self._stage.web)
        self._until(gateway, START_TIMEOUT_S, "pages")
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
            why = of_text(str(error))
            raise LabError(
                say.DEMO_WITHOUT_ZENOH(endpoint=self._stage.endpoint, why=why)
            ) from None
        with session:
            yield session

    def _convert(self, graph: Graph, part: DemoRobot) -> Any:
        from mrlab_msgs import srv

        request = srv.ConvertTrajectory.Request(
            path=str(part.file), robot_model=part.model, end_effector=part.end_effector
        )
        answer = graph.order(srv.ConvertTrajectory, "/converter/convert", request, timeout=60.0)
        self._say("convert", answer.message)
        fetch = srv.GetTrajectory.Request(id=answer.trajectory.id)
        return graph.order(srv.GetTrajectory, "/converter/get", fetch).trajectory

    def _spawn(self, graph: Graph, part: DemoRobot) -> str:
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
        from mrlab_ros.client.follow import Follower

        followers = [Follower(graph, robot) for robot in robots]
        for follower, arrived in zip(followers, arrivals, strict=True):
            robot = follower.robot
            self._until(
                lambda f=follower: f.watch.value is not None,
                START_TIMEOUT_S,
                "playback",
                robot,
            )
            self._until(lambda a=arrived: a.payloads, START_TIMEOUT_S, "zenoh", arrived.key)
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
        from mrlab_msgs.srv import Trigger

        from mrlab_ros.messages.systems import member_to_message

        systems = graph.watch(msg.RobotSystems, "/systems")
        members = [
            member_to_message(robot, trajectory.info.id)
            for robot, trajectory in zip(robots, trajectories, strict=True)
        ]
        create = srv.CreateSystem.Request(name=SYSTEM, members=members)
        answer = graph.order(
            srv.CreateSystem, "/coordinator/create_system", create, timeout=RUN_TIMEOUT_S
        )
        self._say("load", answer.message)
        played = graph.order(Trigger, f"/{SYSTEM}/play", Trigger.Request(), timeout=RUN_TIMEOUT_S)
        self._say("play", played.message)
        longest = max(trajectory.info.duration for trajectory in trajectories)
        deadline = time.monotonic() + longest + RUN_TIMEOUT_S
        course = SystemCourse(systems)
        with Display(self._console, followers, arrivals) as display:
            while not course.complete():
                if time.monotonic() > deadline:
                    raise LabError(
                        say.DEMO_TOO_SLOW(duration=longest, complaint=self._last_trouble())
                    )
                display.show(course.label)
                self._pause(0.1)
            display.finish()

    def _summarise(
        self, graph: Graph, follower: Follower, trajectory: Any, arrived: Arrivals
    ) -> RobotSummary:
        start_ns, count = follower.start_ns, trajectory.info.frame_count
        if start_ns is None:
            complaint = self._last_trouble()
            raise LabError(say.DEMO_NEVER_PLAYED(robot=follower.robot, complaint=complaint))
        found, wrong = 0, [""]

        def complete() -> bool:
            nonlocal found, wrong
            found, wrong = frames_in_order(arrived.payloads, trajectory, start_ns)
            return bool(found >= count)

        end = time.monotonic() + LAST_FRAME_TIMEOUT_S
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

        systems = self._systems.value.systems if self._systems.value else ()
        found = [system for system in systems if system.name == SYSTEM]
        if not found:
            return False
        system, kind = found[0], msg.RobotSystem
        self.label = system.label
        if system.state == kind.COLLISION_HALT:
            raise LabError(say.DEMO_HALTED(why=heard(system)))
        if system.state == kind.PLAYING:
            self._played = True
        if system.state in (kind.READY, kind.COMPLETE) and self._played:
            if system.code == PLAYED_TO_END.code:
                return True
            why = heard(system) if system.message else None
            raise LabError(say.DEMO_ENDED_EARLY(state=system.label, why=why))
        return False
