"""Holding: an object is fixed to the hand, weighed, slips, is released."""

from __future__ import annotations

import math

from mrlab_ros.core.base.diagnostic import Code, Diagnostic
from mrlab_ros.core.base.geometry import (
    Pose,
    Vector,
    add,
    compose,
    conjugate,
    cross,
    dot,
    inverse,
    relative,
    rotate,
    scale,
    subtract,
)
from mrlab_ros.core.physics.diagnostics import PULLED_THROUGH, SLIPPED_OUT, TORN_OFF
from mrlab_ros.core.physics.engine import BodyState
from mrlab_ros.core.physics.grasp.load import Grip, Load, attached, bears, remark
from mrlab_ros.core.physics.simulated_robot import Held, Robot
from mrlab_ros.core.physics.world_state import GraspChanged, LoadChanged, SceneObject, WorldState

# An object that slid so far between the fingers, m, falls: a pad is 25 mm high.
SLID = 0.012
# From so far on, m, an object is pulled through a closed hand: less is its play.
PULLED = 0.001
STILL: Vector = (0.0, 0.0, 0.0)
# The normal of a contact that supports an object points up by more than this cosine.
SUPPORTS = 0.5


class Holding:
    """Fixes objects to hands and keeps what is known of them."""

    def __init__(self, state: WorldState) -> None:
        self._world_state = state
        self._engine = state.engine

    def fix(self, robot: Robot, thing: SceneObject, grip: Grip | None) -> None:
        """Fix an object to a robot's hand where it is.

        What others feel when they meet it is the effective mass of a robot, half of its moving
        mass and its load (ISO/TS 15066:2016, A.3.4).
        """
        hand = self._world_state.hand(robot).pose
        in_hand = relative(hand, self._engine.object(thing.name).pose)
        half = [(b - a) / 2 for a, b in zip(thing.type.low, thing.type.high, strict=True)]
        reach = _length(in_hand.position) + _length((half[0], half[1], half[2]))
        robot.holding = Held(in_hand, grip, reach)
        robot.held, thing.held_by, thing.hand = thing.name, robot.name, None
        robot.held_since_ns = self._world_state.now_ns
        robot.share_of = None
        robot.pressed.clear()
        robot.leaving.discard(thing.name)
        robot.told = robot.reason = None
        felt = robot.arm.moving_mass / 2 + thing.type.mass if robot.arm.moving_mass else 0.0
        self._engine.hold(robot.name, robot.arm.hand, thing.name, felt)
        robot.holding.load = robot.told = self._load(
            robot, thing, self._engine.object(thing.name).pose, STILL
        )
        if robot.told is not None:
            robot.reason = remark(robot.told, robot.name)

    def free(self, robot: Robot) -> None:
        """Let go of what is held; the object keeps the hand's velocity."""
        thing = self._world_state.objects[robot.held]
        self._engine.release(thing.name)
        hand = self._world_state.hand(robot)
        pose = self._engine.object(thing.name).pose
        arm = subtract(pose.position, hand.pose.position)
        linear = add(hand.linear, cross(hand.angular, arm))
        self._engine.set_object(thing.name, BodyState(pose, linear, hand.angular))
        thing.held_by, robot.held, robot.holding = "", "", None
        robot.leaving.add(thing.name)
        robot.share_of = None
        robot.pressed.clear()

    def rest(self, robot: Robot) -> None:
        """Take what is held as at rest in the hand from now on."""
        held = robot.holding
        if held is None:
            return
        thing = self._world_state.objects[robot.held]
        held.poses.clear()
        held.slip_speed = 0.0
        held.load = self._load(robot, thing, self._engine.object(thing.name).pose, STILL)

    def announce(self, robot: Robot) -> None:
        """Add an event with the state of a gripper."""
        self._world_state.events.append(self._state(robot))

    def remark(self, robot: Robot, reason: Diagnostic) -> None:
        """Say something of a gripper whose state stays."""
        if reason != robot.reason and robot.may_remark(self._world_state.now_ns):
            robot.reason = reason
            self._world_state.events.append(LoadChanged(self._state(robot)))

    def _state(self, robot: Robot) -> GraspChanged:
        states = self._engine.fingers(robot.name)
        return GraspChanged(
            self._world_state.now_ns,
            robot.name,
            robot.grasp,
            robot.held,
            tuple(state.position for state in states),
            tuple(state.force for state in states),
            robot.reason,
            robot.holding.load if robot.holding is not None else None,
        )

    # what it bears --------------------------------------------------------------------------

    def weigh(self, robot: Robot, now_ns: int, duration: float) -> None:
        """Look at what a grasp bears; the last look was `duration` s ago.

        The load is that of the instant of the last look: its acceleration is the second
        difference of the places of the object's centre of mass around it.
        """
        held = robot.holding
        if held is None:
            return
        thing = self._world_state.objects[robot.held]
        held.poses.append(self._engine.object(thing.name).pose)
        if len(held.poses) < 3:
            at, acceleration = held.poses[-1], STILL
        else:
            at = held.poses[1]
            before, now, after = (_centre(thing, pose) for pose in held.poses)
            ways = subtract(after, now), subtract(now, before)
            acceleration = scale(subtract(*ways), 1.0 / duration**2)
        held.load = self._load(robot, thing, at, acceleration)
        if held.load is None:
            return
        said = remark(held.load, robot.name)
        lifted = held.lifted or not self._stands(robot)
        news = lifted != held.lifted or _code(said) != _code(robot.reason)
        # News come at once; a load that changes steadily leaves room for them.
        changed = robot.quiet(now_ns) and not held.load.about(robot.told)
        if (news or changed) and robot.may_remark(now_ns):
            robot.told, robot.reason, held.lifted = held.load, said, lifted
            self._world_state.events.append(LoadChanged(self._state(robot)))

    def _load(
        self, robot: Robot, thing: SceneObject, at: Pose, acceleration: Vector
    ) -> Load | None:
        """Return the load while the object is at `at` and its centre of mass accelerates by
        `acceleration`, m/s^2."""
        held = robot.holding
        if held is None:
            return None
        # All that bears it at the same instant: the engine's links have moved on with their step.
        hand = compose(at, inverse(held.in_hand))
        link = self._world_state.hand(robot).pose
        tool = self._engine.link(robot.name, robot.tool_link).pose
        tool0 = compose(hand, relative(link, tool)).position
        mass, centre = thing.type.mass, _centre(thing, at)
        if held.grip is None:
            return attached(tool0, centre, mass, robot.payload)
        return bears(
            held.grip,
            hand,
            tool0,
            centre,
            acceleration,
            mass,
            robot.payload,
            thing.type.body.friction,
            self._force(robot, held.grip),
            self._drag(thing),
        )

    # two hands on one thing -----------------------------------------------------------------

    def _friction(self, robot: Robot, grip: Grip, thing: SceneObject) -> float:
        """Return the friction with which a hand holds against a pull, N."""
        return thing.type.body.friction * grip.kind.friction * self._force(robot, grip)

    def _drag(self, thing: SceneObject) -> Vector:
        """Return the force, N in world, of closed hands through which an object is pulled."""
        total = STILL
        for robot in self._world_state.robots.values():
            still = robot.still_grips
            size = _length(still.slid) if still is not None else 0.0
            if still is not None and still.object == thing.name and size > PULLED:
                force = self._friction(robot, still.grip, thing)
                turn = self._world_state.hand(robot).pose.orientation
                total = subtract(total, scale(rotate(turn, still.slid), force / size))
        return total

    def pulled(self, robot: Robot) -> Diagnostic | None:
        """Follow what another robot pulls at in a closed hand; return what is to be said of it.

        Across the way its fingers close the object slides, against friction, and is torn off in
        the end; against them it strains, which halts whoever pulls. A face lets it go.
        """
        still = robot.still_grips
        thing = self._world_state.objects.get(still.object) if still is not None else None
        taker = self._world_state.robots.get(thing.held_by) if thing is not None else None
        if still is None or thing is None or taker is None or taker.holding is None:
            robot.still_grips = None
            return None
        hands = relative(self._world_state.hand(robot).pose, self._world_state.hand(taker).pose)
        moved = compose(compose(hands, taker.holding.in_hand), inverse(still.in_hand))
        point = still.grip.point
        way = subtract(compose(moved, Pose(point)).position, point)
        against = STILL
        if self._world_state.settings.hold == "infinite":
            against = way
        elif not still.grip.kind.pulls:
            axis = still.grip.axes[0]
            against = scale(axis, dot(way, axis))
        still.strain = _length(against)
        if still.strain > self._world_state.settings.set_down:
            # It is stuck between the fingers, and no longer slides.
            return None
        still.slid = subtract(way, against)
        across = _length(still.slid)
        torn = across > (still.grip.kind.yields or SLID)
        if not torn and across <= PULLED:
            return None
        if torn:
            robot.still_grips = None
            robot.leaving.discard(thing.name)
        return (TORN_OFF if torn else PULLED_THROUGH)(
            object=thing.name,
            robot=robot.name,
            other=taker.name,
            way=round(across, 3),
            force=self._friction(robot, still.grip, thing),
            margin=taker.holding.load.slip_margin if taker.holding.load is not None else 0.0,
        )

    @staticmethod
    def _force(robot: Robot, grip: Grip) -> float:
        """Return what presses on an object from all sides together, N, or pulls at it."""
        if grip.kind.pulls:
            return robot.tool.force
        return robot.arm.grip_force * (2.0 if grip.backed else 1.0)

    @staticmethod
    def _stands(robot: Robot) -> bool:
        """Return whether what is held stands on something, which bears its weight."""
        return any(touch.held and touch.normal[2] > SUPPORTS for touch in robot.touches)

    def slip(self, robot: Robot, duration: float) -> Diagnostic | None:
        """Let what friction does not hold slide for `duration` s.

        Return why it falls; None: it is still in the hand.
        """
        held = robot.holding
        if held is None or held.load is None or held.grip is None:
            return None
        load = held.load
        if self._world_state.settings.hold == "infinite" or (
            load.excess <= 0 and held.slip_speed <= 0
        ):
            return None
        if self._stands(robot):
            held.slip_speed = 0.0
            return None
        if held.grip.kind.pulls:
            return _fallen(held.grip.kind.came_off, robot, load)
        held.slip_speed = max(held.slip_speed + load.excess * duration, 0.0)
        way = held.slip_speed * duration
        held.slid += way
        if held.slid > SLID:
            return _fallen(SLIPPED_OUT, robot, load)
        hand = self._world_state.hand(robot).pose
        shift = rotate(conjugate(hand.orientation), scale(load.way, way))
        held.in_hand = Pose(add(held.in_hand.position, shift), held.in_hand.orientation)
        self._engine.slide(robot.held, shift)
        return None


def _centre(thing: SceneObject, at: Pose) -> Vector:
    """Return where the centre of mass of an object at `at` is, in world."""
    return compose(at, Pose(thing.type.body.centre)).position


def _code(said: Diagnostic | None) -> str:
    return said.code if said is not None else ""


def _fallen(code: Code, robot: Robot, load: Load) -> Diagnostic:
    return code(
        object=robot.held,
        mass=load.mass,
        friction=load.friction,
        friction_needed=load.friction_needed,
    )


def _length(v: Vector) -> float:
    return math.hypot(*v)
