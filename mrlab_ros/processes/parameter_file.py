"""Checks a ROS parameter file before a process is started with it."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from pathlib import Path

from mrlab_ros.adapters.yaml_files import RosLoader, read_yaml
from mrlab_ros.core.base import records
from mrlab_ros.core.base.checks import checked
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.base.names import PARAMETERS_OF_RCLPY, close_to
from mrlab_ros.core.base.records import Field, Record
from mrlab_ros.nodes.parameters import NODES
from mrlab_ros.processes.diagnostics import NO_NODE

# Sections for every node of a process.
FOR_ALL = ("/**", "/*")


def check_parameter_file(path: Path) -> None:
    """Raise BadInput that names every mistake of the file.

    A section for all nodes may hold the parameters of any node of the lab.
    """
    content = read_yaml(path, empty=True, loader=RosLoader)
    records.every(lambda section: _check_section(*section), content.items(), str(path))


def parameter(path: Path, node: str, name: str) -> object:
    """Return what a parameter file says of one parameter of a node; None: nothing."""
    content = read_yaml(path, empty=True, loader=RosLoader)
    found = None
    # A node's own section wins.
    for section in (*FOR_ALL, f"/**/{node}", f"/{node}", node):
        values = (content.get(section) or {}).get("ros__parameters") or {}
        found = dict(_flat(values)).get(name, found)
    return found


def _check_section(name: object, content: object) -> None:
    node = str(name).removeprefix("/**").removeprefix("/")
    if name not in FOR_ALL and node not in NODES:
        close = close_to(node, NODES)
        raise BadInput(NO_NODE(node=str(name), nodes=list(NODES), close=close))
    kinds = tuple(NODES.values()) if name in FOR_ALL else (NODES[node],)
    known: dict[str, list[Field]] = {}
    for kind in kinds:
        for field in records.fields_of(kind).values():
            known.setdefault(field.name, []).append(field)
    values = Record(content, str(name), ("ros__parameters",)).mapping("ros__parameters")
    mistakes = []
    for key, value in _flat(values):
        if key.startswith(PARAMETERS_OF_RCLPY):
            continue
        if key not in known:
            mistakes.append(records.unknown_field(str(name), key, known))
        for field in known.get(key, ()):
            try:
                checked(f"{name}: {key}", value, field.check)
            except BadInput as error:
                mistakes.append(error.diagnostic)
                break
    records.raise_all(mistakes, str(name))


def _flat(values: Mapping[object, object], prefix: str = "") -> Iterator[tuple[str, object]]:
    """Yield full names and values; ROS writes staging.jerk as staging: {jerk: ...}, too."""
    for key, value in values.items():
        if isinstance(value, Mapping):
            yield from _flat(value, f"{prefix}{key}.")
        else:
            yield f"{prefix}{key}", value
