"""What a file states of a matrix, the nearest first: its unit, its robot, gears of motors."""

from __future__ import annotations

import itertools
import re
from collections.abc import Collection, Iterator
from dataclasses import dataclass

import numpy as np

from mrlab_ros.core.conversion.evidence import units
from mrlab_ros.core.conversion.evidence.glossary import ROBOTS, Class
from mrlab_ros.core.conversion.evidence.names import Word, described, leaf, spelled, words_in
from mrlab_ros.core.conversion.evidence.units import ANGLES, TIMES, Unit
from mrlab_ros.core.conversion.workspace import COMMENT, Variable, Workspace, outer
from mrlab_ros.core.robots.model import RobotModel

ELEMENT = re.compile(r"[({][^.]*$")
# words of a text: letters with the signs of units inside
TOKEN = re.compile(r"[^\W\d_]+|°(?![cCfF])")
QUOTIENT = re.compile(r"\s*(/|per\b|\*|·|\^|-?[²2]|s\b|pro\b)")
FACTORS = frozenset(
    ("resolution", "aufloesung", "auflösung", "résolution", "resolución", "risoluzione")
)
# a word that may be something else is a unit behind these, at the end
BEHIND = re.compile(r"(?:\b(?:in|en|em)|[:=(])$")
# a unit behind one of these is another one
PREFIXES = ("/", "milli", "micro", "mikro", "centi", "half", "halbe", "tenth", "hundredth")
MODES = ("mode", "modus", "modo", "on", "in")
TRUTHS = {"true": True, "yes": True, "on": True, "ja": True, "si": True, "oui": True,
          "false": False, "no": False, "off": False, "nein": False, "non": False}  # fmt: skip
SPOKEN = frozenset(("rad", "deg", "mrad", "gon", "urad", "turn", "ddeg", "cdeg", "mdeg"))
AMBIGUOUS = frozenset(
    ("grade", "grau", "graus", "du", "giro", "giri", "tour", "tours", "hudu", "turn", "turns",
     "cycles", "quan", "rev", "vuelta", "volta", "tur")
)  # fmt: skip
OURS = (
    Class.UNIT_KEY, Class.SYMBOL, Class.JOINT, Class.ANGLE, Class.CONFIGURATION, Class.PLACE,
    Class.MOTION, Class.ROLE, Class.KEPT, Class.ABOUT, Class.ARM, Class.UNIT_FLAG,
)  # fmt: skip
MOST_TEXTS = 2000
MODEL = re.compile(r"(?=.*\d)(?=.*[^\W\d]).{3,}")


@dataclass(frozen=True)
class Statement:
    """A text or a number beside a matrix. near: 0 is nearest; words: of its name."""

    variable: Variable
    near: int
    words: tuple[Word, ...]

    @property
    def path(self) -> str:
        return self.variable.path

    @property
    def text(self) -> str:
        return self.variable.text.strip()

    def names(self, *kinds: Class) -> bool:
        """Say whether a word of its name is of one of these classes."""
        return any(w.can_be(*kinds) for w in self.words)


@dataclass(frozen=True)
class UnitClaim:
    """A unit that the file states for a matrix. source: where; text: in its own words."""

    unit: Unit
    source: str
    text: str


def nearby(workspace: Workspace, matrix: str) -> list[tuple[int, Variable]]:
    """Return the texts and small numbers that belong to a matrix, each with how near it stands.

    0: an attribute of the matrix. 1: in the same struct. 2: in a struct there that is about the
    rest. 3 and more: the same, farther out.
    """
    small = workspace.small
    found = [(0, v) for v in small.get(matrix, ())]
    place, steps = outer(matrix), 1
    while True:
        found += [(steps, v) for v in small.get(place, ())]
        for struct in workspace.small:
            inside = struct.startswith(f"{place}." if place else "") and struct != place
            own = struct.endswith(f".{matrix}")  # features.q.names is about q
            if inside and struct[-1:] not in ")}" and (own or _is_about(struct[len(place) :])):
                found += [(steps + 1, v) for v in small[struct]]
        if not place:
            return found
        place, steps = outer(place), steps + 2


def _is_about(path: str) -> bool:
    """Say whether the path of a struct says that it is about what stands around it."""
    return any(w.can_be(Class.ABOUT, Class.UNIT_KEY) for w in described(path))


def about(workspace: Workspace, matrix: str) -> list[Statement]:
    """Return the texts and numbers that may be said of a matrix, the nearest first."""
    around = {outer(matrix), *itertools.accumulate(outer(matrix).split("."), "{}.{}".format)}
    found = [
        Statement(v, near, tuple(_words_of(ELEMENT.sub("", v.path), around)))
        for near, v in nearby(workspace, matrix)[:MOST_TEXTS]
        if v.path != matrix
    ]
    found.sort(key=lambda s: s.near)
    return found


