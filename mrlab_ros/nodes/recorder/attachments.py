"""Collects the attachments that make a bag self-contained: URDFs, meshes, trajectories, ..."""

from __future__ import annotations

import array
import json
import platform
import re
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import yaml
from ament_index_python.packages import get_package_share_directory
from mrlab_msgs import msg
from rcl_interfaces.srv import GetParameters, ListParameters
from rclpy.parameter import parameter_value_to_python
from rclpy.serialization import deserialize_message
from std_msgs.msg import String

from mrlab_ros.adapters import share
from mrlab_ros.adapters.robots.library import MESH_PREFIX, RobotLibrary
from mrlab_ros.adapters.trajectories.formats import chunks
from mrlab_ros.core.base.diagnostic import Diagnostic
from mrlab_ros.core.base.errors import LabError
from mrlab_ros.core.bridge.assets import media_type
from mrlab_ros.core.robots.frames import without_frames
from mrlab_ros.core.trajectory.trajectory import Trajectory
from mrlab_ros.messages import qos, trajectories
from mrlab_ros.nodes.converter.catalogue import CatalogueClient
from mrlab_ros.nodes.recorder.diagnostics import NOT_ATTACHED, PARAMETERS_NOT_ATTACHED
from mrlab_ros.ros.calls import call
from mrlab_ros.ros.raw_streams import Received
from mrlab_ros.ros.spinning import Caller
from mrlab_ros.ros.worker import Worker

Attach = Callable[[str, str, bytes], None]
PACKAGE = re.compile(r"package://([^/]+)/(.+)")
# The same in CDR, where a text ends with a zero byte.
URI_IN_CDR = re.compile(rb"package://[^\0]+")
SCENE = "scene.json"
PARAMETERS_TIMEOUT_S = 2.0


