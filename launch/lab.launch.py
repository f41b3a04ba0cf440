"""The lab under ROS's own launcher: ros2 launch mrlab_ros lab.launch.py [robots:=ur5e]."""

import os
import tempfile

from ament_index_python.packages import get_package_share_directory
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, OpaqueFunction
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node

from mrlab_ros.processes import physics_support


def generate_launch_description():
    """Declare the arguments; the processes follow from their values."""
    config = os.path.join(get_package_share_directory("mrlab_ros"), "config", "lab.yaml")
    flags = ["true", "false"]
    return LaunchDescription(
        [
            DeclareLaunchArgument(
                "config", default_value=config, description="ROS parameter file"
            ),
            DeclareLaunchArgument(
                "robots",
                default_value="",
                description="robots to begin with, such as ur5e,kuka_kr3_r540",
            ),
            DeclareLaunchArgument(
                "bridge",
                default_value="true",
                choices=flags,
                description="carry the graph over zenoh",
            ),
            DeclareLaunchArgument(
                "keys",
                default_value="",
                description="keys folder (mrlab keys init); empty: no keys, this machine only",
            ),
            DeclareLaunchArgument(
                "listen",
                default_value="",
                description="where zenoh clients connect; empty: tcp/127.0.0.1:7447, with keys "
                "tls/0.0.0.0:7447",
            ),
            DeclareLaunchArgument(
                "connect",
                default_value="",
                description="with keys: a secured router that lets people in (mrlab keys router)",
            ),
            DeclareLaunchArgument(
                "insecure",
                default_value="false",
                choices=flags,
                description="listen beyond this machine without keys",
            ),
            DeclareLaunchArgument(
                "physics",
                default_value="false" if physics_support.missing() else "true",
                choices=flags,
                description="simulate contacts and grasps",
            ),
            DeclareLaunchArgument(
                "web", default_value="false", choices=flags, description="start the web gateway"
            ),
            DeclareLaunchArgument(
                "state_dir",
                default_value="",
                description="folder for scene and trajectories; empty: a temporary one",
            ),
            OpaqueFunction(function=processes),
        ]
    )


def processes(context):
    """Return the same processes that `mrlab up` keeps, each started again when it ends."""

    def value(name):
        return LaunchConfiguration(name).perform(context)

    if value("web") == "true":
        raise RuntimeError("this version of the lab has no web gateway; leave web:=false")
    state = {"state_dir": value("state_dir") or tempfile.mkdtemp(prefix="mrlab-")}
    robots = [model.strip() for model in value("robots").split(",") if model.strip()]

    def host(nodes, **parameters):
        return Node(
            package="mrlab_ros",
            executable="host",
            arguments=nodes.split(),
            parameters=[value("config"), {**state, **parameters}],
            output="screen",
            emulate_tty=True,
            respawn=True,
            respawn_delay=1.0,
        )

    started = [
        host("converter lab coordinator", **({"robots": robots} if robots else {})),
        host("playback"),
        host("recorder"),
    ]
    if value("physics") == "true":
        why_not = physics_support.missing()
        if why_not:
            raise RuntimeError(f"{why_not}; or leave physics:=false")
        started.append(host("physics"))
    if value("bridge") == "true":
        chosen = {"insecure": value("insecure") == "true"}
        if value("keys"):
            chosen["keys"] = os.path.abspath(os.path.expanduser(value("keys")))
        if value("listen"):
            chosen["listen"] = [value("listen")]
        if value("connect"):
            chosen |= {"connect": [value("connect")], "mode": "client"}
        started.append(host("bridge", **chosen))
    return started
