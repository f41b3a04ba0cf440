"""Checks of single values: numbers, texts, choices, lists, matrices.

None (an empty YAML value) counts as missing. NaN and infinities are never accepted.
"""

from __future__ import annotations

import math
import re
import reprlib
from collections.abc import Mapping
from dataclasses import dataclass
from enum import Enum
from typing import TYPE_CHECKING, Any, Generic, Protocol, TypeAlias, TypeVar

from mrlab_ros.core.base import diagnostics as said
from mrlab_ros.core.base import names
from mrlab_ros.core.base.diagnostic import Diagnostic
from mrlab_ros.core.base.errors import BadInput

if TYPE_CHECKING:
    from numpy.typing import NDArray

T = TypeVar("T")
T_co = TypeVar("T_co", covariant=True)
EnumT = TypeVar("EnumT", bound=Enum)
# A place in a file or what is expected there: with a code, or a name of its own such as a path.
Words: TypeAlias = Diagnostic | str
ANY_TEXT = said.A_TEXT()
# Long enough for a vector or a path; a whole mesh is cut.
_shorten = reprlib.Repr()
_shorten.maxstring = _shorten.maxother = 120
_shorten.maxlist = _shorten.maxtuple = _shorten.maxdict = 8


@dataclass(frozen=True)
class Range:
    """The numbers from `low` to `high`; an open end is not part of it."""

    low: float = -math.inf
    high: float = math.inf
    low_open: bool = False
    high_open: bool = False

    def __contains__(self, value: float) -> bool:
        above = value > self.low if self.low_open else value >= self.low
        below = value < self.high if self.high_open else value <= self.high
        return above and below

    @property
    def words(self) -> Diagnostic | None:
        """The words after a noun, such as 'from 60 to 2000' and 'above 0'; None: no limits."""
        low, high = _plain(self.low), _plain(self.high)
        below, most = (high, None) if self.high_open else (None, high)
        if low is None:
            if high is None:
                return None
            return said.LIMITS_BELOW(below=high) if self.high_open else said.LIMITS_TO(high=high)
        if self.low_open:
            return said.LIMITS_ABOVE(low=low, high=most, below=below)
        if most is None:
            return said.LIMITS_FROM(low=low, below=below)
        return said.LIMITS_BETWEEN(low=low, high=most)


def _plain(limit: float) -> float | None:
    return None if math.isinf(limit) else limit


ANY = Range()


def above(low: float, at_most: float = math.inf) -> Range:
    """Return the numbers above `low`, which is not part of them."""
    return Range(low, at_most, low_open=True)


def at_least(low: float) -> Range:
    """Return the numbers of `low` and more."""
    return Range(low)


def between(low: float, high: float) -> Range:
    """Return the numbers from `low` to `high`, both included."""
    return Range(low, high)


class Check(Protocol[T_co]):
    """The check of a value.

    expected: the words after 'expected' in an error. read: returns the value in its type; raises
    ValueError, with a remedy where there is one, for a value that is not expected.
    """

    @property
    def expected(self) -> Words: ...

    def read(self, value: object) -> T_co: ...


def _number(value: object, limits: Range, *, whole: bool = False, mirrored: bool = False) -> float:
    def allowed(number: float) -> bool:
        return (abs(number) if mirrored else number) in limits

    if isinstance(value, str):
        try:
            number = float(value)
        except ValueError:
            raise ValueError from None
        if not math.isfinite(number) or (whole and not number.is_integer()):
            raise ValueError
        if not allowed(number):
            raise ValueError
        # YAML takes 1e3 for a text: its numbers need a point and a sign, as in 1.0e+3.
        raise ValueError(said.WITHOUT_QUOTES(number=int(number) if whole else number))
    if type(value) not in (int, float):
        raise ValueError
    try:
        number = float(value)  # type: ignore[arg-type]
    except OverflowError:
        raise ValueError from None
    if not math.isfinite(number):
        raise ValueError(said.FINITE_NUMBERS())
    if not allowed(number):
        raise ValueError
    return number


@dataclass(frozen=True)
class Number:
    """A finite number; whole numbers and decimals alike. mirrored: its negative may be, too."""

    limits: Range = ANY
    unit: str = ""
    mirrored: bool = False

    @property
    def expected(self) -> Words:
        sign = "either" if self.mirrored else None
        return said.A_NUMBER(limits=self.limits.words, unit=self.unit or None, sign=sign)

    def read(self, value: object) -> float:
        return _number(value, self.limits, mirrored=self.mirrored)


@dataclass(frozen=True)
class Integer:
    """A whole number; 5.0 is one too."""

    limits: Range = ANY
    unit: str = ""

    @property
    def expected(self) -> Words:
        return said.AN_INTEGER(limits=self.limits.words, unit=self.unit or None)

    def read(self, value: object) -> int:
        number = _number(value, self.limits, whole=True)
        if not number.is_integer():
            raise ValueError
        return value if isinstance(value, int) else int(number)


@dataclass(frozen=True)
class Flag:
    """True or false."""

    @property
    def expected(self) -> Words:
        return said.TRUE_OR_FALSE()

    def read(self, value: object) -> bool:
        if not isinstance(value, bool):
            raise ValueError
        return value


