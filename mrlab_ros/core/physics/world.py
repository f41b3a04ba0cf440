"""The simulated world: prescribed arms, free objects, and the contacts and grasps between them.

The caller owns time: joint states, clocks and commands carry stamps, and `advance(now_ns)` steps
on a fixed grid. `take_events()` and `take_contacts()` return what happened. The same inputs give
the same events.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from mrlab_ros.core.base.clock import SECOND
from mrlab_ros.core.base.diagnostic import Diagnostic
from mrlab_ros.core.base.errors import Misuse
from mrlab_ros.core.base.geometry import Pose, Vector, compose, relative
from mrlab_ros.core.physics.catalogue import Catalogue
from mrlab_ros.core.physics.collisions import Collisions
from mrlab_ros.core.physics.diagnostics import ALREADY_IN_WORLD, OPENED_UNSEEN
from mrlab_ros.core.physics.engine import BodyState, Engine, LinkPairs
from mrlab_ros.core.physics.grasp import kinds
from mrlab_ros.core.physics.grasp.kinds import Gripper
from mrlab_ros.core.physics.grasp.load import Tool
from mrlab_ros.core.physics.grippers import Grippers
from mrlab_ros.core.physics.objects import Inventory
from mrlab_ros.core.physics.scrubbing import Rewind
from mrlab_ros.core.physics.settings import Settings
from mrlab_ros.core.physics.simulated_robot import GripperProgram, Playing, Robot
from mrlab_ros.core.physics.stepping import ROOM_STEPS, SLOW_STEPS, ArmMotion, Rest, StepGrid
from mrlab_ros.core.physics.world_state import Contact, Event, SceneObject, WorldState
from mrlab_ros.core.scene.carrier import Carrier
from mrlab_ros.core.scene.surfaces import Surface

# A gap longer than this between two calls of advance(), ns, counts as a stall, not as silence of
# an arm.
STALL_NS = SECOND // 50


class World:
    """Arms, objects and surfaces on one engine. A refused call changes nothing."""

    def __init__(self, engine: Engine, catalogue: Catalogue, settings: Settings) -> None:
        self._engine = engine
        self._settings = settings
        self._world_state = WorldState(engine, settings)
        self._robots = self._world_state.robots
        self._grippers = Grippers(self._world_state)
        self._inventory = Inventory(self._world_state, catalogue, self._grippers)
        self._collisions = Collisions(self._world_state)
        self._rewind = Rewind(self._world_state, self._grippers)
        self._arm_motion = ArmMotion(self._world_state, self._grippers, self._collisions)
        self._rest = Rest(self._world_state)
        self._grid = StepGrid(settings.step_rate)
        # now_ns of the last call of advance().
        self._called_ns = 0
        self.steps = 0
        self.skipped_ns = 0
        # Time was skipped before the next step.
        self._skipped = False
        self.set_surfaces([])

    # what there is --------------------------------------------------------------------------

    @property
    def now_ns(self) -> int:
        """The world's time: that of its last step."""
        return self._world_state.now_ns

    @property
    def objects(self) -> tuple[SceneObject, ...]:
        return tuple(self._world_state.objects.values())

    @property
    def surfaces(self) -> tuple[Surface, ...]:
        return tuple(self._world_state.surfaces.values())

    @property
    def robots(self) -> tuple[str, ...]:
        return tuple(self._robots)

    def robot(self, name: str) -> Robot:
        """Return a robot; raise Misuse where there is none."""
        return self._world_state.robot(name)

    def object(self, name: str) -> SceneObject:
        """Return an object; raise Misuse where there is none."""
        return self._world_state.object(name)

    def motion(self, name: str) -> BodyState:
        """Return an object's pose and velocity."""
        return self._engine.object(self.object(name).name)

    def fingers(self, name: str) -> dict[str, float]:
        """Return the positions, m or rad, of a robot's finger joints by name; empty: none."""
        robot = self.robot(name)
        states = self._engine.fingers(name)
        joints = [finger.joint for finger in robot.arm.fingers]
        return {joint: state.position for joint, state in zip(joints, states, strict=True)}

    def hand(self, name: str) -> BodyState:
        """Return pose and velocity of the link that a robot's objects are fixed to."""
        return self._world_state.hand(self.robot(name))

    def in_tool(self, name: str) -> Pose | None:
        """Return an object's pose in tool0 of the robot that holds it; None: no robot does."""
        robot = self._robots.get(self.object(name).held_by)
        if robot is None or robot.in_hand is None:
            return None
        tool = self._engine.link(robot.name, robot.tool_link).pose
        return compose(relative(tool, self.hand(robot.name).pose), robot.in_hand)

    def overlaps(self) -> list[tuple[str, Surface]]:
        """Return the robots that stand in surfaces, whose contacts with them are not checked."""
        known = self._world_state.surfaces
        return [
            (name, known[surface])
            for name, robot in sorted(self._robots.items())
            for surface in sorted(robot.tolerated)
            if surface in known
        ]

    def take_events(self) -> list[Event]:
        """Return the events since the last call, oldest first."""
        taken, self._world_state.events = self._world_state.events, []
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
        tool: Tool | None = None,
        reason: Diagnostic | None = None,
    ) -> None:
        """Add a robot; its arm is in the world from its first joint state on.

        apart: pairs of its links that never touch, though their collision shapes may. tool: what
        is stated of its hand. reason: what is to be said of its gripper.
        """
        if name in self._robots:
            raise Misuse(ALREADY_IN_WORLD(name=name))
        arm = self._engine.add_arm(name, urdf, joints, pose, apart)
        if not arm.fingers and gripper.closes:
            gripper = kinds.NONE
        self._robots[name] = Robot(
            name, joints, pose, arm, gripper, self._settings, tool or Tool()
        )
        self._robots[name].reason = reason
        self._engine.set_fingers(name, [finger.opened for finger in arm.fingers])
        # Braked: free fingers would slide when the arm swings.
        self._engine.drive_fingers(name, [0.0] * len(arm.fingers))
        self._grippers.announce(self._robots[name])

    def place_robot(self, name: str, pose: Pose) -> None:
        """Move the base at once, together with what the gripper holds."""
        robot = self.robot(name)
        robot.pose = pose
        self._engine.place_arm(name, pose)
        self._grippers.carry(robot)
        self._collisions.tolerate(robot)

    def remove_robot(self, name: str) -> str:
        """Remove a robot; what it held is released and falls. Return its name; empty: nothing."""
        robot = self.robot(name)
        held = robot.held
        self._grippers.let_go(robot)
        self._engine.remove_arm(name)
        del self._robots[name]
        for other in self._robots.values():
            other.snapshots.forget(name)
        return held

    def joint_state(
        self, name: str, stamp_ns: int, positions: Sequence[float], velocities: Sequence[float]
    ) -> bool:
        """Add a published joint state; return False where it is out of order."""
        robot = self.robot(name)
        added = robot.stream.add(stamp_ns, positions, velocities, self.now_ns)
        if not robot.stream.stands(self.now_ns):
            self._rest.end()
        return added

    def set_program(self, name: str, program: GripperProgram) -> None:
        """Set when the loaded trajectory opens and closes the gripper."""
        self.robot(name).program = program

    def playback(self, name: str, playing: Playing) -> None:
        """Follow the robot's playback; a state applies from its stamp on."""
        robot = self.robot(name)
        robot.queue(playing)
        self._rest.end()
        ahead_ns = playing.stamp_ns - self._called_ns
        # A stamp too far ahead is of another clock and applies at once.
        foreign = ahead_ns > self._settings.max_catch_up * SECOND
        self._apply_due(robot, None if foreign else self.now_ns)

    def _apply_due(self, robot: Robot, now_ns: int | None) -> None:
        """Apply queued playback states whose stamp is at or before `now_ns` (None: all)."""
        shown_ns = None if now_ns is None else now_ns - robot.stream.delay_ns
        for before in robot.apply_due(shown_ns):
            self._rewind.follow(robot, before)

    def attach(self, name: str, object_name: str, reach: float | None = None) -> None:
        """Fix an object to a robot's gripper where it is, by service.

        reach: m, how far from the hand it may be; None: the setting attach_reach.
        """
        limit = self._settings.attach_reach if reach is None else reach
        self._grippers.attach(name, object_name, limit)

    def detach(self, name: str) -> str:
        """Detach what a robot holds, by service; return the object's name."""
        return self._grippers.detach(name)

    def release_missed(self, name: str, object_name: str, in_hand: Pose) -> Diagnostic | None:
        """Let go of what a robot held where its gripper was commanded to open since.

        in_hand: T_hand_object, as it held it. Return what is said of it; None: it is to hold it.
        """
        robot, thing = self.robot(name), self.object(object_name)
        opening = robot.opening(self.now_ns)
        if opening is None:
            return None
        robot.reason = OPENED_UNSEEN(object=object_name, robot=name)
        self._grippers.leave(robot, thing, opening, in_hand)
        self._grippers.announce(robot)
        return robot.reason

    # objects and the room -------------------------------------------------------------------

    def spawn(
        self, type_id: str, name: str = "", pose: Pose | None = None, *, automatic: bool = False
    ) -> SceneObject:
        """Add an object at `pose`, or with `automatic` on the nearest surface below it."""
        return self._inventory.spawn(type_id, name, pose, automatic=automatic)

    def move(
        self,
        name: str,
        pose: Pose,
        linear: Vector,
        angular: Vector,
        *,
        held: bool,
        hand: str = "",
        kept_for: str = "",
    ) -> None:
        """Move an object: kinematic while `held`, else released there with the velocity given.

        hand: the id of the hand whose moves it follows from now on; empty: it follows none.
        kept_for: the robot that alone may take it while it is held; empty: any.
        """
        self._inventory.move(name, pose, linear, angular, held=held, hand=hand, kept_for=kept_for)

    def follow(self, name: str, hand: str, sequence: int, pose: Pose) -> bool:
        """Move an object to where its hand has it; return whether this move counts.

        It counts where that hand holds the object, and no newer one has come. Raises BadInput.
        """
        return self._inventory.follow(name, hand, sequence, pose)

    def carried(self) -> dict[str, tuple[Carrier, int]]:
        """Return by object the hand that carries it, and the number of its newest move."""
        return self._inventory.carried()

    def let_go(self, carried: Mapping[str, tuple[Carrier, int]]) -> list[str]:
        """Release the objects of hands that have not moved since `carried`; return their names."""
        return self._inventory.let_go(carried)

    def remove(self, name: str) -> None:
        """Remove an object."""
        self._inventory.remove(name)

    def clear(self) -> int:
        """Remove all objects; return how many there were."""
        return self._inventory.clear()

    def set_surfaces(self, new: Sequence[Surface], source: str = "") -> tuple[str, ...]:
        """Replace the room's surfaces; without one labelled floor there is an endless floor.

        source: replace those of this source alone. Returns the names of those that overlap a
        robot. They are tolerated until the robot has moved out of them.
        """
        return self._collisions.set_surfaces(new, source)

    # time -----------------------------------------------------------------------------------

    @property
    def next_ns(self) -> int:
        """When the next step is due: a world at rest makes every SLOW_STEPS-th only."""
        return self._grid.stamp(self._grid.next(resting=self._rest.resting))

    def advance(self, now_ns: int, most: int | None = None) -> int:
        """Step until `now_ns`, or as far as the arms' motion is known; return the steps made.

        most: steps in one call; the rest is left to the next one.
        """
        grid = self._grid
        if not grid.started:
            grid.start(now_ns)
            self._world_state.now_ns = self._called_ns = now_ns
        waited_ns = min(max(now_ns - self._called_ns, 0), STALL_NS)
        self._called_ns = now_ns
        target_ns = now_ns
        for robot in self._robots.values():
            until = robot.stream.known_until(now_ns, waited_ns)
            if until is not None and until < target_ns:
                target_ns = until
        behind_ns = target_ns - self._world_state.now_ns
        if behind_ns > self._settings.max_catch_up * SECOND:
            self.skipped_ns += behind_ns
            self._skipped = True
            for robot in self._robots.values():
                robot.stream.skip(target_ns)
            self._rest.end()
            self._grid.shift(behind_ns)
            self._world_state.now_ns += behind_ns
        made = 0
        while made != most:
            count = grid.next(resting=self._rest.resting)
            stamp_ns = grid.stamp(count)
            if stamp_ns > target_ns:
                break
            grid.count, self._world_state.now_ns = count, stamp_ns
            self._step(stamp_ns)
            made += 1
        self.steps += made
        return made

    def _step(self, now_ns: int) -> None:
        for robot in self._robots.values():
            if robot.queued:
                self._apply_due(robot, now_ns)
        slow = self._grid.count % SLOW_STEPS == 0
        moved = self._arm_motion.pose(now_ns, check=slow)
        whole = 1.0 / self._settings.step_rate
        divisions = self._arm_motion.divisions(moved) if moved else 1
        if self._inventory.fast:
            divisions = max(divisions, self._inventory.divisions(whole))
        duration = whole / divisions
        if self._inventory.in_hand:
            self._inventory.keep_in_hand()
        present = [robot for robot in self._robots.values() if robot.placed is not None]
        if self._skipped:
            self._skipped = False
            for robot in present:
                self._grippers.catch_up(robot, now_ns)
        for k in range(1, divisions + 1):
            if divisions > 1:
                self._arm_motion.pose_between(moved, k / divisions)
            self._engine.step(duration)
            for robot in present:
                self._collisions.observe(robot, now_ns, duration)
        for robot in present:
            if robot.closed or robot.held or robot.program.times:
                self._grippers.follow(robot, now_ns, duration * divisions)
            if robot.pending is not None:
                self._rewind.restore(robot, now_ns)
        if slow:
            motions = self._inventory.motions()
            self._inventory.look_for_fast(motions)
            if self._grid.count % ROOM_STEPS == 0 and self._inventory.keep_in_room(motions):
                motions = self._inventory.motions()
            self._rewind.record(now_ns, motions)
            for robot in present:
                self._rewind.retrace(robot, now_ns)
                self._collisions.check_clearance(robot, now_ns)
                if robot.held:
                    self._grippers.weigh(robot, now_ns, duration * divisions * SLOW_STEPS)
            self._rest.compare(self._inventory.motions)
