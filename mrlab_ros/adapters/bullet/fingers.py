"""The fingers of arms in a Bullet world: how they close, their drives and their couplings.

An arm as Bullet knows it.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

from mrlab_ros.adapters.bullet.description import Coupling, Description
from mrlab_ros.adapters.bullet.diagnostics import BAD_FINGERS, FINGER_BEYOND
from mrlab_ros.adapters.bullet.quiet import pybullet
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.base.geometry import (
    Quaternion,
    Vector,
    add,
    cross,
    dot,
    rotate,
    scale,
    subtract,
)
from mrlab_ros.core.physics.engine import Arm, FingerState, LinkPairs

FAR = 1.0  # m, over which fingers are looked for
COUPLED = 1e-7  # m or rad; coupled fingers that are nearer to their places are left there
# Limit of the finger force, N or N*m: what they hold is fixed to the gripper, and a light object
# between strong fingers would jitter.
PRESS = 15.0


class Fingers:
    """Closes and opens the fingers of the arms of one world."""

    def __init__(self, client: int) -> None:
        self._client = client

    def _call(self, function: Callable[..., Any], *arguments: Any, **named: Any) -> Any:
        return function(*arguments, physicsClientId=self._client, **named)

    def find_closing(
        self, arm: LoadedArm, description: Description, joint_index: dict[str, int]
    ) -> None:
        """Find which way each finger of a loaded arm closes; leave them open.

        joint_index: Bullet's number of each joint.
        """
        closes = self._closes(arm, description)
        arm.facts = description.facts(closes)
        arm.ways = _ways(arm, description, joint_index, closes)

    def _closes(self, arm: LoadedArm, description: Description) -> list[float]:
        """Return of each finger whether its upper (1) or its lower limit (-1) is closed: where it
        is nearer to the other fingers. A follower closes as its leader does."""
        led = {c.follower: c for c in arm.couplings}
        roots = {
            index: description.chain(link)[0]
            for link, index in arm.index.items()
            if link in description.finger_of
        }
        closes = [1.0] * len(arm.fingers)
        pairs = [(a, b) for a in roots for b in roots if a < b and roots[a] != roots[b]]

        def spread(finger: int, position: float) -> float:
            for i, facts in enumerate(description.fingers):
                at = position if i == finger else (facts.lower + facts.upper) / 2
                c = led.get(i)
                if c is not None and c.leader == finger:
                    at = c.multiplier * position + c.offset
                self._call(pybullet.resetJointState, arm.body, arm.fingers[i], at)
            found = (
                self._call(
                    pybullet.getClosestPoints,
                    arm.body,
                    arm.body,
                    FAR,
                    linkIndexA=a,
                    linkIndexB=b,
                )
                for a, b in pairs
            )
            return min((p[8] for points in found for p in points), default=FAR)

        for i, facts in enumerate(description.fingers):
            if i not in led:
                closes[i] = 1.0 if spread(i, facts.upper) <= spread(i, facts.lower) else -1.0
        for c in arm.couplings:
            closes[c.follower] = math.copysign(1.0, closes[c.leader] * c.multiplier)
        for index, facts, way in zip(arm.fingers, description.fingers, closes, strict=True):
            opened = replace(facts, closes=way).opened
            self._call(pybullet.resetJointState, arm.body, index, opened)
        return closes

    def drive(self, name: str, arm: LoadedArm, velocities: Sequence[float]) -> None:
        """Drive fingers at `velocities`, m/s or rad/s; raise BadInput where they do not fit."""
        if len(velocities) != len(arm.fingers) or not all(map(math.isfinite, velocities)):
            raise BadInput(BAD_FINGERS(robot=name, found=[*velocities], count=len(arm.fingers)))
        if arm.fingers:
            self._call(
                pybullet.setJointMotorControlArray,
                arm.body,
                arm.fingers,
                pybullet.VELOCITY_CONTROL,
                targetVelocities=list(velocities),
                forces=[min(f.max_force, PRESS) for f in arm.facts.fingers],
            )

    def place(self, arm: LoadedArm, positions: Sequence[float]) -> None:
        """Put fingers at `positions`, m or rad, at rest; raise BadInput beyond their limits."""
        for joint, finger, position in zip(arm.fingers, arm.facts.fingers, positions, strict=True):
            if not finger.lower - 1e-3 <= position <= finger.upper + 1e-3:
                raise BadInput(
                    FINGER_BEYOND(
                        finger=finger.joint, position=position, low=finger.lower, high=finger.upper
                    )
                )
            self._call(pybullet.resetJointState, arm.body, joint, position, 0.0)

    def states(self, arm: LoadedArm) -> tuple[FingerState, ...]:
        if not arm.fingers:
            return ()
        states = pybullet.getJointStates(arm.body, arm.fingers, self._client)
        return tuple(FingerState(s[0], s[3]) for s in states)

    def grip(self, arm: LoadedArm, link: int, point: Vector, normal: Vector) -> float:
        """Return the cosine between a contact and the way a finger closes, or a tool points.

        normal: unit, from the other towards the arm.
        """
        if link in arm.ways:
            way: Vector = (0.0, 0.0, 0.0)
            for joint in arm.ways[link]:
                state = pybullet.getLinkState(arm.body, joint.index, 0, 0, self._client)
                axis = scale(rotate(state[5], joint.axis), joint.rate)
                moved = axis if joint.slides else cross(axis, subtract(point, state[4]))
                way = add(way, moved)
            size = math.hypot(*way)
            return -dot(way, normal) / size if size > 0 else 0.0
        if arm.links[link] not in arm.facts.face_links:
            return 0.0
        tool = self._tool(arm)
        return -dot(rotate(tool, (0.0, 0.0, 1.0)), normal)

    def _tool(self, arm: LoadedArm) -> Quaternion:
        """Return the orientation of an arm's tool frame."""
        state = pybullet.getLinkState(arm.body, arm.index[arm.facts.tool], 0, 0, self._client)
        turn: Quaternion = state[5]
        return turn

    def couple(self, arm: LoadedArm) -> None:
        """Keep fingers in their ranges; place each leader at the mean of what its followers'
        positions mean for it, and them; call it after every step."""
        states = pybullet.getJointStates(arm.body, arm.fingers, self._client)
        led: dict[int, list[tuple[int, float, float]]] = {
            i: [(i, 1.0, 0.0)] for i in range(len(arm.fingers)) if i not in arm.followers
        }
        for c in arm.couplings:
            led.setdefault(c.leader, []).append((c.follower, c.multiplier, c.offset))
        for leader, members in led.items():
            finger = arm.facts.fingers[leader]
            mean = _mean([(states[i][0] - o) / m for i, m, o in members])
            velocity = _mean([states[i][1] / m for i, m, _ in members])
            position = min(max(mean, finger.lower), finger.upper)
            if position != mean:
                velocity = 0.0
            if all(abs(states[i][0] - m * position - o) < COUPLED for i, m, o in members):
                continue
            for i, m, o in members:
                self._call(
                    pybullet.resetJointState,
                    arm.body,
                    arm.fingers[i],
                    m * position + o,
                    m * velocity,
                )


