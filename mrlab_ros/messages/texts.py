"""Diagnostics in messages: the text, the code, and the values by name as key-value pairs."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from diagnostic_msgs.msg import KeyValue

from mrlab_ros.core.base.diagnostic import Diagnostic, to_texts
from mrlab_ros.core.base.phrase import Value


def values_to_message(values: Mapping[str, Value]) -> list[KeyValue]:
    """Return values by name; a text as it is, all else as JSON."""
    return [KeyValue(key=name, value=text) for name, text in to_texts(values).items()]


def told(said: Diagnostic | str | None, text: str = "message") -> dict[str, Any]:
    """Return the fields that say `said` in a message or a response: text, code and values.

    text: the name of the field for the English text.
    """
    if not isinstance(said, Diagnostic):
        return {text: said or ""}
    return {text: str(said), "code": said.code, "values": values_to_message(said.values)}


def tell(answer: Any, success: bool, said: Diagnostic | str | None) -> None:
    """Fill in the response of a service: whether it was done, and what to say of it."""
    answer.success = success
    for name, value in told(said).items():
        setattr(answer, name, value)
