"""Encodes and decodes CDR by message definitions."""

from __future__ import annotations

import math
from collections.abc import Mapping
from functools import cache
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
from ament_index_python.packages import PackageNotFoundError, get_package_share_directory
from rosbags.interfaces import Nodetype
from rosbags.typesys import Stores, get_types_from_msg, get_typestore

from mrlab_ros.core.base.errors import BadInput, Unavailable
from mrlab_ros.gateway.lab.diagnostics import (
    BYTES_NOT_OF_TYPE,
    NO_SUCH_FIELD,
    NOT_OF_TYPE,
    PACKAGE_MISSING,
    UNKNOWN_TYPE,
)

PACKAGE = "mrlab_msgs"
# The field that ROS puts into a message without fields.
EMPTY = "structure_needs_at_least_one_member"


class Definitions:
    """The message types of the lab, ROS's standard ones included.

    texts: type name such as mrlab_msgs/msg/Robots or mrlab_msgs/srv/Seek -> text of its file.
    A request is named mrlab_msgs/srv/Seek_Request, a response mrlab_msgs/srv/Seek_Response.
    store: rosbags' types; the halves of services are in msg/ there.
    """

    def __init__(self, texts: Mapping[str, str]) -> None:
        self.store = get_typestore(Stores.ROS2_JAZZY)
        self.learn(dict(texts))

    def learn(self, texts: Mapping[str, str]) -> list[str]:
        """Add the types that are not known yet; return those that are known otherwise."""
        found: dict[str, Any] = {}
        for name, text in texts.items():
            package, folder, kind = name.split("/")
            if folder == "srv":
                # Halves of services are registered as messages: they find their own package.
                request, _, response = text.partition("---")
                found |= _parsed(request, f"{package}/msg/{kind}_Request")
                found |= _parsed(response, f"{package}/msg/{kind}_Response")
            else:
                found |= _parsed(text, name)
        known = self.store.fielddefs
        self.store.register({name: entry for name, entry in found.items() if name not in known})
        # Fields alone: constants may be added without harm.
        return [name for name, entry in found.items() if known[name][1] != entry[1]]

    def encode(self, type_name: str, values: object) -> bytes:
        """Return the CDR, with its header, of a message or of a mapping: field -> value.

        Fields that a mapping leaves out are 0, empty or false. Raises BadInput for an unknown type
        or field, or a value that does not fit its field.
        """
        name = self._known(type_name)
        if isinstance(values, Mapping):
            values = self._filled(name, values)
        try:
            return bytes(self.store.serialize_cdr(values, name))
        except Exception as error:
            raise BadInput(
                NOT_OF_TYPE(found=_short(values), type=type_name, why=str(error))
            ) from error

    def decode(self, type_name: str, payload: bytes) -> Any:
        """Return the message, with its fields as attributes. Raises BadInput where it is none."""
        name = self._known(type_name)
        definition = self.store.get_msgdef(name)
        try:
            # Not deserialize_cdr: that refuses bytes behind the last field, and rclpy leaves
            # padding there.
            little = payload[1] & 1
            read = definition.deserialize_cdr_le if little else definition.deserialize_cdr_be
            message, _ = read(memoryview(payload)[4:], 0, definition.cls, self.store)
        except Exception as error:
            raise BadInput(
                BYTES_NOT_OF_TYPE(size=len(payload), type=type_name, why=str(error))
            ) from error
        return message

    def _known(self, type_name: str) -> str:
        name = type_name.replace("/srv/", "/msg/")
        if name not in self.store.fielddefs:
            raise BadInput(UNKNOWN_TYPE(type=type_name))
        return name

    def _filled(self, name: str, values: Mapping[str, Any]) -> Any:
        fields = dict(self.store.get_msgdef(name).fields)
        strangers = [key for key in values if key not in fields]
        if strangers:
            known = [field for field in fields if field != EMPTY]
            raise BadInput(NO_SUCH_FIELD(type=name, names=strangers, fields=known))
        parts = {key: self._part(kind, values.get(key)) for key, kind in fields.items()}
        return self.store.types[name](**parts)

    def _part(self, kind: Any, value: Any) -> Any:
        """Return `value` as a field holds it; None: zeros."""
        node, detail = kind
        if node is Nodetype.NAME:
            if value is None or isinstance(value, Mapping):
                return self._filled(detail, value or {})
            return value
        if node is Nodetype.BASE:
            return _zero(detail[0]) if value is None else value
        (inner, inner_detail), length = detail
        if value is None:
            value = [None] * (length if node is Nodetype.ARRAY else 0)
        if inner is Nodetype.BASE and inner_detail[0] != "string":
            if isinstance(value, bytes | bytearray | memoryview):
                return np.frombuffer(value, inner_detail[0])
            return np.array([0 if each is None else each for each in value], inner_detail[0])
        return [self._part((inner, inner_detail), each) for each in value]


def learning_definitions() -> Definitions:
    """Return the types of this machine's message package, none of them where it is not here.

    The lab's key `schema` has the others.
    """
    try:
        return Definitions(texts_of(Path(get_package_share_directory(PACKAGE))))
    except PackageNotFoundError:
        return Definitions({})


@cache
def installed_definitions() -> Definitions:
    """Return the types of the message package on this machine. Raises Unavailable without it."""
    try:
        folder = Path(get_package_share_directory(PACKAGE))
    except PackageNotFoundError as error:
        raise Unavailable(PACKAGE_MISSING(package=PACKAGE)) from error
    return Definitions(texts_of(folder))


def texts_of(folder: Path) -> dict[str, str]:
    """Return the definitions in PACKAGE's folder with msg/ and srv/: type name -> text."""
    return {
        f"{PACKAGE}/{kind}/{file.stem}": file.read_text()
        for kind in ("msg", "srv")
        for file in sorted(folder.glob(f"{kind}/*.{kind}"))
        if file.is_file()  # a link may be left of a type that is no more
    }


def plain(message: object) -> Any:
    """Return a message as JSON has it: mappings, lists, numbers and texts; NaN becomes None."""
    if isinstance(message, SimpleNamespace):
        return {key: plain(value) for key, value in vars(message).items()}
    if hasattr(message, "__msgtype__"):
        names = [name for name in message.__dataclass_fields__ if name != "__msgtype__"]  # type: ignore[attr-defined]
        return {name: plain(getattr(message, name)) for name in names if name != EMPTY}
    if isinstance(message, np.ndarray):
        return plain(message.tolist())
    if isinstance(message, list | tuple):
        return [plain(each) for each in message]
    if isinstance(message, np.generic):
        return plain(message.item())
    if isinstance(message, float) and not math.isfinite(message):
        return None
    return message


def _parsed(text: str, name: str) -> dict[str, Any]:
    bare = [line.split("#")[0].strip() for line in text.splitlines()]
    if not any(line and "=" not in line for line in bare):
        text += f"\nuint8 {EMPTY}\n"
    return dict(get_types_from_msg(text, name))


def _zero(base: str) -> Any:
    return {"string": "", "bool": False}.get(base, 0.0 if base.startswith("float") else 0)


def _short(values: object) -> str:
    text = repr(values)
    return text if len(text) < 200 else f"{text[:200]}..."
