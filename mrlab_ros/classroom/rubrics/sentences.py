"""Sentences of a rubric: forms with gaps, and what stands in the gaps.

A form is `grasps OBJECT [by ROBOT] between FROM and TO`: words in capitals are gaps, what is in
brackets may be left out, `<` and `>` stand for themselves and for their words.
"""

from __future__ import annotations

import difflib
import re
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

from mrlab_ros.classroom.rubrics.diagnostics import (
    NEGATIVE,
    NOT_A_PLACE,
    TIMES_SWAPPED,
    UNKNOWN_SENTENCE,
)
from mrlab_ros.classroom.rubrics.rubric import (
    ANGLE,
    DISTANCE,
    LENGTH,
    NUMBER,
    SHARE,
    SPEED,
    TIME,
    WRITTEN,
    Measure,
    Quantity,
)
from mrlab_ros.core.base.diagnostic import Fix
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.base.geometry import Pose, Vector

NAME = r"[A-Za-z][\w-]*"
PLACE = r"\[[^\]]*\]"
LESS = r"(?:<=?|≤|below|under|less than|at most|shorter than|up to)"
MORE = r"(?:>=?|≥|above|over|more than|at least|greater than)"
# Gaps: what may stand there, and the quantity that it is; None: a name or a place.
GAPS: dict[str, tuple[str, Quantity | None]] = {
    "OBJECT": (NAME, None),
    "THING": (NAME, None),
    "ROBOT": (NAME, None),
    "OTHER": (NAME, None),
    "PLACE": (PLACE, None),
    "LENGTH": (WRITTEN, LENGTH),
    "WAY": (WRITTEN, DISTANCE),
    "ANGLE": (WRITTEN, ANGLE),
    "TIME": (WRITTEN, TIME),
    "FROM": (WRITTEN, TIME),
    "TO": (WRITTEN, TIME),
    "SPEED": (WRITTEN, SPEED),
    "SHARE": (WRITTEN, SHARE),
    "NUMBER": (WRITTEN, NUMBER),
}
_TOKEN = re.compile(r"\[|\]|[<>]|[A-Z]+|[^\s\[\]<>]+")
Gaps = Mapping[str, Any]


@dataclass(frozen=True)
class Given:
    """Options of a test beside its sentence. each: every pose earns its part of the points; until:
    where no part of them is left, SI."""

    poses: tuple[Pose | Vector, ...] = ()
    each: bool = False
    until: float | None = None


@dataclass(frozen=True)
class Form:
    """One form of a sentence. build: makes the measure from what stands in the gaps, by their
    names in lower case, None where a gap is left out. about: one line for the documentation.

    until: the quantity of `partial: until ...`, None where there is none. poses: whether the test
    lists poses; each: whether `partial: each` is known.
    """

    text: str
    build: Callable[[Gaps, Given], Measure]
    about: str
    until: Quantity | None = None
    poses: bool = False
    each: bool = False

    @property
    def rules(self) -> tuple[str, ...]:
        """Return the rules by which a part of the points may be given, such as 'until 4 s'."""
        each = ("each",) if self.each else ()
        return (*each, f"until {self.until.example}") if self.until else each

    @cached_property
    def pattern(self) -> re.Pattern[str]:
        """Return the pattern of the sentences; spaces are single, the case does not matter."""
        parts: list[str] = []
        optional = 0
        for token in _TOKEN.findall(self.text):
            if token == "[":
                parts.append("(?:")
                optional += 1
            elif token == "]":
                parts.append(")?")
                optional -= 1
            elif token in "<>":
                parts.append(rf"\s?{LESS if token == '<' else MORE}\s?")
            else:
                before = "" if not parts or parts[-1].endswith(r"\s?") else r"\s"
                gap = GAPS.get(token)
                found = f"(?P<{token.lower()}>{gap[0]})" if gap else re.escape(token)
                parts.append((before if token != "," else "") + found)
        return re.compile("".join(parts), re.IGNORECASE)

    def read(self, sentence: str) -> dict[str, Any] | None:
        """Return what stands in the gaps; None: the sentence has another form. Raises BadInput
        where a quantity is none of its kind."""
        match = self.pattern.fullmatch(sentence)
        if match is None:
            return None
        gaps: dict[str, Any] = {}
        for name, text in match.groupdict().items():
            quantity = GAPS[name.upper()][1]
            if text is None or quantity is None:
                gaps[name] = text if text is None or not text.startswith("[") else _place(text)
                continue
            unit = ""
            if name == "from" and match.groupdict().get("to"):
                # "between 2 and 4 s"
                unit = re.sub(r"^[-+\d.,]*(e[-+]?\d+)?\s?", "", match["to"])
            value = quantity.read(text.lower(), unit.lower())
            if value < 0 and quantity is not NUMBER:
                raise BadInput(NEGATIVE(text=text, expected=quantity.expected))
            gaps[name] = value
        first, last = gaps.get("from"), gaps.get("to")
        if first is not None and last is not None and first >= last:
            raise BadInput(TIMES_SWAPPED(first=first, last=last))
        return gaps


def _place(text: str) -> tuple[float, ...]:
    """Return the place of '[x, y]' or '[x, y, z]', m in world."""
    try:
        numbers = tuple(float(part) for part in text.strip("[]").replace(",", " ").split())
    except ValueError:
        numbers = ()
    if len(numbers) not in (2, 3) or not all(abs(v) <= 100 for v in numbers):
        raise BadInput(NOT_A_PLACE(text=text))
    return numbers


def form_of(sentence: str, forms: Iterable[Form]) -> tuple[Form, dict[str, Any]]:
    """Return the form of a sentence and what stands in its gaps; raise BadInput."""
    plain = " ".join(sentence.split())
    known = list(forms)
    for form in known:
        gaps = form.read(plain)
        if gaps is not None:
            return form, gaps
    bones = [_bones(form.text) for form in known]
    wanted = _bones(plain)
    ranked = sorted(
        range(len(known)),
        key=lambda i: difflib.SequenceMatcher(None, wanted, bones[i]).ratio(),
        reverse=True,
    )
    fixes = (Fix(command="mrlab rubric measures"),)
    close = [known[i].text for i in ranked[:2]]
    raise BadInput(UNKNOWN_SENTENCE(text=plain, close=close, fixes=fixes))


def _bones(text: str) -> str:
    """Return the words of a sentence without quantities, brackets and capitals."""
    without = re.sub(rf"{WRITTEN}|\[[^\]]*\d[^\]]*\]|\[|\]|\b[A-Z]+\b|\b\w+_\w*\b", " ", text)
    return " ".join(re.sub(LESS, "<", re.sub(MORE, ">", without.lower())).split())
