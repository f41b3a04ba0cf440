"""Tells the arm of a URDF from its hand.

Finds which end of each finger's range is open, and turns all to one convention.
"""

from __future__ import annotations

import re
import xml.etree.ElementTree as ET
from collections.abc import Iterator, Mapping, Sequence
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

# A finger that comes nearer by less, m, tells nothing of open and closed.
LEAST_STROKE = 1e-6
# A range is even about 0 where its middle is off by less than this share of it.
UNEVEN = 0.05
# Cosine between two axes below which one is across the other.
ACROSS = 0.5


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

    A hand closes on a place half way between its palm and the ends of its fingers, these amid
    their ranges: nearer to it is closed. below: all joints below the arm, parents first. centres:
    of each link's shapes, (3,) m in the link's frame; a link without shapes may be missing. Raises
    BadInput where a driven joint has no range, or mimics none of the hand.
    """
    by_name = {joint.name: joint for joint in below if joint.moves}
    driven = [joint for joint in by_name.values() if joint.mimic is None]
    ranges = {joint.name: _range(joint, origin) for joint in driven}
    followed = {joint.name: _followed(joint, by_name, origin) for joint in by_name.values()}
    palm, last = palm_and_ends(below)
    amid = {name: (lower + upper) / 2 for name, (lower, upper) in ranges.items()}

    def middles(positions: Mapping[str, float]) -> Array:
        at = {n: m * positions[d] + o for n, (d, m, o) in followed.items()}
        return middles_of(below, centres, at, (palm, *last))

    half_closed = middles(amid)
    target = (half_closed[0] + half_closed[1:].mean(axis=0)) / 2

    def away(name: str, share: float) -> float:
        lower, upper = ranges[name]
        ends = middles(amid | {name: lower + share * (upper - lower)})[1:]
        return float(np.linalg.norm(ends - target, axis=1).mean())

    found: dict[str, Finger] = {}
    for joint in driven:
        lower, upper = ranges[joint.name]
        # Not at its ends: there a finger may be past the place.
        flipped = away(joint.name, 0.75) > away(joint.name, 0.25) + LEAST_STROKE
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


def closing_only(
    below: Sequence[urdf.UrdfJoint],
) -> tuple[tuple[urdf.UrdfJoint, ...], tuple[urdf.UrdfJoint, ...]]:
    """Return the joints below an arm, parents first, with those of the hand that close nothing as
    fixed ones, and these: what turns endlessly beside fingers, a wrist that carries them all, and
    what swings a finger of three or more to both sides alike, across the way it bends."""
    driven = [joint for joint in below if joint.moves and joint.mimic is None]
    if not driven:
        return tuple(below), ()
    palm, last = palm_and_ends(below)
    followed = {joint.mimic.joint for joint in below if joint.mimic is not None}
    wrist = {joint.name for joint in urdf.path_to(palm, tuple(below))[1]}
    kept = [
        joint
        for joint in driven
        if joint.name not in followed
        and (
            joint.kind == "continuous"
            or (len(last) > 1 and joint.name in wrist)
            or (len(last) > 2 and _sways(joint, below))
        )
    ]
    if len(kept) == len(driven):
        kept = []
    return tuple(replace(j, kind="fixed") if j in kept else j for j in below), tuple(kept)


def _sways(joint: urdf.UrdfJoint, below: Sequence[urdf.UrdfJoint]) -> bool:
    """Return whether a joint turns to both sides alike, and the next one across it."""
    limit = joint.limit or {}
    lower, upper = limit.get("lower", 0.0), limit.get("upper", 0.0)
    if joint.kind != "revolute" or abs(lower + upper) > UNEVEN * (upper - lower):
        return False
    axes = {joint.child: np.array(joint.unit_axis)}  # in the frames of links that it carries
    for after in below:
        if after.parent in axes:
            axis = after.segment().T_parent_joint[:3, :3].T @ axes[after.parent]
            if after.moves:
                return bool(abs(axis @ np.array(after.unit_axis)) < ACROSS)
            axes[after.child] = axis
    return False


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


def palm_and_ends(below: Sequence[urdf.UrdfJoint]) -> tuple[str, list[str]]:
    """Return the link where the ways to the fingers part, and the last link that each moves."""
    above = {joint.child: joint.parent for joint in below}

    def way(link: str) -> list[str]:
        return [*way(above[link]), link] if link in above else [link]

    ways = {joint.child: way(joint.parent) for joint in below if joint.moves}
    inner = {link for links in ways.values() for link in links}
    last = [link for link in ways if link not in inner]
    common = [link for link in ways[last[0]] if all(link in ways[other] for other in last)]
    return common[-1], last


def middles_of(
    below: Sequence[urdf.UrdfJoint],
    centres: Mapping[str, Array],
    positions: Mapping[str, float],
    links: Sequence[str],
) -> Array:
    """Return the middles of links, (N, 3) m, with the hand's joints at these positions."""
    places: dict[str, Array] = {below[0].parent: np.eye(4)}
    for joint in below:
        at = np.array([positions[joint.name]] if joint.moves else [])
        step = KinematicChain(joint.parent, (joint.segment(),)).tool0(at)
        places[joint.child] = places[joint.parent] @ step
    return np.array([(places[x] @ np.append(centres.get(x, np.zeros(3)), 1.0))[:3] for x in links])


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
        below, kept = closing_only(below)
        return Split(arm, tip, below, (*still, *kept), why)

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
