"""Expect that something is refused, by what it means: error class, code and values."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from types import ModuleType
from typing import Any

import pytest

from mrlab_ros.core.base.diagnostic import Code, Diagnostic, plain
from mrlab_ros.core.base.errors import LabError


@contextmanager
def refused(
    code: Code, kind: type[LabError] = LabError, **values: Any
) -> Iterator[pytest.ExceptionInfo[LabError]]:
    """Expect a `kind` with this code and, among others, these values; a nested one counts too."""
    with pytest.raises(kind) as caught:
        yield caught
    _check(plain(caught.value), code, values)


@contextmanager
def command_refuses(command: ModuleType, code: str | Code, **values: Any) -> Iterator[None]:
    """Expect that the module of a command tells this code and, among others, these values."""
    told: list[Diagnostic] = []
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(command, "say_problem", told.append)
        yield
    (found,) = told
    _check(plain(found), code, values)


def _check(found: dict[str, Any], code: str | Code, values: dict[str, Any]) -> None:
    name = code.code if isinstance(code, Code) else code
    inner = [found, *_inner(found["values"])]
    codes = [each["code"] for each in inner]
    assert name in codes, f"expected {name}, found {codes}: {found['message']}"
    said = next(each for each in inner if each["code"] == name)["values"]
    assert {key: said.get(key) for key in values} == plain(values)


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
