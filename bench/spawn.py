"""How long a robot takes from the order to spawn it until the lab has it.

A real lab with physics. For each model: until the order is answered, until the first joint
state, and until physics offers its topics: then its hulls are in the world. Mark: 1 s each. What a
page then draws is in `bench/room.mjs`.
"""

from __future__ import annotations

import threading
import time
from pathlib import Path
from typing import Any

import report
from sensor_msgs.msg import JointState

from mrlab_ros import Lab
from mrlab_ros.adapters.robots.library import RobotLibrary
from mrlab_ros.processes.lab import lab_processes, parameter_file
from mrlab_ros.processes.options import LabOptions, new_lab_id
from mrlab_ros.processes.supervisor import Supervisor
from mrlab_ros.ros import share
from mrlab_ros.ros.calls import NoAnswer
from mrlab_ros.ros.graph_node import Graph

# A lab that takes longer is broken, s.
LONGEST_S = 60.0


def opened() -> Lab:
    """Return the lab once it answers."""
    began = time.monotonic()
    while True:
        try:
            return Lab()
        except NoAnswer:
            if time.monotonic() - began > LONGEST_S:
                raise


def once(lab: Lab, model: str) -> dict[str, float]:
    """Spawn a robot and remove it again; return how long each step took, s."""
    name = f"{model}_bench"
    graph = lab.graph
    assert isinstance(graph, Graph)
    moved = threading.Event()
    reached: dict[str, float] = {}

    def heard(message: JointState) -> None:
        reached.setdefault("joint state", time.monotonic())
        moved.set()

    lab.watch(JointState, f"/{name}/joint_states", heard)
    began = time.monotonic()
    robot = lab.spawn(model, name=name)
    reached["answer"] = time.monotonic()
    # Physics offers this once the robot's hulls are in its world.
    while not graph.node.count_publishers(f"/{name}/collision"):
        assert time.monotonic() - began < LONGEST_S
        time.sleep(0.002)
    reached["physics"] = time.monotonic()
    assert moved.wait(LONGEST_S)
    robot.remove()
    return {step: at - began for step, at in reached.items()}


def run(folder: Path, rounds: float) -> list[dict[str, Any]]:
    options = LabOptions(parameter_file(None), folder, (), lab_id=new_lab_id())
    rows = []
    with (
        Supervisor(
            [process.spec(options) for process in lab_processes(options)], lambda name, line: None
        ),
        opened() as lab,
    ):
        models = RobotLibrary(share.directory() / "robots").ids()
        for model in models if rounds else models[:1]:
            took = [once(lab, model) for _ in range(round(rounds) or 1)]
            rows.append(
                {"model": model, "rounds": rounds}
                | {
                    f"{step}, max s": max(each[step] for each in took)
                    for step in ("answer", "joint state", "physics")
                }
            )
    return rows


if __name__ == "__main__":
    report.whole_lab(__doc__, "From the order to a robot in the lab", run, 1, 3)
