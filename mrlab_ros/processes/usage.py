"""Usage of an executable of the lab's nodes: `ros2 run mrlab_ros playback --help`."""

from __future__ import annotations

import json
from collections.abc import Sequence

from mrlab_ros.core.base import records
from mrlab_ros.nodes.parameters import NODES as PARAMETERS
from mrlab_ros.processes.lab import NODES


def usage(names: Sequence[str]) -> str:
    """Return how to start the nodes called `names`, none: any, and what parameters they have."""
    program = names[0] if len(names) == 1 else "host"
    nodes = "" if len(names) == 1 else f" {' '.join(names) or 'NODE...'}"
    parts = [
        f"usage: ros2 run mrlab_ros {program}{nodes} [--ros-args --params-file FILE "
        "-p NAME:=VALUE -r FROM:=TO]\n"
    ]
    if names:
        parts.append("It is a part of the lab: `ros2 launch mrlab_ros lab.launch.py` starts all.")
    else:
        parts.append(
            f"Runs nodes of the lab in one process.\nNODE is one of {', '.join(sorted(NODES))}.\n"
            "`host NODE --help` lists the parameters of a node."
        )
    parts += [_parameters(name) for name in names]
    return "\n".join(parts)


def _parameters(name: str) -> str:
    node = NODES[name].graph_name
    lines = [f"\nparameters of /{node}:"]
    for field in records.fields_of(PARAMETERS[node]).values():
        default = list(field.default) if isinstance(field.default, tuple) else field.default
        known = "read at the start" if not field.changeable else "can change at run time"
        lines.append(
            f"  {field.name} (default {json.dumps(default, default=str)})\n"
            f"      {field.about}\n      Expected {field.check.expected}; {known}."
        )
    return "\n".join(lines)
