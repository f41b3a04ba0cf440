"""The objects of the scene: adding, placing, moving and removing them."""

from __future__ import annotations

import itertools
import math
from collections.abc import Mapping

import numpy as np

from mrlab_ros.core.base.diagnostic import Diagnostic
from mrlab_ros.core.base.errors import BadInput, Misuse
from mrlab_ros.core.base.geometry import (
    WORLD_SIZE,
    Pose,
    Vector,
    add,
    checked_vector,
    scale,
)
from mrlab_ros.core.base.names import checked_name
from mrlab_ros.core.physics.catalogue import Catalogue, ObjectType
from mrlab_ros.core.physics.diagnostics import (
    ALL_HELD,
    LEFT_ROOM,
    MADE_ROOM,
    NO_FREE_PLACE,
    NO_SURFACE_BELOW,
    SURFACE_BEYOND,
    SURFACE_IS_LINE,
    SURFACE_NO_VERTEX,
    SURFACE_OUTLINE,
    SURFACE_TOO_FINE,
)
from mrlab_ros.core.physics.engine import Body, BodyState, Part, Shape
from mrlab_ros.core.physics.grippers import Grippers
from mrlab_ros.core.physics.world_state import HAND, ObjectRemoved, SceneObject, WorldState
from mrlab_ros.core.scene.carrier import Carrier, carrier
from mrlab_ros.core.scene.surfaces import Surface

# A detected plane gets this thickness behind it, m: a headset sees no back side.
THICKNESS = 0.02
FLOOR_SIZE = 200.0  # m
MAX_OUTLINE = 1000

# An object beyond WORLD_SIZE, or this far below the floor, m, is removed.
WORLD_DEPTH = 10.0
# Largest velocity with which a person can throw, m/s.
MAX_THROW = 30.0
MAX_SPIN = 100.0  # rad/s
SPAWN_GAP = 0.0005
# A step in which a free object moves further than this, m, near an arm is divided.
FAST_WAY = 0.008
# Speed that an object gains by falling between two tests of fast objects, m/s.
GAINED = 0.5
# Rings around the wanted position in which a free one is searched.
SPAWN_RINGS = 12


