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
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pybullet

from mrlab_ros.adapters.bullet.description import Coupling, Description
from mrlab_ros.adapters.bullet.shapes import NEUTRAL
from mrlab_ros.core.errors import BadInput, Misuse
from mrlab_ros.core.geometry import Pose
from mrlab_ros.core.physics.engine import Arm, BodyState, FingerState, LinkPairs

FINGER_FRICTION = 1.5
ALL_GROUPS = 0xFFFF
STATIC_GROUP = 2  # Bullet's own collision group of what never moves
# Limit of the finger force, N or N*m: what they hold is fixed to the gripper, and a light object
# between strong fingers would jitter.
PRESS = 15.0
# Joint positions, rad, far apart: links that overlap in all of them always overlap.
SAMPLES = (0.0, 0.35, -0.5, 0.8)


@dataclass(eq=False)
class LoadedArm:
    """An arm as Bullet knows it: its numbers of body, joints and links.

    index: the number of each link. links: the link that each number counts as: what is fixed to
    a finger is that finger.
    """

    body: int
    facts: Arm
    joints: list[int]
    fingers: list[int]
    index: dict[str, int]
    links: dict[int, str]
    moving: list[int]
    positions: list[float]
    couplings: tuple[Coupling, ...]
    ignored: set[tuple[int, int]]
    driven: bool = False


class Arms:
    """The arms of one world, by name. resolve: turns a package:// URI into a path."""

    def __init__(self, client: int, resolve: Callable[[str], Path]) -> None:
        self._client = client
        self._resolve = resolve
        self._arms: dict[str, LoadedArm] = {}

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
        description = Description(text, joints, f"the description of {name}")
        body = self._load(description.text(self._resolve), pose)
        links, joint_index = {-1: description.base}, {}
        for i in range(self._call(pybullet.getNumJoints, body)):
            info = self._call(pybullet.getJointInfo, body, i)
            links[i] = info[12].decode()
            joint_index[info[1].decode()] = i
        arm = LoadedArm(
            body=body,
            facts=description.facts(),
            joints=[joint_index[j] for j in joints],
            fingers=[joint_index[f.joint] for f in description.fingers],
            index={link: i for i, link in links.items()},
            links={i: description.finger_of.get(link, link) for i, link in links.items()},
            moving=[i for i in links if links[i] not in description.fixed_links],
            positions=[0.0] * len(joints),
            couplings=description.couplings,
            ignored=set(),
        )
        self._free(arm)
        for link in sorted(description.fixed_links):
            # As for Bullet's static bodies: the base may overlap the floor.
            others = ALL_GROUPS & ~STATIC_GROUP
            self._call(
                pybullet.setCollisionFilterGroupMask, body, arm.index[link], STATIC_GROUP, others
            )
        for a, b in description.neighbours():
            self._ignore(arm, arm.index[a], arm.index[b])
        for pair in apart:
            if pair <= arm.index.keys():
                self._ignore(arm, *sorted(arm.index[link] for link in pair))
        self._ignore_permanent(arm)
        self._arms[name] = arm
        return arm

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
                lateralFriction=FINGER_FRICTION if i in arm.fingers else NEUTRAL,
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

    def _pose(self, arm: LoadedArm, positions: list[float]) -> None:
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
        """Remove an arm; return its body number."""
        body = self[name].body
        del self._arms[name]
        self._call(pybullet.removeBody, body)
        return body

    def move(self, name: str, positions: Sequence[float], velocities: Sequence[float]) -> None:
        arm = self[name]
        if len(positions) != len(arm.joints) or len(velocities) != len(arm.joints):
            raise BadInput(
                f"{len(positions)} joint positions for {name}; expected {len(arm.joints)}"
            )
        if not (all(map(math.isfinite, positions)) and all(map(math.isfinite, velocities))):
            raise BadInput(
                f"the joint state of {name} is not finite: {list(positions)}, {list(velocities)}"
            )
        arm.positions = list(positions)
        pybullet.resetJointStatesMultiDof(
            arm.body,
            arm.joints,
            [(q,) for q in positions],
            [(v,) for v in velocities],
            physicsClientId=self._client,
        )

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
        arm.driven = any(velocities)
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
        """Switch contacts between the links of an arm and an object on or off."""
        arm = self[name]
        for link in arm.links:
            self._call(pybullet.setCollisionFilterPair, arm.body, other, link, -1, int(touch))

    def stepped(self) -> None:
        """Keep coupled fingers equally far closed; call it after every step."""
        for arm in self._arms.values():
            if arm.couplings and arm.driven:
                self._couple(arm)

    def _couple(self, arm: LoadedArm) -> None:
        """Place each leader at the mean of what its followers' positions mean for it, and them."""
        states = self._call(pybullet.getJointStates, arm.body, arm.fingers)
        led: dict[int, list[tuple[int, float, float]]] = {}
        for c in arm.couplings:
            led.setdefault(c.leader, [(c.leader, 1.0, 0.0)]).append(
                (c.follower, c.multiplier, c.offset)
            )
        for members in led.values():
            position = _mean([(states[i][0] - o) / m for i, m, o in members])
            velocity = _mean([states[i][1] / m for i, m, _ in members])
            for i, m, o in members:
                self._call(
                    pybullet.resetJointState,
                    arm.body,
                    arm.fingers[i],
                    m * position + o,
                    m * velocity,
                )


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
