"""Texts with typed values: parse a template once, fill it in for a reader.

A template is a text with placeholders `{name}` or `{name:quantity}`. The quantity says in which
unit the value is stored and how it is shown, the same in terminal, page, room and report:

    {name}                     text of a person or a file, as it is
    {value:angle}              rad, shown as 12.4°          {value:turn_rate}  rad/s, 180.0°/s
    {value:fine_angle}         rad, shown as 0.03°
    {value:length}             m, shown as 135 mm, 1.25 m   {value:speed}      m/s
    {value:time}               s, shown as 2.00 s           {value:rate}       Hz
    {value:duration}           s, from 100 s on shown as 2:05.3 min or 1:02:05 h
    {value:mass} {value:force} kg, N                        {value:moment}     N*m
    {value:share}              0 to 1, shown as 63%         {value:number}     four digits
    {value:bytes}              B, shown as kB, MB or GB     {value:integer}
    {value:exact}              a number with all its digits, such as a limit that was declared
    {value:measure}            in the unit that the value `unit` names, a key of UNITS
    {point:position}           (x, y, z) in m; (x, y) too
    {count:count frame|frames} 1 frame, 3 frames
    {rows:rows}                (first, last) from 1: row 7, rows 7 to 9
    {names:list}               a, b and c                   {names:either}     a, b or c
    {events:list play=start}   the same, with words of its own for those that are known
    {side:choice above=over|below=under}                    the text of one of the known words;
                               another, and one without a text, is said as it is
    {state:state}              a state of the lab by its name, such as PLAYING
    {why:problem}              another diagnostic, or what a library said; its remedy follows
                               the sentence
    {all:problems}             several of them, a line each, with their remedies
    {all:reasons}              several of them in one sentence, parted by semicolons

`[text {name} text]` is left out where one of its values is missing: None, "" or an empty list.
`{{`, `}}`, `[[` and `]]` are the signs themselves. `web/src/words/phrase.ts` reads the same
templates for other languages; `test/unit/core/base/phrases.json` holds both to one result.
"""

from __future__ import annotations

import functools
import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from decimal import ROUND_HALF_UP, Context, Decimal
from math import degrees, isfinite
from typing import Any, TypeAlias

from mrlab_ros.core.base.foreign_text import visible, visible_lines

# A text, a number in the unit of its quantity, several of these, or a
# diagnostic with values of its own.
Value: TypeAlias = Any

TOKEN = re.compile(r"\{\{|\}\}|\[\[|\]\]|\{(?P<name>[a-z_]+)(?::(?P<spec>[^{}]+))?\}|[\[\]]")


@dataclass(frozen=True)
class Placeholder:
    """A value in a text. quantity: a key of QUANTITIES; words: what follows it, parted by |."""

    name: str
    quantity: str
    words: tuple[str, ...] = ()


@dataclass(frozen=True)
class Phrase:
    """A parsed template: texts, placeholders, and parts that may be left out."""

    parts: tuple[str | Placeholder | Phrase, ...]

    def placeholders(self, optional: bool = True) -> Iterator[Placeholder]:
        """Yield the placeholders; optional: also those of parts that may be left out."""
        for part in self.parts:
            if isinstance(part, Placeholder):
                yield part
            elif isinstance(part, Phrase) and optional:
                yield from part.placeholders()

    def fill(self, values: Mapping[str, Value]) -> str:
        """Return the English text with these values."""
        return "".join(self._filled(values))

    def _filled(self, values: Mapping[str, Value]) -> Iterator[str]:
        for part in self.parts:
            if isinstance(part, str):
                yield part
            elif isinstance(part, Placeholder):
                yield shown(part, values)
            elif not any(_missing(values.get(p.name)) for p in part.placeholders(False)):
                yield part.fill(values)


@functools.cache
def phrase(template: str) -> Phrase:
    """Return the parsed template; raise ValueError where it is none."""
    stack: list[list[str | Placeholder | Phrase]] = [[]]
    end = 0
    for found in TOKEN.finditer(template):
        if found.start() > end:
            stack[-1].append(template[end : found.start()])
        end = found.end()
        sign = found[0]
        if found["name"]:
            quantity, _, words = (found["spec"] or "text").partition(" ")
            if quantity not in QUANTITIES:
                raise ValueError(f"{template!r}: there is no quantity {quantity!r}")
            listed = tuple(words.split("|")) if words else ()
            stack[-1].append(Placeholder(found["name"], quantity, listed))
        elif sign == "[":
            stack.append([])
        elif sign == "]":
            if len(stack) == 1:
                raise ValueError(f"{template!r}: ] without [")
            inner = Phrase(tuple(stack.pop()))
            stack[-1].append(inner)
        else:
            stack[-1].append(sign[0])
    if len(stack) > 1:
        raise ValueError(f"{template!r}: [ without ]")
    stack[0].append(template[end:])
    return Phrase(tuple(part for part in stack[0] if part != ""))


def _missing(value: Value) -> bool:
    return value is None or (isinstance(value, str | Sequence) and not value)


def shown(part: Placeholder, values: Mapping[str, Value]) -> str:
    """Return a value as an English text."""
    value = values[part.name]
    quantity = part.quantity
    if quantity == "measure":
        quantity = UNITS[str(values.get("unit") or "")]
    return QUANTITIES[quantity](value, part.words)


# Halves are rounded away from zero in decimal, as Intl.NumberFormat rounds: 0.145 s is 0.15 s.
_HALF_UP = Context(prec=400, rounding=ROUND_HALF_UP)


