"""The fingers of arms in a Bullet world: how they close, their drives and their couplings.

An arm as Bullet knows it.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Container, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

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

COUPLED = 1e-7  # m or rad; coupled fingers that are nearer to their places are left there
# Limit of the finger force, N or N*m: what they hold is fixed to the gripper, and a light object
# between strong fingers would jitter.
PRESS = 15.0
# Share of the largest effect below which a change takes nothing out of what is pressed on.
LEAST_EFFECT = 0.1
# Share of its speed below which a coupled finger is stopped.
MOVES = 0.5
# Force that holds a finger where it is to stand, N or N*m.
LOCK = 1e4


class Fingers:
    """Closes and opens the fingers of the arms of one world."""

    def __init__(self, client: int) -> None:
        self._client = client

    def _call(self, function: Callable[..., Any], *arguments: Any, **named: Any) -> Any:
        return function(*arguments, physicsClientId=self._client, **named)

    def find_closing(
        self, arm: LoadedArm, description: Description, joint_index: dict[str, int]
    ) -> None:
        """Note which way each finger of a loaded arm closes, and open it.

        A leader closes at its upper limit, and a follower as that moves it. joint_index: Bullet's
        number of each joint.
        """
        closes = [1.0] * len(arm.fingers)
        for c in arm.couplings:
            closes[c.follower] = math.copysign(1.0, c.multiplier)
        arm.facts = description.facts(closes)
        for index, finger in zip(arm.fingers, arm.facts.fingers, strict=True):
            self._call(pybullet.resetJointState, arm.body, index, finger.opened)
        arm.ways = _ways(arm, description, joint_index, closes)

    def drive(self, name: str, arm: LoadedArm, velocities: Sequence[float]) -> None:
        """Drive fingers at `velocities`, m/s or rad/s; raise BadInput where they do not fit."""
        if len(velocities) != len(arm.fingers) or not all(map(math.isfinite, velocities)):
            raise BadInput(BAD_FINGERS(robot=name, found=[*velocities], count=len(arm.fingers)))
        arm.driven, arm.locked = tuple(velocities), ()
        if arm.fingers:
            states = pybullet.getJointStates(arm.body, arm.fingers, self._client)
            self._lock(arm, [state[0] for state in states])

    def _lock(
        self, arm: LoadedArm, positions: Sequence[float], pushed: Container[int] = ()
    ) -> None:
        """Lock the fingers that are to stand, or are at the end they are driven to: nothing pushes
        them from there. pushed: leaders that were pushed past an end in the last step."""
        locked = [False] * len(arm.fingers)
        for leader, members in arm.groups:
            finger, velocity = arm.facts.fingers[leader], arm.driven[leader]
            end = finger.upper if velocity > 0 else finger.lower
            stands = not velocity or leader in pushed or abs(positions[leader] - end) < COUPLED
            for i, _, _ in members:
                locked[i] = stands
        if arm.locked != (now := tuple(locked)):
            arm.locked = now
            self._call(
                pybullet.setJointMotorControlArray,
                arm.body,
                arm.fingers,
                pybullet.VELOCITY_CONTROL,
                targetVelocities=[
                    0.0 if held else v for held, v in zip(now, arm.driven, strict=True)
                ],
                forces=[
                    LOCK if held else min(f.max_force, PRESS)
                    for held, f in zip(now, arm.facts.fingers, strict=True)
                ],
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
                way = add(way, self._carried(arm, joint, point))
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
        positions mean for it, and them; call it after every step. Where fingers are stopped on two
        sides, all are placed as the last of them: those that touch nothing push no others on."""
        states = pybullet.getJointStates(arm.body, arm.fingers, self._client)
        positions, pushed = [state[0] for state in states], set()
        for leader, members in arm.groups:
            finger = arm.facts.fingers[leader]
            means = [(positions[i] - o) / m for i, m, o in members]
            mean = sum(means) / len(members)
            drive = arm.driven[leader]
            stopped = {
                arm.ways[arm.fingers[i]][0].index
                for i, m, _ in members
                if drive and states[i][1] / m / drive < MOVES
            }
            if len(stopped) > 1:
                mean = min(means) if drive > 0 else max(means)
            position = min(max(mean, finger.lower), finger.upper)
            if all(abs(positions[i] - m * position - o) < COUPLED for i, m, o in members):
                continue
            velocity = sum([states[i][1] / m for i, m, _ in members]) / len(members)
            if position != mean:
                velocity = 0.0
                pushed.add(leader)
            for i, m, o in members:
                positions[i] = m * position + o
                self._call(
                    pybullet.resetJointState, arm.body, arm.fingers[i], positions[i], m * velocity
                )
        self._lock(arm, positions, pushed)

    def settle(self, arm: LoadedArm, body: int, *, fixed: bool) -> Vector:
        """Open the fingers that are in what they press on; return how it moves out of them, m.

        fixed: it does not move. Each link that is in it gives one equation: by how much the finger
        opens along its normal and the thing moves against it is its depth. The least such changes
        are taken.
        """
        deepest: dict[int, Any] = {}
        for p in pybullet.getClosestPoints(arm.body, body, 0.0, physicsClientId=self._client):
            grips = arm.links[p[3]] in arm.facts.grip_links
            if grips and (p[3] not in deepest or p[8] < deepest[p[3]][8]):
                deepest[p[3]] = p
        if not deepest:
            return (0.0, 0.0, 0.0)
        changes = np.zeros((len(deepest), 3 + len(arm.groups)))
        for row, (index, p) in zip(changes, deepest.items(), strict=True):
            # The normal points out of the thing.
            row[:3] = (0.0, 0.0, 0.0) if fixed else p[7]
            for way in arm.ways.get(index, ()):
                row[3 + way.group] += dot(self._carried(arm, way, p[5]), p[7])
        depths = [p[8] for p in deepest.values()]
        # In metres at the contacts, so that a finger's angle counts as a way does. What the links
        # nearly contradict each other in is left: it would throw the thing away.
        sizes = np.ones(changes.shape[1])
        sizes[3:] = np.abs(changes[:, 3:]).max(axis=0)
        sizes[sizes == 0] = 1.0
        found = np.linalg.lstsq(changes / sizes, np.array(depths), rcond=LEAST_EFFECT)[0]
        x, y, z, *ways = (found / sizes).tolist()
        self._open(arm, ways)
        return (x, y, z)

    def _open(self, arm: LoadedArm, ways: Sequence[float]) -> None:
        """Open the fingers of each leader by so much, m or rad, within their range."""
        states = self.states(arm)
        for (leader, members), way in zip(arm.groups, ways, strict=True):
            finger = arm.facts.fingers[leader]
            at = states[leader].position - finger.closes * way
            at = min(max(at, finger.lower), finger.upper)
            for i, m, o in members:
                self._call(pybullet.resetJointState, arm.body, arm.fingers[i], m * at + o, 0.0)

    def _carried(self, arm: LoadedArm, way: Way, point: Vector) -> Vector:
        """Return how a joint carries a point along while its leader closes by 1 m or rad."""
        state = pybullet.getLinkState(arm.body, way.index, 0, 0, self._client)
        axis = scale(rotate(state[5], way.axis), way.rate)
        return axis if way.slides else cross(axis, subtract(point, state[4]))


