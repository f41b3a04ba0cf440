"""The objects of a Bullet world: gravity acts on them alone, and objects at rest sleep.

Bullet puts objects at rest to sleep, with all they touch, and wakes them when something awake
touches them. It does not notice a support that is removed or placed elsewhere: then the objects
near it are woken here.
"""

from __future__ import annotations

import math

from mrlab_ros.adapters.bullet.diagnostics import NO_SPEED, NOT_IN_WORLD
from mrlab_ros.adapters.bullet.quiet import pybullet
from mrlab_ros.adapters.bullet.shapes import (
    STATIC_GROUP,
    least,
    make_body,
    make_shape,
    mass_frame,
)
from mrlab_ros.core.base.errors import BadInput, Misuse
from mrlab_ros.core.base.geometry import (
    Pose,
    Quaternion,
    Vector,
    add,
    compose,
    cross,
    dot,
    inverse,
    rotate,
    scale,
    subtract,
)
from mrlab_ros.core.physics.diagnostics import ALREADY_IN_WORLD
from mrlab_ros.core.physics.engine import IDENTITY, Body, BodyState, Shape

# An object slower than this, m/s and rad/s, for two seconds (fixed in Bullet) falls asleep.
REST = 0.01
# Mass of a held object, kg: no contact moves it.
HELD_MASS = 1e6
# A support that moved less than this, m, still supports.
NUDGE = 1e-5
# Half of the least extent, m, below which an object is thin.
THIN = 0.004
# A way of its centre, m, that is looked at: less than half of a sheet of 1 mm.
LOOKED_AT = 0.0003
# A surface is this share of half of its thickness away from the centre of what has not sunk in.
SUNK = 0.8
MAX_SPEED = 1000.0  # m/s and rad/s


