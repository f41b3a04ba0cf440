"""Brings joints to rad and m, or says which unit has to be named."""

from __future__ import annotations

from typing import Any

import numpy as np

from mrlab_ros.core.base.diagnostic import Diagnostic, Fix
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.conversion import units
from mrlab_ros.core.conversion.assessment import Assessment
from mrlab_ros.core.conversion.diagnostics import (
    ALL_JOINTS_TURN,
    BAD_OPTION,
    CONVERTED_UNIT,
    COUNTS,
    DEGREES,
    DOUBTFUL_VALUES,
    LIKE_PERCENT,
    LIKE_POSES,
    LITTLE_IN_DEGREES,
    LOOKS_LIKE,
    SMALL_FOR_DEGREES,
    UNIT_MIXED,
    UNIT_REACHES,
    UNITS_APPLIED,
    UNWRAP_APPLIED,
)
from mrlab_ros.core.conversion.explain import matlab_name
from mrlab_ros.core.conversion.options import Options, columns_text
from mrlab_ros.core.conversion.unit_names import said_by_units
from mrlab_ros.core.robots.model import RobotModel
from mrlab_ros.core.trajectory.trajectory import Array


def in_radians(
    arm: Array,
    options: Options,
    assessment: Assessment,
    robot: RobotModel,
    notes: list[Diagnostic],
) -> tuple[Array, float]:
    """Apply the options that change values; raise BadInput where a unit has to be named first."""
    path, poses = assessment.path, assessment.poses.strong
    unit, factor = options.factor()
    doubted = any(n.code == "doubtful_values" and n.variable == path for n in notes)
    if unit == "mm":
        arm = _in_metres(arm, robot, options)
        notes.append(UNITS_APPLIED(variable=path, taken="mm"))
    elif unit:
        if unit == "deg":
            few = _spanning_little(arm)
            if few:
                notes.append(_doubtful(path, LITTLE_IN_DEGREES(columns=columns_text(few))))
            elif _in_percent(arm):
                notes.append(_doubtful(path, LIKE_PERCENT()))
        if poses is not None and unit != "rad" and not doubted:
            notes.append(_doubtful(path, LIKE_POSES(why=poses)))
        if factor != 1.0:
            arm *= factor
        counts = 2 * np.pi / factor if unit == "counts" else None
        notes.append(UNITS_APPLIED(variable=path, taken=unit, counts=counts))
    elif said_by_units(assessment.variable.units).unit == "deg":
        arm, factor = np.radians(arm), float(np.radians(1))
        notes.append(_converted(arm, path))
    elif (evidence := assessment.unit).why is not None and not assessment.by_name:
        if poses is not None and evidence.unit == "counts":
            why, fix = LIKE_POSES(why=poses), Fix(matlab="save('traj.mat', 'q')")
            size = assessment.variable.size
            raise BadInput(LOOKS_LIKE(variable=path, size=size, why=why, fixes=(fix,)))
        raise BadInput(_unit_finding(arm, assessment, evidence.why, robot))
    elif assessment.by_name or assessment.variable.is_message:
        ends = (arm.min(axis=0), arm.max(axis=0))
        if units.evidence(arm, *ends, robot, "").unit == "deg":
            largest = float(np.abs(arm).max())
            raise BadInput(
                DEGREES(
                    variable=path,
                    value=largest,
                    unit="deg",
                    limit=float(np.abs(units.limits_of(robot)).max()),
                    why=UNIT_REACHES(largest=largest),
                )
            )
    if options.unwrap:
        arm = np.unwrap(arm, axis=0)
        notes.append(UNWRAP_APPLIED(variable=path))
    return arm, factor


def _spanning_little(arm: Array) -> list[int]:
    """Return columns, from 0, that move as radians do, where others move as degrees only."""
    span = np.ptp(arm, axis=0)
    largest = np.abs(arm).max(axis=0)
    if not (largest > units.LEAST_DEGREES).any():
        return []
    return [int(i) for i in np.flatnonzero((span > 0.02) & (span < 2) & (largest < 2 * np.pi))]


def _in_percent(arm: Array) -> bool:
    """Say whether several columns run from 0 to 100 and none beyond."""
    ends = (np.abs(arm.min(axis=0)) < 0.5) & (np.abs(arm.max(axis=0) - 100) < 0.5)
    return bool(ends.sum() >= 2 and arm.min() > -0.5 and arm.max() < 100.5)


def _converted(arm: Array, path: str) -> Diagnostic:
    """Return what to say of degrees, now in rad, that the file itself names so."""
    largest = float(np.degrees(np.abs(arm).max()))
    if largest > units.LEAST_DEGREES:
        return CONVERTED_UNIT(variable=path)
    return _doubtful(path, SMALL_FOR_DEGREES(largest=largest))


def _doubtful(path: str, why: Diagnostic) -> Diagnostic:
    return DOUBTFUL_VALUES(variable=path, why=[why])


def _unit_finding(
    arm: Array, assessment: Assessment, why: Diagnostic, robot: RobotModel
) -> Diagnostic:
    evidence, name = assessment.unit, matlab_name(assessment.path)
    largest = float(np.abs(arm).max())
    row = int(np.abs(arm).max(axis=1).argmax()) + 1
    words: dict[str, Any] = {
        "variable": assessment.path,
        "first_row": row,
        "last_row": row,
        "value": largest,
        "limit": float(np.abs(units.limits_of(robot)).max()),
        "robot": robot.id,
        "why": why,
    }
    few = _spanning_little(arm)
    if evidence.unit == "deg" and few:
        many = [i for i in range(arm.shape[1]) if np.abs(arm[:, i]).max() > units.LEAST_DEGREES]
        text = columns_text(many)
        words["why"] = UNIT_MIXED(columns=text, largest=largest, others=columns_text(few))
        line = f"{name}(:, {text}) = deg2rad({name}(:, {text}));"
        return DEGREES(unit="deg", fixes=(Fix(matlab=line),), **words)
    if evidence.unit == "deg":
        percent = "percent" if _in_percent(arm) else ""
        return DEGREES(unit="deg", percent=percent, **words)
    return COUNTS(counts=evidence.counts, **words)


def _in_metres(arm: Array, robot: RobotModel, options: Options) -> Array:
    """Return the prismatic joints' mm as m; raise BadInput where all joints turn."""
    moving = [s for s in robot.chain.segments if s.axis is not None] if robot.chain else []
    sliding = [i for i, segment in enumerate(moving) if segment.prismatic]
    if not sliding:
        why = ALL_JOINTS_TURN(model=robot.id)
        raise BadInput(BAD_OPTION(option="units", found=options.units, why=why))
    arm[:, sliding] *= 1e-3
    return arm
