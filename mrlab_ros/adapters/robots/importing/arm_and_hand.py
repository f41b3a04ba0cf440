"""Tells the arm of a URDF from its hand.

Finds which end of each finger's range is open, and turns all to one convention.
"""

from __future__ import annotations

import itertools
import re
import xml.etree.ElementTree as ET
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace

import numpy as np

from mrlab_ros.adapters.robots import urdf
from mrlab_ros.adapters.robots.diagnostics import NO_LINK_IN_FILE
from mrlab_ros.adapters.robots.importing.diagnostics import (
    ARM_MIMICS,
    ARMS_BRANCH,
    HAND_LIMITS,
    HAND_MIMICS,
    NO_ARM_THERE,
    TIP_GIVEN,
    TIP_OF_CHAIN,
    TIP_OF_GROUP,
    TIP_UNMOVED,
)
from mrlab_ros.core.base.diagnostic import Diagnostic
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.base.geometry import Array
from mrlab_ros.core.robots.model import KinematicChain

# A hand whose fingers come apart by less over their range, m, tells nothing of open and closed.
LEAST_STROKE = 1e-6


@dataclass(frozen=True)
class Finger:
    """A joint of the hand as the lab has it: `lower` is open, `upper` closed; rad or m.

    flipped: its axis was turned round for that. mimics: the driven joint that it follows, or
    empty; multiplier, offset: how. velocity: 0 where none is stated.
    """

    name: str
    lower: float
    upper: float
    velocity: float
    flipped: bool
    mimics: str = ""
    multiplier: float = 1.0
    offset: float = 0.0


def fingers(
    below: tuple[urdf.UrdfJoint, ...], centres: Mapping[str, Array], origin: str
) -> tuple[Finger, ...]:
    """Return the moving joints below an arm so that every one closes from `lower` to `upper`.

    A hand is open where its fingers are further apart. below: all joints below the arm, parents
    first. centres: of each link's shapes, (3,) m in the link's frame; a link without shapes may
    be missing. Raises BadInput where a driven joint has no range, or mimics none of the hand.
    """
    by_name = {joint.name: joint for joint in below if joint.moves}
    driven = [joint for joint in by_name.values() if joint.mimic is None]
    ranges = {joint.name: _range(joint, origin) for joint in driven}
    followed = {joint.name: _followed(joint, by_name, origin) for joint in by_name.values()}

    def spread(end: int, turned: str = "") -> float:
        ends = {name: pair[end if name != turned else 1 - end] for name, pair in ranges.items()}
        return _spread(below, centres, {n: m * ends[d] + o for n, (d, m, o) in followed.items()})

    found: dict[str, Finger] = {}
    for joint in driven:
        lower, upper = ranges[joint.name]
        # Each driven joint alone: two that open in opposite directions must not cancel.
        flipped = spread(0, joint.name) > spread(0) + LEAST_STROKE
        velocity = (joint.limit or {}).get("velocity", 0.0)
        ends = (0.0 - upper, 0.0 - lower) if flipped else (lower, upper)
        found[joint.name] = Finger(joint.name, *ends, velocity, flipped)
    for name, (leader, multiplier, offset) in followed.items():
        if name in found:
            continue
        first = found[leader]
        if first.flipped:
            multiplier = -multiplier
        flipped = multiplier < 0
        if flipped:
            multiplier, offset = -multiplier, 0.0 - offset
        ends = (multiplier * first.lower + offset, multiplier * first.upper + offset)
        velocity = multiplier * first.velocity
        found[name] = Finger(name, *ends, velocity, flipped, leader, multiplier, offset)
    return tuple(found[name] for name in by_name)


def _range(joint: urdf.UrdfJoint, origin: str) -> tuple[float, float]:
    limit = joint.limit or {}
    lower, upper = limit.get("lower", 0.0), limit.get("upper", 0.0)
    if joint.kind == "continuous" or not lower < upper:
        raise BadInput(HAND_LIMITS(file=origin, joint=joint.name, lower=lower, upper=upper))
    return lower, upper


def _followed(
    joint: urdf.UrdfJoint, by_name: Mapping[str, urdf.UrdfJoint], origin: str
) -> tuple[str, float, float]:
    """Return the driven joint that a joint follows in the end, multiplier and offset."""
    multiplier, offset, at = 1.0, 0.0, joint
    for _ in by_name:
        if at.mimic is None:
            return at.name, multiplier, offset
        offset += multiplier * at.mimic.offset
        multiplier *= at.mimic.multiplier
        if at.mimic.joint not in by_name:
            break
        at = by_name[at.mimic.joint]
    if at.mimic is None:
        return at.name, multiplier, offset
    raise BadInput(HAND_MIMICS(file=origin, joint=joint.name, other=at.mimic.joint))


