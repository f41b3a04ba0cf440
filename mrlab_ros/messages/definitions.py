"""Message definitions in the form ros2msg: a type's text, then that of every type within.

All definitions that a client decodes the lab with, in one JSON document.

Checks a request before it is serialized: a field of another type would end the process.
"""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator
from functools import cache
from numbers import Integral, Real
from pathlib import Path
from typing import Any

from ament_index_python.packages import PackageNotFoundError, get_package_share_directory
from rosidl_parser.definition import AbstractNestedType, NamespacedType

from mrlab_ros.core.base.diagnostics import BAD_REQUEST_FIELD, TYPE_WITHOUT_TEXT
from mrlab_ros.core.base.errors import BadInput, Misuse
from mrlab_ros.messages.qos import message_class

OWN_PACKAGE = "mrlab_msgs"
VERSION = 1


def schema(types: Iterable[str]) -> bytes:
    """Return the definitions of all types of the lab, of `types`, and of all types within.

    A JSON document: `messages` and `services` with the text of each type, such as
    sensor_msgs/msg/JointState, and `hashes` with each type's hash (REP 2011). Types that are not
    installed are left out.
    """
    wanted = sorted({*_own(), *types})
    kinds = [kind for kind in wanted if _is_installed(kind)]
    for kind in kinds:  # grows while it is read
        kinds += [inner for inner in dict.fromkeys(_within(kind)) if inner not in kinds]
    texts = {kind: text_of(kind) for kind in sorted(kinds)}
    document = {
        "version": VERSION,
        "messages": {kind: text for kind, text in texts.items() if "/msg/" in kind},
        "services": {kind: text for kind, text in texts.items() if "/srv/" in kind},
        "hashes": {kind: value for kind in texts for kind, value in _hashes(kind)},
    }
    return json.dumps(document).encode()


def _own() -> Iterator[str]:
    share = Path(get_package_share_directory(OWN_PACKAGE))
    for folder in ("msg", "srv"):
        for file in share.glob(f"{folder}/*.{folder}"):
            yield f"{OWN_PACKAGE}/{folder}/{file.stem}"


def _is_installed(kind: str) -> bool:
    try:
        message_class(kind)
        text_of(kind)
    except BadInput:
        return False
    return True


def _within(kind: str) -> Iterator[str]:
    found: Any = message_class(kind)
    for part in (found,) if "/msg/" in kind else (found.Request, found.Response):
        yield from types_in(part)


def _hashes(kind: str) -> Iterator[tuple[str, str]]:
    """Yield a type with its hash, and a service's request and response with theirs."""
    package, folder, name = kind.split("/")
    names = (kind,) if folder == "msg" else (kind, f"{kind}_Request", f"{kind}_Response")
    try:
        file = Path(get_package_share_directory(package)) / folder / f"{name}.json"
        known = json.loads(file.read_text())["type_hashes"]
    except (PackageNotFoundError, OSError, ValueError, KeyError):
        return
    for entry in known:
        if entry["type_name"] in names:
            yield entry["type_name"], entry["hash_string"]


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


REALS = {"double", "float"}
INTEGERS = {f"{sign}int{bits}" for sign in ("", "u") for bits in (8, 16, 32, 64)}


def fitted(message: Any, where: str = "") -> Any:
    """Return `message` with its numbers in the types of its fields, such as 2 as 2.0.

    where: what the message is a part of. Raises Misuse where a field has a value of another kind:
    the serialization aborts the process there.
    """
    for name, kind in message.get_fields_and_field_types().items():
        value = getattr(message, name)
        if kind.startswith("sequence<") or kind.endswith("]"):
            item = kind.removeprefix("sequence<").split(",")[0].split("[")[0].rstrip(">")
            if item.startswith("string") or "/" in item:
                for entry in value:
                    _fit(entry, item, f"{where}{name}")
            continue
        fitting = _fit(value, kind, f"{where}{name}")
        if fitting is not value:
            setattr(message, name, fitting)
    return message


def _fit(value: Any, kind: str, name: str) -> Any:
    """Return a field's value in its type; raise Misuse."""
    if kind in REALS:
        if isinstance(value, Real) and not isinstance(value, bool):
            return value if isinstance(value, float) else float(value)
        expected = "number"
    elif kind in INTEGERS:
        if isinstance(value, Integral) and not isinstance(value, bool):
            return value if isinstance(value, int) else int(value)
        expected = "integer"
    elif kind == "boolean":
        if isinstance(value, bool):
            return value
        expected = "boolean"
    elif kind.startswith("string"):
        if isinstance(value, str):
            return value
        expected = "text"
    else:
        return fitted(value, f"{name}.") if hasattr(value, "get_fields_and_field_types") else value
    raise Misuse(BAD_REQUEST_FIELD(field=name, found=repr(value), expected=expected))
