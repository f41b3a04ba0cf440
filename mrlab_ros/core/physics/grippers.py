"""The grippers: grasp, hand over, release and carry objects."""

from __future__ import annotations

from mrlab_ros.core.clock import SECOND
from mrlab_ros.core.errors import Misuse
from mrlab_ros.core.geometry import (
    Pose,
    add,
    compose,
    cross,
    relative,
    subtract,
)
from mrlab_ros.core.physics.engine import BodyState, Kind
from mrlab_ros.core.physics.events import GraspChanged
from mrlab_ros.core.physics.grasp import Grasp, GraspEvent, Gripper
from mrlab_ros.core.physics.simulated_robot import COMMANDING, Robot
from mrlab_ros.core.physics.world_state import SceneObject, WorldState


class Grippers:
    """The grippers of all robots in the world."""

    def __init__(self, state: WorldState) -> None:
        self._world_state = state
        self._engine = state.engine

    # by service -----------------------------------------------------------------------------

    def attach(self, name: str, object_name: str) -> None:
        """Fix an object to a robot's gripper where it is; raise Misuse where it cannot be."""
        robot, thing = self._world_state.robot(name), self._world_state.object(object_name)
        if not thing.graspable:
            raise Misuse(f"'{object_name}' is fixed to the room; choose an object that moves")
        if robot.held:
            raise Misuse(f"'{name}' holds '{robot.held}' already; detach that first")
        if robot.placed is None:
            raise Misuse(f"'{name}' has not moved yet; wait for its first joint state")
        self._seize(robot, thing)

    def detach(self, name: str) -> str:
        """Detach what a robot holds; return the object's name."""
        robot = self._world_state.robot(name)
        if not robot.held:
            raise Misuse(f"'{name}' holds nothing; there is nothing to detach")
        held = robot.held
        self.lose(robot)
        return held

    # holding --------------------------------------------------------------------------------

    def _seize(self, robot: Robot, thing: SceneObject) -> None:
        self.take_away(thing)
        hand = self._world_state.hand(robot).pose
        robot.in_hand = relative(hand, self._engine.object(thing.name).pose)
        self._engine.hold(robot.name, robot.arm.hand, thing.name)
        robot.held, thing.held_by, thing.hand = thing.name, robot.name, None
        robot.held_since_ns = self._world_state.now_ns
        robot.lost = ""
        robot.fire(GraspEvent.SEIZED)
        self._engine.drive_fingers(robot.name, robot.finger_velocities())
        self.announce(robot)

    def let_go(self, robot: Robot) -> None:
        """Release what is held; the object keeps the gripper's velocity."""
        if not robot.held:
            return
        thing = self._world_state.objects[robot.held]
        self._engine.release(thing.name)
        hand = self._world_state.hand(robot)
        pose = self._engine.object(thing.name).pose
        arm = subtract(pose.position, hand.pose.position)
        linear = add(hand.linear, cross(hand.angular, arm))
        self._engine.set_object(thing.name, BodyState(pose, linear, hand.angular))
        thing.held_by, robot.held, robot.in_hand = "", "", None

    def lose(self, robot: Robot) -> None:
        """Release what a robot holds while its gripper stays closed."""
        robot.lost = robot.held
        self.let_go(robot)
        robot.fire(GraspEvent.LOST)
        self.announce(robot)

    def take_away(self, thing: SceneObject) -> None:
        """Take an object from the robot or person that holds it."""
        if thing.held_by in self._world_state.robots:
            self.lose(self._world_state.robots[thing.held_by])
        thing.held_by, thing.hand = "", None

    def carry(self, robot: Robot) -> None:
        """Place what the gripper holds after the arm was placed."""
        if robot.held and robot.in_hand is not None:
            hand = self._world_state.hand(robot).pose
            self._engine.set_object(robot.held, BodyState(compose(hand, robot.in_hand)))

    def put_in_hand(self, robot: Robot, thing: SceneObject, in_hand: Pose) -> None:
        """Let a robot hold an object at `in_hand`: T_hand_object."""
        hand = self._world_state.hand(robot).pose
        self._engine.set_object(thing.name, BodyState(compose(hand, in_hand)))
        if robot.held != thing.name:
            self._seize(robot, thing)

    def announce(self, robot: Robot) -> None:
        """Add an event with the state of a gripper."""
        states = self._engine.fingers(robot.name)
        self._world_state.events.append(
            GraspChanged(
                self._world_state.now_ns,
                robot.name,
                robot.grasp,
                robot.held,
                tuple(state.position for state in states),
                tuple(state.force for state in states),
            )
        )

    # along the trajectory -------------------------------------------------------------------

    def follow(self, robot: Robot, now_ns: int) -> None:
        """Open or close the gripper as the trajectory commands; grasp what it reached."""
        if robot.program.times and robot.playing.state in COMMANDING and robot.pending is None:
            position = robot.playing.position(robot.stream.shown_ns(now_ns))
            closed = robot.program.closed_at(position)
            if closed is not None and closed != robot.closed:
                self._set_closed(robot, closed, now_ns)
        if robot.closed and not robot.held:
            self._watch(robot, now_ns)

    def _set_closed(self, robot: Robot, closed: bool, now_ns: int) -> None:
        robot.closed = closed
        robot.closing_since_ns = now_ns
        robot.lost = ""
        robot.watch.reset()
        if not closed:
            self.let_go(robot)
        changed = robot.fire(GraspEvent.CLOSE if closed else GraspEvent.OPEN)
        self._engine.drive_fingers(robot.name, robot.finger_velocities())
        if changed:
            self.announce(robot)

    def _watch(self, robot: Robot, now_ns: int) -> None:
        reached: str | None = None
        shut = False
        if robot.gripper is Gripper.VACUUM:
            reached = self._sucked(robot)
            waited = (now_ns - robot.closing_since_ns) / SECOND
            shut = waited > self._world_state.settings.grasp_timeout
        elif robot.gripper is Gripper.FINGERS and robot.grasp is Grasp.CLOSING:
            states = self._engine.fingers(robot.name)
            stalled = robot.watch.update(now_ns, states, robot.touches)
            if stalled:
                reached = robot.watch.pinched(now_ns)
            timeout = (
                robot.watch.all_stalled_for(now_ns) > self._world_state.settings.grasp_timeout
            )
            shut = timeout or (bool(stalled) and robot.watch.shut(states))
        thing = self._world_state.objects.get(reached) if reached is not None else None
        if thing is not None and thing.graspable and self._may_take(robot, thing):
            self._seize(robot, thing)
        elif shut and robot.fire(GraspEvent.SHUT):
            self.announce(robot)

    def _may_take(self, robot: Robot, thing: SceneObject) -> bool:
        """Return whether a closed gripper may take an object: of two that close on it at the same
        time the first one keeps it; a gripper that closes later takes it over."""
        holder = self._world_state.robots.get(thing.held_by)
        return holder is None or robot.closing_since_ns >= holder.held_since_ns

    def _sucked(self, robot: Robot) -> str | None:
        """Return the first object, by name, that the cup touches.

        What was taken from it is not grasped again before the next gripper command, or two cups
        on one object would take it from each other at every step.
        """
        objects = self._world_state.objects
        reached = (
            touch.other
            for touch in robot.touches
            if touch.kind is Kind.OBJECT
            and touch.link in robot.arm.tool_links
            and touch.other != robot.lost
            and touch.other in objects
        )
        return min((name for name in reached if objects[name].graspable), default=None)