class Inventory:
    """Adds and removes the objects of the world."""

    def __init__(self, state: WorldState, catalogue: Catalogue, grippers: Grippers) -> None:
        self._world_state = state
        self._engine = state.engine
        self._objects = state.objects
        self._catalogue = catalogue
        self._grippers = grippers
        # Free objects that are fast, or may be before the next look.
        self.fast: tuple[str, ...] = ()
        # Set while a person holds something.
        self.in_hand = False

    def spawn(self, type_id: str, name: str, pose: Pose | None, *, automatic: bool) -> SceneObject:
        """Add an object at `pose`, or with `automatic` on the nearest surface below it."""
        kind = self._catalogue.get(type_id)
        pose = Pose() if pose is None else pose
        checked_vector(pose.position, "position", WORLD_SIZE)
        taken = frozenset(self._objects) | frozenset(self._world_state.robots)
        if not name:
            name = next(n for i in itertools.count(1) if (n := f"{type_id}_{i}") not in taken)
        checked_name(name, taken, "object")
        if automatic:
            pose = self._free_place(kind, pose)
        self._make_room()
        self._engine.add_object(name, kind.body, BodyState(pose))
        self._objects[name] = SceneObject(name, kind)
        return self._objects[name]

    def _make_room(self) -> None:
        most = self._world_state.settings.max_objects
        if len(self._objects) < most:
            return
        oldest = next((o for o in self._objects.values() if not o.held_by), None)
        if oldest is None:
            raise Misuse(ALL_HELD(count=len(self._objects)))
        self.remove(oldest.name)
        self._announce(oldest, MADE_ROOM(limit=most))

    def _free_place(self, kind: ObjectType, wanted: Pose) -> Pose:
        x, y, z = wanted.position
        height = self._engine.below((x, y, z + 0.05))
        if height is None:
            raise Misuse(NO_SURFACE_BELOW(place=[*wanted.position]))
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
                # What it stands on is fixed, and the engine's bounding boxes have a margin.
                above = (low[0], low[1], low[2] + min(0.03, kind.size[2] / 2))
                there = self._engine.overlapping(low, high)
                there -= {name for name, thing in self._objects.items() if not thing.graspable}
                if not there and not self._engine.overlapping(above, high):
                    return Pose(place, wanted.orientation)
        raise Misuse(NO_FREE_PLACE(type=kind.id, distance=SPAWN_RINGS * pitch))

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
        """Move an object: kinematic while `held`, else released there with the velocity given."""
        thing = self._world_state.object(name)
        checked_vector(pose.position, "position", WORLD_SIZE)
        checked_vector(linear, "velocity", MAX_THROW)
        checked_vector(angular, "angular_velocity", MAX_SPIN)
        if thing.held_by == HAND and not held:
            self._grippers.give(thing)
        self._grippers.take_away(thing)
        motion = BodyState(pose, linear, angular)
        self.fast = (*self.fast, name)
        self._engine.set_object(name, BodyState(pose) if held or not thing.type.mass else motion)
        thing.held_by = HAND if held else ""
        thing.hand = BodyState(pose) if held else None
        thing.carrier = carrier(hand)
        thing.kept_for = kept_for if held else ""
        self.in_hand |= held

    def follow(self, name: str, hand: str, sequence: int, pose: Pose) -> bool:
        """Move an object to where its hand has it; return whether this move counts."""
        thing = self._objects.get(name)
        if thing is None or thing.hand is None or thing.carrier is None:
            return False
        checked_vector(pose.position, "position", WORLD_SIZE)
        if not thing.carrier.follows(hand, sequence):
            return False
        self.fast = (*self.fast, name)
        thing.hand = BodyState(pose)
        self._engine.set_object(name, thing.hand)
        return True

    def carried(self) -> dict[str, tuple[Carrier, int]]:
        """Return by object the hand that carries it, and the number of its newest move."""
        return {
            name: (thing.carrier, thing.carrier.sequence)
            for name, thing in self._objects.items()
            if thing.hand is not None and thing.carrier is not None
        }

    def let_go(self, carried: Mapping[str, tuple[Carrier, int]]) -> list[str]:
        """Release the objects of hands that have not moved since `carried`; return their names."""
        still = self.carried()
        left = [name for name, hand in carried.items() if still.get(name) == hand]
        for name in left:
            hand = self._objects[name].hand
            assert hand is not None
            self.move(name, hand.pose, (0.0, 0.0, 0.0), (0.0, 0.0, 0.0), held=False)
        return left

    def keep_in_hand(self) -> None:
        """Reset the pose of what a person holds."""
        self.in_hand = False
        for thing in self._objects.values():
            if thing.hand is not None:
                self.in_hand = True
                self._engine.set_object(thing.name, thing.hand)

    def remove(self, name: str) -> None:
        thing = self._world_state.object(name)
        self._grippers.take_away(thing)
        self._engine.remove_object(name)
        del self._objects[name]
        self.fast = tuple(other for other in self.fast if other != name)

    def clear(self) -> int:
        """Remove all objects; return how many there were."""
        count = len(self._objects)
        for name in list(self._objects):
            self.remove(name)
        return count

    def motions(self) -> dict[str, BodyState]:
        """Return the state of every movable object by name."""
        return self._engine.objects()

    def look_for_fast(self, motions: Mapping[str, BodyState]) -> None:
        """Look which objects may be fast until the next call. motions: of all movable objects."""
        least = FAST_WAY * self._world_state.settings.step_rate - GAINED
        self.fast = tuple(
            [
                name
                for name, motion in motions.items()
                if math.hypot(*motion.linear) > least and not self._objects[name].held_by
            ]
        )

    def divisions(self, duration: float) -> int:
        """Return into how many parts a step of `duration` s is divided for what flies at an arm.

        The engine's own check for what is fast stops an object only when it is inside by a part
        of its size.
        """
        most = 1
        for name in self.fast:
            thing = self._objects[name]
            motion = self._engine.object(name)
            way = math.hypot(*motion.linear) * duration
            if way <= FAST_WAY or thing.held_by:
                continue
            if self._near_arm(thing, motion, duration):
                most = max(most, math.ceil(way / self._world_state.settings.max_travel))
        return most

    def _near_arm(self, thing: SceneObject, motion: BodyState, duration: float) -> bool:
        """Return whether an object may meet an arm within `duration` s."""
        size = math.hypot(*map(max, map(abs, thing.type.low), map(abs, thing.type.high)))
        start = motion.pose.position
        corners = list(zip(start, add(start, scale(motion.linear, duration)), strict=True))
        x, y, z = (min(pair) - size for pair in corners)
        low = (x, y, z)
        x, y, z = (max(pair) + size for pair in corners)
        high = (x, y, z)
        return not self._world_state.robots.keys().isdisjoint(self._engine.overlapping(low, high))

    def keep_in_room(self, motions: Mapping[str, BodyState]) -> bool:
        """Remove what left the room; return whether anything did."""
        count = len(self._objects)
        for name, motion in motions.items():
            x, y, z = motion.pose.position
            if abs(x) < WORLD_SIZE and abs(y) < WORLD_SIZE and -WORLD_DEPTH < z < WORLD_SIZE:
                continue
            thing = self._objects[name]
            self.remove(name)
            self._announce(thing, LEFT_ROOM())
        return len(self._objects) < count

    def _announce(self, thing: SceneObject, why: Diagnostic) -> None:
        stage = self._world_state
        stage.events.append(ObjectRemoved(stage.now_ns, thing.name, thing.type.id, why))