def _spread(
    below: tuple[urdf.UrdfJoint, ...],
    centres: Mapping[str, Array],
    positions: Mapping[str, float],
) -> float:
    """Return the mean distance, m, between the last links of the fingers at these positions."""
    places: dict[str, Array] = {below[0].parent: np.eye(4)}
    for joint in below:
        at = np.array([positions[joint.name]] if joint.moves else [])
        step = KinematicChain(joint.parent, (joint.segment(),)).tool0(at)
        places[joint.child] = places[joint.parent] @ step
    moving = [joint for joint in below if joint.moves]
    inner = {joint.parent for joint in moving}
    last = [joint.child for joint in moving if joint.child not in inner]
    if len(last) < 2:  # one jaw: against the other, which is part of the palm
        last += [joint.parent for joint in moving]
    points = [(places[x] @ np.append(centres.get(x, np.zeros(3)), 1.0))[:3] for x in last]
    pairs = [float(np.linalg.norm(a - b)) for a, b in itertools.combinations(points, 2)]
    return float(np.mean(pairs))


# Names of joints and links that belong to a hand.
HAND_NAME = re.compile(r"finger|grip|jaw|knuckle|claw|thumb", re.IGNORECASE)
# Names of links that may be a whole hand, which the last joint of the arm turns.
WHOLE_HAND = re.compile(r"grip", re.IGNORECASE)
# Names of a frame between the fingers.
TIP_NAME = re.compile(r"tcp|tool|grasp|(^|_)ee(_|$)|end_effector", re.IGNORECASE)
# An arm has at least this many more joints than whatever branches off it.
LONGER_BY = 2


@dataclass(frozen=True)
class Split:
    """arm: its moving joints, base first. tip: the link whose pose the arm decides. below: all
    joints below the arm, parents first. still: moving joints that belong neither to the arm nor
    below it. why: how it was decided, for a person."""

    arm: tuple[urdf.UrdfJoint, ...]
    tip: str
    below: tuple[urdf.UrdfJoint, ...]
    still: tuple[urdf.UrdfJoint, ...]
    why: Diagnostic

    @property
    def hand(self) -> tuple[urdf.UrdfJoint, ...]:
        return tuple(joint for joint in self.below if joint.moves)


def split(root: ET.Element, origin: str, tip: str = "", groups: Groups | None = None) -> Split:
    """Return the arm and the hand of a URDF.

    tip: a link that the user named; groups: what an SRDF says. Without either, the arm is the
    chain from the root down to where moving joints branch, and the hand is what branches there.
    Raises BadInput for an unknown tip, or where two chains are equally long.
    """
    tree = _Tree(root, origin)
    if tip:
        if tip not in tree.links:
            raise BadInput(NO_LINK_IN_FILE(file=origin, link=tip, known=[*tree.links]))
        return tree.split_at(tip, TIP_GIVEN())
    if groups is not None and (named := groups.arm_tip(tree)) is not None:
        return tree.split_at(named, TIP_OF_GROUP(group=groups.arm_name))
    return tree.trunk()


