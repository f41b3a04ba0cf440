"""The one list of the lab's processes."""

from __future__ import annotations

import json
import os
import sys
from pathlib import Path

from mrlab_ros.processes.supervisor import ProcessSpec


def lab_processes(
    *,
    config: Path,
    robots: tuple[str, ...],
    listen: str | None,
    state_dir: Path,
    physics: bool = False,
    keys: Path | None = None,
    insecure: bool = False,
    router: bool = False,
) -> list[ProcessSpec]:
    """Return the processes of a lab.

    listen: where people connect, None without a bridge. router: there is a router, to which the
    bridge connects, too.
    """

    def host(name: str, nodes: str, *parameters: str) -> ProcessSpec:
        options = [o for p in (f"state_dir:={state_dir}", *parameters) for o in ("-p", p)]
        argv = (sys.executable, "-m", "mrlab_ros.processes.host", *nodes.split(), "--ros-args")
        # One short line a message: the process's name stands before it already.
        env = {
            "PYTHONUNBUFFERED": "1",
            "RCUTILS_CONSOLE_OUTPUT_FORMAT": os.environ.get(
                "RCUTILS_CONSOLE_OUTPUT_FORMAT", "[{severity}] [{name}]: {message}"
            ),
        }
        return ProcessSpec(name, (*argv, "--params-file", str(config), *options), env)

    spawn = [f"lab:robots:={json.dumps(robots)}"] if robots else []
    specs = [
        host("lab", "converter lab coordinator", *spawn),
        host("playback", "playback"),
        host("recorder", "recorder"),
    ]
    if physics:
        specs.append(host("physics", "physics"))
    if listen is not None:
        there = json.dumps([listen])
        where = [f"connect:={there}", "mode:=client"] if router else [f"listen:={there}"]
        security = [f"insecure:={json.dumps(insecure)}"]
        if keys is not None:
            # A ROS parameter that looks like a number would be one.
            security.append(f"keys:={json.dumps(str(keys.expanduser().resolve()))}")
        specs.append(host("bridge", "bridge", *where, *security))
    return specs
