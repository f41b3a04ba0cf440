"""Brings joints to rad and m, or says which unit has to be named."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from mrlab_ros.core.base.diagnostic import Diagnostic, Fix
from mrlab_ros.core.conversion import units
from mrlab_ros.core.conversion.assessment import Assessment
from mrlab_ros.core.conversion.explain import matlab_name
from mrlab_ros.core.conversion.options import Options, columns_text
from mrlab_ros.core.conversion.unit_names import said_by_units
from mrlab_ros.core.diagnostics import Refused, finding
from mrlab_ros.core.robots.model import RobotModel
from mrlab_ros.core.trajectory.trajectory import Array


def in_radians(
    arm: Array,
    options: Options,
    assessment: Assessment,
    robot: RobotModel,
    notes: list[Diagnostic],
) -> tuple[Array, float]:
    """Apply the options that change values; raise Refused where a unit has to be named first."""
    path, name = assessment.path, matlab_name(assessment.path)
    unit, factor = options.factor()
    doubted = any(n.code == "doubtful_values" and n.variable == path for n in notes)
    if unit == "mm":
        arm = _in_metres(arm, robot, options)
        notes.append(finding("option_applied", variable=path, what=f"'{path}' was taken as mm"))
    elif unit:
        if unit == "deg":
            few = _spanning_little(arm)
            if few:
                why = f"in degrees, columns {columns_text(few)} move by less than 2 degrees each"
                why += ", and they may be radians already, while others are degrees"
                notes.append(finding("doubtful_values", variable=path, why=why))
            elif _in_percent(arm):
                why = "it runs from 0 to 100 in several columns, as percent do"
                notes.append(finding("doubtful_values", variable=path, why=why))
        if assessment.poses.strong and unit != "rad":
            why = f"it looks like poses of the tool: {assessment.poses.strong}"
            if not doubted:
                notes.append(finding("doubtful_values", variable=path, why=why))
        if factor != 1.0:
            arm *= factor
        words = {"deg": "degrees", "rad": "radians", "counts": f"{options.units} a turn"}[unit]
        what = f"'{path}' was taken as {words}"
        notes.append(finding("option_applied", variable=path, what=what))
    elif said_by_units(assessment.variable.units).unit == "deg":
        arm, factor = np.radians(arm), float(np.radians(1))
        notes.append(_converted(arm, path))
    elif assessment.unit.option and not assessment.by_name:
        if assessment.poses.strong and assessment.unit.unit == "counts":
            why = f"it looks like poses of the tool: {assessment.poses.strong}"
            fix = Fix(matlab="save('traj.mat', 'q')")
            size = assessment.variable.size
            raise Refused(finding("looks_like", variable=path, size=size, why=why, fixes=(fix,)))
        raise Refused(_unit_finding(arm, assessment, name, robot))
    elif assessment.by_name or assessment.variable.is_message:
        ends = (arm.min(axis=0), arm.max(axis=0))
        if units.evidence(arm, *ends, robot, "").unit == "deg":
            largest = float(np.abs(arm).max())
            raise Refused(
                finding(
                    "degrees",
                    variable=path,
                    name=name,
                    value=largest,
                    unit="deg",
                    limit=float(np.abs(units.limits_of(robot)).max()),
                    why=f"it reaches {largest:g}",
                    robot=robot.id,
                )
            )
    if options.unwrap:
        arm = np.unwrap(arm, axis=0)
        what = f"jumps of 2*pi in '{path}' were removed"
        notes.append(finding("option_applied", variable=path, what=what))
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
        return finding("converted_unit", variable=path)
    why = f"its unit in the file is degrees, and it reaches {largest:.3g}, as radians do too"
    return finding("doubtful_values", variable=path, why=why)


def _unit_finding(arm: Array, assessment: Assessment, name: str, robot: RobotModel) -> Diagnostic:
    evidence = assessment.unit
    row = int(np.abs(arm).max(axis=1).argmax()) + 1
    words: dict[str, Any] = {
        "variable": assessment.path,
        "name": name,
        "where": f"row {row}",
        "first_row": row,
        "last_row": row,
        "value": float(np.abs(arm).max()),
        "limit": float(np.abs(units.limits_of(robot)).max()),
        "robot": robot.id,
        "why": evidence.why,
    }
    few = _spanning_little(arm)
    if evidence.unit == "deg" and few:
        many = [i for i in range(arm.shape[1]) if np.abs(arm[:, i]).max() > units.LEAST_DEGREES]
        text = columns_text(many)
        words["why"] = f"columns {text} reach up to {words['value']:g}, as degrees do"
        words["why"] += f", but columns {columns_text(few)} move as radians do"
        line = f"{name}(:, {text}) = deg2rad({name}(:, {text}));"
        found = finding("degrees", unit="deg", fixes=(Fix(matlab=line),), **words)
        return replace(
            found,
            remedy=f"Convert the columns that are degrees, in MATLAB {line} Only if all of them "
            "are degrees: --units deg.",
        )
    if evidence.unit == "deg" and _in_percent(arm):
        words["why"] += " (or in percent, as several columns run from 0 to 100)"
    if evidence.unit == "deg":
        return finding("degrees", unit="deg", **words)
    per_turn = evidence.option.removeprefix("counts:")
    line = f"{name} = {name} * 2*pi / {per_turn};"
    fixes = (Fix("units", evidence.option, line),)
    return finding("counts", counts=per_turn, fixes=fixes, **words)


def _in_metres(arm: Array, robot: RobotModel, options: Options) -> Array:
    """Return the prismatic joints' mm as m; raise Refused where all joints turn."""
    moving = [s for s in robot.chain.segments if s.axis is not None] if robot.chain else []
    sliding = [i for i, segment in enumerate(moving) if segment.prismatic]
    if not sliding:
        problem = f"all joints of {robot.id} turn: they take rad, deg or counts:N"
        raise Refused(finding("bad_option", option="units", found=options.units, problem=problem))
    arm[:, sliding] *= 1e-3
    return arm
