"""Contacts and distances of the arms of a Bullet world, and of what they hold.

What the arms of a Bullet world hold, and what they pass into.

Held objects are kinematic: posed with the gripper's velocity before every step.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Mapping
from dataclasses import dataclass

from mrlab_ros.adapters.bullet.arms import Arms
from mrlab_ros.adapters.bullet.fingers import Fingers
from mrlab_ros.adapters.bullet.objects import Objects, carried
from mrlab_ros.adapters.bullet.quiet import pybullet
from mrlab_ros.core.base.geometry import (
    Pose,
    Vector,
    add,
    cross,
    dot,
    relative,
    scale,
    subtract,
)
from mrlab_ros.core.physics.engine import BodyState, Kind, Near, Touch

# Cosine between two contacts of an object from which on it is squeezed between them: 60 degrees.
OPPOSITE = 0.5


class Contacts:
    """Reads contacts of the last step, and distances of the present poses.

    names: of each body, by Bullet's number of it. surfaces: Bullet's numbers, by name.
    """

    def __init__(
        self,
        client: int,
        arms: Arms,
        fingers: Fingers,
        objects: Objects,
        holding: Holding,
        names: Mapping[int, tuple[Kind, str]],
        surfaces: Mapping[str, int],
    ) -> None:
        self._client = client
        self._arms = arms
        self._fingers = fingers
        self._objects = objects
        self._holding = holding
        self._names = names
        self._surfaces = surfaces

    def touches(self, name: str, duration: float) -> list[Touch]:
        """Return the contact points of an arm and of what it holds; duration: of the step, s."""
        arm = self._arms[name]
        own = self._holding.of(name) if self._holding.held else []
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
            depth, impulse = max(-p[8], 0.0), p[9] * duration
            if kind is Kind.OBJECT and other in own:
                # The held object reports it, as a contact of its own.
                continue
            grip = self._fingers.grip(arm, p[3], p[5], p[7]) if kind is Kind.OBJECT else 0.0
            found.append(
                Touch(
                    arm.links[p[3]], kind, other, other_link, p[5], p[7], depth, impulse, "", grip
                )
            )
        for held in own:
            found += self._held_touches(name, held, duration)
        if self._holding.passing:
            found += self._passed(name)
        return found

    def _held_touches(self, name: str, held: str, duration: float) -> list[Touch]:
        """Return the contact points of what an arm holds, as contacts of the arm."""
        known, found = self._holding.held[held], []
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
                grip = self._fingers.grip(arm, p[4], p[6], scale(p[7], -1.0))
                velocity = subtract(velocity, self._arms.velocity_at(arm, p[4], p[6]))
                kind = Kind.SELF if other == name else Kind.ROBOT
            elif kind is Kind.OBJECT and other in self._holding.held:
                other_motion = self._holding.held[other].motion
                way = subtract(p[6], other_motion.pose.position)
                moved = add(other_motion.linear, cross(other_motion.angular, way))
                velocity = subtract(velocity, moved)
            depth, impulse = max(-p[8], 0.0), p[9] * duration
            found.append(
                Touch(
                    known.link, kind, other, other_link, p[5], p[7], depth, impulse, held, grip,
                    -dot(velocity, p[7]),
                )
            )  # fmt: skip
        return found

    def _passed(self, name: str) -> list[Touch]:
        """Return where an arm and what it holds are inside of what they pass into."""
        arm, found = self._arms[name], []
        for passing, other in sorted(self._holding.passing):
            if passing != name:
                continue
            body = self._objects.body(other)
            close = pybullet.getClosestPoints(arm.body, body, 0.0, physicsClientId=self._client)
            for p in close:
                if p[3] in arm.moving and other not in self._holding.held:
                    grip = self._fingers.grip(arm, p[3], p[5], p[7])
                    link = arm.links[p[3]]
                    found.append(
                        Touch(link, Kind.OBJECT, other, "", p[5], p[7], -p[8], 0.0, "", grip)
                    )
            for held in self._holding.of(name):
                close = pybullet.getClosestPoints(
                    self._objects.body(held), body, 0.0, physicsClientId=self._client
                )
                link = self._holding.held[held].link
                found += [
                    Touch(link, Kind.OBJECT, other, "", p[5], p[7], -p[8], 0.0, held)
                    for p in close
                    if held != other
                ]
        return found

    def squeezed(self, arm: str, name: str, normal: Vector) -> Vector:
        """Return the way, m, out of what an arm presses an object into; zeros: into nothing.

        normal: unit, of the contact, from the object towards the arm.
        """
        own = {self._arms[arm].body, *(self._objects.body(h) for h in self._holding.of(arm))}
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

    def nearest(
        self,
        arm: str,
        kind: Kind,
        other: str,
        limit: float,
        without: frozenset[str] = frozenset(),
    ) -> Near | None:
        """Return where an arm and what it holds are nearest to something; None: beyond `limit`, m.

        without: links, and what is held, that do not count.
        """
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
        for held in self._holding.of(arm):
            if (kind, other) != (Kind.OBJECT, held) and not own and held not in without:
                near = pybullet.getClosestPoints(
                    self._objects.body(held), body, limit, physicsClientId=self._client
                )
                for p in near:
                    if p[8] < least:
                        nearest, least, held_nearest = p, p[8], held
        if nearest is None:
            return None
        link = self._holding.held[held_nearest].link if held_nearest else robot.links[nearest[3]]
        others = self._arms[other].links if kind in (Kind.ROBOT, Kind.SELF) else {}
        return Near(least, link, held_nearest, others.get(nearest[4], ""))

    def _body(self, kind: Kind, name: str) -> int | None:
        if kind is Kind.OBJECT:
            return self._objects.body(name) if name in self._objects else None
        if kind is Kind.SURFACE:
            return self._surfaces.get(name)
        return self._arms[name].body if name in self._arms else None


@dataclass(eq=False)
class HeldObject:
    """An object held by a link. offset: T_link_object. motion: at the instant that the arm was
    posed for."""

    arm: str
    link: str
    offset: Pose
    motion: BodyState


class Holding:
    """Fixes objects to links of arms, and lets arms pass into objects.

    held: by the object's name. passing: arms that pass into objects, by name.
    """

    def __init__(self, arms: Arms, objects: Objects) -> None:
        self._arms = arms
        self._objects = objects
        self.held: dict[str, HeldObject] = {}
        self.passing: set[tuple[str, str]] = set()

    def of(self, arm: str) -> list[str]:
        """Return the names of what an arm holds."""
        return [name for name, known in self.held.items() if known.arm == arm]

    def hold(self, arm: str, link: str, name: str, mass: float = 0.0) -> None:
        """Fix an object to an arm's link; mass: kg that others feel, 0: it does not give way."""
        body = self._objects.body(name)
        hand = self._arms.link(arm, link).pose
        if name in self.held:
            self.release(name)
        motion = self._objects.motion(name)
        self.held[name] = HeldObject(arm, link, relative(hand, motion.pose), motion)
        self._objects.grip(name, mass)
        self._arms.let_touch(arm, body, False)

    def slide(self, name: str, way: Vector) -> None:
        """Shift a held object by `way`, m, in the frame of the hand."""
        held = self.held[name]
        held.offset = Pose(add(held.offset.position, way), held.offset.orientation)

    def release(self, name: str) -> None:
        """Undo hold()."""
        arm = self.held.pop(name).arm
        for passing, thing in self.passing:
            if passing == arm and thing != name:
                self._objects.let_pass(name, self._objects.body(thing), False)
        self._objects.loosen(name)
        self._arms.let_touch(arm, self._objects.body(name), True)
        if (arm, name) in self.passing:
            self.let_pass(arm, name, True)

    def let_pass(self, arm: str, name: str, passes: bool) -> None:
        """Switch contacts of an arm and what it holds with an object off (`passes`) or on."""
        loaded, body = self._arms[arm], self._objects.body(name)
        if passes:
            self.passing.add((arm, name))
        else:
            self.passing.discard((arm, name))
        own = self.held[name].arm == arm if name in self.held else False
        links = [
            i for i in loaded.moving if not (own and loaded.links[i] in loaded.facts.grip_links)
        ]
        self._arms.let_pass(loaded, links, body, passes)
        for held in self.of(arm):
            if held != name:
                self._objects.let_pass(held, body, passes)

    def forget_arm(self, arm: str) -> None:
        """Release what an arm holds, and let it pass into nothing."""
        for held in self.of(arm):
            self.release(held)
        for passing, thing in sorted(self.passing):
            if passing == arm:
                self.let_pass(arm, thing, False)

    def forget_object(self, name: str) -> None:
        """Release an object, and let no arm pass into it."""
        if name in self.held:
            self.release(name)
        for arm, thing in sorted(self.passing):
            if thing == name:
                self.let_pass(arm, thing, False)

    def speed(self, arm: str) -> float:
        """Return the speed of the fastest corner of what an arm holds, m/s; 0: nothing."""
        fastest = 0.0
        for held in self.of(arm):
            hand = self._arms.link(arm, self.held[held].link)
            low, high = self._objects.bounds(held)
            for x, y, z in itertools.product(*zip(low, high, strict=True)):
                way = subtract((x, y, z), hand.pose.position)
                fastest = max(fastest, math.hypot(*add(hand.linear, cross(hand.angular, way))))
        return fastest

    def carry(self, duration: float) -> None:
        """Pose what is held with its gripper for a step of `duration` s, moving as it does: a
        rigid constraint."""
        for name, held in self.held.items():
            hand = self._arms.link(held.arm, held.link)
            held.motion = carried(hand, held.offset)
            self._objects.move_held(name, held.motion, duration)
