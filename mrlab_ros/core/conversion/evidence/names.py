"""What a name says about the numbers under it: names of variables, headings, labels.

A name is cut into words, and the words of the glossary explain it or leave some unread. A name
that is explained as joint positions as a whole is taken in silence; unread words beside joint
positions are said, and asked about where the numbers speak against them.
"""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Iterator
from dataclasses import dataclass, replace
from enum import Enum
from functools import cache, lru_cache

from mrlab_ros.core.base.diagnostic import Diagnostic
from mrlab_ros.core.conversion.diagnostics import NAME_SAYS
from mrlab_ros.core.conversion.evidence import units
from mrlab_ros.core.conversion.evidence.glossary import (
    AFTER_SYMBOL,
    BEFORE_SYMBOL,
    CLASSES,
    NUMBERED,
    ONE_MEANING,
    QUANTITIES,
    ROBOTS,
    ROLE_LETTERS,
    TWO_MEANINGS,
    Class,
)


class Hint(Enum):
    """What a name says of joint positions.

    POSITIONS: joint positions, all of it explained. PARTLY: joint positions beside unread words.
    TWO_FACED: joints or the tool. NEUTRAL: nothing. DOUBTFUL: two quantities. AGAINST: another.
    """

    POSITIONS = "positions"
    PARTLY = "partly"
    NEUTRAL = "neutral"
    TWO_FACED = "two_faced"
    DOUBTFUL = "doubtful"
    AGAINST = "against"

    @property
    def of_joints(self) -> bool:
        return self in (Hint.POSITIONS, Hint.PARTLY)

    @property
    def against(self) -> bool:
        return self in (Hint.DOUBTFUL, Hint.AGAINST)


@dataclass(frozen=True)
class Name:
    """What a name says.

    what: the quantity it names, or empty. unit: that of angles which it states. unread: its words
    that no glossary explains. motor: it says that the numbers are those of motors.
    """

    hint: Hint
    what: str = ""
    unit: units.Unit | None = None
    unread: tuple[str, ...] = ()
    motor: bool = False

    @property
    def why(self) -> Diagnostic:
        """Return what is said of the hint, with the quantity where the name says one."""
        unread = [f"'{word}'" for word in self.unread]
        if self.hint is Hint.AGAINST and self.what:
            return NAME_SAYS(quantity=self.what)
        if self.hint is Hint.DOUBTFUL and self.what:
            return NAME_SAYS(often=self.what)
        return NAME_SAYS(hint=self.hint.value, unread=unread)


# what joints have beside positions: a struct of that name holds no positions
OF_JOINTS = ("velocities", "accelerations", "torques", "currents", "errors")
HARMLESS = frozenset((Class.ROLE, Class.KEPT, Class.ABOUT, Class.ARM, Class.SIDE, Class.UNIT_FLAG))
SUBSCRIPTS = re.compile(r"([({])[\d,]+([)}])")
# fields that only say "the values are in here"
CONTAINER_TAIL = re.compile(
    r"(\.(signals|values|data|Data|Values|Value|q_?data)(\(\d+\))?)+(\([\d:, end]+\))?$"
)
# q_punkt and q_p are how German lectures write a derivative; q_2p is the second one
DOTTED = re.compile(r"(q|th|theta|phi|gelenk|winkel)(?P<two>2|zwei|doppel)?(punkt|p|pkt)$")
SPELLED = str.maketrans(
    {"ä": "ae", "ö": "oe", "ü": "ue", "ß": "ss", "\u0131": "i", "ł": "l", "ø": "o", "θ": " theta ",
     "ϑ": " theta ", "φ": " phi ", "ϕ": " phi ", "ω": " omega ", "τ": " tau ", "δ": " delta ",
     "π": " pi ", "\u03b1": " alpha ", "°": " deg ", "º": " deg ", "µ": "u", "%": " percent "}
)  # fmt: skip
UNIT_BEHIND = re.compile(r"(.+(?: |\d_))([^ _]+)")
CJK = re.compile(r"[\u3040-\u30ff\u3400-\u9fff\uac00-\ud7af]")
FRONT = ("qdd", "ddq", "qd", "dq", "q", "th")
GLUE = ("", "s", "es", "n", "en", "e")
LEAST_PART = 3
# two readings: a function before a symbol and a recording behind it, a motor's current or the
# present positions behind one
FUNCTIONS, ALSO_CURRENTS = ("log", "exp"), "current"


def words(text: str) -> frozenset[str]:
    """Return the words of a text, in lower case."""
    return frozenset(text.lower().split())


