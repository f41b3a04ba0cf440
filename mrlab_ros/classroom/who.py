"""Who handed in what, and has which row of the platform's table, after what teachers decided."""

from __future__ import annotations

import getpass
import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from mrlab_ros.adapters.whole_file import write_text
from mrlab_ros.classroom import pseudonyms
from mrlab_ros.classroom.diagnostics import NOT_READABLE, WORKSHEET_WRITTEN
from mrlab_ros.classroom.journal_file import JournalFile
from mrlab_ros.classroom.marks import gradebook, matching
from mrlab_ros.classroom.marks.exports import Roster, Submission
from mrlab_ros.classroom.marks.graded import Student
from mrlab_ros.classroom.marks.journal import Entry, State
from mrlab_ros.classroom.marks.matching import Person, Unmatched
from mrlab_ros.core.base.diagnostic import Diagnostic
from mrlab_ros.core.base.errors import BadInput


@dataclass(frozen=True)
class Decisions:
    """What a teacher decides with a run. matches: what was not matched, and who it is; accepts:
    all proposals hold."""

    matches: tuple[tuple[str, str], ...] = ()
    accepts: bool = False


@dataclass(frozen=True)
class Matched:
    """Who handed in what. key_table: the file that says who is who, None: names are shown.
    places: identifier of a row of the table, by key. unmatched, rows: what a teacher has to
    decide, and rows that nobody has, as the folder may show them; missing: who is in no row, where
    the folder may not."""

    roster: Roster
    key_table: Path | None
    places: Mapping[str, str]
    unmatched: tuple[Unmatched, ...]
    rows: tuple[Person, ...]
    missing: tuple[Diagnostic, ...] = ()


def sheet_of(template: Path | None, title: str) -> gradebook.Sheet | None:
    """Read the table of a platform, None: there is none; raise BadInput where it is no such table.

    title: of the rubric.
    """
    if template is None:
        return None
    try:
        text = template.read_bytes().decode("utf-8")
    except (OSError, UnicodeDecodeError) as error:
        raise BadInput(NOT_READABLE(file=str(template), why=str(error))) from None
    return gradebook.Sheet(text, template.name, title)


def fill(
    sheet: gradebook.Sheet, students: Sequence[Student], places: Mapping[str, str], out: Path
) -> list[Diagnostic]:
    """Write the table of a platform with the grades; return what its teacher has to know."""
    text, problems = sheet.filled(students, places)
    write_text(out, text)
    return [WORKSHEET_WRITTEN(file=str(out)), *problems]


def matched(
    roster: Roster,
    sheet: gradebook.Sheet | None,
    state: State,
    journal: JournalFile,
    decisions: Decisions,
    hidden: pseudonyms.Pseudonyms | None = None,
) -> Matched:
    """Match files and rows with students, and keep what is decided now. Raises BadInput.

    hidden: the roster without names; then files alone can be decided about.
    """
    found = _found(roster, sheet, state, hidden)
    if decisions.matches or decisions.accepts:
        now, who = time.time(), getpass.getuser()
        rows = sheet.people if sheet is not None and hidden is None else ()
        made = matching.decided(
            found.unmatched, state.owners, _people(found.roster, hidden), rows,
            decisions.matches, accepts=decisions.accepts,
        )  # fmt: skip
        new = [Entry(now, who, did, key, text=text) for did, key, text in made]
        found = _found(roster, sheet, journal.append(lambda _: new), hidden)
    return found


def _found(
    roster: Roster,
    sheet: gradebook.Sheet | None,
    state: State,
    hidden: pseudonyms.Pseudonyms | None,
) -> Matched:
    rows = sheet.people if sheet is not None else ()
    label: Callable[[str], str] = hidden.label if hidden is not None else str
    own = matching.assigned(roster, state.owners, () if hidden else rows, label)
    # the table has names, so rows are found by them
    real = [replace(_real(s, hidden), key=s.key) for s in own.submissions]
    places, missing = matching.enrolled(real, rows, state.rows) if sheet is not None else ({}, [])
    taken = set(places.values())
    free = tuple(row for row in rows if row.identifier not in taken)
    people: Sequence[Person] = _people(own, hidden)
    if hidden is not None:
        files, rest = matching.files(own.left_out, state.owners, people, label)
        own = replace(own, left_out=rest)
        why = tuple(each.why for each in missing)
        return Matched(own, hidden.key_table, places, tuple(files), (), why)
    files, rest = matching.files(own.left_out, state.owners, [*people, *free])
    own = replace(own, left_out=rest)
    return Matched(own, None, places, (*files, *missing), free)


def _real(submission: Submission, hidden: pseudonyms.Pseudonyms | None) -> Submission:
    return submission if hidden is None else hidden.who.get(submission.name, submission)


def _people(roster: Roster, hidden: pseudonyms.Pseudonyms | None) -> list[Person]:
    """Return who handed in something, by name; shown as the folder may show them."""
    found = []
    for one in roster.submissions:
        real = _real(one, hidden)
        found.append(Person(one.key, real.name, real.identifier, one.name))
    return found