def _words_of(path: str, around: Collection[str]) -> list[Word]:
    """Return the words of a name, and those of the structs that are about a matrix.

    around: the structs in which the matrix lies; their names say nothing of it.
    """
    words, struct = described(leaf(path)), outer(path)
    while struct and struct not in around:
        words += [w for w in described(leaf(struct)) if not w.can_be(Class.ABOUT)]
        struct = outer(struct)
    return words


def unit_claims(said: list[Statement], matrix: str) -> list[UnitClaim]:
    """Return the units of angles that the file states for a matrix, the nearest first."""
    claims = [UnitClaim(unit, s.path, text) for s in said for unit, text in _units(s, matrix)]
    return list({claim.unit: claim for claim in reversed(claims)}.values())[::-1]


def unread_units(said: list[Statement], matrix: str) -> list[Statement]:
    """Return the texts that are called a unit of the matrix and spell none of angles."""
    return [
        s
        for s in said
        if s.text
        and s.near <= 2
        and s.names(Class.UNIT_KEY)
        and _is_ours(s, matrix)
        and _is_other(units.parse(s.text))
        and not list(_spoken(s.text))
    ]


def _is_other(unit: Unit | None) -> bool:
    """Say whether a unit is none of joint positions, nor that of the times beside them."""
    return unit is None or unit.quantity not in (ANGLES, TIMES, "rates", "shares", "none")


def _units(s: Statement, matrix: str) -> Iterator[tuple[Unit, str]]:
    if not s.variable.text or s.text.lower() in TRUTHS:
        flagged = _flag(s)
        if flagged is not None and _is_ours(s, matrix):
            yield flagged, s.text or "true"
        return
    keyed = s.names(Class.UNIT_KEY) or all(w.can_be(Class.UNIT_FLAG, Class.ANGLE) for w in s.words)
    if keyed:
        unit = units.parse(s.text)
        if unit is not None and _is_ours(s, matrix):
            if unit.is_angle or (unit.quantity == "shares" and unit.name != ""):
                yield unit, s.text
            return
    if keyed and not _is_ours(s, matrix):
        return
    if (keyed or _tells(s)) and not any(w.quantity for w in s.words):
        spoken = set(_spoken(s.text))
        if len(spoken) == 1:
            yield spoken.pop(), s.text


def _tells(s: Statement) -> bool:
    """Say whether a text may describe the matrix: a comment, or one about what is beside it."""
    if s.variable.kind == COMMENT or s.near == 0 or s.names(Class.ABOUT, *OURS[:7]):
        return True
    unit = units.parse(s.text)
    if unit is not None and unit.name in SPOKEN and units.plain(s.text) not in AMBIGUOUS:
        return True
    return any(w.can_be(*OURS[1:5]) for w in words_of_text(s.text))


def _is_ours(s: Statement, matrix: str) -> bool:
    """Say whether the name of a statement names no other quantity than the matrix does."""
    own = {w.text for w in described(leaf(matrix))}
    return all(
        w.text in own
        or w.text in MODES
        or w.unit is not None
        or (w.can_be(*OURS) and not w.quantity)
        for w in s.words
    )


def _spoken(text: str) -> Iterator[Unit]:
    """Yield the units of angles in a text of several words; not those of quotients."""
    for match in TOKEN.finditer(text):
        word = units.plain(match[0])
        unit = units.parse(word) if len(word) > 2 or word == "°" else None
        before = text[: match.start()].rstrip().lower()
        if unit is None or unit.name not in SPOKEN:
            continue
        ends = BEHIND.search(before) and not text[match.end() :].strip(" .)")
        if word in AMBIGUOUS and not ends:
            continue
        if QUOTIENT.match(text, match.end()):
            continue
        last = before.split()[-3:]
        parts = (units.parse(" ".join((*last[-n:], word))) for n in range(len(last), 0, -1))
        part = next((p for p in parts if p is not None), None)
        if before[-1:].isdigit() and (part is None or FACTORS & {*last}):
            continue  # an angle by itself, or a resolution
        if part is not None or not before.endswith(PREFIXES):
            yield part or unit


def _flag(s: Statement) -> Unit | None:
    """Return the unit of a flag such as is_degrees = true or use_radians = 0."""
    stated = [w.unit for w in s.words if w.unit is not None and w.unit.name in ("deg", "rad")]
    rest = [w for w in s.words if w.unit is None]
    flags = (Class.UNIT_FLAG, Class.ANGLE, Class.UNIT_KEY)
    if len(stated) != 1 or not all(w.can_be(*flags) or w.text in MODES for w in rest):
        return None
    true = _truth(s.variable)
    if true is None:
        return None
    other = units.RADIANS if stated[0].name == "deg" else units.DEGREES
    return stated[0] if true else other


def _truth(v: Variable) -> bool | None:
    if v.text.strip().lower() in TRUTHS:
        return TRUTHS[v.text.strip().lower()]
    if v.values is not None and v.values.size == 1:
        number = float(np.asarray(v.values).reshape(-1)[0])
        return bool(number) if number in (0.0, 1.0) else None
    return None


