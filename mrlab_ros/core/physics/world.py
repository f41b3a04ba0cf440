"""The simulated world: arms that are led, objects that are free, and what happens between them.

Time is the caller's: joint states, clocks and commands come with stamps, `advance(now_ns)` steps
on a fixed grid, and what happened comes out of `take_events()` and `take_contacts()`. The same
inputs give the same events.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from mrlab_ros.core.clock import SECOND
from mrlab_ros.core.errors import BadInput, Misuse
from mrlab_ros.core.kinematics import Array
from mrlab_ros.core.physics import surfaces as rooms
from mrlab_ros.core.physics.catalogue import Catalogue, ObjectType
from mrlab_ros.core.physics.engine import Engine, Kind, Motion, Touch
from mrlab_ros.core.physics.grasp import Grasp, GraspEvent, Gripper
from mrlab_ros.core.physics.halt import Halt
from mrlab_ros.core.physics.poses import (
    Vector,
    add,
    checked_vector,
    compose,
    cross,
    relative,
    subtract,
)
from mrlab_ros.core.physics.robot import COMMANDING, MOVING, GripperProgram, Playing, Robot
from mrlab_ros.core.physics.settings import Settings
from mrlab_ros.core.physics.snapshots import Kept, Snapshot
from mrlab_ros.core.physics.surfaces import Surface
from mrlab_ros.core.playback_states import State
from mrlab_ros.core.scene import Pose, checked_name

# What needs no look at every step is looked at this often, steps.
LOOK = 12
# An object so far away, m, or so far below the floor is lost.
WORLD_SIZE = 100.0
WORLD_DEPTH = 10.0
# Thrown faster than this, m/s, nothing was thrown by hand.
MAX_THROW = 30.0
# A restored snapshot waits this long for the arm's own jump, ns.
RESTORE_WAIT_NS = SECOND // 10
SPAWN_GAP = 0.0005
# How far from the wanted place a free one is looked for, m.
SPAWN_RINGS = 12


@dataclass(frozen=True)
class Contact:
    """A touch with when and in which source frame of the robot's trajectory it was."""

    stamp_ns: int
    robot: str
    frame: int
    touch: Touch


@dataclass(frozen=True)
class CollisionChanged:
    """contact: the first of the collision, None when it ended. clearance: m."""

    stamp_ns: int
    robot: str
    colliding: bool
    contact: Contact | None
    clearance: float


@dataclass(frozen=True)
class GraspChanged:
    """What a gripper does now. positions, forces: of the fingers, in the arm's order."""

    stamp_ns: int
    robot: str
    state: Grasp
    object: str
    positions: tuple[float, ...]
    forces: tuple[float, ...]


@dataclass(frozen=True)
class ObjectRemoved:
    """An object that the world itself took away, and why."""

    stamp_ns: int
    name: str
    why: str


Event = CollisionChanged | GraspChanged | ObjectRemoved


@dataclass(eq=False)
class SceneObject:
    """An object of the scene; held_by: a robot's name, or "hand", or empty."""

    name: str
    type: ObjectType
    held_by: str = ""
    hand: Motion | None = None

    @property
    def graspable(self) -> bool:
        return self.type.mass > 0


HAND = "hand"


