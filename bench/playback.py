"""Punctuality of playback: how late joint states leave, how many are lost, what it costs.

The lab's deadline thread, with real-time priority where that is permitted and without, beside what
it replaces, a plain rclpy timer per robot that fills a message, in the same run. Each case has a
process of its own; deadline error is the time from a joint state's deadline to the moment its
publish call has returned.
"""

from __future__ import annotations

import argparse
import json
import os
import subprocess
import sys
import time
from collections.abc import Callable
from typing import Any

import numpy as np
import rclpy
import report
from rclpy.executors import SingleThreadedExecutor
from sensor_msgs.msg import JointState

from mrlab_ros.adapters.robots.library import RobotLibrary
from mrlab_ros.adapters.robots.ruckig_planner import RuckigPlanner
from mrlab_ros.core.playback.playback import Playback
from mrlab_ros.core.playback.states import State
from mrlab_ros.core.playback.stream import Sample
from mrlab_ros.core.trajectory.trajectory import Channels, Source, Trajectory
from mrlab_ros.messages import qos
from mrlab_ros.messages.joint_states import JointStateEncoder
from mrlab_ros.messages.time import time_to_message
from mrlab_ros.ros import deadlines, share
from mrlab_ros.ros.deadlines import Player, Scheduler


def trajectory(model: Any, frame_rate: float, seconds: float) -> Trajectory:
    """Return a slow sine around the home pose."""
    t = np.arange(round(frame_rate * seconds) + 1) / frame_rate
    wave = 0.2 * np.sin(t)[:, None] * np.ones(len(model.joints))
    positions, zeros = model.home + wave, np.zeros_like(wave)
    return Trajectory(
        "sine", model.id, None, model.joint_names, frame_rate, positions, None,
        Channels(np.gradient(positions, 1 / frame_rate, axis=0), zeros),
        Source("sine.mat", "q", "0" * 64),
    )  # fmt: skip


def deadline_thread(robots: int, rate: float, seconds: float) -> dict[str, Any]:
    """Play on `robots` robots through the scheduler; return errors in ms and counts."""
    node = rclpy.create_node("bench")
    model = RobotLibrary(share.directory() / "robots").model("ur5e")
    motion = trajectory(model, rate, seconds)
    scheduler = Scheduler()
    errors: list[int] = []
    last_error = [0]
    players = []
    for i in range(robots):
        playback = Playback(model, RuckigPlanner(), 0.0)
        encoder = JointStateEncoder(f"robot_{i}", model.joint_names)
        publisher = node.create_publisher(JointState, f"robot_{i}/joint_states", qos.STREAM)

        def send(sample: Sample, encoder: Any = encoder, publisher: Any = publisher) -> None:
            publisher.publish(encoder.encode(sample.due_ns, sample.positions, sample.velocities))
            if sample.streamed:
                last_error[0] = scheduler.clock.now_ns() - sample.due_ns
                errors.append(last_error[0])

        playback.load(0, motion)
        players.append(Player(playback, send, lambda now_ns, snapshot: None))
        scheduler.add(players[-1])
    scheduler.start()
    begin = time.process_time()
    with scheduler.command() as now_ns:
        for player in players:
            player.playback.play(now_ns, now_ns + 200_000_000)
    deadline = time.monotonic() + seconds + 30
    while any(p.playback.state is not State.READY for p in players):
        if time.monotonic() > deadline:
            raise SystemExit("the playback did not end")
        time.sleep(0.05)
    cpu = time.process_time() - begin
    scheduler.stop()
    return {
        "errors_ms": [e * 1e-6 for e in errors],
        "last_ms": last_error[0] * 1e-6,
        "lost": robots * motion.frame_count - len(errors),
        "cpu": cpu / (seconds + 0.2),
    }