@dataclass(frozen=True)
class Text:
    """A text that matches `pattern` as a whole, which `what` describes."""

    pattern: re.Pattern[str] | None = None
    what: Words = ANY_TEXT

    @property
    def expected(self) -> Words:
        return self.what

    def read(self, value: object) -> str:
        text = str(value)
        fits = self.pattern is None or self.pattern.fullmatch(text) is not None
        if not isinstance(value, str):
            raise ValueError(*[said.IN_QUOTES(text=text)] * (fits and _is_number(value)))
        if not fits:
            raise ValueError
        return value


@dataclass(frozen=True)
class Choice(Generic[T]):
    """One of a few texts or numbers, each with what it stands for; the case does not matter."""

    values: Mapping[Any, T]

    @property
    def expected(self) -> Words:
        return said.ONE_OF(choices=[str(key) for key in self.values])

    def read(self, value: object) -> T:
        key = value.lower() if isinstance(value, str) else value
        # 1 and True are the same key of a dict.
        if type(key) not in (str, int) or key not in self.values:
            raise ValueError
        return self.values[key]


def enum_values(kind: type[EnumT]) -> Choice[EnumT]:
    """Return the choice of an enum's values."""
    return Choice({member.value: member for member in kind})


@dataclass(frozen=True)
class Numbers:
    """A list of `count` numbers; of at least one where `count` is None."""

    count: int | None = None
    limits: Range = ANY
    unit: str = ""

    @property
    def expected(self) -> Words:
        limits, unit = self.limits.words, self.unit or None
        if self.count is None:
            return said.SOME_NUMBERS(limits=limits, unit=unit)
        return said.COUNTED_NUMBERS(count=self.count, limits=limits, unit=unit)

    def read(self, value: object) -> tuple[float, ...]:
        if not isinstance(value, list | tuple) or not value:
            raise ValueError
        if self.count is not None and len(value) != self.count:
            raise ValueError
        return tuple(_number(number, self.limits) for number in value)


@dataclass(frozen=True)
class Matrix:
    """A list of rows of `columns` numbers each, whole ones where `whole` is true; may be empty.

    Read as an (N, columns) array of float64, or of int32.
    """

    columns: int
    whole: bool = False

    @property
    def expected(self) -> Words:
        numbers = "whole" if self.whole else "any"
        return said.ROWS_OF_NUMBERS(columns=self.columns, numbers=numbers)

    def read(self, value: object) -> NDArray[Any]:
        import numpy as np  # here: commands read records without matrices, and want to be quick

        if not isinstance(value, list | tuple):
            raise ValueError
        try:
            rows = np.array(value) if value else np.zeros((0, self.columns), np.int64)
        except (ValueError, OverflowError):
            raise ValueError from None
        numeric = rows.dtype.kind in ("i" if self.whole else "if")
        if not numeric or rows.ndim != 2 or rows.shape[1] != self.columns:
            raise ValueError
        kind = np.dtype(np.int32 if self.whole else np.float64)
        if not np.isfinite(rows).all() or (
            self.whole and np.abs(rows).max(initial=0) > np.iinfo(np.int32).max
        ):
            raise ValueError
        return rows.astype(kind)


@dataclass(frozen=True)
class Texts:
    """A list of texts, each as `item` expects it; may be empty.

    single: one text alone is a list of one. skip_empty: empty texts are left out, as ROS writes
    [''] where it means a list of no texts.
    """

    item: Text = Text()
    single: bool = False
    skip_empty: bool = False

    @property
    def expected(self) -> Words:
        code = said.TEXT_OR_TEXTS if self.single else said.SOME_TEXTS
        return code(item=None if self.item == Text() else self.item.what)

    def read(self, value: object) -> tuple[str, ...]:
        if isinstance(value, str):
            if not self.single:
                self.item.read(value)
                raise ValueError(said.IN_BRACKETS(text=value))
            value = [value]
        if not isinstance(value, list | tuple):
            raise ValueError
        texts = (text for text in value if text != "" or not self.skip_empty)
        return tuple(self.item.read(text) for text in texts)


FLAG = Flag()
TEXT = Text()
TEXTS = Texts()
FILLED_TEXT = Text(re.compile(r".+", re.DOTALL), said.A_FILLED_TEXT())
NAME = Text(names.NAME, said.A_NAME())


def _is_number(value: object) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool)


def shown(value: object) -> str:
    """Return a value as an error shows it: short, and true or false as YAML writes them."""
    if isinstance(value, bool):
        return str(value).lower()
    return "empty" if value is None else _shorten.repr(value)


def bad_value(what: Words, value: object, expected: Words, hint: Words | None = None) -> BadInput:
    """Return the error for a value that is not what it must be."""
    if value is None:
        return BadInput(said.EMPTY_VALUE(what=what, expected=expected))
    return BadInput(
        said.BAD_VALUE(what=what, found=shown(value), expected=expected, hint=hint or None)
    )


def checked(what: Words, value: object, check: Check[T]) -> T:
    """Return `value` as `check` reads it; raise BadInput that names `what`."""
    try:
        return check.read(value)
    except ValueError as error:
        raise bad_value(what, value, check.expected, *error.args[:1]) from None