@cache
def vocabulary() -> dict[str, tuple[frozenset[Class], str]]:
    """Return for each word its classes, and the other quantity that it names, or empty."""
    classes: dict[str, set[Class]] = {}
    quantity: dict[str, str] = {}
    for kind, text in CLASSES.items():
        for word in text.split():
            classes.setdefault(spelled(word), set()).add(kind)
    for what, text in QUANTITIES.items():
        for word in text.split():
            classes.setdefault(spelled(word), set()).add(Class.OTHER)
            quantity.setdefault(spelled(word), what)
    for word in " ".join(ROBOTS.values()).split():
        classes.setdefault(word, set()).add(Class.ARM)
    return {word: (frozenset(kinds), quantity.get(word, "")) for word, kinds in classes.items()}


def spelled(text: str) -> str:
    """Return a text in small letters, without accents, with umlauts and Greek spelled out."""
    lower = unicodedata.normalize("NFC", text.lower()).translate(SPELLED)
    if lower.isascii():
        return lower
    bare = "".join(c for c in unicodedata.normalize("NFD", lower) if not unicodedata.combining(c))
    return unicodedata.normalize("NFC", bare)


@dataclass(frozen=True)
class Word:
    """A word of a name with its classes; none: it is unread. quantity: another one, or empty."""

    text: str
    classes: frozenset[Class] = frozenset()
    quantity: str = ""
    unit: units.Unit | None = None

    @property
    def unread(self) -> bool:
        return not (self.classes or self.unit)

    def can_be(self, *kinds: Class) -> bool:
        return not self.classes.isdisjoint(kinds)


@lru_cache(maxsize=8192)
def word_of(text: str) -> Word:
    """Return what a word says: by itself, as a unit, or as a compound of known words."""
    found = vocabulary().get(text)
    unit = units.parse(text) if len(text) > 1 else None
    unit = unit if unit is not None and unit.quantity not in (units.TIMES, "none") else None
    if found is not None:
        return Word(text, *found, unit if unit is not None and unit.is_angle else None)
    if unit is not None:
        other = "" if unit.is_angle or unit.quantity == "shares" else unit.quantity
        other = "poses" if unit.quantity == units.LENGTHS else other
        if unit.quantity not in ("shares", "rates"):
            kinds = frozenset((Class.OTHER,)) if other else frozenset()
            return Word(text, kinds, other, unit if unit.is_angle else None)
    return Word(text)


@lru_cache(maxsize=8192)
def words_in(text: str) -> tuple[Word, ...]:
    """Return a word, or the known words that cover all of it: gelenkwinkel is gelenk, winkel."""
    whole = word_of(text)
    if not whole.unread:
        return (whole,)
    covered = next(_covers(text, 0), None)
    return (whole,) if covered is None else tuple(map(word_of, covered))


def _covers(text: str, depth: int) -> Iterator[list[str]]:
    """Yield the ways in which known words cover all of a text, the longest words first."""
    if not text:
        yield []
        return
    least = 1 if CJK.match(text) else LEAST_PART
    known = vocabulary()
    for length in range(len(text), 0, -1):
        part = text[:length]
        if part not in known or (length < least and not (depth == 0 and part in FRONT)):
            continue
        if depth == 0 and part in FRONT and length == len(text):
            continue
        for glue in GLUE:
            if not text[length:].startswith(glue) or (glue and depth > 4):
                continue
            rest = text[length + len(glue) :]
            if glue and not rest:
                continue
            yield from ([part, *more] for more in _covers(rest, depth + 1))


def leaf(path: str) -> str:
    """Return the name that speaks for `path`: `out.q` of `out.q.signals(1).values`."""
    inner = CONTAINER_TAIL.sub("", path)
    return re.split(r"[.{(]", inner if inner else path)[-1] if "." in inner else inner


def parts(name: str) -> list[str]:
    """Return the lower-case words of a name: joint_Angles2 is joint, angles, 2."""
    spaced = re.sub(r"(?<=[a-zäöüß])(?=[A-ZÄÖÜ])", "_", name.replace("kHz", "Khz"))
    spaced = re.sub(r"(?<=[A-Z])(?=[A-Z][a-z]{2})", "_", spaced)
    # names of models keep their digits: ur5e
    spaced = re.sub(r"(?<=[A-Za-z]{2})(?=\d)(?!\d+e(?![a-z0-9]))", "_", spaced)
    return [p for p in re.split(r"[\W_]+", spelled(spaced)) if p]