class Objects:
    """The objects of one world, by name. gravity: m/s^2."""

    def __init__(self, client: int, gravity: float) -> None:
        self._client = client
        self._gravity = gravity
        self._bodies: dict[str, int] = {}
        # One for each body of the catalogue, reused by all objects of that type.
        self._shapes: dict[Body, int] = {}
        self._masses: dict[int, float] = {}
        self._held: set[int] = set()
        # Centre of each thin object at the last test of its way, and half of its thickness as a
        # vector in its frame; zeros where it has several parts.
        self._thin: dict[int, tuple[Vector, Vector]] = {}
        # T_object_body where Bullet's frame, at the centre of mass, is not the object's.
        self._frames: dict[int, Pose] = {}
        self._moments: dict[int, Vector] = {}
        # Pose of each body as last read, and what that means for its object. A sleeping one keeps
        # its pose exactly.
        self._read: dict[int, tuple[Vector, Quaternion, BodyState]] = {}

    def __contains__(self, name: str) -> bool:
        return name in self._bodies

    def body(self, name: str) -> int:
        try:
            return self._bodies[name]
        except KeyError:
            raise Misuse(NOT_IN_WORLD(name=name)) from None

    def add(self, name: str, body: Body, motion: BodyState) -> int:
        """Put an object into the world; return Bullet's number of it."""
        if name in self._bodies:
            raise Misuse(ALREADY_IN_WORLD(name=name))
        _check(name, motion)
        frame, moments = mass_frame(body)
        made = self._make_weighted(body, frame, compose(motion.pose, frame))
        self._bodies[name] = made
        if frame != IDENTITY:
            self._frames[made] = frame
        if body.mass:
            self._masses[made] = body.mass
            if moments is not None:
                self._moments[made] = moments
            self._weigh(made, body.mass)
            if min(map(least, body.parts)) < THIN:
                self._thin[made] = compose(motion.pose, frame).position, _thickness(body)
            self._change(made, pybullet.ACTIVATION_STATE_ENABLE_SLEEPING, REST)
            self._set_velocity(made, self._of_body(made, motion))
        else:
            self.wake_near(made)
        return made

    def _make_weighted(self, body: Body, frame: Pose, pose: Pose) -> int:
        """Make a body to which gravity applies. frame: of its shape; pose: where that is.

        The arms must know none, so the world has none: it would turn their velocities off
        between two steps. Bullet hands a change of the world's gravity on to bodies that are
        awake, and bodies that are new have the world's.
        """
        client = self._client
        if body not in self._shapes:
            self._shapes[body] = make_shape(client, body, frame)
        try:
            for other in self._masses:
                self._change(other, pybullet.ACTIVATION_STATE_SLEEP)
            pybullet.setGravity(0.0, 0.0, -self._gravity, physicsClientId=client)
            made = make_body(client, body, self._shapes[body], pose)
            if body.mass:
                self._change(made, pybullet.ACTIVATION_STATE_SLEEP)
        finally:
            pybullet.setGravity(0.0, 0.0, 0.0, physicsClientId=client)
            for other in self._masses:
                self._change(other, self._awake(other))
        return made

    def _awake(self, body: int) -> int:
        """Return the state in which a body moves; what slept before sleeps again at once."""
        state: int = pybullet.ACTIVATION_STATE_ENABLE_SLEEPING
        if body in self._held:
            state = pybullet.ACTIVATION_STATE_DISABLE_SLEEPING
        return state

    def _change(self, body: int, state: int, threshold: float = -1.0) -> None:
        pybullet.changeDynamics(
            body, -1, activationState=state, sleepThreshold=threshold, physicsClientId=self._client
        )

    def remove(self, name: str) -> int:
        """Take an object away; return the number it had."""
        body = self.body(name)
        self.wake_near(body)
        self._held.discard(body)
        self._masses.pop(body, None)
        self._thin.pop(body, None)
        for kept in (self._read, self._frames, self._moments):
            kept.pop(body, None)
        del self._bodies[name]
        pybullet.removeBody(body, physicsClientId=self._client)
        return body

    def motion(self, name: str) -> BodyState:
        return self._motion(self.body(name))

    def motions(self) -> dict[str, BodyState]:
        """Return motion() of every object that has a mass, by name."""
        return {
            name: self._motion(body) for name, body in self._bodies.items() if body in self._masses
        }

    def _motion(self, body: int) -> BodyState:
        position, turn = pybullet.getBasePositionAndOrientation(body, self._client)
        known = self._read.get(body)
        if known is not None and known[0] == position and known[1] == turn:
            return known[2]
        linear, angular = pybullet.getBaseVelocity(body, self._client)
        motion = BodyState(Pose(position, turn), linear, angular)
        if body in self._frames:
            motion = carried(motion, inverse(self._frames[body]))
        self._read[body] = position, turn, motion
        return motion

    def _of_body(self, body: int, motion: BodyState) -> BodyState:
        """Return how Bullet's body moves where its object moves like this."""
        frame = self._frames.get(body)
        return motion if frame is None else carried(motion, frame)

    def set_motion(self, name: str, motion: BodyState) -> None:
        """Put an object somewhere at once, moving; what it touched there is woken."""
        body = self.body(name)
        _check(name, motion)
        motion = self._of_body(body, motion)
        pose = motion.pose
        was = pybullet.getBasePositionAndOrientation(body, self._client)
        moved = max(abs(a - b) for a, b in zip(was[0], pose.position, strict=True))
        turned = max(abs(a - b) for a, b in zip(was[1], pose.orientation, strict=True))
        if max(moved, turned) > NUDGE:
            if body in self._masses:
                self.wake_near(body)
            else:
                # Between what is fixed and what sleeps Bullet finds no contacts.
                self.wake_all()
        pybullet.resetBasePositionAndOrientation(
            body, pose.position, pose.orientation, self._client
        )
        if body in self._thin:
            self._thin[body] = pose.position, self._thin[body][1]
        if body in self._masses:
            self._set_velocity(body, motion)
            self._wake(body)

    def stepped(self) -> None:
        """Bring back each thin object whose centre passed a fixed surface, or is about in it.

        The sphere that Bullet sweeps is small in what is thin; an edge that turns gets past it,
        and what is in a sheet by half is pushed to either side.
        """
        for body, (before, half) in self._thin.items():
            at, turn = pybullet.getBasePositionAndOrientation(body, self._client)
            if math.dist(at, before) < LOOKED_AT:
                continue
            if body not in self._held:
                through = rotate(turn, half)
                ends = [at, subtract(at, through), add(at, through)]
                passed, *inside = pybullet.rayTestBatch(
                    [before, at, at],
                    ends,
                    collisionFilterMask=STATIC_GROUP,
                    physicsClientId=self._client,
                )
                if passed[0] >= 0:
                    self._stop(body, before, turn, passed[4])
                    continue
                for hit, way in zip(inside, (through, scale(through, -1.0)), strict=True):
                    if hit[0] >= 0 and hit[2] < SUNK:
                        at = add(at, scale(way, 1.0 - hit[2]))
                        self._stop(body, at, turn, scale(way, 1.0 / math.hypot(*way)))
                        break
            self._thin[body] = at, half

    def _stop(self, body: int, at: Vector, turn: Quaternion, normal: Vector) -> None:
        """Put a body there, and take from its velocity what goes against a unit normal."""
        linear, angular = pybullet.getBaseVelocity(body, self._client)
        linear = subtract(linear, scale(normal, min(dot(linear, normal), 0.0)))
        pybullet.resetBasePositionAndOrientation(body, at, turn, self._client)
        pybullet.resetBaseVelocity(body, linear, angular, physicsClientId=self._client)

    def move_held(self, name: str, motion: BodyState, duration: float) -> None:
        """Put a held object where its hand is, moving with it for a step of `duration` s."""
        body = self._bodies[name]
        motion = self._of_body(body, motion)
        pybullet.resetBasePositionAndOrientation(
            body, motion.pose.position, motion.pose.orientation, self._client
        )
        x, y, z = motion.linear
        lift = self._gravity * duration
        self._set_velocity(body, BodyState(motion.pose, (x, y, z + lift), motion.angular))

    def _set_velocity(self, body: int, motion: BodyState) -> None:
        self._read.pop(body, None)
        pybullet.resetBaseVelocity(
            body, motion.linear, motion.angular, physicsClientId=self._client
        )

    def let_pass(self, name: str, other: int, passes: bool) -> None:
        """Switch contacts between two objects off (`passes`) or on."""
        pybullet.setCollisionFilterPair(
            self.body(name), other, -1, -1, int(not passes), physicsClientId=self._client
        )

    # held in a hand -------------------------------------------------------------------------

    def bounds(self, name: str) -> tuple[Vector, Vector]:
        """Return the corners of a box around an object, in world."""
        low, high = pybullet.getAABB(self.body(name), -1, self._client)
        return low, high

    def grip(self, name: str, mass: float) -> None:
        """Make an object kinematic: only move_held() moves it.

        mass: kg that others feel; 0: no contact moves it.
        """
        body = self.body(name)
        self._held.add(body)
        self._change(body, pybullet.ACTIVATION_STATE_DISABLE_SLEEPING)
        self._weigh(body, mass or HELD_MASS)

    def loosen(self, name: str) -> None:
        """Undo grip(); the object keeps its motion."""
        body = self.body(name)
        self._held.discard(body)
        self._weigh(body, self._masses[body])
        # The first lets it sleep at all, the second not yet.
        self._change(body, pybullet.ACTIVATION_STATE_ENABLE_SLEEPING)
        self._wake(body)

    def _weigh(self, body: int, mass: float) -> None:
        """Give a body a mass, kg; its inertia grows with it."""
        client = self._client
        pybullet.changeDynamics(body, -1, mass=mass, physicsClientId=client)
        if body in self._moments:
            moments = scale(self._moments[body], mass / self._masses[body])
            pybullet.changeDynamics(body, -1, localInertiaDiagonal=moments, physicsClientId=client)

    # rest -----------------------------------------------------------------------------------

    def _wake(self, body: int) -> None:
        if body not in self._held:
            self._change(body, pybullet.ACTIVATION_STATE_WAKE_UP)

    def wake_all(self) -> None:
        for body in self._masses:
            self._wake(body)

    def wake_near(self, body: int) -> None:
        """Wake what a body touches, and with it all that leans on that."""
        low, high = pybullet.getAABB(body, -1, self._client)
        found = pybullet.getOverlappingObjects(low, high, self._client) or ()
        for other in sorted({other for other, _ in found}):
            if other in self._masses:
                self._wake(other)

    def wake_touching(self, arm: int) -> None:
        """Wake what an arm touched in the last step, given Bullet's number of it."""
        for point in pybullet.getContactPoints(arm, physicsClientId=self._client):
            if point[2] in self._masses:
                self._wake(point[2])


def _thickness(body: Body) -> Vector:
    """Return half of the thickness of a single solid as a vector in its frame, m."""
    if len(body.parts) > 1 or body.parts[0].shape is Shape.HULL:
        return (0.0, 0.0, 0.0)
    (part,) = body.parts
    if part.shape is Shape.BOX:
        axis = min(range(3), key=part.size.__getitem__)
    else:
        axis = 2 if part.shape is Shape.CYLINDER and part.size[1] / 2 < part.size[0] else 0
    half = least(part)
    return (half * (axis == 0), half * (axis == 1), half * (axis == 2))


def carried(motion: BodyState, frame: Pose) -> BodyState:
    """Return the motion of a frame that is fixed in a body, given where it is in the body's."""
    pose = compose(motion.pose, frame)
    way = subtract(pose.position, motion.pose.position)
    return BodyState(pose, add(motion.linear, cross(motion.angular, way)), motion.angular)


def _check(name: str, motion: BodyState) -> None:
    velocities = motion.linear + motion.angular
    if not all(abs(v) <= MAX_SPEED for v in velocities):
        raise BadInput(NO_SPEED(object=name, found=[*velocities]))