def _ways(
    arm: LoadedArm, description: Description, joint_index: dict[str, int], closes: list[float]
) -> dict[int, tuple[Way, ...]]:
    """Return how each link of a finger moves while the gripper closes."""
    rates = dict(zip((f.joint for f in description.fingers), closes, strict=True))
    for c in arm.couplings:
        leader, follower = description.fingers[c.leader], description.fingers[c.follower]
        rates[follower.joint] = closes[c.leader] * c.multiplier
        rates[leader.joint] = closes[c.leader]
    ways = {}
    for link, index in arm.index.items():
        if link in description.finger_of:
            chain = description.chain(link)
            ways[index] = tuple(
                Way(joint_index[joint], *description.axis(joint), rates[joint]) for joint in chain
            )
    return ways


def _mean(values: Sequence[float]) -> float:
    return sum(values) / len(values)


@dataclass(frozen=True)
class Way:
    """How a joint carries a finger along while the gripper closes. index: of its link; axis: unit,
    in the link's frame; rate: its share of the leader's speed, signed."""

    index: int
    axis: Vector
    slides: bool
    rate: float


@dataclass(eq=False)
class LoadedArm:
    """An arm as Bullet knows it: its numbers of body, joints and links.

    index: the number of each link. links: the link that each number counts as: what is fixed to
    a finger is that finger. made_of: its URDF, its joints, its links that never touch. ways: by
    the number of a finger's link, how it closes. present: it was moved to where it stands; before
    that nothing touches it.
    """

    body: int
    facts: Arm
    joints: list[int]
    fingers: list[int]
    index: dict[str, int]
    links: dict[int, str]
    moving: list[int]
    positions: Sequence[float]
    couplings: tuple[Coupling, ...]
    ignored: set[tuple[int, int]]
    made_of: tuple[str, tuple[str, ...], LinkPairs]
    followers: frozenset[int] = frozenset()
    ways: dict[int, tuple[Way, ...]] = field(default_factory=dict)
    present: bool = False
