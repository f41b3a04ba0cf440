"""Students and their files: the exports of Moodle, ILIAS, Canvas and Gradescope, or a folder."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import PurePosixPath
from typing import Any

from mrlab_ros.classroom.marks.diagnostics import (
    NEWEST_TAKEN,
    NO_MOTION_FILE,
    NONE_NAMED_SO,
    NOT_NAMED_AS_BY,
    SENDER_NOT_NAMED,
    TEXT_NOT_READ,
)
from mrlab_ros.classroom.rubrics.late import instant
from mrlab_ros.core.base.diagnostic import Diagnostic
from mrlab_ros.core.base.foreign_text import visible
from mrlab_ros.core.base.names import without_accents

MOODLE = re.compile(
    r"(?P<name>.+)_(?P<id>\d+)_assignsubmission_(?P<kind>file|onlinetext|comments)(_(?P<file>.*))?",
    re.DOTALL,
)
ILIAS = re.compile(r"(?P<last>[^_]+)_(?P<first>[^_]+)_(?P<login>.+)_(?P<id>\d+)")
CANVAS = re.compile(
    r"(?P<name>[^\W_]([^\W_]|-)*)_(?P<late>LATE_)?(?P<id>\d+)_"
    r"(?:(?P<submission>\d+)_(?P<file>.+)|(?P<text>text)\.html)",
    re.IGNORECASE | re.DOTALL,
)
GRADESCOPE = re.compile(r"submission_(?P<id>\d+)")
# What students handed in on the page, for a course that is connected.
COURSE = re.compile(r"handed_in_(?P<id>\d+)")
METADATA = "submission_metadata.yml"
# Canvas and browsers number the attempts: motion-1.mat, motion (2).mat
ATTEMPT = re.compile(r"(?:-| ?\()(\d{1,2})\)?$")
JUNK = re.compile(r"(^|/)(__MACOSX/|\._|\.DS_Store$|Thumbs\.db$|desktop\.ini$)", re.IGNORECASE)
ARCHIVE = ".zip"
MOST_KEY, MOST_NAME = 60, 200  # characters
REFERENCE = "reference"  # the key of the solution, which no student has
FOLDER, MOODLE_FORM, GRADESCOPE_FORM, CANVAS_FORM, ILIAS_FORM, COURSE_FORM = FORMS = (
    "folder", "Moodle", "Gradescope", "Canvas", "ILIAS", "course",
)  # fmt: skip
# ILIAS has all submissions in a folder of this name.
SUBMISSIONS = {"abgaben", "submissions"}


@dataclass(frozen=True)
class Entry:
    """A file of an export. path: with /, from its top; modified: sortable, newest last."""

    path: str
    size: int = 0
    modified: tuple[int, ...] = ()


@dataclass(frozen=True)
class Submission:
    """The submission of one student.

    key: a file name of its own for this student, stable for the same export. identifier: the
    number by which the system knows the student or the submission, or empty. handed_in: s since
    1970, None: the export does not say it. folder: how the
    export names it, for feedback that is sent back. candidates: files that may hold the motion,
    the first to be tried first. notes: what a teacher shall know.
    """

    key: str
    name: str
    form: str
    identifier: str = ""
    folder: str = ""
    email: str = ""
    late: bool = False
    handed_in: float | None = None
    candidates: tuple[Entry, ...] = ()
    others: tuple[str, ...] = ()
    notes: tuple[Diagnostic, ...] = ()

    @property
    def sent(self) -> str:
        """Return the name of the file, by which Canvas takes feedback; empty for a pseudonym."""
        names = [PurePosixPath(e.path).name for e in self.candidates if self.identifier]
        named = (name for name in names if self.form != CANVAS_FORM or CANVAS.fullmatch(name))
        return next(named, "")


@dataclass(frozen=True)
class LeftOut:
    """A file that belongs to nobody. entry: it may hold a motion of somebody; None: it is no such
    file."""

    path: str
    why: Diagnostic
    entry: Entry | None = None


@dataclass(frozen=True)
class Roster:
    """All submissions of an export, by name, and what belongs to nobody."""

    form: str
    submissions: tuple[Submission, ...]
    left_out: tuple[LeftOut, ...] = ()


@dataclass
class _Found:
    name: str
    identifier: str
    folder: str
    late: bool = False
    files: list[tuple[Entry, str]] = field(default_factory=list)
    notes: list[Diagnostic] = field(default_factory=list)
    text: bool = False
    email: str = ""
    handed_in: float | None = None


def recognise(
    entries: Iterable[Entry],
    suffixes: Sequence[str],
    *,
    pattern: str = "",
    metadata: Mapping[str, Any] | None = None,
    form: str = "",
) -> Roster:
    """Return who handed in what.

    suffixes: endings of files that may hold a motion. pattern: a file name pattern such as
    "motion*.mat", which decides among several. metadata: the content of submission_metadata.yml,
    of Gradescope or of a course; people of a course who sent nothing have a row. form: one of
    FORMS; empty: the one that most paths have.
    """
    kept, left_out = [], []
    for entry in sorted(entries, key=lambda e: e.path):
        if JUNK.search(entry.path):
            continue
        if PurePosixPath(entry.path).name == METADATA:
            continue
        kept.append(entry)
    form = form or _form(kept)
    students: dict[tuple[str, str], _Found] = {}
    top = _wrapper(kept, suffixes) if form == FOLDER else 0
    for entry in kept:
        parts = PurePosixPath(entry.path).parts
        found = _plain(parts[top:], suffixes) if form == FOLDER else _named(parts, form)
        if found is None:
            why = NO_MOTION_FILE() if form == FOLDER else NOT_NAMED_AS_BY(form=form)
            may = entry if _ending(entry.path, suffixes) else None
            left_out.append(LeftOut(entry.path, why, may))
            continue
        one, rest = found
        known = students.setdefault((one.name, one.identifier), one)
        known.late |= one.late
        known.text |= one.text
        if not one.text:
            known.files.append((entry, rest))
    if form == COURSE_FORM:
        here = {found.folder for found in students.values()}
        for name in map(str, metadata or ()):
            if name not in here and (match := COURSE.fullmatch(name)):
                students[name, match["id"]] = _Found(name, match["id"], name)
    if form in (GRADESCOPE_FORM, COURSE_FORM):
        _names_of_metadata(students, metadata or {})
    ordered = sorted(students.values(), key=lambda s: (s.name.casefold(), s.identifier))
    taken = {REFERENCE}
    submissions = tuple(_submission(s, form, suffixes, pattern, taken) for s in ordered)
    return Roster(form, submissions, tuple(left_out))


def renamed(submission: Submission, name: str, key: str) -> Submission:
    """Return a submission that says nothing of who handed it in."""
    count = len(submission.candidates)
    notes = (NEWEST_TAKEN(count=count),) if count > 1 else ()
    return replace(
        submission, key=key, name=name, identifier="", folder=key, email="", others=(), notes=notes
    )


def file_label(name: str) -> str:
    """Return the name of a file in which nothing acts, as every file system takes it."""
    shown = visible(name).replace("\\", "_")
    if len(shown.encode()) <= MOST_NAME:
        return shown
    stem, _, ending = shown.rpartition(".")
    ending = f".{ending[:20]}" if stem else ""
    return shown.encode()[: MOST_NAME - len(ending.encode())].decode("utf-8", "ignore") + ending


def slug(text: str) -> str:
    """Return a text as a file name that every system takes: a-z, 0-9 and -."""
    ascii_only = without_accents(text).encode("ascii", "ignore").decode().lower()
    return re.sub(r"[^a-z0-9]+", "-", ascii_only).strip("-")[:MOST_KEY]


def _form(entries: Sequence[Entry]) -> str:
    """Return the form that at least half of the files have; a folder's where none has."""
    paths = [PurePosixPath(entry.path).parts for entry in entries]
    counts = {
        MOODLE_FORM: sum(any(map(MOODLE.fullmatch, parts)) for parts in paths),
        GRADESCOPE_FORM: sum(any(map(GRADESCOPE.fullmatch, parts[:-1])) for parts in paths),
        COURSE_FORM: sum(any(map(COURSE.fullmatch, parts[:-1])) for parts in paths),
        CANVAS_FORM: sum(any(map(CANVAS.fullmatch, parts)) for parts in paths),
        ILIAS_FORM: _of_ilias(paths),
    }
    best = max(counts, key=lambda form: counts[form])
    return best if counts[best] and 2 * counts[best] >= len(paths) else FOLDER


