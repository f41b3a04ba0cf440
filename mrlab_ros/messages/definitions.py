"""Message definitions in the form ros2msg: a type's text, then that of every type within."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache
from pathlib import Path

from ament_index_python.packages import PackageNotFoundError, get_package_share_directory
from rosidl_parser.definition import AbstractNestedType, NamespacedType

from mrlab_ros.core.errors import BadInput
from mrlab_ros.messages.qos import message_class

SEPARATOR = "=" * 80


@cache
def definition(kind: str) -> str:
    """Return the text of `kind`, such as sensor_msgs/msg/JointState, with all types within.

    Those follow, each once and breadth first, below a line of 80 equals signs and
    `MSG: package/Name`. The texts are the installed .msg files, whose comments give the units.
    Raises BadInput where a type or its text is not installed.
    """
    kinds = [kind]
    for parent in kinds:  # grows while it is read
        kinds += [inner for inner in dict.fromkeys(_types_in(parent)) if inner not in kinds]
    parts = [_text(kind)]
    for inner in kinds[1:]:
        package, _, name = inner.split("/")
        parts.append(f"{SEPARATOR}\nMSG: {package}/{name}\n{_text(inner)}")
    return "\n".join(part.rstrip("\n") for part in parts) + "\n"


def _types_in(kind: str) -> Iterator[str]:
    """Yield the message types of the fields of `kind`, in their order."""
    for slot in message_class(kind).SLOT_TYPES:
        held = slot.value_type if isinstance(slot, AbstractNestedType) else slot
        if isinstance(held, NamespacedType):
            yield "/".join(held.namespaced_name())


def _text(kind: str) -> str:
    package, folder, name = kind.split("/")
    try:
        return (Path(get_package_share_directory(package)) / folder / f"{name}.msg").read_text()
    except (PackageNotFoundError, OSError):
        raise BadInput(
            f"the text of the message {kind} is not installed; install the package {package}, "
            "or leave out the topics of that type"
        ) from None
