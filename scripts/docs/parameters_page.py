"""Makes docs/parameters.md from the records of the parameters, figures and rules."""

from __future__ import annotations

from dataclasses import MISSING
from enum import Enum
from typing import Any

from mrlab_ros.core.base import records
from mrlab_ros.core.bridge.rules import ServiceRule, TopicRule
from mrlab_ros.core.physics.settings import Settings
from mrlab_ros.core.trajectory.derived_signals import ProxyCoefficients
from mrlab_ros.gateway.link.limits import LinkLimits
from mrlab_ros.nodes.parameters import NODES
from mrlab_ros.processes.launch_arguments import LAB, ROBOT, Argument
from mrlab_ros.ros.parameters import to_ros

HEAD = """# Parameters

<!-- made by `make docs` from the records in the code -->

Every parameter of the lab's nodes and every figure of its configuration files: what it means,
what it may be and what it is where nobody sets it.

Set the parameters of nodes in a ROS parameter file, `mrlab up --config FILE`
(`config/lab.yaml` shows all of them), or one by one:

<!-- not run: needs the `ros2` command of a ROS machine -->
```
ros2 run mrlab_ros host playback --ros-args -p telemetry_rate:=20
ros2 param describe /playback_host telemetry_rate      # unit, range, whether it can change
ros2 param set /playback_host telemetry_rate 20
```

A start with values that cannot be ends at once and names all of them. A change that cannot be is
refused with the reason, and nothing changes. Whole numbers are accepted where a decimal number is
expected; NaN and infinities are accepted nowhere. In the tables, *at run time* says whether a
change takes effect without a restart.
"""
FILES: tuple[tuple[str, type[Any], str], ...] = (
    (
        "`config/physics.yaml`",
        Settings,
        "Figures of [physics](physics-model.md), read when it starts.",
    ),
    (
        "`config/torque_proxy.yaml`",
        ProxyCoefficients,
        "Nominal coefficients of the torque proxy, base joint first; a robot with more joints "
        "repeats the last number. Read when the converter starts.",
    ),
    (
        "`config/bridge.yaml`: topics",
        TopicRule,
        "The fields of a rule; [the bridge](bridge.md#the-allow-list) explains them. Read when "
        "the bridge starts.",
    ),
    ("`config/bridge.yaml`: services", ServiceRule, "The fields of a rule for services."),
    (
        "`mrlab up --web-limits FILE`",
        LinkLimits,
        "What the pages may take of the [gateway](gateway.md). Read when it starts.",
    ),
)


def current() -> str:
    """Return the page as the records say it today."""
    parts = [HEAD]
    for node, kind in NODES.items():
        if records.fields_of(kind):
            parts.append(f"## `{node}`\n\n{_table(kind, run_time=True)}\n")
    for title, kind, about in FILES:
        parts.append(f"## {title}\n\n{about}\n\n{_table(kind, run_time=False)}\n")
    for file, arguments in (("lab", LAB), ("robot", ROBOT)):
        parts.append(f"## `ros2 launch mrlab_ros {file}.launch.py`\n\n{_arguments(arguments)}\n")
    return "\n".join(parts)


def _arguments(arguments: tuple[Argument, ...]) -> str:
    rows = ["| argument | default | may be | meaning |", "|---|---|---|---|"]
    for each in arguments:
        # Whether pybullet is installed here says nothing of another machine.
        default = (
            "`true` where pybullet is installed"
            if each.name == "physics"
            else (_default(MISSING if each.default is None else each.default))
        )
        choices = " or ".join(f"`{choice}`" for choice in each.choices) or "a text"
        rows.append(f"| `{each.name}:=` | {default} | {choices} | {each.about} |")
    return "\n".join(rows)


def _table(kind: type[Any], *, run_time: bool) -> str:
    head = ["name", "default", "expected", *(["at run time"] if run_time else []), "meaning"]
    rows = [head, ["---"] * len(head)]
    for field in records.fields_of(kind).values():
        change = [("yes" if field.changeable else "no")] if run_time else []
        first = [f"`{field.name}`", _default(field.default), str(field.check.expected)]
        rows.append([*first, *change, field.about])
    return "\n".join(f"| {' | '.join(row)} |" for row in rows)


def _default(value: object) -> str:
    if value is MISSING:
        return "none, must be given"
    if isinstance(value, Enum):
        value = value.value
    value = to_ros(value)
    if isinstance(value, list) and len(value) > 4:
        return f"{len(value)} names, see `config/lab.yaml`"
    if isinstance(value, bool):
        return f"`{str(value).lower()}`"
    return "empty" if value == "" else f"`{value}`"
