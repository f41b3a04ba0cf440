"""Expect that something is refused, by what it means: error class, code and values."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import pytest

from mrlab_ros.core.base.diagnostic import Code, plain
from mrlab_ros.core.errors import LabError


@contextmanager
def refused(
    code: Code, kind: type[LabError] = LabError, **values: Any
) -> Iterator[pytest.ExceptionInfo[LabError]]:
    """Expect a `kind` with this code and, among others, these values; a nested one counts too."""
    with pytest.raises(kind) as caught:
        yield caught
    found = plain(caught.value)
    inner = [found, *_inner(found["values"])]
    codes = [each["code"] for each in inner]
    assert code.code in codes, f"expected {code.code}, found {codes}: {caught.value}"
    said = next(each for each in inner if each["code"] == code.code)["values"]
    assert {name: said.get(name) for name in values} == plain(values)


def said_in(found: Any) -> dict[str, dict[str, Any]]:
    """Return the values of a diagnostic, or an error, and of all inside it, by their codes."""
    whole = plain(found)
    return {each["code"]: each["values"] for each in [*_inner(whole["values"]), whole]}


def _inner(value: Any) -> Iterator[dict[str, Any]]:
    if isinstance(value, dict):
        if "code" in value and "values" in value:
            yield value
        for each in value.values():
            yield from _inner(each)
    elif isinstance(value, list):
        for each in value:
            yield from _inner(each)
