"""CDR by the definitions that the lab delivers."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from rosbags.interfaces import Nodetype
from rosbags.typesys import Stores, get_types_from_msg, get_typestore

from mrlab_client.errors import LabError

# The field that ROS puts into a message without fields.
EMPTY = "structure_needs_at_least_one_member"


class Messages:
    """The message types of a lab. schema: as its `/api/schema` delivers them."""

    def __init__(self, schema: Mapping[str, Mapping[str, str]]) -> None:
        self._store = get_typestore(Stores.ROS2_JAZZY)
        found: dict[str, Any] = {}
        for name, text in schema["messages"].items():
            found |= _parsed(text, name)
        for name, text in schema["services"].items():
            request, _, response = text.partition("---\n")
            for half, part in (("Request", request), ("Response", response)):
                # Halves are registered as messages, so that they find their package's own.
                found |= _parsed(part, f"{name}_{half}".replace("/srv/", "/msg/"))
        known = self._store.types
        self._store.register({name: each for name, each in found.items() if name not in known})

    def encode(self, kind: str, values: Mapping[str, Any]) -> bytes:
        """Return the CDR of a message; what `values` leaves out is 0, empty or no turn."""
        name = self._known(kind)
        return bytes(self._store.serialize_cdr(self._filled(name, values), name))

    def decode(self, kind: str, payload: bytes) -> Any:
        """Return a message, with its fields as attributes."""
        definition = self._store.get_msgdef(self._known(kind))
        # Not deserialize_cdr: that refuses the padding which ROS leaves behind the last field.
        little = payload[1] & 1
        read = definition.deserialize_cdr_le if little else definition.deserialize_cdr_be
        message, _ = read(memoryview(payload)[4:], 0, definition.cls, self._store)
        return message

    def _known(self, kind: str) -> str:
        name = kind.replace("/srv/", "/msg/")
        if name not in self._store.types:
            raise LabError(f"The lab has no message type {kind}.", "unknown_type")
        return name

    def _filled(self, name: str, values: Mapping[str, Any]) -> Any:
        fields = dict(self._store.get_msgdef(name).fields)
        if strangers := set(values) - set(fields):
            known = ", ".join(each for each in fields if each != EMPTY)
            raise LabError(f"{name} has no field {', '.join(strangers)}; it has {known}.")
        if name == "geometry_msgs/msg/Quaternion" and not values:
            values = {"w": 1.0}
        parts = {key: self._part(form, values.get(key)) for key, form in fields.items()}
        return self._store.types[name](**parts)

    def _part(self, form: Any, value: Any) -> Any:
        """Return `value` as a field holds it; None: zeros."""
        node, detail = form
        if node is Nodetype.NAME:
            return self._filled(detail, value or {})
        if node is Nodetype.BASE:
            if detail[0] == "string":
                return value or ""
            return np.dtype(detail[0]).type(0 if value is None else value)
        (inner, inner_detail), length = detail
        found = (
            [None] * (length if node is Nodetype.ARRAY else 0) if value is None else list(value)
        )
        parts = [self._part((inner, inner_detail), each) for each in found]
        numbers = inner is Nodetype.BASE and inner_detail[0] != "string"
        return np.array(parts, inner_detail[0]) if numbers else parts


def _parsed(text: str, name: str) -> dict[str, Any]:
    bare = [line.split("#")[0].strip() for line in text.splitlines()]
    if not any(line and "=" not in line for line in bare):
        text += f"\nuint8 {EMPTY}\n"
    return dict(get_types_from_msg(text, name))
