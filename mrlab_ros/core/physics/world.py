"""The simulated world: arms that are led, objects that are free, and what happens between them.

Time is the caller's: joint states, clocks and commands come with stamps, `advance(now_ns)` steps
on a fixed grid, and what happened comes out of `take_events()` and `take_contacts()`. The same
inputs give the same events.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

from mrlab_ros.core.clock import SECOND
from mrlab_ros.core.errors import Misuse
from mrlab_ros.core.geometry import Pose, Vector
from mrlab_ros.core.physics.catalogue import Catalogue
from mrlab_ros.core.physics.collisions import Collisions
from mrlab_ros.core.physics.engine import BodyState, Engine, LinkPairs
from mrlab_ros.core.physics.events import Contact, Event
from mrlab_ros.core.physics.grasp import Gripper
from mrlab_ros.core.physics.grippers import Hands
from mrlab_ros.core.physics.joint_stream import Joints, between
from mrlab_ros.core.physics.objects import Inventory
from mrlab_ros.core.physics.scrubbing import Rewind
from mrlab_ros.core.physics.settings import Settings
from mrlab_ros.core.physics.simulated_robot import GripperProgram, Playing, Robot
from mrlab_ros.core.physics.surfaces import Surface
from mrlab_ros.core.physics.world_state import SceneObject, Stage

# What needs no look at every step is looked at this often, steps.
LOOK = 12
# A turn that comes so much later than the one before, ns, was not waited for: the machine stalled.
WAIT_NS = SECOND // 50
# A robot that moved in a step: from where, to where, and with which velocities.
Led = tuple[Robot, Joints, Joints, Joints]


class World:
    """Arms, objects and surfaces on one engine. A refused call changes nothing."""

    def __init__(self, engine: Engine, catalogue: Catalogue, settings: Settings) -> None:
        self._engine = engine
        self._settings = settings
        self._stage = Stage(engine, settings)
        self._robots = self._stage.robots
        self._hands = Hands(self._stage)
        self._inventory = Inventory(self._stage, catalogue, self._hands)
        self._collisions = Collisions(self._stage)
        self._rewind = Rewind(self._stage, self._hands)
        self._epoch_ns: int | None = None
        # The caller's time at its last turn.
        self._heard_ns = 0
        self._count = 0
        self.steps = 0
        self.skipped_ns = 0
        self.set_surfaces([])

    # what there is --------------------------------------------------------------------------

    @property
    def now_ns(self) -> int:
        """The world's time: that of its last step."""
        return self._stage.now_ns

    @property
    def objects(self) -> tuple[SceneObject, ...]:
        return tuple(self._stage.objects.values())

    @property
    def surfaces(self) -> tuple[Surface, ...]:
        return tuple(self._stage.surfaces.values())

    @property
    def robots(self) -> tuple[str, ...]:
        return tuple(self._robots)

    def robot(self, name: str) -> Robot:
        """Return a robot; raise Misuse where there is none."""
        return self._stage.robot(name)

    def object(self, name: str) -> SceneObject:
        """Return an object; raise Misuse where there is none."""
        return self._stage.object(name)

    def motion(self, name: str) -> BodyState:
        """Return where an object is and how it moves."""
        return self._engine.object(self.object(name).name)

    def hand(self, name: str) -> BodyState:
        """Return where the link is that a robot's objects are fixed to, and how it moves."""
        return self._stage.hand(self.robot(name))

    def take_events(self) -> list[Event]:
        """Return what happened since the last call, oldest first."""
        taken, self._stage.events = self._stage.events, []
        return taken

    def take_contacts(self) -> list[Contact]:
        """Return the hardest contact of each pair since the last call."""
        return self._collisions.take()

    # robots ---------------------------------------------------------------------------------

    def add_robot(
        self,
        name: str,
        urdf: str,
        joints: tuple[str, ...],
        pose: Pose,
        gripper: Gripper,
        apart: LinkPairs = frozenset(),
    ) -> None:
        """Add a robot; it takes part from its first joint state on.

        apart: pairs of its links that never touch, though their shapes may.
        """
        if name in self._robots:
            raise Misuse(f"robot '{name}' is in the world already; remove it first")
        arm = self._engine.add_arm(name, urdf, joints, pose, apart)
        if not arm.fingers and gripper is Gripper.FINGERS:
            gripper = Gripper.NONE
        self._robots[name] = Robot(name, joints, pose, arm, gripper, self._settings)
        self._engine.set_fingers(name, [finger.lower for finger in arm.fingers])
        # Braked: free fingers would slide as the arm swings.
        self._engine.drive_fingers(name, [0.0] * len(arm.fingers))
        self._hands.tell(self._robots[name])

    def place_robot(self, name: str, pose: Pose) -> None:
        """Put the base elsewhere at once, with what the hand holds."""
        robot = self.robot(name)
        robot.pose = pose
        self._engine.place_arm(name, pose)
        self._hands.carry(robot)
        self._collisions.tolerate(robot)

    def remove_robot(self, name: str) -> None:
        """Take a robot away; what it held stays behind and falls."""
        robot = self.robot(name)
        self._hands.let_go(robot)
        self._engine.remove_arm(name)
        del self._robots[name]

    def joint_state(
        self, name: str, stamp_ns: int, positions: Sequence[float], velocities: Sequence[float]
    ) -> bool:
        """Take a published joint state; return False where it came out of order."""
        return self.robot(name).stream.add(stamp_ns, positions, velocities, self.now_ns)

    def set_program(self, name: str, program: GripperProgram) -> None:
        """Set when the loaded trajectory opens and closes the gripper."""
        self.robot(name).program = program

    def playback(self, name: str, playing: Playing) -> None:
        """Follow the robot's playback: its clock, its seeks, its runs, each from its stamp on."""
        robot = self.robot(name)
        robot.hear(playing)
        ahead_ns = playing.stamp_ns - self._heard_ns
        # A stamp too far ahead is another clock's, and holds at once.
        foreign = ahead_ns > self._settings.max_catch_up * SECOND
        self._take_up(robot, None if foreign else self.now_ns)

    def _take_up(self, robot: Robot, now_ns: int | None) -> None:
        """Let hold what was heard of a playback until the world's time `now_ns`; None: all."""
        shown_ns = None if now_ns is None else now_ns - robot.stream.delay_ns
        for before in robot.take_up(shown_ns):
            self._rewind.follow(robot, before)

    def attach(self, name: str, object_name: str) -> None:
        """Fix an object to a robot's hand where it is, by hand."""
        self._hands.attach(name, object_name)

    def detach(self, name: str) -> str:
        """Let a robot lose what it holds, by hand; return the object's name."""
        return self._hands.detach(name)

    # objects and the room -------------------------------------------------------------------

    def spawn(
        self, type_id: str, name: str = "", pose: Pose | None = None, *, automatic: bool = False
    ) -> SceneObject:
        """Put an object at `pose`, or with `automatic` on the nearest surface below it."""
        return self._inventory.spawn(type_id, name, pose, automatic=automatic)

    def move(self, name: str, pose: Pose, linear: Vector, angular: Vector, *, held: bool) -> None:
        """Move an object by hand: kinematic while `held`, else let go there with its velocity."""
        self._inventory.move(name, pose, linear, angular, held=held)

    def remove(self, name: str) -> None:
        """Remove an object."""
        self._inventory.remove(name)

    def clear(self) -> int:
        """Remove all objects; return how many there were."""
        return self._inventory.clear()

    def set_surfaces(self, new: Sequence[Surface]) -> tuple[str, ...]:
        """Replace the room's surfaces; without one labelled floor there is an endless floor.

        Returns the names of those that stand in a robot: it may move out of them, and from then
        on they count.
        """
        return self._collisions.set_surfaces(new)

    # time -----------------------------------------------------------------------------------

    def _stamp(self, count: int) -> int:
        assert self._epoch_ns is not None
        return self._epoch_ns + round(count * SECOND / self._settings.step_rate)

    def advance(self, now_ns: int, most: int | None = None) -> int:
        """Step until `now_ns`, or as far as the moving arms are known; return the steps made.

        most: steps, of which more are left to the next call.
        """
        if self._epoch_ns is None:
            self._epoch_ns = self._stage.now_ns = self._heard_ns = now_ns
        waited_ns = min(max(now_ns - self._heard_ns, 0), WAIT_NS)
        self._heard_ns = now_ns
        if now_ns < self._stage.now_ns - SECOND:
            # The clock was set back: go on from there.
            self._shift(now_ns - self._stage.now_ns)
            for robot in self._robots.values():
                self._take_up(robot, None)
        target_ns = now_ns
        for robot in self._robots.values():
            until = robot.stream.known_until(now_ns, waited_ns)
            if until is not None and until < target_ns:
                target_ns = until
        behind_ns = target_ns - self._stage.now_ns
        if behind_ns > self._settings.max_catch_up * SECOND:
            self.skipped_ns += behind_ns
            self._shift(behind_ns)
        made = 0
        while made != most and (stamp_ns := self._stamp(self._count + 1)) <= target_ns:
            self._count += 1
            self._stage.now_ns = stamp_ns
            self._step(stamp_ns)
            made += 1
        self.steps += made
        return made

    def _shift(self, by_ns: int) -> None:
        """Let the world's clock go on from elsewhere."""
        assert self._epoch_ns is not None
        self._epoch_ns += by_ns
        self._stage.now_ns += by_ns

    def _step(self, now_ns: int) -> None:
        for robot in self._robots.values():
            if robot.coming:
                self._take_up(robot, now_ns)
        led = self._lead(now_ns)
        divisions = self._divisions(led)
        duration = 1.0 / self._settings.step_rate / divisions
        self._inventory.keep_in_hand()
        present = [robot for robot in self._robots.values() if robot.placed is not None]
        for k in range(1, divisions + 1):
            if divisions > 1:
                for robot, start, end, velocities in led:
                    at = between(start, end, k / divisions)
                    self._engine.move_arm(robot.name, at, velocities)
            self._engine.step(duration)
            for robot in present:
                self._collisions.look(robot, now_ns)
        for robot in present:
            self._hands.follow(robot, now_ns)
            if robot.pending is not None:
                self._rewind.restore(robot, now_ns)
        if self._count % LOOK == 0:
            self._rewind.record(now_ns, self._inventory.motions())
            for robot in present:
                self._collisions.look_around(robot, now_ns)

    def _lead(self, now_ns: int) -> list[Led]:
        """Put every arm where its joint states say; return those that moved, from where."""
        led: list[Led] = []
        look = self._count % LOOK == 0
        for robot in self._robots.values():
            placed = robot.stream.at(now_ns)
            if placed is None:
                continue
            before = robot.placed
            same = before == placed.positions
            # Nothing pulls a standing arm away, but what touches it nudges it a little.
            idle = same and not (look or robot.touches or robot.held)
            if idle and not any(placed.velocities):
                continue
            jumped = placed.jumped or before is None
            self._engine.move_arm(robot.name, placed.positions, placed.velocities, jumped=jumped)
            robot.placed = placed.positions
            if jumped:
                self._hands.carry(robot)
                if robot.pending is not None:
                    robot.pending = (now_ns, robot.pending[1])
                if before is None:
                    self._collisions.tolerate(robot)
            elif before is not None and not same:
                led.append((robot, before, placed.positions, placed.velocities))
        return led

    def _divisions(self, led: list[Led]) -> int:
        """Return into how many parts a step is divided so that no arm passes through a plate."""
        most = 0.0
        for robot, start, end, velocities in led:
            # No point of an arm moves further than all its joints at full stretch would move it.
            bound = robot.reach(end, start)
            if bound > self._settings.max_travel:
                if velocities is not robot.share_of:
                    # Of a motion straight in joint space the share stays the same.
                    stretched = robot.reach(velocities)
                    speed = self._engine.speed(robot.name)
                    robot.share = min(speed / stretched, 1.0) if stretched else 1.0
                    robot.share_of = velocities
                most = max(most, bound * robot.share)
        return min(math.ceil(most / self._settings.max_travel) or 1, self._settings.max_divisions)
