"""Files and students of an export that could not be matched, and who it may be.

A file that is named otherwise than the platform names files belongs to nobody; a student who is in
no row of the platform's table would lose the mark. The nearest person is proposed by name and
number; what the teacher decides is kept in the journal, and applied in each run.
"""

from __future__ import annotations

import difflib
import itertools
import re
from collections import Counter
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from pathlib import PurePosixPath
from typing import Any

from mrlab_ros.classroom.marks.diagnostics import (
    FILE_ASSIGNED,
    NOT_IN_WORKSHEET,
    UNKNOWN_MATCH,
)
from mrlab_ros.classroom.marks.exports import (
    REFERENCE,
    Entry,
    LeftOut,
    Roster,
    Submission,
    file_label,
    slug,
)
from mrlab_ros.classroom.marks.journal import ASSIGN, ENROL
from mrlab_ros.core.base.diagnostic import Diagnostic, plain
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.base.names import without_accents

FILE, STUDENT = "file", "student"
SURE = 0.75  # of a name that has to stand there
APART = 0.05  # by which the nearest is nearer than the next
ALIKE, INITIAL = 0.75, 0.85  # from which two words are one with a slip; of a word by its letter
LEAST_NUMBER = 3  # digits by which a person is known
MOST = 100  # proposals that are looked for by spelling


@dataclass(frozen=True)
class Person:
    """Somebody to whom something may belong. key: of the submission; identifier: in the
    platform's table."""

    key: str
    name: str
    identifier: str = ""
    pseudonym: str = ""

    @property
    def shown(self) -> str:
        return self.pseudonym or self.name


@dataclass(frozen=True)
class Unmatched:
    """A file of nobody, or a student in no row of the platform's table.

    what: path of the file, or of the folder with all that seems to be of one person; the
    student's key. proposal: a person's key, or the identifier of a row; proposed: the name there;
    both empty: nobody is near.
    """

    kind: str
    what: str
    name: str
    why: Diagnostic
    proposal: str = ""
    proposed: str = ""

    def plain(self) -> dict[str, Any]:
        """Return it as class.json has it."""
        return {**vars(self), "why": plain(self.why)}


def nearest(text: str, people: Sequence[Person], *, whole: bool = False) -> Person | None:
    """Return the person whose name or number stands in a text, with slips; None: nobody, or two.

    whole: the text is a name, and has no other words.
    """
    words = _words(text)
    found = frozenset(words)
    joined = found | {pair for a, b in itertools.pairwise(words) for pair in (a + b, b + a)}
    scores = sorted((_share(p, found, joined, whole=whole), n) for n, p in enumerate(people))
    if not scores or scores[-1][0] < SURE:
        return None
    if len(scores) > 1 and scores[-2][0] > scores[-1][0] - APART:
        return None
    return people[scores[-1][1]]


def assigned(
    roster: Roster,
    owners: Mapping[str, str],
    people: Iterable[Person],
    label: Callable[[str], str] = str,
) -> Roster:
    """Return a roster in which files belong to whom a teacher gave them.

    owners: key by path, of a file or a folder; empty: nobody's. people: who may have no submission
    yet. A key that nobody has makes a submission of its own. label: how paths are named.
    """
    known = {person.key: person for person in people}
    given: dict[str, list[Entry]] = {}
    names: dict[str, str] = {}
    rest = []
    for each in roster.left_out:
        path = None if each.entry is None else _decided(each.entry.path, owners, label)
        if each.entry is not None and path is not None and (key := owners[path]):
            given.setdefault(key, []).append(each.entry)
            names.setdefault(key, path)
        else:
            rest.append(each)
    submissions = {s.key: s for s in roster.submissions}
    for wanted, entries in given.items():
        label_of = names[wanted]
        who = known.get(wanted) or Person(_own(wanted), file_label(label_of))
        key = wanted if wanted in submissions else who.key
        one = submissions.get(key) or Submission(key, who.name, roster.form, who.identifier)
        newest = sorted(entries, key=lambda e: e.modified, reverse=True)
        submissions[key] = replace(
            one,
            candidates=(*newest, *one.candidates),
            notes=(*one.notes, FILE_ASSIGNED(file=label_of)),
        )
    ordered = sorted(submissions.values(), key=lambda s: (s.name.casefold(), s.identifier))
    return Roster(roster.form, tuple(ordered), tuple(rest))


