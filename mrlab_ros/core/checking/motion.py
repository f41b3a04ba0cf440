"""The check of one motion: what the converter found, its figures, and what physics recorded."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, replace
from typing import Any

import numpy as np

from mrlab_ros.core.base.diagnostic import Diagnostic, Severity
from mrlab_ros.core.base.geometry import Array, Pose, Vector, rotate
from mrlab_ros.core.checking import evidence, joint_limits, tool, waypoints
from mrlab_ros.core.checking.diagnostics import BARE_FLANGE
from mrlab_ros.core.checking.evidence import CLOSE, NO_ADVICE, Advice
from mrlab_ros.core.checking.joint_limits import JointFigures, StatedLimits, spectral_arc_length
from mrlab_ros.core.checking.rehearsal_record import Rehearsed
from mrlab_ros.core.checking.report import (
    RANGES,
    SPEEDS,
    CheckReport,
    RobotReport,
    conditions,
    in_order,
)
from mrlab_ros.core.checking.tool import Dexterity
from mrlab_ros.core.conversion.convert import ConversionResult
from mrlab_ros.core.physics.grasp.states import Grasp
from mrlab_ros.core.robots.model import RobotModel
from mrlab_ros.core.trajectory.trajectory import Trajectory

# A tool that moves slower, m/s, stands; the cycle is from its first motion to its last, of the
# arm's joints (rad/s) too.
STANDS = 1e-4


@dataclass(frozen=True, eq=False)
class CheckedRobot:
    """A robot that is checked. pose: T_world_base. stated: by joint, what its vendor states."""

    name: str
    model: RobotModel
    end_effector: str
    pose: Pose
    stated: Mapping[str, StatedLimits]


@dataclass(frozen=True, eq=False)
class MotionFigures:
    """Figures of a motion. tool: (N, 3) m of tool0 in world at times (N,) s; speeds: (N,)
    m/s of it."""

    joints: tuple[JointFigures, ...]
    dexterity: Dexterity
    times: Array
    tool: Array
    speeds: Array
    smoothness: float | None
    cycle: float
    farthest: float

    def plain(self) -> dict[str, Any]:
        """Return the figures by name, SI, for JSON."""
        least = int(self.dexterity.conditioning.argmin())
        return {
            "duration": float(self.times[-1]),
            "cycle_time": self.cycle,
            "path_length": float(np.linalg.norm(np.diff(self.tool, axis=0), axis=1).sum()),
            "tool_speed": float(self.speeds.max()),
            "farthest_from_axis_1": self.farthest,
            "smoothness_sparc": self.smoothness,
            "least_conditioning": float(self.dexterity.conditioning[least]),
            "least_conditioning_time": float(self.dexterity.times[least]),
        }


def figures_of(trajectory: Trajectory, robot: CheckedRobot) -> MotionFigures:
    """Return what a trajectory is on a robot."""
    chain, rate = robot.model.chain, trajectory.frame_rate
    positions = trajectory.positions
    times = np.arange(len(positions)) / rate
    local = chain.tool0(positions)[:, :3, 3]
    speeds = np.linalg.norm(np.gradient(local, 1.0 / rate, axis=0), axis=1)
    moving = np.abs(np.diff(positions, axis=0)).max(axis=1) * rate > STANDS
    frames = np.flatnonzero(moving)
    return MotionFigures(
        joint_limits.figures_of(positions, rate, robot.model.joints, robot.stated),
        tool.dexterity_of(chain, positions, rate, robot.model.reach),
        times,
        in_world(local, robot.pose),
        speeds,
        spectral_arc_length(speeds, rate),
        float(frames[-1] + 1 - frames[0]) / rate if len(frames) else 0.0,
        float(np.hypot(local[:, 0], local[:, 1]).max()),
    )


def in_world(points: Array, pose: Pose) -> Array:
    """Return points, (N, 3) m in a robot's base, in the frame world."""
    axes = [rotate(pose.orientation, axis) for axis in ((1, 0, 0), (0, 1, 0), (0, 0, 1))]
    moved: Array = points @ np.array(axes) + np.array(pose.position)
    return moved


def motion_findings(figures: MotionFigures, robot: str) -> list[Diagnostic]:
    """Return what the figures of a motion say."""
    return [
        *joint_limits.findings_of(figures.joints, robot, float(figures.times[-1])),
        *tool.findings_of(figures.dexterity, robot),
    ]


