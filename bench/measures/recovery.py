"""Safety and recovery: a client's wait for a pause, a halt, a killed process and a new robot.

Pause and halt: from the call of /ROBOT/pause to its answer, and from publishing /ROBOT/collision
to the state COLLISION_HALT, while twelve robots play and the lab around them is busy or stopped.
Mark: p99 < 10 ms in every case. A blow: each process is killed (kill -9), and frozen for 3 s; from
then on, or from the end of the freeze, a client repeats the command that a person would give next,
until it succeeds. Mark: 5 s each. A death: from the kill of each process to its end, which
includes the release of its memory, and from there to the event at another node. Mark: 10 ms to
the event. Spawn: from the order until its answer, the first joint state, and the topics of
physics, which has the robot's hulls then. Mark: 1 s each.
"""

from __future__ import annotations

import os
import signal
import sys
import tempfile
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import report
import zenoh
from lab import LIBRARY, MODEL, Lab, catalogue, robot_names, running, sine
from mrlab_msgs import msg, srv
from mrlab_msgs.srv import SetLoop, Trigger
from partner import Failed, until
from partners.zenoh_client import client_config
from sensor_msgs.msg import JointState
from size import Size
from tf2_msgs.msg import TFMessage

from mrlab_ros.core.base.diagnostics import ILLEGAL_EVENT
from mrlab_ros.core.runtime.process_states import Phase
from mrlab_ros.messages import qos
from mrlab_ros.processes.lab import LabProcess
from mrlab_ros.ros.calls import NoAnswer, call

NEEDS = ()
ROBOTS = 13
MILLION = 1_000_000
# The converter has a process of its own, so that it can be stopped alone.
APART = (
    LabProcess("converter", ("converter",)),
    LabProcess("lab", ("lab",), lambda options: {"lab:robots": options.robots}),
    LabProcess("playback", ("playback",)),
)
FREEZE_S = 3.0
# A client that has no answer by then asks again, s.
AGAIN_S = 1.0
# A lab that takes longer is broken, s.
LONGEST_S = 40.0


class Measured:
    """One robot that is paused and halted, over and over."""

    def __init__(self, lab: Lab, robot: str) -> None:
        self._lab, self._robot = lab, robot
        self._collision = lab.node.create_publisher(
            msg.Collision, f"/{robot}/collision", qos.LATCHED
        )

    def pause_ms(self) -> float:
        took = self._lab.ms(Trigger, f"/{self._robot}/pause")
        self._play()
        return took

    def halt_ms(self) -> float:
        contact = msg.Contact(link="forearm_link", other="wall")
        began = time.perf_counter()
        self._collision.publish(msg.Collision(colliding=True, contact=contact))
        self._lab.await_label(self._robot, "COLLISION_HALT")
        took = (time.perf_counter() - began) * 1e3
        self._collision.publish(msg.Collision(colliding=False))
        self._play()
        return took

    def _play(self) -> None:
        self._lab.await_label(self._robot, "PAUSED")
        self._lab.ask(Trigger, f"/{self._robot}/play")
        self._lab.await_label(self._robot, "PLAYING")

    def rows(self, case: str, seconds: float) -> list[dict[str, Any]]:
        took: dict[str, list[float]] = {"pause": [], "collision halt": []}
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            took["pause"].append(self.pause_ms())
            took["collision halt"].append(self.halt_ms())
            time.sleep(0.02)
        return [
            {"case": case, "what": what, "count": len(values), **report.percentiles(values)}
            for what, values in took.items()
        ]


@contextmanager
def loading(lab: Lab, robot: str) -> Iterator[list[str]]:
    """Load a long trajectory on `robot` again and again; yield what the loads answered."""
    answers: list[str] = []
    stop = threading.Event()

    def work() -> None:
        client = lab.client(srv.LoadTrajectory, f"/{robot}/load")
        while not stop.is_set():
            request = srv.LoadTrajectory.Request(id=("long", "short")[len(answers) % 2])
            try:
                answer = call(client, request, 30.0)
                answers.append("loaded" if answer.success else answer.message)
            except NoAnswer as error:
                answers.append(str(error))

    thread = threading.Thread(target=work)
    thread.start()
    try:
        yield answers
    finally:
        stop.set()
        thread.join()


