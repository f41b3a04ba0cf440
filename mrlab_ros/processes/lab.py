"""The one list of the lab's nodes and processes.

`mrlab up`, `mrlab demo` and `launch/lab.launch.py` start these processes, the host makes the
nodes, and the readiness check and `mrlab status` expect them in the graph.
"""

from __future__ import annotations

import json
import os
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from mrlab_ros.adapters.sandbox import python_process
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.processes.child_process import ProcessSpec
from mrlab_ros.processes.diagnostics import NO_PARAMETER_FILE, NO_SUCH_PROCESS
from mrlab_ros.processes.options import LabOptions
from mrlab_ros.processes.web import GatewayProcess

# The module that runs the nodes of a process, and its name as a ROS executable.
HOST_MODULE = "mrlab_ros.processes.host"
HOST_EXECUTABLE = "host"
# One short line a message: the supervisor puts the process's name before it.
LOG_FORMAT = "[{severity}] [{name}]: {message}"


@dataclass(frozen=True)
class NodeEntry:
    """A node that a process can run.

    module, kind: where its class is. graph_name: its name in the graph. state: the latched topic
    whose first message says that the node is complete, and the topic's type in mrlab_msgs; where
    there is none, the node's presence in the graph says so. in_replay: it stays in the graph
    while a bag is replayed.
    """

    module: str
    kind: str
    graph_name: str
    state: tuple[str, str] | None = None
    in_replay: bool = False
    numpy: bool = True


NODES = {
    "bridge": NodeEntry(
        "mrlab_ros.nodes.bridge.node", "BridgeNode", "bridge", in_replay=True, numpy=False
    ),
    "converter": NodeEntry(
        "mrlab_ros.nodes.converter.node",
        "ConverterNode",
        "converter",
        ("/trajectories", "TrajectoryCatalogue"),
    ),
    "coordinator": NodeEntry(
        "mrlab_ros.nodes.coordinator.node",
        "CoordinatorNode",
        "coordinator",
        ("/systems", "RobotSystems"),
    ),
    "frames": NodeEntry("mrlab_ros.nodes.frames.node", "FramesNode", "frames"),
    "lab": NodeEntry("mrlab_ros.nodes.lab.node", "LabNode", "lab", ("/robots", "Robots")),
    "physics": NodeEntry("mrlab_ros.nodes.physics.node", "PhysicsNode", "physics"),
    "playback": NodeEntry("mrlab_ros.nodes.playback.host", "PlaybackHostNode", "playback_host"),
    "recorder": NodeEntry(
        "mrlab_ros.nodes.recorder.node", "RecorderNode", "recorder", in_replay=True
    ),
}


Parameters = dict[str, object]


def _lab_parameters(options: LabOptions) -> Parameters:
    found: Parameters = {"lab:robots": options.robots} if options.robots else {}
    if options.store:
        found["converter:store"] = options.store
    return found


def _playback_parameters(options: LabOptions) -> Parameters:
    if not options.socket or options.connect or not options.bridge:
        return {}
    from mrlab_ros.processes.parameter_file import parameter

    prefix = parameter(options.config, "bridge", "prefix")
    return {"playback_host:socket": options.socket, "playback_host:prefix": prefix or ""}


def _bridge_parameters(options: LabOptions) -> Parameters:
    found: Parameters = {}
    if options.connect:
        found |= {"bridge:connect": [options.connect], "bridge:mode": "client"}
    elif options.listen:
        found["bridge:listen"] = [options.listen]
    if options.socket and not options.connect:
        found["bridge:socket"] = options.socket
    if options.insecure:
        found["bridge:insecure"] = True
    if options.keys is not None:
        found["bridge:keys"] = str(options.keys.expanduser().resolve())
    return found


