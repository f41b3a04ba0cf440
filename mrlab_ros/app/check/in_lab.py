"""Checks a stored trajectory in the scene of a running lab, in a process that nothing waits for.

As a program it reads one pickled `Task` from its standard input and writes one JSON object. It
gives way to other processes (nice), under limits of memory and processor time, and ends with the
process that started it. `changed` says what moved in the scene since it was taken.
"""

from __future__ import annotations

import contextlib
import ctypes
import json
import math
import os
import pickle
import resource
import signal
import sys
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import numpy as np

from mrlab_ros.adapters.robots.library import RobotLibrary
from mrlab_ros.adapters.sandbox.inert_output import guard
from mrlab_ros.adapters.trajectories import npz_file
from mrlab_ros.app.check.diagnostics import (
    CHECK_OUT_OF_MEMORY,
    FOR_ANOTHER_MODEL,
    NOT_IN_LAB,
    TOO_LONG_FOR_LAB,
)
from mrlab_ros.app.check.stage import Stage, first_link
from mrlab_ros.core.base.diagnostic import Diagnostic, plain
from mrlab_ros.core.base.errors import BadInput, LabError
from mrlab_ros.core.base.geometry import Pose
from mrlab_ros.core.checking import motion
from mrlab_ros.core.checking.diagnostics import (
    APPEARED,
    DISAPPEARED,
    HELD_BY_ANOTHER,
    IN_LAB,
    MOVED,
    OTHER_MODEL,
    STANDS_ELSEWHERE,
    SURFACES_CHANGED,
    WAS_LET_GO,
)
from mrlab_ros.core.checking.rehearsal import Actor
from mrlab_ros.core.conversion.convert import ConversionResult, Outcome
from mrlab_ros.core.scene.document import SceneDocument
from mrlab_ros.core.trajectory.trajectory import Trajectory

GiB = 1 << 30
MEMORY = 4 * GiB  # of the address space, bytes
NICENESS = 10
PROCESSOR_TIME_S = 120
PR_SET_PDEATHSIG = 1
LONGEST_S = 600.0  # of a motion, s


@dataclass(frozen=True, eq=False)
class Task:
    """A request. share: the package's folder. motion: the trajectory, or its file as the store
    keeps it; trajectory: its id. robot: the robot of the scene that plays it."""

    share: Path
    motion: Path | Trajectory
    trajectory: str
    robot: str
    scene: LabScene


def check(task: Task) -> dict[str, Any]:
    """Return the report, as JSON has it; raise LabError where it cannot be checked."""
    loaded = npz_file.read(task.motion) if isinstance(task.motion, Path) else task.motion
    t = replace(loaded, id=task.trajectory)
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


# A smaller motion counts as none: m, and rad of an orientation or a joint.
SAME_PLACE, SAME_ANGLE = 0.002, 0.02


@dataclass(frozen=True, eq=False)
class LabScene:
    """A lab at one instant.

    stands: (J,) rad of each robot whose joint states are known, in its joints' order. in_tool:
    T_tool0_object of what a robot holds, by object.
    """

    document: SceneDocument
    stands: Mapping[str, tuple[float, ...]] = field(default_factory=dict)
    in_tool: Mapping[str, Pose] = field(default_factory=dict)

    @property
    def shown(self) -> Diagnostic:
        """Return what a motion goes through."""
        return IN_LAB(objects=len(self.document.objects), robots=len(self.document.robots))


def changed(before: LabScene, now: LabScene, robot: str) -> Diagnostic | None:
    """Return what differs for a motion of `robot`; None: nothing.

    Where the robot itself stands does not count: the motion begins at its first frame.
    """
    was, now_there = before.document, now.document
    robots = {r.name: r for r in was.robots}, {r.name: r for r in now_there.robots}
    objects = {o.name: o for o in was.objects}, {o.name: o for o in now_there.objects}
    for old, new in (robots, objects):
        for name in sorted(old.keys() ^ new.keys()):
            return (APPEARED if name in new else DISAPPEARED)(name=name)
    for name, one in robots[0].items():
        other = robots[1][name]
        if (one.model, one.end_effector) != (other.model, other.end_effector):
            return OTHER_MODEL(name=name)
        if not same_place(one.pose, other.pose):
            return MOVED(name=name)
        if name != robot and _moved(before.stands.get(name), now.stands.get(name)):
            return STANDS_ELSEWHERE(name=name)
    for name, thing in objects[0].items():
        found = objects[1][name]
        if (thing.type, thing.held_by) != (found.type, found.held_by):
            return (HELD_BY_ANOTHER if found.held_by else WAS_LET_GO)(name=name)
        # what is held moves with its robot
        if not thing.held_by and not same_place(thing.pose, found.pose):
            return MOVED(name=name)
    surfaces = [[(s.name, s.label, len(s.vertices)) for s in d.surfaces] for d in (was, now_there)]
    if surfaces[0] != surfaces[1] or any(
        not same_place(a.pose, b.pose)
        for a, b in zip(was.surfaces, now_there.surfaces, strict=True)
    ):
        return SURFACES_CHANGED()
    return None


def same_place(a: Pose, b: Pose) -> bool:
    """Return whether two poses are one for a check."""
    if math.dist(a.position, b.position) > SAME_PLACE:
        return False
    along = abs(sum(x * y for x, y in zip(a.orientation, b.orientation, strict=True)))
    return 2.0 * math.acos(min(along, 1.0)) <= SAME_ANGLE


def _moved(before: tuple[float, ...] | None, now: tuple[float, ...] | None) -> bool:
    if before is None or now is None:
        return False
    return len(before) != len(now) or any(
        abs(a - b) > SAME_ANGLE for a, b in zip(before, now, strict=True)
    )
