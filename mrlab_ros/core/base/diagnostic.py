"""Everything that the lab tells a person: a code with typed values, its text beside the code.

A room declares its codes in a module `diagnostics`, one `Code` each, next to the code that uses
them. Calling a code with values makes a `Diagnostic`; an error carries one:

    NO_ROBOT = Code("no_robot", "There is no robot {robot}[; did you mean {close}?].")
    raise BadInput(NO_ROBOT(robot=name, close=similar))

Programs read `code` and `values`, never the text. Other languages have a table by code in
`web/src/words/`. No text names an option of the command line or a button: a fix is data, and each
door words it in its own way.
"""

from __future__ import annotations

import json
import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from enum import IntEnum
from math import isfinite
from typing import Any, Protocol

from mrlab_ros.core.base.foreign_text import visible
from mrlab_ros.core.base.phrase import Phrase, Value, ended, phrase

# Text that MATLAB takes for a variable or a part of one, and for nothing else; pasted text
# may hold no other name of a file, such as `q; system('...')`.
MATLAB_PATH = re.compile(r"[A-Za-z]\w*(\.[A-Za-z]\w*|\([\d:, ]+\)|\{[\d:, ]+\})*", re.ASCII)
# Values that say where a diagnostic applies; each code may have them beside those of its text.
IN_MESSAGE = frozenset(
    ("variable", "where", "first_row", "last_row", "joint", "value", "limit", "unit")
)
# Those that mrlab_msgs/Diagnostic has no field for.
FURTHER = frozenset(("robot", "link", "time", "end", "kind", "other"))
PLACE = IN_MESSAGE | FURTHER


class Severity(IntEnum):
    """How much a diagnostic matters; the values are those of mrlab_msgs/Diagnostic."""

    INFO = 0
    WARNING = 1
    ERROR = 2


INFO, WARNING, ERROR = Severity


@dataclass(frozen=True)
class Fix:
    """One way to mend what was found; every field may be empty.

    option: a field of ConvertTrajectory. value: what to set it to, as text. matlab: statements
    that do the same in MATLAB. command: a command line of a shell.
    """

    option: str = ""
    value: str = ""
    matlab: str = ""
    command: str = ""


@dataclass(frozen=True)
class Diagnostic:
    """One thing that a person is told.

    code: what it is, for programs. message, remedy: English sentences made from the values: what
    was found and expected, and what to do next. values: by name, in SI units and radians; names
    of PLACE say where it applies. fixes: ways to mend it, the likeliest first.
    """

    code: str
    severity: Severity
    message: str
    remedy: str = ""
    values: Mapping[str, Value] = field(default_factory=dict, hash=False)
    fixes: tuple[Fix, ...] = ()

    def __str__(self) -> str:
        return f"{ended(self.message)} {self.remedy}" if self.remedy else self.message

    @property
    def refuses(self) -> bool:
        return self.severity is Severity.ERROR

    @property
    def variable(self) -> str:
        """The variable in the workspace; empty: the whole file."""
        return str(self.values.get("variable") or "")

    @property
    def where(self) -> str:
        """A place inside the variable, such as 'row 12, column 3'."""
        return str(self.values.get("where") or "")

    @property
    def first_row(self) -> int:
        """The first row that it applies to, from 1; 0: no rows."""
        return int(self.values.get("first_row") or 0)

    @property
    def last_row(self) -> int:
        return int(self.values.get("last_row") or 0)

    @property
    def joint(self) -> str:
        """The robot's joint; empty: none."""
        return str(self.values.get("joint") or "")

    @property
    def value(self) -> float | None:
        """Return the found figure, in `unit`; None: no number."""
        value = self.values.get("value")
        return None if value is None else float(value)

    @property
    def limit(self) -> float | None:
        """Return the figure that it was compared with, in `unit`."""
        limit = self.values.get("limit")
        return None if limit is None else float(limit)

    @property
    def unit(self) -> str:
        return str(self.values.get("unit") or "")

    @property
    def robot(self) -> str:
        """The robot in the scene; empty: none."""
        return str(self.values.get("robot") or "")

    @property
    def link(self) -> str:
        """The robot's link or joint; empty: none."""
        return str(self.values.get("link") or "")

    @property
    def time(self) -> float | None:
        """s from the first frame; None: no instant."""
        time = self.values.get("time")
        return None if time is None else float(time)

    @property
    def end(self) -> float | None:
        """s from the first frame at which it ends."""
        end = self.values.get("end")
        return None if end is None else float(end)

    @property
    def kind(self) -> str:
        """Return the obstacle, by engine.Kind's name in lower case; empty: none."""
        return str(self.values.get("kind") or "")

    @property
    def other(self) -> str:
        """The name of what the robot meets."""
        return str(self.values.get("other") or "")

    def with_values(self, **values: Value) -> Diagnostic:
        """Return the same with more values; the texts stay."""
        return replace(self, values={**self.values, **values})


