"""Brings messages of a bag to the definitions that are installed here.

A bag of an earlier lab, or of another distribution, may define a type with other fields. Fields
of the same name and kind are kept, new ones have their defaults, those that are gone are left out.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from rosbags.interfaces import Nodetype
from rosbags.typesys import Stores, get_types_from_msg, get_typestore
from rosbags.typesys.store import Typestore

from mrlab_ros.adapters.bags.diagnostics import FIELD_CHANGED
from mrlab_ros.core.base.errors import BadInput

# Types of ROS that numpy calls otherwise.
DTYPES = {"octet": "uint8", "byte": "uint8", "char": "uint8"}
Convert = Callable[[bytes], bytes]


def migration(kind: str, recorded: str, installed: str) -> Convert | None:
    """Return what turns a recorded message into an installed one; None: they are the same.

    recorded, installed: the definitions with all types within. Raises BadInput where a field of
    one name has another kind in the two.
    """
    old, new = _store(kind, recorded), _store(kind, installed)
    if all(
        name in old.fielddefs and old.fielddefs[name][1] == fields
        for name, (_, fields) in new.fielddefs.items()
    ):
        return None
    _check(kind, kind, old, new)

    def convert(data: bytes) -> bytes:
        known = old.get_msgdef(kind)
        read = known.deserialize_cdr_le if data[1] else known.deserialize_cdr_be
        message = read(data[4:], 0, known.cls, old)[0]
        return bytes(new.serialize_cdr(_moved(message, kind, old, new), kind))

    return convert


def _store(kind: str, text: str) -> Typestore:
    store = get_typestore(Stores.EMPTY)
    store.register(get_types_from_msg(text, kind))
    return store


def _check(old_kind: str, kind: str, old: Typestore, new: Typestore) -> None:
    before = dict(old.fielddefs[old_kind][1])
    for name, description in new.fielddefs[kind][1]:
        if name not in before:
            continue
        was = before[name]
        inner, was_inner = _message_in(description), _message_in(was)
        if inner and was_inner and _shape(description) == _shape(was):
            _check(was_inner, inner, old, new)
        elif was != description:
            raise BadInput(FIELD_CHANGED(field=name, type=kind))


def _shape(description: Any) -> Any:
    """Return how often a message is in a field: its node type, and a length where it has one."""
    node, inner = description
    return node if node == Nodetype.NAME else (node, inner[1])


def _message_in(description: Any) -> str:
    """Return the message type in a field, alone or in a list; empty: it holds none."""
    node, inner = description
    if node == Nodetype.NAME:
        return str(inner)
    if node in (Nodetype.ARRAY, Nodetype.SEQUENCE) and inner[0][0] == Nodetype.NAME:
        return str(inner[0][1])
    return ""


def _moved(message: Any, kind: str, old: Typestore, new: Typestore) -> Any:
    """Return a message of the new store with the values of one of the old."""
    values = []
    for name, description in new.fielddefs[kind][1]:
        inner = _message_in(description)
        if not hasattr(message, name):
            values.append(_default(description, new))
        elif inner and description[0] == Nodetype.NAME:
            values.append(_moved(getattr(message, name), inner, old, new))
        elif inner:
            values.append([_moved(each, inner, old, new) for each in getattr(message, name)])
        else:
            values.append(getattr(message, name))
    return new.types[kind](*values)


def _default(description: Any, store: Typestore) -> Any:
    node, inner = description
    if node == Nodetype.BASE:
        name = inner[0]
        if name == "string":
            return ""
        return False if name == "bool" else 0.0 if name.startswith("float") else 0
    if node == Nodetype.NAME:
        fields = store.fielddefs[str(inner)][1]
        return store.types[str(inner)](*(_default(field, store) for _, field in fields))
    count = inner[1] if node == Nodetype.ARRAY else 0
    if inner[0][0] == Nodetype.BASE and inner[0][1][0] != "string":
        return np.zeros(count, np.dtype(DTYPES.get(inner[0][1][0], inner[0][1][0])))
    return [_default(inner[0], store) for _ in range(count)]
