"""What a late submission loses: a share of its points for each day that has begun."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator
from dataclasses import dataclass
from datetime import datetime

from mrlab_ros.classroom.rubrics.diagnostics import HANDED_IN_LATE, HANDED_IN_ON_TIME
from mrlab_ros.classroom.rubrics.rubric import Ground, Outcome
from mrlab_ros.core.base.checks import FILLED_TEXT, Text
from mrlab_ros.core.base.diagnostic import Diagnostic
from mrlab_ros.core.base.records import field
from mrlab_ros.core.checking.check_record import Checked

DAY_S = 24 * 3600.0
INSTANT = re.compile(
    r"(\d{4}-\d\d-\d\d)[T ](\d\d:\d\d)(:\d\d)?(?:\.\d+)?\s*(?:(Z|UTC)|([+-]\d\d):?(\d\d))"
)
DUE = Text(INSTANT, "a day, a time and its zone, such as '2026-11-30 23:59 +01:00'")
PART = Text(re.compile(r"\d+(?:[.,]\d+)?\s*%"), "a percentage, such as 10%")


def instant(text: str) -> float | None:
    """Return a time of an export, s since 1970; None for another text."""
    found = INSTANT.fullmatch(text.strip())
    if found is None:
        return None
    day, minute, second, _, hours, minutes = found.groups()
    zone = f"{hours}:{minutes}" if hours else "+00:00"
    try:
        return datetime.fromisoformat(f"{day}T{minute}{second or ':00'}{zone}").timestamp()
    except ValueError:
        return None


@dataclass(frozen=True)
class Late:
    """The rule of a rubric for late submissions."""

    per_day: str = field(PART, "Share of the points that each day that has begun takes.")
    due: str = field(DUE, "Until when all points can be had; none: as the platform says.", "")
    at_most: str = field(PART, "Share of the points that is taken at most.", "100%")
    name: str = field(FILLED_TEXT, "What the row is called.", "Late")

    def days(self, handed_in: float | None, late: bool) -> int:
        """Return how many days have begun since it was due.

        handed_in: s since 1970, None: not known; late: the platform calls it late, which is a day
        where no more is known.
        """
        due = instant(self.due)
        if due is None or handed_in is None:
            return int(late)
        return max(math.ceil((handed_in - due) / DAY_S), 0)

    def share(self, days: int) -> float:
        """Return the share of the points that is taken."""
        return min(days * _part(self.per_day), _part(self.at_most), 1.0)

    def found(self, days: int) -> Diagnostic:
        """Return what a student is told."""
        return HANDED_IN_LATE(days=days, share=self.share(days)) if days else HANDED_IN_ON_TIME()

    # As the measure of a test that gives no points.

    def assess(self, checked: Checked, reference: Checked | None) -> Outcome:
        return Outcome(1.0, self.found(0), None)

    def flaws(self, ground: Ground) -> Iterator[Diagnostic]:
        yield from ()


def _part(text: str) -> float:
    return float(text.strip().rstrip("%").replace(",", ".")) / 100