def safety(size: Size) -> list[dict[str, Any]]:
    seconds = size.of(0.5, 8.0, 30.0)
    robots, frames = size.of((2, 10_000), (ROBOTS, MILLION), (ROBOTS, MILLION))
    with tempfile.TemporaryDirectory() as name:
        catalogue(Path(name), [sine("short", 6_000), sine("long", frames)])
        with running(Path(name), robots=robots, processes=APART) as lab:
            loader, *players = robot_names(robots)
            lab.follow([loader, *players])
            for robot in (loader, *players):
                lab.ask(srv.LoadTrajectory, f"/{robot}/load", id="short")
            for robot in players:
                lab.ask(SetLoop, f"/{robot}/set_loop", loop=True)
                lab.ask(Trigger, f"/{robot}/play")
            for robot in players:
                lab.await_label(robot, "PLAYING")
            measured = Measured(lab, players[0])
            # The first call of a service also finds it, which is not measured.
            measured.pause_ms()
            rows = measured.rows("quiet", seconds)
            with loading(lab, loader) as answers:
                rows += measured.rows(f"another robot loads {frames:,} frames", seconds)
            if "loaded" not in answers:
                raise Failed(f"nothing was loaded: {answers[:3]}")
            converter = lab.processes()["converter"]
            converter.suspend()
            try:
                with loading(lab, loader):
                    rows += measured.rows("the converter is stopped, a load waits", seconds)
            finally:
                converter.resume()
    return rows


class Commands:
    """What a person does next, by the process that was hit. Each returns whether it worked."""

    def __init__(self, lab: Lab) -> None:
        self._lab = lab
        self.said = ""
        self._transforms = 0
        lab.subscribe(TFMessage, "/tf", self._on_transforms, qos.STREAM)

    def _on_transforms(self, _: TFMessage) -> None:
        self._transforms += 1

    def _ask(self, kind: Any, service: str, **fields: Any) -> Any:
        try:
            return call(self._lab.client(kind, service), kind.Request(**fields), AGAIN_S)
        except NoAnswer as error:
            self.said = str(error)
            return None

    def _works(self, kind: Any, service: str, *, done: bool = False, **fields: Any) -> bool:
        """Return whether a service obeys; done: or refuses because it has done so already."""
        answer = self._ask(kind, service, **fields)
        if answer is None:
            return False
        self.said = answer.message
        return answer.success or (done and answer.code == ILLEGAL_EVENT.code)

    def play(self) -> bool:
        return self._works(Trigger, "/cell/play", done=True)

    def lab(self) -> bool:
        found = self._ask(srv.ListTrajectories, "/converter/list_any", robot_model=MODEL)
        return found is not None and self._works(Trigger, "/cell/pause")

    def playback(self) -> bool:
        alone = self._works(Trigger, f"/{MODEL}_3/stop")
        return alone and self.play()

    def recorder(self) -> bool:
        # A start that came too late for its caller is one.
        return self._works(srv.StartRecording, "/recorder/start", done=True)

    def tidy(self) -> None:
        """End what a command began."""
        call(self._lab.client(Trigger, "/recorder/stop"), Trigger.Request(), LONGEST_S)

    def physics(self) -> bool:
        return self._works(srv.SpawnObject, "/physics/spawn_object", type="cube", automatic=True)

    def frames(self) -> bool:
        before = self._transforms
        time.sleep(0.1)
        return self._transforms > before

    def bridge(self) -> bool:
        try:
            with zenoh.open(client_config(self._lab.endpoint)) as session:
                return any(r.ok for r in session.get("@mrlab/bridge/clock", timeout=AGAIN_S))
        except zenoh.ZError:
            return False

    def until_works(self, name: str) -> float:
        """Repeat a command until it works; return how long that took, s."""
        began = time.monotonic()
        while not getattr(self, name)():
            if time.monotonic() - began > LONGEST_S:
                raise Failed(f"{name} does not work again within {LONGEST_S:g} s: {self.said}")
            time.sleep(0.02)
        return time.monotonic() - began


def kill(pid: int) -> None:
    os.kill(pid, signal.SIGKILL)


def freeze(pid: int) -> None:
    os.kill(pid, signal.SIGSTOP)
    time.sleep(FREEZE_S)
    os.kill(pid, signal.SIGCONT)


