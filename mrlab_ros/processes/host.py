"""Runs one or several of the lab's nodes in this process until it is asked to stop."""

from __future__ import annotations

import importlib
import os
import signal
import sys
import time
from collections.abc import Callable
from contextlib import suppress

import rclpy
import rclpy.utilities
from rclpy.impl.implementation_singleton import rclpy_implementation
from rclpy.node import Node

from mrlab_ros.core.errors import LabError
from mrlab_ros.processes.stand_aside import STAYS, StandAside
from mrlab_ros.processes.supervisor import RESTARTS
from mrlab_ros.ros.spinning import SpunNode

# By name: the module and the class of each node.
NODES = {
    "bridge": ("mrlab_ros.nodes.bridge.node", "BridgeNode"),
    "converter": ("mrlab_ros.nodes.converter", "ConverterNode"),
    "coordinator": ("mrlab_ros.nodes.coordinator", "CoordinatorNode"),
    "lab": ("mrlab_ros.nodes.lab.node", "LabNode"),
    "physics": ("mrlab_ros.nodes.physics.node", "PhysicsNode"),
    "playback": ("mrlab_ros.nodes.playback", "PlaybackHostNode"),
    "recorder": ("mrlab_ros.nodes.recorder.node", "RecorderNode"),
}
# How often a process looks whether it was asked to stop, s.
LOOK = 0.1
# A process that is started anew must not join a replay that goes on: so long it looks for the
# recorder, s. Discovery takes up to 3 s.
FIND_TIMEOUT = 3.0


def maker(name: str) -> Callable[[], Node]:
    """Import the node called `name`; what is returned builds it in the default context."""
    module, kind = NODES[name]
    made: Callable[[], Node] = getattr(importlib.import_module(module), kind)
    return made


def main(names: list[str] | None = None) -> None:
    """Run the nodes named in `names`, or on the command line before --ros-args."""
    arguments = sys.argv[1:]
    if names is None:
        end = arguments.index("--ros-args") if "--ros-args" in arguments else len(arguments)
        names = arguments[:end]
    unknown = [name for name in names if name not in NODES]
    if unknown or not names:
        sys.exit(
            f"host: found {'no node' if not names else ', '.join(unknown)}; expected one or more "
            f"of {', '.join(NODES)}, as in: host converter lab coordinator"
        )
    sys.exit(run(names))


def run(names: list[str]) -> int:
    """Spin the nodes until SIGINT or SIGTERM; return the process's exit code.

    While a bag is replayed, the nodes that would publish the same topics are not there; made
    anew, they heal as after a restart.
    """
    rclpy.init()
    # rclpy's own handler of SIGTERM shuts the context down and calls nobody.
    running = rclpy.utilities.get_default_context().ok
    aside: StandAside | None = None
    spun: dict[str, SpunNode] = {}
    name = ""
    try:
        if set(names) - STAYS:
            aside = StandAside()
        makers = {name: maker(name) for name in names}
        if aside is not None:
            aside.hear(FIND_TIMEOUT if os.environ.get(RESTARTS, "0") != "0" else 0.0)
        while running():
            replay = aside is not None and aside.wanted
            wanted = [name for name in names if name in STAYS or not replay]
            for name in [name for name in reversed(spun) if name not in wanted]:
                spun.pop(name).close()
            for name in wanted:
                if name not in spun:
                    spun[name] = SpunNode(makers[name]())
            time.sleep(LOOK)
        return 0
    except LabError as error:
        print(f"{name}: {error}", file=sys.stderr, flush=True)
        return 1
    except KeyboardInterrupt:
        return 0
    finally:
        # A second Ctrl-C must not cut the tidying short: the supervisor sets the deadline.
        signal.signal(signal.SIGINT, signal.SIG_IGN)
        # rclpy's handler of the signal shuts down too, in a thread of its own, and may be first.
        with suppress(rclpy_implementation.RCLError):
            rclpy.utilities.try_shutdown()
        for node in reversed(spun.values()):
            node.close()
        if aside is not None:
            aside.close()
        sys.stdout.flush()
        sys.stderr.flush()


if __name__ == "__main__":
    main()
