"""The physics node: the world beside the graph, fed by joint states and telling what happens."""

from __future__ import annotations

import functools
import threading
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
from geometry_msgs.msg import Point, Twist, Vector3
from geometry_msgs.msg import Pose as PoseMessage
from mrlab_msgs import msg, srv
from rclpy.context import Context
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.publisher import Publisher
from rclpy.serialization import deserialize_message
from rclpy.subscription import Subscription
from sensor_msgs.msg import JointState
from std_msgs.msg import ColorRGBA, String
from std_srvs.srv import Trigger

from mrlab_ros import conversions, host, qos, share
from mrlab_ros.adapters import scene_files
from mrlab_ros.adapters.bullet import BulletEngine
from mrlab_ros.adapters.robot_library import END_EFFECTORS, read_yaml
from mrlab_ros.adapters.scene_files import SceneFiles
from mrlab_ros.core.clock import SECOND, PlaybackClock
from mrlab_ros.core.errors import BadInput, LabError
from mrlab_ros.core.physics import catalogue
from mrlab_ros.core.physics.engine import Kind, Motion
from mrlab_ros.core.physics.grasp import Gripper
from mrlab_ros.core.physics.poses import Vector, checked_vector
from mrlab_ros.core.physics.robot import GripperProgram, Playing
from mrlab_ros.core.physics.scene_document import (
    ObjectEntry,
    RobotEntry,
    SceneDocument,
    SystemEntry,
)
from mrlab_ros.core.physics.settings import Settings
from mrlab_ros.core.physics.surfaces import Surface
from mrlab_ros.core.physics.world import (
    CollisionChanged,
    Contact,
    Event,
    GraspChanged,
    ObjectRemoved,
    SceneObject,
    World,
)
from mrlab_ros.core.playback_states import State
from mrlab_ros.nodes.answers import answered
from mrlab_ros.nodes.calls import call
from mrlab_ros.nodes.lab import pose_from_message, pose_to_message
from mrlab_ros.scheduler import LabClock
from mrlab_ros.spinning import Caller
from mrlab_ros.wait_set import WaitSetThread

PACKAGE = "package://mrlab_ros/"
# The world is looked after at least this often, ns: its own step.
TURN_NS = SECOND // 240
CONTACTS_NS = SECOND // 50
OBJECTS_NS = SECOND // 30
REPEAT_NS = SECOND
SAVE_NS = 2 * SECOND
# An object that moved less than this since it was last told stands still, m or m/s.
STILL = 1e-4


def resolve(uri: str) -> Path:
    """Return the path of a package:// URI of the lab's own."""
    if not uri.startswith(PACKAGE):
        raise BadInput(f"the mesh {uri} is not of this lab; expected {PACKAGE}robots/...")
    return share.directory() / uri.removeprefix(PACKAGE)


@dataclass(eq=False)
class Listened:
    """A robot of /robots: what is known of it, and where its news come from and go to."""

    robot: msg.Robot
    subscriptions: list[Subscription]
    collision: Publisher
    grasp: Publisher
    description: str = ""
    built: tuple[str, str] = ("", "")
    program: GripperProgram = field(default_factory=GripperProgram)
    playing: Playing = field(default_factory=Playing)


