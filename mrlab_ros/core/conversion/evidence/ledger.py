"""The ledger of a file: how everything in it ends beside the matrix that was chosen.

Each number, vector, matrix, text and attribute is explained by a claim, harmless, or unread.
Nothing that is unread and could change the motion or its rate is passed over in silence.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from enum import Enum
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mrlab_ros.core.conversion.evidence import rate_scalars, rate_sentences, statements, units
from mrlab_ros.core.conversion.evidence.glossary import FOREIGN, PENDING, PROSE, QUIET, Class
from mrlab_ros.core.conversion.evidence.joining import first_path
from mrlab_ros.core.conversion.evidence.names import CJK, Hint, Word, described, hint, leaf, parts
from mrlab_ros.core.conversion.evidence.statements import ELEMENT, Statement
from mrlab_ros.core.conversion.evidence.time_vectors import (
    MOST_RATE,
    PATH_PARAMETERS,
    SECONDS,
    UNIT_WORDS,
    counts_rows,
    is_even,
    is_regular,
    snapped,
)
from mrlab_ros.core.conversion.workspace import COMMENT, Variable, Workspace


class About(Enum):
    """The part of a reading that a claim is about."""

    QUANTITY = "quantity"
    UNIT = "unit"
    ORDER = "order"
    ROBOT = "robot"
    RATE = "rate"
    MOTOR = "motor"


class Standing(Enum):
    """How sure a claim is: the file says so, the numbers do, or nothing does."""

    STATED = "stated"
    INFERRED = "inferred"
    ASSUMED = "assumed"


@dataclass(frozen=True)
class Claim:
    """A part of the reading of a matrix. source: the path of its evidence, or empty."""

    about: About
    value: str
    standing: Standing
    source: str = ""


class End(Enum):
    """How something of a file ends; unread: by what it could be."""

    EXPLAINED = "explained"
    HARMLESS = "harmless"
    TIME = "time"
    FACTOR = "factor"
    PER_JOINT = "per_joint"
    TEXT = "text"

    @property
    def unread(self) -> bool:
        return self not in (End.EXPLAINED, End.HARMLESS)


@dataclass(frozen=True)
class Entry:
    """One variable of the file. words: those not understood; rate: Hz, 0 where none follows."""

    variable: Variable
    end: End
    words: tuple[str, ...] = ()
    rate: float = 0.0

    @property
    def path(self) -> str:
        return self.variable.path


# classes of words that explain a number beside a matrix as no time and no factor of it
SETTLED = (Class.TABLE, Class.GEAR, Class.GRIPPER, Class.UNIT_FLAG)
OF_TIMES = (Class.CLOCK, Class.PERIOD, Class.RATE, Class.DURATION)
ALSO_OTHERWISE = (Class.TABLE, Class.ROLE, Class.KEPT, Class.SYMBOL)
OF_MATRIX = (Class.SYMBOL, Class.JOINT, Class.ANGLE, Class.CONFIGURATION)
CHANGES = (Class.MOTOR, Class.GEAR, Class.FACTOR, Class.ORDER)
TELLING = (*OF_MATRIX, Class.PLACE)
TIME_UNITS = frozenset().union(*(UNIT_WORDS[u] for u in ("s", "ms", "us", "ns")))
TIMED = re.compile(
    r"\d\s*(?:[munµ]?s|[mu]?sec\w*|k?hz|hertz|fps|sek\w*|seg\w*|second\w*|ms\w*)\b|"
    r"(?:rate|dt|fs|ts)\s*[=:]\s*\d",
    re.I,
)
LEAST_STEP, MOST_STEP = 1e-4, 0.5  # s; of a number that no word explains
MOST_EVERY = 1000
SWAPPED = re.compile(r"<-*>|<=>|[↔⇄]")
ENOUGH = 8  # numbers of a vector that rises
ANGLE_FACTORS = (np.pi / 180, 180 / np.pi, np.pi / 200, 200 / np.pi)
NOTHING = frozenset(("none", "no", "off", "false", "linear", "0", "keine", "aus", "aucun"))
FLAGS = (Class.UNIT_FLAG, Class.ANGLE, Class.UNIT_KEY)
MOST_ENTRIES = 3000
SAME = 0.01
FAR = 99  # how near what belongs to another struct is


@dataclass(frozen=True)
class Ledger:
    """The entries of a file, the nearest to the matrix first."""

    entries: tuple[Entry, ...]

    def unread(self, *ends: End) -> list[Entry]:
        return [e for e in self.entries if e.end in ends]


@dataclass(frozen=True)
class _Matrix:
    """What the ledger is kept for. rate: Hz; assumed: nothing says it; ends: (2, C) rows."""

    path: str
    rows: int
    joints: int
    rate: float
    assumed: bool
    robot: frozenset[str]
    ends: NDArray[Any]
    unit_stated: bool = False

    def begins_or_ends_at(self, posture: NDArray[Any]) -> bool:
        """Say whether one number a joint, such as q0, is its first or its last row."""
        ends = self.ends[:, : self.joints]
        return ends.shape[1] == len(posture) and bool((abs(ends - posture) < 1e-6).all(1).any())


def read(
    workspace: Workspace,
    path: str,
    size: tuple[int, int],
    claims: Sequence[Claim],
    told: Iterable[str],
    robot: str,
) -> Ledger:
    """Return how everything in a file ends beside the matrix at `path`.

    size: its rows and the joints of the robot. told: the paths that a finding names already.
    robot: all its names.
    """
    rate = next(c for c in claims if c.about is About.RATE)
    own = first_path(path)
    held = workspace.find(path) or workspace.find(own)
    values = None if held is None else held.values
    ends = np.empty((2, 0)) if values is None or values.ndim != 2 else values[[0, -1]]
    assumed = rate.standing is Standing.ASSUMED
    unit_stated = any(c.about is About.UNIT for c in claims)
    matrix = _Matrix(
        own, *size, float(rate.value), assumed, frozenset(parts(robot)), ends, unit_stated
    )
    known = {c.source for c in claims} | set(told) | {own, path}
    near = {v.path: n for n, v in reversed(statements.nearby(workspace, own))}
    listed = [v for v in workspace.variables if v.path in near or assumed]
    listed.sort(key=lambda v: near.get(v.path, FAR))
    return Ledger(
        tuple(
            Entry(v, End.EXPLAINED)
            if v.path in known
            else _entry(v, near.get(v.path, FAR), matrix)
            for v in listed[:MOST_ENTRIES]
            if not ELEMENT.search(leaf(v.path)) or v.kind == COMMENT
        )
    )


def _entry(v: Variable, near: int, matrix: _Matrix) -> Entry:
    said = Statement(v, near, tuple(described(leaf(ELEMENT.sub("", v.path)))))
    if v.text:
        return _text(said, matrix)
    if v.values is None or v.kind == "logical" or not v.values.size:
        return Entry(v, End.HARMLESS)
    if v.values.size == 1:
        return _number(said, matrix)
    if len(v.shape) == 2 and min(v.shape) == 1:
        return _vector(said, matrix)
    rises = matrix.assumed and _has_clock(v, matrix)
    return Entry(v, End.TIME if rises else End.HARMLESS)


def _is_timed(words: Sequence[Word]) -> bool:
    """Say whether a name has a word that says time and means nothing else there."""
    if len(words) > 1 and words[-1].text in TIME_UNITS | {"hz", "khz"}:
        return True
    return any(w.can_be(*OF_TIMES) and not w.can_be(*ALSO_OTHERWISE) for w in words)


def _is_settled(words: Sequence[Word]) -> bool:
    """Say whether a name explains its number as a quantity of its own."""
    return bool(words) and all(
        w.can_be(*SETTLED) or w.quantity or w.can_be(Class.ROLE, Class.ARM, Class.JOINT)
        for w in words
    ) and any(w.can_be(*SETTLED) or w.quantity for w in words)  # fmt: skip


def _touches(words: Sequence[Word], matrix: _Matrix) -> bool:
    """Say whether a name is that of the matrix with more behind or before it: q_gain."""
    own = [w.text for w in described(leaf(matrix.path))]
    return len(words) > 1 and bool(own) and own[0] in {w.text for w in words}


def _unread(words: Sequence[Word]) -> tuple[str, ...]:
    return tuple(w.text for w in words if w.unread and len(w.text) > 1)


def _number(s: Statement, matrix: _Matrix) -> Entry:
    v, words = s.variable, s.words
    assert v.values is not None
    number = float(np.asarray(v.values).reshape(-1)[0])
    if s.near <= 2 and not matrix.unit_stated and number in ANGLE_FACTORS:
        return Entry(v, End.FACTOR)
    if number and s.near <= 2 and not _is_timed(words) and (done := _may_be_done(words, number)):
        return Entry(v, End.TEXT, done)
    counts = (0.0, 1.0, matrix.rows, matrix.joints, matrix.joints + 1)
    if not np.isfinite(number) or number in counts:
        return Entry(v, End.HARMLESS)
    timed, settled = _is_timed(words), _is_settled(words)
    rate = _rate_of(number, words)
    if all(len(w.text) == 1 for w in words):
        # a letter explains nothing that is near a usual rate or step
        least, most = rate_scalars.LIKELY_RATES
        settled = settled and not least <= rate <= most
    if number > 0 and matrix.assumed and (timed or (not settled and _may_be_time(number))):
        return Entry(v, End.TIME, rate=rate)
    touching = _touches(words, matrix) and not any(w.can_be(Class.ROLE) for w in words)
    factor = any(w.can_be(Class.FACTOR) and not w.can_be(Class.TABLE) for w in words)
    of_angles = any(w.unit is not None and w.unit.is_angle for w in words) and not settled
    if _agrees(number, matrix, timed=timed) and not (touching or factor or of_angles):
        return Entry(v, End.EXPLAINED)
    if s.near > 2:
        return Entry(v, End.HARMLESS)
    if timed and FOREIGN & {w.text for w in words}:
        return Entry(v, End.HARMLESS)
    if timed and (words[-1].text in TIME_UNITS or not factor):
        likely = rate_scalars.LIKELY_RATES[0] <= rate <= rate_scalars.LIKELY_RATES[1]
        rated = any(w.can_be(Class.PERIOD, Class.RATE) and len(w.text) > 1 for w in words)
        if likely and rated:
            return Entry(v, End.TIME, rate=rate)
        # every n-th row, in words that are not understood
        unread = _unread(words) if number % 1 == 0 and 2 <= number <= MOST_EVERY else ()
        return Entry(v, End.FACTOR if unread else End.HARMLESS, unread)
    if touching or factor or of_angles or (not settled and _unread(words)):
        return Entry(v, End.FACTOR, _unread(words))
    return Entry(v, End.HARMLESS)


def _may_be_done(words: Sequence[Word], number: float) -> tuple[str, ...]:
    """Return the words of a number that may still change a motion: flip = 1, interp = 10.

    So may a flag that is set and is not known at all, or is about angles: rad2deg_applied.
    """
    pending = tuple(w.text for w in words if w.text in PENDING)
    if pending or number != 1.0:
        return pending if len(pending) == len(words) or number == 1.0 else ()
    if all(w.unread and len(w.text) > 1 for w in words):
        return () if QUIET & {w.text for w in words} else _texts(words)
    given = {w.unit for w in words if w.unit is not None}
    flags = all(w.can_be(*FLAGS) or w.unit is not None for w in words) and len(given) == 1
    return () if flags or len(words) < 2 or not any(u.is_angle for u in given) else _texts(words)


def _texts(words: Sequence[Word]) -> tuple[str, ...]:
    return tuple(w.text for w in words)


def _may_be_time(number: float) -> bool:
    return LEAST_STEP <= number <= MOST_STEP or 2 <= number <= MOST_RATE


def _rate_of(number: float, words: Sequence[Word]) -> float:
    """Return the rate, Hz, that a number would mean as a step below 1, else as a rate."""
    last = words[-1].text if words else ""
    if number <= 0:
        return 0.0
    for unit in ("ms", "us", "ns"):
        if last in UNIT_WORDS[unit]:
            return snapped(1 / (number * SECONDS[unit]))
    return snapped(1 / number if number < 1 else number)


def _agrees(number: float, matrix: _Matrix, *, timed: bool) -> bool:
    """Say whether a number is the rate of the rows or their step; timed: or their duration."""
    if matrix.assumed:
        return False
    lasting = (1.0, matrix.rows, matrix.rows - 1) if timed else (1.0,)
    values = [matrix.rate, *(n / matrix.rate for n in lasting)]
    units = (1.0, 1e-3, 1e-6, 1e-9, 60.0) if timed else (1.0,)
    return any(abs(number * k - value) <= SAME * value for k in units for value in values)


def _vector(s: Statement, matrix: _Matrix) -> Entry:
    v, words = s.variable, s.words
    assert v.values is not None
    values = np.asarray(v.values, dtype=np.float64).reshape(-1)
    if not np.isfinite(values).all():
        return Entry(v, End.HARMLESS)
    if len(values) == matrix.joints and s.near <= 2 and values.any() and matrix.joints > 1:
        numbers = sorted(values.tolist())
        permuted = numbers in ([float(n + i) for n in range(matrix.joints)] for i in (0, 1))
        away = any(w.quantity == "errors" for w in words)
        other = any(w.can_be(*SETTLED[:3]) or w.quantity not in ("", "parameters") for w in words)
        plain = all(w.can_be(*OF_MATRIX) for w in words) and not matrix.begins_or_ends_at(values)
        turned = -1 in numbers and set(numbers) <= {
            -1.0,
            1.0,
        }  # signs of axes, whatever it is called
        pending = any(w.text in PENDING for w in words)
        unread = any(w.unread for w in words) and not other
        open_to = away or plain or turned or pending or unread
        return Entry(
            v, End.PER_JOINT if open_to and not permuted else End.EXPLAINED, _unread(words)
        )
    path_parameter = "".join(parts(leaf(v.path))) in PATH_PARAMETERS
    longer = [w for w in words if len(w.text) > 1]
    other = (any(w.quantity for w in words) or _is_settled(longer)) and not _is_timed(words)
    if not matrix.assumed or path_parameter:
        return Entry(v, End.HARMLESS)
    if len(values) < ENOUGH:
        least, most = rate_scalars.LIKELY_STEPS
        near = any(least <= n <= most for n in values.tolist())
        open_to = _is_timed(words) or (near and any(w.unread for w in words))
        return Entry(v, End.TIME if open_to else End.HARMLESS)
    steps = np.diff(values)
    rises = (steps > 0).all() and not (steps == 1).all()
    return Entry(v, End.TIME if rises and (not other or is_even(values)) else End.HARMLESS)


def _has_clock(v: Variable, matrix: _Matrix) -> bool:
    """Say whether the first or the last column of another matrix rises as times do."""
    values: NDArray[Any] | None = v.values
    if values is None or values.ndim != 2 or len(values) < ENOUGH or v.is_message:
        return False
    if v.path == matrix.path or hint(v.path) in (Hint.POSITIONS, Hint.PARTLY):
        return False
    columns = (values[:, 0], values[:, -1])
    return any(is_regular(c) and not counts_rows(c) and c[0] >= 0 for c in columns)


def _text(s: Statement, matrix: _Matrix) -> Entry:
    v, text = s.variable, s.text
    if v.kind == "logical":
        of_angles = tuple(w.text for w in s.words if w.unit is not None and w.unit.is_angle)
        if statements.TRUTHS.get(text.lower()) and not of_angles:
            of_angles = _may_be_done(s.words, 1.0)
        return Entry(v, End.TEXT if of_angles and s.near <= 2 else End.HARMLESS, of_angles)
    stated = rate_sentences.rate_in(text)
    rate = stated.rate if stated else 0.0
    if matrix.assumed:
        spoken = (*s.words, *statements.words_of_text(text))
        timed = any(w.can_be(*rate_scalars.OF_TIMES) for w in spoken)
        if TIMED.search(text) or (timed and any(c.isdigit() for c in text)):
            return Entry(v, End.TIME)
    elif rate and s.near <= 2 and abs(rate - matrix.rate) > SAME * rate:
        return Entry(v, End.TIME, rate=rate)
    if s.near > 2 or s.names(Class.ADMIN):
        return Entry(v, End.HARMLESS)
    if s.names(Class.UNIT_KEY):
        return Entry(v, End.TEXT if _is_unit_of_angles(s) else End.HARMLESS, (text,))
    words = tuple(dict.fromkeys(_words_that_matter(s, matrix)))
    return Entry(v, End.TEXT if words else End.HARMLESS, words)


def _is_unit_of_angles(s: Statement) -> bool:
    """Say whether a text that is called a unit may be that of the matrix, and is not radians."""
    if any(w.quantity or w.can_be(Class.TABLE, *OF_TIMES) for w in s.words):
        return False
    unit = units.parse(s.text)
    return unit is None or (unit.is_angle and unit.factor != 1.0)


def _words_that_matter(s: Statement, matrix: _Matrix) -> Iterator[str]:
    """Yield the words of a text that say what a matrix could be and that no claim obeys.

    Those that name another quantity, a motor, a factor, an order; in a description, also the
    unread ones.
    """
    yield from SWAPPED.findall(s.text)
    spoken = statements.words_of_text(s.text)
    if not NOTHING & set(s.text.lower().split()):
        yield from (w.text for w in s.words if w.text in PENDING)
    found = [w for w in spoken if w.text not in PROSE and w.text not in matrix.robot]
    reads_all = s.near == 0 or s.names(Class.ABOUT, Class.ARM, Class.ORDER, *TELLING)
    named = s.names(Class.NAMES) and not s.names(Class.ARM)
    reads_all = (reads_all or len(spoken) > 1 or bool(CJK.search(s.text))) and not named
    for w in found:
        other = w.quantity and not w.can_be(Class.ROLE, Class.KEPT, Class.PLACE)
        changes = w.can_be(*CHANGES) and not w.can_be(Class.KEPT, Class.SAMPLING, Class.TABLE)
        counted = w.unit is not None and not (w.unit.factor == 1.0 or matrix.unit_stated)
        pending = w.text in PENDING and not w.can_be(Class.KEPT)
        if other or changes or counted or pending or (reads_all and w.unread):
            yield w.text
