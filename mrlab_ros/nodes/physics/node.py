"""The physics node: the world beside the graph, fed by joint states and telling what happens."""

from __future__ import annotations

import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from mrlab_msgs import srv
from rclpy.context import Context
from rclpy.parameter import Parameter
from std_srvs.srv import Trigger

from mrlab_ros.adapters.bullet import support
from mrlab_ros.adapters.robots.library import RobotLibrary
from mrlab_ros.adapters.scenes import files
from mrlab_ros.adapters.scenes.files import SceneFiles
from mrlab_ros.adapters.scenes.object_meshes import ObjectMeshes
from mrlab_ros.adapters.yaml_files import read_yaml
from mrlab_ros.core.clock import SECOND
from mrlab_ros.core.errors import BadInput, LabError
from mrlab_ros.core.physics import catalogue
from mrlab_ros.core.physics.engine import BodyState
from mrlab_ros.core.physics.settings import Settings
from mrlab_ros.core.physics.world import World
from mrlab_ros.core.scene.document import ObjectEntry
from mrlab_ros.messages import physics as messages
from mrlab_ros.messages.poses import pose_from_message
from mrlab_ros.nodes import parameters
from mrlab_ros.nodes.lab.scenes import (
    PendingGrasp,
    SceneLoader,
    Shared,
    document,
)
from mrlab_ros.nodes.parameters import PhysicsParameters
from mrlab_ros.nodes.physics.listener import GraphListener
from mrlab_ros.nodes.physics.publishers import WorldPublishers
from mrlab_ros.ros import share
from mrlab_ros.ros.answers import answered
from mrlab_ros.ros.deadlines import SWITCH_INTERVAL, LabClock
from mrlab_ros.ros.parameters import ParameterNode
from mrlab_ros.ros.spinning import Caller

try:
    from mrlab_ros.adapters.bullet.engine import BulletEngine
except ModuleNotFoundError as error:
    if error.name != "pybullet":
        raise
    raise BadInput(support.missing()) from None

# The world is looked after at least this often, ns: its own step.
TURN_NS = SECOND // 240
# After so many steps the other threads have their turn, and what happened is told.
MOST_STEPS = 24
SAVE_PERIOD = 2.0  # s