def physics_findings(
    recorded: Rehearsed,
    graspable: Sequence[str],
    closest: float = CLOSE,
    advice: Advice = NO_ADVICE,
) -> list[Diagnostic]:
    """Return what a rehearsal says. graspable: the objects that can be held. advice: how a
    conflict of two robots is resolved."""
    return [
        *evidence.of_collisions(recorded, advice),
        *evidence.of_distances(recorded, closest, advice),
        *evidence.of_grasps(recorded, graspable),
    ]


def _bare_flange(t: Trajectory | None, recorded: Rehearsed, robot: str) -> list[Diagnostic]:
    """Return a finding where a motion closes a gripper and the robot has none to announce it."""
    if t is None or t.gripper is None or not t.gripper.any():
        return []
    if any(c.robot == robot and c.state is not Grasp.OPEN for c in recorded.grasps):
        return []
    return [BARE_FLANGE(robot=robot, time=float(t.gripper.argmax()) / t.frame_rate)]


def converted_findings(result: ConversionResult, robot: str) -> list[Diagnostic]:
    """Return what the conversion found, without its notes."""
    t = result.trajectory
    found = t.warnings if t is not None and not result.diagnostics else result.diagnostics
    rate = t.frame_rate if t is not None else None
    return [_of_motion(d, robot, rate) for d in found if d.severity > 0]


def _of_motion(found: Diagnostic, robot: str, frame_rate: float | None) -> Diagnostic:
    """Return what the conversion found as a finding of the check.

    frame_rate: Hz of the motion, None where it is not known. A joint that moves faster than it can
    is a warning to the converter, since the lab can play it; no controller can.
    """
    values: dict[str, Any] = {"robot": robot}
    if found.first_row and frame_rate:
        values["time"] = (found.first_row - 1) / frame_rate
        values["end"] = (max(found.last_row, found.first_row) - 1) / frame_rate
    severity = Severity.ERROR if found.code in SPEEDS else found.severity
    return replace(found.with_values(**values), severity=severity)


def _said(found: Diagnostic) -> str | frozenset[str]:
    """Return what a finding says: the converter and the check have codes of their own for it."""
    return next((codes for codes in (RANGES, SPEEDS) if found.code in codes), found.code)


def joint_rows(figures: Sequence[JointFigures]) -> list[dict[str, Any]]:
    """Return the figures of the joints for JSON: numbers, and limits where there are."""
    rows = []
    for one in figures:
        row = {k: v for k, v in vars(one).items() if k not in ("joint", "stated")}
        limits = {
            "range": [one.joint.lower, one.joint.upper],
            "speed_limit": one.joint.max_velocity,
            **{f"{k}_limit": v for k, v in asdict(one.stated).items()},
        }
        rows.append({"name": one.joint.name, **row, **limits})
    return rows


def report_of(
    result: ConversionResult,
    robot: CheckedRobot,
    figures: MotionFigures | None,
    recorded: Rehearsed | None,
    *,
    inputs: Mapping[str, Any],
    scene: Diagnostic,
    graspable: Sequence[str] = (),
    points: Sequence[Vector] = (),
    within: float = 0.005,
    closest: float = CLOSE,
) -> CheckReport:
    """Return the report on a converted file.

    figures, recorded: None where the file was refused, or nothing was rehearsed. scene: what the
    motion went through. points: m in world, that tool0 shall pass within `within` m.
    """
    name, t = robot.name, result.trajectory
    found = converted_findings(result, name)
    passed: list[waypoints.Passed] = []
    if figures is not None:
        # The converter's finding of a joint that is too fast or too far has a remedy in the file.
        known = {(_said(f), f.joint) for f in found}
        found += [f for f in motion_findings(figures, name) if (_said(f), f.joint) not in known]
        if points:
            passed = waypoints.passed(figures.tool, figures.times, points, within)
            found += waypoints.findings_of(passed, within, name)
    if recorded is not None:
        found += physics_findings(recorded, graspable, closest)
        found += _bare_flange(t, recorded, name)
    findings = in_order(found)
    rows = figures.joints if figures is not None else ()
    return CheckReport(
        title=result.file,
        inputs=inputs,
        robots=(
            RobotReport(
                name,
                robot.model.id,
                robot.end_effector,
                t.id if t is not None else "",
                vars(t.source) if t is not None else {"file": result.file},
                figures.plain() if figures is not None else {},
                joint_rows(rows),
                conditions(rows, findings, rehearsed=recorded is not None, scene=scene),
            ),
        ),
        findings=findings,
        duration=float(figures.times[-1]) if figures is not None else None,
        clearances=evidence.clearances(recorded) if recorded is not None else (),
        grasps=tuple(recorded.grasps) if recorded is not None else (),
        points=passed,
    )
