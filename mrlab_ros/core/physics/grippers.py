"""The grippers: grasp, hand over, release and carry objects."""

from __future__ import annotations

import math
from collections.abc import Sequence

from mrlab_ros.core.base.clock import SECOND
from mrlab_ros.core.base.diagnostic import Diagnostic
from mrlab_ros.core.base.errors import Misuse
from mrlab_ros.core.base.geometry import (
    Pose,
    Vector,
    compose,
    conjugate,
    dot,
    relative,
    rotate,
    subtract,
)
from mrlab_ros.core.physics.diagnostics import (
    CLOSED_UNSEEN,
    FIXED_OBJECT,
    HOLDS_ALREADY,
    HOLDS_NOTHING,
    LOOSE_BETWEEN,
    NOT_MOVED_YET,
    OPENED_UNSEEN,
    OUT_OF_ATTACH_REACH,
    TOO_WIDE,
)
from mrlab_ros.core.physics.engine import BodyState, Kind, Touch
from mrlab_ros.core.physics.grasp import kinds
from mrlab_ros.core.physics.grasp.load import Grip, fingers_grip, middle
from mrlab_ros.core.physics.grasp.states import INWARDS, Grasp, GraspEvent
from mrlab_ros.core.physics.holding import Holding
from mrlab_ros.core.physics.seal import OUT, leak, lip
from mrlab_ros.core.physics.simulated_robot import COMMANDING, Gripped, Robot
from mrlab_ros.core.physics.snapshots import HeldSnapshot
from mrlab_ros.core.physics.world_state import SceneObject, WorldState
from mrlab_ros.core.playback.states import State

# From this distance on, m, the fingers have left what they released.
LEFT = 0.002