def surface_body(surface: Surface, max_triangles: int) -> Body:
    """Return the surface as a static body; raise BadInput where it is none.

    A plane becomes a slab behind its front: the convex hull of its outline.
    """
    name, vertices, triangles = surface.name, surface.vertices, surface.triangles
    if not np.isfinite(vertices).all() or (len(vertices) and np.abs(vertices).max() > 1000):
        raise BadInput(SURFACE_BEYOND(surface=name))
    if len(triangles):
        if len(triangles) > max_triangles:
            raise BadInput(
                SURFACE_TOO_FINE(surface=name, count=len(triangles), most=max_triangles)
            )
        if triangles.min() < 0 or triangles.max() >= len(vertices):
            vertex = int(triangles.max() if triangles.min() >= 0 else triangles.min())
            raise BadInput(SURFACE_NO_VERTEX(surface=name, vertex=vertex, count=len(vertices)))
        # Unused vertices would enlarge the bounding box.
        named, places = np.unique(triangles, return_inverse=True)
        part = Part(
            Shape.MESH,
            vertices=vertices[named],
            triangles=places.reshape(-1, 3).astype(np.int32),
        )
    elif surface.endless:
        part = Part(Shape.BOX, (FLOOR_SIZE, FLOOR_SIZE, 1.0), Pose((0.0, 0.0, -0.5)))
    else:
        if not 3 <= len(vertices) <= MAX_OUTLINE:
            raise BadInput(SURFACE_OUTLINE(surface=name, count=len(vertices), most=MAX_OUTLINE))
        across = vertices - vertices.mean(axis=0)
        if np.linalg.svd(across, compute_uv=False)[1] < 1e-4:
            raise BadInput(SURFACE_IS_LINE(surface=name))
        behind = vertices - [0.0, 0.0, THICKNESS]
        part = Part(Shape.HULL, vertices=np.concatenate([vertices, behind]))
    return Body((part,), 0.0)
