"""The work of `mrlab class`: read the export, check what is missing, write pages and tables."""

from __future__ import annotations

import functools
import getpass
import json
import os
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field, replace
from pathlib import Path, PurePosixPath
from typing import Any

import orjson
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn

from mrlab_ros.adapters import share
from mrlab_ros.app.check import cell
from mrlab_ros.app.check.file import CELLS
from mrlab_ros.app.convert import SUFFIXES
from mrlab_ros.classroom import grader, pseudonyms, who, words, worker
from mrlab_ros.classroom.diagnostics import (
    NO_SUBMISSIONS,
    PROCESSES_KILLED,
    REFERENCE_APART,
    REFERENCE_NOT_READ,
    STOPPED,
    UNKNOWN_FORM,
)
from mrlab_ros.classroom.folder import (
    CHANGES,
    CLASS,
    EVIDENCE,
    FEEDBACK,
    INDEX,
    KEPT,
    PAGES,
    RESULTS,
    TABLE,
    TRAJECTORIES,
    ResultsFolder,
)
from mrlab_ros.classroom.journal_file import JournalFile
from mrlab_ros.classroom.marks import changes, gradebook
from mrlab_ros.classroom.marks.diagnostics import (
    CLASS_IS_LOCKED,
    MARKS_CHANGED,
    NO_FILE_HANDED_IN,
    UNREADABLE,
)
from mrlab_ros.classroom.marks.exports import (
    FORMS,
    REFERENCE,
    LeftOut,
    Roster,
    Submission,
    file_label,
    recognise,
)
from mrlab_ros.classroom.marks.graded import GradedClass, Student
from mrlab_ros.classroom.marks.journal import MARK, Entry, State
from mrlab_ros.classroom.marks.result import (
    FAILED,
    MARKED,
    NO_FILE,
    REFUSED,
    TO_REPEAT,
    Result,
    without_marks,
)
from mrlab_ros.classroom.page import class_page, with_page
from mrlab_ros.classroom.rubrics.rubric import Rubric
from mrlab_ros.classroom.setup import Bounds, Setup, Task
from mrlab_ros.classroom.submissions import Export
from mrlab_ros.commands import output
from mrlab_ros.core.base.diagnostic import Diagnostic
from mrlab_ros.core.base.errors import BadInput, Misuse
from mrlab_ros.core.conversion.options import Options
from mrlab_ros.core.scene.document import SceneDocument

MOST_CANDIDATES = 8  # files of one student that are tried
ATTEMPTS = 3  # where processes that check were killed
DONE, FAILED_SOME = 0, 1


@dataclass(frozen=True)
class Request:
    """The arguments of the command. jobs: 0: one a processor.

    base: the folder of the class where `out` holds marks that are only proposed; its journal,
    results and evidence are read. final: a locked class is written once more. worksheet: the
    filled template; fills: it is written. progress: told how many are checked, of how many.
    """

    source: Path
    setup: Setup
    out: Path
    jobs: int = 0
    backend: str = "loky"
    scheduler: str = ""
    pseudonyms: bool = False
    as_json: bool = False
    fresh: bool = False
    template: Path | None = None
    form: str = ""
    base: Path | None = None
    final: bool = False
    worksheet: Path | None = None
    fills: bool = True
    decisions: who.Decisions = field(default_factory=who.Decisions)
    progress: Callable[[int, int], None] = lambda done, count: None


@dataclass(frozen=True)
class _Wanted:
    """A submission whose result is not kept yet. digest, checked: under which it will be, and its
    evidence."""

    task: Task
    digest: str
    checked: str


Answer = tuple[tuple[str, str, str], dict[str, bytes]]


def run(request: Request) -> int:
    """Mark a class, say it, and return the exit code; raise LabError where nothing is marked."""
    graded, key_table, problems = marked(request)
    if request.as_json:
        print(json.dumps(graded.document()))
    else:
        words.show(graded, request.out, key_table, problems)
    outcomes = {s.result.outcome for s in graded.students}
    return FAILED_SOME if outcomes & {FAILED, TO_REPEAT} else DONE


