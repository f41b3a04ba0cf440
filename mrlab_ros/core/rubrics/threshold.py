"""A figure against its limit, and the share of the points that it earns."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from mrlab_ros.core.rubrics.quantities import Quantity
from mrlab_ros.core.rubrics.rubric import Outcome

# The unit of a figure in SI, by the unit that people see.
SI = {"mm": "m", "m": "m", "deg": "rad", "s": "s", "m/s": "m/s", "%": "", "": ""}
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

    @property
    def words(self) -> str:
        return f"{'at least' if self.at_least else 'at most'} {self.quantity.words(self.limit)}"

    def share(self, value: float) -> float:
        """Return the share of the points, 0 to 1: all up to the limit, then evenly less."""
        beyond = self.limit - value if self.at_least else value - self.limit
        if beyond <= ROUNDING * max(1.0, abs(self.limit)):
            return 1.0
        if self.until is None:
            return 0.0
        span = abs(self.until - self.limit)
        return max(1.0 - beyond / span, 0.0) if span > 0 else 0.0

    def outcome(self, value: float, words: str, time: float | None) -> Outcome:
        """Return what a figure gets; words: a sentence without its end, {} where the value is."""
        return Outcome(
            self.share(value),
            f"{words.replace('{}', self.quantity.words(value))}; expected {self.words}.",
            time,
            value,
            self.limit,
            SI[self.quantity.shown],
        )

    def flaws(self) -> Iterator[str]:
        """Yield why a part of the points could never be given."""
        if self.until is None:
            return
        wrong = self.until >= self.limit if self.at_least else self.until <= self.limit
        if wrong:
            side = "below" if self.at_least else "above"
            yield (
                f"'partial: until {self.quantity.words(self.until)}' gives no part of the points: "
                f"it must lie {side} the limit of {self.quantity.words(self.limit)}"
            )
