"""Brings joints to rad and m, or says which unit has to be named."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from mrlab_ros.core.base.diagnostic import Diagnostic, Fix
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.conversion.candidates import matlab_name
from mrlab_ros.core.conversion.diagnostics import (
    ALL_JOINTS_TURN,
    BAD_OPTION,
    CONVERTED_UNIT,
    COUNTS,
    COUNTS_STATED,
    DEGREES,
    DOUBTFUL_VALUES,
    LIKE_PERCENT,
    LIKE_POSES,
    LITTLE_IN_DEGREES,
    LOOKS_LIKE,
    MOTOR_SIDE,
    SCALE_BESIDE,
    SMALL_FOR_DEGREES,
    UNIT_CONFLICT,
    UNIT_MIXED,
    UNIT_OF_NAME,
    UNIT_REACHES,
    UNIT_STATED,
    UNIT_UNREAD,
    UNITS_APPLIED,
    UNITS_DIFFER,
    UNWRAP_APPLIED,
)
from mrlab_ros.core.conversion.evidence import statements
from mrlab_ros.core.conversion.evidence import unit_range as units
from mrlab_ros.core.conversion.evidence import units as spellings
from mrlab_ros.core.conversion.evidence.assessment import Assessment
from mrlab_ros.core.conversion.evidence.headings import BRACKETS, said_by_units, units_of
from mrlab_ros.core.conversion.evidence.joining import first_path
from mrlab_ros.core.conversion.evidence.statements import Statement, UnitClaim
from mrlab_ros.core.conversion.options import UNITS, Options, columns_text
from mrlab_ros.core.conversion.workspace import Variable
from mrlab_ros.core.robots.model import RobotModel
from mrlab_ros.core.trajectory.trajectory import Array

# rad; what a factor of the file makes of a motion is meant from so much on
LEAST_SCALED = 0.02


def in_radians(
    arm: Array,
    options: Options,
    assessment: Assessment,
    robot: RobotModel,
    said: list[Statement],
    notes: list[Diagnostic],
    columns: Sequence[int],
) -> tuple[Array, float | Array]:
    """Bring joints to rad and m; raise BadInput where a unit has to be named first.

    said: what the file states beside the matrix. columns: those of the matrix, from 0, that the
    joints are.
    """
    path = assessment.path
    unit, factor = options.factor()
    if unit == "mm":
        arm = _in_metres(arm, robot, options)
        notes.append(UNITS_APPLIED(variable=path, taken="mm"))
    elif unit:
        notes += _as_asked(arm, unit, factor, assessment, notes)
        notes += _stated_otherwise(unit, assessment, said)
        arm *= factor
    elif (each := _factor_of_each(assessment.variable, columns, notes)) is not None:
        return arm * each, each
    else:
        factor = _stated_factor(assessment, said, notes) or 1.0
        if factor != 1.0:
            arm *= factor
            notes += _converted(arm, assessment, said, factor)
        else:
            _refuse_other_units(arm, assessment, robot, said, notes)
    if options.unwrap:
        arm = np.unwrap(arm, axis=0)
        notes.append(UNWRAP_APPLIED(variable=path))
    return arm, factor


def _as_asked(
    arm: Array, unit: str, factor: float, assessment: Assessment, notes: list[Diagnostic]
) -> list[Diagnostic]:
    """Return what is said of values, still in their unit, that a person named."""
    path, poses = assessment.path, assessment.poses.strong
    found = []
    if unit == "deg":
        few = _spanning_little(arm)
        if few:
            found.append(_doubtful(path, LITTLE_IN_DEGREES(columns=columns_text(few))))
        elif _in_percent(arm):
            found.append(_doubtful(path, LIKE_PERCENT()))
    doubted = any(n.code == "doubtful_values" and n.variable == path for n in notes)
    if poses is not None and unit != "rad" and not doubted:
        found.append(_doubtful(path, LIKE_POSES(why=poses)))
    counts = 2 * np.pi / factor if unit == "counts" else None
    return [*found, UNITS_APPLIED(variable=path, taken=unit, counts=counts)]


def _stated_otherwise(
    unit: str, assessment: Assessment, said: list[Statement]
) -> list[Diagnostic]:
    """Return the warning of a unit that a person named and the file contradicts."""
    others = [c for c in unit_claims(assessment, said) if c.unit.name != unit]
    return [
        _doubtful(assessment.path, UNIT_STATED(source=c.source, stated=c.unit.name))
        for c in others[:1]
    ]


def _factor_of_each(
    variable: Variable, columns: Sequence[int], notes: list[Diagnostic]
) -> Array | None:
    """Return the factors to rad of columns whose headings give different units, else None.

    Raises BadInput where one of them has no unit, or one without a factor.
    """
    given = units_of(variable, columns)
    stated = list(dict.fromkeys(u for u in given if u is not None))
    if len(stated) < 2:
        return None
    first, second = stated[:2]
    listed = [columns_text([c for c, u in zip(columns, given, strict=True) if u == s])
              for s in (first, second)]  # fmt: skip
    values: dict[str, Any] = {"variable": variable.path, "columns": listed[0], "others": listed[1]}
    values |= {"stated": first.name, "second": second.name}
    factors = np.array([u.factor if u is not None else 0.0 for u in given])
    if not factors.all():
        path = variable.path
        values = {"source": path, "other": path, "stated": first.name, "second": second.name}
        raise BadInput(UNIT_CONFLICT(variable=path, **values))
    notes.append(UNITS_DIFFER(**values))
    return factors


def unit_claims(assessment: Assessment, said: list[Statement]) -> list[UnitClaim]:
    """Return the units that the file states for a matrix: columns, texts beside it, its name."""
    path, name = assessment.path, assessment.name.unit
    of_columns = said_by_units(assessment.variable.units).unit
    claims = statements.unit_claims(said, first_path(path))
    if of_columns is not None and of_columns not in {c.unit for c in claims}:
        claims.insert(0, UnitClaim(of_columns, path, of_columns.name))
    if name is not None and name not in {c.unit for c in claims}:
        claims.append(UnitClaim(name, path, name.name))
    return claims


def _stated_factor(
    assessment: Assessment, said: list[Statement], notes: list[Diagnostic]
) -> float | None:
    """Return the factor to rad of the unit that the file states, None where it states none.

    Raises BadInput where two are stated, and where the name of the matrix alone says one.
    """
    path = assessment.path
    claims = unit_claims(assessment, said)
    if not claims:
        unread = statements.unread_units(said, first_path(path))
        found = [(s.path, s.text) for s in unread] + _unread_in_headings(assessment)
        notes += [UNIT_UNREAD(variable=path, source=s, words=text) for s, text in found[:1]]
        return None
    first, *others = claims
    if others:
        second = others[0]
        raise BadInput(
            UNIT_CONFLICT(
                variable=path,
                source=first.source,
                stated=first.unit.name,
                other=second.source,
                second=second.unit.name,
            )
        )
    if not first.unit.factor or not first.unit.is_angle:
        counts = statements.counts_a_turn(said) if first.unit.name == "counts" else None
        if counts is None:
            raise BadInput(
                COUNTS_STATED(variable=path, source=first.source, stated=first.unit.name)
            )
        return float(2 * np.pi / counts)
    by_name = first.source == path and said_by_units(assessment.variable.units).unit is None
    if by_name and first.unit.factor != 1.0 and first.unit != spellings.DEGREES:
        refused = UNIT_OF_NAME(variable=path, stated=first.unit.name)
        if assessment.name.unread:
            # q_div_pi and q_mod_pi are not in half turns
            refused = replace(refused, fixes=(Fix(matlab=f"plot({matlab_name(path)})"),))
        raise BadInput(refused)
    return first.unit.factor


def _unread_in_headings(assessment: Assessment) -> list[tuple[str, str]]:
    """Return the headings of a matrix with a unit in brackets that is none of angles."""
    found = []
    for heading in assessment.variable.columns:
        match = BRACKETS.search(heading)
        if match and match.start() and not match[1].isdigit():
            found.append((heading, match[1]))
    found += [(assessment.path, text) for text in assessment.variable.units if text.strip()]
    return [(source, text) for source, text in found if not _may_be_of_joints(text)]


def _may_be_of_joints(text: str) -> bool:
    unit = spellings.parse(text)
    return unit is not None and (unit.is_angle or unit.quantity in ("none", spellings.TIMES))


def _refuse_other_units(
    arm: Array,
    assessment: Assessment,
    robot: RobotModel,
    said: list[Statement],
    notes: list[Diagnostic],
) -> None:
    """Raise BadInput where the values are no radians of the robot, by their range."""
    evidence, path = assessment.unit, assessment.path
    if assessment.by_name or assessment.variable.is_message:
        ends = (arm.min(axis=0), arm.max(axis=0))
        if units.evidence(arm, *ends, robot, "").unit == "deg":
            largest = float(np.abs(arm).max())
            raise BadInput(
                DEGREES(
                    variable=path,
                    value=largest,
                    unit="deg",
                    limit=float(np.degrees(np.abs(units.limits_of(robot)).max())),
                    why=UNIT_REACHES(largest=largest),
                )
            )
    elif evidence.why is not None:
        if assessment.poses.strong is not None and evidence.unit == "counts":
            why = LIKE_POSES(why=assessment.poses.strong)
            size, fix = assessment.variable.size, Fix(matlab="save('traj.mat', 'q', '-v7')")
            raise BadInput(LOOKS_LIKE(variable=path, size=size, why=why, fixes=(fix,)))
        scaled = _scaled(arm, path, said, robot)
        if scaled is not None:
            raise BadInput(scaled)
        found = _unit_finding(arm, assessment, evidence.why, robot)
        raise BadInput(_as_stated(found, evidence.unit, said, notes, len(robot.joints)))


def _scaled(arm: Array, path: str, said: list[Statement], robot: RobotModel) -> Diagnostic | None:
    """Return the finding of values that a factor beside them brings within the limits."""
    for source, factor in statements.factors(said):
        low, high = sorted((factor * arm.min(axis=0), factor * arm.max(axis=0)), key=np.sum)
        reach = max(-float(low.min()), float(high.max()))
        if factor <= 0 or reach < LEAST_SCALED:
            continue
        if units.inside(low, high, units.limits_of(robot)):
            line = f"q = {matlab_name(path)} * {source};"
            named = f"counts:{2 * np.pi / factor!r}" if factor < 1 else ""
            unit = next((u for u in UNITS if _is_factor(u, factor)), named)
            fixes = (Fix("units", unit, line),) if unit else (Fix(matlab=line),)
            return SCALE_BESIDE(
                variable=path, value=reach / factor, source=source, factor=factor,
                model=robot.id, fixes=fixes,
            )  # fmt: skip
    return None


def _is_factor(unit: str, factor: float) -> bool:
    parsed = spellings.parse(unit)
    return parsed is not None and parsed.is_angle and abs(parsed.factor - factor) < 1e-6 * factor


def _as_stated(
    found: Diagnostic, unit: str, said: list[Statement], notes: list[Diagnostic], joints: int
) -> Diagnostic:
    """Return the finding of a unit with the advice that goes with what the file states.

    Angles of motors are divided by their gears first, and a unit that was not understood is
    advised only where its own words name it.
    """
    codes = {n.code: n for n in notes}
    name = matlab_name(found.variable)
    if MOTOR_SIDE.code in codes:
        gear = statements.gears(said, joints)
        line = f"plot({name})" if gear is None else f"q = {name} ./ {gear.path}(:).';"
        return replace(found, fixes=(Fix(matlab=line),))
    unread = codes.get(UNIT_UNREAD.code)
    if unread is not None:
        parts = re.split(r"[\s/,;:()\[\]]+", str(unread.values["words"]))
        if not any(stated and stated.name == unit for stated in map(spellings.parse, parts)):
            return replace(found, fixes=tuple(Fix(matlab=fix.matlab) for fix in found.fixes))
    return found


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


def _converted(
    arm: Array, assessment: Assessment, said: list[Statement], factor: float
) -> list[Diagnostic]:
    """Return what to say of values, now in rad, whose unit the file itself names."""
    path = assessment.path
    claim = unit_claims(assessment, said)[0]
    source = claim.source if claim.source != path else None
    found = [CONVERTED_UNIT(variable=path, stated=claim.unit.name, source=source)]
    few = _spanning_little(arm / factor) if claim.unit == spellings.DEGREES else []
    if few:
        found.append(_doubtful(path, LITTLE_IN_DEGREES(columns=columns_text(few))))
    largest = float(np.abs(arm).max()) / factor
    if largest <= units.LEAST_DEGREES and claim.unit.name != "turn":
        found.append(_doubtful(path, SMALL_FOR_DEGREES(largest=largest, stated=claim.unit.name)))
    return found


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
    if evidence.unit == "deg":
        # as the value is: in the unit that it seems to have
        words["limit"] = math.degrees(words["limit"])
    if evidence.unit == "deg" and few:
        many = [i for i in range(arm.shape[1]) if np.abs(arm[:, i]).max() > units.LEAST_DEGREES]
        text = columns_text(many)
        words["why"] = UNIT_MIXED(columns=text, largest=largest, others=columns_text(few))
        line = f"{name}(:, {text}) = deg2rad({name}(:, {text}));"
        return DEGREES(unit="deg", fixes=(Fix(matlab=line),), **words)
    if evidence.unit == "deg":
        percent = "percent" if _in_percent(arm) else ""
        return DEGREES(unit="deg", percent=percent, **words)
    found = COUNTS(counts=evidence.counts, **words)
    if evidence.alone:
        return found
    # a scale that fits several units is no advice
    return replace(found, fixes=(Fix(matlab=f"plot({name})"),))


def _in_metres(arm: Array, robot: RobotModel, options: Options) -> Array:
    """Return the prismatic joints' mm as m; raise BadInput where all joints turn."""
    moving = [s for s in robot.chain.segments if s.axis is not None] if robot.chain else []
    sliding = [i for i, segment in enumerate(moving) if segment.prismatic]
    if not sliding:
        why = ALL_JOINTS_TURN(model=robot.id)
        raise BadInput(BAD_OPTION(option="units", found=options.units, why=why))
    arm[:, sliding] *= 1e-3
    return arm
