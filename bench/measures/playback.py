"""Punctuality of playback: how late joint states leave, how many are lost, and what it costs.

The lab's deadline thread, with real-time priority where that is permitted and without, beside the
baseline in the same run: one rclpy timer a robot that fills a message. Late: from a joint state's
deadline to the moment its publish call has returned. In a whole lab, thirteen robots play at 100
Hz with telemetry, read by physics, the bridge, a recording and a client; then they stand, while a
process with plain timers publishes the same. There lateness is what telemetry says of every robot
ten times a second, and of the timers that of every joint state. CPU is of one core.
"""

from __future__ import annotations

import os
import tempfile
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import psutil
import rclpy
import report
from lab import LIBRARY, MODEL, Lab, catalogue, robot_names, running, sine
from mrlab_msgs import msg, srv
from mrlab_msgs.srv import SetLoop, Trigger
from partner import cpu_s, in_process, until
from rclpy.executors import SingleThreadedExecutor
from sensor_msgs.msg import JointState
from size import Size

from mrlab_ros.adapters.robots.ruckig_planner import RuckigPlanner
from mrlab_ros.core.playback.playback import Playback
from mrlab_ros.core.playback.states import State
from mrlab_ros.core.playback.stream import Sample
from mrlab_ros.messages import qos
from mrlab_ros.messages.joint_states import JointStateEncoder
from mrlab_ros.messages.time import time_to_message
from mrlab_ros.ros import deadlines
from mrlab_ros.ros.deadlines import Player, Scheduler

NEEDS = ()
ROBOTS, RATE = 13, 100.0
CASES = ((1, 100.0), (13, 100.0), (50, 100.0), (1, 250.0), (1, 500.0), (1, 1000.0))


class Late:
    """How late joint states left, ms, and the processor time meanwhile."""

    def __init__(self) -> None:
        self.ms: list[float] = []
        self.begin()

    def begin(self) -> None:
        self._began = time.process_time()

    def found(self, expected: int, seconds: float) -> dict[str, Any]:
        cpu = (time.process_time() - self._began) / seconds
        return {"ms": self.ms, "lost": expected - len(self.ms), "CPU %": 100 * cpu}


def deadline_thread(robots: int, rate: float, seconds: float, name: str = "robot") -> Any:
    """Play on `robots` robots through the scheduler."""
    rclpy.init()
    node = rclpy.create_node("bench")
    model, motion = LIBRARY.model(MODEL), sine("sine", round(rate * seconds) + 1, rate)
    scheduler, players, late = Scheduler(), [], Late()
    for i in range(robots):
        playback = Playback(model, RuckigPlanner(), 0.0)
        encoder = JointStateEncoder(f"{name}_{i + 1}", model.joint_names)
        publisher = node.create_publisher(JointState, f"{name}_{i + 1}/joint_states", qos.STREAM)

        def send(sample: Sample, encoder: Any = encoder, publisher: Any = publisher) -> None:
            publisher.publish(encoder.encode(sample.due_ns, sample.positions, sample.velocities))
            if sample.streamed:
                late.ms.append((scheduler.clock.now_ns() - sample.due_ns) * 1e-6)

        playback.load(0, motion)
        players.append(Player(playback, send, lambda now_ns, snapshot: None))
        scheduler.add(players[-1])
    scheduler.start()
    late.begin()
    with scheduler.command() as now_ns:
        for player in players:
            player.playback.play(now_ns, now_ns + 200_000_000)
    until(lambda: all(p.playback.state is State.READY for p in players), "the end", seconds + 30)
    scheduler.stop()
    return late.found(robots * motion.frame_count, seconds + 0.2)


def ordinary_thread(robots: int, rate: float, seconds: float, name: str = "robot") -> Any:
    """Play as deadline_thread() does, in a thread without precedence over other work."""
    deadlines.take_precedence = lambda: ""
    return deadline_thread(robots, rate, seconds, name)


def plain_timers(robots: int, rate: float, seconds: float, name: str = "robot") -> Any:
    """Play with one rclpy timer a robot; its call k is due (k + 1)/f after it was made."""
    rclpy.init()
    node = rclpy.create_node("bench")
    motion, late = sine("sine", round(rate * seconds) + 1, rate), Late()
    executor, period = SingleThreadedExecutor(), round(1e9 / rate)
    executor.add_node(node)
    playing = set(range(robots))

    def timer(robot: int) -> Callable[[], None]:
        publisher = node.create_publisher(
            JointState, f"{name}_{robot + 1}/joint_states", qos.STREAM
        )
        due, frames = time.monotonic_ns() + period, iter(range(motion.frame_count))

        def tick() -> None:
            frame = next(frames, None)
            if frame is None:
                playing.discard(robot)
                return
            message = JointState(name=list(motion.joint_names))
            message.header.stamp = time_to_message(time.monotonic_ns())
            message.position = motion.positions[frame].tolist()
            message.velocity = motion.channels.velocities[frame].tolist()
            publisher.publish(message)
            late.ms.append((time.monotonic_ns() - due - frame * period) * 1e-6)

        return tick

    for robot in range(robots):
        node.create_timer(1 / rate, timer(robot))
    end = time.monotonic() + 3 * seconds + 10
    while playing and time.monotonic() < end:
        executor.spin_once(timeout_sec=0.1)
    return late.found(robots * motion.frame_count, seconds)


