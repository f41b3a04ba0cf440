"""What the arms of a Bullet world hold, and what they pass into.

Held objects are kinematic: posed with the gripper's velocity before every step.
"""

from __future__ import annotations

import itertools
import math
from dataclasses import dataclass

from mrlab_ros.adapters.bullet.arms import Arms
from mrlab_ros.adapters.bullet.objects import Objects
from mrlab_ros.core.base.geometry import Pose, Vector, add, compose, cross, relative, subtract
from mrlab_ros.core.physics.engine import BodyState


@dataclass(eq=False)
class HeldObject:
    """What an arm's link holds. offset: T_link_object. motion: at the instant that the arm was
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
            pose = compose(hand.pose, held.offset)
            way = subtract(pose.position, hand.pose.position)
            linear = add(hand.linear, cross(hand.angular, way))
            held.motion = BodyState(pose, linear, hand.angular)
            self._objects.move_held(name, held.motion, duration)
