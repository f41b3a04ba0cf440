"""Expands a xacro, whose expressions are Python: in a process behind the wall only."""

from __future__ import annotations

from mrlab_ros.adapters.robots.diagnostics import XACRO_REFUSED
from mrlab_ros.core.errors import BadInput


def expand(path: str, arguments: dict[str, str]) -> str:
    """Return the URDF's text; raise BadInput where xacro refuses the file."""
    import xacro
    from ament_index_python.packages import PackageNotFoundError

    try:
        expanded: str = xacro.process_file(path, mappings=arguments).toprettyxml(indent="  ")
    except MemoryError:
        raise
    except Exception as error:  # xacro evaluates Python: anything can come out of it
        # What xacro raises is often a text alone.
        if isinstance(error, PackageNotFoundError) or "not found" in str(error):
            hint = "package"
        elif isinstance(error, PermissionError) or "Permission denied" in str(error):
            hint = "folder"
        else:
            hint = "argument" if "rgument" in str(error) else "file"
        file = path.rpartition("/")[2]
        raise BadInput(XACRO_REFUSED(file=file, why=str(error), hint=hint)) from None
    return expanded
