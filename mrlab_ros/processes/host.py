"""Start a process of the lab: `python -m mrlab_ros.processes.host NODE... --ros-args ...`.

This module imports little, so that its first statements decide what SIGINT does. By default
Python raises KeyboardInterrupt, and in the middle of an import that prints a traceback.
"""

from __future__ import annotations

import signal
import sys
from pathlib import Path


def main(names: list[str] | None = None) -> None:
    """Run the nodes named in `names`, or on the command line before --ros-args.

    Until rclpy is initialised, SIGINT and SIGTERM end the process at once: there is nothing to
    close yet. From then on rclpy handles both. A supervisor may start the process with SIGINT
    blocked, see supervisor.ProcessSpec; a SIGINT that arrived before this call then ends it here.
    """
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    signal.pthread_sigmask(signal.SIG_UNBLOCK, {signal.SIGINT})
    from mrlab_ros.processes.lab import NODES

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
    from mrlab_ros.processes.node_runner import run

    sys.exit(run(names))


def run_named_node() -> None:
    """Run the node that the executable is named after, as `ros2 run mrlab_ros converter` does."""
    main([Path(sys.argv[0]).name])


if __name__ == "__main__":
    main()
