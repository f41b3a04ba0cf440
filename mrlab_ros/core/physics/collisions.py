"""Contacts and collisions of the arms, and when a collision is over."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

import numpy as np

from mrlab_ros.core.base.geometry import Pose, add
from mrlab_ros.core.physics import contact_rules
from mrlab_ros.core.physics.clearance import Halt
from mrlab_ros.core.physics.engine import BodyState, Kind, Touch
from mrlab_ros.core.physics.grippers import LEFT
from mrlab_ros.core.physics.objects import surface_body
from mrlab_ros.core.physics.simulated_robot import Robot
from mrlab_ros.core.physics.world_state import CollisionChanged, Contact, WorldState
from mrlab_ros.core.scene import surfaces as rooms
from mrlab_ros.core.scene.surfaces import Surface

# Deeper than this, m, no arm presses an object into anything.
SQUEEZED = 0.0005


class Collisions:
    """Observes contacts of all arms with objects, surfaces, each other and themselves."""

    def __init__(self, state: WorldState) -> None:
        self._world_state = state
        self._engine = state.engine
        self._contacts: dict[tuple[str, str, str, Kind, str, str], Contact] = {}

    def take(self) -> list[Contact]:
        """Return the hardest contact of each pair since the last call."""
        taken, self._contacts = list(self._contacts.values()), {}
        return taken

    def observe(self, robot: Robot, now_ns: int, duration: float) -> None:
        """Record an arm's contacts of a step of `duration` s; announce a collision that begins."""
        robot.touches = self._engine.touches(robot.name)
        if not robot.touches:
            return
        if robot.held:
            contact_rules.press(robot, now_ns, duration)
        frame = robot.playing.frame_at(robot.stream.shown_ns(now_ns))
        first: Contact | None = None
        for touch in robot.touches:
            if touch.link in robot.arm.fixed_links and not touch.held:
                continue
            contact = Contact(now_ns, robot.name, frame, touch)
            key = (robot.name, touch.link, touch.held, touch.kind, touch.other, touch.other_link)
            known = self._contacts.get(key)
            if known is None or touch.impulse > known.touch.impulse:
                self._contacts[key] = contact
            counts = contact_rules.counts(self._world_state, robot, touch)
            if touch.kind is Kind.OBJECT and self._presses(robot, touch, counts):
                counts = True
            if counts:
                robot.partners.add((touch.kind, touch.other))
                if first is None or touch.depth > first.touch.depth:
                    first = contact
        if first is not None:
            begins = robot.clearance.touched()
            if begins or robot.raise_again:
                self._world_state.events.append(
                    CollisionChanged(now_ns, robot.name, True, first, -first.touch.depth)
                )
            robot.raise_again = False

    def _presses(self, robot: Robot, touch: Touch, counts: bool) -> bool:
        """Return whether an arm presses an object too far into something else.

        An arm gives way to nothing, and neither does the floor. Instead of pushing the object into
        the floor, the arm passes into the object. counts: whether the touch is a collision anyway.
        """
        thing = self._world_state.objects.get(touch.other)
        if thing is None or thing.held_by:
            return False
        if touch.other in robot.passing:
            return touch.depth > (robot.gripper.yields or self._world_state.settings.set_down)
        # Fingers press with little force on obstacles that they may touch.
        if counts or touch.depth > SQUEEZED or touch.link not in robot.finger_links:
            way = self._engine.squeezed(robot.name, touch.other, touch.normal)
            if math.hypot(*way) > SQUEEZED:
                robot.passing.add(touch.other)
                self._engine.let_pass(robot.name, touch.other, True)
                pose = self._engine.object(touch.other).pose
                out = Pose(add(pose.position, way), pose.orientation)
                self._engine.set_object(touch.other, BodyState(out))
        return False

    def check_clearance(self, robot: Robot, now_ns: int) -> None:
        """Announce a collision that is over; stop tolerating what the arm has left."""
        far = 2 * self._world_state.settings.clear_margin
        contact_rules.forget(robot, now_ns)
        for name in list(robot.leaving):
            if self._engine.distance(robot.name, Kind.OBJECT, name, LEFT) >= LEFT:
                robot.leaving.discard(name)
        for name in list(robot.passing):
            if self._engine.distance(robot.name, Kind.OBJECT, name, LEFT) >= LEFT:
                robot.passing.discard(name)
                self._engine.let_pass(robot.name, name, False)
        for name in list(robot.tolerated):
            if self._engine.distance(robot.name, Kind.SURFACE, name, far) >= far / 2:
                robot.tolerated.discard(name)
        if robot.clearance.state is Halt.CLEAR:
            return
        if any(contact_rules.counts(self._world_state, robot, touch) for touch in robot.touches):
            return
        nearest = far
        for kind, other in self._all_near(robot) if robot.inherited else robot.partners:
            # Links of one arm are always close to each other; it is enough that they do not touch.
            if kind is Kind.SELF or (kind is Kind.OBJECT and other == robot.held):
                continue
            nearest = min(nearest, self._engine.distance(robot.name, kind, other, far))
        if robot.clearance.apart(now_ns, nearest):
            robot.partners.clear()
            robot.inherited = False
            self._world_state.events.append(
                CollisionChanged(now_ns, robot.name, False, None, nearest)
            )

    def _all_near(self, robot: Robot) -> Iterator[tuple[Kind, str]]:
        """Yield everything that an arm may have hit."""
        yield from ((Kind.SURFACE, n) for n in self._world_state.surfaces.keys() - robot.tolerated)
        yield from ((Kind.OBJECT, n) for n in self._world_state.objects.keys() - robot.leaving)
        yield from ((Kind.ROBOT, n) for n in self._world_state.robots.keys() - {robot.name})

    # the room -------------------------------------------------------------------------------

    def set_surfaces(self, new: Sequence[Surface], source: str = "") -> tuple[str, ...]:
        """Replace the room's surfaces; without one labelled floor there is an endless floor.

        source: replace those of this source alone. Returns the names of those that overlap a
        robot. They are tolerated until the robot has moved out of them.
        """
        if source:
            new = rooms.of_source(source, new, self._world_state.surfaces)
        wanted = {surface.name: surface for surface in new}
        rooms.check_names(new)
        if not any(surface.label == rooms.FLOOR for surface in new):
            wanted.setdefault(rooms.FLOOR, rooms.floor())
        most = self._world_state.settings.max_triangles
        before = self._world_state.surfaces
        # A headset sends the whole room repeatedly: unchanged surfaces stay.
        kept = {n for n, s in wanted.items() if n in before and _alike(s, before[n])}
        bodies = {n: surface_body(s, most) for n, s in wanted.items() if n not in kept}
        for name in before:
            if name not in kept:
                self._engine.remove_surface(name)
        for name, body in bodies.items():
            self._engine.add_surface(name, body, wanted[name].pose)
        self._world_state.surfaces = wanted
        found: set[str] = set()
        for robot in self._world_state.robots.values():
            robot.tolerated.clear()
            found |= self.tolerate(robot)
        return tuple(sorted(found))

    def tolerate(self, robot: Robot) -> set[str]:
        """Tolerate the surfaces that overlap the robot now; return their names."""
        if robot.placed is not None:
            # Surfaces it already collides with are not tolerated.
            hit = {name for kind, name in robot.partners if kind is Kind.SURFACE}
            for name in self._world_state.surfaces.keys() - hit:
                if self._engine.distance(robot.name, Kind.SURFACE, name, 0.001) <= 0:
                    robot.tolerated.add(name)
        return robot.tolerated


def _alike(a: Surface, b: Surface) -> bool:
    """Return whether two surfaces have the same body."""
    return (
        a.pose == b.pose
        and np.array_equal(a.vertices, b.vertices)
        and np.array_equal(a.triangles, b.triangles)
    )
