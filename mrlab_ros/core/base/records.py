"""Checked fields of a YAML or JSON mapping.

Every mistake is a diagnostic: where it is, the value found, what was expected. Two ways to read:

- `Record` reads a mapping field by field, where fields depend on each other.
- `read(Kind, mapping, place)` builds a dataclass whose fields are made with `field(...)`: one
  record per field with its check, its default and its meaning. It names all mistakes at once.

None (an empty YAML value) counts as a missing field. NaN and infinities are never accepted.
"""

from __future__ import annotations

import dataclasses
import math
import re
import reprlib
from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from dataclasses import MISSING, dataclass
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
S = TypeVar("S")
EnumT = TypeVar("EnumT", bound=Enum)
# A place in a file or what is expected there: with a code, or a name of its own such as a path.
Words: TypeAlias = Diagnostic | str

ANY_TEXT = said.A_TEXT()
# A longer list of known fields is left out where one of them is close to what was written.
LONGEST_LIST = 12
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


def _number(value: object, limits: Range, *, whole: bool = False) -> float:
    if isinstance(value, str):
        try:
            number = float(value)
        except ValueError:
            raise ValueError from None
        if not math.isfinite(number) or (whole and not number.is_integer()):
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
    if number not in limits:
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
        if not self.mirrored:
            return _number(value, self.limits)
        number = _number(value, ANY)
        if abs(number) not in self.limits:
            raise ValueError
        return number


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
        if not isinstance(value, str):
            raise ValueError(*[said.IN_QUOTES(text=str(value))] * _is_number(value))
        if self.pattern is not None and not self.pattern.fullmatch(value):
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


def unknown_field(place: Words, key: object, known: Collection[str]) -> Diagnostic:
    """Return the mistake of a field that does not exist."""
    close = names.close_to(str(key), known)
    fields = [] if close and len(known) > LONGEST_LIST else list(known)
    return said.UNKNOWN_FIELD(place=place, key=str(key), fields=fields, close=close)


def entry_place(place: Words, one: str, number: int) -> Diagnostic:
    """Return the place of an entry of a list, counted from 1; one: a word that ENTRY knows."""
    return said.ENTRY(place=place, one=one, number=number)


class Mistakes(BadInput):
    """Several mistakes of one thing."""

    def __init__(self, mistakes: Sequence[Words], whole: Words) -> None:
        self.mistakes = tuple(mistakes)
        super().__init__(said.MISTAKES(what=whole, count=len(mistakes), all=list(mistakes)))


def mistakes_of(error: BadInput) -> tuple[Words, ...]:
    """Return the mistakes that an error names."""
    return error.mistakes if isinstance(error, Mistakes) else (error.diagnostic,)


def raise_all(mistakes: Sequence[Words], whole: Words) -> None:
    """Raise BadInput that names all mistakes of `whole`; do nothing where there are none."""
    if len(mistakes) == 1:
        raise BadInput(mistakes[0])
    if mistakes:
        raise Mistakes(mistakes, whole)


def every(build: Callable[[S], T], sources: Iterable[S], whole: Words) -> list[T]:
    """Return what `build` makes of each source; raise BadInput that names all their mistakes."""
    built: list[T] = []
    mistakes: list[Words] = []
    for source in sources:
        try:
            built.append(build(source))
        except BadInput as error:
            mistakes += mistakes_of(error)
    raise_all(mistakes, whole)
    return built


