"""The load of a grasp and its friction: a quasi-static model with declared figures.

Fingers: Coulomb friction of a soft pad. A pad that carries a force F across it and a moment M
about its normal slips where (F / (mu N))^2 + (M / (mu N r))^2 > 1, with r its effective radius
(Howe and Cutkosky, "Practical force-motion models for sliding manipulation", IJRR 1996). Vacuum:
the holding force of the cup less what pulls and peels at it presses the lip on the surface.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from mrlab_ros.core.base.diagnostic import Diagnostic
from mrlab_ros.core.base.geometry import (
    Pose,
    Vector,
    add,
    compose,
    cross,
    dot,
    rotate,
    scale,
    subtract,
)
from mrlab_ros.core.physics.diagnostics import OVER_PAYLOAD, SLIPS
from mrlab_ros.core.physics.grasp.kinds import FINGERS, Gripper

GRAVITY: Vector = (0.0, 0.0, -9.80665)  # m/s^2, the standard value
# Effective radius of a finger pad, m: two thirds of the radius of a pad of 12 mm.
PAD_RADIUS = 0.008
# Friction needed where nothing presses on the object any more.
NO_GRIP = 99.0
# Friction less than this is needed by no grasp, so that the margin stays finite.
LEAST = 1e-3
# A load that differs by less than this share, and by less than these, is much the same.
SAME = 0.05
SAME_FRICTION = 1e-4
SAME_MOMENT = 0.005  # N*m
# Two fingers whose contacts are closer to one line than this (sine) oppose each other.
ON_A_LINE = 0.35


@dataclass(frozen=True)
class Tool:
    """Stated figures of a robot's hand. payload: kg of the robot at its flange, 0: not stated;
    force: N with which a face pulls; lip_radius: m, of that face; tip: the link of the tool's
    frame, empty: tool0."""

    payload: float = 0.0
    force: float = 0.0
    lip_radius: float = 0.0
    tip: str = ""


@dataclass(frozen=True)
class Grip:
    """How an object is gripped, in the frame of the hand. point: m, the middle of the contacts;
    axes: unit, their normals, or one, out of a face that pulls; spread: m, from the contacts to
    the point, or the radius of the face. backed: a finger presses against the hand itself, which
    presses back as much."""

    point: Vector
    axes: tuple[Vector, ...]
    spread: float
    kind: Gripper = FINGERS
    backed: bool = False


@dataclass(frozen=True)
class Load:
    """The load of a grasp; see mrlab_msgs/Grasp. excess: m/s^2, by which it slips along `way`.

    friction, friction_needed: 0 of what was attached by service, which never slips.
    """

    mass: float
    payload: float
    friction: float
    friction_needed: float
    wrist_moment: float
    way: Vector = (0.0, 0.0, 0.0)
    excess: float = 0.0

    @property
    def slip_margin(self) -> float:
        return self.friction / self.friction_needed - 1.0 if self.friction_needed else 0.0

    def about(self, other: Load | None) -> bool:
        """Return whether another load is much the same."""
        if other is None:
            return False
        friction = abs(self.friction_needed - other.friction_needed)
        moment = abs(self.wrist_moment - other.wrist_moment)
        return (
            friction <= SAME_FRICTION + SAME * other.friction_needed
            and moment <= SAME_MOMENT + SAME * other.wrist_moment
        )


def fingers_grip(contacts: Sequence[tuple[Vector, Vector]], *, backed: bool = False) -> Grip:
    """Return the grip of fingers at `contacts`: (point, normal) each, in the frame of the hand.

    backed: see Grip.
    """
    between = middle([point for point, _ in contacts])
    spread = sum(math.dist(point, between) for point, _ in contacts) / len(contacts)
    return Grip(between, tuple(normal for _, normal in contacts), spread, backed=backed)


def attached(tool0: Vector, centre: Vector, mass: float, payload: float) -> Load:
    """Return what a robot bears with an object that was attached by service; see bears()."""
    return Load(mass, payload, 0.0, 0.0, _wrist_moment(tool0, centre, mass))


def bears(
    grip: Grip,
    hand: Pose,
    tool0: Vector,
    centre: Vector,
    acceleration: Vector,
    mass: float,
    payload: float,
    friction: float,
    force: float,
    drag: Vector = (0.0, 0.0, 0.0),
) -> Load:
    """Return what a grasp bears.

    hand: its pose in world; tool0: its origin in world; centre: of mass of the held object, in
    world, at the same instant; acceleration: m/s^2 of that centre; mass: kg; friction: of the
    object's surface; force: N of all fingers together, or of the cup; drag: N, of another hand at
    the object's centre. What pulls and peels at a
    cup takes from its friction, so it counts as friction needed: the margin is by how much the
    load may grow before the cup slips or comes off.
    """
    load = add(scale(subtract(GRAVITY, acceleration), mass), drag)
    turn = hand.orientation
    point = compose(hand, Pose(grip.point)).position
    moment = cross(subtract(centre, point), load)
    axes = [rotate(turn, axis) for axis in grip.axes]
    mu = friction * grip.kind.friction
    if grip.kind.pulls:
        axis = axes[0]
        across, twist = _apart(load, axis)[1], dot(moment, axis)
        peel = _length(subtract(moment, scale(axis, twist)))
        pull = dot(load, axis) + peel / grip.spread
        pressing, radius = force - pull, grip.spread
    else:
        axis, pair = _common(axes)
        along, rest = _apart(load, axis)
        twist = dot(moment, axis)
        across = rest if pair else along
        # A push on one finger must not open it.
        opening = _length(along if pair else rest)
        pressing, pull = (force if opening <= force / 2 else 0.0), 0.0
        radius = PAD_RADIUS if pair else max(grip.spread, PAD_RADIUS)
    wanted = math.hypot(_length(across), twist / radius)
    gone = pressing <= wanted / NO_GRIP
    needed = NO_GRIP if gone else max((wanted + mu * pull) / (pressing + pull), LEAST)
    excess = _length(load) / mass if gone else (wanted - mu * pressing) / mass
    wrist = _wrist_moment(tool0, centre, mass)
    size = _length(across)
    way = scale(across, 1.0 / size) if size > 0 else (0.0, 0.0, 0.0)
    return Load(mass, payload, mu, needed, wrist, way, excess)


def _wrist_moment(tool0: Vector, centre: Vector, mass: float) -> float:
    """Return the moment of an object's weight about the origin of tool0, N*m."""
    return _length(cross(subtract(centre, tool0), scale(GRAVITY, mass)))


def remark(load: Load, holder: str) -> Diagnostic | None:
    """Return what is to be said of a load; None: nothing."""
    if load.slip_margin < 0:
        return SLIPS(mass=load.mass, friction=load.friction, friction_needed=load.friction_needed)
    if 0 < load.payload < load.mass:
        return OVER_PAYLOAD(robot=holder, mass=load.mass, payload=load.payload)
    return None


def _common(axes: Sequence[Vector]) -> tuple[Vector, bool]:
    """Return the line that two fingers close on, and True; or what three turn about, and False."""
    first = axes[0]
    for other in axes[1:]:
        normal = cross(first, other)
        size = _length(normal)
        if size > ON_A_LINE:
            return scale(normal, 1.0 / size), False
    return first, True


def _apart(v: Vector, axis: Vector) -> tuple[Vector, Vector]:
    """Return the components of `v` along a unit axis and across it."""
    along = scale(axis, dot(v, axis))
    return along, subtract(v, along)


def middle(points: Sequence[Vector]) -> Vector:
    """Return the mean of points; raise ValueError where there are none."""
    x, y, z = (sum(axis) / len(points) for axis in zip(*points, strict=True))
    return (x, y, z)


def _length(v: Vector) -> float:
    return math.hypot(*v)
