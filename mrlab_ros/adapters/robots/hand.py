"""Finds which end of each finger's range is open, and turns all to one convention."""

from __future__ import annotations

import itertools
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from mrlab_ros.adapters.robots import urdf
from mrlab_ros.adapters.robots.diagnostics import HAND_LIMITS, HAND_MIMICS
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
