"""What a reader finds, and who takes it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

from mrlab_ros.core.base.diagnostic import Diagnostic


@dataclass(frozen=True, eq=False)
class Found:
    """One variable as a reader finds it.

    The fields are those of `core.conversion.workspace.Variable`, with the numbers as bytes: data
    is column by column, of numpy type `dtype`, None where the numbers are of no use.
    within_object: it lies in a MATLAB object, so two readers have been compared already.
    """

    path: str
    kind: str
    shape: tuple[int, ...] = ()
    data: memoryview | bytes | None = None
    dtype: str = ""
    is_object: bool = False
    note: Diagnostic | str = ""
    columns: tuple[str, ...] = ()
    units: tuple[str, ...] = ()
    time: str = ""
    label: str = ""
    text: str = ""
    within_object: bool = False


class Sink(Protocol):
    """Takes what a reader finds, in the order of the file."""

    def add(self, found: Found) -> None: ...
