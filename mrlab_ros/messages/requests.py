"""Checks a request before it is serialized: a field of another type would end the process."""

from __future__ import annotations

from numbers import Integral, Real
from typing import Any

from mrlab_ros.core.base.diagnostics import BAD_REQUEST_FIELD
from mrlab_ros.core.base.errors import Misuse

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
