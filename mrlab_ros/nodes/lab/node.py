"""The lab node: the set of robots in the scene."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress
from dataclasses import replace
from functools import partial
from pathlib import Path
from secrets import token_hex
from typing import TYPE_CHECKING

from mrlab_msgs import msg, srv
from rclpy.publisher import Publisher
from std_msgs.msg import String

from mrlab_ros.adapters import journal_file, share
from mrlab_ros.adapters.robots.library import RobotLibrary
from mrlab_ros.adapters.robots.publishing import published
from mrlab_ros.adapters.scenes.files import SCENE_FILE, SceneFiles, StateFile
from mrlab_ros.core.base.diagnostic import Diagnostic
from mrlab_ros.core.base.errors import BadInput, LabError
from mrlab_ros.core.base.geometry import Pose
from mrlab_ros.core.robots.controllers import Controller
from mrlab_ros.core.robots.frames import joint_name
from mrlab_ros.core.runtime.identity import Identity
from mrlab_ros.core.scene.diagnostics import NO_SUCH_PLACE, PLACE_SET
from mrlab_ros.core.scene.document import Place, RobotEntry, SceneDocument, checked_text
from mrlab_ros.core.scene.restore import self_contained, with_pending
from mrlab_ros.core.scene.robots import PlacedRobot, Scene
from mrlab_ros.core.scene.undo import removed_with
from mrlab_ros.core.systems import registry
from mrlab_ros.messages import qos
from mrlab_ros.messages.poses import pose_from_message
from mrlab_ros.messages.scenes import (
    robot_entry,
    robot_to_message,
    robots_to_message,
    system_entry,
    text_to_message,
    things_of_scene,
)
from mrlab_ros.messages.time import make_header
from mrlab_ros.nodes import parameters
from mrlab_ros.nodes.lab.controllers import ControllerManager
from mrlab_ros.nodes.lab.diagnostics import (
    END_EFFECTOR_REMOVED,
    END_EFFECTOR_SET,
    NOT_AS_BEFORE,
    ROBOT_LEFT_OUT,
    ROBOT_PLACED,
    ROBOT_REMOVED,
    ROBOT_SPAWNED,
    SYSTEM_LEFT_OUT,
)
from mrlab_ros.nodes.lab.observer import Observer
from mrlab_ros.nodes.lab.restore import LabRestore, Return
from mrlab_ros.nodes.lab.scenes import Scenes
from mrlab_ros.nodes.lab.undo import Undo
from mrlab_ros.nodes.parameters import LabParameters
from mrlab_ros.ros.clock import LabClock, every
from mrlab_ros.ros.decoding import subscribe
from mrlab_ros.ros.parameters import NodeArguments, ParameterNode
from mrlab_ros.ros.services import answered, create_service
from mrlab_ros.ros.spinning import Caller

if TYPE_CHECKING:
    from typing_extensions import Unpack

# Period of writing changed loaded trajectories and places of robots, s.
SAVE_PERIOD_S = 2.0
# Which systems there are is written sooner: one that was dissolved must not come back, s.
SYSTEMS_PERIOD_S = 0.1


class LabNode(ParameterNode[LabParameters], name="lab", kind=LabParameters, others=parameters.ALL):
    """Spawns, places and removes robots, and announces who is where."""

    def __init__(self, **ros: Unpack[NodeArguments]) -> None:
        super().__init__(**ros)
        state_dir = self.parameters.state_dir
        log = self.get_logger()
        file = Path(state_dir) / SCENE_FILE if state_dir else None
        self._file = StateFile(file, log.error, whole=True)
        # Diagnostics of state that could not be brought back.
        self.lost: list[Diagnostic] = []
        self._library = RobotLibrary(share.directory() / "robots")
        self._scene = Scene()
        self._descriptions: dict[str, Publisher] = {}
        self._robots = self.create_publisher(msg.Robots, "/robots", qos.LATCHED)
        # Service responses need a second executor thread: load_scene waits for them.
        self._caller = Caller(self)
        self._identity = Identity(self.parameters.lab_id, self._meet)
        self._lab_clock = LabClock(self)
        subscribe(self._caller.node, msg.Robots, "/robots", self._on_robots, qos.LATCHED)
        self._observer = Observer(self._caller.node, self._identity)
        self._restore = LabRestore(self._caller.node, self._observer, self)
        folder = Path(state_dir) if state_dir else Path.home() / ".local" / "share" / "mrlab"
        self._scenes = Scenes(
            self._caller.node,
            SceneFiles(share.directory() / "config" / "scenes", folder / "scenes"),
            self._library,
            self._observer,
            self._restore,
            self._document,
        )
        self._undo = Undo(self, self._observer, self._restore, self._lab_clock, self._names)
        last = self._file.load()
        if last is None:
            for model in self.parameters.robots:
                self._spawn(model, None, "", None)
            last = SceneDocument()
        last = self._without_dissolved(last)
        # The ids of the places where the lab has been.
        self._known_places: set[str] = set()
        self._place = last.place or Place(token_hex(6))
        self._places = self.create_publisher(msg.Place, "/place", qos.LATCHED)
        self._return = Return(
            self._restore_robots(last),
            self._restore,
            self._observer,
            log.warning,
            self._lose,
        )
        self._announce()
        self.go_to(self._place)
        for kind, name, callback in (
            (srv.SpawnRobot, "spawn_robot", self._on_spawn),
            (srv.PlaceRobot, "place_robot", self._on_place),
            (srv.SetEndEffector, "set_end_effector", self._on_end_effector),
            (srv.Remove, "remove_robot", self._on_remove),
            (srv.SceneFile, "save_scene", self._on_save_scene),
            (srv.SceneFile, "load_scene", self._on_load_scene),
            (srv.ListScenes, "list_scenes", self._on_list_scenes),
            (srv.Undo, "undo", self._on_undo),
            (srv.SetPlace, "set_place", self._on_set_place),
        ):
            create_service(self, kind, f"~/{name}", callback)
        ControllerManager(self, self._controllers)
        subscribe(self, msg.Move, "/moves", self._on_move, qos.NEWEST)
        every(self, SAVE_PERIOD_S, self._save)
        every(self, SYSTEMS_PERIOD_S, self._save_systems)
        self._return.start()

    def destroy_node(self) -> None:
        self._return.cancel()
        self._save()
        self._caller.close()
        super().destroy_node()

    # robots ---------------------------------------------------------------------------------

    def _spawn(
        self, model_id: str, end_effector: str | None, name: str, pose: Pose | None
    ) -> PlacedRobot:
        model = self._library.model(model_id)
        description = self._library.description(model_id, end_effector)
        robot = self._scene.spawn(
            PlacedRobot(
                name or self._scene.free_name(model_id),
                model_id,
                end_effector,
                pose or self._scene.free_pose(model.reach),
                model.reach,
                model.joint_names,
            )
        )
        self._describe(robot.name, description)
        return robot

    def _names(self) -> frozenset[str]:
        return frozenset(robot.name for robot in self._scene.robots)

    def _describe(self, name: str, description: str) -> None:
        if name not in self._descriptions:
            self._descriptions[name] = self.create_publisher(
                String, f"/{name}/robot_description", qos.LATCHED
            )
        self._descriptions[name].publish(text_to_message(published(description, name)))

    def _announce(self) -> None:
        now_ns = self._lab_clock.now_ns()
        self._robots.publish(robots_to_message(now_ns, self._scene.robots, self._identity.lab))
        self._observer.follow([robot.name for robot in self._scene.robots])
        self._save()

    def _controllers(self) -> list[Controller]:
        states = {robot.name: self._observer.state(robot.name) for robot in self._scene.robots}
        return [
            Controller(
                robot.name,
                tuple(joint_name(robot.name, joint) for joint in robot.joint_names),
                state.system if (state := states[robot.name]) is not None else "",
            )
            for robot in self._scene.robots
        ]

    def spawn(self, robots: Sequence[RobotEntry]) -> None:
        """Put the robots of a document into the scene; raise LabError where one cannot be."""
        try:
            for robot in robots:
                self._spawn_entry(robot)
        finally:
            self._announce()

    def _spawn_entry(self, robot: RobotEntry) -> None:
        self._spawn(robot.model, robot.end_effector or None, robot.name, robot.pose)

    def remove(self, names: Sequence[str]) -> None:
        """Take robots out of the scene; raise LabError where one is not there."""
        try:
            for name in names:
                self._remove(name)
        finally:
            self._announce()

    def _remove(self, name: str) -> None:
        self._scene.remove(name)
        self.destroy_publisher(self._descriptions.pop(name))

    def go_to(self, place: Place) -> None:
        """Announce that the robots stand in a place."""
        self._place = place
        self._known_places.add(place.id)
        header = make_header(self._lab_clock.now_ns())
        self._places.publish(msg.Place(header=header, id=place.id, name=place.name))

    # what a restart brings back ---------------------------------------------------------------

    def _document(self) -> SceneDocument:
        """Return the robots with what they have loaded, and the systems."""
        now_ns = self._lab_clock.now_ns()
        observer = self._observer
        scene = SceneDocument(
            robots=tuple(
                robot_entry(robot, observer.state(robot.name), now_ns)
                for robot in self._scene.robots
            ),
            systems=tuple(system_entry(system, now_ns) for system in observer.systems or ()),
            place=self._place,
        )
        return self_contained(with_pending(scene, self._return.pending))

    def _save(self) -> None:
        self._file.save(self._document())

    def _save_systems(self) -> None:
        if self._observer.systems_changed.is_set():
            self._observer.systems_changed.clear()
            self._save()

    def _on_robots(self, message: msg.Robots) -> None:
        self._identity.obeys(message.lab)

    def _meet(self, said: Diagnostic) -> None:
        """Name another lab, also on /diagnostics."""
        self.lost.append(said)
        self.get_logger().warning(str(said))

    def _lose(self, why: Diagnostic) -> None:
        """Keep a copy of the state file, and say what could not be brought back."""
        self.lost.append(why)
        self._file.keep_copy(str(why))

    def _without_dissolved(self, last: SceneDocument) -> SceneDocument:
        """Leave out systems that the coordinator dissolved: its journal is written at once."""
        kept = journal_file.peek(self.parameters.state_dir, "coordinator")
        if kept is None:
            return last
        names = {name for name, _, _ in registry.read(kept)}
        return replace(last, systems=tuple(s for s in last.systems if s.name in names))

    def _restore_robots(self, last: SceneDocument) -> SceneDocument:
        """Spawn the robots of the last run; return the document without those that cannot be."""
        restored: list[RobotEntry] = []
        mistakes: list[Diagnostic] = []
        for robot in last.robots:
            try:
                self._spawn_entry(robot)
            except LabError as error:
                mistakes.append(ROBOT_LEFT_OUT(robot=robot.name, why=error.diagnostic))
            else:
                restored.append(robot)
        intact = self_contained(replace(last, robots=tuple(restored)))
        mistakes += [
            SYSTEM_LEFT_OUT(system=system.name)
            for system in last.systems
            if system not in intact.systems
        ]
        if mistakes:
            self._lose(NOT_AS_BEFORE(all=mistakes))
        if restored:
            self.get_logger().info(f"the scene is back with {len(restored)} robots")
        return intact

    # services ---------------------------------------------------------------------------------

    @answered
    def _on_spawn(
        self, request: srv.SpawnRobot.Request, response: srv.SpawnRobot.Response
    ) -> Diagnostic:
        if request.automatic:
            pose = self._automatic_pose(request)
        else:
            pose = pose_from_message(request.pose)
        self._file.check_room()
        robot = self._spawn(request.model, request.end_effector or None, request.name, pose)
        self._announce()
        response.robot = robot_to_message(robot)
        return ROBOT_SPAWNED(robot=robot.name, place=[*robot.pose.position])

    def _automatic_pose(self, request: srv.SpawnRobot.Request) -> Pose:
        reach = self._library.model(request.model).reach
        viewer = pose_from_message(request.viewer) if request.has_viewer else None
        seen = self._observer
        return self._scene.free_pose_on(reach, request.surface, viewer, seen.supports, seen.things)

    @answered
    def _on_place(
        self, request: srv.PlaceRobot.Request, response: srv.PlaceRobot.Response
    ) -> Diagnostic:
        self._file.check_room()
        self._scene.place(request.robot, pose_from_message(request.pose), request.hand)
        self._announce()
        return ROBOT_PLACED(robot=request.robot)

    def _on_move(self, move: msg.Move) -> None:
        # The call that puts it down says what is wrong with a place; a move has no answer.
        with suppress(LabError):
            pose = pose_from_message(move.pose)
            if self._scene.follow(move.robot, move.hand, move.sequence, pose):
                self._announce()

    @answered
    def _on_end_effector(
        self, request: srv.SetEndEffector.Request, response: srv.SetEndEffector.Response
    ) -> Diagnostic:
        robot = self._scene.robot(request.robot)
        end_effector = request.end_effector or None
        description = self._library.description(robot.model, end_effector)
        self._file.check_room()
        self._scene.set_end_effector(robot.name, end_effector)
        self._describe(robot.name, description)
        self._announce()
        if end_effector is None:
            return END_EFFECTOR_REMOVED(robot=robot.name)
        return END_EFFECTOR_SET(robot=robot.name, end_effector=end_effector)

    @answered
    def _on_remove(self, request: srv.Remove.Request, response: srv.Remove.Response) -> Diagnostic:
        held = things_of_scene(self._observer.objects, self._names())
        lost = removed_with(request.name, self._document(), held)
        self.remove([request.name])
        said = ROBOT_REMOVED(robot=request.name)
        self._undo.note(said, lost)
        return said

    @answered
    def _on_save_scene(
        self, request: srv.SceneFile.Request, response: srv.SceneFile.Response
    ) -> Diagnostic:
        return self._scenes.save(request.name)

    @answered
    def _on_load_scene(
        self, request: srv.SceneFile.Request, response: srv.SceneFile.Response
    ) -> Diagnostic:
        self._file.check_room()
        self._return.finish()
        with self._undo:
            return self._scenes.load(
                request.name, self._names(), partial(self._undo.note, whole=True)
            )

    @answered
    def _on_undo(self, request: srv.Undo.Request, response: srv.Undo.Response) -> Diagnostic:
        self._file.check_room()
        return self._undo.undo(request.id, self._scenes)

    @answered
    def _on_set_place(
        self, request: srv.SetPlace.Request, response: srv.SetPlace.Response
    ) -> Diagnostic:
        place = Place(request.id or token_hex(6), checked_text(request.name))
        if request.id and request.id not in self._known_places:
            raise BadInput(NO_SUCH_PLACE(place=request.id))
        self._file.check_room()
        self.go_to(place)
        self._save()
        return PLACE_SET(place=request.name)

    def _on_list_scenes(
        self, request: srv.ListScenes.Request, response: srv.ListScenes.Response
    ) -> srv.ListScenes.Response:
        response.scenes = list(self._scenes.names())
        return response