class PhysicsNode(Node):
    """Steps the world as joint states arrive; publishes contacts, collisions, grasps, objects."""

    def __init__(
        self,
        *,
        context: Context | None = None,
        parameter_overrides: list[Parameter] | None = None,
    ) -> None:
        super().__init__("physics", context=context, parameter_overrides=parameter_overrides or [])
        state = self.declare_parameter("state_dir", "").value
        folder = Path(state) if state else Path.home() / ".local" / "share" / "mrlab"
        self._file = folder / "physics.yaml" if state else None
        config = share.directory() / "config"
        self._files = SceneFiles(config / "scenes", folder / "scenes")
        settings = Settings.from_mapping(read_yaml(config / "physics.yaml"))
        types = catalogue.parse(read_yaml(config / "objects.yaml"))
        self._lock = threading.Lock()
        self._lab_clock = LabClock()
        self._engine = BulletEngine(resolve)
        self._world = World(self._engine, types, settings)
        self._robots: dict[str, Listened] = {}
        self._systems: list[msg.RobotSystem] = []
        self._told: dict[str, tuple[msg.SceneObject, Motion, str]] = {}
        self._next_contacts_ns = self._next_objects_ns = self._repeat_ns = self._save_ns = 0
        self._announced = False
        self._contacts = self.create_publisher(msg.Contacts, "/contacts", qos.EVENTS)
        self._objects = self.create_publisher(msg.SceneObjects, "/objects", qos.LATCHED)
        self._surfaces = self.create_publisher(msg.Surfaces, "/surfaces", qos.LATCHED)
        if self._file is not None and self._file.exists():
            self._restore(self._file)
        self._announce_surfaces()
        self._serve()
        # Joint states come a thousand times a second: they bypass the executor.
        self._ear = Node(
            "physics_ear", context=context, start_parameter_services=False, enable_rosout=False
        )
        self._thread = WaitSetThread(self.context, "physics", self._turn, self._on_error)
        self._hear(msg.Robots, "/robots", self._on_robots, qos.LATCHED)
        self._hear(msg.RobotSystems, "/systems", self._on_systems, qos.LATCHED)
        self._thread.start()

    def _serve(self) -> None:
        for kind, name, callback in (
            (srv.SpawnObject, "spawn_object", self._on_spawn),
            (srv.MoveObject, "move_object", self._on_move),
            (srv.Remove, "remove_object", self._on_remove),
            (Trigger, "clear_objects", self._on_clear),
            (srv.SetSurfaces, "set_surfaces", self._on_surfaces),
            (srv.Attach, "attach", self._on_attach),
            (srv.Detach, "detach", self._on_detach),
            (srv.SceneFile, "save_scene", self._on_save),
            (srv.SceneFile, "load_scene", self._on_load),
        ):
            self.create_service(kind, f"~/{name}", callback)
        # Answers come by another thread than the one that waits for them.
        self._caller = Caller(self)
        client = self._caller.node.create_client
        self._spawn_robot = client(srv.SpawnRobot, "/lab/spawn_robot")
        self._remove_robot = client(srv.Remove, "/lab/remove_robot")
        self._create_system = client(srv.CreateSystem, "/coordinator/create_system")
        self._dissolve_system = client(srv.Remove, "/coordinator/dissolve_system")

    def destroy_node(self) -> None:
        self._thread.stop()
        self._caller.close()
        with self._lock:
            if self._file is not None:
                scene_files.write(self._file, self._document())
            self._engine.close()
        self._ear.destroy_node()
        super().destroy_node()

    # what the graph says --------------------------------------------------------------------

    def _hear(
        self, kind: Any, topic: str, callback: Callable[[Any], None], quality: Any
    ) -> Subscription:
        subscription = self._ear.create_subscription(kind, topic, _unused, quality, raw=True)
        self._thread.add_subscription(
            subscription, lambda data: callback(deserialize_message(data, kind))
        )
        return subscription

    def _on_error(self, error: Exception) -> None:
        self.get_logger().error(f"physics: {error}", throttle_duration_sec=1.0)

    def _on_systems(self, message: msg.RobotSystems) -> None:
        self._systems = list(message.systems)

    def _on_robots(self, message: msg.Robots) -> None:
        wanted = {robot.name: robot for robot in message.robots}
        for name, known in list(self._robots.items()):
            if name not in wanted or wanted[name].model != known.robot.model:
                self._forget(name)
        for name, robot in wanted.items():
            if name not in self._robots:
                self._listen(robot)
                continue
            known = self._robots[name]
            moved = known.robot.pose != robot.pose
            known.robot = robot
            self._build(name)
            if moved:
                with self._lock:
                    if name in self._world.robots:
                        self._world.place_robot(name, pose_from_message(robot.pose))

    def _listen(self, robot: msg.Robot) -> None:
        name = robot.name

        def hear(kind: Any, topic: str, callback: Callable[[str, Any], None], quality: Any) -> Any:
            return self._hear(kind, f"/{name}/{topic}", functools.partial(callback, name), quality)

        self._robots[name] = Listened(
            robot,
            [],
            self.create_publisher(msg.Collision, f"/{name}/collision", qos.LATCHED),
            self.create_publisher(msg.Grasp, f"/{name}/grasp", qos.LATCHED),
        )
        self._robots[name].subscriptions += [
            hear(String, "robot_description", self._on_description, qos.LATCHED),
            hear(JointState, "joint_states", self._on_joint_state, qos.STREAM),
            hear(msg.PlaybackState, "playback_state", self._on_playback, qos.LATCHED),
            hear(msg.GraspTargets, "targets", self._on_targets, qos.LATCHED),
        ]

    def _forget(self, name: str) -> None:
        known = self._robots.pop(name)
        for subscription in known.subscriptions:
            self._thread.remove(subscription)
            self._ear.destroy_subscription(subscription)
        with self._lock:
            if name in self._world.robots:
                self._world.remove_robot(name)
        self.destroy_publisher(known.collision)
        self.destroy_publisher(known.grasp)

    def _on_description(self, name: str, message: String) -> None:
        self._robots[name].description = message.data
        self._build(name)

    def _build(self, name: str) -> None:
        """Put the robot into the world, anew where its description or end effector changed."""
        known = self._robots[name]
        wanted = (known.description, known.robot.end_effector)
        if not known.description or known.built == wanted:
            return
        known.built = wanted
        with self._lock:
            if name in self._world.robots:
                self._world.remove_robot(name)
            try:
                self._world.add_robot(
                    name,
                    known.description,
                    tuple(known.robot.joint_names),
                    pose_from_message(known.robot.pose),
                    _gripper(known.robot.end_effector),
                )
                self._world.set_program(name, known.program)
                self._world.playback(name, known.playing)
            except LabError as error:
                self.get_logger().error(f"{name} has no physics: {error}")

    def _on_joint_state(self, name: str, message: JointState) -> None:
        stamp_ns = conversions.to_ns(message.header.stamp)
        with self._lock:
            if name in self._world.robots:
                self._world.joint_state(
                    name, stamp_ns, np.array(message.position), np.array(message.velocity)
                )

    def _on_playback(self, name: str, message: msg.PlaybackState) -> None:
        clock = message.clock
        playing = Playing(
            State(message.state),
            message.trajectory_id,
            PlaybackClock(conversions.to_ns(clock.stamp), clock.position, clock.rate),
            message.frame,
            message.frame_count,
            message.frame_rate,
            message.duration,
        )
        self._robots[name].playing = playing
        with self._lock:
            if name in self._world.robots:
                self._world.playback(name, playing)

    def _on_targets(self, name: str, message: msg.GraspTargets) -> None:
        program = GripperProgram(
            tuple(target.time for target in message.targets),
            tuple(target.close for target in message.targets),
        )
        self._robots[name].program = program
        with self._lock:
            if name in self._world.robots:
                self._world.set_program(name, program)

    # time -----------------------------------------------------------------------------------

    def _turn(self) -> int:
        """Do a turn of the world's; what goes wrong in one must not end the thread."""
        try:
            return self._advance()
        except Exception as error:
            if self.context.ok():
                self.get_logger().error(f"physics: {error!r}", throttle_duration_sec=1.0)
            return TURN_NS

    def _advance(self) -> int:
        """Advance the world and tell what happened; return how long to wait at most, ns."""
        with self._lock:
            now_ns = self._lab_clock.now_ns()
            self._world.advance(now_ns)
            for event in self._world.take_events():
                self._tell(event)
            if now_ns >= self._next_contacts_ns:
                contacts = self._world.take_contacts()
                if contacts:
                    self._next_contacts_ns = now_ns + CONTACTS_NS
                    self._contacts.publish(
                        msg.Contacts(
                            header=conversions.header(now_ns, "world"),
                            contacts=[_contact(c) for c in contacts],
                        )
                    )
            if now_ns >= self._next_objects_ns:
                self._next_objects_ns = now_ns + OBJECTS_NS
                self._announce_objects(now_ns)
            return int(max(self._world.now_ns + TURN_NS - now_ns, TURN_NS // 4))

    def _tell(self, event: Event) -> None:
        if isinstance(event, ObjectRemoved):
            self.get_logger().info(f"{event.name} is removed: {event.why}")
            return
        known = self._robots.get(event.robot)
        if known is None:
            return
        if isinstance(event, CollisionChanged):
            known.collision.publish(
                msg.Collision(
                    header=conversions.header(event.stamp_ns, "world"),
                    colliding=event.colliding,
                    contact=_contact(event.contact) if event.contact else msg.Contact(),
                    clearance=event.clearance,
                )
            )
        elif isinstance(event, GraspChanged):
            fingers = self._world.robot(event.robot).arm.fingers
            known.grasp.publish(
                msg.Grasp(
                    header=conversions.header(event.stamp_ns, f"{event.robot}/tool0"),
                    state=event.state.value,
                    object=event.object,
                    fingers=[finger.joint for finger in fingers],
                    finger_positions=event.positions,
                    finger_forces=event.forces,
                )
            )

    def _announce_objects(self, now_ns: int) -> None:
        """Publish all objects where one came, went or moved; else once a second."""
        changed = not self._announced or self._told.keys() != {
            thing.name for thing in self._world.objects
        }
        told: dict[str, tuple[msg.SceneObject, Motion, str]] = {}
        for thing in self._world.objects:
            motion = self._world.motion(thing.name)
            before = self._told.get(thing.name)
            if before is not None and before[2] == thing.held_by and _still(before[1], motion):
                told[thing.name] = before
                continue
            changed = True
            told[thing.name] = (_object(thing, motion), motion, thing.held_by)
        self._told = told
        if not changed and now_ns < self._repeat_ns:
            return
        self._announced = True
        self._repeat_ns = now_ns + REPEAT_NS
        self._objects.publish(
            msg.SceneObjects(
                header=conversions.header(now_ns, "world"), objects=[t[0] for t in told.values()]
            )
        )
        if changed and self._file is not None and now_ns >= self._save_ns:
            self._save_ns = now_ns + SAVE_NS
            scene_files.write(self._file, self._document())

    def _announce_surfaces(self) -> None:
        self._surfaces.publish(
            msg.Surfaces(
                header=conversions.header(self._lab_clock.now_ns(), "world"),
                surfaces=[_surface(surface) for surface in self._world.surfaces],
            )
        )

    # services -------------------------------------------------------------------------------

    @answered
    def _on_spawn(self, request: Any, response: Any) -> str:
        pose = pose_from_message(request.pose)
        with self._lock:
            thing = self._world.spawn(
                request.type, request.name, pose, automatic=request.automatic
            )
            response.object = _object(thing, self._world.motion(thing.name))
        p = response.object.pose.position
        return f"{thing.name} is at {p.x:.3g}, {p.y:.3g}, {p.z:.3g} m"

    @answered
    def _on_move(self, request: Any, response: Any) -> str:
        with self._lock:
            self._world.move(
                request.name,
                pose_from_message(request.pose),
                _vector(request.twist.linear),
                _vector(request.twist.angular),
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

    @answered
    def _on_surfaces(self, request: Any, response: Any) -> str:
        surfaces = [_surface_from_message(s) for s in request.surfaces]
        with self._lock:
            inside = self._world.set_surfaces(surfaces)
            self._announce_surfaces()
            count = len(self._world.surfaces)
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

    # scenes ---------------------------------------------------------------------------------

    def _document(self) -> SceneDocument:
        return SceneDocument(
            robots=tuple(
                RobotEntry(
                    known.robot.name,
                    known.robot.model,
                    known.robot.end_effector,
                    pose_from_message(known.robot.pose),
                )
                for known in self._robots.values()
            ),
            objects=tuple(
                ObjectEntry(thing.name, thing.type.id, self._world.motion(thing.name).pose)
                for thing in self._world.objects
            ),
            surfaces=self._world.surfaces,
            systems=tuple(
                SystemEntry(
                    system.name,
                    tuple((m.robot, m.trajectory_id) for m in system.members),
                    system.mode,
                    system.policy,
                    system.loop,
                )
                for system in self._systems
            ),
        )

    def _restore(self, file: Path) -> None:
        """Take back the objects and surfaces of the last run; the robots come from the lab."""
        try:
            scene = scene_files.read(file)
            self._world.set_surfaces(scene.surfaces)
            for entry in scene.objects:
                self._world.spawn(entry.type, entry.name, entry.pose)
        except LabError as error:
            self.get_logger().error(f"the last scene is not all back: {error}")

    @answered
    def _on_save(self, request: Any, response: Any) -> str:
        with self._lock:
            document = self._document()
        path = self._files.save(request.name, document)
        return f"saved {len(document.robots)} robots, {len(document.objects)} objects in {path}"

    @answered
    def _on_load(self, request: Any, response: Any) -> str:
        scene = self._files.load(request.name)
        for system in self._systems:
            _demand(call(self._dissolve_system, srv.Remove.Request(name=system.name)))
        for name in list(self._robots):
            _demand(call(self._remove_robot, srv.Remove.Request(name=name)))
        with self._lock:
            self._world.clear()
            self._world.set_surfaces(scene.surfaces)
            self._announce_surfaces()
            for thing in scene.objects:
                self._world.spawn(thing.type, thing.name, thing.pose, automatic=thing.automatic)
        for robot in scene.robots:
            wanted = srv.SpawnRobot.Request(
                model=robot.model,
                end_effector=robot.end_effector,
                name=robot.name,
                pose=pose_to_message(robot.pose),
            )
            _demand(call(self._spawn_robot, wanted))
        for entry in scene.systems:
            members = [msg.SystemMember(robot=r, trajectory_id=t) for r, t in entry.members]
            _demand(
                call(
                    self._create_system,
                    srv.CreateSystem.Request(
                        name=entry.name,
                        members=members,
                        mode=entry.mode,
                        policy=entry.policy,
                        loop=entry.loop,
                    ),
                    timeout=15.0,
                )
            )
        return f"loaded {len(scene.robots)} robots, {len(scene.objects)} objects"


def _unused(message: Any) -> None:
    """The wait set takes the messages; rclpy wants a callback all the same."""


def _demand(answer: Any) -> None:
    """Raise BadInput with the reason where another node refused."""
    if not answer.success:
        raise BadInput(f"the scene is loaded in part: {answer.message}")


def _gripper(end_effector: str) -> Gripper:
    if not end_effector:
        return Gripper.NONE
    path = share.directory() / "robots" / END_EFFECTORS / end_effector / "end_effector.yaml"
    kind = str(read_yaml(path).get("class", ""))
    return Gripper.VACUUM if "vacuum" in kind else Gripper.FINGERS


def _vector(message: Any) -> Vector:
    return checked_vector((message.x, message.y, message.z), "the velocity")


def _vector3(v: Vector) -> Vector3:
    return Vector3(x=v[0], y=v[1], z=v[2])


def _still(before: Motion, now: Motion) -> bool:
    pairs = (
        *zip(before.pose.position, now.pose.position, strict=True),
        *zip(before.pose.orientation, now.pose.orientation, strict=True),
    )
    return all(abs(a - b) < STILL for a, b in pairs)


def _contact(contact: Contact) -> msg.Contact:
    touch = contact.touch
    return msg.Contact(
        stamp=conversions.stamp(contact.stamp_ns),
        robot=contact.robot,
        link=touch.link,
        kind=touch.kind.value,
        other=contact.robot if touch.kind is Kind.SELF else touch.other,
        other_link=touch.other_link,
        point=Point(x=touch.point[0], y=touch.point[1], z=touch.point[2]),
        normal=_vector3(touch.normal),
        depth=touch.depth,
        impulse=touch.impulse,
        frame=contact.frame,
    )


def _object(thing: SceneObject, motion: Motion) -> msg.SceneObject:
    kind = thing.type
    r, g, b, a = kind.color
    return msg.SceneObject(
        name=thing.name,
        type=kind.id,
        pose=pose_to_message(motion.pose),
        twist=Twist(linear=_vector3(motion.linear), angular=_vector3(motion.angular)),
        size=_vector3(kind.size),
        mass=kind.mass,
        color=ColorRGBA(r=r, g=g, b=b, a=a),
        mesh=kind.mesh,
        held_by=thing.held_by,
    )


def _surface(surface: Surface) -> msg.Surface:
    pose: PoseMessage = pose_to_message(surface.pose)
    return msg.Surface(
        name=surface.name,
        label=surface.label,
        pose=pose,
        vertices=[Point(x=x, y=y, z=z) for x, y, z in surface.vertices.tolist()],
        triangles=surface.triangles.ravel().tolist(),
    )


def _surface_from_message(message: msg.Surface) -> Surface:
    if len(message.triangles) % 3:
        raise BadInput(
            f"surface '{message.name}' has {len(message.triangles)} triangle indices; expected "
            "three a triangle"
        )
    if not message.name:
        raise BadInput("a surface has no name; give each its own, such as table_1")
    vertices = [(v.x, v.y, v.z) for v in message.vertices]
    return Surface(
        message.name,
        message.label,
        pose_from_message(message.pose),
        np.array(vertices, dtype=np.float64).reshape(-1, 3),
        np.array(message.triangles, dtype=np.int64).astype(np.int32).reshape(-1, 3),
    )


def main() -> None:
    host.main(["physics"])
