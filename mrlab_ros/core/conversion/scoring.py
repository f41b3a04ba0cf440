"""How much a matrix is like joint positions: score, objections and doubts in words."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

from mrlab_ros.core.conversion.assessment import Assessment, blocking_clocks
from mrlab_ros.core.conversion.unit_names import said_by_units
from mrlab_ros.core.conversion.variable_names import Hint
from mrlab_ros.core.robots.model import RobotModel

NAME_SCORES = {
    Hint.POSITIONS: 0.3,
    Hint.NEUTRAL: 0.0,
    Hint.TWO_FACED: 0.0,
    Hint.DOUBTFUL: -0.3,
    Hint.AGAINST: -0.55,
}
FEW_ROWS = 10  # fewer than this say little of how a matrix moves


def judged(a: Assessment, robot: RobotModel) -> Assessment:
    """Return the assessment with its score, its objections and its doubts."""
    if a.variable.is_message:
        return replace(a, points=1.5, reasons=("it is a JointTrajectory for these joints",))
    points = 0.5
    reasons: list[str] = []
    objections: list[str] = []
    doubts: list[str] = []
    hint = a.name.hint
    if a.by_name:
        points += 0.4
        reasons.append("its columns are named as the joints")
    else:
        points += NAME_SCORES[hint]
        reasons.append(a.name.why)
    if not a.finite:
        reasons.append("it holds NaN or Inf")
        return replace(a, points=points, reasons=tuple(reasons))
    if a.fits:
        points += _judge_range(a, reasons)
        points += _judge_motion(a, reasons)
        objections += _objections(a)
        doubts += _doubts(a, robot)
    if a.tool_path:
        points += 0.3
        reasons.append(f"'{a.tool_path}' is the path of the tool at these positions")
    if a.rates and hint in (Hint.POSITIONS, Hint.NEUTRAL, Hint.TWO_FACED):
        points += 0.15
        reasons.append(f"'{a.rates[0][0]}' is its derivative")
    if a.rows == a.columns:
        points -= 0.2
        reasons.append("it is square")
    if a.last_is_joint:
        points -= 0.1
        reasons.append("its last column is not a gripper's")
    if a.between_zeros and hint in (Hint.NEUTRAL, Hint.TWO_FACED) and not (a.tool_path or a.rates):
        points -= 0.25
        reasons.append("it begins and ends at zero, as velocities do")
    may_be_poses = a.poses.possible and hint in (Hint.TWO_FACED, Hint.DOUBTFUL)
    if may_be_poses and a.poses.hints and not a.tool_path:
        points -= 0.25
    if any(c.likely for c in a.clocks) and not a.by_name and a.columns == len(robot.joints):
        points -= 0.3
    if objections:
        points = min(points, 0.2)
    return replace(
        a,
        points=points,
        reasons=tuple(reasons),
        objections=tuple(objections),
        doubts=tuple(doubts),
    )


def _judge_range(a: Assessment, reasons: list[str]) -> float:
    in_degrees = a.unit.unit == "deg" and said_by_units(a.variable.units).unit == "deg"
    if a.by_name or a.unit.unit == "rad" or in_degrees:
        return 0.1
    reasons.append("it leaves the joint limits" if a.unit.unit == "" else a.unit.why)
    return -0.2


def _judge_motion(a: Assessment, reasons: list[str]) -> float:
    if a.still:
        reasons.append("it never moves")
        return -0.2
    if a.smooth is not None:
        reasons.append(
            "it moves smoothly" if a.smooth else "its rows do not follow one another like a motion"
        )
        return 0.1 if a.smooth else -0.25
    if a.rows < FEW_ROWS:
        reasons.append(f"it has {a.rows} rows only")
        return -0.15
    return 0.0


def _objections(a: Assessment) -> Iterable[str]:
    if a.velocity_of:
        what = "accelerations" if a.is_acceleration else "velocities"
        yield f"it holds the {what} of '{a.velocity_of}'"
    if a.tool_of:
        yield f"its columns 1 to 3 are the positions of the tool at '{a.tool_of}'"
    if a.poses.strong:
        yield f"it looks like poses of the tool: {a.poses.strong}"
    if not (a.low.any() or a.high.any()):
        yield "all of it is 0: it was never filled"


def _doubts(a: Assessment, robot: RobotModel) -> Iterable[str]:
    if a.poses.possible and a.poses.hints and not (a.tool_path or a.rates or a.by_name):
        yield f"it may be poses of the tool in m and rad: {' and '.join(a.poses.hints)}"
    for clock in a.clocks:
        if not (a.by_name or clock in blocking_clocks(a, robot)):
            yield f"column {clock.index + 1} may be time and not a joint: {clock.why}"
    if a.still and (a.low.any() or a.high.any()):
        yield "it never moves"
