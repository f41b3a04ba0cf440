"""Other claims of a file about a matrix: the order of its joints, its robot, motors, offsets."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from mrlab_ros.core.conversion.evidence.glossary import Class
from mrlab_ros.core.conversion.evidence.names import described, spelled
from mrlab_ros.core.conversion.evidence.statements import Statement
from mrlab_ros.core.robots.model import RobotModel

SPLIT = re.compile(r"[\n;,|]+|\s{1,}(?=\D)")
NUMBERED = re.compile(r"(?P<before>\D*)(?P<number>\d+)(?P<after>\D*)$")
# joints by their place in an arm, from the base to the flange
PLACES = ("base", "shoulder", "elbow", "wrist", "wrist", "wrist")


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
    """Return the vectors beside a matrix that permute the numbers of its joints."""
    found = []
    for s in said:
        values = s.variable.values
        if values is None or values.size != joints or joints < 2 or s.near > 5:
            continue
        numbers = np.asarray(values, dtype=np.float64).reshape(-1)
        if not np.isfinite(numbers).all():
            continue
        for first in (1, 0):
            if sorted(numbers.tolist()) == list(range(first, first + joints)):
                text = "[" + " ".join(f"{n:g}" for n in numbers) + "]"
                order = tuple(int(n) - first for n in numbers)
                found.append(OrderClaim(order, s.path, text))
                break
    return found


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
    joints = [set(_tokens(j)) for j in robot.joint_names]
    tokens = [set(_tokens(n)) for n in names]
    exact = [_only([i for i, j in enumerate(joints) if j == t]) for t in tokens]
    if None not in exact and len(set(exact)) == len(joints):
        return tuple(i for i in exact if i is not None)
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
    part = [_only([i for i, j in enumerate(joints) if t and t <= j]) for t in tokens]
    if None not in part and len(set(part)) == len(joints):
        return tuple(i for i in part if i is not None)
    if len(names) == len(PLACES) and all(p in t for p, t in zip(PLACES, tokens, strict=True)):
        return tuple(range(len(names)))
    return None


def _tokens(text: str) -> list[str]:
    spaced = re.sub(r"(?<=[a-z])(?=[A-Z])", "_", text)
    found = [p for p in re.split(r"[\W_]+|(?<=[a-z])(?=\d)", spelled(spaced)) if p]
    return [p for p in found if p not in ("joint", "position", "pos", "q", "angle")]


def _only(found: list[int]) -> int | None:
    return found[0] if len(found) == 1 else None