def _of_ilias(paths: Sequence[Sequence[str]]) -> int:
    """Return how many files lie in a folder of ILIAS.

    A folder such as my_robot_lab_2 has that form too: either it lies in the folder of all
    submissions, or there are others beside it and all have the form.
    """
    beside: dict[tuple[str, ...], Counter[str]] = {}
    for parts in paths:
        for depth, part in enumerate(parts[:-1]):
            beside.setdefault(tuple(parts[:depth]), Counter())[part] += 1
    return max(
        (
            sum(files.values())
            for above, files in beside.items()
            if all(map(ILIAS.fullmatch, files))
            and (len(files) > 1 or (above and above[-1].lower() in SUBMISSIONS))
        ),
        default=0,
    )


def _named(parts: Sequence[str], form: str) -> tuple[_Found, str] | None:
    """Return the student of a path in an export, and the file's name without the student's."""
    for number, part in enumerate(parts):
        rest = "/".join(parts[number + 1 :])
        if form == MOODLE_FORM and (match := MOODLE.fullmatch(part)):
            name, within = match["name"].replace("_", " "), match["file"] or ""
            file = "/".join(each for each in (within, rest) if each)
            text = match["kind"] != "file"
            return _Found(name, match["id"], part if rest else "", text=text), file
        if form == ILIAS_FORM and rest and (match := ILIAS.fullmatch(part)):
            name = f"{match['first']} {match['last']}"
            return _Found(name, match["login"], part), rest
        if form == CANVAS_FORM and (match := CANVAS.fullmatch(part)):
            file = "/".join(each for each in (match["file"], rest) if each)
            late, text = bool(match["late"]), bool(match["text"])
            return _Found(match["name"], match["id"], "", late, text=text), file
        pattern = {GRADESCOPE_FORM: GRADESCOPE, COURSE_FORM: COURSE}.get(form)
        if pattern and rest and (match := pattern.fullmatch(part)):
            return _Found(part, match["id"], part), rest
    return None


