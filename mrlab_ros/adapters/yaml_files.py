"""Reads YAML files and names their mistakes; suggests the file meant by a name that is missing."""

from __future__ import annotations

import os
import re
from pathlib import Path
from typing import Any

import yaml

from mrlab_ros.adapters.diagnostics import (
    FILE_MISSING,
    FILE_UNREADABLE,
    KEY_TWICE,
    NOT_A_FILE,
    NOT_OF_FORMAT,
    NOT_UTF8,
    YAML_ALIAS,
    YAML_MAPPING,
)
from mrlab_ros.core.base.checks import bad_value
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.base.names import close_to


def close_file(path: Path) -> str | None:
    """Return the entry beside `path` whose name is closest; None where none is close."""
    try:
        beside = os.listdir(path.parent)
    except OSError:
        return None
    return close_to(path.name, (name for name in beside if not name.startswith(".")))


def check_file(path: Path, name: str = "") -> None:
    """Raise BadInput where `path` is no file: reading a pipe would wait forever.

    name: what the error calls it; empty: the path.
    """
    if path.is_file():
        return
    name = name or str(path)
    if not path.exists():
        raise BadInput(FILE_MISSING(file=name, close=close_file(path)))
    raise BadInput(NOT_A_FILE(file=name, what="folder" if path.is_dir() else "special"))


_Safe: Any = getattr(yaml, "CSafeLoader", yaml.SafeLoader)


class Loader(_Safe):  # type: ignore[misc]
    """PyYAML's safe loader that reads 1e3 as a number, as YAML 1.2 and ROS do."""


_EXPONENT = re.compile(r"[-+]?(?:\d+\.?\d*|\.\d+)[eE][-+]?\d+$")
Loader.add_implicit_resolver("tag:yaml.org,2002:float", _EXPONENT, list("-+.0123456789"))


class RosLoader(yaml.SafeLoader):
    """Reads a parameter file as rcl does: dates, 1_024 and 1:30 are texts.

    Refuses what rcl refuses or decides silently: aliases, and a key that is there twice. In
    Python alone: the C parser resolves aliases itself.
    """

    def compose_node(self, parent: Any, index: Any) -> Any:
        if self.check_event(yaml.events.AliasEvent):
            event = self.peek_event()
            line = event.start_mark.line + 1
            raise BadInput(YAML_ALIAS(line=line, alias=event.anchor))
        return super().compose_node(parent, index)

    def construct_mapping(self, node: Any, deep: bool = False) -> Any:
        seen = set()
        for key, _ in node.value:
            if isinstance(key, yaml.ScalarNode) and key.value in seen:
                raise BadInput(KEY_TWICE(line=key.start_mark.line + 1, key=key.value))
            seen.add(key.value if isinstance(key, yaml.ScalarNode) else id(key))
        return super().construct_mapping(node, deep=deep)


# Texts that PyYAML takes for numbers and dates, and rcl for texts.
_TEXTS = re.compile(r"[-+]?[\d.]+[_:].*|[-+]?0b.*|\d{4}-.*")
RosLoader.yaml_implicit_resolvers = {
    first: [("tag:yaml.org,2002:str", _TEXTS), *found] if first in set("-+.0123456789") else found
    for first, found in Loader.yaml_implicit_resolvers.items()
}


def read_yaml(path: Path, *, empty: bool = False, loader: Any = Loader) -> dict[str, Any]:
    """Return the mapping in a YAML file; raise BadInput where there is none.

    empty: a file without content is a mapping without entries. loader: RosLoader for a ROS
    parameter file.
    """
    try:
        with path.open("rb") as file:
            content = yaml.load(file, Loader=loader)
    except BadInput as error:
        raise BadInput(FILE_UNREADABLE(file=str(path), why=error.diagnostic)) from None
    except (OSError, yaml.YAMLError) as error:
        raise BadInput(FILE_UNREADABLE(file=str(path), why=_reason(error))) from None
    if content is None and empty:
        return {}
    if not isinstance(content, dict):
        raise bad_value(str(path), content, YAML_MAPPING())
    return content


def read_with_lines(path: Path, name: str = "") -> tuple[object, dict[tuple[str | int, ...], int]]:
    """Return what a YAML file holds, and the line of each entry by the keys that lead to it.

    name: what errors call it; empty: the path. Raises BadInput where it is no YAML, or a key is
    there twice.
    """
    origin = name or str(path)
    check_file(path, origin)
    lines: dict[tuple[str | int, ...], int] = {}
    seen: set[int] = set()

    def walk(node: Any, keys: tuple[str | int, ...]) -> None:
        # An alias leads to a node that was there before.
        if id(node) in seen:
            return
        seen.add(id(node))
        if isinstance(node, yaml.SequenceNode):
            for index, each in enumerate(node.value):
                lines[(*keys, index)] = each.start_mark.line + 1
                walk(each, (*keys, index))
        elif isinstance(node, yaml.MappingNode):
            for key, each in node.value:
                name, line = str(key.value), key.start_mark.line + 1
                if (*keys, name) in lines:
                    raise BadInput(KEY_TWICE(file=origin, line=line, key=name))
                lines[(*keys, name)] = line
                walk(each, (*keys, name))

    try:
        text = path.read_text(encoding="utf-8-sig")
        node = yaml.compose(text, Loader=Loader)
        walk(node, ())
        return yaml.load(text, Loader=Loader), lines
    except OSError as error:
        raise BadInput(FILE_UNREADABLE(file=origin, why=_reason(error))) from None
    except UnicodeDecodeError:
        raise BadInput(NOT_UTF8(file=origin)) from None
    except (yaml.YAMLError, ValueError, RecursionError) as error:
        raise not_yaml(origin, error) from None


def not_yaml(file: str, error: Exception) -> BadInput:
    """Return the error for a file that YAML does not read, with the line where it is known."""
    mark = getattr(error, "problem_mark", None)
    why = getattr(error, "problem", None) or str(error)
    line = mark.line + 1 if mark is not None else None
    return BadInput(NOT_OF_FORMAT(file=file, line=line, format="YAML", why=why))


def _reason(error: Exception) -> str:
    return getattr(error, "strerror", None) or str(error)
