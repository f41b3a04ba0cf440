"""Lengths, angles, times, speeds and shares, as people write them: 5 mm, 30 deg, 80%."""

from __future__ import annotations

import math
import re
from dataclasses import dataclass

from mrlab_ros.core.errors import BadInput

# A number and, behind it, its unit or whatever stands there.
WRITTEN = r"[-+]?[\d.,]*\d[\d.,]*(?:e[-+]?\d+)?\s?(?:%|°|[a-zµ]+(?:/[a-z]+)?)?"
_PARTS = re.compile(r"([-+]?[\d.,]*\d[\d.,]*(?:e[-+]?\d+)?)\s?(.*)")


@dataclass(frozen=True)
class Quantity:
    """A kind of quantity. units: what each is in SI; shown: the unit for people, and how many of
    it are 1 of SI. most: of SI, beyond which a value is a slip."""

    noun: str
    units: dict[str, float]
    shown: str
    example: str
    most: float

    def read(self, text: str, unit: str = "") -> float:
        """Return the value in SI; unit: where the text has none. Raises BadInput."""
        match = _PARTS.fullmatch(text.strip())
        number, given = (match[1], match[2].strip() or unit) if match else (text, unit)
        try:
            value = float(number)
        except ValueError:
            point = f"; write {number.replace(',', '.')}" if "," in number else ""
            raise BadInput(f"'{text}' is no number{point}; expected {self.expected}") from None
        if given not in self.units:
            what = f"has the unit '{given}'" if given else "has no unit"
            raise BadInput(f"'{text}' {what}; expected {self.expected}")
        value *= self.units[given]
        if not -self.most <= value <= self.most or not math.isfinite(value):
            raise BadInput(f"'{text}' is beyond {self.words(self.most)}; expected {self.expected}")
        return value

    @property
    def expected(self) -> str:
        units = ", ".join(unit for unit in self.units if unit)
        return f"{self.noun}, such as {self.example}" + (f" (units: {units})" if units else "")

    def words(self, value: float) -> str:
        """Return a value in SI for a person, such as '4.7 mm'."""
        shown = value / self.units[self.shown]
        text = f"{round(shown, 3) + 0.0:.4g}" if abs(shown) < 1e4 else f"{shown:.0f}"
        if self.shown == "%":
            return f"{text}%"
        return f"{text} {self.shown}".strip()


LENGTH = Quantity("a length", {"mm": 1e-3, "cm": 1e-2, "m": 1.0}, "mm", "5 mm", 100.0)
DISTANCE = Quantity("a length", {"m": 1.0, "cm": 1e-2, "mm": 1e-3}, "m", "1.5 m", 1e4)
ANGLE = Quantity(
    "an angle",
    {"deg": math.pi / 180, "°": math.pi / 180, "rad": 1.0},
    "deg", "10 deg", 4 * math.pi,
)  # fmt: skip
TIME = Quantity(
    "a time", {"s": 1.0, "ms": 1e-3, "min": 60.0, "sec": 1.0, "seconds": 1.0}, "s", "4 s", 1e6
)
SPEED = Quantity("a speed", {"m/s": 1.0, "cm/s": 1e-2, "mm/s": 1e-3}, "m/s", "250 mm/s", 100.0)
SHARE = Quantity("a percentage", {"%": 0.01}, "%", "80%", 10.0)
NUMBER = Quantity("a number", {"": 1.0}, "", "-3", 1e6)