def _plain(parts: Sequence[str], suffixes: Sequence[str]) -> tuple[_Found, str] | None:
    if not parts:
        return None
    if len(parts) > 1:
        name = parts[0].removesuffix(ARCHIVE)
        return _Found(name, "", parts[0]), "/".join(parts[1:])
    ending = _ending(parts[0], suffixes)
    if not ending:
        return None
    return _Found(parts[0][: -len(ending)] or parts[0], "", ""), parts[0]


def _wrapper(entries: Sequence[Entry], suffixes: Sequence[str]) -> int:
    """Return how many folders are around all motions and are no student's; a folder with one
    motion, or with numbered attempts at one, is a student's."""
    depth = 0
    every = [PurePosixPath(e.path).parts for e in entries]
    paths = [parts for parts in every if _ending(parts[-1], suffixes)] or every
    if len({(*parts[:-1], _attempt(parts[-1], suffixes)[0]) for parts in paths}) == 1:
        return 0
    while paths and min(map(len, paths)) > depth + 1:
        if len({parts[depth] for parts in paths}) != 1 or paths[0][depth].endswith(ARCHIVE):
            break
        depth += 1
    return depth


def _names_of_metadata(
    students: Mapping[tuple[str, str], _Found], metadata: Mapping[str, Any]
) -> None:
    for found in students.values():
        about = metadata.get(found.folder)
        submitters = about.get(":submitters") if isinstance(about, Mapping) else None
        people = [p for p in submitters or () if isinstance(p, Mapping)]
        if not people:
            found.notes.append(SENDER_NOT_NAMED(file=METADATA, folder=found.folder))
            continue
        found.handed_in = instant(str(about.get(":created_at", ""))) if about else None
        found.name = ", ".join(str(p.get(":name") or "?") for p in people)
        found.identifier = ", ".join(str(p[":sid"]) for p in people if p.get(":sid"))
        found.email = ", ".join(str(p[":email"]) for p in people if p.get(":email"))


def _submission(
    found: _Found, form: str, suffixes: Sequence[str], pattern: str, taken: set[str]
) -> Submission:
    key = slug(f"{found.name} {found.identifier}") or "student"
    base, number = key, 1
    while key in taken:
        number += 1
        key = f"{base}-{number}"
    taken.add(key)
    can: list[tuple[Entry, str]] = []
    cannot: list[tuple[Entry, str]] = []
    for entry, name in found.files:
        (can if _ending(name, suffixes) else cannot).append((entry, name))
    notes = list(found.notes)
    name = visible(found.name)[:MOST_NAME]
    if found.text:
        notes.append(TEXT_NOT_READ())
    matching = [each for each in can if pattern and PurePosixPath(each[1]).match(pattern)]
    if pattern and can and not matching:
        notes.append(NONE_NAMED_SO(pattern=pattern))
    chosen = matching or can
    tries = [_attempt(name, suffixes) for _, name in chosen]
    counted = len({stem for stem, _ in tries}) == 1  # attempts at one file, numbered
    newest = sorted(
        zip(chosen, tries, strict=True),
        key=lambda each: (each[1][1] * counted, each[0][0].modified, each[0][1]),
        reverse=True,
    )
    chosen = [each for each, _ in newest]
    if len(can) > 1:
        names = [name for _, name in chosen]
        rule = pattern if matching and len(matching) < len(can) else None
        notes.append(NEWEST_TAKEN(count=len(can), pattern=rule, files=names))
    return Submission(
        key, name, form, found.identifier, found.folder, found.email, found.late, found.handed_in,
        tuple(entry for entry, _ in chosen), tuple(name for _, name in cannot), tuple(notes),
    )  # fmt: skip


def _ending(name: str, suffixes: Sequence[str]) -> str:
    lower = name.lower()
    return max((s for s in suffixes if lower.endswith(s)), key=len, default="")


def _attempt(name: str, suffixes: Sequence[str]) -> tuple[str, int]:
    """Return a name without the number of its attempt, and that number, 0 without."""
    stem = name[: -len(_ending(name, suffixes)) or None]
    match = ATTEMPT.search(stem)
    return (stem[: match.start()], int(match[1])) if match else (stem, 0)
