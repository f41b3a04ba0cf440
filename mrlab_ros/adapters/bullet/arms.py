"""The arms of a Bullet world: multibodies posed by joint states, with force-driven fingers.

The prescribed links have such a large mass that no contact moves them. Their joints are set before
every step, with their velocities, so that an object that is hit gets the right impulse.
"""

from __future__ import annotations

import contextlib
import math
import os
import sys
import tempfile
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import pybullet

from mrlab_ros.adapters.bullet.description import Coupling, Description
from mrlab_ros.adapters.bullet.shapes import NEUTRAL, STATIC_GROUP
from mrlab_ros.core.errors import BadInput, Misuse
from mrlab_ros.core.geometry import (
    Pose,
    Quaternion,
    Vector,
    add,
    cross,
    dot,
    rotate,
    scale,
    subtract,
)
from mrlab_ros.core.physics.engine import Arm, BodyState, FingerState, LinkPairs
from mrlab_ros.core.physics.grasp_load import PAD_FRICTION

# Where the first removed arm waits, m, and how many wait at most: one costs 25 us a step.
PARKED_AT, MOST_PARKED = -500.0, 8
FAR = 1.0  # m, over which fingers are looked for
COUPLED = 1e-7  # m or rad; coupled fingers that are nearer to their places are left there
ALL_GROUPS = 0xFFFF
OBJECT_GROUP = 1  # the same of what moves
ARM_GROUP = 64  # of the arms' links: rays that look for objects pass them
# Limit of the finger force, N or N*m: what they hold is fixed to the gripper, and a light object
# between strong fingers would jitter.
PRESS = 15.0
# Joint positions, rad, far apart: links that overlap in all of them always overlap.
SAMPLES = (0.0, 0.35, -0.5, 0.8)


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


