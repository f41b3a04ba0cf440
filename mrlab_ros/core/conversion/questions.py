"""Asks about what a file states of the chosen matrix and what cannot simply be obeyed."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from mrlab_ros.core.base.diagnostic import Diagnostic, Fix, Severity
from mrlab_ros.core.conversion.diagnostics import (
    MOTOR_SIDE,
    NAMES_OTHER,
    ORDER_STATED,
    ORDER_UNCLEAR,
    ROBOT_STATED,
    UNUSED_BESIDE,
)
from mrlab_ros.core.conversion.evidence import beside, statements
from mrlab_ros.core.conversion.evidence.joining import first_path
from mrlab_ros.core.conversion.evidence.names import Name, described, leaf
from mrlab_ros.core.conversion.evidence.statements import Statement
from mrlab_ros.core.conversion.explain import saving
from mrlab_ros.core.conversion.options import Options, columns_text
from mrlab_ros.core.conversion.workspace import Variable, Workspace, shortened
from mrlab_ros.core.robots.model import RobotModel

MOST_CLAIMS = 3
# the questions whose fixes are answers of a person: what is asked about is taken all the same
ANSWERS = frozenset(("question", "ambiguous", "names_other", "robot_stated", "motor_side"))


def asked(
    workspace: Workspace, variable: Variable, name: Name, robot: RobotModel, options: Options
) -> list[Diagnostic]:
    """Return what has to be asked about a matrix before it is laid out: errors and warnings.

    A person who named the matrix has answered: then nothing of it is an error.
    """
    if variable.is_message or variable.values is None or len(variable.shape) != 2:
        return []
    said = statements.about(workspace, first_path(variable.path))
    joints = len(robot.joints)
    found = [*_robots(workspace, variable, robot), *_motors(said, variable, name, joints)]
    if not options.columns:
        found += _orders(said, variable, robot)
    vectors = beside.unused_vectors(said, joints)
    if vectors:
        unread = [w.text for v in vectors for w in described(leaf(v.path)) if w.unread]
        found.append(
            UNUSED_BESIDE(
                variable=variable.path,
                found=shortened([v.path for v in vectors]),
                count="one" if len(vectors) == 1 else "more",
                unread=shortened([f"'{word}'" for word in dict.fromkeys(unread)]),
            )
        )
    numbers = beside.factors(said)
    if numbers:
        named = shortened([v.path for v in numbers])
        found.append(UNUSED_BESIDE(variable=variable.path, found=named, count="factor", unread=[]))
    if options.variable:
        return [_answered(d) for d in found]
    return found


def _answered(found: Diagnostic) -> Diagnostic:
    if found.severity is not Severity.ERROR or found.code not in ANSWERS:
        return found
    fixes = tuple(Fix(matlab=fix.matlab) for fix in found.fixes if fix.matlab)
    return replace(found, severity=Severity.WARNING, fixes=fixes)


def _yes(variable: Variable) -> tuple[Fix, ...]:
    return (Fix("variable", variable.path, saving(variable.path)),)


def _robots(workspace: Workspace, variable: Variable, robot: RobotModel) -> list[Diagnostic]:
    found = []
    for claim in beside.robot_claims(workspace, robot)[:1]:
        severity = Severity.ERROR if claim.other_maker else Severity.WARNING
        found.append(
            ROBOT_STATED(
                severity=severity,
                variable=variable.path,
                source=claim.source,
                words=claim.text[:80],
                model=robot.id,
                fixes=_yes(variable)
                if claim.other_maker
                else (Fix(matlab=saving(variable.path)),),
            )
        )
    return found


def _motors(
    said: list[Statement], variable: Variable, name: Name, joints: int
) -> list[Diagnostic]:
    gear = beside.gears(said, joints)
    if gear is None and not name.motor:
        return []
    source = variable.path if gear is None else gear.path
    finding = MOTOR_SIDE(variable=variable.path, source=source)
    if not name.motor:
        return [finding]
    fixes = (*_yes(variable), *finding.fixes)
    return [
        MOTOR_SIDE(severity=Severity.ERROR, variable=variable.path, source=source, fixes=fixes)
    ]


def _orders(said: list[Statement], variable: Variable, robot: RobotModel) -> list[Diagnostic]:
    """Return what is said of the orders and names that the file states for the columns."""
    path, joints = variable.path, len(robot.joints)
    for claim in beside.order_vectors(said, joints)[:MOST_CLAIMS]:
        words: dict[str, Any] = {"variable": path, "source": claim.source, "words": claim.text}
        if claim.is_identity:
            continue
        if claim.is_clear:
            kept = (Fix("columns", f"1:{joints}", saving(path)),)
            return [ORDER_STATED(model=robot.id, fixes=kept, **words)]
        columns = [claim.joints.index(j) for j in range(joints)]
        fixes = tuple(
            Fix(
                "columns",
                text,
                f"q = {path}(:, {text}); {saving('q')}",
            )
            for text in map(columns_text, (columns, list(claim.joints)))
        )
        return [ORDER_UNCLEAR(joints=joints, fixes=fixes, **words)]
    if variable.columns:
        return []
    for names in beside.names_claims(said, variable.shape[1])[:MOST_CLAIMS]:
        meant = names.names[:joints]
        if beside.order_of_names(meant, robot) is None and not _numbers_alone(meant):
            return [
                NAMES_OTHER(
                    variable=path,
                    source=names.source,
                    words=" ".join(shortened(list(names.names))),
                    model=robot.id,
                    joints=list(robot.joint_names),
                    fixes=_yes(variable),
                )
            ]
    return []


def _numbers_alone(names: tuple[str, ...]) -> bool:
    return all(name.strip().isdigit() for name in names)
