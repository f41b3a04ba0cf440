"""Runs one or several of the lab's nodes in this process until it is asked to stop."""

from __future__ import annotations

import importlib
import os
import signal
import sys

import rclpy
import rclpy.utilities
from rclpy.executors import ExternalShutdownException, MultiThreadedExecutor
from rclpy.node import Node

from mrlab_ros.core.errors import LabError
from mrlab_ros.spinning import spin

NODES = {
    "bridge": "BridgeNode",
    "converter": "ConverterNode",
    "coordinator": "CoordinatorNode",
    "lab": "LabNode",
    "playback": "PlaybackHostNode",
}
# Service callbacks may wait for another node's answer; so many can wait at once.
THREADS = 4


def make(name: str) -> Node:
    """Build the node called `name` in the default context."""
    module = importlib.import_module(f"mrlab_ros.nodes.{name}")
    node: Node = getattr(module, NODES[name])()
    return node


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
    """Spin the nodes until SIGINT or SIGTERM; return the process's exit code."""
    rclpy.init()
    nodes: list[Node] = []
    try:
        executor = MultiThreadedExecutor(num_threads=THREADS)
        for name in names:
            nodes.append(make(name))
            executor.add_node(nodes[-1])
            # A node that makes further nodes has them spun beside it.
            adopt = getattr(nodes[-1], "adopt", None)
            if adopt is not None:
                adopt(executor)
        spin(executor)
        return 0
    except LabError as error:
        print(
            f"{names[len(nodes)] if len(nodes) < len(names) else 'host'}: {error}",
            file=sys.stderr,
            flush=True,
        )
        return 1
    except (KeyboardInterrupt, ExternalShutdownException):
        return 0
    finally:
        # A second Ctrl-C must not cut the tidying short: the supervisor sets the deadline.
        signal.signal(signal.SIGINT, signal.SIG_IGN)
        for node in reversed(nodes):
            node.destroy_node()
        rclpy.utilities.try_shutdown()
        sys.stdout.flush()
        sys.stderr.flush()


if __name__ == "__main__":
    try:
        main()
    except SystemExit as end:
        # rclpy's threads may outlive an executor that was interrupted; nothing is left to do.
        if isinstance(end.code, int):
            os._exit(end.code)
        raise