class Arms:
    """The arms of one world, by name. resolve: turns a package:// URI into a path."""

    def __init__(self, client: int, resolve: Callable[[str], Path]) -> None:
        self._client = client
        self._resolve = resolve
        self._arms: dict[str, LoadedArm] = {}
        # Those of them that have fingers.
        self._fingered: list[LoadedArm] = []
        # Arms that were removed, oldest first: Bullet keeps the shapes of a removed body.
        self._parked: list[LoadedArm] = []

    def __getitem__(self, name: str) -> LoadedArm:
        try:
            return self._arms[name]
        except KeyError:
            raise Misuse(f"physics has no arm '{name}'; add it first") from None

    def __contains__(self, name: str) -> bool:
        return name in self._arms

    def _call(self, function: Callable[..., Any], *arguments: Any, **named: Any) -> Any:
        return function(*arguments, physicsClientId=self._client, **named)

    def add(
        self, name: str, text: str, joints: tuple[str, ...], pose: Pose, apart: LinkPairs
    ) -> LoadedArm:
        """Load an arm; raise BadInput where a joint or a mesh of its URDF is missing.

        apart: pairs of its links that never touch, though their shapes may.
        """
        if name in self._arms:
            raise Misuse(f"arm '{name}' is in the world already; remove it first")
        made_of = (text, joints, apart)
        parked = next((arm for arm in self._parked if arm.made_of == made_of), None)
        if parked is not None:
            self._parked.remove(parked)
            self._arms[name] = parked
            self._list_fingered()
            parked.positions = [0.0] * len(joints)
            self.place(name, pose)
            return parked
        description = Description(text, joints, f"the description of {name}")
        body = self._load(description.text(self._resolve), pose)
        links, joint_index = {-1: description.base}, {}
        for i in range(self._call(pybullet.getNumJoints, body)):
            info = self._call(pybullet.getJointInfo, body, i)
            links[i] = info[12].decode()
            joint_index[info[1].decode()] = i
        arm = LoadedArm(
            body=body,
            facts=description.facts([1.0] * len(description.fingers)),
            joints=[joint_index[j] for j in joints],
            fingers=[joint_index[f.joint] for f in description.fingers],
            index={link: i for i, link in links.items()},
            links={i: description.finger_of.get(link, link) for i, link in links.items()},
            moving=[i for i in links if links[i] not in description.fixed_links],
            positions=[0.0] * len(joints),
            couplings=description.couplings,
            ignored=set(),
            made_of=made_of,
            followers=frozenset(c.follower for c in description.couplings),
        )
        self._free(arm)
        self._let_collide(arm, collide=False)
        for a, b in description.neighbours():
            self._ignore(arm, arm.index[a], arm.index[b])
        for pair in apart:
            if pair <= arm.index.keys():
                self._ignore(arm, *sorted(arm.index[link] for link in pair))
        self._ignore_permanent(arm)
        if arm.fingers:
            closes = self._closes(arm, description)
            arm.facts = description.facts(closes)
            arm.ways = _ways(arm, description, joint_index, closes)
        self._arms[name] = arm
        self._list_fingered()
        return arm

    def _list_fingered(self) -> None:
        self._fingered = [arm for arm in self._arms.values() if arm.fingers]

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

    def _load(self, text: str, pose: Pose) -> int:
        with tempfile.NamedTemporaryFile("w", suffix=".urdf") as file, _silent():
            file.write(text)
            file.flush()
            body: int = self._call(
                pybullet.loadURDF,
                file.name,
                pose.position,
                pose.orientation,
                useFixedBase=True,
                flags=pybullet.URDF_USE_SELF_COLLISION | pybullet.URDF_USE_INERTIA_FROM_FILE,
            )
        return body

    def _free(self, arm: LoadedArm) -> None:
        """Switch off Bullet's motors and damping of an arm."""
        driven = arm.joints + arm.fingers
        pads = {finger.link for finger in arm.facts.fingers}
        self._call(
            pybullet.setJointMotorControlArray,
            arm.body,
            driven,
            pybullet.VELOCITY_CONTROL,
            forces=[0.0] * len(driven),
        )
        for i in arm.links:
            self._call(
                pybullet.changeDynamics,
                arm.body,
                i,
                lateralFriction=PAD_FRICTION if arm.links[i] in pads else NEUTRAL,
                restitution=NEUTRAL,
                linearDamping=0.0,
                angularDamping=0.0,
                jointDamping=0.0,
                maxJointVelocity=1000.0,
            )

    def _ignore(self, arm: LoadedArm, a: int, b: int) -> None:
        arm.ignored |= {(a, b), (b, a)}
        self._call(pybullet.setCollisionFilterPair, arm.body, arm.body, a, b, 0)

    def _ignore_permanent(self, arm: LoadedArm) -> None:
        """Ignore pairs of links whose hulls overlap however the wrist and elbow are turned.

        Hulls are larger than what they cover; a pair that overlaps in each of several distant
        poses is no sign of a collision.
        """
        always: set[tuple[int, int]] | None = None
        for angle in SAMPLES:
            self._pose(arm, [angle * (1 + 0.1 * k) for k in range(len(arm.joints))])
            close = self._call(pybullet.getClosestPoints, arm.body, arm.body, 0.0)
            found = {(p[3], p[4]) for p in close if p[3] < p[4]}
            always = found if always is None else always & found
        self._pose(arm, [0.0] * len(arm.joints))
        for a, b in sorted(always or ()):
            self._ignore(arm, a, b)

    def _pose(self, arm: LoadedArm, positions: Sequence[float]) -> None:
        for joint, position in zip(arm.joints, positions, strict=True):
            self._call(pybullet.resetJointState, arm.body, joint, position)

    def place(self, name: str, pose: Pose) -> None:
        arm = self[name]
        self._call(
            pybullet.resetBasePositionAndOrientation, arm.body, pose.position, pose.orientation
        )
        # Bullet updates the links' shapes only when joints are set.
        self._pose(arm, arm.positions)

    def remove(self, name: str) -> int:
        """Remove an arm; return its body number.

        It is parked, out of reach and without contacts, until the same robot comes again.
        """
        arm = self[name]
        del self._arms[name]
        self._list_fingered()
        self._let_collide(arm, collide=False)
        place = (0.0, 0.0, PARKED_AT * (1 + len(self._parked)))
        self._call(pybullet.resetBasePositionAndOrientation, arm.body, place, (0.0, 0.0, 0.0, 1.0))
        self._pose(arm, [0.0] * len(arm.joints))
        self._parked.append(arm)
        if len(self._parked) > MOST_PARKED:
            self._call(pybullet.removeBody, self._parked.pop(0).body)
        return arm.body

    def _let_collide(self, arm: LoadedArm, *, collide: bool) -> None:
        """Let an arm's links collide, or not."""
        arm.present = collide
        for i in arm.links:
            # As for Bullet's static bodies: the base may overlap the floor.
            group, others = STATIC_GROUP, ALL_GROUPS & ~STATIC_GROUP
            if i in arm.moving:
                group, others = ARM_GROUP, ALL_GROUPS
            if not collide:
                group = others = 0
            self._call(pybullet.setCollisionFilterGroupMask, arm.body, i, group, others)

    def move(self, name: str, positions: Sequence[float], velocities: Sequence[float]) -> None:
        arm = self[name]
        if len(positions) != len(arm.joints) or len(velocities) != len(arm.joints):
            raise BadInput(
                f"{len(positions)} joint positions for {name}; expected {len(arm.joints)}"
            )
        # A sum is finite where all of it is, and a NaN or an infinity stays in it.
        if not math.isfinite(sum(positions) + sum(velocities)):
            raise BadInput(
                f"the joint state of {name} is not finite: {list(positions)}, {list(velocities)}"
            )
        arm.positions = positions
        pybullet.resetJointStatesMultiDof(
            arm.body,
            arm.joints,
            list(zip(positions)),
            list(zip(velocities)),
            physicsClientId=self._client,
        )
        if not arm.present:
            self._let_collide(arm, collide=True)

    def speed(self, name: str) -> float:
        arm = self[name]
        states = pybullet.getLinkStates(arm.body, arm.moving, 1, 0, self._client)
        return max((math.hypot(*state[6]) for state in states), default=0.0)

    def drive_fingers(self, name: str, velocities: Sequence[float]) -> None:
        arm = self[name]
        if len(velocities) != len(arm.fingers) or not all(map(math.isfinite, velocities)):
            raise BadInput(
                f"finger velocities {list(velocities)} for {name}; expected {len(arm.fingers)}"
            )
        if arm.fingers:
            self._call(
                pybullet.setJointMotorControlArray,
                arm.body,
                arm.fingers,
                pybullet.VELOCITY_CONTROL,
                targetVelocities=list(velocities),
                forces=[min(f.max_force, PRESS) for f in arm.facts.fingers],
            )

    def set_fingers(self, name: str, positions: Sequence[float]) -> None:
        arm = self[name]
        for joint, finger, position in zip(arm.fingers, arm.facts.fingers, positions, strict=True):
            if not finger.lower - 1e-3 <= position <= finger.upper + 1e-3:
                raise BadInput(
                    f"finger {finger.joint} at {position}; expected {finger.lower} to "
                    f"{finger.upper}"
                )
            self._call(pybullet.resetJointState, arm.body, joint, position, 0.0)

    def fingers(self, name: str) -> tuple[FingerState, ...]:
        arm = self[name]
        if not arm.fingers:
            return ()
        states = pybullet.getJointStates(arm.body, arm.fingers, self._client)
        return tuple(FingerState(s[0], s[3]) for s in states)

    def link(self, name: str, link: str) -> BodyState:
        arm = self[name]
        if link not in arm.index:
            raise Misuse(f"{name} has no link '{link}'; its links: {', '.join(arm.index)}")
        if arm.index[link] < 0:
            at = self._call(pybullet.getBasePositionAndOrientation, arm.body)
            return BodyState(Pose(*at))
        state = pybullet.getLinkState(arm.body, arm.index[link], 1, 1, self._client)
        return BodyState(Pose(state[0], state[1]), state[6], state[7])

    def let_touch(self, name: str, other: int, touch: bool) -> None:
        """Switch contacts between an arm's hand with its fingers and an object on or off."""
        arm = self[name]
        for link in arm.facts.grip_links:
            self._call(
                pybullet.setCollisionFilterPair, arm.body, other, arm.index[link], -1, int(touch)
            )

    def let_pass(self, arm: LoadedArm, links: Sequence[int], other: int, passes: bool) -> None:
        """Switch contacts between links of an arm and an object off (`passes`) or on."""
        for link in links:
            self._call(pybullet.setCollisionFilterPair, arm.body, other, link, -1, int(not passes))

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
        if arm.links[link] not in arm.facts.tool_links:
            return 0.0
        tool = self.tool(arm)
        return -dot(rotate(tool, (0.0, 0.0, 1.0)), normal)

    def tool(self, arm: LoadedArm) -> Quaternion:
        """Return the orientation of an arm's tool frame."""
        state = pybullet.getLinkState(arm.body, arm.index[arm.facts.tool], 0, 0, self._client)
        turn: Quaternion = state[5]
        return turn

    def velocity_at(self, arm: LoadedArm, link: int, point: Vector) -> Vector:
        """Return the velocity of a link at a point, m/s."""
        if link < 0:
            return (0.0, 0.0, 0.0)
        state = pybullet.getLinkState(arm.body, link, 1, 0, self._client)
        return add(state[6], cross(state[7], subtract(point, state[0])))

    def stepped(self) -> None:
        """Keep coupled fingers equally far closed; call it after every step."""
        for arm in self._fingered:
            self._couple(arm)

    def _couple(self, arm: LoadedArm) -> None:
        """Keep fingers in their ranges; place each leader at the mean of what its followers'
        positions mean for it, and them."""
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


@contextlib.contextmanager
def _silent() -> Iterator[None]:
    """Suppress what Bullet prints on stdout while it loads."""
    sys.stdout.flush()
    saved, nowhere = os.dup(1), os.open(os.devnull, os.O_WRONLY)
    try:
        os.dup2(nowhere, 1)
        yield
    finally:
        os.dup2(saved, 1)
        os.close(saved)
        os.close(nowhere)