def number_named(said: list[Statement], *texts: str) -> float | None:
    """Return the first number whose name has all words of one of the texts."""
    for s in said:
        have = {w.text for w in s.words}
        values = s.variable.values
        if values is None or values.size != 1:
            continue
        if any(have >= set(text.split()) for text in texts):
            number = float(np.asarray(values).reshape(-1)[0])
            if np.isfinite(number) and number > 0:
                return number
    return None


def counts_a_turn(said: list[Statement]) -> float | None:
    """Return how many counts make a turn, where the file says so."""
    return number_named(
        said, "counts turn", "counts rev", "cpr", "ppr", "counts umdrehung", "resolution",
        "enc resolution", "counts revolution", "ticks rev", "aufloesung", "inkremente", "inc u",
    )  # fmt: skip


def words_of_text(text: str) -> list[Word]:
    """Return the words of a text of the file, compounds taken apart."""
    return [w for token in TOKEN.findall(text) for w in words_in(spelled(token).strip())]


@dataclass(frozen=True)
class RobotClaim:
    """A robot that a text names. other_maker: it is of another maker than the chosen one."""

    source: str
    text: str
    other_maker: bool


def robot_claims(workspace: Workspace, robot: RobotModel) -> list[RobotClaim]:
    """Return the texts that name another robot than the chosen one."""
    own = set(re.split(r"[\W_]+", spelled(f"{robot.id} {robot.manufacturer} {robot.product}")))
    own_makers = {
        maker
        for maker, words in ROBOTS.items()
        if own & set(words.split()) or maker in spelled(robot.manufacturer)
    }
    known = {word: maker for maker, words in ROBOTS.items() for word in words.split()}
    if not own_makers:
        return []
    found = []
    for v in workspace.variables:
        if not v.text or len(v.text) > 200 or v.kind == "logical":
            continue
        tokens = [t for t in re.split(r"[\W_]+", spelled(v.text)) if t]
        pairs = [a + b for a, b in itertools.pairwise(tokens)]
        said = [t for t in dict.fromkeys((*tokens, *pairs)) if _series(t, known)]
        makers = {known[_series(t, known)] for t in said}
        keyed = any(
            w.can_be(Class.ARM) or w.text in ("model", "modell") for w in described(leaf(v.path))
        )
        if not makers or not (keyed or len(tokens) <= 12):
            continue
        models = [
            t for t in said if any(c.isdigit() for c in t) or t in ("iiwa", "iisy", "youbot")
        ]
        if not makers & own_makers:
            found.append(RobotClaim(v.path, v.text.strip(), other_maker=True))
        elif models and not any(m in own or any(o.startswith(m) for o in own) for m in models):
            found.append(RobotClaim(v.path, v.text.strip(), other_maker=False))
    return found


def robot_named(name: str, robot: RobotModel) -> str:
    """Return the words by which a name, as of a file, means another robot of the library.

    Words of models have letters and digits (kr6, r900); empty where the chosen robot has as many
    of the name's words as any other.
    """
    said = _models(name)
    own = said & _models(f"{robot.id} {robot.product}")
    best = max((said & _models(other) for other in robot.others), key=len, default=set())
    return " ".join(sorted(best, key=name.lower().find)) if len(best) > len(own) else ""


def _models(text: str) -> set[str]:
    """Return the words of models in a text, also those that are written apart (KR 6)."""
    words = [word for word in re.split(r"[\W_]+", text.lower()) if word]
    pairs = (a + b for a, b in itertools.pairwise(words) if a.isalpha() and b.isdigit())
    return {word for word in (*words, *pairs) if MODEL.fullmatch(word)}


def _series(word: str, known: Collection[str]) -> str:
    """Return the word of a robot that is known: itself, or the series of one such as iiwa14."""
    series = word.rstrip("0123456789")
    if word in known:
        return word
    return series if len(series) > 2 and series in known else ""


def factors(said: list[Statement]) -> Iterator[tuple[str, float]]:
    """Yield the numbers beside a matrix that are named as factors, with where they stand."""
    for s in said:
        values = s.variable.values
        if values is not None and values.size == 1 and s.names(Class.FACTOR):
            number = float(np.asarray(values).reshape(-1)[0])
            if np.isfinite(number) and number not in (0.0, 1.0):
                yield s.path, number


def gears(said: list[Statement], joints: int) -> Statement | None:
    """Return the gear ratios beside a matrix, or None."""
    for s in said:
        values = s.variable.values
        if values is None or values.size not in (1, joints) or not s.names(Class.GEAR):
            continue
        if any(w.quantity or w.can_be(Class.GRIPPER) for w in s.words):
            continue
        numbers = np.abs(np.asarray(values, dtype=np.float64))
        if np.isfinite(numbers).all() and float(numbers.max()) > 1:
            return s
    return None
