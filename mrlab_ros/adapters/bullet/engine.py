"""The physics engine port on pybullet.

Bullet ends the process on bad input, so everything is checked before it is called.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from pathlib import Path

from mrlab_ros.adapters.bullet.arms import OBJECT_GROUP, Arms
from mrlab_ros.adapters.bullet.contacts import Contacts, Holding
from mrlab_ros.adapters.bullet.diagnostics import BAD_STEP, WORLDS_FULL
from mrlab_ros.adapters.bullet.fingers import Fingers
from mrlab_ros.adapters.bullet.objects import Objects
from mrlab_ros.adapters.bullet.quiet import pybullet
from mrlab_ros.adapters.bullet.shapes import STATIC_GROUP, make_body, make_shape, mass_frame
from mrlab_ros.core.base.errors import BadInput, Misuse
from mrlab_ros.core.base.geometry import Pose, Vector, add, compose
from mrlab_ros.core.physics.diagnostics import ALREADY_IN_WORLD
from mrlab_ros.core.physics.engine import (
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
# Rounds in which fingers come out of what they press on: those that turn need some.
SETTLED_IN = 3
RAY = 100.0  # m, length of the ray that searches the support below a point
# At most: a tower of ten needs that many to stand, and all else few.
SOLVER_ITERATIONS = 200
# (m/s)^2: the solver stops when no velocity changes by more than 1 mm/s.
SOLVER_RESIDUAL = 1e-6


class BulletEngine:
    """Implements mrlab_ros.core.physics.engine.Engine.

    resolve: turns a package:// URI into a path. One engine is one world of its own.
    """

    def __init__(self, resolve: Callable[[str], Path], gravity: float = GRAVITY) -> None:
        self._client = pybullet.connect(pybullet.DIRECT)
        if self._client < 0:
            raise Misuse(WORLDS_FULL())
        self._duration = math.nan
        pybullet.setPhysicsEngineParameter(
            numSolverIterations=SOLVER_ITERATIONS,
            solverResidualThreshold=SOLVER_RESIDUAL,
            deterministicOverlappingPairs=1,
            physicsClientId=self._client,
        )
        self._fingers = Fingers(self._client)
        self._arms = Arms(self._client, resolve, self._fingers)
        self._objects = Objects(self._client, gravity)
        self._surfaces: dict[str, int] = {}
        self._names: dict[int, tuple[Kind, str]] = {}
        self._holding = Holding(self._arms, self._objects)
        self._contacts = Contacts(
            self._client,
            self._arms,
            self._fingers,
            self._objects,
            self._holding,
            self._names,
            self._surfaces,
        )

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
        self._holding.forget_arm(name)
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
        return max(self._arms.speed(name), self._holding.speed(name))

    def drive_fingers(self, name: str, velocities: Sequence[float]) -> None:
        self._fingers.drive(name, self._arms[name], velocities)

    def set_fingers(self, name: str, positions: Sequence[float]) -> None:
        self._fingers.place(self._arms[name], positions)

    def settle(self, name: str, thing: str) -> None:
        arm, body = self._arms[name], self._objects.body(thing)
        for _ in range(SETTLED_IN):
            way = self._fingers.settle(arm, body, fixed=thing in self._holding.held)
            if way != (0.0, 0.0, 0.0):
                at = self._objects.motion(thing).pose
                moved = Pose(add(at.position, way), at.orientation)
                self._objects.set_motion(thing, BodyState(moved))

    def fingers(self, name: str) -> tuple[FingerState, ...]:
        return self._fingers.states(self._arms[name])

    def link(self, arm: str, link: str) -> BodyState:
        return self._arms.link(arm, link)

    # contacts and distances -----------------------------------------------------------------

    def touches(self, name: str) -> list[Touch]:
        return self._contacts.touches(name, self._duration)

    def squeezed(self, arm: str, name: str, normal: Vector) -> Vector:
        return self._contacts.squeezed(arm, name, normal)

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
        return self._contacts.nearest(arm, kind, other, limit, without)

    # objects and surfaces -------------------------------------------------------------------

    def add_object(self, name: str, body: Body, motion: BodyState) -> None:
        self._names[self._objects.add(name, body, motion)] = (Kind.OBJECT, name)

    def remove_object(self, name: str) -> None:
        self._holding.forget_object(name)
        del self._names[self._objects.remove(name)]

    def object(self, name: str) -> BodyState:
        held = self._holding.held.get(name)
        # Bullet has moved the body on, to the end of the step.
        return held.motion if held is not None else self._objects.motion(name)

    def objects(self) -> dict[str, BodyState]:
        found = self._objects.motions()
        for name, held in self._holding.held.items():
            found[name] = held.motion
        return found

    def set_object(self, name: str, motion: BodyState) -> None:
        self._objects.set_motion(name, motion)
        if name in self._holding.held:
            self._holding.held[name].motion = motion

    def add_surface(self, name: str, body: Body, pose: Pose) -> None:
        if name in self._surfaces:
            raise Misuse(ALREADY_IN_WORLD(name=name))
        # A shape that is not centred is a compound, which is slower in every step.
        frame, _ = mass_frame(body)
        shape = make_shape(self._client, body, frame)
        self._surfaces[name] = make_body(self._client, body, shape, compose(pose, frame))
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
        self._holding.hold(arm, link, name, mass)

    def slide(self, name: str, way: Vector) -> None:
        self._holding.slide(name, way)

    def release(self, name: str) -> None:
        self._holding.release(name)

    def let_pass(self, arm: str, name: str, passes: bool) -> None:
        self._holding.let_pass(arm, name, passes)

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
                raise BadInput(BAD_STEP(step=duration))
            self._duration = duration
            pybullet.setTimeStep(duration, self._client)
        if self._holding.held:
            self._holding.carry(duration)
        pybullet.stepSimulation(self._client)
        self._arms.stepped()
        self._objects.stepped()
