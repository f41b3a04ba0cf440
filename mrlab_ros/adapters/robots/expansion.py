"""Expands a xacro, whose expressions are Python: in a process in the sandbox only."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from collections.abc import Iterator

from mrlab_ros.adapters.robots.diagnostics import XACRO_REFUSED
from mrlab_ros.core.base.errors import BadInput


def expand(path: str, arguments: dict[str, str]) -> str:
    """Return the URDF's text; raise BadInput where xacro refuses the file."""
    import xacro
    from ament_index_python.packages import PackageNotFoundError
    from xacro.substitution_args import ArgException

    hints: dict[type[BaseException], str] = {
        PackageNotFoundError: "package",
        PermissionError: "folder",
        ArgException: "argument",
    }
    try:
        expanded: str = xacro.process_file(path, mappings=arguments).toprettyxml(indent="  ")
    except MemoryError:
        raise
    except Exception as error:  # xacro evaluates Python: anything can come out of it
        known = (hint for one in _wrapped(error) for kind, hint in hints.items()
                 if isinstance(one, kind))  # fmt: skip
        file = path.rpartition("/")[2]
        why = str(error) or type(error).__name__
        hint = next(known, "file")
        names = _arguments(path) if hint == "argument" else []
        raise BadInput(
            XACRO_REFUSED(file=file, why=why, hint=hint, arguments=names or None)
        ) from None
    return expanded


def _arguments(path: str) -> list[str]:
    """Return the arguments that a file declares, as NAME:=DEFAULT."""
    found = ET.parse(path).iter("{http://www.ros.org/wiki/xacro}arg")
    return [f"{arg.get('name')}:={arg.get('default')}" for arg in found]


def _wrapped(error: BaseException | None) -> Iterator[BaseException]:
    """Yield an error and those that it wraps: as its cause, or as `exc`, as xacro does."""
    while error is not None:
        yield error
        error = getattr(error, "exc", None) or error.__cause__ or error.__context__