def marked(request: Request) -> tuple[GradedClass, Path | None, list[Diagnostic]]:
    """Mark a class and write its folder; return it, the file that says who is who, and what its
    teacher has to know. Raises LabError."""
    rubric = request.setup.rubric
    # What cannot be read leaves no folder.
    with Export(request.source) as export, (folder := ResultsFolder(request.out)).alone():
        roster = recognise(
            export.entries,
            (*SUFFIXES, *CELLS),
            pattern=rubric.files,
            metadata=export.metadata,
            form=request.form,
        )
        unread = (LeftOut(path, why) for path, why in export.problems)
        roster = replace(roster, left_out=(*roster.left_out, *unread))
        if not roster.submissions:
            raise BadInput(NO_SUBMISSIONS(file=str(request.source)))
        state, problems = _state(request, folder)
        sheet = who.sheet_of(request.template, rubric.name)
        hidden = pseudonyms.of_roster(roster, request.out) if request.pseudonyms else None
        matched = who.matched(
            hidden.roster if hidden else roster, sheet, state,
            JournalFile(request.base or request.out), request.decisions, hidden,
        )  # fmt: skip
        roster = matched.roster
        results = _results(request, roster, export, folder, state)
        students = tuple(
            changes.applied(Student(s, results[s.key]), state.columns(s.key), state.comment(s.key))
            for s in roster.submissions
        )
        if count := sum(bool(state.columns(s.key)) for s in students):
            problems.append(MARKS_CHANGED(count=count))
        if request.setup.pages:
            students = tuple(with_page(s, folder, share.directory()) for s in students)
        graded = GradedClass(
            rubric, roster.form, students, roster.left_out, results.get(REFERENCE),
            matched.unmatched, matched.rows,
        )  # fmt: skip
        _write(graded, folder)
        problems += matched.missing
        if sheet is not None and request.fills:
            beside = request.out.with_name(f"{request.out.name}-{sheet.name}")
            place = request.worksheet or beside
            problems += who.fill(sheet, students, matched.places, place)
    return graded, matched.key_table, problems


def form_of(name: str) -> str:
    """Return the form of an export by its name in any case; raise Misuse where it is unknown."""
    known = {each.lower(): each for each in FORMS}
    if name and name.lower() not in known:
        raise Misuse(UNKNOWN_FORM(form=name, known=list(known)))
    return known.get(name.lower(), "")


def of_rubric(
    rubric: Rubric, scene: SceneDocument, options: Options, bounds: Bounds, *, pages: bool
) -> Setup:
    """Return the setup of a rubric, with the bytes of its reference. Raises BadInput."""
    if not rubric.reference:
        return Setup(rubric, scene, options, None, bounds, pages)
    path = Path(rubric.reference)
    reference, *beside = (
        (each.name, _reference(rubric, each)) for each in (path, *_motions(rubric, scene, path))
    )
    return Setup(rubric, scene, options, reference, bounds, pages, tuple(beside))


def _motions(rubric: Rubric, scene: SceneDocument, path: Path) -> list[Path]:
    """Return the motions of a reference that is a cell; raise LabError where one is elsewhere."""
    if path.suffix.lower() not in CELLS:
        return []
    system, placed = cell.read(path, scene, rubric.scene)
    loaded = {robot.name: robot.trajectory for robot in placed.robots}
    names = {member.trajectory or loaded[member.robot] for member in system.members}
    for name in names:
        if "/" in name:
            raise BadInput(REFERENCE_APART(rubric=rubric.origin, file=path.name, motion=name))
    return [path.parent / name for name in sorted(names) if name]


def _reference(rubric: Rubric, path: Path) -> bytes:
    try:
        return path.read_bytes()
    except OSError as error:
        raise BadInput(
            REFERENCE_NOT_READ(rubric=rubric.origin, file=str(path), why=error.strerror)
        ) from None


