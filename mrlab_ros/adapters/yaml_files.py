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


def read_yaml(path: Path, *, empty: bool = False) -> dict[str, Any]:
    """Return the mapping in a YAML file; raise BadInput where there is none.

    empty: a file without content is a mapping without entries.
    """
    try:
        with path.open("rb") as file:
            content = yaml.load(file, Loader=Loader)
    except (OSError, yaml.YAMLError) as error:
        raise BadInput(f"{path} cannot be read: {error}; expected a YAML file") from None
    if content is None and empty:
        return {}
    if not isinstance(content, dict):
        raise BadInput(f"{path} holds {type(content).__name__}; expected a YAML mapping")
    return content