def files(
    left_out: Sequence[LeftOut],
    owners: Mapping[str, str],
    people: Sequence[Person],
    label: Callable[[str], str] = str,
) -> tuple[list[Unmatched], tuple[LeftOut, ...]]:
    """Return the files that nobody has decided about, those of one folder for one person once; and
    all others."""
    near: list[tuple[PurePosixPath, LeftOut, Person | None]] = []
    rest = []
    for each in left_out:
        if each.entry is None or _decided(each.entry.path, owners, label) is not None:
            rest.append(each)
            continue
        path = PurePosixPath(each.entry.path)
        person = nearest(str(path.with_suffix("")), people) if len(near) < MOST else None
        near.append((path, each, person))
    beside: dict[PurePosixPath, set[Person | None]] = {}
    for path, _, person in near:
        for place in path.parents:
            beside.setdefault(place, set()).add(person)
    found: dict[str, Unmatched] = {}
    for path, each, person in near:
        together = person is not None and path.parent.name and beside[path.parent] == {person}
        what = label(str(path.parent if together else path))
        key, name = (person.key, person.shown) if person else ("", "")
        found[what] = Unmatched(FILE, what, what, each.why, key, name)
    return list(found.values()), tuple(rest)


def enrolled(
    students: Sequence[Submission], rows: Sequence[Person], chosen: Mapping[str, str]
) -> tuple[dict[str, str], list[Unmatched]]:
    """Return the row of each student by key, as its identifier, and who is in none.

    It is the row that a teacher chose (empty: none), that has the student's number, or, where the
    export has no numbers, the only one with that name.
    """
    by_number = {number: row for row in rows for number in numbers(row.identifier)}
    by_name = Counter(_name(row.name) for row in rows)
    same = Counter(_name(s.name) for s in students)
    named = {_name(row.name): row for row in rows}
    found: dict[str, str] = {}
    taken: set[str] = set()
    missing = []
    for one in sorted(students, key=lambda s: s.key not in chosen):  # what was chosen first
        name = _name(one.name)
        row = by_number.get(one.identifier)
        if row is None and not one.identifier and by_name[name] == same[name] == 1:
            row = named[name]
        place = chosen.get(one.key, row.identifier if row is not None else None)
        if place is None or place in taken:
            missing.append(one)
        else:
            found[one.key] = place
            taken.update(filter(None, [place]))
    free = [row for row in rows if row.identifier not in taken]
    unmatched = []
    for number, one in enumerate(missing):
        name = _name(one.name)
        near = named[name] if by_name[name] == 1 and named[name] in free else None
        if near is None and number < MOST:
            near = nearest(one.name, free, whole=True)
        proposal, proposed = (near.identifier, near.name) if near else ("", "")
        why = NOT_IN_WORKSHEET(student=one.name)
        unmatched.append(Unmatched(STUDENT, one.key, one.name, why, proposal, proposed))
    return found, unmatched


