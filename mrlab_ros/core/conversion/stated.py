"""What a file states beside a matrix: its unit, its label, the joints of its columns."""

from __future__ import annotations

import re
from collections import Counter
from dataclasses import replace

from mrlab_ros.core.conversion import joining
from mrlab_ros.core.conversion.headings import MOST_HEADINGS, plain
from mrlab_ros.core.conversion.named_columns import names_joints
from mrlab_ros.core.conversion.time_vectors import is_time_name
from mrlab_ros.core.conversion.unit_names import said_by_units
from mrlab_ros.core.conversion.variable_names import Hint, describe
from mrlab_ros.core.conversion.workspace import Variable, Workspace
from mrlab_ros.core.robots.model import RobotModel

UNIT_FIELDS = frozenset(("unit", "units", "einheit", "einheiten"))
NAME_FIELDS = ("name", "names", "joint_names", "jointnames", "jointNames", "JointNames", "Name")
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
        _in_degrees(_named_as_joints(v, v.columns, robot), robot)
        if v.columns and v.values is not None
        else v
        for v in workspace.variables
    )
    return replace(workspace, variables=variables)


def _in_degrees(table: Variable, robot: RobotModel) -> Variable:
    """Return a table with degrees as its unit where the headings of all its joints say so."""
    headings = [h for h in table.columns if not is_time_name(plain(h)[0])]
    degrees = [h for h in headings if plain(h)[1] == "deg"]
    if table.units or len(degrees) < len(robot.joints) or len(headings) - len(degrees) > 1:
        return table
    return replace(table, units=("deg",))


def with_statements(workspace: Workspace, robot: RobotModel, join: str = "") -> Workspace:
    """Return the workspace with the units, labels and joints that stand beside its matrices.

    Units: a text called unit or Einheit beside the matrix. Labels: label or blockName of a
    structure of Simulink. Joints: a list of names beside the matrix. join: the option of that
    name, whose pieces may have labels.
    """
    texts = {v.path: v.text for v in workspace.variables if v.text}
    if not texts:
        return workspace
    units = {
        path.rpartition(".")[0]: text
        for path, text in texts.items()
        if path.rpartition(".")[2].lower() in UNIT_FIELDS
    }
    variables = tuple(
        _stated(v, texts, units, robot, join)
        if v.values is not None and len(v.shape) == 2 and min(v.shape) > 1 and not v.is_message
        else v
        for v in workspace.variables
    )
    return replace(workspace, variables=variables)


def _stated(
    v: Variable, texts: dict[str, str], units: dict[str, str], robot: RobotModel, join: str
) -> Variable:
    sources = joining.sources(v.path, join)[:MOST_SOURCES]
    outer = sources[0].rpartition(".")[0]
    # degrees alone: another unit may be that of another matrix beside it
    unit = units.get(outer, "")
    if unit and not v.units and said_by_units((unit,)).unit == "deg":
        v = replace(v, units=(unit,))
    labels = [_label(path, texts) for path in sources]
    if labels[0] and not v.label:
        v = replace(v, label=labels[0])
    if v.columns or describe(v.path).hint in UNLIKELY:
        return v
    names = labels if len(labels) > 1 and all(labels) else _names_beside(outer, texts)
    if len(names) == v.shape[1]:
        if tuple(names) != robot.joint_names and set(names) == set(robot.joint_names):
            return replace(v, columns=tuple(names))
        found = _named_as_joints(v, tuple(names), robot)
        if names_joints(found, robot):
            return found
    return v


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


def _names_beside(outer: str, texts: dict[str, str]) -> list[str]:
    """Return the texts of a cell called name or joint_names that lies in the struct `outer`."""
    for field in NAME_FIELDS:
        path = f"{outer}.{field}" if outer else field
        found: list[str] = []
        while f"{path}{{{len(found) + 1}}}" in texts:
            found.append(texts[f"{path}{{{len(found) + 1}}}"].strip())
        if found:
            return found
    return []


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
    degrees = any(plain(headings[c])[1] for c in found)
    return replace(v, columns=tuple(names), units=("deg",) if degrees else v.units)


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
