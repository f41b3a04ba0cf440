"""Packages beside the lab that add commands and routes; the lab works without them.

Each package has
- COMMANDS: module and attribute of each command of `mrlab`, by its name;
- ROUTERS: module and attribute of each router of the gateway;
- POLICY: role that each of its routes needs, by method and path; "everybody": none;
- POSTED: paths to which pages of other sites may post, for each of which the package says what
  takes the place of the guard's tokens;
- check(settings): raises BadInput where the settings of a gateway cannot be served.
Its own module imports nothing of these, so that the command line starts quickly.
"""

from __future__ import annotations

import importlib
from collections.abc import Iterator
from typing import Any

EXTENSIONS = ("mrlab_ros.classroom",)


def extensions() -> Iterator[Any]:
    """Yield the packages that are installed."""
    for name in EXTENSIONS:
        try:
            yield importlib.import_module(name)
        except ModuleNotFoundError as error:
            if error.name != name:
                raise


def named(where: str) -> Any:
    """Return what `module:attribute` names."""
    module, _, attribute = where.partition(":")
    return getattr(importlib.import_module(module), attribute)
