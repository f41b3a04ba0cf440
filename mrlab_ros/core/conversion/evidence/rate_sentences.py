"""Rates that a sentence states, in any language: a number, a unit, and what is counted a time.

"250 Hz", "20 samples per second", "toutes les 50 ms", "Abtastzeit: 4 ms". The order of numbers,
units and the few words for each and per is read; the other words only say how sure it is.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from functools import lru_cache

from mrlab_ros.core.conversion.evidence import units
from mrlab_ros.core.conversion.evidence.glossary import FOREIGN, PROSE, Class
from mrlab_ros.core.conversion.evidence.names import Word, spelled, words, words_in

TOKEN = re.compile(r"\d+(?:[.,]\d+)?(?:e-?\d+)?|毫秒|微秒|秒|赫兹|每|[^\W\d_]+|[/%°]")
CLAUSE = re.compile(r"[\n;()\[\]]+|[.,](?!\d)")
EVERY = words(
    "every each alle je jede jeder jedem jedes toutes tous chaque cada ogni todos todas elke 每"
)
# between what is counted and a time, or a time and what is counted
PER = EVERY | words("/ per pro par por al alla au a in")
# a rate beside such words is that of a filter
PROCESSED = ("filt", "gefilt", "smooth", "liss", "suav", "glaett", "geglaett", "lowpass")
ARTICLES = words("der la el the un una ein")
TIMES_OVER = words("times mal fois veces volte vezes")
IMAGES = words("fps frames bilder bildern images imagenes immagini imagens")
COUNTED = (Class.SAMPLING, Class.PLACE, Class.KEPT)
STEPS = (Class.PERIOD, Class.SAMPLING)
NEAR = 4  # words between a name of a step and its number
LEAST, MOST = 0.1, 10_000.0  # Hz


@dataclass(frozen=True)
class Stated:
    """A rate, Hz. sure: no word of its sentence speaks of other data or was not understood."""

    rate: float
    sure: bool


@lru_cache(maxsize=4096)
def rate_in(text: str) -> Stated | None:
    """Return the rate that a text states, None where it states none, or several."""
    found_in = (TOKEN.findall(spelled(c.replace("1/s", " hz"))) for c in CLAUSE.split(text))
    clauses = [[token for token in c if token not in ARTICLES] for c in found_in]
    ours = [c for c in clauses if not any(t in FOREIGN or t.startswith(PROCESSED) for t in c)]
    found = {rate for clause in ours for rate in _rates(clause) if LEAST <= rate <= MOST}
    if len(found) != 1:
        return None
    spoken = [token for clause in ours for token in clause]
    alone = sum(token[0].isdecimal() for token in spoken) == 1  # 1 of 10 samples at 500 Hz
    sure = alone and len(ours) == len(clauses) and not any(map(_is_unread, set(spoken)))
    return Stated(found.pop(), sure)


def _is_unread(token: str) -> bool:
    """Say whether a word of a sentence is not understood; images are those of a camera."""
    if token in IMAGES:
        return True
    if token[0].isdecimal() or token in PER or token in PROSE or units.parse(token):
        return False
    return any(w.unread or w.quantity for w in _words(token))


def _words(token: str) -> tuple[Word, ...]:
    return words_in(token) if token[0].isalpha() else ()


def _can_be(token: str, *kinds: Class) -> bool:
    return len(token) > 1 and any(w.can_be(*kinds) for w in _words(token))


def _unit(tokens: list[str], place: int, quantity: str) -> units.Unit | None:
    unit = units.parse(tokens[place]) if 0 <= place < len(tokens) else None
    return unit if unit is not None and unit.quantity == quantity else None


def _rates(tokens: list[str]) -> Iterator[float]:
    """Yield the rates of one clause."""
    for i, token in enumerate(tokens):
        if not token[0].isdecimal() or not (number := float(token.replace(",", "."))):
            continue
        before, after = tokens[max(0, i - NEAR) : i], tokens[i + 1 : i + 6]
        before = before[
            max((k + 1 for k, t in enumerate(before) if t[0].isdecimal()), default=0) :
        ]
        if unit := _unit(tokens, i + 1, "rates"):
            yield number * unit.factor
        elif unit := _unit(tokens, i + 1, units.TIMES):
            of_each = after[1:2] and after[1] in PER and _can_be(" ".join(after[2:3]), *COUNTED)
            every = any(t in EVERY for t in before[-2:])
            if of_each or every or any(_can_be(t, *STEPS) for t in before):
                yield 1 / (number * unit.factor)
        elif unit := _counted(after) or _of_each(before):
            yield number / unit.factor
        elif before and _can_be(before[-1], Class.RATE) and not (after and units.parse(after[0])):
            yield number


def _counted(after: list[str]) -> units.Unit | None:
    """Return the time in `samples per second`, the words behind a number; None: no such words."""
    for k, token in enumerate(after[:-1]):
        unit = _unit(after, k + 1, units.TIMES)
        if token in PER and unit is not None:
            return unit if not k or any(_is_counted(t) for t in after[:k]) else None
        if units.parse(token) or token[0].isdecimal():
            return None
    return None


def _is_counted(token: str) -> bool:
    return token in TIMES_OVER or _can_be(token, *COUNTED)


def _of_each(before: list[str]) -> units.Unit | None:
    """Return the time in `per second:`, the words before a number; None: no such words."""
    return (
        _unit(before, len(before) - 1, units.TIMES)
        if before[-2:-1] and before[-2] in PER
        else None
    )