@dataclass(frozen=True)
class Code:
    """The declaration of a code: a row of a room's table.

    text, remedy: templates (`phrase.py`) of one or more sentences. meaning: one sentence for the
    generated page of codes. fixes: each (option, value, MATLAB); templates of `str.format`, in
    which `{name:matlab}` is a variable as MATLAB takes it. commands: fixes that are command lines
    of a shell; templates, too. data: names of further values. page: whether a page can show it;
    clients of ROS and terminals get a text alone, which is English.
    """

    code: str
    text: str
    remedy: str = ""
    severity: Severity = ERROR
    meaning: str = ""
    fixes: tuple[tuple[str, str, str], ...] = ()
    commands: tuple[str, ...] = ()
    data: tuple[str, ...] = ()
    page: bool = True

    @property
    def phrases(self) -> tuple[Phrase, Phrase]:
        return phrase(self.text), phrase(self.remedy)

    def names(self) -> tuple[frozenset[str], frozenset[str]]:
        """Return the names of the values that it needs, and of all that it may have."""
        needed, known = set[str](), {*PLACE, *self.data}
        for each in self.phrases:
            needed |= {part.name for part in each.placeholders(optional=False)}
            known |= {part.name for part in each.placeholders()}
        return frozenset(needed), frozenset(known)

    def __call__(
        self,
        *,
        severity: Severity | None = None,
        fixes: tuple[Fix, ...] | None = None,
        **values: Value,
    ) -> Diagnostic:
        """Return the diagnostic with these values; None: a value that is not there.

        severity, fixes: instead of the declared ones. Raises TypeError for a value that the text
        needs and does not get, or that the code does not know.
        """
        needed, known = self.names()
        wrong = needed - values.keys() | values.keys() - known
        if wrong:
            raise TypeError(f"{self.code}: the values {sorted(wrong)} are missing or unknown")
        text, remedy = self.phrases
        if fixes is None:
            quoted = {k: _Said(v) if isinstance(v, str) else v for k, v in values.items()}
            quoted.setdefault("name", _Said(values.get("variable") or ""))
            fixes = tuple(
                Fix(*(part.format(**quoted) for part in fix))
                for fix in (*self.fixes, *(("", "", "", words) for words in self.commands))
            )
        advice = [*self._inner_remedies(values), remedy.fill(values)]
        return Diagnostic(
            self.code,
            self.severity if severity is None else severity,
            text.fill(values),
            " ".join(dict.fromkeys(filter(None, advice))),
            {name: value for name, value in values.items() if value is not None},
            fixes,
        )

    def _inner_remedies(self, values: Mapping[str, Value]) -> Iterator[str]:
        """Yield the remedies of the diagnostics within its sentences."""
        for part in (part for each in self.phrases for part in each.placeholders()):
            value = values.get(part.name)
            if part.quantity == "reasons":
                yield from map(_remedy, value or ())
            elif part.quantity == "problem":
                yield _remedy(value)


def _remedy(value: Value) -> str:
    found = getattr(value, "diagnostic", value)
    return found.remedy if isinstance(found, Diagnostic) else ""


