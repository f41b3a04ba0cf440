"""The lab under ROS's own launcher: ros2 launch mrlab_ros lab.launch.py robots:=ur5e rviz:=true

`ros2 launch mrlab_ros lab.launch.py -s` lists the arguments. The processes, their parameters and
the parameter file are those of `mrlab up`.
"""

import os
import sys
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

from mrlab_ros.adapters import private_folder, share
from mrlab_ros.adapters.parent_exit import LAUNCHER
from mrlab_ros.adapters.sandbox import python_process
from mrlab_ros.adapters.scenes.files import SceneFiles
from mrlab_ros.commands.up.command import checked_store
from mrlab_ros.commands.up.keys import checked_router, free_endpoint
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
    parts_of_lab,
    robot_models,
)
from mrlab_ros.processes.launch_arguments import LAB
from mrlab_ros.processes.options import LabOptions, new_lab_id

# A process that ends is started again after this time, s, and at most so many times; one that
# refuses its configuration is not, see refused().
RESPAWN = {"respawn": True, "respawn_delay": 1.0, "respawn_max_retries": 10}
# A process that takes its output for a terminal colours it, for a file and a pipe as well.
SHOWN = {"output": "screen", "emulate_tty": sys.stdout.isatty()}
# The services that these arguments call when the lab is ready, unless another lab has them too.
CALLED = {"scene": "/lab/load_scene", "record": "/recorder/start"}


def generate_launch_description():
    """Declare the arguments; the processes follow from their values."""
    declared = [DeclareLaunchArgument(each.name, **each.settings) for each in LAB]
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
    parts = parts_of_lab(value("only"))
    bridge = given("bridge") and (not parts or "bridge" in parts)
    listen = value("listen")
    if value("connect") and bridge:
        checked_router(value("connect"), listen, keys, given("insecure"))
    elif listen and bridge:
        check_endpoints((listen,), given("insecure"), keys is not None)
        listen = free_endpoint(listen, "listen:=")
    web = None
    if bridge and given("web"):
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
    if path("state_dir"):
        folder = private_folder.make(path("state_dir"))
        private_folder.hold(folder)  # until this process ends
    else:
        folder = Path(tempfile.mkdtemp(prefix="mrlab-"))
    options = LabOptions(
        lab_id="" if parts else new_lab_id(),
        config=parameter_file(path("config")),
        state_dir=folder,
        robots=robot_models(value("robots")),
        store=checked_store(value("store")),
        physics=physics,
        frames=given("frames"),
        bridge=bridge,
        listen=listen,
        connect=value("connect"),
        keys=keys,
        insecure=given("insecure"),
        web=web,
        sim_time=given("use_sim_time"),
        only=parts,
    )
    if value("scene"):
        check_scene(value("scene"), options.state_dir)
    found = lab_processes(options)
    reach = graph_range(value("discovery"))
    # The processes end with this one, which would leave them behind at a SIGTERM.
    unbuffered = {"PYTHONUNBUFFERED": "1"}
    with_it = {"additional_env": {LAUNCHER: str(os.getpid()), **unbuffered, **reach}}
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
    ready_once = []

    def begin(event, _context):
        ready_once.append(event)
        return [] if event.returncode else list(later.values())

    return [
        *unknown(context.launch_configurations),
        *nodes,
        *programs,
        RegisterEventHandler(OnProcessExit(on_exit=lambda event, _: refused(event, ready_once))),
        RegisterEventHandler(OnProcessExit(target_action=ready, on_exit=begin)),
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
    names = [each.name for each in LAB]
    words = [
        f"{name}:= is no argument of the lab (-s lists them); did you mean '{close}'?"
        for name in given
        if name not in names and (close := close_to(name, names))
    ]
    return [LogInfo(msg=text) for text in words]


def refused(event, ready_once):
    """Return what keeps a process that refuses its configuration from being started again.

    While the lab starts, until `ready_once` holds something, it ends the launch by BadInput.
    """
    if event.returncode != WRONG_CONFIGURATION:
        return []
    if not ready_once:
        raise BadInput(f"{event.process_name} refuses its configuration; its last line says why")
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
