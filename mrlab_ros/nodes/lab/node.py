"""The lab node: the set of robots in the scene."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

from mrlab_msgs import msg, srv
from rclpy.context import Context
from rclpy.parameter import Parameter
from rclpy.publisher import Publisher
from std_msgs.msg import String

from mrlab_ros.adapters.robots.library import RobotLibrary
from mrlab_ros.adapters.scenes.files import SceneFiles
from mrlab_ros.core.errors import BadInput, LabError
from mrlab_ros.core.geometry import Pose
from mrlab_ros.core.scene.robots import PlacedRobot, Scene
from mrlab_ros.messages import qos
from mrlab_ros.messages.poses import pose_from_message, pose_to_message, transforms_to_message
from mrlab_ros.messages.time import make_header
from mrlab_ros.nodes import parameters
from mrlab_ros.nodes.parameters import LabParameters
from mrlab_ros.ros import share
from mrlab_ros.ros.answers import answered
from mrlab_ros.ros.parameters import ParameterNode

try:  # not among the ROS wheels; where it is missing, a client places robots by /robots
    from tf2_msgs.msg import TFMessage
except ImportError:
    TFMessage = None


class LabNode(ParameterNode[LabParameters]):
    """Spawns, places and removes robots, and announces who is where."""

    def __init__(
        self,
        *,
        context: Context | None = None,
        parameter_overrides: list[Parameter] | None = None,
    ) -> None:
        super().__init__(
            "lab",
            LabParameters,
            parameters.ALL,
            context=context,
            parameter_overrides=parameter_overrides,
        )
        state_dir = self.parameters.state_dir
        self._file = Path(state_dir) / "scene.json" if state_dir else None
        folder = Path(state_dir) if state_dir else Path.home() / ".local" / "share" / "mrlab"
        self._scenes = SceneFiles(share.directory() / "config" / "scenes", folder / "scenes")
        self._library = RobotLibrary(share.directory() / "robots")
        self._scene = Scene()
        self._descriptions: dict[str, Publisher] = {}
        self._robots = self.create_publisher(msg.Robots, "/robots", qos.LATCHED)
        self._transforms = (
            self.create_publisher(TFMessage, "/tf_static", qos.LATCHED) if TFMessage else None
        )
        if self._file is not None and self._file.exists():
            self._restore(self._file)
        else:
            for model in self.parameters.robots:
                self._spawn(model, None, "", None)
        self._announce()
        self.create_service(srv.SpawnRobot, "~/spawn_robot", self._on_spawn)
        self.create_service(srv.PlaceRobot, "~/place_robot", self._on_place)
        self.create_service(srv.SetEndEffector, "~/set_end_effector", self._on_end_effector)
        self.create_service(srv.Remove, "~/remove_robot", self._on_remove)
        self.create_service(srv.ListScenes, "~/list_scenes", self._on_list_scenes)

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

    def _describe(self, name: str, description: str) -> None:
        if name not in self._descriptions:
            self._descriptions[name] = self.create_publisher(
                String, f"/{name}/robot_description", qos.LATCHED
            )
        self._descriptions[name].publish(String(data=description))

    def _message(self, robot: PlacedRobot) -> msg.Robot:
        return msg.Robot(
            name=robot.name,
            model=robot.model,
            end_effector=robot.end_effector or "",
            pose=pose_to_message(robot.pose),
            joint_names=list(robot.joint_names),
        )

    def _announce(self) -> None:
        now_ns = self.get_clock().now().nanoseconds
        robots = [self._message(robot) for robot in self._scene.robots]
        self._robots.publish(msg.Robots(header=make_header(now_ns, "world"), robots=robots))
        if self._transforms is not None:
            self._transforms.publish(transforms_to_message(now_ns, TFMessage, robots))
        if self._file is not None:
            self._save(self._file)

    def _save(self, file: Path) -> None:
        """Write the scene so that a restarted lab has it back; a reader sees all or nothing."""
        scene = [
            {
                "name": r.name,
                "model": r.model,
                "end_effector": r.end_effector,
                "position": r.pose.position,
                "orientation": r.pose.orientation,
            }
            for r in self._scene.robots
        ]
        file.parent.mkdir(parents=True, exist_ok=True)
        new = file.with_suffix(".new")
        new.write_text(json.dumps(scene, indent=1))
        new.replace(file)

    def _restore(self, file: Path) -> None:
        for r in json.loads(file.read_text()):
            try:
                pose = Pose(tuple(r["position"]), tuple(r["orientation"]))
                self._spawn(r["model"], r["end_effector"], r["name"], pose)
            except LabError as error:
                self.get_logger().error(f"{r['name']} of the last scene is left out: {error}")
        self.get_logger().info(f"the scene is back: {len(self._scene.robots)} robots")

    @answered
    def _on_spawn(self, request: Any, response: Any) -> str:
        if request.automatic and request.surface not in ("", "floor"):
            raise BadInput(
                f"the surface '{request.surface}' is unknown to the lab; leave it empty for the "
                "floor, or give a pose"
            )
        pose = None if request.automatic else pose_from_message(request.pose)
        robot = self._spawn(request.model, request.end_effector or None, request.name, pose)
        self._announce()
        response.robot = self._message(robot)
        x, y, _ = robot.pose.position
        return f"{robot.name} stands at x {x:g} m, y {y:g} m"

    @answered
    def _on_place(self, request: Any, response: Any) -> str:
        self._scene.place(request.robot, pose_from_message(request.pose))
        self._announce()
        return f"{request.robot} is placed"

    @answered
    def _on_end_effector(self, request: Any, response: Any) -> str:
        robot = self._scene.robot(request.robot)
        end_effector = request.end_effector or None
        description = self._library.description(robot.model, end_effector)
        self._scene.set_end_effector(robot.name, end_effector)
        self._describe(robot.name, description)
        self._announce()
        return f"{robot.name} carries {end_effector or 'nothing'}"

    @answered
    def _on_remove(self, request: Any, response: Any) -> str:
        self._scene.remove(request.name)
        self.destroy_publisher(self._descriptions.pop(request.name))
        self._announce()
        return f"{request.name} is removed"

    def _on_list_scenes(self, request: Any, response: Any) -> Any:
        response.scenes = self._scenes.names()
        return response