def _digits(value: float, digits: int, unit: str) -> str:
    if not isfinite(value):
        return f"{value:g}{unit}"
    rounded = Decimal(repr(float(value))).quantize(Decimal((0, (1,), -digits)), context=_HALF_UP)
    return f"{rounded if rounded else abs(rounded):f}{unit}"


def _significant(value: float, digits: int, unit: str) -> str:
    if isfinite(value):
        context = Context(prec=digits, rounding=ROUND_HALF_UP)
        value = float(context.create_decimal(repr(float(value))))
    text = f"{value:.{digits}g}"
    return (f"{float(text):.0f}" if "e+" in text and abs(value) < 1e15 else text) + unit


def _length(value: float, words: Sequence[str]) -> str:
    if abs(value) >= 1:
        return _digits(value, 2, " m")
    return _digits(value * 1e3, 0 if abs(value) >= 0.01 else 1, " mm")


def _duration(value: float, words: Sequence[str]) -> str:
    if value < 99.995:
        return _digits(value, 2, " s")
    tenths = int(value * 10 + 0.5)
    if tenths < 36_000:
        return f"{tenths // 600}:{tenths % 600 / 10:04.1f} min"
    whole = int(value + 0.5)
    return f"{whole // 3600}:{whole // 60 % 60:02d}:{whole % 60:02d} h"


def _bytes(value: float, words: Sequence[str]) -> str:
    for scale, unit in ((1e9, "GB"), (1e6, "MB"), (1e3, "kB")):
        if abs(value) >= scale:
            return _significant(value / scale, 3, f" {unit}")
    return _digits(value, 0, " B")


def joined(names: Sequence[object], last: str = "and") -> str:
    """Return `a, b and c`."""
    texts = [
        _significant(name, 10, "") if isinstance(name, float) else visible(str(name))
        for name in names
    ]
    return f" {last} ".join(filter(None, [", ".join(texts[:-1]), texts[-1]])) if texts else ""


def _rows(value: tuple[int, int], words: Sequence[str]) -> str:
    first, last = value
    return f"row {first}" if last <= first else f"rows {first} to {last}"


def _choice(value: str, words: Sequence[str]) -> str:
    known = dict(word.partition("=")[::2] for word in words)
    return known.get(value) or value


def _worded(names: Sequence[object], words: Sequence[str]) -> list[object]:
    known = dict(word.partition("=")[::2] for word in words)
    return [known.get(str(name), name) for name in names]


def _clause(value: Any) -> str:
    """Return what a diagnostic, an error with one, or a library says, for within a sentence."""
    found = getattr(value, "diagnostic", value)
    return visible_lines(getattr(found, "message", None) or str(found)).rstrip(".")


def _position(value: Sequence[float], words: Sequence[str]) -> str:
    return " ".join(
        f"{axis} {_digits(v, 3, '')}" for axis, v in zip("xyz", value, strict=False)
    ) + (" m")


# How each quantity is shown in English; the arguments are the value and the words of its place.
QUANTITIES: dict[str, Callable[[Any, Sequence[str]], str]] = {
    "text": lambda v, w: visible(str(v)),
    "integer": lambda v, w: f"{int(v)}",
    "number": lambda v, w: _significant(v, 4, ""),
    "exact": lambda v, w: _significant(v, 10, ""),
    "angle": lambda v, w: _digits(degrees(v), 1, "°"),
    "fine_angle": lambda v, w: _digits(degrees(v), 2, "°"),
    "turn_rate": lambda v, w: _digits(degrees(v), 1, "°/s"),
    "turn_acceleration": lambda v, w: _digits(degrees(v), 0, "°/s²"),
    "turn_jerk": lambda v, w: _digits(degrees(v), 0, "°/s³"),
    "length": _length,
    "speed": lambda v, w: _digits(v, 2, " m/s"),
    "time": lambda v, w: _digits(v, 2, " s"),
    "duration": _duration,
    "rate": lambda v, w: _significant(v, 4, " Hz"),
    "share": lambda v, w: _digits(round(v * 100, 9), 0, "%"),
    "mass": lambda v, w: _significant(v, 3, " kg"),
    "force": lambda v, w: _significant(v, 3, " N"),
    "moment": lambda v, w: _significant(v, 3, " N*m"),
    "bytes": _bytes,
    "position": _position,
    "count": lambda v, w: " ".join(filter(None, [f"{v}", *([w[v != 1]] if w else [])])),
    "rows": _rows,
    "list": lambda v, w: joined(_worded(v, w)),
    "either": lambda v, w: joined(_worded(v, w), "or"),
    "choice": _choice,
    "problem": lambda v, w: _clause(v),
    "problems": lambda v, w: "".join(f"\n  {visible_lines(str(each))}" for each in v),
    "reasons": lambda v, w: "; ".join(map(_clause, v)),
    "state": lambda v, w: visible(str(v)),
    "measure": lambda v, w: _significant(v, 4, ""),
}
# The quantity of each unit that a value's `unit` may name.
UNITS = {
    "": "number",
    "1": "number",
    "%": "share",
    "rad": "angle",
    "rad/s": "turn_rate",
    "m": "length",
    "m/s": "speed",
    "s": "time",
    "Hz": "rate",
    "kg": "mass",
    "N": "force",
    "N*m": "moment",
    "rad/s^2": "turn_acceleration",
    "rad/s^3": "turn_jerk",
}


def ended(text: str) -> str:
    """Return a text as a sentence that another may follow; a list's line has no full stop."""
    return text if not text or text.endswith((".", ":", "!", "?")) else f"{text}."