class Record:
    """A mapping with known fields.

    place: what the mapping is, such as "scene.yaml, robot 2"; every error begins with it.
    fields: the names that the mapping may hold. Raises BadInput where `value` is no mapping or
    holds another name.
    """

    def __init__(self, value: object, place: Words, fields: Collection[str]) -> None:
        if not isinstance(value, Mapping):
            raise bad_value(place, value, said.A_MAPPING(fields=list(fields)))
        raise_all([unknown_field(place, key, fields) for key in value if key not in fields], place)
        self.place = place
        self._values = value

    def __contains__(self, key: str) -> bool:
        return self._values.get(key) is not None

    def at(self, key: str) -> Diagnostic:
        """Return the place of a field."""
        return said.FIELD(place=self.place, key=key)

    def error(self, why: Words) -> BadInput:
        """Return an error about this mapping."""
        return BadInput(said.IN_PLACE(place=self.place, why=why))

    def optional(self, key: str, check: Check[T]) -> T | None:
        """Return the field, None where it is missing; raise BadInput where it is wrong."""
        value = self._values.get(key)
        try:
            return None if value is None else check.read(value)
        except ValueError as error:
            raise bad_value(self.at(key), value, check.expected, *error.args[:1]) from None

    def value(self, key: str, check: Check[T], default: T) -> T:
        """Return the field, `default` where it is missing; raise BadInput where it is wrong."""
        found = self.optional(key, check)
        return default if found is None else found

    def required(self, key: str, check: Check[T]) -> T:
        """Return the field; raise BadInput where it is missing or wrong."""
        found = self.optional(key, check)
        if found is None:
            raise BadInput(said.MISSING_FIELD(what=self.at(key), expected=check.expected))
        return found

    def record(self, key: str, fields: Collection[str]) -> Record | None:
        """Return the mapping below `key`, None where it is missing."""
        value = self._values.get(key)
        if value is None:
            return None
        return Record(value, said.FIELD_BELOW(place=self.place, key=key), fields)

    def mapping(self, key: str) -> Mapping[object, object]:
        """Return the mapping below `key` as it is; raise BadInput where there is none."""
        value = self._values.get(key)
        if not isinstance(value, Mapping):
            raise bad_value(self.at(key), value, said.NAMED_ENTRIES())
        return value

    def records(self, key: str, fields: Collection[str], one: str) -> list[Record]:
        """Return the list of mappings below `key`; `one` names an entry: 'part' -> 'part 2'."""
        return [
            Record(entry, entry_place(self.place, one, i), fields)
            for i, entry in enumerate(self.entries(key), 1)
        ]

    def entries(self, key: str) -> Sequence[object]:
        """Return the list below `key` as it is, empty where it is missing."""
        value = self._values.get(key)
        if value is None:
            return ()
        if not isinstance(value, list | tuple):
            raise bad_value(self.at(key), value, said.A_LIST())
        return value


@dataclass(frozen=True)
class Field:
    """One field of a dataclass that `read` builds.

    name: in the file. default: MISSING where the field must be given. about: one sentence for
    the documentation. changeable: a new value can take effect without a restart.
    """

    name: str
    check: Check[Any]
    default: Any
    about: str
    changeable: bool


def field(
    check: Check[T],
    about: str,
    default: T | Any = MISSING,
    *,
    name: str = "",
    changeable: bool = False,
) -> Any:
    """Return a dataclass field with its record; `name`: where the file calls it otherwise."""
    metadata = {"check": check, "about": about, "name": name, "changeable": changeable}
    return dataclasses.field(default=default, metadata=metadata)


def fields_of(kind: type[Any]) -> dict[str, Field]:
    """Return the records of a dataclass whose fields are made with `field`, by attribute."""
    return {
        f.name: Field(
            f.metadata["name"] or f.name,
            f.metadata["check"],
            f.default,
            f.metadata["about"],
            f.metadata["changeable"],
        )
        for f in dataclasses.fields(kind)
    }


def read(kind: type[T], values: object, place: Words) -> T:
    """Build a dataclass from a mapping; raise BadInput that names all mistakes of `place`."""
    fields = fields_of(kind)
    names = [f.name for f in fields.values()]
    if not isinstance(values, Mapping):
        raise bad_value(place, values, said.A_MAPPING(fields=names))
    mistakes: list[Words] = [
        unknown_field(place, key, names) for key in values if key not in names
    ]
    found: dict[str, Any] = {}
    for attribute, f in fields.items():
        value = values.get(f.name)
        if value is None:
            if f.default is MISSING:
                what = said.FIELD(place=place, key=f.name)
                mistakes.append(said.MISSING_FIELD(what=what, expected=f.check.expected))
            continue
        try:
            found[attribute] = f.check.read(value)
        except ValueError as error:
            what = said.FIELD(place=place, key=f.name)
            bad = bad_value(what, value, f.check.expected, *error.args[:1])
            mistakes.append(bad.diagnostic)
    raise_all(mistakes, place)
    return kind(**found)


def check_fields(instance: Any, place: Words) -> None:
    """Check the fields of a dataclass that was built by hand, as `read` does."""
    mistakes: list[Words] = []
    for attribute, f in fields_of(type(instance)).items():
        value = getattr(instance, attribute)
        try:
            f.check.read(value)
        except ValueError as error:
            what = said.FIELD(place=place, key=f.name)
            bad = bad_value(what, value, f.check.expected, *error.args[:1])
            mistakes.append(bad.diagnostic)
    raise_all(mistakes, place)
