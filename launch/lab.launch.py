"""The lab under ROS's own launcher: ros2 launch mrlab_ros lab.launch.py [robots:=ur5e]."""

import tempfile
from pathlib import Path

from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, ExecuteProcess, OpaqueFunction
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node

from mrlab_ros.adapters.bullet.support import missing
from mrlab_ros.commands.up.web import checked_web, prepare_keys
from mrlab_ros.processes import physics_support
from mrlab_ros.processes.lab import (
    HOST_EXECUTABLE,
    LabProcess,
    lab_processes,
    parameter_file,
    robot_models,
)
from mrlab_ros.processes.options import LabOptions, new_lab_id

# A process that ends is started again after this time, s, and at most so many times: the launcher
# cannot know that a process refuses its configuration and would start it for ever.
RESPAWN_DELAY_S = 1.0
RESPAWN_MAX_RETRIES = 10


def generate_launch_description():
    """Declare the arguments; the processes follow from their values."""
    flags = ["true", "false"]
    return LaunchDescription(
        [
            DeclareLaunchArgument(
                "config",
                default_value="",
                description="ROS parameter file; empty: the shipped config/lab.yaml",
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
                default_value="false" if missing() else "true",
                choices=flags,
                description="simulate contacts and grasps",
            ),
            DeclareLaunchArgument(
                "frames",
                default_value="true",
                choices=flags,
                description="publish /tf and markers for RViz, Foxglove and recordings",
            ),
            DeclareLaunchArgument(
                "state_dir",
                default_value="",
                description="folder for scene and trajectories; empty: a temporary one",
            ),
            DeclareLaunchArgument(
                "store",
                default_value="",
                description="uploads and trajectories: a folder or URL; empty: in state_dir",
            ),
            DeclareLaunchArgument(
                "use_sim_time",
                default_value="false",
                choices=flags,
                description="the topic /clock gives the time",
            ),
            DeclareLaunchArgument(
                "web",
                default_value="true",
                choices=flags,
                description="serve the pages for browsers and headsets",
            ),
            DeclareLaunchArgument(
                "http",
                default_value="",
                description="where the pages are served, HOST:PORT; empty: 127.0.0.1:8080, with "
                "keys 0.0.0.0:8080",
            ),
            DeclareLaunchArgument(
                "https_cert",
                default_value="",
                description="certificate for HTTPS (PEM, whole chain), if not that of keys",
            ),
            DeclareLaunchArgument(
                "https_key",
                default_value="",
                description="the private key of https_cert (PEM)",
            ),
            DeclareLaunchArgument(
                "public_url",
                default_value="",
                description="address of a reverse proxy that offers the pages; people sign in",
            ),
            DeclareLaunchArgument(
                "oidc",
                default_value="",
                description="YAML file of an OpenID Connect provider by which people sign in",
            ),
            DeclareLaunchArgument(
                "web_limits",
                default_value="",
                description="YAML file of how many pages there may be and what each may send",
            ),
            OpaqueFunction(function=processes),
        ]
    )


def processes(context):
    """Return the processes that `mrlab up` keeps, each with its name in the launcher's output."""

    def value(name):
        return LaunchConfiguration(name).perform(context).strip()

    def path(name):
        return Path(value(name)).expanduser().absolute() if value(name) else None

    keys, insecure = path("keys"), value("insecure") == "true"
    bridge = value("bridge") == "true"
    web = None
    if bridge and value("web") == "true":
        web = checked_web(
            value("http"),
            keys=keys,
            insecure=insecure,
            certificate=path("https_cert"),
            certificate_key=path("https_key"),
            public_url=value("public_url").rstrip("/"),
            oidc=path("oidc"),
            limits=path("web_limits"),
        )
        if keys is not None:
            prepare_keys(keys)
    physics, _ = physics_support.wanted(value("physics") == "true")
    options = LabOptions(
        lab_id=new_lab_id(),
        config=parameter_file(path("config")),
        state_dir=path("state_dir") or Path(tempfile.mkdtemp(prefix="mrlab-")),
        robots=robot_models(value("robots")),
        store=value("store"),
        physics=physics,
        frames=value("frames") == "true",
        bridge=bridge,
        listen=value("listen"),
        connect=value("connect"),
        keys=keys,
        insecure=insecure,
        web=web,
        sim_time=value("use_sim_time") == "true",
    )
    found = lab_processes(options)
    nodes = [
        Node(
            package="mrlab_ros",
            executable=HOST_EXECUTABLE,
            exec_name=process.name,
            arguments=list(process.arguments(options)),
            output="screen",
            emulate_tty=True,
            respawn=True,
            respawn_delay=RESPAWN_DELAY_S,
            respawn_max_retries=RESPAWN_MAX_RETRIES,
        )
        for process in found
        if isinstance(process, LabProcess)
    ]
    # No ROS node: the launcher would give it ROS arguments.
    programs = [
        ExecuteProcess(
            cmd=list(process.command(options)),
            name=process.name,
            output="screen",
            emulate_tty=True,
            respawn=True,
            respawn_delay=RESPAWN_DELAY_S,
            respawn_max_retries=RESPAWN_MAX_RETRIES,
        )
        for process in found
        if not isinstance(process, LabProcess)
    ]
    return [*nodes, *programs]
