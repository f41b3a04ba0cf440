"""The physics node: steps the world by joint states and publishes its events."""

from __future__ import annotations

import math
import sys
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import TYPE_CHECKING

from mrlab_msgs import msg, srv
from mrlab_msgs.srv import Trigger

from mrlab_ros.adapters import share
from mrlab_ros.adapters.bullet import support
from mrlab_ros.adapters.robots.library import RobotLibrary
from mrlab_ros.adapters.scenes.files import StateFile
from mrlab_ros.adapters.scenes.object_meshes import ObjectMeshes
from mrlab_ros.adapters.yaml_files import read_yaml
from mrlab_ros.core.base.clock import SECOND
from mrlab_ros.core.base.diagnostic import Diagnostic
from mrlab_ros.core.base.errors import BadInput, LabError
from mrlab_ros.core.physics import catalogue
from mrlab_ros.core.physics.settings import Settings
from mrlab_ros.core.physics.world import World
from mrlab_ros.core.runtime.identity import Identity
from mrlab_ros.core.runtime.process_states import GATEWAY, Deaths
from mrlab_ros.core.scene.carrier import Carrier
from mrlab_ros.messages import physics as messages
from mrlab_ros.messages import qos
from mrlab_ros.messages.poses import pose_from_message
from mrlab_ros.messages.scenes import placement_to_message, placements_from_messages
from mrlab_ros.messages.status import processes_from_message
from mrlab_ros.nodes import parameters
from mrlab_ros.nodes.parameters import PhysicsParameters
from mrlab_ros.nodes.physics.contents import Contents
from mrlab_ros.nodes.physics.diagnostics import (
    CONTENTS_FIT,
    CONTENTS_SET,
    OBJECT_ATTACHED,
    OBJECT_DETACHED,
    OBJECT_MOVED,
    OBJECT_REMOVED,
    OBJECT_SPAWNED,
    OBJECTS_REMOVED,
    SURFACES_SET,
)
from mrlab_ros.nodes.physics.listener import GraphListener
from mrlab_ros.nodes.physics.publishers import WorldPublishers
from mrlab_ros.ros.clock import LabClock, every
from mrlab_ros.ros.deadlines import SWITCH_INTERVAL_S
from mrlab_ros.ros.decoding import subscribe
from mrlab_ros.ros.parameters import NodeArguments, ParameterNode
from mrlab_ros.ros.services import answered, create_service

if TYPE_CHECKING:
    from typing_extensions import Unpack

try:
    from mrlab_ros.adapters.bullet.engine import BulletEngine
except ModuleNotFoundError as error:
    if error.name != "pybullet":
        raise
    raise BadInput(support.missing() or str(error)) from None

# The world is advanced at least this often, ns, unless it rests: its own step.
TURN_NS = SECOND // 240
# After this many steps the lock is released and events are published.
MOST_STEPS = 24
# How often it is looked whether there is something to save, s.
SAVE_LOOK_S = 0.1
# Pages are back by then after their gateway was started again, and take anew what they carry, s.
RETURN_S = 5.0
# After the process did not run, what came meanwhile is taken for so long before time is skipped.
TAKEN_IN_NS = 3 * SECOND // 10
LET_GO_PERIOD_S = 0.5
FILE = "physics.json"


