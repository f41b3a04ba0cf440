"""The joints of the columns of a matrix, by headings, labels, lists of names and orders."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from mrlab_ros.core.conversion.evidence import joining, statements, units
from mrlab_ros.core.conversion.evidence.glossary import Class
from mrlab_ros.core.conversion.evidence.headings import (
    BRACKETS,
    GRIPPER,
    MOST_HEADINGS,
    foreign_quantity,
    names_joints,
    plain,
)
from mrlab_ros.core.conversion.evidence.names import (
    Hint,
    describe,
    described,
    spelled,
    words,
    words_in,
)
from mrlab_ros.core.conversion.evidence.statements import Statement
from mrlab_ros.core.conversion.evidence.time_vectors import is_time_name
from mrlab_ros.core.conversion.workspace import Variable, Workspace
from mrlab_ros.core.robots.model import RobotModel

SPLIT = re.compile(r"[\n;,|]+|\s{1,}(?=\D)")
NUMBERED = re.compile(r"(?P<before>\D*)(?P<number>\d+)(?P<after>\D*)$")
# joints by their place in an arm, from the base to the flange
PLACES = ("base", "shoulder", "elbow", "wrist", "wrist", "wrist")
PLACE_WORDS = {
    "base": "base basis sockel socle",
    "shoulder": "shoulder schulter epaule hombro spalla ombro schouder bark",
    "elbow": "elbow ellbogen ellenbogen coude codo gomito cotovelo elleboog lokiec",
    "wrist": "wrist handgelenk poignet muneca polso pulso punho pols nadgarstek",
}
FEWEST_NUMBERED = 3  # of one name, such as q1 to q3
ORDERED = re.compile(r"\d+|[轴軸]|から|まで|[到至]|[<>↔⇄]|[^\W\d_]+|\.(?=\d)")
# what stands between the first and the last joint of an order
TO = words(
    "to down bis zu a au al all ao ate hasta fino jusqu jusque till until naar tot til 到 至 から "
    "まで"
)
OF_ORDER = (Class.ORDER, Class.JOINT, Class.SYMBOL)
PLACE_OF = {word: place for place, words in PLACE_WORDS.items() for word in words.split()}


@dataclass(frozen=True)
class OrderClaim:
    """The joint, from 0, that each column holds; source: where the file says so."""

    joints: tuple[int, ...]
    source: str
    text: str

    @property
    def is_identity(self) -> bool:
        return self.joints == tuple(range(len(self.joints)))

    @property
    def is_clear(self) -> bool:
        """Say whether it means the same read as columns of joints and as joints of columns."""
        return all(self.joints[j] == i for i, j in enumerate(self.joints))


def order_vectors(said: list[Statement], joints: int) -> list[OrderClaim]:
    """Return the vectors and texts beside a matrix that permute the numbers of its joints."""
    found = []
    for s in said:
        values = s.variable.values
        if joints < 2 or s.near > 5:
            continue
        if s.text and s.variable.kind != "logical":
            numbers = numbers_in_order(s.text, joints)
        elif values is not None and values.size == joints:
            numbers = np.asarray(values, dtype=np.float64).reshape(-1).tolist()
        else:
            continue
        for first in (1, 0):
            if sorted(numbers) == list(range(first, first + joints)):
                text = "[" + " ".join(f"{n:g}" for n in numbers) + "]"
                order = tuple(int(n) - first for n in numbers)
                found.append(OrderClaim(order, s.path, text))
                break
    return found


def numbers_in_order(text: str, joints: int) -> list[float]:
    """Return the numbers of joints that a text puts in an order: 6 5 4 3 2 1, axis 6 to axis 1.

    Empty where other words stand between them, or where it says no order.
    """
    tokens = ORDERED.findall(spelled(text))
    places = [i for i, token in enumerate(tokens) if token.isdecimal()]
    numbers = [float(tokens[i]) for i in places]
    if len(numbers) < 2 or "." in tokens:
        return []
    between = [t for t in tokens[places[0] : places[-1]] if not t.isdecimal()]
    spoken = [w for t in tokens[: places[0]] if t[0].isalpha() for w in words_in(t)]
    lettered = len(tokens[places[0] - 1]) == 1 if places[0] else True  # A6 to A1
    known = lettered or any(w.can_be(*OF_ORDER) for w in spoken)
    if not (known and all(t in TO or _is_joint(t) for t in between)):
        return []
    if len(numbers) == 2 and numbers in ([joints, 1], [1, joints], [joints - 1, 0]):
        step = 1 if numbers[0] < numbers[1] else -1
        return [float(n) for n in range(int(numbers[0]), int(numbers[1]) + step, step)]
    return numbers if len(numbers) == joints else []


def _is_joint(token: str) -> bool:
    return (len(token) == 1 and token.isalpha()) or all(
        w.can_be(Class.JOINT) for w in words_in(token)
    )


@dataclass(frozen=True)
class NamesClaim:
    """Names of columns beside a matrix, in its order."""

    names: tuple[str, ...]
    source: str


def names_claims(said: list[Statement], count: int) -> list[NamesClaim]:
    """Return the lists of `count` names beside a matrix: cells, lines, or one text."""
    lists: dict[str, list[tuple[int, str]]] = {}
    whole = []
    for s in said:
        if not s.text or s.near > 5 or not s.names(Class.NAMES, Class.JOINT, Class.ORDER):
            continue
        element = re.search(r"[({](?:1,)?(\d+)[)}]$", s.path)
        if element is not None:
            lists.setdefault(s.path[: element.start()], []).append((int(element[1]), s.text))
        elif s.variable.kind not in ("logical",):
            names = [n.strip(" []{}'\"") for n in SPLIT.split(s.text)]
            whole.append(NamesClaim(tuple(n for n in names if n), s.path))
    found = [NamesClaim(tuple(t for _, t in sorted(m)), path) for path, m in lists.items()]
    return [claim for claim in (*found, *whole) if len(claim.names) == count]


def order_of_names(names: Sequence[str], robot: RobotModel) -> tuple[int, ...] | None:
    """Return the joint, from 0, that each name means; None where they are not the robot's."""
    by_words = order_of_words(names, robot)
    if by_words is not None:
        return by_words
    numbers = [NUMBERED.match(n.strip()) for n in names]
    if all(numbers) and len({spelled(m["before"] + m["after"]) for m in numbers if m}) == 1:
        said = described(numbers[0]["before"]) if numbers[0] else []
        counted = [int(m["number"]) for m in numbers if m]
        first = min(counted)
        usual = all(
            w.can_be(Class.SYMBOL, Class.JOINT, Class.ANGLE, Class.PLACE) or len(w.text) == 1
            for w in said
        )
        if (
            usual
            and first in (0, 1)
            and sorted(counted) == list(range(first, first + len(counted)))
        ):
            return tuple(n - first for n in counted)
    return None


