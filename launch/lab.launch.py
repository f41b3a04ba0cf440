"""The lab under ROS's own launcher: ros2 launch mrlab_ros lab.launch.py robots:=ur5e rviz:=true

`ros2 launch mrlab_ros lab.launch.py -s` lists the arguments. The processes, their parameters and
the parameter file are those of `mrlab up`.
"""

import os
import tempfile
from pathlib import Path

from ament_index_python.packages import PackageNotFoundError, get_package_prefix
from launch import LaunchDescription
from launch.actions import (
    DeclareLaunchArgument,
    EmitEvent,
    ExecuteProcess,
    LogInfo,
    OpaqueFunction,
    RegisterEventHandler,
)
from launch.event_handlers import OnProcessExit
from launch.events import matches_action
from launch.events.process import ShutdownProcess
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node

from mrlab_ros.adapters import share
from mrlab_ros.adapters.bullet.support import missing
from mrlab_ros.adapters.parent_exit import LAUNCHER
from mrlab_ros.adapters.sandbox import python_process
from mrlab_ros.adapters.scenes.files import SceneFiles
from mrlab_ros.commands.up.keys import free_endpoint
from mrlab_ros.commands.up.surroundings import graph_range
from mrlab_ros.commands.up.web import checked_web, prepare_keys
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.base.names import close_to
from mrlab_ros.core.bridge.links import check_endpoints
from mrlab_ros.processes import physics_support
from mrlab_ros.processes.child_process import WRONG_CONFIGURATION
from mrlab_ros.processes.lab import (
    HOST_EXECUTABLE,
    LabProcess,
    lab_processes,
    parameter_file,
    robot_models,
)
from mrlab_ros.processes.options import LabOptions, new_lab_id

# A process that ends is started again after this time, s, and at most so many times; one that
# refuses its configuration is not, see refused().
RESPAWN = {"respawn": True, "respawn_delay": 1.0, "respawn_max_retries": 10}
SHOWN = {"output": "screen", "emulate_tty": True}
CHOICES = {"true": ["true", "false"], "false": ["true", "false"]}
CHOICES["localhost"] = ["localhost", "subnet"]
# The services that these arguments call when the lab is ready, unless another lab has them too.
CALLED = {"scene": "/lab/load_scene", "record": "/recorder/start"}

# By name: default and description; those whose default is in CHOICES take nothing else.
ARGUMENTS = {
    "config": ("", "ROS parameter file; empty: the shipped config/lab.yaml"),
    "robots": ("", "robots to begin with, such as ur5e,kuka_kr3_r540"),
    "scene": ("", "scene to load when the lab is ready, such as handover; it replaces the robots"),
    "remap": ("", "names to remap in the lab's nodes, such as /clock:=/sim/clock, with commas"),
    "physics": ("false" if missing() else "true", "simulate contacts and grasps"),
    "frames": ("true", "publish /tf and markers for RViz, Foxglove and recordings"),
    "rviz": ("false", "start RViz with config/mrlab.rviz"),
    "record": ("", "bag to record into from when the lab is ready"),
    "bridge": ("true", "carry the graph over zenoh"),
    "listen": (
        "",
        "where zenoh clients connect; empty: tcp/127.0.0.1:7447, with keys tls/0.0.0.0:7447",
    ),
    "connect": ("", "with keys: a secured router that lets people in (mrlab keys router)"),
    "keys": ("", "keys folder (mrlab keys init); empty: no keys, this machine only"),
    "insecure": ("false", "listen beyond this machine without keys"),
    "web": ("true", "serve the pages for browsers and headsets"),
    "http": (
        "",
        "where the pages are served, HOST:PORT; empty: 127.0.0.1:8080, with keys 0.0.0.0:8080",
    ),
    "https_cert": ("", "certificate for HTTPS (PEM, whole chain), if not that of keys"),
    "https_key": ("", "the private key of https_cert (PEM)"),
    "public_url": ("", "address of a reverse proxy that offers the pages; people sign in"),
    "oidc": ("", "YAML file of an OpenID Connect provider by which people sign in"),
    "web_limits": ("", "YAML file of how many pages there may be and what each may send"),
    "class": ("", "folder that mrlab class made, for instructors to step through"),
    "lti": ("", "YAML file of the learning platform whose course the class is"),
    "state_dir": ("", "folder for scene and trajectories; empty: a temporary one"),
    "store": ("", "uploads and trajectories: a folder or URL; empty: in state_dir"),
    "discovery": (
        "localhost",
        "who finds the ROS graph, which asks for no key; subnet: everybody on this network",
    ),
    "use_sim_time": ("false", "the topic /clock gives the time"),
}


def generate_launch_description():
    """Declare the arguments; the processes follow from their values."""
    declared = [
        DeclareLaunchArgument(
            name,
            default_value=default,
            description=description,
            **({"choices": CHOICES[default]} if default in CHOICES else {}),
        )
        for name, (default, description) in ARGUMENTS.items()
    ]
    return LaunchDescription([*declared, OpaqueFunction(function=processes)])