def without_numbers(path: str) -> str:
    """Return a path with 1 for every subscript: all elements of an array are named alike."""
    return SUBSCRIPTS.sub(r"\g<1>1\2", path)


def described(text: str) -> list[Word]:
    """Return the words of a text that is no path."""
    return [word for p in parts(text) if not p.isdigit() for word in words_in(_bare(p))]


def _bare(part: str) -> str:
    """Return a word without the digits behind it, unless it is a letter or a known word."""
    known = len(part) == 1 or part in vocabulary()
    return part if known else part.rstrip("0123456789") or part


def describe(path: str) -> Name:
    """Return what the name of the variable at `path` says.

    Of a series such as q1..q6, or a list, the first name speaks.
    """
    return _describe(without_numbers(path))


def hint(path: str) -> Hint:
    """Return what the name of the variable at `path` says of joint positions."""
    return describe(path).hint


@lru_cache(maxsize=4096)
def _describe(path: str) -> Name:
    first = re.split(r"\.\.|,(?![^(]*\))", path)[0].strip("[] ")
    series = first != path
    bracketed = units.in_brackets(first) if not first.endswith("}") else None
    if bracketed is not None and bracketed.quantity in ("none", "shares", units.TIMES):
        bracketed = None
    if bracketed is not None and not (bracketed.is_angle or series or "[" in first):
        bracketed = None
    name = re.sub(r"[({][^.]*$", "", leaf(first))
    said = parts(name)
    if bracketed is not None and not bracketed.is_angle:
        return Name(Hint.AGAINST, _quantity(bracketed))
    of_unit = _said_by_last(said)
    if of_unit:
        return Name(Hint.AGAINST, of_unit)
    found = replace(_said_by(said, series=series))
    if bracketed is not None:
        found = replace(found, unit=bracketed)
    if found.hint.of_joints:
        of_struct = _said_by_struct(first)
        if of_struct is not None and of_struct.what in OF_JOINTS:
            return Name(Hint.DOUBTFUL, of_struct.what)
    if found.what == "states" and first.startswith("observation."):
        return Name(Hint.TWO_FACED)  # the joints, measured, where a robot learns
    if found.hint in (Hint.NEUTRAL, Hint.TWO_FACED):
        of_struct = _said_by_struct(first)
        if of_struct is not None:
            unread = found.unread if of_struct.hint.of_joints else ()
            hint = Hint.PARTLY if unread and of_struct.hint.of_joints else of_struct.hint
            return Name(hint, of_struct.what, found.unit, unread)
    return found


def _quantity(unit: units.Unit) -> str:
    return "poses" if unit.quantity == units.LENGTHS else unit.quantity


def _said_by_last(said: list[str]) -> str:
    """Return the quantity of a quotient or product that a name ends in, such as rad_s, or none."""
    rest = [p for p in said if p != "per"]
    for count in (3, 2):
        ending = rest[-count:]
        if len(rest) <= count or len(ending) < count:
            continue
        texts = {"/".join(ending), "*".join(ending), "/".join(ending[:2]) + "".join(ending[2:])}
        for text in texts:
            unit = units.parse(text)
            if unit is not None and ending[0] != "q" and unit.quantity in (*OF_JOINTS, "jerks"):
                return unit.quantity
    if len(rest) > 1 and rest[-1] in ("rads", "degs"):
        return "velocities"
    return ""


def _said_by_struct(path: str) -> Name | None:
    """Return what the struct says that a field such as pos or data lies in, or None.

    joints.pos are joint positions and tcp.pos is none. A letter alone says nothing.
    """
    outer = CONTAINER_TAIL.sub("", path).rpartition(".")[0]
    name = re.split(r"[.]", re.sub(r"[({][^.]*$", "", outer))[-1]
    if len(name) < 2 or name == path:
        return None
    said = describe(name)
    return said if said.hint.of_joints or said.hint is Hint.AGAINST else None


