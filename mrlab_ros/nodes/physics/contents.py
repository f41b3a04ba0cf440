"""The objects and surfaces of the physics node as a whole: read, replaced, kept for a restart."""

from __future__ import annotations

import math
import threading
import time
from collections.abc import Callable, Sequence
from contextlib import AbstractContextManager
from dataclasses import replace

from mrlab_ros.adapters.scenes.files import StateFile
from mrlab_ros.core.base.clock import SECOND
from mrlab_ros.core.base.diagnostic import Diagnostic
from mrlab_ros.core.base.diagnostics import IN_PLACE
from mrlab_ros.core.base.errors import BadInput, LabError
from mrlab_ros.core.base.names import checked_name
from mrlab_ros.core.physics.engine import BodyState
from mrlab_ros.core.physics.pending_grasp import PendingGrasp
from mrlab_ros.core.physics.world import World
from mrlab_ros.core.scene.document import ObjectEntry, SceneDocument
from mrlab_ros.core.scene.surfaces import Surface
from mrlab_ros.nodes.physics.diagnostics import (
    CANNOT_HOLD_FIXED,
    CONTENTS_NOT_BACK,
    TOO_MANY_OBJECTS,
)

# A robot that is to hold an object may come this long after the object, ns.
ROBOT_TIMEOUT_NS = 20 * SECOND
SAVE_PERIOD_S = 2.0


