"""What a file states beside a matrix: its unit, its label, the joints of its columns."""

from __future__ import annotations

import re
from collections import Counter
from dataclasses import replace

from mrlab_ros.core.conversion.evidence import joining, statements, units
from mrlab_ros.core.conversion.evidence.beside import (
    NamesClaim,
    names_claims,
    order_of_names,
    order_vectors,
)
from mrlab_ros.core.conversion.evidence.headings import MOST_HEADINGS, plain
from mrlab_ros.core.conversion.evidence.names import Hint, describe
from mrlab_ros.core.conversion.evidence.time_vectors import is_time_name
from mrlab_ros.core.conversion.named_columns import GRIPPER, names_joints
from mrlab_ros.core.conversion.workspace import Variable, Workspace
from mrlab_ros.core.robots.model import RobotModel

SIGNALS = re.compile(r"(?P<block>.+)\.signals(?:\(\d+\))?\.values$")
NUMBERED = re.compile(r"(?P<before>\D*)(?P<number>\d+)(?P<after>\D*)$")
DEFAULT_BLOCK = re.compile(r"(to ?workspace|to ?file|scope|out)\s*\d*$", re.IGNORECASE)
UNLIKELY = (Hint.AGAINST, Hint.DOUBTFUL)
MOST_SOURCES = 64  # pieces of a joined matrix whose labels are compared


def with_headings(workspace: Workspace, robot: RobotModel) -> Workspace:
    """Return the workspace with the headings of its tables as joints where they name joints.

    Headings such as position.elbow_joint, or q1, q3, q2, put the columns in another order than
    the robot's. Headings that name other quantities, such as velocity.elbow_joint, stay.
    """
    variables = tuple(
        _with_unit(_named_as_joints(v, v.columns, robot), robot)
        if v.columns and v.values is not None
        else v
        for v in workspace.variables
    )
    return replace(workspace, variables=variables)


def _with_unit(table: Variable, robot: RobotModel) -> Variable:
    """Return a table with degrees as its unit where the headings of all its joints say so."""
    headings = [h for h in table.columns if not is_time_name(plain(h)[0])]
    given = [unit for h in headings if (unit := plain(h)[1]) is not None]
    if table.units or len(given) < len(robot.joints) or len(headings) - len(given) > 1:
        return table
    return replace(table, units=(given[0].name,)) if len(set(given)) == 1 else table


def with_statements(workspace: Workspace, robot: RobotModel, join: str = "") -> Workspace:
    """Return the workspace with the units, labels and joints that stand beside its matrices.

    Units: a text called unit or Einheit beside the matrix. Labels: label or blockName of a
    structure of Simulink. Joints: a list of names beside the matrix. join: the option of that
    name, whose pieces may have labels.
    """
    texts = {v.path: v.text for v in workspace.variables if v.text}
    variables = tuple(
        _stated(v, workspace, texts, robot, join)
        if v.values is not None and len(v.shape) == 2 and min(v.shape) > 1 and not v.is_message
        else v
        for v in workspace.variables
    )
    return replace(workspace, variables=variables)


def _stated(
    v: Variable, workspace: Workspace, texts: dict[str, str], robot: RobotModel, join: str
) -> Variable:
    sources = joining.sources(v.path, join)[:MOST_SOURCES]
    labels = [_label(path, texts) for path in sources]
    if labels[0] and not v.label:
        v = replace(v, label=labels[0])
    of_label = units.in_brackets(v.label) if v.label else None
    if of_label is not None and of_label.is_angle and not v.units:
        v = replace(v, units=(of_label.name,))
    if v.columns or describe(v.path).hint.against:
        return v
    joints = len(robot.joints)
    said = statements.about(workspace, sources[0])
    lists = [NamesClaim(tuple(labels), sources[0])] if len(labels) > 1 and all(labels) else []
    for claim in (*lists, *names_claims(said, v.shape[1])):
        names = claim.names[:joints] if len(claim.names) == joints + 1 else claim.names
        order = order_of_names(names, robot) if len(names) == joints else None
        if order is not None:
            return replace(v, columns=_columns(order, v, robot)) if _needed(order, names) else v
        found = _named_as_joints(v, claim.names, robot)
        if names_joints(found, robot):
            return found
    for vector in order_vectors(said, joints):
        if not vector.is_identity and vector.is_clear and v.shape[1] in (joints, joints + 1):
            return replace(v, columns=_columns(vector.joints, v, robot))
    return v


