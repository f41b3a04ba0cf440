"""Lengths, angles, times, speeds and shares, as people write them: 5 mm, 30 deg, 80%."""

from __future__ import annotations

import math
import re
from dataclasses import dataclass

from mrlab_ros.core.base.diagnostic import Diagnostic
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.rubrics.diagnostics import (
    BEYOND_MOST,
    NO_UNIT,
    NOT_A_NUMBER,
    OTHER_UNIT,
    QUANTITY,
)

# A number and, behind it, its unit or whatever stands there.
WRITTEN = r"[-+]?[\d.,]*\d[\d.,]*(?:e[-+]?\d+)?\s?(?:%|°|[a-zµ]+(?:/[a-z]+)?)?"
_PARTS = re.compile(r"([-+]?[\d.,]*\d[\d.,]*(?:e[-+]?\d+)?)\s?(.*)")


@dataclass(frozen=True)
class Quantity:
    """A kind of quantity. units: what each is in SI, the first is that of the example; si: the
    unit in SI. most: of SI, beyond which a value is a slip."""

    noun: str
    units: dict[str, float]
    si: str
    example: str
    most: float

    def read(self, text: str, unit: str = "") -> float:
        """Return the value in SI; unit: where the text has none. Raises BadInput."""
        match = _PARTS.fullmatch(text.strip())
        number, given = (match[1], match[2].strip() or unit) if match else (text, unit)
        try:
            value = float(number)
        except ValueError:
            better = number.replace(",", ".") if "," in number else None
            raise BadInput(
                NOT_A_NUMBER(text=text, better=better, expected=self.expected)
            ) from None
        if given not in self.units:
            if not given:
                raise BadInput(NO_UNIT(text=text, expected=self.expected))
            raise BadInput(OTHER_UNIT(text=text, given=given, expected=self.expected))
        value *= self.units[given]
        if not -self.most <= value <= self.most or not math.isfinite(value):
            raise BadInput(
                BEYOND_MOST(text=text, limit=self.most, unit=self.si, expected=self.expected)
            )
        return value

    @property
    def expected(self) -> Diagnostic:
        units = [unit for unit in self.units if unit]
        return QUANTITY(quantity=self.noun, example=self.example, units=units)


LENGTH = Quantity("length", {"mm": 1e-3, "cm": 1e-2, "m": 1.0}, "m", "5 mm", 100.0)
DISTANCE = Quantity("length", {"m": 1.0, "cm": 1e-2, "mm": 1e-3}, "m", "1.5 m", 1e4)
ANGLE = Quantity(
    "angle",
    {"deg": math.pi / 180, "°": math.pi / 180, "rad": 1.0},
    "rad", "10 deg", 4 * math.pi,
)  # fmt: skip
TIME = Quantity(
    "time", {"s": 1.0, "ms": 1e-3, "min": 60.0, "sec": 1.0, "seconds": 1.0}, "s", "4 s", 1e6
)
SPEED = Quantity("speed", {"m/s": 1.0, "cm/s": 1e-2, "mm/s": 1e-3}, "m/s", "250 mm/s", 100.0)
SHARE = Quantity("share", {"%": 0.01}, "%", "80%", 10.0)
NUMBER = Quantity("number", {"": 1.0}, "", "-3", 1e6)
