"""Expands a xacro, whose expressions are Python: in a process in the sandbox only."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from collections.abc import Iterator

from mrlab_ros.adapters.robots.importing.diagnostics import XACRO_NO_ARGUMENT, XACRO_REFUSED
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.base.names import close_to


def expand(path: str, arguments: dict[str, str]) -> str:
    """Return the URDF's text; raise BadInput where xacro refuses the file, or an argument."""
    import xacro
    from ament_index_python.packages import PackageNotFoundError
    from xacro.substitution_args import ArgException

    hints: dict[type[BaseException], str] = {
        PackageNotFoundError: "package",
        PermissionError: "folder",
        ArgException: "argument",
    }
    file = path.rpartition("/")[2]
    given = _Arguments(arguments)
    try:
        expanded: str = xacro.process_file(path, mappings=given).toprettyxml(indent="  ")
    except MemoryError:
        raise
    except Exception as error:  # xacro evaluates Python: anything can come out of it
        known = ((hint, one) for one in _wrapped(error) for kind, hint in hints.items()
                 if isinstance(one, kind))  # fmt: skip
        hint, first = next(known, ("file", error))
        why = str(error) or type(error).__name__
        if hint == "package":  # without where it was sought, and the class that xacro puts before
            why = str(first.args[0]).partition(", searching")[0]
        names = _arguments(path) if hint == "argument" else []
        raise BadInput(
            XACRO_REFUSED(file=file, why=why, hint=hint, arguments=names or None)
        ) from None
    if unused := sorted(arguments.keys() - given.asked):
        names = sorted(given.asked)
        close = close_to(unused[0], names)
        raise BadInput(XACRO_NO_ARGUMENT(file=file, arguments=unused, known=names, close=close))
    return expanded


class _Arguments(dict[str, str]):
    """Arguments of a xacro. asked: the names of those that it and what it includes have."""

    def __init__(self, given: dict[str, str]) -> None:
        super().__init__(given)
        self.asked: set[str] = set()

    def __contains__(self, name: object) -> bool:
        self.asked.add(str(name))
        return super().__contains__(name)


def _arguments(path: str) -> list[str]:
    """Return the arguments that a file declares, as NAME:=DEFAULT."""
    found = ET.parse(path).iter("{http://www.ros.org/wiki/xacro}arg")
    return [f"{arg.get('name')}:={arg.get('default')}" for arg in found]


def _wrapped(error: BaseException | None) -> Iterator[BaseException]:
    """Yield an error and those that it wraps: as its cause, or as `exc`, as xacro does."""
    while error is not None:
        yield error
        error = getattr(error, "exc", None) or error.__cause__ or error.__context__
