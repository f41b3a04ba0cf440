"""The motion of each run: joints, tool path, and the reference beside them."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from mrlab_ros.adapters.robots import urdf
from mrlab_ros.adapters.robots.library import TIP, joints_to
from mrlab_ros.core.base.clock import SECOND
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.base.geometry import Pose, rotate
from mrlab_ros.core.recording.report import (
    ReferenceTrajectory,
    RobotReport,
    SessionReport,
    course_of,
)
from mrlab_ros.core.recording.run_finding import time_of
from mrlab_ros.core.recording.runs import Course, Run, RunJoint
from mrlab_ros.core.robots.model import KinematicChain

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Reference:
    """A trajectory that runs are compared with. name: for a person; model: of the robot."""

    name: str
    model: str
    course: ReferenceTrajectory


@dataclass
class Samples:
    """The joint states of a robot: s of the session, stamps ns, positions in `names` order.

    received: when the recorder received each; times: when the arm stood so.
    """

    names: list[str]
    received: list[float] = field(default_factory=list)
    times: list[float] = field(default_factory=list)
    stamps: list[int] = field(default_factory=list)
    positions: list[Array] = field(default_factory=list)

    def add(self, received: float, stamp_ns: int, start_ns: int, positions: Array) -> None:
        """Take a joint state; one of other joints than the first is left out."""
        if len(positions) == len(self.names):
            before = self.times[-1] if self.times else 0.0
            self.received.append(received)
            self.times.append(time_of(received, (stamp_ns - start_ns) / SECOND, before))
            self.stamps.append(stamp_ns)
            self.positions.append(positions)


@dataclass(frozen=True)
class Arm:
    """The part of a robot's description that the report needs."""

    chain: KinematicChain
    joints: tuple[RunJoint, ...]


def arm_of(name: str, description: str) -> Arm | None:
    """Return the arm of a URDF, None where it has no tool0 or is none."""
    try:
        root = urdf.parse(description, name)
        chain, _ = urdf.chain(root, TIP, name)
        joints = joints_to(root, TIP, name)
    except BadInput:
        return None
    return Arm(
        chain,
        tuple(RunJoint(j.name, j.kind == "prismatic", j.lower, j.upper) for j in joints),
    )


def add_courses(
    report: SessionReport,
    samples: dict[str, Samples],
    descriptions: dict[str, str],
    played: dict[str, ReferenceTrajectory],
    reference: Reference | None,
) -> None:
    """Give every run its motion and how far it was from the reference.

    played: the trajectories of the bag; reference: a trajectory in place of what was played, for
    robots of its model.
    """
    arms = {name: arm_of(name, text) for name, text in descriptions.items()}
    for run in report.runs:
        recorded, arm = samples.get(run.robot), arms.get(run.robot)
        if recorded is None:
            continue
        course, name = course_of(played, run.trajectory, run.version), run.trajectory
        if reference is not None and reference.model == run.model:
            course, name = reference.course, reference.name
        robot = report.robots[run.robot]
        run.joints = arm.joints if arm else tuple(map(RunJoint, recorded.names))
        run.course = _course(robot, run, recorded, course)
        if run.course is None:
            continue
        if arm is not None:
            base = robot.base_at(run.start)
            run.course.tool = _tool(arm.chain, run.course.joints, base)
            run.course.expected_tool = _tool(arm.chain, run.course.expected, base)
        run.deviation = run.course.deviation(name, run.joints)


def _course(
    robot: RobotReport,
    run: Run,
    recorded: Samples,
    reference: ReferenceTrajectory | None,
) -> Course | None:
    """Return the joint states of a run in the order of its joints; None: there are none."""
    names = [joint.name for joint in run.joints]
    if not set(names) <= set(recorded.names):
        return None
    columns = [recorded.names.index(name) for name in names]
    times, received = np.array(recorded.times), np.array(recorded.received)
    chosen = np.flatnonzero((received >= run.start) & (received <= run.end))
    if not len(chosen):
        return None
    joints = np.array([recorded.positions[i] for i in chosen])[:, columns]
    positions = np.full(len(chosen), np.nan)
    expected = np.full(joints.shape, np.nan)
    for row, i in enumerate(chosen):
        found = robot.playing_at(recorded.stamps[i])
        if found is None:
            continue
        positions[row] = found[1]
        at = None if reference is None else reference.at(found[1])
        if at is not None and at.shape == joints[row].shape:
            expected[row] = at
    return Course(times[chosen], positions, joints, expected)


def _tool(chain: KinematicChain, joints: Array, base: Pose) -> Array:
    """Return the places of tool0 in the world, (N, 3) m; NaN where a joint is."""
    local = chain.tool0(joints)[:, :3, 3]
    axes = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))
    turned = np.array([rotate(base.orientation, axis) for axis in axes])
    found: Array = local @ turned + np.array(base.position)
    return found