class _Tree:
    def __init__(self, root: ET.Element, origin: str) -> None:
        self.origin = origin
        self.joints = urdf.joints(root, origin)
        self.links = [str(element.get("name")) for element in root.iterfind("link")]
        self._below: dict[str, list[urdf.UrdfJoint]] = {}
        for joint in self.joints:
            self._below.setdefault(joint.parent, []).append(joint)
        children = {joint.child for joint in self.joints}
        self.root = next(link for link in self.links if link not in children)

    def path(self, tip: str) -> tuple[urdf.UrdfJoint, ...]:
        return urdf.path_to(tip, self.joints)[1]

    def below(self, link: str) -> Iterator[urdf.UrdfJoint]:
        """Yield all joints below a link."""
        for joint in self._below.get(link, ()):
            yield joint
            yield from self.below(joint.child)

    def split_at(self, tip: str, why: Diagnostic) -> Split:
        arm = tuple(joint for joint in self.path(tip) if joint.moves)
        if not arm:
            raise BadInput(TIP_UNMOVED(file=self.origin, link=tip))
        return self._split(arm, tip, why)

    def _split(self, arm: tuple[urdf.UrdfJoint, ...], tip: str, why: Diagnostic) -> Split:
        for joint in arm:
            if joint.mimic is not None:
                raise BadInput(
                    ARM_MIMICS(file=self.origin, joint=joint.name, other=joint.mimic.joint)
                )
        below = tuple(self.below(arm[-1].child))
        used = {joint.name for joint in (*arm, *below)}
        still = [joint for joint in self.joints if joint.moves and joint.name not in used]
        endless = self._endless(below)
        still += endless
        below = tuple(replace(j, kind="fixed") if j in endless else j for j in below)
        return Split(arm, tip, below, tuple(still), why)

    def _endless(self, below: tuple[urdf.UrdfJoint, ...]) -> list[urdf.UrdfJoint]:
        """Return what turns endlessly in a hand beside its fingers: a gear that is shown."""
        followed = {joint.mimic.joint for joint in below if joint.mimic is not None}
        driven = [joint for joint in below if joint.moves and joint.mimic is None]
        endless = [j for j in driven if j.kind == "continuous" and j.name not in followed]
        return endless if len(endless) < len(driven) else []

    def depth(self, joint: urdf.UrdfJoint) -> int:
        """Return the most driven joints on a way down that begins with `joint`."""
        own = int(joint.moves and joint.mimic is None)
        return own + max(map(self.depth, self._below.get(joint.child, ())), default=0)

    def trunk(self) -> Split:
        link, arm = self.root, list[urdf.UrdfJoint]()
        why = TIP_OF_CHAIN()
        while True:
            ways = [j for j in self._below.get(link, ()) if j.moves or self._moves_below(j)]
            if not ways:
                break
            ways.sort(key=self.depth, reverse=True)
            first, second = self.depth(ways[0]), self.depth(ways[1]) if len(ways) > 1 else 0
            if len(ways) > 1 and first - second < LONGER_BY:
                # A branch into shorter chains than the one that leads to it is a hand.
                arms = first > LONGER_BY and first >= len(arm)
                if arms and not any(HAND_NAME.search(j.name) for j in ways):
                    raise BadInput(
                        ARMS_BRANCH(
                            file=self.origin,
                            link=link,
                            first=first,
                            second=second,
                            tip=self._end(ways[0]),
                        )
                    )
                break
            joint = ways[0]
            if arm and self._of_hand(joint):
                if joint.moves:
                    break
                if not self._arm_below(joint):
                    # A fixed joint that the hand begins with.
                    link = joint.child
                    continue
            if joint.moves:
                arm.append(joint)
            link = joint.child
        if not arm:
            raise BadInput(NO_ARM_THERE(file=self.origin, link=link))
        return self._split(tuple(arm), self._tip(arm[-1].child), why)

    def _of_hand(self, joint: urdf.UrdfJoint) -> bool:
        """Return whether a joint is named as one of a hand: it, or the link that it moves.

        A joint that turns a link named gripper, in which other joints move, is the arm's last.
        """
        if HAND_NAME.search(joint.name):
            return True
        if not HAND_NAME.search(joint.child):
            return False
        whole = joint.moves and WHOLE_HAND.search(joint.child)
        return not (whole and any(j.moves and j.mimic is None for j in self.below(joint.child)))

    def _driven_arm(self, joint: urdf.UrdfJoint) -> bool:
        return joint.moves and joint.mimic is None and not self._of_hand(joint)

    def _moves_below(self, joint: urdf.UrdfJoint) -> bool:
        return any(below.moves for below in self.below(joint.child))

    def _end(self, joint: urdf.UrdfJoint) -> str:
        """Return the last link before the hand on the longest way down."""
        while True:
            ways = [j for j in self._below.get(joint.child, ()) if self._driven_arm(j)]
            ways += [j for j in self._below.get(joint.child, ()) if self._arm_below(j)]
            if not ways:
                return joint.child
            joint = max(ways, key=self.depth)

    def _arm_below(self, joint: urdf.UrdfJoint) -> bool:
        return any(self._driven_arm(below) for below in self.below(joint.child))

    def _tip(self, link: str) -> str:
        """Return tool0, a tool frame, or the last link that is rigidly fixed to `link`."""
        rigid = [link]
        for at in rigid:
            rigid += [j.child for j in self._below.get(at, ()) if not j.moves]
        if "tool0" in rigid:
            return "tool0"
        named = [at for at in rigid[1:] if TIP_NAME.search(at)]
        if named:
            return named[-1]
        # Along the chain of single fixed joints: a flange, not a sensor beside fingers.
        while len(ways := self._below.get(link, [])) == 1 and not ways[0].moves:
            link = ways[0].child
        return link


class Groups:
    """The planning groups of an SRDF."""

    def __init__(self, text: str, origin: str) -> None:
        try:
            self._root = ET.fromstring(text)
        except ET.ParseError as error:
            raise urdf.not_xml(origin, error, text) from None
        self.arm_name = ""

    def arm_tip(self, tree: _Tree) -> str | None:
        """Return the last link of the group whose chain moves most joints; None without one."""
        hands = {element.get("group") for element in self._root.iterfind("end_effector")}
        best = 0
        found = None
        for group in self._root.iterfind("group"):
            chain = group.find("chain")
            if chain is None or group.get("name") in hands:
                continue
            tip = str(chain.get("tip_link"))
            if tip not in tree.links:
                continue
            moved = sum(joint.moves for joint in tree.path(tip))
            if moved > best:
                best, found, self.arm_name = moved, tip, str(group.get("name"))
        return found