def decided(
    unmatched: Sequence[Unmatched],
    owners: Mapping[str, str],
    students: Sequence[Person],
    rows: Sequence[Person],
    matches: Sequence[tuple[str, str]],
    *,
    accepts: bool,
) -> list[tuple[str, str, str]]:
    """Return acts for the journal: what is done, the student's key, and the file or row.

    matches: what is matched and who it is; nobody where that is empty, and itself where a file
    is a submission of its own. accepts: all other proposals hold. Raises BadInput for what is
    unknown.
    """
    wanted = [(each, each.proposal) for each in unmatched if accepts and each.proposal]
    made = {
        (each.kind, each.what): (ASSIGN, proposal, each.what)
        if each.kind == FILE
        else (ENROL, each.what, proposal)
        for each, proposal in wanted
    }
    files = {each.what for each in unmatched if each.kind == FILE} | set(owners)
    for what, who in matches:
        if what in files:
            person = _called(who, students, rows) if who not in ("", what) else None
            made[FILE, what] = (ASSIGN, person.key if person else who and _own(who), what)
        else:
            one = _called(what, students)
            row = _called(who, rows).identifier if who else ""
            made[STUDENT, one.key] = (ENROL, one.key, row)
    return list(made.values())


def _called(text: str, *groups: Sequence[Person]) -> Person:
    """Return who has a key, number or name; raise BadInput where that is nobody, or several."""
    for people in groups:
        for known in (
            [p for p in people if text in (p.key, p.identifier)],
            [p for p in people if text in numbers(p.identifier)],
            [p for p in people if _name(text) in (_name(p.name), _name(p.shown))],
        ):
            if len(known) == 1:
                return known[0]
    near = nearest(text, [person for people in groups for person in people], whole=True)
    raise BadInput(UNKNOWN_MATCH(found=text, near=near and near.shown))


def numbers(said: str) -> tuple[str, ...]:
    """Return how a row of a table may be known: as it says, and by the number in it."""
    number = re.search(r"\d+", said)
    return (said, number[0]) if number else (said,)


def key_of(name: str, identifier: str) -> str:
    """Return the key of a person who has no submission yet."""
    return slug(f"{name} {numbers(identifier)[-1]}") or "student"


def _own(key: str) -> str:
    """Return a key that somebody asked for as one that is a file name, and not the solution's."""
    own = slug(key) or "student"
    return f"{own}-1" if own == REFERENCE else own


def _decided(path: str, owners: Mapping[str, str], label: Callable[[str], str]) -> str | None:
    """Return under which name somebody decided about a file or a folder around it."""
    places = (path, *map(str, PurePosixPath(path).parents))
    return next((name for place in places if (name := label(place)) in owners), None)


def _words(text: str) -> list[str]:
    return re.findall(r"[^\W\d_]+|\d+", without_accents(text).casefold())


def _name(text: str) -> tuple[str, ...]:
    return tuple(sorted(_words(text)))


@lru_cache(maxsize=50_000)
def _of_person(person: Person) -> tuple[frozenset[str], frozenset[str]]:
    """Return the words of a name, and the numbers by which a person is known."""
    known = {n for n in numbers(person.identifier) if len(n) >= LEAST_NUMBER}
    return frozenset(_words(person.name)), frozenset(n.casefold() for n in known)


def _share(person: Person, found: frozenset[str], joined: frozenset[str], *, whole: bool) -> float:
    """Return how much of a person's name stands among words, from 0 to 1."""
    words, known = _of_person(person)
    if known & found:
        return 1.0
    if not words or not found:
        return 0.0
    if any(a + b in found for a in words for b in words if a != b):
        return 1.0
    own = sum(max(_closeness(word, each) for each in joined) for word in words) / len(words)
    if not whole or own < ALIKE / 2:
        return own
    back = sum(max(_closeness(each, word) for word in words) for each in found) / len(found)
    return (own + back) / 2


@lru_cache(maxsize=200_000)
def _closeness(one: str, other: str) -> float:
    if one == other:
        return 1.0
    short, long = sorted((one, other), key=len)
    if len(short) == 1 and short.isalpha():
        return INITIAL * long.startswith(short)
    if short.isdigit() or 2 * len(short) < ALIKE * (len(short) + len(long)):
        return 0.0
    ratio = difflib.SequenceMatcher(None, one, other).ratio()
    return ratio if ratio >= ALIKE else 0.0