@dataclass(frozen=True)
class LabProcess:
    """A process of the lab: its name, its nodes, their parameters, and when it is started.

    A parameter that the options decide is named `node:name`: so it wins over the parameter file,
    whose own `node:` section would win over one for all nodes.
    """

    name: str
    nodes: tuple[str, ...]
    parameters: Callable[[LabOptions], Parameters] = lambda _: {}
    wanted: Callable[[LabOptions], bool] = lambda _: True

    @property
    def beside(self) -> str:
        """The process on whose machine it runs."""
        return self.name

    def arguments(self, options: LabOptions) -> tuple[str, ...]:
        """Return the host's command line: the nodes, then their ROS arguments."""
        parameters = {
            "state_dir": str(options.state_dir),
            **({"lab_id": options.lab_id} if options.lab_id else {}),
            **self.parameters(options),
        }
        if options.sim_time:
            # By node: the nodes that these make for themselves need no clock of their own.
            parameters |= {f"{NODES[n].graph_name}:use_sim_time": True for n in self.nodes}
        # A value is YAML, and JSON is YAML in which a text stays a text.
        given = [a for n, v in parameters.items() for a in ("-p", f"{n}:={json.dumps(v)}")]
        return (*self.nodes, "--ros-args", "--params-file", str(options.config), *given)

    def command(self, options: LabOptions) -> tuple[str, ...]:
        """Return the program and its arguments."""
        return python_process.command(HOST_MODULE, *self.arguments(options))

    def spec(self, options: LabOptions) -> ProcessSpec:
        """Return the process as the supervisor starts it."""
        env = {
            "PYTHONUNBUFFERED": "1",
            "RCUTILS_CONSOLE_OUTPUT_FORMAT": os.environ.get(
                "RCUTILS_CONSOLE_OUTPUT_FORMAT", LOG_FORMAT
            ),
        }
        nodes = tuple(NODES[name].graph_name for name in self.nodes)
        imports = tuple(NODES[name].module for name in self.nodes)
        return ProcessSpec(
            self.name, self.command(options), env, True, nodes, HOST_MODULE, imports
        )


PROCESSES: tuple[LabProcess | GatewayProcess, ...] = (
    LabProcess("lab", ("converter", "lab", "coordinator"), _lab_parameters),
    LabProcess("playback", ("playback",), _playback_parameters),
    LabProcess("recorder", ("recorder",)),
    LabProcess("physics", ("physics",), wanted=lambda options: options.physics),
    LabProcess("frames", ("frames",), wanted=lambda options: options.frames),
    LabProcess("bridge", ("bridge",), _bridge_parameters, wanted=lambda options: options.bridge),
    GatewayProcess(),
)


def lab_processes(options: LabOptions) -> tuple[LabProcess | GatewayProcess, ...]:
    """Return the processes of a lab with these options."""
    found = (process for process in PROCESSES if process.wanted(options))
    return tuple(each for each in found if not options.only or each.beside in options.only)


def parts_of_lab(text: str) -> frozenset[str]:
    """Return the names of processes in a list such as 'playback,physics'; empty: all of the lab.

    Raises BadInput for an unknown one. The pages belong to the bridge.
    """
    parts = [part for part in (each.strip() for each in text.split(",")) if part]
    known = list(dict.fromkeys(process.beside for process in PROCESSES))
    for part in parts:
        if part not in known:
            raise BadInput(NO_SUCH_PROCESS(name=part, known=known))
    return frozenset(parts)


def lab_nodes(options: LabOptions) -> tuple[NodeEntry, ...]:
    """Return the nodes of a lab with these options."""
    return tuple(NODES[name] for process in lab_processes(options) for name in process.nodes)


def parameter_file(chosen: Path | None) -> Path:
    """Return the parameter file, the shipped one where none is chosen.

    Raises BadInput where there is none, or names all its mistakes.
    """
    if chosen is None:
        from mrlab_ros.adapters import share

        chosen = share.directory() / "config" / "lab.yaml"
    if not chosen.is_file():
        raise BadInput(NO_PARAMETER_FILE(path=str(chosen)))
    from mrlab_ros.processes.parameter_file import check_parameter_file

    check_parameter_file(chosen)
    return chosen.resolve()


def robot_models(text: str) -> tuple[str, ...]:
    """Return the models in a list such as 'ur5e,kuka_kr3_r540'; raise BadInput for an unknown."""
    models = tuple(model for model in (part.strip() for part in text.split(",")) if model)
    if models:
        from mrlab_ros.adapters import share
        from mrlab_ros.adapters.robots.library import RobotLibrary

        library = RobotLibrary(share.directory() / "robots")
        for model in models:
            library.model(model)
    return models
