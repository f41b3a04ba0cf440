"""The physics engine port on pybullet.

Bullet ends the process on bad input, so everything is checked before it is called. Held
objects are kinematic: posed with the gripper's velocity before every step.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import pybullet

from mrlab_ros.adapters.bullet.arms import OBJECT_GROUP, Arms
from mrlab_ros.adapters.bullet.objects import Objects
from mrlab_ros.adapters.bullet.shapes import STATIC_GROUP, make_body, make_shape
from mrlab_ros.core.errors import BadInput, Misuse
from mrlab_ros.core.geometry import (
    Pose,
    Vector,
    add,
    compose,
    cross,
    dot,
    relative,
    scale,
    subtract,
)
from mrlab_ros.core.physics.engine import (
    IDENTITY,
    Arm,
    Body,
    BodyState,
    FingerState,
    Hit,
    Kind,
    LinkPairs,
    Near,
    Touch,
)

GRAVITY = 9.80665  # m/s^2, the standard value
RAY = 100.0  # m, length of the ray that searches the support below a point
SOLVER_ITERATIONS = 30
# Cosine between two contacts of an object from which on it is squeezed between them: 60 degrees.
OPPOSITE = 0.5
# (m/s)^2: the solver stops when no velocity changes by more than 1 mm/s.
SOLVER_RESIDUAL = 1e-6


@dataclass(eq=False)
class HeldObject:
    """What an arm's link holds. offset: T_link_object. motion: at the instant that the arm was
    posed for."""

    arm: str
    link: str
    offset: Pose
    motion: BodyState


class BulletEngine:
    """Implements mrlab_ros.core.physics.engine.Engine.

    resolve: turns a package:// URI into a path. One engine is one world of its own.
    """

    def __init__(self, resolve: Callable[[str], Path], gravity: float = GRAVITY) -> None:
        self._client = pybullet.connect(pybullet.DIRECT)
        if self._client < 0:
            raise Misuse("pybullet has no room for another world; close one first")
        self._duration = math.nan
        pybullet.setPhysicsEngineParameter(
            numSolverIterations=SOLVER_ITERATIONS,
            solverResidualThreshold=SOLVER_RESIDUAL,
            deterministicOverlappingPairs=1,
            physicsClientId=self._client,
        )
        self._arms = Arms(self._client, resolve)
        self._objects = Objects(self._client, gravity)
        self._surfaces: dict[str, int] = {}
        self._names: dict[int, tuple[Kind, str]] = {}
        self._held: dict[str, HeldObject] = {}
        # Arms that pass into objects, by name.
        self._passing: set[tuple[str, str]] = set()

    def close(self) -> None:
        if self._client >= 0:
            pybullet.disconnect(self._client)
            self._client = -1

    # arms -----------------------------------------------------------------------------------

    def add_arm(
        self,
        name: str,
        urdf: str,
        joints: tuple[str, ...],
        pose: Pose,
        apart: LinkPairs = frozenset(),
    ) -> Arm:
        """Load an arm; raise BadInput where a joint or a mesh of its URDF is missing."""
        arm = self._arms.add(name, urdf, joints, pose, apart)
        self._names[arm.body] = (Kind.ROBOT, name)
        return arm.facts

    def place_arm(self, name: str, pose: Pose) -> None:
        self._objects.wake_touching(self._arms[name].body)
        self._arms.place(name, pose)

    def remove_arm(self, name: str) -> None:
        for held in self._held_by(name):
            self.release(held)
        for arm, thing in sorted(self._passing):
            if arm == name:
                self.let_pass(arm, thing, False)
        self._objects.wake_touching(self._arms[name].body)
        del self._names[self._arms.remove(name)]

    def move_arm(
        self,
        name: str,
        positions: Sequence[float],
        velocities: Sequence[float],
        *,
        jumped: bool = False,
    ) -> None:
        self._arms.move(name, positions, velocities)
        if jumped:
            # Objects that rested on the arm must wake up.
            self._objects.wake_touching(self._arms[name].body)

    def speed(self, name: str) -> float:
        fastest = self._arms.speed(name)
        for held in self._held_by(name):
            hand = self.link(name, self._held[held].link)
            low, high = self._objects.bounds(held)
            for x, y, z in itertools.product(*zip(low, high, strict=True)):
                way = subtract((x, y, z), hand.pose.position)
                fastest = max(fastest, math.hypot(*add(hand.linear, cross(hand.angular, way))))
        return fastest

    def drive_fingers(self, name: str, velocities: Sequence[float]) -> None:
        self._arms.drive_fingers(name, velocities)

    def set_fingers(self, name: str, positions: Sequence[float]) -> None:
        self._arms.set_fingers(name, positions)

    def fingers(self, name: str) -> tuple[FingerState, ...]:
        return self._arms.fingers(name)

    def link(self, arm: str, link: str) -> BodyState:
        return self._arms.link(arm, link)

    def touches(self, name: str) -> list[Touch]:
        arm = self._arms[name]
        found: list[Touch] = []
        # Bullet orders every contact so that the body in the query comes first.
        for p in pybullet.getContactPoints(arm.body, physicsClientId=self._client):
            # Bodies that press on each other may be a little apart.
            if p[8] > 0.0 and p[9] <= 0.0:
                continue
            kind, other = self._names[p[2]]
            other_link = ""
            if kind is Kind.ROBOT:
                other_link = self._arms[other].links[p[4]]
                kind = Kind.SELF if p[2] == arm.body else Kind.ROBOT
            depth, impulse = max(-p[8], 0.0), p[9] * self._duration
            if kind is Kind.OBJECT and other in self._held and self._held[other].arm == name:
                # The held object reports it, as a contact of its own.
                continue
            grip = self._arms.grip(arm, p[3], p[5], p[7]) if kind is Kind.OBJECT else 0.0
            found.append(
                Touch(
                    arm.links[p[3]], kind, other, other_link, p[5], p[7], depth, impulse, "", grip
                )
            )
        if self._held:
            for held in self._held_by(name):
                found += self._held_touches(name, held)
        if self._passing:
            found += self._passed(name)
        return found

    def _passed(self, name: str) -> list[Touch]:
        """Return where an arm and what it holds are inside of what they pass into."""
        arm, found = self._arms[name], []
        for passing, other in sorted(self._passing):
            if passing != name:
                continue
            body = self._objects.body(other)
            close = pybullet.getClosestPoints(arm.body, body, 0.0, physicsClientId=self._client)
            for p in close:
                if p[3] in arm.moving and (other not in self._held):
                    grip = self._arms.grip(arm, p[3], p[5], p[7])
                    link = arm.links[p[3]]
                    found.append(
                        Touch(link, Kind.OBJECT, other, "", p[5], p[7], -p[8], 0.0, "", grip)
                    )
            for held in self._held_by(name):
                close = pybullet.getClosestPoints(
                    self._objects.body(held), body, 0.0, physicsClientId=self._client
                )
                link = self._held[held].link
                found += [
                    Touch(link, Kind.OBJECT, other, "", p[5], p[7], -p[8], 0.0, held)
                    for p in close
                    if held != other
                ]
        return found

    def squeezed(self, arm: str, name: str, normal: Vector) -> Vector:
        own = {self._arms[arm].body, *(self._objects.body(h) for h in self._held_by(arm))}
        body, client = self._objects.body(name), self._client
        points = pybullet.getContactPoints(body, physicsClientId=client)
        others = {p[2] for p in points if p[2] not in own and dot(p[7], normal) > OPPOSITE}
        deepest, way = 0.0, (0.0, 0.0, 0.0)
        for other in sorted(others):
            # The contact points are those of before the step.
            for p in pybullet.getClosestPoints(body, other, 0.0, physicsClientId=client):
                if -p[8] > deepest and dot(p[7], normal) > OPPOSITE:
                    deepest, way = -p[8], scale(p[7], -p[8])
        return way

    def let_pass(self, arm: str, name: str, passes: bool) -> None:
        loaded, body = self._arms[arm], self._objects.body(name)
        if passes:
            self._passing.add((arm, name))
        else:
            self._passing.discard((arm, name))
        own = self._held[name].arm == arm if name in self._held else False
        links = [
            i for i in loaded.moving if not (own and loaded.links[i] in loaded.facts.grip_links)
        ]
        self._arms.let_pass(loaded, links, body, passes)
        for held in self._held_by(arm):
            if held != name:
                self._objects.let_pass(held, body, passes)

    def _held_by(self, name: str) -> list[str]:
        return [held for held, known in self._held.items() if known.arm == name]

    def _held_touches(self, name: str, held: str) -> list[Touch]:
        """Return the contact points of what an arm holds, as contacts of the arm."""
        known, found = self._held[held], []
        body, motion = self._objects.body(held), known.motion
        for p in pybullet.getContactPoints(body, physicsClientId=self._client):
            if p[8] > 0.0 and p[9] <= 0.0:
                continue
            kind, other = self._names[p[2]]
            other_link, grip = "", 0.0
            way = subtract(p[5], motion.pose.position)
            velocity = add(motion.linear, cross(motion.angular, way))
            if kind is Kind.ROBOT:
                arm = self._arms[other]
                other_link = arm.links[p[4]]
                # The normal points from the other robot to what is held: against its finger.
                grip = self._arms.grip(arm, p[4], p[6], scale(p[7], -1.0))
                velocity = subtract(velocity, self._arms.velocity_at(arm, p[4], p[6]))
                kind = Kind.SELF if other == name else Kind.ROBOT
            elif kind is Kind.OBJECT and other in self._held:
                other_motion = self._held[other].motion
                way = subtract(p[6], other_motion.pose.position)
                moved = add(other_motion.linear, cross(other_motion.angular, way))
                velocity = subtract(velocity, moved)
            depth, impulse = max(-p[8], 0.0), p[9] * self._duration
            found.append(
                Touch(
                    known.link, kind, other, other_link, p[5], p[7], depth, impulse, held, grip,
                    -dot(velocity, p[7]),
                )
            )  # fmt: skip
        return found

    def distance(self, arm: str, kind: Kind, other: str, limit: float) -> float:
        near = self.nearest(arm, kind, other, limit)
        return limit if near is None else near.distance

    def nearest(
        self,
        arm: str,
        kind: Kind,
        other: str,
        limit: float,
        without: frozenset[str] = frozenset(),
    ) -> Near | None:
        robot = self._arms[arm]
        body = self._body(kind, other)
        if body is None:
            return None
        own = kind is Kind.SELF
        nearest, least, held_nearest = None, limit, ""
        close = pybullet.getClosestPoints(robot.body, body, limit, physicsClientId=self._client)
        for p in close:
            if own and (p[3] == p[4] or (p[3], p[4]) in robot.ignored):
                continue
            if p[8] >= least or not (own or p[3] in robot.moving):
                continue
            if robot.links[p[3]] not in without:
                nearest, least = p, p[8]
        for held in self._held_by(arm):
            if (kind, other) != (Kind.OBJECT, held) and not own and held not in without:
                near = pybullet.getClosestPoints(
                    self._objects.body(held), body, limit, physicsClientId=self._client
                )
                for p in near:
                    if p[8] < least:
                        nearest, least, held_nearest = p, p[8], held
        if nearest is None:
            return None
        link = self._held[held_nearest].link if held_nearest else robot.links[nearest[3]]
        others = self._arms[other].links if kind in (Kind.ROBOT, Kind.SELF) else {}
        return Near(least, link, held_nearest, others.get(nearest[4], ""))

    def _body(self, kind: Kind, name: str) -> int | None:
        if kind is Kind.OBJECT:
            return self._objects.body(name) if name in self._objects else None
        if kind is Kind.SURFACE:
            return self._surfaces.get(name)
        return self._arms[name].body if name in self._arms else None

    # objects and surfaces -------------------------------------------------------------------

    def add_object(self, name: str, body: Body, motion: BodyState) -> None:
        self._names[self._objects.add(name, body, motion)] = (Kind.OBJECT, name)

    def remove_object(self, name: str) -> None:
        if name in self._held:
            self.release(name)
        for arm, thing in sorted(self._passing):
            if thing == name:
                self.let_pass(arm, thing, False)
        del self._names[self._objects.remove(name)]

    def object(self, name: str) -> BodyState:
        held = self._held.get(name)
        # Bullet has moved the body on, to the end of the step.
        return held.motion if held is not None else self._objects.motion(name)

    def objects(self) -> dict[str, BodyState]:
        found = self._objects.motions()
        for name, held in self._held.items():
            found[name] = held.motion
        return found

    def set_object(self, name: str, motion: BodyState) -> None:
        self._objects.set_motion(name, motion)
        if name in self._held:
            self._held[name].motion = motion

    def add_surface(self, name: str, body: Body, pose: Pose) -> None:
        if name in self._surfaces:
            raise Misuse(f"surface '{name}' is in the world already; remove it first")
        if len(body.parts) == 1:
            # A shape that is not centred is a compound, which is slower in every step.
            (part,) = body.parts
            pose = compose(pose, part.pose)
            body = replace(body, parts=(replace(part, pose=IDENTITY),))
        shape = make_shape(self._client, body)
        self._surfaces[name] = make_body(self._client, body, shape, pose)
        self._names[self._surfaces[name]] = (Kind.SURFACE, name)
        self._objects.wake_all()

    def remove_surface(self, name: str) -> None:
        body = self._surfaces.pop(name)
        del self._names[body]
        pybullet.removeBody(body, physicsClientId=self._client)
        self._objects.wake_all()

    # holding --------------------------------------------------------------------------------

    def hold(self, arm: str, link: str, name: str, mass: float = 0.0) -> None:
        """Fix an object to an arm's link; mass: kg that others feel, 0: it does not give way."""
        body = self._objects.body(name)
        hand = self.link(arm, link).pose
        if name in self._held:
            self.release(name)
        motion = self._objects.motion(name)
        self._held[name] = HeldObject(arm, link, relative(hand, motion.pose), motion)
        self._objects.grip(name, mass)
        self._arms.let_touch(arm, body, False)

    def slide(self, name: str, way: Vector) -> None:
        held = self._held[name]
        held.offset = Pose(add(held.offset.position, way), held.offset.orientation)

    def release(self, name: str) -> None:
        arm = self._held.pop(name).arm
        for passing, thing in self._passing:
            if passing == arm and thing != name:
                self._objects.let_pass(name, self._objects.body(thing), False)
        self._objects.loosen(name)
        self._arms.let_touch(arm, self._objects.body(name), True)
        if (arm, name) in self._passing:
            self.let_pass(arm, name, True)

    def _carry(self, duration: float) -> None:
        """Pose what is held with its gripper and set its velocity: a rigid constraint."""
        for name, held in self._held.items():
            hand = self.link(held.arm, held.link)
            pose = compose(hand.pose, held.offset)
            way = subtract(pose.position, hand.pose.position)
            linear = add(hand.linear, cross(hand.angular, way))
            held.motion = BodyState(pose, linear, hand.angular)
            self._objects.move_held(name, held.motion, duration)

    # space and time -------------------------------------------------------------------------

    def below(self, point: Vector) -> float | None:
        x, y, z = point
        hits = pybullet.rayTestBatch(
            [(x, y, z)],
            [(x, y, z - RAY)],
            collisionFilterMask=STATIC_GROUP,
            physicsClientId=self._client,
        )
        body, _, _, hit, _ = hits[0]
        return None if body < 0 else float(hit[2])

    def rays(
        self, name: str, starts: Sequence[Vector], ends: Sequence[Vector]
    ) -> list[Hit | None]:
        body = self._objects.body(name)
        found = pybullet.rayTestBatch(
            starts,
            ends,
            collisionFilterMask=OBJECT_GROUP,
            physicsClientId=self._client,
        )
        return [Hit(hit[2], hit[4]) if hit[0] == body else None for hit in found]

    def overlapping(self, low: Vector, high: Vector) -> set[str]:
        found = pybullet.getOverlappingObjects(low, high, self._client) or ()
        names = (self._names[body] for body, _ in found if body in self._names)
        return {name for kind, name in names if kind is not Kind.SURFACE}

    def step(self, duration: float) -> None:
        if duration != self._duration:
            if not 1e-5 <= duration <= 0.1:
                raise BadInput(f"a step of {duration} s; expected 1e-5 to 0.1 s")
            self._duration = duration
            pybullet.setTimeStep(duration, self._client)
        if self._held:
            self._carry(duration)
        pybullet.stepSimulation(self._client)
        self._arms.stepped()
        self._objects.stepped()
