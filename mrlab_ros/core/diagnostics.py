"""Findings about a file or a trajectory, as data: code, severity, words, remedy, place."""

from __future__ import annotations

from dataclasses import dataclass
from enum import IntEnum


class Severity(IntEnum):
    """How much a finding matters; the values are those of mrlab_msgs/Diagnostic."""

    INFO = 0
    WARNING = 1
    ERROR = 2


@dataclass(frozen=True)
class Diagnostic:
    """One finding. `where` is a place inside `variable`, such as 'row 12, column 3'."""

    code: str
    severity: Severity
    message: str
    remedy: str = ""
    variable: str = ""
    where: str = ""