def _results(
    request: Request, roster: Roster, export: Export, folder: ResultsFolder, state: State
) -> dict[str, Result]:
    """Return the result of each submission by key, of the reference too; what is kept is not
    checked again."""
    results: dict[str, Result] = {}
    missing: dict[str, Submission | None] = {}
    known = _known(request, folder)
    for submission in roster.submissions:
        if not submission.candidates:
            files = None if request.pseudonyms else submission.others
            why = NO_FILE_HANDED_IN(files=files)
            results[submission.key] = without_marks(request.setup.rubric, NO_FILE, why)
        else:
            missing[submission.key] = submission
    if request.setup.reference is not None:
        missing[REFERENCE] = None
    total = len(missing)
    bar = Progress(
        TextColumn("{task.description}"), BarColumn(), MofNCompleteColumn(),
        TimeRemainingColumn(), console=output.console(stderr=True), transient=True,
        disable=request.as_json or not sys.stderr.isatty(),
    )  # fmt: skip
    with bar:
        shown = bar.add_task("Checking", total=total)

        def done(key: str, result: Result) -> None:
            results[key] = result
            missing.pop(key, None)
            bar.update(shown, completed=total - len(missing))
            request.progress(total - len(missing), total)

        for attempt in range(1, ATTEMPTS + 1):
            try:
                _run(request, missing, export, folder, state, known, done)
                break
            except grader.Broken:
                if attempt == ATTEMPTS:
                    raise BadInput(PROCESSES_KILLED(count=ATTEMPTS)) from None
            except KeyboardInterrupt:
                count = total - len(missing)
                output.say_error(str(STOPPED(done=count, all=total)))
                raise
    return results


def _run(
    request: Request,
    missing: dict[str, Submission | None],
    export: Export,
    folder: ResultsFolder,
    state: State,
    known: Any,
    done: Any,
) -> None:
    """Check what is missing, and keep each result when it comes."""
    setup, unread = request.setup, []
    base = folder if request.base is None else ResultsFolder(request.base)

    def wanted() -> Iterator[_Wanted]:
        for key, submission in list(missing.items()):
            try:
                task = _task(key, submission, export, setup, pseudonym=request.pseudonyms)
            except BadInput as error:
                unread.append((key, without_marks(setup.rubric, NO_FILE, error.diagnostic)))
                continue
            if setup.pages:  # which show them
                task = replace(task, changes=state.columns(key), comment=state.comment(key))
            digest, checked = task.digest(setup.digest), task.checked(setup.ground)
            found = known(key, digest)
            if found is not None:
                unread.append((key, found))
                continue
            evidence = b"" if request.fresh else base.evidence(key, checked)
            yield _Wanted(replace(task, evidence=evidence), digest, checked)

    # other machines have no folder of ours
    here = tempfile.TemporaryDirectory(prefix="mrlab-class-", ignore_cleanup_errors=True)
    with here as scratch:
        own = (scratch, os.getpid()) if request.backend == "loky" else ("", 0)
        grade = functools.partial(_graded, setup, *own)
        answers = grader.run(
            grade,
            wanted(),
            jobs=request.jobs,
            backend=request.backend,
            scheduler=request.scheduler,
        )
        try:
            for wanted_one, files in answers:
                done(wanted_one[0], _stored(folder, *wanted_one, files))
                while unread:
                    done(*unread.pop())
        finally:
            grader.close_all()
    while unread:
        done(*unread.pop())


def _graded(setup: Setup, scratch: str, owner: int, wanted: _Wanted) -> Answer:
    """Check one submission, wherever this runs."""
    named = (wanted.task.key, wanted.digest, wanted.checked)
    return named, grader.checked(setup, wanted.task, scratch, owner)


def _task(
    key: str, submission: Submission | None, export: Export, setup: Setup, *, pseudonym: bool
) -> Task:
    """Return the task of a submission with its bytes, None: of the reference."""
    if submission is None:
        return Task(key, setup.references[0][0], setup.references)
    chosen = submission.candidates[:MOST_CANDIDATES]
    names = [file_label(PurePosixPath(entry.path).name) for entry in chosen]
    files: list[tuple[str, bytes]] = []
    problems = []
    for name, entry in zip(names, chosen, strict=True):
        try:
            files.append((name, export.read(entry.path)))
        except BadInput as error:
            problems.append(error)
    if not files and pseudonym and problems[0].diagnostic.values:
        raise BadInput(UNREADABLE())  # the values hold names
    if not files:
        raise problems[0]
    named = tuple(pseudonyms.unnamed(key, files) if pseudonym else files)
    rule = setup.rubric.late
    late = rule.days(submission.handed_in, submission.late) if rule else 0
    return Task(key, submission.name, named, late=late)