class Contents:
    """Contents of the world beside the robots.

    lock: guards the world. rehearsal: makes an empty world beside it, in which a change is tried;
    its context closes it. max_objects: active at once.
    """

    def __init__(
        self,
        world: World,
        lock: threading.Lock,
        rehearsal: Callable[[], AbstractContextManager[World]],
        max_objects: int,
        file: StateFile,
        log: Callable[[str], None],
    ) -> None:
        self._world = world
        self._lock = lock
        self._rehearsal = rehearsal
        self._max_objects = max_objects
        self._file = file
        self._log = log
        self._pending: list[PendingGrasp] = []
        self.changed = False
        # What was held, and when, as it was written last.
        self._held: dict[str, str] = {}
        self._saved_at = -math.inf
        # What of the last run is not as it was.
        self.lost: list[Diagnostic] = []

    def document(self) -> SceneDocument:
        """Return the objects and surfaces as they are; the caller holds the lock."""
        world = self._world
        awaited = {grasp.name: grasp for grasp in self._pending}
        objects = []
        for thing in world.objects:
            entry = ObjectEntry(thing.name, thing.type.id, world.motion(thing.name).pose)
            if thing.held_by in world.robots:
                in_hand = world.robot(thing.held_by).in_hand
                entry = replace(entry, held_by=thing.held_by, in_hand=in_hand)
            elif thing.name in awaited:
                grasp = awaited[thing.name]
                entry = replace(entry, held_by=grasp.robot, in_hand=grasp.in_hand)
            objects.append(entry)
        return SceneDocument(objects=tuple(objects), surfaces=world.surfaces)

    # replacing ------------------------------------------------------------------------------

    def check(
        self, objects: Sequence[ObjectEntry], surfaces: Sequence[Surface]
    ) -> tuple[ObjectEntry, ...]:
        """Return the objects with the poses they would have; raise LabError where one cannot be.

        They are tried in an empty world: robots count only for their names.
        """
        if len(objects) > self._max_objects:
            raise BadInput(TOO_MANY_OBJECTS(count=len(objects), most=self._max_objects))
        placed = []
        with self._rehearsal() as world:
            world.set_surfaces(surfaces)
            for entry in objects:
                thing = world.spawn(entry.type, entry.name, entry.pose, automatic=entry.automatic)
                if entry.held_by and not thing.graspable:
                    raise BadInput(CANNOT_HOLD_FIXED(robot=entry.held_by, object=thing.name))
                pose = world.motion(thing.name).pose
                placed.append(replace(entry, name=thing.name, pose=pose, automatic=False))
        return tuple(placed)

    def replace(
        self, objects: Sequence[ObjectEntry], surfaces: Sequence[Surface], now_ns: int
    ) -> tuple[ObjectEntry, ...]:
        """Replace all objects and surfaces; raise LabError, with nothing changed, as check().

        An object that a robot holds stays in the air until that robot is there.
        """
        placed = self.check(objects, surfaces)
        with self._lock:
            for entry in placed:
                checked_name(entry.name, frozenset(self._world.robots), "object")
            self._pending.clear()
            self._world.clear()
            self._world.set_surfaces(surfaces)
            for entry in placed:
                self._put(entry, now_ns + ROBOT_TIMEOUT_NS)
            self.changed = True
        return placed

    def _put(self, entry: ObjectEntry, absent_ns: int, *, missed: bool = False) -> None:
        self._world.spawn(entry.type, entry.name, entry.pose, automatic=entry.automatic)
        if entry.held_by and entry.in_hand is not None:
            grasp = PendingGrasp(
                entry.name, entry.held_by, entry.in_hand, absent_ns, missed=missed
            )
            grasp.keep(self._world, BodyState(entry.pose))
            self._pending.append(grasp)

    def regrip(self, now_ns: int, robots: frozenset[str] | None) -> None:
        """Let robots hold again what they held; the caller holds the lock.

        robots: those of the lab, None while they are not known.
        """
        waiting = []
        for grasp in self._pending:
            absent = robots is not None and grasp.robot not in robots
            try:
                if not grasp.check(self._world, now_ns, absent=absent):
                    waiting.append(grasp)
                elif grasp.let_go is not None:
                    self.lost.append(grasp.let_go)
                    self._log(str(grasp.let_go))
            except LabError as error:
                self._log(f"{grasp.robot} does not hold {grasp.name} again: {error}")
                motion = self._world.motion(grasp.name)
                self._world.move(
                    grasp.name, motion.pose, motion.linear, motion.angular, held=False
                )
        self._pending = waiting

    @property
    def waiting(self) -> bool:
        """Return whether a robot is to hold something that it does not hold yet."""
        return bool(self._pending)

    # for a restart --------------------------------------------------------------------------

    def restore(self) -> None:
        """Bring back the objects and surfaces of the last run; log what cannot be."""
        scene = self._file.load()
        if scene is None:
            return
        mistakes = self._restore_surfaces(scene.surfaces)
        for entry in scene.objects:
            try:
                # A robot of the last run that the lab no longer has drops its object at once.
                self._put(entry, 0, missed=True)
            except LabError as error:
                mistakes.append(IN_PLACE(place=entry.name, why=error.diagnostic))
        if mistakes:
            self._file.keep_copy(str(CONTENTS_NOT_BACK(all=mistakes)))

    def _restore_surfaces(self, surfaces: Sequence[Surface]) -> list[Diagnostic]:
        """Set the surfaces, without those that cannot be; return why."""
        try:
            self._world.set_surfaces(surfaces)
            return []
        except LabError:
            intact: list[Surface] = []
            mistakes: list[Diagnostic] = []
        for surface in surfaces:
            try:
                self._world.set_surfaces([surface])
            except LabError as error:
                mistakes.append(error.diagnostic)
            else:
                intact.append(surface)
        self._world.set_surfaces(intact)
        return mistakes

    def save(self, *, now: bool = False) -> None:
        """Write what changed every SAVE_PERIOD_S; at once `now`, or where something else is held.

        The world does not wait for the file.
        """
        due = now or time.monotonic() - self._saved_at >= SAVE_PERIOD_S
        with self._lock:
            held = {thing.name: thing.held_by for thing in self._world.objects if thing.held_by}
            if held == self._held and not (due and self.changed):
                return
            self.changed, self._held, self._saved_at = False, held, time.monotonic()
            scene = self.document()
        if not self._file.save(scene):
            self.changed = True