METHODS: dict[str, Callable[..., Any]] = {
    "deadline thread": deadline_thread,
    "without priority": ordinary_thread,
    "rclpy timers": plain_timers,
}


def alone(method: str, robots: int, rate: float, seconds: float) -> dict[str, Any]:
    """Run one method in a process of its own."""
    found = in_process(METHODS[method], robots, rate, seconds)
    return {
        "method": method,
        "robots": robots,
        "Hz": rate,
        "frames": len(found["ms"]),
        **report.percentiles(found["ms"], "late "),
        "last late ms": found["ms"][-1],
        "lost": found["lost"],
        "CPU %": found["CPU %"],
    }


def punctuality(size: Size) -> list[dict[str, Any]]:
    seconds = size.of(0.2, 2.0, 10.0)
    rows = [
        alone(method, robots, rate, seconds)
        for robots, rate in size.some(CASES)
        for method in METHODS
    ]
    # 10,000 frames: at 100 Hz that takes 100 s, so the quick run asks the same of 1000 Hz.
    rate, frames = size.of(1000.0, 1000.0, 100.0), size.of(99, 9999, 9999)
    return [*rows, alone("deadline thread", 1, rate, frames / rate)]


class Listening:
    """What a client receives of the robots."""

    def __init__(self, lab: Lab, robots: int) -> None:
        self.late: list[float] = []
        self.count = 0
        for robot in robot_names(robots):
            lab.subscribe(msg.Telemetry, f"/{robot}/telemetry", self._on_telemetry, qos.STREAM)
            lab.subscribe(
                JointState, f"/{robot}/joint_states", self._on_joint_state, qos.STREAM, raw=True
            )

    def _on_telemetry(self, message: Any) -> None:
        self.late.append(message.deadline_error * 1e3)

    def _on_joint_state(self, data: bytes) -> None:
        self.count += 1


def without_priority(process: psutil.Process) -> None:
    """Give every thread of a process the ordinary policy."""
    for thread in process.threads():
        os.sched_setscheduler(thread.id, os.SCHED_OTHER, os.sched_param(0))


def used(lab: Lab, work: Callable[[], Any]) -> tuple[Any, dict[str, float]]:
    """Return what `work` returns, and each process's share of a core meanwhile, %."""
    processes = lab.processes()
    before, began = {name: cpu_s(p) for name, p in processes.items()}, time.monotonic()
    found = work()
    taken = time.monotonic() - began
    return found, {n: 100 * (cpu_s(p) - before[n]) / taken for n, p in processes.items()}


def in_a_lab(size: Size) -> list[dict[str, Any]]:
    settle, seconds = size.of((0.5, 0.5), (6.0, 10.0), (6.0, 30.0))
    robots = size.of(2, ROBOTS, ROBOTS)
    with tempfile.TemporaryDirectory() as name:
        catalogue(Path(name), [sine("short", 60_000)])
        with running(Path(name), robots=robots) as lab:
            listening = Listening(lab, robots)
            for robot in robot_names(robots):
                lab.ask(srv.LoadTrajectory, f"/{robot}/load", id="short")
            members = [msg.SystemMember(robot=robot) for robot in robot_names(robots)]
            lab.create_system(members)
            lab.ask(SetLoop, "/cell/set_loop", loop=True)
            lab.ask(srv.StartRecording, "/recorder/start", bag=str(Path(name) / "bag"))
            lab.ask(Trigger, "/cell/play")
            time.sleep(settle)
            return compared(lab, listening, robots, seconds)


def compared(lab: Lab, listening: Listening, robots: int, seconds: float) -> list[dict[str, Any]]:
    def row(method: str, late: list[float], received: float, cpu: dict[str, float]) -> Any:
        own = cpu.pop("playback")
        return {
            "joint states by": method,
            **report.percentiles(late, "late "),
            "received/s": received,
            "its CPU %": own,
            **{f"{name} %": value for name, value in cpu.items()},
        }

    rows = []
    for method in ("deadline thread", "without priority"):
        if method == "without priority":
            without_priority(lab.processes()["playback"])
        listening.late.clear()
        before = listening.count
        _, cpu = used(lab, lambda: time.sleep(seconds))
        received = (listening.count - before) / seconds
        rows.append(row(method, list(listening.late), received, cpu))
    lab.ask(Trigger, "/cell/stop")
    before = listening.count
    found, cpu = used(lab, lambda: in_process(plain_timers, robots, RATE, seconds, MODEL))
    cpu["playback"] = found["CPU %"]
    received = (listening.count - before) / seconds
    return [*rows, row("rclpy timers", found["ms"], received, cpu)]


TABLES = {"Playback punctuality": punctuality, f"{ROBOTS} robots in a whole lab": in_a_lab}