def _needed(order: tuple[int, ...], names: tuple[str, ...]) -> bool:
    """Say whether names of columns change their order."""
    return order != tuple(range(len(names)))


def _columns(order: tuple[int, ...], v: Variable, robot: RobotModel) -> tuple[str, ...]:
    named = tuple(robot.joint_names[j] for j in order)
    return named if v.shape[1] == len(named) else (*named, GRIPPER)


def _label(path: str, texts: dict[str, str]) -> str:
    """Return the label of a signal in a structure of Simulink, or what its block is called."""
    match = SIGNALS.match(path)
    if match is None:
        return ""
    label = texts.get(f"{path.removesuffix('.values')}.label", "").strip()
    if label:
        return label
    block = texts.get(f"{match['block']}.blockName", "")
    name = block.rpartition("/")[2].strip()
    return "" if DEFAULT_BLOCK.match(name) else name


def _named_as_joints(v: Variable, headings: tuple[str, ...], robot: RobotModel) -> Variable:
    """Return a table with its headings replaced by the joints that they name in another order."""
    joints = robot.joint_names
    if v.is_message or len(headings) > MOST_HEADINGS or not set(joints).isdisjoint(headings):
        return v
    bare = [plain(h)[0] for h in headings]
    found = _affixed(bare, joints)
    if found is None:
        found = _numbered(bare, len(joints))
    if found is None:
        return v
    names = list(headings)
    for joint, column in zip(joints, found, strict=True):
        names[column] = joint
    given = next((unit for c in found if (unit := plain(headings[c])[1])), None)
    return replace(v, columns=tuple(names), units=(given.name,) if given else v.units)


def _affixed(headings: list[str], joints: tuple[str, ...]) -> list[int] | None:
    """Return the columns of position.elbow_joint and the like, in the robot's order, or None."""
    groups: dict[tuple[str, str], dict[str, int]] = {}
    for column, heading in enumerate(headings):
        # the longest: joint_1 is in joint_10
        joint = max((j for j in joints if j in heading), key=len, default="")
        if joint:
            before, _, after = heading.partition(joint)
            groups.setdefault((before, after), {})[joint] = column
    likely = [
        found
        for affixes, found in groups.items()
        if len(found) == len(joints) and not any(_is_foreign(a) for a in affixes)
    ]
    return [likely[0][j] for j in joints] if len(likely) == 1 else None


def _is_foreign(affix: str) -> bool:
    text = re.sub(r"[^0-9A-Za-zÀ-ɏ]+", "_", affix).strip("_")
    return bool(text) and describe(text).hint in UNLIKELY


def _numbered(headings: list[str], joints: int) -> list[int] | None:
    """Return the columns of q1, q3, q2 and the like in the order of their numbers, or None.

    None where they count upwards already.
    """
    matches = [NUMBERED.match(h) for h in headings]
    groups = Counter((m["before"], m["after"]) for m in matches if m)
    full = [key for key, count in groups.items() if count == joints]
    if len(full) != 1:
        return None
    columns = [c for c, m in enumerate(matches) if m and (m["before"], m["after"]) == full[0]]
    numbers = [int(m["number"]) for m in matches if m and (m["before"], m["after"]) == full[0]]
    ordered = sorted(numbers)
    first = ordered[0]
    if numbers == ordered or first > 1 or ordered != list(range(first, first + joints)):
        return None
    if _is_foreign(headings[columns[0]]):
        return None
    return [c for _, c in sorted(zip(numbers, columns, strict=True))]
