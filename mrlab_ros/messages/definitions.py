"""Message definitions in the form ros2msg: a type's text, then that of every type within."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache
from pathlib import Path
from typing import Any

from ament_index_python.packages import PackageNotFoundError, get_package_share_directory
from rosidl_parser.definition import AbstractNestedType, NamespacedType

from mrlab_ros.core.base.diagnostics import TYPE_WITHOUT_TEXT
from mrlab_ros.core.base.errors import BadInput
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
        kinds += [
            inner for inner in dict.fromkeys(types_in(message_class(parent))) if inner not in kinds
        ]
    parts = [text_of(kind)]
    for inner in kinds[1:]:
        package, _, name = inner.split("/")
        parts.append(f"{SEPARATOR}\nMSG: {package}/{name}\n{text_of(inner)}")
    return "\n".join(part.rstrip("\n") for part in parts) + "\n"


def types_in(message: Any) -> Iterator[str]:
    """Yield the message types of the fields of a message's class, in their order."""
    for slot in message.SLOT_TYPES:
        held = slot.value_type if isinstance(slot, AbstractNestedType) else slot
        if isinstance(held, NamespacedType):
            yield "/".join(held.namespaced_name())


def text_of(kind: str) -> str:
    """Return the installed text of a message or a service; raise BadInput without one."""
    package, folder, name = kind.split("/")
    try:
        share = Path(get_package_share_directory(package))
        return (share / folder / f"{name}.{folder}").read_text()
    except (PackageNotFoundError, OSError):
        raise BadInput(TYPE_WITHOUT_TEXT(type=kind, package=package)) from None
