"""YAML files whose mistakes are named."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import yaml

from mrlab_ros.core.errors import BadInput

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
            raise yaml.composer.ComposerError(
                None,
                None,
                f"*{event.anchor} is an alias, which ROS does not read; write the values out",
                event.start_mark,
            )
        return super().compose_node(parent, index)

    def construct_mapping(self, node: Any, deep: bool = False) -> Any:
        seen = set()
        for key, _ in node.value:
            if isinstance(key, yaml.ScalarNode) and key.value in seen:
                raise yaml.constructor.ConstructorError(
                    None, None, f"'{key.value}' is there twice; write it once", key.start_mark
                )
            seen.add(key.value if isinstance(key, yaml.ScalarNode) else id(key))
        return super().construct_mapping(node, deep=deep)


# What PyYAML takes for numbers and dates, and rcl for texts.
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
    except (OSError, yaml.YAMLError) as error:
        raise BadInput(f"{path} cannot be read: {error}; expected a YAML file") from None
    if content is None and empty:
        return {}
    if not isinstance(content, dict):
        raise BadInput(f"{path} holds {type(content).__name__}; expected a YAML mapping")
    return content
