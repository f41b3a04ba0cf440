"""Start a process of the lab: `python -m mrlab_ros.processes.host NODE... --ros-args ...`.

This module imports little, so that its first statements decide what SIGINT does. By default
Python raises KeyboardInterrupt, and in the middle of an import that prints a traceback.
"""

from __future__ import annotations

import os
import signal
import sys
from pathlib import Path

from mrlab_ros.adapters.parent_exit import end_with_launcher
from mrlab_ros.adapters.sandbox.inert_output import guard
from mrlab_ros.adapters.sandbox.python_process import keep_to_installed_modules


def main(names: list[str] | None = None) -> None:
    """Run the nodes named in `names`, or on the command line before --ros-args; --help prints.

    Until rclpy is initialised, SIGINT and SIGTERM end the process at once: there is nothing to
    close yet. From then on rclpy handles both. A supervisor may start the process with SIGINT
    blocked, see supervisor.ProcessSpec; a SIGINT that arrived before this call then ends it here.
    """
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    signal.pthread_sigmask(signal.SIG_UNBLOCK, {signal.SIGINT})
    end_with_launcher()
    keep_to_installed_modules()
    guard()
    from mrlab_ros.processes.lab import NODES

    arguments = sys.argv[1:]
    if "--ros-args" in arguments:
        arguments = arguments[: arguments.index("--ros-args")]
    wants_help = {"-h", "--help"} & {*arguments}
    if names is None:
        names = [word for word in arguments if word not in wants_help]
    elif arguments and not wants_help:
        sys.exit(
            f"{names[0]}: found {' '.join(arguments)}; expected nothing before --ros-args. "
            f"Parameters are given as in: {names[0]} --ros-args -p NAME:=VALUE"
        )
    unknown = [name for name in names if name not in NODES]
    if wants_help and not unknown:
        from mrlab_ros.processes.usage import usage

        print(usage(names))
        return
    if unknown or not names:
        sys.exit(
            f"host: found {'no node' if not names else ', '.join(unknown)}; expected one or more "
            f"of {', '.join(NODES)}, as in: host converter lab coordinator"
        )
    from mrlab_ros.adapters import threads
    from mrlab_ros.processes.node_runner import run

    threads.end_process_where_a_thread_fails()

    if "recorder" not in names:
        os.umask(0o077)  # what the lab keeps is its user's alone; bags are made for others, too
    # Everything is closed. A thread of Fast DDS or zenoh that comes back to Python while the
    # interpreter ends would abort the process.
    os._exit(run(names))


def run_named_node() -> None:
    """Run the node that the executable is named after, as `ros2 run mrlab_ros converter` does."""
    main([Path(sys.argv[0]).name])


if __name__ == "__main__":
    main()