class Grippers:
    """The grippers of all robots in the world."""

    def __init__(self, state: WorldState) -> None:
        self._world_state = state
        self._engine = state.engine
        self._holding = Holding(state)

    # by service -----------------------------------------------------------------------------

    def attach(self, name: str, object_name: str, reach: float) -> None:
        """Fix an object to a robot's gripper where it is; raise Misuse where it cannot be.

        reach: m, how far it may be from the nearest link of the hand.
        """
        robot, thing = self._world_state.robot(name), self._world_state.object(object_name)
        if not thing.graspable:
            raise Misuse(FIXED_OBJECT(object=object_name))
        if robot.held:
            raise Misuse(HOLDS_ALREADY(robot=name, object=robot.held))
        if robot.placed is None:
            raise Misuse(NOT_MOVED_YET(robot=name))
        away = self._away(robot, thing)
        if away > reach:
            raise Misuse(
                OUT_OF_ATTACH_REACH(object=object_name, robot=name, distance=away, limit=reach)
            )
        self._seize(robot, thing)

    def detach(self, name: str) -> str:
        """Detach what a robot holds; return the object's name."""
        robot = self._world_state.robot(name)
        if not robot.held:
            raise Misuse(HOLDS_NOTHING(robot=name))
        held = robot.held
        self.lose(robot)
        return held

    def _away(self, robot: Robot, thing: SceneObject) -> float:
        """Return how far an object's box is from the nearest link of a hand, m."""
        pose = self._engine.object(thing.name).pose
        nearest = math.inf
        for link in robot.arm.tool_links | {robot.arm.hand, robot.tool_link}:
            at = self._engine.link(robot.name, link).pose.position
            inside = relative(pose, Pose(at)).position
            sides = zip(thing.type.low, inside, thing.type.high, strict=True)
            beside = [max(low - x, 0.0, x - high) for low, x, high in sides]
            nearest = min(nearest, math.hypot(*beside))
        return nearest

    # holding --------------------------------------------------------------------------------

    def _seize(self, robot: Robot, thing: SceneObject, grip: Grip | None = None) -> None:
        self.take_away(thing)
        self._holding.fix(robot, thing, grip)
        robot.lost = ""
        robot.fire(GraspEvent.SEIZED)
        self._engine.drive_fingers(robot.name, robot.finger_velocities())
        self.announce(robot)

    def let_go(self, robot: Robot) -> None:
        """Release what is held; the object keeps the gripper's velocity."""
        if robot.held:
            self._holding.free(robot)

    def lose(self, robot: Robot, reason: Diagnostic | None = None) -> None:
        """Release what a robot holds while its gripper stays closed."""
        robot.lost, robot.reason = robot.held, reason
        self.let_go(robot)
        robot.fire(GraspEvent.LOST)
        if not robot.closed or robot.gripper is kinds.NONE:
            # It was attached by service; the gripper itself was not closed.
            robot.fire(GraspEvent.OPEN)
            self._engine.drive_fingers(robot.name, robot.finger_velocities())
        self.announce(robot)

    def take_away(self, thing: SceneObject) -> None:
        """Take an object from the robot or person that holds it."""
        if thing.held_by in self._world_state.robots:
            self.lose(self._world_state.robots[thing.held_by])
        thing.held_by, thing.hand, thing.kept_for = "", None, ""

    def carry(self, robot: Robot) -> None:
        """Place what the gripper holds after the arm was placed."""
        robot.still_grips = None
        for other in self._world_state.robots.values():
            if other.still_grips is not None and other.still_grips.object == robot.held:
                other.still_grips = None
        if robot.holding is not None:
            hand = self._world_state.hand(robot).pose
            pose = compose(hand, robot.holding.in_hand)
            self._engine.set_object(robot.held, BodyState(pose))
            robot.holding.poses.clear()

    def put_in_hand(self, robot: Robot, thing: SceneObject, kept: HeldSnapshot) -> None:
        """Let a robot hold an object as it held it once, for as long."""
        self._engine.set_fingers(robot.name, kept.fingers)
        again = robot.held == thing.name
        if again:
            self.let_go(robot)
        hand = self._world_state.hand(robot).pose
        self._engine.set_object(thing.name, BodyState(compose(hand, kept.in_hand)))
        if again:
            self._holding.fix(robot, thing, kept.grip)
        else:
            self._seize(robot, thing, kept.grip)
        robot.held_since_ns = self._world_state.now_ns - kept.for_ns

    def catch_up(self, robot: Robot, now_ns: int) -> None:
        """Go on after time was skipped: no force comes of it, and the newest command counts."""
        self._holding.rest(robot)
        position = robot.commanded_at(now_ns)
        closed = None if position is None else robot.program.closed_at(position)
        if closed is None or closed == robot.closed or robot.pending is not None:
            return
        robot.takes_over = False
        thing, in_hand = self._world_state.objects.get(robot.held), robot.in_hand
        opening = robot.opening(now_ns)
        if closed or thing is None or in_hand is None:
            unseen = CLOSED_UNSEEN(robot=robot.name) if closed else None
            self._set_closed(robot, closed, now_ns, unseen)
            return
        said = OPENED_UNSEEN(object=thing.name, robot=robot.name)
        self._set_closed(robot, closed, now_ns, said)
        self.leave(robot, thing, opening, in_hand)

    def leave(self, robot: Robot, thing: SceneObject, opening: int | None, in_hand: Pose) -> None:
        """Let an object lie where an opening of the robot's program released it.

        in_hand: T_hand_object. Without a known place it stays where it is.
        """
        pose = self._engine.object(thing.name).pose
        places = robot.program.places
        if opening is not None and opening < len(places):
            tool = self._engine.link(robot.name, robot.arm.tool).pose
            hand = relative(tool, self._world_state.hand(robot).pose)
            pose = compose(compose(compose(robot.pose, places[opening]), hand), in_hand)
        thing.held_by, thing.hand, thing.kept_for = "", None, ""
        robot.leaving.add(thing.name)
        self._engine.set_object(thing.name, BodyState(pose))

    def announce(self, robot: Robot) -> None:
        """Add an event with the state of a gripper."""
        self._holding.announce(robot)

    def weigh(self, robot: Robot, now_ns: int, duration: float) -> None:
        """Look at what a grasp bears; the last look was `duration` s ago."""
        self._holding.weigh(robot, now_ns, duration)

    # along the trajectory -------------------------------------------------------------------

    def follow(self, robot: Robot, now_ns: int, duration: float) -> None:
        """Open or close the gripper as the trajectory commands; grasp what it reached.

        duration: s since the last call.
        """
        if robot.program.times and robot.playing.state in COMMANDING and robot.pending is None:
            position = robot.playing.position(robot.stream.shown_ns(now_ns))
            closed = robot.program.closed_at(position)
            if closed is not None and closed != robot.closed:
                playing = robot.playing
                robot.takes_over = playing.state is State.PLAYING and playing.clock.rate > 0
                self._set_closed(robot, closed, now_ns)
        if robot.still_grips is not None:
            self._follow_pull(robot, robot.still_grips)
        if robot.held:
            fallen = self._holding.slip(robot, duration)
            if fallen is not None:
                self.lose(robot, fallen)
        elif robot.closed:
            self._watch(robot, now_ns)

    def _follow_pull(self, robot: Robot, still: Gripped) -> None:
        """Follow an object that another robot took over from a hand that is closed about it."""
        thing = self._world_state.objects.get(still.object)
        if thing is not None and not thing.held_by:
            # The other hand let it go: this one has it alone again.
            robot.still_grips = None
            self._seize(robot, thing, still.grip)
            return
        pulled = self._holding.pulled(robot)
        if pulled is not None and robot.still_grips is None:
            robot.reason = pulled
            self.announce(robot)
        elif pulled is not None and (robot.reason is None or pulled.code != robot.reason.code):
            self._holding.remark(robot, pulled)

    def _set_closed(
        self, robot: Robot, closed: bool, now_ns: int, reason: Diagnostic | None = None
    ) -> None:
        robot.closed = closed
        robot.closing_since_ns = now_ns
        robot.lost, robot.reason, robot.still_grips = "", reason, None
        robot.watch.reset()
        if not closed:
            self.let_go(robot)
            # Objects that the fingers only pressed on are released too.
            robot.leaving |= {
                touch.other
                for touch in robot.touches
                if touch.kind is Kind.OBJECT and touch.link in robot.finger_links
            }
        changed = self.command(robot, closed)
        self._engine.drive_fingers(robot.name, robot.finger_velocities())
        if changed:
            self.announce(robot)

    def give(self, thing: SceneObject) -> None:
        """Let the grippers that an object is at touch it on: a hand lets it go there."""
        for robot in self._world_state.robots.values():
            if self._engine.distance(robot.name, Kind.OBJECT, thing.name, LEFT) < LEFT:
                robot.leaving.add(thing.name)

    def command(self, robot: Robot, closed: bool) -> bool:
        """Fire the command to close or open; return whether the state changed.

        A bare flange has nothing to close.
        """
        if closed and robot.gripper is kinds.NONE:
            return False
        return robot.fire(GraspEvent.CLOSE if closed else GraspEvent.OPEN)

    def _watch(self, robot: Robot, now_ns: int) -> None:
        found: tuple[SceneObject, Grip | None] | None = None
        shut, reason = False, None
        if robot.gripper.pulls:
            found, reason = self._pulled(robot)
            waited = (now_ns - robot.closing_since_ns) / SECOND
            shut = waited > self._world_state.settings.grasp_timeout
        elif robot.gripper.closes and robot.grasp is Grasp.CLOSING:
            states = self._engine.fingers(robot.name)
            # Fingers do not press on what they pass into.
            touches = [touch for touch in robot.touches if touch.other not in robot.passing]
            stalled = robot.watch.update(now_ns, states, touches)
            if stalled:
                found, reason = self._pinched(robot, now_ns)
            timeout = (
                robot.watch.all_stalled_for(now_ns) > self._world_state.settings.grasp_timeout
            )
            shut = timeout or (bool(stalled) and robot.watch.shut(states))
        between = robot.watch.between(now_ns) if robot.gripper.closes else []
        if found is not None and self._may_take(robot, found[0]):
            giver = self._world_state.robots.get(found[0].held_by)
            before = giver.holding if giver is not None and giver.closed else None
            if robot.gripper.closes:
                self._engine.settle(robot.name, found[0].name)
            self._seize(robot, *found)
            if giver is not None and before is not None and before.grip is not None:
                giver.still_grips = Gripped(found[0].name, before.in_hand, before.grip)
            loose = [name for name in between if name != found[0].name]
            if loose:
                self._holding.remark(robot, LOOSE_BETWEEN(objects=loose))
        elif shut and robot.grasp is Grasp.CLOSING:
            # The touched object may be gone by now: keep the reason why it was not held.
            together = LOOSE_BETWEEN(objects=between) if len(between) > 1 else None
            robot.reason = reason or together or robot.reason
            robot.fire(GraspEvent.SHUT)
            self.announce(robot)
        elif reason is not None and robot.gripper.pulls:
            self._holding.remark(robot, reason)

    def _pinched(
        self, robot: Robot, now_ns: int
    ) -> tuple[tuple[SceneObject, Grip | None] | None, Diagnostic | None]:
        """Return the object between the fingers with its grip, and why there is none."""
        pinched = robot.watch.pinched(now_ns)
        thing = self._world_state.objects.get(pinched[0]) if pinched is not None else None
        if pinched is None or thing is None or not thing.graspable:
            return None, None
        if robot.watch.wedged(self._engine.fingers(robot.name)):
            return None, TOO_WIDE(object=thing.name)
        hand = self._world_state.hand(robot).pose
        contacts = [
            (
                relative(hand, Pose(middle([touch.point for touch in touches]))).position,
                self._in_hand(hand, touches[0].normal),
            )
            for touches in pinched[1]
        ]
        backed = any(touches[0].link not in robot.finger_links for touches in pinched[1])
        return (thing, fingers_grip(contacts, backed=backed)), None

    @staticmethod
    def _in_hand(hand: Pose, way: Vector) -> Vector:
        return rotate(conjugate(hand.orientation), way)

    def _may_take(self, robot: Robot, thing: SceneObject) -> bool:
        """Return whether a closed gripper may take an object: of two that close on it at the same
        time the first one keeps it; a gripper that closes later takes it over, but not one that
        finds itself closed where its robot was put, by a scene or a seek."""
        holder = self._world_state.robots.get(thing.held_by)
        if holder is None:
            return thing.kept_for in ("", robot.name)
        return robot.takes_over and robot.closing_since_ns >= holder.held_since_ns

    def _pulled(
        self, robot: Robot
    ) -> tuple[tuple[SceneObject, Grip | None] | None, Diagnostic | None]:
        """Return the first object, by name, that a face pulls, and why there is none.

        What was taken from it is not grasped again before the next gripper command, or two faces
        on one object would take it from each other at every step.
        """
        objects = self._world_state.objects
        reached: dict[str, list[Touch]] = {}
        for touch in robot.touches:
            if (
                touch.kind is Kind.OBJECT
                and touch.link in robot.arm.face_links
                and touch.other != robot.lost
                and touch.other in objects
                and objects[touch.other].graspable
            ):
                reached.setdefault(touch.other, []).append(touch)
        reason: Diagnostic | None = None
        for name in sorted(reached):
            inwards = [touch for touch in reached[name] if touch.grip >= INWARDS]
            if not inwards:
                reason = reason or robot.gripper.beside(object=name)
                continue
            grip, leaks = self._sealed(robot, name, inwards)
            if leaks is None:
                return (objects[name], grip), None
            reason = reason or leaks
        return None, reason

    def _sealed(
        self, robot: Robot, name: str, touches: Sequence[Touch]
    ) -> tuple[Grip | None, Diagnostic | None]:
        """Return the grip of a face on an object that it touches, and why it does not hold."""
        radius = robot.tool.lip_radius
        if not radius:
            return None, None
        tool = self._engine.link(robot.name, robot.tool_link).pose
        axis = rotate(tool.orientation, OUT)
        depth = max(dot(subtract(touch.point, tool.position), axis) for touch in touches)
        found = lip(tool, depth, radius)
        leaks = None
        if robot.gripper.seals:
            leaks = leak(name, found, self._engine.rays(name, found.starts, found.ends))
        hand = self._world_state.hand(robot).pose
        point = relative(hand, Pose(found.middle)).position
        return Grip(point, (self._in_hand(hand, axis),), radius, robot.gripper), leaks
