"""Checks a stored trajectory in the scene of a running lab, in a process that nothing waits for.

As a program it reads one pickled `Task` from its standard input and writes one JSON object. It
gives way to other processes (nice), under limits of memory and processor time, and ends with the
process that started it.
"""

from __future__ import annotations

import contextlib
import ctypes
import json
import os
import pickle
import resource
import signal
import sys
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from mrlab_ros.adapters.checking.diagnostics import (
    CHECK_OUT_OF_MEMORY,
    FOR_ANOTHER_MODEL,
    NOT_IN_LAB,
    TOO_LONG_FOR_LAB,
)
from mrlab_ros.adapters.checking.stage import Stage, first_link
from mrlab_ros.adapters.guarded_streams import guard
from mrlab_ros.adapters.robots.library import RobotLibrary
from mrlab_ros.adapters.trajectories import npz_file
from mrlab_ros.core.base.diagnostic import plain
from mrlab_ros.core.base.errors import BadInput, LabError
from mrlab_ros.core.checking import motion
from mrlab_ros.core.checking.lab_scene import LabScene
from mrlab_ros.core.checking.rehearsal import Actor
from mrlab_ros.core.conversion.convert import ConversionResult, Outcome

GiB = 1 << 30
MEMORY = 4 * GiB  # of the address space, bytes
NICENESS = 10
PROCESSOR_TIME_S = 120
PR_SET_PDEATHSIG = 1
LONGEST_S = 600.0  # of a motion, s


@dataclass(frozen=True, eq=False)
class Task:
    """What is checked. share: the package's folder. file: the trajectory, as the store keeps it;
    trajectory: its id. robot: the robot of the scene that plays it."""

    share: Path
    file: Path
    trajectory: str
    robot: str
    scene: LabScene


def check(task: Task) -> dict[str, Any]:
    """Return the report, as JSON has it; raise LabError where it cannot be checked."""
    t = replace(npz_file.read(task.file), id=task.trajectory)
    if t.duration > LONGEST_S:
        raise BadInput(TOO_LONG_FOR_LAB(trajectory=t.id, duration=t.duration, most=LONGEST_S))
    document = task.scene.document
    own = [r for r in document.robots if r.name == task.robot]
    if not own:
        raise BadInput(NOT_IN_LAB(robot=task.robot, robots=[r.name for r in document.robots]))
    stage = Stage(task.share, RobotLibrary(task.share / "robots"))
    entries = (own[0], *(r for r in document.robots if r.name != task.robot))
    robots = [stage.robot(e.name, e.model, e.end_effector, e.pose) for e in entries]
    checked = robots[0]
    if t.robot_model != checked.model.id:
        model = checked.model.id
        raise BadInput(
            FOR_ANOTHER_MODEL(trajectory=t.id, found=t.robot_model, robot=task.robot, model=model)
        )
    actors = [
        Actor(
            r.name,
            # where nothing says how a robot stands, it stands at home
            np.array(task.scene.stands.get(r.name, r.model.home)),
            t if r is checked else None,
            first_link=first_link(r),
        )
        for r in robots
    ]
    played = stage.rehearse(robots, actors, document, drawn=False, in_tool=task.scene.in_tool)
    report = motion.report_of(
        ConversionResult(t.source.file, Outcome.ACCEPTED, t, (), ()),
        checked,
        motion.figures_of(t, checked),
        played.recorded,
        inputs=stage.inputs(robots, document),
        scene=task.scene.shown,
        graspable=played.graspable,
    )
    return report.document()


def confine() -> None:
    """Let others run first, and end with the process that started this one."""
    with contextlib.suppress(OSError, AttributeError):
        ctypes.CDLL(None).prctl(PR_SET_PDEATHSIG, signal.SIGKILL)
    # Not the least: on a machine that draws pages in software it would never end.
    os.nice(NICENESS)
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
    resource.setrlimit(resource.RLIMIT_CPU, (PROCESSOR_TIME_S, PROCESSOR_TIME_S))


def main() -> None:
    """Check what the standard input says; write {"report": ...} or {"problem": a diagnostic}."""
    guard()
    confine()
    # pybullet prints its build time
    answer = os.fdopen(os.dup(1), "w")
    os.dup2(2, 1)
    try:
        told: dict[str, Any] = {
            "report": check(pickle.load(sys.stdin.buffer))
        }  # from the gateway itself
    except LabError as error:
        told = {"problem": plain(error)}
    except MemoryError:
        told = {"problem": plain(CHECK_OUT_OF_MEMORY(most=MEMORY))}
    with answer:
        json.dump(told, answer)


if __name__ == "__main__":
    main()
