"""Checked fields of a YAML or JSON mapping.

Every mistake is a diagnostic: where it is, the value found, what was expected. Two ways to read:

- `Record` reads a mapping field by field, where fields depend on each other.
- `read(Kind, mapping, place)` builds a dataclass whose fields are made with `field(...)`: one
  record per field with its check, its default and its meaning. It names all mistakes at once.

None (an empty YAML value) counts as a missing field. NaN and infinities are never accepted.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from dataclasses import MISSING, dataclass
from typing import Any, TypeVar

from mrlab_ros.core.base import diagnostics as said
from mrlab_ros.core.base import names
from mrlab_ros.core.base.checks import Check, T, Words, bad_value
from mrlab_ros.core.base.diagnostic import Diagnostic
from mrlab_ros.core.base.errors import BadInput

S = TypeVar("S")

# A longer list of known fields is left out where one of them is close to what was written.
LONGEST_LIST = 12


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
