"""Errors: the lab's own sentence, its code and its values."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from mrlab_client.motion import Check


class LabError(Exception):
    """The lab refuses, and has changed nothing. code: what it is, for programs."""

    def __init__(self, message: str, code: str = "", values: Mapping[str, Any] | None = None):
        super().__init__(message)
        self.code, self.values = code, dict(values or {})


class NoAnswer(LabError):
    """Nobody answers, or the connection was lost; a request may have been carried out."""


class FileRefused(LabError):
    """A motion that the lab does not take; `result` has its findings."""

    def __init__(self, result: Check) -> None:
        first = next((each for each in result.findings if each.severity == "error"), None)
        super().__init__(result.message, "" if first is None else first.code)
        self.result = result


def of_plain(found: Mapping[str, Any]) -> LabError:
    """Return the error of a diagnostic as the lab's JSON has it."""
    text = f"{found.get('message', '')} {found.get('remedy', '')}".strip()
    return LabError(text, str(found.get("code", "")), found.get("values"))
