"""What a robot held before a restart: it comes back to the hand, or was let go meanwhile."""

from __future__ import annotations

import math

from mrlab_ros.core.base.clock import SECOND
from mrlab_ros.core.base.diagnostic import Diagnostic
from mrlab_ros.core.base.geometry import Pose, compose
from mrlab_ros.core.physics.engine import BodyState
from mrlab_ros.core.physics.world import World

# Fingers have this long to close on the object before it is attached, ns.
CLOSING_NS = SECOND


class PendingGrasp:
    """Brings an object back to the hand that held it: fingers close on it, or it is attached.

    in_hand: T_hand_object. absent_ns: until when, on the caller's clock, a robot that the lab
    does not have may still come. missed: its robot has gone on meanwhile; an opening that was
    commanded then counts. let_go: what is to be said where it did.
    """

    def __init__(
        self, name: str, robot: str, in_hand: Pose, absent_ns: int, *, missed: bool = False
    ) -> None:
        self.name = name
        self.robot = robot
        self.in_hand = in_hand
        self._absent_ns = absent_ns
        self._missed = missed
        self._since_ns: int | None = None
        self.let_go: Diagnostic | None = None

    def keep(self, world: World, state: BodyState) -> None:
        """Hold the object where it is to be, for its robot alone."""
        world.move(
            self.name, state.pose, state.linear, state.angular, held=True, kept_for=self.robot
        )

    def check(self, world: World, now_ns: int, *, absent: bool) -> bool:
        """Move the object along with the hand; return whether nothing is left to do.

        absent: whether the lab is known not to have the robot. Past absent_ns the object is let
        go then; until its robot is in the world it stays where it is.
        """
        present = {thing.name for thing in world.objects}
        if self.name not in present:
            return True
        if absent and now_ns > self._absent_ns:
            motion = world.motion(self.name)
            world.move(self.name, motion.pose, motion.linear, motion.angular, held=False)
            return True
        if self.robot not in world.robots or world.robot(self.robot).placed is None:
            return False
        if world.robot(self.robot).held == self.name:
            return True
        if self._missed:
            self.let_go = world.release_missed(self.robot, self.name, self.in_hand)
            if self.let_go is not None:
                return True
        state = BodyState(compose(world.hand(self.robot).pose, self.in_hand))
        self.keep(world, state)
        if self._since_ns is None:
            self._since_ns = now_ns
        if now_ns - self._since_ns < CLOSING_NS:
            return False
        # It was in the hand like this before.
        world.attach(self.robot, self.name, math.inf)
        return True