class World:
    """Arms, objects and surfaces on one engine. A refused call changes nothing."""

    def __init__(self, engine: Engine, catalogue: Catalogue, settings: Settings) -> None:
        self._engine = engine
        self._catalogue = catalogue
        self._settings = settings
        self._robots: dict[str, Robot] = {}
        self._objects: dict[str, SceneObject] = {}
        self._surfaces: dict[str, Surface] = {}
        self._events: list[Event] = []
        self._contacts: dict[tuple[str, str, Kind, str, str], Contact] = {}
        self._epoch_ns: int | None = None
        self._count = 0
        self.steps = 0
        self.skipped_ns = 0
        self.set_surfaces([])

    # what there is --------------------------------------------------------------------------

    @property
    def now_ns(self) -> int:
        """The world's time: that of its last step."""
        return 0 if self._epoch_ns is None else self._stamp(self._count)

    @property
    def objects(self) -> tuple[SceneObject, ...]:
        return tuple(self._objects.values())

    @property
    def surfaces(self) -> tuple[Surface, ...]:
        return tuple(self._surfaces.values())

    @property
    def robots(self) -> tuple[str, ...]:
        return tuple(self._robots)

    def robot(self, name: str) -> Robot:
        """Return a robot; raise Misuse where there is none."""
        try:
            return self._robots[name]
        except KeyError:
            known = ", ".join(self._robots) or "none"
            raise Misuse(f"no robot '{name}' is in the scene; there are: {known}") from None

    def object(self, name: str) -> SceneObject:
        """Return an object; raise Misuse where there is none."""
        try:
            return self._objects[name]
        except KeyError:
            known = ", ".join(self._objects) or "none"
            raise Misuse(f"no object '{name}' is in the scene; there are: {known}") from None

    def motion(self, name: str) -> Motion:
        """Return where an object is and how it moves."""
        return self._engine.object(self.object(name).name)

    def take_events(self) -> list[Event]:
        """Return what happened since the last call, oldest first."""
        taken, self._events = self._events, []
        return taken

    def take_contacts(self) -> list[Contact]:
        """Return the hardest contact of each pair since the last call."""
        taken, self._contacts = list(self._contacts.values()), {}
        return taken

    # robots ---------------------------------------------------------------------------------

    def add_robot(
        self, name: str, urdf: str, joints: tuple[str, ...], pose: Pose, gripper: Gripper
    ) -> None:
        """Add a robot; it takes part from its first joint state on."""
        if name in self._robots:
            raise Misuse(f"robot '{name}' is in the world already; remove it first")
        arm = self._engine.add_arm(name, urdf, joints, pose)
        if not arm.fingers and gripper is Gripper.FINGERS:
            gripper = Gripper.NONE
        self._robots[name] = Robot(name, joints, pose, arm, gripper, self._settings)
        self._engine.set_fingers(name, [finger.lower for finger in arm.fingers])
        self._tell_grasp(self._robots[name])

    def place_robot(self, name: str, pose: Pose) -> None:
        """Put the base elsewhere at once, with what the hand holds."""
        robot = self.robot(name)
        robot.pose = pose
        self._engine.place_arm(name, pose)
        self._carry(robot)
        self._tolerate(robot)

    def remove_robot(self, name: str) -> None:
        """Take a robot away; what it held stays behind and falls."""
        robot = self.robot(name)
        self._let_go(robot)
        self._engine.remove_arm(name)
        del self._robots[name]

    def joint_state(self, name: str, stamp_ns: int, positions: Array, velocities: Array) -> bool:
        """Take a published joint state; return False where it came out of order."""
        return self.robot(name).stream.add(stamp_ns, positions, velocities, self.now_ns)

    def set_program(self, name: str, program: GripperProgram) -> None:
        """Set when the loaded trajectory opens and closes the gripper."""
        self.robot(name).program = program

    def playback(self, name: str, playing: Playing) -> None:
        """Follow the robot's playback: its clock, its seeks, its runs."""
        robot = self.robot(name)
        before, robot.playing = robot.playing, playing
        if playing.state in MOVING and before.state not in MOVING:
            robot.raise_again = True
        if playing.trajectory_id != before.trajectory_id:
            robot.snapshots.clear()
            return
        if before.sought(playing):
            snapshot = robot.snapshots.at(playing.clock.position)
            if snapshot is not None:
                robot.pending = (self.now_ns + RESTORE_WAIT_NS, snapshot)
        begins = before.state is not State.PLAYING or before.sought(playing)
        if playing.state is State.PLAYING and begins:
            robot.snapshots.cut(playing.clock.position)

    # objects --------------------------------------------------------------------------------

    def spawn(
        self, type_id: str, name: str = "", pose: Pose | None = None, *, automatic: bool = False
    ) -> SceneObject:
        """Put an object at `pose`, or with `automatic` on the nearest surface below it."""
        kind = self._catalogue.get(type_id)
        pose = Pose() if pose is None else pose
        checked_vector(pose.position, "the position", WORLD_SIZE)
        taken = frozenset(self._objects) | frozenset(self._robots)
        if not name:
            name = next(n for i in itertools.count(1) if (n := f"{type_id}_{i}") not in taken)
        checked_name(name, taken, "object")
        if automatic:
            pose = self._free_place(kind, pose)
        self._make_room()
        self._engine.add_object(name, kind.body, Motion(pose))
        self._objects[name] = SceneObject(name, kind)
        return self._objects[name]

    def _make_room(self) -> None:
        if len(self._objects) < self._settings.max_objects:
            return
        oldest = next((o for o in self._objects.values() if not o.held_by), None)
        if oldest is None:
            raise Misuse(
                f"all {len(self._objects)} objects are held; let one go or remove one first"
            )
        self.remove(oldest.name)
        most = self._settings.max_objects
        self._removed(oldest.name, f"the oldest of {most} objects made room for a new one")

    def _free_place(self, kind: ObjectType, wanted: Pose) -> Pose:
        x, y, z = wanted.position
        height = self._engine.below((x, y, z + 0.05))
        if height is None:
            raise Misuse(f"there is no surface below {wanted.position}; give a pose above one")
        pitch = 1.2 * max(kind.size[0], kind.size[1], 0.05)
        for ring in range(SPAWN_RINGS):
            for i in range(max(6 * ring, 1)):
                turn = 2 * math.pi * i / max(6 * ring, 1)
                at = (
                    x + ring * pitch * math.cos(turn),
                    y + ring * pitch * math.sin(turn),
                )
                place = (at[0], at[1], height - kind.low[2] + SPAWN_GAP)
                found = self._engine.below((at[0], at[1], z + 0.05))
                if found is None or abs(found - height) > 0.005:
                    continue
                low, high = add(place, kind.low), add(place, kind.high)
                # The engine's boxes are a little larger than what they hold.
                low = (low[0], low[1], low[2] + min(0.03, kind.size[2] / 2))
                if not self._engine.overlapping(low, high):
                    return Pose(place, wanted.orientation)
        raise Misuse(
            f"no free place for a {kind.id} within {SPAWN_RINGS * pitch:.2g} m; move or "
            "remove something"
        )

    def move(self, name: str, pose: Pose, linear: Vector, angular: Vector, *, held: bool) -> None:
        """Move an object by hand: kinematic while `held`, else let go there with its velocity."""
        thing = self.object(name)
        checked_vector(pose.position, "the position", WORLD_SIZE)
        checked_vector(linear, "the velocity", MAX_THROW)
        checked_vector(angular, "the angular velocity", 100.0)
        self._take_from_robot(thing)
        motion = Motion(pose, linear, angular)
        self._engine.set_object(name, Motion(pose) if held or not thing.type.mass else motion)
        thing.held_by = HAND if held else ""
        thing.hand = Motion(pose) if held else None

    def remove(self, name: str) -> None:
        thing = self.object(name)
        self._take_from_robot(thing)
        self._engine.remove_object(name)
        del self._objects[name]

    def clear(self) -> int:
        """Remove all objects; return how many there were."""
        count = len(self._objects)
        for name in list(self._objects):
            self.remove(name)
        return count

    def _removed(self, name: str, why: str) -> None:
        self._events.append(ObjectRemoved(self.now_ns, name, why))

    # surfaces -------------------------------------------------------------------------------

    def set_surfaces(self, new: Sequence[Surface]) -> tuple[str, ...]:
        """Replace the room's surfaces; without one labelled floor there is an endless floor.

        Returns the names of those that stand in a robot: it may move out of them, and from then
        on they count.
        """
        wanted = {surface.name: surface for surface in new}
        if len(wanted) != len(new):
            raise BadInput("two surfaces have the same name; give each its own")
        if not any(surface.label == rooms.FLOOR for surface in new):
            wanted.setdefault(rooms.FLOOR, rooms.floor())
        bodies = {n: rooms.body(s, self._settings.max_triangles) for n, s in wanted.items()}
        for name in self._surfaces:
            self._engine.remove_surface(name)
        for name, body in bodies.items():
            self._engine.add_surface(name, body, wanted[name].pose)
        self._surfaces = wanted
        found: set[str] = set()
        for robot in self._robots.values():
            robot.tolerated.clear()
            found |= self._tolerate(robot)
        return tuple(sorted(found))

    def _tolerate(self, robot: Robot) -> set[str]:
        """Note the surfaces that stand in the robot already; return their names."""
        if robot.placed is not None:
            # What it collided with before stays a collision until it is clear of it.
            hit = {name for kind, name in robot.partners if kind is Kind.SURFACE}
            for name in self._surfaces.keys() - hit:
                if self._engine.distance(robot.name, Kind.SURFACE, name, 0.001) <= 0:
                    robot.tolerated.add(name)
        return robot.tolerated

    # holding --------------------------------------------------------------------------------

    def attach(self, name: str, object_name: str) -> None:
        """Fix an object to a robot's hand where it is, by hand."""
        robot, thing = self.robot(name), self.object(object_name)
        if not thing.graspable:
            raise Misuse(f"'{object_name}' is fixed to the room; choose an object that moves")
        if robot.held:
            raise Misuse(f"'{name}' holds '{robot.held}' already; detach that first")
        if robot.placed is None:
            raise Misuse(f"'{name}' has not moved yet; wait for its first joint state")
        self._seize(robot, thing)

    def detach(self, name: str) -> str:
        """Let a robot lose what it holds, by hand; return the object's name."""
        robot = self.robot(name)
        if not robot.held:
            raise Misuse(f"'{name}' holds nothing; there is nothing to detach")
        held = robot.held
        self._let_go(robot)
        robot.fire(GraspEvent.LOST)
        self._tell_grasp(robot)
        return held

    def _seize(self, robot: Robot, thing: SceneObject) -> None:
        self._take_from_robot(thing)
        hand = self._engine.link(robot.name, robot.arm.hand).pose
        robot.in_hand = relative(hand, self._engine.object(thing.name).pose)
        self._engine.hold(robot.name, robot.arm.hand, thing.name)
        robot.held, thing.held_by, thing.hand = thing.name, robot.name, None
        robot.fire(GraspEvent.SEIZED)
        self._engine.drive_fingers(robot.name, robot.finger_velocities())
        self._tell_grasp(robot)

    def _let_go(self, robot: Robot) -> None:
        """Undo the hold; the object flies on with the hand's velocity."""
        if not robot.held:
            return
        thing = self._objects[robot.held]
        self._engine.release(thing.name)
        hand = self._engine.link(robot.name, robot.arm.hand)
        pose = self._engine.object(thing.name).pose
        arm = subtract(pose.position, hand.pose.position)
        linear = add(hand.linear, cross(hand.angular, arm))
        self._engine.set_object(thing.name, Motion(pose, linear, hand.angular))
        thing.held_by, robot.held, robot.in_hand = "", "", None

    def _take_from_robot(self, thing: SceneObject) -> None:
        """Let the robot that holds `thing` lose it."""
        if thing.held_by in self._robots:
            robot = self._robots[thing.held_by]
            self._let_go(robot)
            robot.fire(GraspEvent.LOST)
            self._tell_grasp(robot)
        thing.held_by, thing.hand = "", None

    def _carry(self, robot: Robot) -> None:
        """Put what the hand holds where the hand was put."""
        if robot.held and robot.in_hand is not None:
            hand = self._engine.link(robot.name, robot.arm.hand).pose
            self._engine.set_object(robot.held, Motion(compose(hand, robot.in_hand)))

    def _tell_grasp(self, robot: Robot) -> None:
        states = self._engine.fingers(robot.name)
        self._events.append(
            GraspChanged(
                self.now_ns,
                robot.name,
                robot.grasp,
                robot.held,
                tuple(state.position for state in states),
                tuple(state.force for state in states),
            )
        )

    # time -----------------------------------------------------------------------------------

    def _stamp(self, count: int) -> int:
        assert self._epoch_ns is not None
        return self._epoch_ns + round(count * SECOND / self._settings.step_rate)

    def advance(self, now_ns: int) -> int:
        """Step until `now_ns`, or as far as the moving arms are known; return the steps made."""
        if self._epoch_ns is None:
            self._epoch_ns = now_ns
        target_ns = now_ns
        for robot in self._robots.values():
            until = robot.stream.known_until(now_ns)
            if until is not None:
                target_ns = min(target_ns, until)
        target_ns = max(target_ns, now_ns - round(self._settings.max_lag * SECOND))
        behind_ns = target_ns - self.now_ns
        if behind_ns > self._settings.max_catch_up * SECOND:
            self.skipped_ns += behind_ns
            self._epoch_ns += behind_ns
        elif behind_ns < -SECOND:
            # The clock was set back: go on from there.
            self._epoch_ns += behind_ns
        made = 0
        while self._stamp(self._count + 1) <= target_ns:
            self._count += 1
            self._step(self._stamp(self._count))
            made += 1
        self.steps += made
        return made

    def _step(self, now_ns: int) -> None:
        led = self._lead(now_ns)
        divisions = self._divisions(led)
        duration = 1.0 / self._settings.step_rate / divisions
        for thing in self._objects.values():
            if thing.hand is not None:
                self._engine.set_object(thing.name, thing.hand)
        for k in range(1, divisions + 1):
            if divisions > 1:
                for robot, start, end, velocities in led:
                    at = start + (end - start) * (k / divisions)
                    self._engine.move_arm(robot.name, at, velocities)
            self._engine.step(duration)
            for robot in self._robots.values():
                if robot.placed is not None:
                    self._touch(robot, now_ns)
        look = self._count % LOOK == 0
        for robot in self._robots.values():
            if robot.placed is None:
                continue
            self._command_gripper(robot, now_ns)
            self._watch_gripper(robot, now_ns)
            self._restore(robot, now_ns)
            self._record(robot, now_ns)
            if look:
                self._look_around(robot, now_ns)
        if look:
            self._drop_lost()

    def _lead(self, now_ns: int) -> list[tuple[Robot, Array, Array, Array]]:
        """Put every arm where its joint states say; return those that moved, from where."""
        led = []
        for robot in self._robots.values():
            placed = robot.stream.at(now_ns)
            if placed is None:
                continue
            before, first = robot.placed, robot.placed is None
            same = before is not None and np.array_equal(before, placed.positions)
            # Nothing pulls a standing arm away, but what touches it nudges it a little.
            at_rest = same and not placed.velocities.any()
            if at_rest and not robot.touches and not robot.held and self._count % LOOK:
                continue
            self._engine.move_arm(robot.name, placed.positions, placed.velocities)
            robot.placed = placed.positions
            if placed.jumped or first:
                self._engine.travel(robot.name)
                self._carry(robot)
                if robot.pending is not None:
                    robot.pending = (now_ns, robot.pending[1])
                if first:
                    self._tolerate(robot)
            elif not same and before is not None:
                led.append((robot, before, placed.positions, placed.velocities))
        return led

    def _divisions(self, led: list[tuple[Robot, Array, Array, Array]]) -> int:
        """Return into how many parts a step is divided so that no arm passes through a plate."""
        most = 0.0
        for robot, start, end, _ in led:
            bound = float(np.abs(end - start) @ robot.arm.levers)
            if bound > self._settings.max_travel:
                most = max(most, self._engine.travel(robot.name))
        return min(math.ceil(most / self._settings.max_travel) or 1, self._settings.max_divisions)

    def _touch(self, robot: Robot, now_ns: int) -> None:
        robot.touches = self._engine.touches(robot.name)
        if not robot.touches:
            return
        frame = robot.playing.frame_at(robot.stream.shown_ns(now_ns))
        first: Contact | None = None
        for touch in robot.touches:
            if touch.link in robot.arm.fixed_links:
                continue
            contact = Contact(now_ns, robot.name, frame, touch)
            key = (robot.name, touch.link, touch.kind, touch.other, touch.other_link)
            known = self._contacts.get(key)
            if known is None or touch.impulse > known.touch.impulse:
                self._contacts[key] = contact
            thing = self._objects.get(touch.other) if touch.kind is Kind.OBJECT else None
            if robot.counts(touch, thing is not None and thing.graspable):
                robot.partners.add((touch.kind, touch.other))
                if first is None or touch.depth > first.touch.depth:
                    first = contact
        if first is not None:
            begins = robot.clearance.touched()
            if begins or robot.raise_again:
                self._events.append(
                    CollisionChanged(now_ns, robot.name, True, first, -first.touch.depth)
                )
            robot.raise_again = False

    def _look_around(self, robot: Robot, now_ns: int) -> None:
        """See whether a collision is over, and which surfaces the arm has left."""
        far = 2 * self._settings.clear_margin
        for name in list(robot.tolerated):
            if self._engine.distance(robot.name, Kind.SURFACE, name, far) >= far / 2:
                robot.tolerated.discard(name)
        if robot.clearance.state is Halt.CLEAR:
            return
        if any(self._counts(robot, touch) for touch in robot.touches):
            return
        nearest = far
        for kind, other in robot.partners:
            # Links of one arm are always close to each other: not touching is all they can do.
            if kind is Kind.SELF or (kind is Kind.OBJECT and other == robot.held):
                continue
            nearest = min(nearest, self._engine.distance(robot.name, kind, other, far))
        if robot.clearance.apart(now_ns, nearest):
            robot.partners.clear()
            self._events.append(CollisionChanged(now_ns, robot.name, False, None, nearest))

    def _counts(self, robot: Robot, touch: Touch) -> bool:
        thing = self._objects.get(touch.other) if touch.kind is Kind.OBJECT else None
        return robot.counts(touch, thing is not None and thing.graspable)

    def _drop_lost(self) -> None:
        for name, thing in list(self._objects.items()):
            if not thing.type.mass:
                continue
            x, y, z = self._engine.object(name).pose.position
            # Written so that NaN is lost too.
            if not (abs(x) < WORLD_SIZE and abs(y) < WORLD_SIZE and -WORLD_DEPTH < z < WORLD_SIZE):
                self.remove(name)
                self._removed(name, "it left the room")

    # gripper --------------------------------------------------------------------------------

    def _command_gripper(self, robot: Robot, now_ns: int) -> None:
        if robot.playing.state not in COMMANDING or robot.pending is not None:
            return
        position = robot.playing.position(robot.stream.shown_ns(now_ns))
        closed = robot.program.closed_at(position)
        if closed is None or closed == robot.closed:
            return
        self._set_closed(robot, closed, now_ns)

    def _set_closed(self, robot: Robot, closed: bool, now_ns: int) -> None:
        robot.closed = closed
        robot.closing_since_ns = now_ns
        robot.watch.reset()
        if not closed:
            self._let_go(robot)
        changed = robot.fire(GraspEvent.CLOSE if closed else GraspEvent.OPEN)
        self._engine.drive_fingers(robot.name, robot.finger_velocities())
        if changed:
            self._tell_grasp(robot)

    def _watch_gripper(self, robot: Robot, now_ns: int) -> None:
        if robot.gripper is Gripper.NONE or not robot.closed or robot.held:
            return
        seized: str | None = None
        shut = False
        if robot.gripper is Gripper.VACUUM:
            reached = {t.other for t in robot.touches if t.kind is Kind.OBJECT}
            reached &= {t.other for t in robot.touches if t.link in robot.arm.tool_links}
            seized = min((o for o in reached if self._objects[o].graspable), default=None)
            waited = (now_ns - robot.closing_since_ns) / SECOND
            shut = waited > self._settings.grasp_timeout
        elif robot.grasp is Grasp.CLOSING:
            states = self._engine.fingers(robot.name)
            stalled = robot.watch.look(now_ns, states, robot.touches)
            if stalled:
                seized = robot.watch.pinched(now_ns)
                if seized not in self._objects or not self._objects[seized].graspable:
                    seized = None
            timeout = robot.watch.all_stalled_for(now_ns) > self._settings.grasp_timeout
            shut = timeout or (bool(stalled) and robot.watch.shut(states))
        if seized is not None:
            self._seize(robot, self._objects[seized])
        elif shut and robot.grasp is Grasp.CLOSING:
            robot.fire(GraspEvent.SHUT)
            self._tell_grasp(robot)

    # scrubbing ------------------------------------------------------------------------------

    def _record(self, robot: Robot, now_ns: int) -> None:
        if robot.playing.state is not State.PLAYING or robot.pending is not None:
            return
        position = robot.playing.position(robot.stream.shown_ns(now_ns))
        if not robot.snapshots.wants(position):
            return
        kept = {}
        for name, thing in self._objects.items():
            if thing.type.mass:
                holder = self._robots.get(thing.held_by)
                in_hand = holder.in_hand if holder else None
                kept[name] = Kept(self._engine.object(name), thing.held_by, in_hand)
        robot.snapshots.add(Snapshot(position, kept, robot.closed))

    def _restore(self, robot: Robot, now_ns: int) -> None:
        """Put the objects back to where they were when the run passed the sought place."""
        if robot.pending is None or now_ns < robot.pending[0]:
            return
        snapshot, robot.pending = robot.pending[1], None
        if robot.held and snapshot.objects.get(robot.held, Kept(Motion(Pose()))).held_by == "":
            self._let_go(robot)
            robot.fire(GraspEvent.LOST)
        for name, kept in snapshot.objects.items():
            thing = self._objects.get(name)
            if thing is None or thing.held_by not in ("", robot.name):
                continue
            if kept.held_by == robot.name and kept.in_hand is not None:
                hand = self._engine.link(robot.name, robot.arm.hand).pose
                self._engine.set_object(name, Motion(compose(hand, kept.in_hand)))
                if robot.held != name:
                    self._seize(robot, thing)
            elif not kept.held_by and not thing.held_by:
                self._engine.set_object(name, kept.motion)
        robot.closed = snapshot.closed
        if not robot.held:
            robot.fire(GraspEvent.OPEN)
            if snapshot.closed:
                robot.fire(GraspEvent.CLOSE)
            robot.watch.reset()
        self._engine.drive_fingers(robot.name, robot.finger_velocities())
        self._tell_grasp(robot)