def _stored(
    folder: ResultsFolder, key: str, digest: str, checked: str, files: dict[str, bytes]
) -> Result:
    """Write what was found of a submission, the result last; return it."""
    document = orjson.loads(files[worker.RESULT])
    result = Result(**document)
    folder.forget(key)
    if worker.TRAJECTORY in files:
        folder.write(f"{TRAJECTORIES}/{key}.json", files[worker.TRAJECTORY])
    if worker.EVIDENCE in files:
        folder.write(f"{EVIDENCE}/{key}", files[worker.EVIDENCE])
    if worker.PAGE in files:
        folder.write(f"{PAGES}/{key}.html", files[worker.PAGE])
        folder.write(f"{FEEDBACK}/{key}.html", files.get(worker.FEEDBACK, files[worker.PAGE]))
    if result.outcome in (MARKED, REFUSED, NO_FILE):
        folder.keep(key, digest, document, checked)
    return result


def _known(request: Request, folder: ResultsFolder) -> Any:
    """Return what looks up the kept result of a key under a digest, with all files of it there."""

    def known(key: str, digest: str) -> Result | None:
        if request.fresh:
            return None
        document = folder.kept(key, digest)
        if document is None and request.base is not None:
            document = ResultsFolder(request.base).kept(key, digest)
        if document is None:
            return None
        try:
            result = Result(**document)
        except TypeError:
            return None
        if request.base is not None:
            return result
        if request.setup.pages and not result.has_page:
            return None  # it was checked without pages
        there = (not result.has_trajectory or folder.has(f"{TRAJECTORIES}/{key}.json")) and (
            not result.has_page
            or (folder.has(f"{PAGES}/{key}.html") and folder.has(f"{FEEDBACK}/{key}.html"))
        )
        return result if there else None

    return known


def _state(request: Request, folder: ResultsFolder) -> tuple[State, list[Diagnostic]]:
    """Return what teachers did to the marks, in the table too, and cells of it that are not
    taken. Raises BadInput where the class is locked."""
    journal = JournalFile(request.base or request.out)
    state = journal.state()
    if state.locked and not request.final and request.base is None:
        raise BadInput(CLASS_IS_LOCKED(who=state.locked.who))
    kept, table, before = folder.document(CHANGES), folder.content(TABLE), folder.document(CLASS)
    if not table or not before or changes.digest(table) in kept.get("written", ()):
        return state, []
    found, problems = changes.found(table.decode("utf-8", "replace"), before)
    given = {s["key"]: changes.given_of(s) for s in before["students"]}
    now, user = time.time(), getpass.getuser()
    new = [
        # a value that the test gave takes the change back
        Entry(now, user, MARK, key, test, None if points == given[key][test] else points, TABLE)
        for key, columns in found.items()
        for test, points in columns.items()
    ]
    return journal.append(lambda _: new), problems


def _write(graded: GradedClass, folder: ResultsFolder) -> None:
    """Write pages and tables."""
    for student in graded.students:
        if student.result.outcome == TO_REPEAT:
            continue
        name = f"{RESULTS}/{student.key}/results.json"
        folder.write_json(name, gradebook.gradescope(student.result))
    results = {s.key: s.result for s in graded.students}
    folder.tidy(RESULTS, [key for key, r in results.items() if r.outcome != TO_REPEAT])
    if graded.reference is not None:
        results[REFERENCE] = graded.reference
    # what an earlier submission left is nobody's
    pages = [f"{key}.html" for key, r in results.items() if r.has_page]
    folder.tidy(TRAJECTORIES, [f"{key}.json" for key, r in results.items() if r.has_trajectory])
    folder.tidy(PAGES, pages)
    folder.tidy(FEEDBACK, pages)
    folder.tidy(KEPT, [f"{key}.json" for key in results])
    folder.tidy(EVIDENCE, results)
    table = gradebook.table(graded.rubric, graded.students).encode()
    # a kill between these leaves one of two tables that no hand changed
    written = [changes.digest(table)]
    before = [changes.digest(folder.content(TABLE)), *written]
    folder.write_json(CHANGES, {"written": before})
    folder.write(TABLE, table)
    folder.write_json(CLASS, graded.document())
    folder.write_json(CHANGES, {"written": written})
    folder.write(INDEX, class_page(graded, share.directory()).encode())