def _said_by(said: list[str], *, series: bool) -> Name:
    """Return what the words of a name say together; series: it is one of q1, q2 and so on."""
    whole = "".join(said)
    bare = whole.rstrip("0123456789") or whole
    if series and bare in NUMBERED.split():
        return Name(Hint.POSITIONS)
    if bare in TWO_MEANINGS and len(said) == 1:
        return Name(Hint.DOUBTFUL, TWO_MEANINGS[bare])
    if said[:1] == ["qd"]:
        return Name(Hint.DOUBTFUL, "joint_velocities")
    if len(bare) == 1 and bare != whole and bare in ONE_MEANING["parameters"].split():
        return Name(Hint.NEUTRAL)
    of_whole = next((w for w, names in ONE_MEANING.items() if bare in names.split()), "")
    if of_whole and (bare == whole or of_whole != "times"):
        return Name(Hint.AGAINST, of_whole)
    dotted = DOTTED.match(bare)
    if dotted is not None:
        return Name(Hint.AGAINST, "accelerations" if dotted["two"] else "velocities")
    if said[:1] == ["i"] and len(said) > 1:
        return Name(Hint.AGAINST, "currents")
    if len(said) == 2 and said[1] == "d" and word_of(said[0]).can_be(Class.SYMBOL):
        return Name(Hint.DOUBTFUL, "joint_velocities")  # or desired
    if bare in vocabulary():
        said = [bare]
    found = [word for p in said if not p.isdigit() for word in words_in(_bare(p))]
    if of_letter := _said_by_letter([w.text for w in found]):
        # q_v2 may be the second version
        return Name(Hint.DOUBTFUL if said[-1][-1].isdigit() else Hint.AGAINST, of_letter)
    return _said_by_words(found)


def _said_by_letter(said: list[str]) -> str:
    """Return the quantity that a letter beside a joint's symbol says: v_q, e_theta, q_v."""
    if len(said) != 2:
        return ""
    first, last = said
    if word_of(last).can_be(Class.SYMBOL, Class.JOINT, Class.ANGLE) and first in BEFORE_SYMBOL:
        return BEFORE_SYMBOL[first]
    named = word_of(first).can_be(Class.SYMBOL) or (
        word_of(first).can_be(Class.JOINT) and last == "v"
    )
    return AFTER_SYMBOL.get(last, "") if named else ""


def _said_by_words(found: list[Word]) -> Name:
    symbol = any(w.can_be(Class.SYMBOL, Class.CONFIGURATION) for w in found)
    jointed = symbol or any(w.can_be(Class.JOINT) for w in found)
    angled = any(w.can_be(Class.ANGLE) for w in found)
    unit = next((w.unit for w in found if w.unit is not None), None)
    motor = any(w.can_be(Class.MOTOR) for w in found)
    of_current = found[-1:] and found[-1].text == "current" and len(found) > 1 and not symbol
    if of_current:
        # motor currents end in it, the present positions begin with it
        return Name(Hint.AGAINST, "currents")
    other = next((w.quantity for w in found if w.quantity and not _is_role(w, jointed)), "")
    if other == "errors" and not jointed and not angled and len(found) > 1:
        other = "errors"
    if other:
        return Name(Hint.AGAINST, other)
    unread = tuple(w.text for w in found if _is_unread(w, symbol))
    if symbol and len(found) > 1:
        unread += tuple(w.text for w in found[:1] if w.text in FUNCTIONS)
        unread += tuple(w.text for w in found[-1:] if w.text == ALSO_CURRENTS)
    if symbol and found[-1].text == "rev" and len(found) > 1:
        return Name(Hint.DOUBTFUL, "turns_or_reversed")
    if jointed or angled:
        return Name(Hint.PARTLY if unread else Hint.POSITIONS, "", unit, unread, motor)
    if any(w.can_be(Class.PLACE, Class.MOTION) for w in found):
        return Name(Hint.TWO_FACED, "", unit, unread, motor)
    return Name(Hint.NEUTRAL, "", unit, unread, motor)


def _is_role(word: Word, jointed: bool) -> bool:
    """Say whether a word that may be another quantity is a role here: commanded, present."""
    return jointed and word.can_be(Class.ROLE) and word.text in ("current", "set", "enc")


def _is_unread(word: Word, symbol: bool) -> bool:
    if word.unit is not None or word.text.isdigit():
        return False
    if symbol and len(word.text) == 1 and word.text in ROLE_LETTERS.split():
        return False
    known = (
        *HARMLESS, Class.SYMBOL, Class.JOINT, Class.ANGLE, Class.CONFIGURATION, Class.PLACE,
        Class.MOTION, Class.SAMPLING, Class.MOTOR,
    )  # fmt: skip
    return not word.can_be(*known)


def without_units(name: str) -> tuple[str, units.Unit | None]:
    """Return a name without the unit of angles behind it, and that unit: q1 deg, q1_deg."""
    match = UNIT_BEHIND.fullmatch(name.strip())
    before, last = match.groups() if match else (name, "")
    unit = units.parse(last) if before and len(last) > 1 else None
    return (before.rstrip(" _"), unit) if unit and unit.is_angle else (name.strip(), None)