def _ways(
    arm: LoadedArm, description: Description, joint_index: dict[str, int], closes: list[float]
) -> dict[int, tuple[Way, ...]]:
    """Return how each link of a finger moves while the gripper closes."""
    rates = dict(zip((f.joint for f in description.fingers), closes, strict=True))
    for c in arm.couplings:
        leader, follower = description.fingers[c.leader], description.fingers[c.follower]
        rates[follower.joint] = closes[c.leader] * c.multiplier
        rates[leader.joint] = closes[c.leader]
    group = {
        description.fingers[i].joint: k
        for k, (_, members) in enumerate(arm.groups)
        for i, _, _ in members
    }
    ways = {}
    for link, index in arm.index.items():
        if link in description.finger_of:
            chain = description.chain(link)
            ways[index] = tuple(
                Way(joint_index[joint], *description.axis(joint), rates[joint], group[joint])
                for joint in chain
            )
    return ways


@dataclass(frozen=True)
class Way:
    """How a joint carries a finger along while the gripper closes. index: of its link; axis: unit,
    in the link's frame; rate: its share of the leader's speed, signed; group: of the leader."""

    index: int
    axis: Vector
    slides: bool
    rate: float
    group: int


@dataclass(eq=False)
class LoadedArm:
    """An arm as Bullet knows it: its numbers of body, joints and links.

    index: the number of each link. links: the link that each number counts as: what is fixed to
    a finger is that finger. made_of: its URDF, its joints, its links that never touch. ways: by
    the number of a finger's link, how it closes. present: it was moved to where it stands; before
    that nothing touches it. groups: fingers that move together: the leader, and (finger,
    multiplier, offset) of each, itself the first. driven: m/s or rad/s; locked: nothing moves it.
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
    ways: dict[int, tuple[Way, ...]] = field(default_factory=dict)
    present: bool = False
    groups: tuple[tuple[int, tuple[tuple[int, float, float], ...]], ...] = field(init=False)
    driven: tuple[float, ...] = ()
    locked: tuple[bool, ...] = ()

    def __post_init__(self) -> None:
        led = {c.follower: c for c in self.couplings}
        self.groups = tuple(
            (
                i,
                (
                    (i, 1.0, 0.0),
                    *((f, c.multiplier, c.offset) for f, c in led.items() if c.leader == i),
                ),
            )
            for i in range(len(self.fingers))
            if i not in led
        )
