"""How much a measure measures."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TypeVar

Value = TypeVar("Value")


@dataclass(frozen=True)
class Size:
    """How much is measured: to see that it runs, in a minute, or all.

    soak: minutes. stock: the executable of zenoh-bridge-ros2dds, to measure beside the bridge.
    """

    name: str
    soak: float = 0.0
    stock: str = ""

    def of(self, touch: Value, quick: Value, full: Value) -> Value:
        """Return the amount of this size."""
        return {"touch": touch, "quick": quick, "full": full}[self.name]

    def some(self, cases: Sequence[Value]) -> Sequence[Value]:
        """Return all cases, or the first to see that it runs."""
        return cases[:1] if self.name == "touch" else cases
