"""Finds the text of message types among the installed packages."""

from __future__ import annotations

from functools import cache
from pathlib import Path

from ament_index_python.packages import PackageNotFoundError, get_package_share_directory

from mrlab_ros.core.errors import BadInput
from mrlab_ros.core.recording.definitions import full_definition


def message_text(kind: str) -> str:
    """Return the .msg file of a type such as std_msgs/msg/String; raise BadInput without one."""
    package, folder, name = kind.split("/")
    try:
        path = Path(get_package_share_directory(package)) / folder / f"{name}.msg"
        return path.read_text()
    except (PackageNotFoundError, OSError):
        raise BadInput(
            f"the text of the message {kind} is not installed; install the package {package}, "
            "or leave out the topics of that type"
        ) from None


@cache
def definition(kind: str) -> str:
    """Return the full definition of a type, in the form ros2msg."""
    return full_definition(kind, message_text)
