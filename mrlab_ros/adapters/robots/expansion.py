"""Expands a xacro, whose expressions are Python: in a process behind the wall only."""

from __future__ import annotations

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
        if isinstance(error, PackageNotFoundError) or "not found" in str(error):
            hint = "give the folder of a package with --package NAME=FOLDER"
        elif isinstance(error, PermissionError) or "Permission denied" in str(error):
            hint = (
                "a xacro reads what lies beside it and in its packages; give the folder of one "
                "with --package NAME=FOLDER"
            )
        else:
            asks = " as NAME:=VALUE" if "rgument" in str(error) else ""
            hint = f"give what it asks for{asks}, or correct the file"
        raise BadInput(f"{path.rpartition('/')[2]}: xacro says: {error}; {hint}") from None
    return expanded
