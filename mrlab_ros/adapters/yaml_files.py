"""YAML files whose mistakes are named."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import yaml

from mrlab_ros.core.errors import BadInput


def read_yaml(path: Path) -> dict[str, Any]:
    """Return the mapping in a YAML file; raise BadInput where there is none."""
    try:
        with path.open("rb") as file:
            content = yaml.load(file, Loader=getattr(yaml, "CSafeLoader", yaml.SafeLoader))
    except (OSError, yaml.YAMLError) as error:
        raise BadInput(f"{path} cannot be read: {error}; expected a YAML file") from None
    if not isinstance(content, dict):
        raise BadInput(f"{path} holds {type(content).__name__}; expected a YAML mapping")
    return content
