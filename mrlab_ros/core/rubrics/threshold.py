"""A figure against its limit, and the share of the points that it earns."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

from mrlab_ros.core.base.diagnostic import Code, Diagnostic
from mrlab_ros.core.rubrics.diagnostics import PARTIAL_GIVES_NOTHING
from mrlab_ros.core.rubrics.quantities import Quantity
from mrlab_ros.core.rubrics.rubric import Outcome

# Of a limit that is met but for a last decimal.
ROUNDING = 1e-9


@dataclass(frozen=True)
class Threshold:
    """limit: in SI; a figure shall be at most that, or at least where `at_least`. until: where no
    points are left, None: just beyond the limit."""

    quantity: Quantity
    limit: float
    until: float | None = None
    at_least: bool = False

    def share(self, value: float) -> float:
        """Return the share of the points, 0 to 1: all up to the limit, then evenly less."""
        beyond = self.limit - value if self.at_least else value - self.limit
        if beyond <= ROUNDING * max(1.0, abs(self.limit)):
            return 1.0
        if self.until is None:
            return 0.0
        span = abs(self.until - self.limit)
        return max(1.0 - beyond / span, 0.0) if span > 0 else 0.0

    def outcome(self, code: Code, value: float, time: float | None, /, **values: Any) -> Outcome:
        """Return what a figure gets; code: what is found, with a limit."""
        of: dict[str, Any] = {"value": value, "limit": self.limit, "unit": self.quantity.si}
        return Outcome(self.share(value), code(**of, **values), time)

    def flaws(self) -> Iterator[Diagnostic]:
        """Yield why a part of the points could never be given."""
        if self.until is None:
            return
        if self.until >= self.limit if self.at_least else self.until <= self.limit:
            yield PARTIAL_GIVES_NOTHING(
                until=self.until,
                side="below" if self.at_least else "above",
                limit=self.limit,
                unit=self.quantity.si,
            )