class PhysicsNode(
    ParameterNode[PhysicsParameters], name="physics", kind=PhysicsParameters, others=parameters.ALL
):
    """Steps the world as joint states arrive; publishes contacts, collisions, grasps, objects."""

    def __init__(self, **ros: Unpack[NodeArguments]) -> None:
        super().__init__(**ros)
        state = self.parameters.state_dir
        log = self.get_logger()
        file = StateFile(Path(state) / FILE if state else None, log.error, whole=False)
        config = share.directory() / "config"
        self._settings = Settings.from_mapping(read_yaml(config / "physics.yaml"))
        meshes = ObjectMeshes(share.directory(), self._settings.max_triangles)
        self._types = catalogue.parse(read_yaml(config / "objects.yaml"), meshes)
        library = RobotLibrary(share.directory() / "robots")
        self._resolve = library.mesh_path
        self._lock = threading.Lock()
        self._lab_clock = LabClock(self)
        self._engine = BulletEngine(self._resolve)
        self._world = World(self._engine, self._types, self._settings)
        self._world_publishers = WorldPublishers(self, self._world, self._lab_clock)
        self._contents = Contents(
            self._world,
            self._lock,
            self._rehearsal,
            self._settings.max_objects,
            file,
            log.warning,
        )
        self._contents.restore()
        # Of time.monotonic_ns(): when the last turn began, and before when none steps the world.
        self._turned_ns, self._turns_from_ns = time.monotonic_ns(), 0
        self._world_publishers.publish_surfaces(self._world.surfaces)
        self._listener = GraphListener(
            self,
            self._world,
            self._world_publishers,
            self._lock,
            self._turn,
            library.never_touch,
            library.gripper,
            library.hand_facts,
            self.parameters.lab_id,
            self._lab_clock,
        )
        for kind, name, callback in (
            (srv.SpawnObject, "spawn_object", self._on_spawn),
            (srv.MoveObject, "move_object", self._on_move),
            (srv.Remove, "remove_object", self._on_remove),
            (Trigger, "clear_objects", self._on_clear),
            (srv.ListCatalogue, "list_catalogue", self._on_list),
            (srv.SetSurfaces, "set_surfaces", self._on_surfaces),
            (srv.Attach, "attach", self._on_attach),
            (srv.Detach, "detach", self._on_detach),
            (srv.GetObjects, "get_objects", self._on_get),
            (srv.SetObjects, "set_objects", self._on_set),
        ):
            create_service(self, kind, f"~/{name}", callback)
        subscribe(self, msg.Move, "/moves", self._on_follow, qos.NEWEST)
        self._identity = Identity(self.parameters.lab_id, lambda _: None)
        self._deaths = Deaths(time.monotonic_ns())
        # What hands of pages carried when the gateway went down; they may come back until then.
        self._orphans: dict[str, tuple[Carrier, int]] = {}
        self._let_go_at = math.inf
        subscribe(self, msg.LabProcesses, "/processes", self._on_processes, qos.LATCHED)
        every(self, LET_GO_PERIOD_S, self._let_go)
        every(self, SAVE_LOOK_S, self._contents.save)
        # With Python's default of 5 ms another thread could delay a halt.
        sys.setswitchinterval(SWITCH_INTERVAL_S)
        self._listener.start()

    def destroy_node(self) -> None:
        self._listener.stop()
        self._contents.changed = True
        self._contents.save(now=True)
        with self._lock:
            self._engine.close()
        super().destroy_node()

    @contextmanager
    def _rehearsal(self) -> Iterator[World]:
        engine = BulletEngine(self._resolve)
        try:
            yield World(engine, self._types, self._settings)
        finally:
            engine.close()

    @property
    def lost(self) -> list[Diagnostic]:
        """Return what could not be brought back after a restart."""
        return self._contents.lost

    # time -----------------------------------------------------------------------------------

    def _taking_in(self) -> int:
        """Return for how long, ns, a process that did not run is still to take what came."""
        now_ns = time.monotonic_ns()
        if now_ns - self._turned_ns > self._settings.max_catch_up * SECOND:
            self._turns_from_ns = now_ns + TAKEN_IN_NS
        self._turned_ns = now_ns
        return self._turns_from_ns - now_ns

    def _turn(self) -> int:
        """Advance the world and publish its events; return how long to wait at most, ns.

        An error in one call must not end the thread.
        """
        try:
            taking_in_ns = self._taking_in()
            if taking_in_ns > 0:
                return taking_in_ns
            with self._lock:
                now_ns = self._lab_clock.instant_ns()
                made = self._world.advance(now_ns, MOST_STEPS)
                if self._contents.waiting:
                    self._contents.regrip(now_ns, self._listener.known_robots)
                self._contents.changed |= self._world_publishers.publish_due(now_ns)
                if made == MOST_STEPS:
                    return 0
                # How fast /clock goes is not known.
                simulated = self._lab_clock.simulated
                next_ns = self._world.now_ns + TURN_NS if simulated else self._world.next_ns
                return int(max(next_ns - now_ns, TURN_NS // 4))
        except Exception as error:
            if self.context.ok():
                self.get_logger().error(f"physics: {error!r}", throttle_duration_sec=1.0)
            return TURN_NS

    # services -------------------------------------------------------------------------------

    @answered
    def _on_spawn(
        self, request: srv.SpawnObject.Request, response: srv.SpawnObject.Response
    ) -> Diagnostic:
        pose = pose_from_message(request.pose)
        with self._lock:
            thing = self._world.spawn(
                request.type, request.name, pose, automatic=request.automatic
            )
            motion = self._world.motion(thing.name)
        response.object = messages.object_to_message(thing, motion)
        return OBJECT_SPAWNED(object=thing.name, place=[*motion.pose.position])

    @answered
    def _on_move(
        self, request: srv.MoveObject.Request, response: srv.MoveObject.Response
    ) -> Diagnostic:
        with self._lock:
            self._world.move(
                request.name,
                pose_from_message(request.pose),
                messages.velocity_from_message(request.twist.linear),
                messages.velocity_from_message(request.twist.angular),
                held=request.held,
                hand=request.hand,
            )
        return OBJECT_MOVED(object=request.name, state="held" if request.held else "released")

    def _on_follow(self, move: msg.Move) -> None:
        # The call that lets go says what is wrong with a place; a move has no answer.
        with suppress(LabError), self._lock:
            pose = pose_from_message(move.pose)
            self._world.follow(move.object, move.hand, move.sequence, pose)

    def _on_processes(self, message: msg.LabProcesses) -> None:
        """Note what is carried through a gateway that died or froze: nobody lets go of it."""
        if not self._identity.accepts(message.lab):
            return
        down = self._deaths.new(processes_from_message(message))
        if any(process.name == GATEWAY for process in down):
            with self._lock:
                self._orphans = self._world.carried()
            self._let_go_at = time.monotonic() + RETURN_S

    def _let_go(self) -> None:
        if time.monotonic() < self._let_go_at:
            return
        self._let_go_at = math.inf
        with self._lock:
            fallen = self._world.let_go(self._orphans)
        if fallen:
            self.get_logger().warning(f"the gateway went down: {', '.join(fallen)} let go")

    @answered
    def _on_remove(self, request: srv.Remove.Request, response: srv.Remove.Response) -> Diagnostic:
        with self._lock:
            self._take_out(request.name)
        return OBJECT_REMOVED(object=request.name)

    @answered
    def _on_clear(self, request: Trigger.Request, response: Trigger.Response) -> Diagnostic:
        with self._lock:
            names = [thing.name for thing in self._world.objects]
            self._take_out(*names)
        return OBJECTS_REMOVED(count=len(names))

    def _take_out(self, *names: str) -> None:
        """Remove objects by request, and tell the lab what they were; the lock is held."""
        self._world_publishers.publish_taken_out([self._world.object(name) for name in names])
        for name in names:
            self._world.remove(name)

    def _on_list(
        self, request: srv.ListCatalogue.Request, response: srv.ListCatalogue.Response
    ) -> srv.ListCatalogue.Response:
        response.types = [messages.type_to_message(self._types.get(i)) for i in self._types.ids]
        response.limit = self._settings.max_objects
        return response

    @answered
    def _on_surfaces(
        self, request: srv.SetSurfaces.Request, response: srv.SetSurfaces.Response
    ) -> Diagnostic:
        surfaces = [messages.surface_from_message(s) for s in request.surfaces]
        with self._lock:
            inside = self._world.set_surfaces(surfaces, request.source)
        return SURFACES_SET(count=self._publish_surfaces(), inside=[*inside])

    @answered
    def _on_attach(self, request: srv.Attach.Request, response: srv.Attach.Response) -> Diagnostic:
        with self._lock:
            self._world.attach(request.robot, request.object)
        return OBJECT_ATTACHED(robot=request.robot, object=request.object)

    @answered
    def _on_detach(self, request: srv.Detach.Request, response: srv.Detach.Response) -> Diagnostic:
        with self._lock:
            held = self._world.detach(request.robot)
        return OBJECT_DETACHED(robot=request.robot, object=held)

    def _on_get(
        self, request: srv.GetObjects.Request, response: srv.GetObjects.Response
    ) -> srv.GetObjects.Response:
        with self._lock:
            scene = self._contents.document()
        response.objects = [placement_to_message(thing) for thing in scene.objects]
        response.surfaces = [messages.surface_to_message(s) for s in scene.surfaces]
        return response

    @answered
    def _on_set(
        self, request: srv.SetObjects.Request, response: srv.SetObjects.Response
    ) -> Diagnostic:
        objects = placements_from_messages(request.objects)
        surfaces = [messages.surface_from_message(s) for s in request.surfaces]
        if request.dry_run:
            placed = self._contents.check(objects, surfaces)
        else:
            placed = self._contents.replace(objects, surfaces, self._lab_clock.instant_ns())
            self._publish_surfaces()
        response.objects = [placement_to_message(thing) for thing in placed]
        code = CONTENTS_FIT if request.dry_run else CONTENTS_SET
        return code(objects=len(placed), surfaces=len(surfaces))

    def _publish_surfaces(self) -> int:
        """Publish the surfaces and mark them for saving; return how many there are."""
        with self._lock:
            self._contents.changed = True
            surfaces = self._world.surfaces
        self._world_publishers.publish_surfaces(surfaces)
        return len(surfaces)