class SessionContent:
    """Attaches URDFs, meshes, trajectories, scene and parameters to the bag.

    The recorded messages say what belongs to the session; a thread of its own fetches it, so
    that the recording does not wait.
    """

    def __init__(
        self, caller: Caller, attach: Attach, warn_once: Callable[[Diagnostic], None]
    ) -> None:
        self._caller = caller
        self._attach = attach
        self._complain = warn_once
        self._library = RobotLibrary(share.directory() / "robots")
        self._there: set[str] = set()
        # Versions that the converter was asked for, and by attachment the version that it holds.
        self._asked: set[str] = set()
        self._versions: dict[str, str] = {}
        # The last published scene, unless it is in the bag already.
        self._scene: bytes | None = None
        # Meshes of objects in the messages so far.
        self._uris: set[bytes] = set()
        self._worker = Worker("recorder_content")
        self._trajectories = CatalogueClient(caller.node)
        self._closed = False
        self._readers: dict[str, tuple[Any, Callable[[str, Any], None]]] = {
            "robot_description": (String, self._describe),
            "playback_state": (msg.PlaybackState, self._take_state),
            "robots": (msg.Robots, self._take_scene),
            "converted": (msg.Trajectory, self._take_trajectory),
            "objects": (msg.SceneObjects, self._take_objects),
        }
        self._later("the parameters", self._take_parameters)

    def observe(self, message: Received, kind: str) -> None:
        """Take note of a message that was recorded."""
        name = message.topic.rsplit("/", 1)[-1]
        reader = self._readers.get(name)
        if reader is not None and not self._closed:
            if name == "objects" and not self._has_new_mesh(message):
                return
            self._later(message.topic, lambda: self._read(message, kind, *reader))

    def _has_new_mesh(self, message: Received) -> bool:
        """Return whether objects name an unknown mesh; they are published sixty times a second."""
        new = {*URI_IN_CDR.findall(message.data)} - self._uris
        self._uris |= new
        return bool(new)

    def close(self) -> None:
        """Fetch what is queued, then end."""
        if self._closed:
            return
        self._closed = True
        self._worker.do(lambda: self._guarded(SCENE, self._attach_scene))
        self._worker.close()
        self._trajectories.close()

    def _read(
        self, message: Received, kind: str, wanted: Any, take: Callable[[str, Any], None]
    ) -> None:
        if kind != f"{wanted.__module__.split('.')[0]}/msg/{wanted.__name__}":
            return
        take(message.topic, deserialize_message(message.data, wanted))

    def _later(self, what: str, work: Callable[[], None]) -> None:
        self._worker.later(lambda: self._guarded(what, work))

    def _guarded(self, what: str, work: Callable[[], None]) -> None:
        """Do `work`; a failure leaves an attachment out and does not end the recording."""
        try:
            work()
        except Exception as error:
            why = error if isinstance(error, LabError | OSError) else repr(error)
            self._complain(NOT_ATTACHED(topic=what, why=why))

    def _describe(self, topic: str, message: Any) -> None:
        robot = topic.split("/")[-2]
        if not robot:
            return  # the description of all robots, each of which comes by itself
        urdf = without_frames(str(message.data), robot)
        self._attach(f"robots/{robot}.urdf", "model/urdf+xml", urdf.encode())
        for mesh in ElementTree.fromstring(urdf).iter("mesh"):
            self._attach_uri(topic, mesh.get("filename", ""))

    def _take_objects(self, topic: str, message: Any) -> None:
        for uri in {thing.mesh for thing in message.objects}:
            self._attach_uri(topic, uri)

    def _attach_uri(self, topic: str, uri: str) -> None:
        match = PACKAGE.fullmatch(uri)
        if match is not None:
            self._guarded(topic, partial(self._attach_mesh, *match.groups()))

    def _attach_mesh(self, package: str, path: str) -> None:
        name = f"meshes/{package}/{path}"
        if name in self._there:
            return
        self._there.add(name)
        uri = f"package://{package}/{path}"
        if uri.startswith(MESH_PREFIX):
            file = self._library.mesh_path(uri)
        else:
            file = Path(get_package_share_directory(package)) / path
        kind = media_type(path) or "application/octet-stream"
        self._attach(name, kind, file.read_bytes())

    def _take_state(self, topic: str, state: Any) -> None:
        # Without a version it is in no catalogue: a goal of somebody else's, or a stream.
        if state.trajectory_version:
            self._fetch_trajectory(f"{state.trajectory_id}@{state.trajectory_version}")

    def _take_trajectory(self, topic: str, message: Any) -> None:
        if message.positions:
            self._attach_trajectory(trajectories.trajectory_from_message(message))
        else:  # a long one is announced without its frames
            self._fetch_trajectory(f"{message.info.id}@{message.info.version}")

    def _fetch_trajectory(self, version: str) -> None:
        """Attach a version of the catalogue; ask once: the converter may be gone."""
        if version in self._asked:
            return
        self._asked.add(version)
        if version not in self._versions.values():
            self._attach_trajectory(self._trajectories.fetch(version))

    def _attach_trajectory(self, trajectory: Trajectory) -> None:
        # The first version has the id alone for a name.
        version = f"{trajectory.id}@{trajectory.version}"
        name = trajectory_name(trajectory.id)
        if self._versions.get(name, version) != version:
            name = trajectory_name(version)
        self._versions[name] = version
        self._attach(name, "application/json", b"".join(map(bytes, chunks(trajectory))))

    def _take_scene(self, topic: str, message: Any) -> None:
        scene = [
            {
                "name": robot.name,
                "model": robot.model,
                "end_effector": robot.end_effector,
                "position": _numbers(robot.pose.position, "xyz"),
                "orientation": _numbers(robot.pose.orientation, "xyzw"),
            }
            for robot in message.robots
        ]
        self._scene = json.dumps(scene, indent=1).encode()
        # A robot that is dragged changes the scene many times a second: the first scene is
        # attached at once, the last one at the end.
        if SCENE not in self._there:
            self._attach_scene()

    def _attach_scene(self) -> None:
        if self._scene is not None:
            self._there.add(SCENE)
            self._attach(SCENE, "application/json", self._scene)
            self._scene = None

    def _take_parameters(self) -> None:
        """Attach the parameters of every node with parameter services, as a ROS parameter file."""
        node = self._caller.node
        services = {name for name, _ in node.get_service_names_and_types()}
        found: dict[str, Any] = {}
        for name in sorted(s.removesuffix("/list_parameters") for s in services):
            if f"{name}/list_parameters" in services and f"{name}/get_parameters" in services:
                try:
                    found[name] = {"ros__parameters": self._parameters_of(name)}
                except LabError as error:
                    self._complain(PARAMETERS_NOT_ATTACHED(node=name, why=error))
        self._attach("parameters.yaml", "application/yaml", yaml.safe_dump(found).encode())

    def _parameters_of(self, name: str) -> dict[str, Any]:
        node = self._caller.node
        lists = node.create_client(
            ListParameters, f"{name}/list_parameters", qos_profile=qos.SERVICES
        )
        gets = node.create_client(
            GetParameters, f"{name}/get_parameters", qos_profile=qos.SERVICES
        )
        try:
            names = call(lists, ListParameters.Request(), PARAMETERS_TIMEOUT_S).result.names
            request = GetParameters.Request(names=names)
            values = call(gets, request, PARAMETERS_TIMEOUT_S).values
        finally:
            node.destroy_client(lists)
            node.destroy_client(gets)
        plain = map(parameter_value_to_python, values)
        return {
            name: list(value) if isinstance(value, array.array) else value
            for name, value in zip(names, plain, strict=True)
        }


def trajectory_name(trajectory_id: str) -> str:
    """Return the name of a trajectory's attachment."""
    return f"trajectories/{trajectory_id}.json"


def versions() -> dict[str, str]:
    """Return what made the bag."""
    manifest = ElementTree.parse(share.directory() / "package.xml")
    return {
        "mrlab_ros": manifest.findtext("version", "unknown"),
        "python": platform.python_version(),
        "machine": f"{platform.system()} {platform.release()} {platform.machine()}",
    }


def _numbers(value: Any, names: str) -> list[float]:
    return [getattr(value, name) for name in names]