class _Said(str):
    """A text of a file in a line of MATLAB."""

    def __format__(self, spec: str) -> str:
        if spec == "matlab":
            return str(self) if MATLAB_PATH.fullmatch(self) else "q"
        return visible(self)


def of_text(text: str) -> Diagnostic:
    """Return what a library said, which has no code: a text of its own, never translated."""
    return Diagnostic("", Severity.ERROR, text)


def plain(value: Any) -> Any:
    """Return a value, or a diagnostic, as JSON has it.

    A diagnostic, or an error that carries one, becomes a mapping with the fields of
    mrlab_msgs/Diagnostic; further values of PLACE stand beside them.
    """
    value = getattr(value, "diagnostic", value)
    if isinstance(value, Diagnostic):
        values = {name: plain(each) for name, each in value.values.items()}
        return {
            "code": value.code,
            "severity": value.severity.name.lower(),
            "message": value.message,
            "remedy": value.remedy,
            "variable": value.variable,
            "where": value.where,
            "first_row": value.first_row,
            "last_row": value.last_row,
            "joint": value.joint,
            "value": _finite(value.value),
            "limit": _finite(value.limit),
            "unit": value.unit,
            **{name: values[name] for name in sorted(FURTHER & values.keys())},
            "values": values,
            "fixes": [vars(fix) for fix in value.fixes],
        }
    if isinstance(value, float):
        return _finite(value)
    if isinstance(value, Mapping):
        return {str(name): plain(each) for name, each in value.items()}
    if isinstance(value, str | int | bool) or value is None:
        return value
    if hasattr(value, "item"):
        return plain(value.item())
    return [plain(each) for each in value] if isinstance(value, Iterable) else str(value)


def _finite(value: float | None) -> float | None:
    """JSON has no NaN and no infinity."""
    return value if value is not None and isfinite(value) else None


def to_texts(values: Mapping[str, Value]) -> dict[str, str]:
    """Return values as texts by name, for diagnostic_msgs/KeyValue: a text as it is, else JSON."""
    plains = {name: plain(value) for name, value in values.items()}
    return {n: v if isinstance(v, str) else json.dumps(v) for n, v in plains.items()}


def of_record(record: Any) -> Diagnostic:
    """Return the diagnostic of a record with the fields of mrlab_msgs/Diagnostic.

    The texts of its values stay texts, as the wire has them.
    """
    placed = {
        "variable": record.variable,
        "where": record.where,
        "first_row": int(record.first_row),
        "last_row": int(record.last_row),
        "joint": record.joint,
        "value": float(record.value) if isfinite(record.value) else None,
        "limit": float(record.limit) if isfinite(record.limit) else None,
        "unit": record.unit,
    }
    return Diagnostic(
        record.code,
        Severity(int(record.severity)),
        record.message,
        record.remedy,
        {each.key: each.value for each in record.values}
        | {name: value for name, value in placed.items() if value or value == 0.0},
        tuple(Fix(fix.option, fix.value, fix.matlab, fix.command) for fix in record.fixes),
    )


class NamedText(Protocol):
    """A value of a diagnostic in a message, such as diagnostic_msgs/KeyValue."""

    key: str
    value: str


class Said(Protocol):
    """The fields of a message or a response that hold a diagnostic."""

    message: str
    code: str

    @property
    def values(self) -> Sequence[NamedText]:
        """Return the values of the text."""


class Answer(Said, Protocol):
    """The response of a service."""

    success: bool


def heard(answer: Said) -> Diagnostic:
    """Return what a response or a state said; the texts of its values stay texts."""
    if not answer.code:
        return of_text(answer.message)
    values = {each.key: each.value for each in answer.values}
    return Diagnostic(answer.code, Severity.ERROR, answer.message, values=values)


def from_plain(found: Mapping[str, Any]) -> Diagnostic:
    """Return the diagnostic that `plain` wrote."""
    return Diagnostic(
        str(found["code"]),
        Severity[str(found["severity"]).upper()],
        str(found["message"]),
        str(found["remedy"]),
        dict(found["values"]),
        tuple(Fix(**fix) for fix in found["fixes"]),
    )