def order_of_words(names: Sequence[str], robot: RobotModel) -> tuple[int, ...] | None:
    """Return the joint, from 0, that each name means by its words, such as elbow; else None."""
    joints = [set(_tokens(j)) for j in robot.joint_names]
    tokens = [set(_tokens(n)) for n in names]
    exact = [_only([i for i, j in enumerate(joints) if j == t]) for t in tokens]
    part = [_only([i for i, j in enumerate(joints) if t and t <= j]) for t in tokens]
    for found in (exact, part):
        if None not in found and len(set(found)) == len(joints):
            return tuple(i for i in found if i is not None)
    places = [_only([PLACES.index(p) for p in PLACE_WORDS if p in t]) for t in tokens]
    known = [p for p in places if p is not None]
    if len(joints) != len(PLACES) or sorted(known) != sorted(map(PLACES.index, PLACES)):
        return None
    numbers = [max((int(t) for t in words if t.isdigit()), default=0) for words in tokens]
    ranked = sorted(range(len(known)), key=lambda c: (known[c], numbers[c]))
    return tuple(ranked.index(c) for c in range(len(known)))


def counts_otherwise(names: Sequence[str], robot: RobotModel) -> bool:
    """Say whether names of columns that are numbered do not count all joints, from 0 or 1.

    So do q1 to q5 and temp, q2 to q7, and q1 to q3 and dq1 to dq3.
    """
    if order_of_names(names, robot) is not None:
        return False
    found = [re.search(r"\d+(?=\D*$)", name) for name in names]
    around = [(m.string[: m.start()], m.string[m.end() :]) for m in found if m]
    if not around or max(Counter(around).values()) < FEWEST_NUMBERED:
        return False
    numbers = sorted(int(m[0]) for m in found if m)
    first = numbers[0]
    counted = first in (0, 1) and numbers == list(range(first, first + len(names)))
    return len(set(around)) > 1 or not counted


def _tokens(text: str) -> list[str]:
    spaced = re.sub(r"(?<=[a-z])(?=[A-Z])", "_", text)
    found = [p for p in re.split(r"[\W_]+|(?<=[a-z])(?=\d)", spelled(spaced)) if p]
    kept = [p for p in found if p not in ("joint", "position", "pos", "q", "angle")]
    return [PLACE_OF.get(p, p) for p in kept]


def _only(found: list[int]) -> int | None:
    return found[0] if len(found) == 1 else None


SIGNALS = re.compile(r"(?P<block>.+)\.signals(?:\(\d+\))?\.values$")
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
        found = _numbered(bare, len(joints)) or _worded(bare, headings, robot)
    if found is None:
        return v
    names = list(headings)
    for joint, column in zip(joints, found, strict=True):
        names[column] = joint
    return replace(v, columns=tuple(names), units=_units_of(headings, found) or v.units)


def _units_of(headings: Sequence[str], joints: list[int]) -> tuple[str, ...]:
    """Return the unit that the headings of joints give, or that of each where they differ."""
    given = [_unit_in(h) for h in headings]
    of_joints = {given[c] for c in joints if given[c]}
    return tuple(given) if len(of_joints) > 1 else tuple(of_joints)


def _unit_in(heading: str) -> str:
    """Return the unit of angles in a heading, or what stands in brackets instead; or empty."""
    unit, match = plain(heading)[1], BRACKETS.search(heading)
    if unit is not None:
        return unit.name
    return match[1] if match and match.start() and not match[1].isdigit() else ""


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


def _worded(bare: list[str], headings: Sequence[str], robot: RobotModel) -> list[int] | None:
    """Return the columns of elbow, shoulder, base and the like in the robot's order, or None."""
    columns = [c for c, name in enumerate(bare) if not is_time_name(name)][: len(robot.joints)]
    order = order_of_words([bare[c] for c in columns], robot)
    if order is None or foreign_quantity(headings):
        return None
    return [columns[order.index(j)] for j in range(len(order))]


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