class PhysicsNode(ParameterNode[PhysicsParameters]):
    """Steps the world as joint states arrive; publishes contacts, collisions, grasps, objects."""

    def __init__(
        self,
        *,
        context: Context | None = None,
        parameter_overrides: list[Parameter] | None = None,
    ) -> None:
        super().__init__(
            "physics",
            PhysicsParameters,
            parameters.ALL,
            context=context,
            parameter_overrides=parameter_overrides,
        )
        state = self.parameters.state_dir
        folder = Path(state) if state else Path.home() / ".local" / "share" / "mrlab"
        self._file = folder / "physics.json" if state else None
        config = share.directory() / "config"
        self._files = SceneFiles(config / "scenes", folder / "scenes")
        self._settings = Settings.from_mapping(read_yaml(config / "physics.yaml"))
        meshes = ObjectMeshes(share.directory(), self._settings.max_triangles)
        self._types = catalogue.parse(read_yaml(config / "objects.yaml"), meshes)
        library = RobotLibrary(share.directory() / "robots")
        self._resolve = library.mesh_path
        self._lock = threading.Lock()
        self._lab_clock = LabClock()
        self._engine = BulletEngine(self._resolve)
        self._world = World(self._engine, self._types, self._settings)
        self._news = WorldPublishers(self, self._world)
        self._changed = False
        self._regrips: list[PendingGrasp] = []
        if self._file is not None and self._file.exists():
            self._restore(self._file)
        self._news.tell_surfaces(self._lab_clock.now_ns(), self._world.surfaces)
        self._ear = GraphListener(
            self, self._world, self._news, self._lock, self._turn, library.never_touch
        )
        # Answers come by another thread than the one that waits for them.
        self._caller = Caller(self)
        self._shared = Shared(
            self._world,
            self._lock,
            self._ear,
            self._lab_clock.now_ns,
            self._settings.max_objects,
            self._rehearsal,
        )
        self._scenes = SceneLoader(self._caller.node, self._shared, self._files)
        for kind, name, callback in (
            (srv.SpawnObject, "spawn_object", self._on_spawn),
            (srv.MoveObject, "move_object", self._on_move),
            (srv.Remove, "remove_object", self._on_remove),
            (Trigger, "clear_objects", self._on_clear),
            (srv.ListCatalogue, "list_catalogue", self._on_list),
            (srv.SetSurfaces, "set_surfaces", self._on_surfaces),
            (srv.Attach, "attach", self._on_attach),
            (srv.Detach, "detach", self._on_detach),
            (srv.SceneFile, "save_scene", self._on_save),
            (srv.SceneFile, "load_scene", self._on_load),
        ):
            self.create_service(kind, f"~/{name}", callback)
        if self._file is not None:
            self.create_timer(SAVE_PERIOD, self._save)
        # Python's own 5 ms that one thread may keep the others waiting would delay a halt.
        sys.setswitchinterval(SWITCH_INTERVAL)
        self._ear.start()

    def destroy_node(self) -> None:
        self._ear.stop()
        self._caller.close()
        self._changed = True
        self._save()
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

    # time -----------------------------------------------------------------------------------

    def _turn(self) -> int:
        """Advance the world and tell what happened; return how long to wait at most, ns.

        What goes wrong in one turn must not end the thread.
        """
        try:
            with self._lock:
                now_ns = self._lab_clock.now_ns()
                made = self._world.advance(now_ns, MOST_STEPS)
                if self._regrips:
                    self._regrip()
                self._changed |= self._news.tell(now_ns)
                if made == MOST_STEPS:
                    return 0
                return int(max(self._world.now_ns + TURN_NS - now_ns, TURN_NS // 4))
        except Exception as error:
            if self.context.ok():
                self.get_logger().error(f"physics: {error!r}", throttle_duration_sec=1.0)
            return TURN_NS

    def _save(self) -> None:
        """Keep the scene for a restart where it changed; the world does not wait for the file."""
        if self._file is None or not self._changed:
            return
        with self._lock:
            self._changed = False
            scene = document(self._shared)
        try:
            files.write(self._file, scene)
        except OSError as error:
            self._changed = True
            self.get_logger().error(
                f"the scene cannot be kept for a restart: {error}", throttle_duration_sec=60.0
            )

    def _restore(self, file: Path) -> None:
        """Take back the objects and surfaces of the last run; the robots come from the lab."""
        try:
            scene = files.read(file)
            self._world.set_surfaces(scene.surfaces)
        except LabError as error:
            self.get_logger().error(f"the last scene is not back: {error}")
            return
        for entry in scene.objects:
            try:
                self._put_back(entry)
            except LabError as error:
                self.get_logger().error(f"{entry.name} is not back: {error}")

    def _put_back(self, entry: ObjectEntry) -> None:
        self._world.spawn(entry.type, entry.name, entry.pose)
        if entry.held_by and entry.in_hand is not None:
            # It waits in the air for the robot that held it.
            still = BodyState(entry.pose)
            self._world.move(entry.name, entry.pose, still.linear, still.angular, held=True)
            self._regrips.append(PendingGrasp(entry.name, entry.held_by, entry.in_hand))

    def _regrip(self) -> None:
        """Let the robots of the last run have again what they held; forget who is gone."""
        present = {thing.name: thing for thing in self._world.objects}
        waiting = []
        for regrip in self._regrips:
            if regrip.name not in present:
                continue
            if self._ear.heard and regrip.robot not in self._ear.robots:
                thing = present[regrip.name]
                motion = self._world.motion(thing.name)
                self._world.move(
                    thing.name, motion.pose, motion.linear, motion.angular, held=False
                )
            elif not regrip.look(self._world):
                waiting.append(regrip)
        self._regrips = waiting

    # services -------------------------------------------------------------------------------

    @answered
    def _on_spawn(self, request: Any, response: Any) -> str:
        pose = pose_from_message(request.pose)
        with self._lock:
            thing = self._world.spawn(
                request.type, request.name, pose, automatic=request.automatic
            )
            response.object = messages.object_to_message(thing, self._world.motion(thing.name))
        p = response.object.pose.position
        return f"{thing.name} is at {p.x:.3g}, {p.y:.3g}, {p.z:.3g} m"

    @answered
    def _on_move(self, request: Any, response: Any) -> str:
        with self._lock:
            self._world.move(
                request.name,
                pose_from_message(request.pose),
                messages.velocity_from_message(request.twist.linear),
                messages.velocity_from_message(request.twist.angular),
                held=request.held,
            )
        return f"{request.name} is {'held' if request.held else 'let go'}"

    @answered
    def _on_remove(self, request: Any, response: Any) -> str:
        with self._lock:
            self._world.remove(request.name)
        return f"{request.name} is removed"

    @answered
    def _on_clear(self, request: Any, response: Any) -> str:
        with self._lock:
            return f"{self._world.clear()} objects are removed"

    def _on_list(self, request: Any, response: Any) -> Any:
        response.types = [messages.type_to_message(self._types.get(i)) for i in self._types.ids]
        response.limit = self._settings.max_objects
        return response

    @answered
    def _on_surfaces(self, request: Any, response: Any) -> str:
        surfaces = [messages.surface_from_message(s) for s in request.surfaces]
        with self._lock:
            inside = self._world.set_surfaces(surfaces)
        count = self._tell_surfaces()
        if inside:
            return (
                f"{count} surfaces; {', '.join(inside)} stand in a robot and count once it has "
                "moved out of them"
            )
        return f"{count} surfaces"

    @answered
    def _on_attach(self, request: Any, response: Any) -> str:
        with self._lock:
            self._world.attach(request.robot, request.object)
        return f"{request.robot} holds {request.object}"

    @answered
    def _on_detach(self, request: Any, response: Any) -> str:
        with self._lock:
            return f"{request.robot} lost {self._world.detach(request.robot)}"

    @answered
    def _on_save(self, request: Any, response: Any) -> str:
        with self._lock:
            scene = document(self._shared)
        path = self._files.save(request.name, scene)
        return f"saved {len(scene.robots)} robots, {len(scene.objects)} objects in {path}"

    @answered
    def _on_load(self, request: Any, response: Any) -> str:
        with self._lock:
            self._regrips.clear()
        try:
            return self._scenes.load(request.name)
        finally:
            self._tell_surfaces()

    def _tell_surfaces(self) -> int:
        """Tell the room as it is, and have it kept; return how many surfaces it has."""
        with self._lock:
            self._changed = True
            surfaces = self._world.surfaces
        self._news.tell_surfaces(self._lab_clock.now_ns(), surfaces)
        return len(surfaces)
