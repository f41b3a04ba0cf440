"""How much a matrix is like joint positions: score, objections and doubts."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

from mrlab_ros.core.base.diagnostic import Diagnostic
from mrlab_ros.core.conversion.diagnostics import (
    DERIVATIVE_OF,
    FEW_ROWS_ONLY,
    HAS_DERIVATIVE,
    LIKE_POSES,
    MAY_BE_POSES,
    MAY_BE_TIME,
    SEEN,
    TOOL_OF,
    TOOL_PATH,
)
from mrlab_ros.core.conversion.evidence.assessment import Assessment, blocking_clocks
from mrlab_ros.core.conversion.evidence.labels import said_by_units
from mrlab_ros.core.conversion.evidence.names import Hint
from mrlab_ros.core.robots.model import RobotModel

NAME_SCORES = {
    Hint.POSITIONS: 0.3,
    Hint.PARTLY: 0.2,
    Hint.NEUTRAL: 0.0,
    Hint.TWO_FACED: 0.0,
    Hint.DOUBTFUL: -0.3,
    Hint.AGAINST: -0.55,
}
FEW_ROWS = 10  # fewer than this say little of how a matrix moves


def judged(a: Assessment, robot: RobotModel) -> Assessment:
    """Return the assessment with its score, its objections and its doubts."""
    if a.variable.is_message:
        return replace(a, points=1.5, reasons=(SEEN(what="message"),))
    points = 0.5
    reasons: list[Diagnostic] = []
    objections: list[Diagnostic] = []
    doubts: list[Diagnostic] = []
    hint = a.name.hint
    if a.by_name:
        points += 0.4
        reasons.append(SEEN(what="named"))
    else:
        points += NAME_SCORES[hint]
        reasons.append(a.name.why)
    if not a.finite:
        reasons.append(SEEN(what="not_finite"))
        points -= 0.0 if a.by_name or hint.of_joints else 0.3
        return replace(a, points=points, reasons=tuple(reasons))
    if a.fits:
        points += _judge_range(a, reasons)
        points += _judge_motion(a, reasons)
        objections += _objections(a)
        doubts += _doubts(a, robot)
    if a.tool_path:
        points += 0.3
        reasons.append(TOOL_PATH(other=a.tool_path))
    if a.rates and not hint.against:
        points += 0.15
        reasons.append(HAS_DERIVATIVE(other=a.rates[0][0]))
    if a.rows == a.columns:
        points -= 0.2
        reasons.append(SEEN(what="square"))
    if a.last_is_joint:
        points -= 0.1
        reasons.append(SEEN(what="last_column"))
    if a.between_zeros and hint in (Hint.NEUTRAL, Hint.TWO_FACED) and not (a.tool_path or a.rates):
        points -= 0.25
        reasons.append(SEEN(what="between_zeros"))
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


def _judge_range(a: Assessment, reasons: list[Diagnostic]) -> float:
    in_degrees = a.unit.unit == "deg" and _in_degrees(a)
    if a.by_name or a.unit.unit == "rad" or in_degrees:
        return 0.1
    reasons.append(a.unit.why or SEEN(what="limits"))
    return -0.2


def _in_degrees(a: Assessment) -> bool:
    unit = said_by_units(a.variable.units).unit
    return unit is not None and unit.name == "deg"


def _judge_motion(a: Assessment, reasons: list[Diagnostic]) -> float:
    if a.still:
        reasons.append(SEEN(what="still"))
        return -0.2
    if a.smooth is not None:
        reasons.append(SEEN(what="smooth" if a.smooth else "rough"))
        return 0.1 if a.smooth else -0.25
    if a.rows < FEW_ROWS:
        reasons.append(FEW_ROWS_ONLY(rows=a.rows))
        return -0.15
    return 0.0


def _objections(a: Assessment) -> Iterable[Diagnostic]:
    if a.velocity_of:
        order = "second" if a.is_acceleration else "first"
        yield DERIVATIVE_OF(order=order, other=a.velocity_of)
    if a.tool_of:
        yield TOOL_OF(other=a.tool_of)
    if a.poses.strong:
        yield LIKE_POSES(why=a.poses.strong)
    if not (a.low.any() or a.high.any()):
        yield SEEN(what="zeros")


def _doubts(a: Assessment, robot: RobotModel) -> Iterable[Diagnostic]:
    if a.poses.possible and a.poses.hints and not (a.tool_path or a.rates or a.by_name):
        yield MAY_BE_POSES(why=a.poses.hints)
    for clock in a.clocks:
        if not (a.by_name or clock in blocking_clocks(a, robot)):
            yield MAY_BE_TIME(column=clock.index + 1, why=clock.why)
    if a.still and (a.low.any() or a.high.any()):
        yield SEEN(what="still")