def processes(context):
    """Return the processes that `mrlab up` keeps, each with its name in the launcher's output."""

    def value(name):
        return LaunchConfiguration(name).perform(context).strip()

    def given(name):
        return value(name) == "true"

    def path(name):
        return Path(value(name)).expanduser().absolute() if value(name) else None

    check_namespace(context.launch_configurations.get("ros_namespace", ""))
    shown = [rviz(graph_range(value("discovery")))] if given("rviz") else []
    keys = path("keys")
    listen = value("listen")
    if listen and given("bridge"):
        check_endpoints((listen,), given("insecure"), keys is not None)
        listen = free_endpoint(listen, "listen:=")
    web = None
    if given("bridge") and given("web"):
        web = checked_web(
            value("http"),
            keys=keys,
            insecure=given("insecure"),
            certificate=path("https_cert"),
            certificate_key=path("https_key"),
            public_url=value("public_url").rstrip("/"),
            oidc=path("oidc"),
            limits=path("web_limits"),
            classroom=path("class"),
            lti=path("lti"),
        )
        if keys is not None:
            prepare_keys(keys)
    physics, _ = physics_support.wanted(given("physics"))
    options = LabOptions(
        lab_id=new_lab_id(),
        config=parameter_file(path("config")),
        state_dir=path("state_dir") or Path(tempfile.mkdtemp(prefix="mrlab-")),
        robots=robot_models(value("robots")),
        store=value("store"),
        physics=physics,
        frames=given("frames"),
        bridge=given("bridge"),
        listen=listen,
        connect=value("connect"),
        keys=keys,
        insecure=given("insecure"),
        web=web,
        sim_time=given("use_sim_time"),
    )
    if value("scene"):
        check_scene(value("scene"), options.state_dir)
    found = lab_processes(options)
    reach = graph_range(value("discovery"))
    # The processes end with this one, which would leave them behind at a SIGTERM.
    with_it = {"additional_env": {LAUNCHER: str(os.getpid()), **reach}}
    nodes = [
        Node(
            package="mrlab_ros",
            executable=HOST_EXECUTABLE,
            exec_name=process.name,
            arguments=list(process.arguments(options)),
            remappings=remappings(value("remap")),
            **SHOWN,
            **RESPAWN,
            **with_it,
        )
        for process in found
        if isinstance(process, LabProcess)
    ]
    # No ROS nodes: the launcher would give them ROS arguments.
    programs = [
        ExecuteProcess(
            cmd=list(process.command(options)),
            name=process.name,
            **SHOWN,
            **RESPAWN,
            **with_it,
        )
        for process in found
        if not isinstance(process, LabProcess)
    ]
    names = [node for process in found for node in process.nodes]
    later = afterwards(value, reach)
    ready = ExecuteProcess(
        cmd=[
            *python_process.command("mrlab_ros.processes.readiness"),
            *(options.lab_id, str(len(options.robots)), ",".join(names)),
            *(CALLED[name] for name in later),
        ],
        name="ready",
        **SHOWN,
        additional_env=reach,
    )
    return [
        *unknown(context.launch_configurations),
        *nodes,
        *programs,
        RegisterEventHandler(OnProcessExit(on_exit=refused)),
        RegisterEventHandler(
            OnProcessExit(
                target_action=ready,
                on_exit=lambda event, _: [] if event.returncode else list(later.values()),
            )
        ),
        ready,
        *shown,
    ]


def check_namespace(namespace):
    """Raise BadInput for a lab in a namespace: its parts would not find each other."""
    if namespace.strip("/"):
        raise BadInput(
            f"the lab is launched in the namespace '{namespace}'; expected none, as /robots, "
            "/systems and the names of its robots are the same for all its parts. Include "
            "lab.launch.py outside push_ros_namespace; a second lab has a ROS_DOMAIN_ID of its own"
        )


def check_scene(name, state_dir):
    """Raise BadInput where the lab has no such scene: it would begin without one."""
    SceneFiles(share.directory() / "config" / "scenes", state_dir / "scenes").load(name)


def unknown(given):
    """Return a warning for each name that resembles an argument, such as robot:=ur5e."""
    words = [
        f"{name}:= is no argument of the lab (-s lists them); did you mean '{close}'?"
        for name in given
        if name not in ARGUMENTS and (close := close_to(name, ARGUMENTS))
    ]
    return [LogInfo(msg=text) for text in words]


def refused(event, _context):
    """Return what keeps a process that refuses its configuration from being started again."""
    if event.returncode != WRONG_CONFIGURATION:
        return []
    return [EmitEvent(event=ShutdownProcess(process_matcher=matches_action(event.action)))]


def afterwards(value, reach):
    """Return what is started when the lab is ready, by the argument that asks for it."""
    commands = {"scene": ("scene", "load"), "record": ("record",)}
    return {
        name: ExecuteProcess(
            cmd=[*python_process.command("mrlab_ros.cli", *words, value(name))],
            name=name,
            **SHOWN,
            additional_env=reach,
        )
        for name, words in commands.items()
        if value(name)
    }


def rviz(reach):
    """Return RViz with all displays of the lab; raise BadInput where it is not installed."""
    try:
        get_package_prefix("rviz2")
    except PackageNotFoundError:
        raise BadInput(
            "RViz is not installed; install it (sudo apt install ros-jazzy-rviz2), or leave "
            "rviz:=true out"
        ) from None
    config = share.directory() / "config" / "mrlab.rviz"
    return Node(
        package="rviz2",
        executable="rviz2",
        arguments=["-d", str(config)],
        additional_env=reach,
        **SHOWN,
    )


def remappings(text):
    """Return the pairs in a list such as /a:=/b,/c:=/d; raise BadInput for anything else."""
    pairs = [tuple(part.strip().split(":=")) for part in text.split(",") if part.strip()]
    for pair in pairs:
        if len(pair) != 2 or not all(pair):
            raise BadInput(f"remap is '{text}'; expected FROM:=TO, several with commas between")
    return pairs