def blows(size: Size) -> list[dict[str, Any]]:
    # Members have moved to their places, and processes have run for a while, after `settle` s.
    rounds, settle = size.of((1, 1.0), (1, 5.0), (5, 5.0))
    rows = []
    with tempfile.TemporaryDirectory() as name:
        catalogue(Path(name), [sine("short", 6_000)])
        with running(Path(name), robots=3) as lab:
            for robot in robot_names(3):
                lab.ask(srv.LoadTrajectory, f"/{robot}/load", id="short")
            members = [msg.SystemMember(robot=robot) for robot in robot_names(2)]
            lab.create_system(members)
            lab.ask(SetLoop, "/cell/set_loop", loop=True)
            commands = Commands(lab)
            for what, blow in size.some((("kill -9", kill), ("freeze 3 s", freeze))):
                for process in size.some(tuple(lab.processes())):
                    took = []
                    for _ in range(rounds):
                        commands.until_works("play")
                        time.sleep(settle)
                        blow(lab.processes()[process].pid)
                        took.append(commands.until_works(process))
                        commands.tidy()
                        print(f"{what} {process}: {took[-1]:.2f} s", file=sys.stderr, flush=True)
                    rows.append(
                        {
                            "blow": what,
                            "process": process,
                            "rounds": rounds,
                            "median s": sorted(took)[len(took) // 2],
                            "max s": max(took),
                        }
                    )
    return rows


def spawned(lab: Lab, model: str) -> dict[str, float]:
    """Spawn a robot and remove it again; return how long each step took, s."""
    name = f"{model}_bench"
    moved: list[float] = []
    lab.subscribe(
        JointState, f"/{name}/joint_states", lambda _: moved.append(time.monotonic()), qos.STREAM
    )
    began = time.monotonic()
    lab.ask(srv.SpawnRobot, "/lab/spawn_robot", model=model, name=name, automatic=True)
    answered = time.monotonic()
    until(lambda: lab.node.count_publishers(f"/{name}/collision"), "physics")
    in_physics = time.monotonic()
    until(lambda: moved, "a joint state")
    lab.ask(srv.Remove, "/lab/remove_robot", name=name)
    return {
        "answer, max s": answered - began,
        "joint state, max s": moved[0] - began,
        "physics, max s": in_physics - began,
    }


def spawns(size: Size) -> list[dict[str, Any]]:
    rounds, rows = size.of(1, 1, 3), []
    with tempfile.TemporaryDirectory() as name, running(Path(name)) as lab:
        lab.client(srv.SpawnRobot, "/lab/spawn_robot").wait_for_service(LONGEST_S)
        for model in size.some(LIBRARY.ids()):
            took = [spawned(lab, model) for _ in range(rounds)]
            most = {step: max(each[step] for each in took) for step in took[0]}
            rows.append({"model": model, "rounds": rounds, **most})
    return rows


def deaths(size: Size) -> list[dict[str, Any]]:
    rounds, rows = size.of(1, 3, 10), []
    with tempfile.TemporaryDirectory() as name, running(Path(name), robots=2) as lab:
        heard: list[tuple[int, msg.LabProcess]] = []

        def take(message: msg.LabProcesses) -> None:
            arrived_ns = time.monotonic_ns()
            heard.extend((arrived_ns, process) for process in message.processes)

        lab.subscribe(msg.LabProcesses, "/processes", take, qos.LATCHED)
        until(lambda: heard, "the processes")
        for process in size.some(tuple(lab.processes())):
            seen, event = [], []
            for _ in range(rounds):
                # Restarts follow each other the slower the sooner it dies again.
                until(lambda process=process: runs(lab, process), f"{process} running")
                heard.clear()
                killed_ns = time.monotonic_ns()
                kill(lab.processes()[process].pid)
                arrived_ns, down = until(
                    lambda process=process: first_death(heard, process), "the event"
                )
                seen.append((down.down_steady_ns - killed_ns) / 1e6)
                event.append((arrived_ns - down.down_steady_ns) / 1e6)
            rows.append(
                {
                    "process": process,
                    "rounds": rounds,
                    "kill to end, max ms": max(seen),
                    "end to event, median ms": sorted(event)[len(event) // 2],
                    "end to event, max ms": max(event),
                }
            )
    return rows


def runs(lab: Lab, process: str) -> bool:
    phases = {state.name: state.phase for state in lab.supervisor.states}
    return phases[process] == Phase.RUNNING.value


def first_death(
    heard: list[tuple[int, msg.LabProcess]], name: str
) -> tuple[int, msg.LabProcess] | None:
    waits = (one for one in list(heard) if one[1].state == msg.LabProcess.WAITING)
    return next((one for one in waits if one[1].name == name), None)


TABLES = {
    "From a death to its event on /processes": deaths,
    "Safety path: what a client waits for": safety,
    "From a blow to the next command that works": blows,
    "From the order to a robot in the lab": spawns,
}
