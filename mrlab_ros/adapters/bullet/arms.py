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
from pathlib import Path
from typing import Any

from mrlab_ros.adapters.bullet.description import Description
from mrlab_ros.adapters.bullet.diagnostics import NO_LINK, NOT_IN_WORLD
from mrlab_ros.adapters.bullet.fingers import Fingers, LoadedArm
from mrlab_ros.adapters.bullet.quiet import pybullet
from mrlab_ros.adapters.bullet.shapes import NEUTRAL, STATIC_GROUP
from mrlab_ros.core.base.errors import BadInput, Misuse
from mrlab_ros.core.base.geometry import Pose, Vector, add, cross, subtract
from mrlab_ros.core.physics.diagnostics import (
    ALREADY_IN_WORLD,
    JOINT_STATE_BEYOND,
    JOINT_STATE_SIZE,
)
from mrlab_ros.core.physics.engine import BodyState, LinkPairs
from mrlab_ros.core.physics.grasp.kinds import PAD_FRICTION

# Height of the first removed arm, m, and most removed arms that wait: one costs 25 us a step.
PARKED_AT, MOST_PARKED = -500.0, 8
ALL_GROUPS = 0xFFFF
OBJECT_GROUP = 1  # the same of what moves
ARM_GROUP = 64  # of the arms' links: rays that look for objects pass them
# Joint positions, rad, far apart: links that overlap in all of them always overlap.
SAMPLES = (0.0, 0.35, -0.5, 0.8)


class Arms:
    """The arms of one world, by name. resolve: turns a package:// URI into a path."""

    def __init__(self, client: int, resolve: Callable[[str], Path], fingers: Fingers) -> None:
        self._client = client
        self._fingers = fingers
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
            raise Misuse(NOT_IN_WORLD(name=name)) from None

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
            raise Misuse(ALREADY_IN_WORLD(name=name))
        made_of = (text, joints, apart)
        parked = next((arm for arm in self._parked if arm.made_of == made_of), None)
        if parked is not None:
            self._parked.remove(parked)
            self._arms[name] = parked
            self._list_fingered()
            parked.positions = [0.0] * len(joints)
            self.place(name, pose)
            return parked
        description = Description(text, joints, name)
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
            self._fingers.find_closing(arm, description, joint_index)
        self._arms[name] = arm
        self._list_fingered()
        return arm

    def _list_fingered(self) -> None:
        self._fingered = [arm for arm in self._arms.values() if arm.fingers]

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
        if not len(positions) == len(velocities) == len(arm.joints):
            raise BadInput(
                JOINT_STATE_SIZE(
                    robot=name,
                    positions=len(positions),
                    velocities=len(velocities),
                    joints=len(arm.joints),
                )
            )
        # A sum is finite where all of it is, and a NaN or an infinity stays in it.
        if not math.isfinite(sum(positions) + sum(velocities)):
            raise BadInput(JOINT_STATE_BEYOND(robot=name))
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

    def link(self, name: str, link: str) -> BodyState:
        arm = self[name]
        if link not in arm.index:
            raise Misuse(NO_LINK(robot=name, link=link, known=[*arm.index]))
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

    def velocity_at(self, arm: LoadedArm, link: int, point: Vector) -> Vector:
        """Return the velocity of a link at a point, m/s."""
        if link < 0:
            return (0.0, 0.0, 0.0)
        state = pybullet.getLinkState(arm.body, link, 1, 0, self._client)
        return add(state[6], cross(state[7], subtract(point, state[0])))

    def stepped(self) -> None:
        """Keep coupled fingers equally far closed; call it after every step."""
        for arm in self._fingered:
            self._fingers.couple(arm)


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