def plain_timers(robots: int, rate: float, seconds: float, name: str = "robot") -> dict[str, Any]:
    """Play with one rclpy timer a robot; its call k is due (k + 1)/f after it was made."""
    node = rclpy.create_node("bench")
    model = RobotLibrary(share.directory() / "robots").model("ur5e")
    motion = trajectory(model, rate, seconds)
    period = round(1e9 / rate)
    errors: list[int] = []
    executor = SingleThreadedExecutor()
    executor.add_node(node)
    running = [robots]
    for i in range(robots):
        publisher = node.create_publisher(JointState, f"{name}_{i + 1}/joint_states", qos.STREAM)
        state = {"frame": 0, "start": time.monotonic_ns() + period}

        def tick(state: dict[str, int] = state, publisher: Any = publisher) -> None:
            frame = state["frame"]
            if frame >= motion.frame_count:
                if frame == motion.frame_count:
                    running[0] -= 1
                    state["frame"] += 1
                return
            now = time.monotonic_ns()
            message = JointState(name=list(motion.joint_names))
            message.header.stamp = time_to_message(now)
            message.position = motion.positions[frame].tolist()
            message.velocity = motion.channels.velocities[frame].tolist()
            publisher.publish(message)
            errors.append(time.monotonic_ns() - state["start"] - frame * period)
            state["frame"] += 1

        node.create_timer(1 / rate, tick)
    begin, deadline = time.process_time(), time.monotonic() + 3 * seconds + 10
    while running[0] > 0 and time.monotonic() < deadline:
        executor.spin_once(timeout_sec=0.1)
    return {
        "errors_ms": [e * 1e-6 for e in errors],
        "last_ms": errors[-1] * 1e-6,
        "lost": robots * motion.frame_count - len(errors),
        "cpu": (time.process_time() - begin) / seconds,
    }


def ordinary_thread(robots: int, rate: float, seconds: float) -> dict[str, Any]:
    """Play as deadline_thread() does, in a thread without precedence over other work."""
    deadlines.take_precedence = lambda: ""
    return deadline_thread(robots, rate, seconds)


METHODS: dict[str, Callable[..., dict[str, Any]]] = {
    "deadline thread": deadline_thread,
    "without priority": ordinary_thread,
    "rclpy timers": plain_timers,
}


def in_process(*case: Any) -> dict[str, Any]:
    """Run one case, a method and its arguments, in a process of its own; return its figures."""
    done = subprocess.run(
        [sys.executable, __file__, "--case", json.dumps(case)], stdout=subprocess.PIPE, check=True
    )
    result: dict[str, Any] = json.loads(done.stdout)
    return result


def run_case(method: str, robots: int, rate: float, seconds: float) -> dict[str, Any]:
    """Run one case and return its row."""
    result = in_process(method, robots, rate, seconds)
    errors = report.percentiles(result["errors_ms"])
    return {
        "method": method,
        "robots": robots,
        "Hz": rate,
        "frames": len(result["errors_ms"]),
        "error p50 ms": errors["p50"],
        "p99 ms": errors["p99"],
        "max ms": errors["max"],
        "last ms": result["last_ms"],
        "lost": result["lost"],
        "CPU %": 100 * result["cpu"],
    }


def main() -> None:
    parser = report.options(__doc__)
    parser.add_argument("--case", help=argparse.SUPPRESS)
    options = parser.parse_args()
    if options.case:
        method, *arguments = json.loads(options.case)
        rclpy.init()
        sys.stdout.write(json.dumps(METHODS[method](*arguments)))
        sys.stdout.flush()
        os._exit(0)
    seconds = report.scaled(options, 0.2, 2.0, 10.0)
    cases = [(1, 100.0), (13, 100.0), (50, 100.0), (1, 250.0), (1, 500.0), (1, 1000.0)]
    rows = [
        run_case(method, robots, rate, seconds)
        for robots, rate in report.some(options, cases)
        for method in METHODS
    ]
    # 10,000 frames: at 100 Hz that takes 100 s, so the quick run asks the same of 1000 Hz.
    rate = report.scaled(options, 1000.0, 1000.0, 100.0)
    frames = report.scaled(options, 99, 9999, 9999)
    rows.append(run_case("deadline thread", 1, rate, frames / rate))
    report.show("Playback punctuality", rows, options.json)


if __name__ == "__main__":
    main()
