"""The work of `mrlab class`: read the export, check what is missing, write pages and tables."""

from __future__ import annotations

import functools
import json
import os
import re
import secrets
import sys
import tempfile
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path, PurePosixPath
from typing import Any

import orjson
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn

from mrlab_ros.adapters import share
from mrlab_ros.app.check import cell
from mrlab_ros.app.check.file import CELLS
from mrlab_ros.app.convert import SUFFIXES
from mrlab_ros.classroom import grader, words, worker
from mrlab_ros.classroom.diagnostics import (
    KEY_TABLE_NOT_READ,
    KEY_TABLE_NOT_WRITTEN,
    NO_SUBMISSIONS,
    PROCESSES_KILLED,
    REFERENCE_APART,
    REFERENCE_NOT_READ,
    STOPPED,
    UNKNOWN_FORM,
    WORKSHEET_FAILED,
    WORKSHEET_WRITTEN,
)
from mrlab_ros.classroom.folder import (
    CHANGES,
    CLASS,
    FEEDBACK,
    INDEX,
    KEPT,
    PAGES,
    RESULTS,
    TABLE,
    TRAJECTORIES,
    ResultsFolder,
)
from mrlab_ros.classroom.marks import changes, gradebook
from mrlab_ros.classroom.marks.diagnostics import MARKS_CHANGED, NO_FILE_HANDED_IN, UNREADABLE
from mrlab_ros.classroom.marks.exports import (
    FORMS,
    REFERENCE,
    Roster,
    Submission,
    file_label,
    recognise,
)
from mrlab_ros.classroom.marks.graded import GradedClass, Student
from mrlab_ros.classroom.marks.result import (
    FAILED,
    MARKED,
    NO_FILE,
    TO_REPEAT,
    Result,
    pseudonymous,
    without_marks,
)
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
    """The arguments of the command. jobs: 0: one a processor."""

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


@dataclass(frozen=True)
class _Wanted:
    """A submission whose result is not kept yet. digest: under which it will be."""

    task: Task
    digest: str


Answer = tuple[str, str, dict[str, bytes]]


def run(request: Request) -> int:
    """Grade a class and return the exit code; raise LabError where nothing can be graded."""
    rubric = request.setup.rubric
    with Export(request.source) as export:
        roster = recognise(
            export.entries,
            (*SUFFIXES, *CELLS),
            pattern=rubric.files,
            metadata=export.metadata,
            form=request.form,
        )
        left_out = (*roster.left_out, *export.problems)
        roster = replace(roster, left_out=left_out)
        if not roster.submissions:
            raise BadInput(NO_SUBMISSIONS(file=str(request.source)))
        folder = ResultsFolder(request.out)
        key_table, who = None, dict[str, Submission]()
        if request.pseudonyms:
            roster, key_table, who = _pseudonyms(roster, request.out)
        results = _results(request, roster, export, folder)
    students = tuple(Student(s, results[s.key]) for s in roster.submissions)
    changed, problems = _changes(folder, students)
    students = tuple(changes.applied(s, changed.get(s.key, {})) for s in students)
    graded = GradedClass(rubric, roster.form, students, roster.left_out, results.get(REFERENCE))
    _write(graded, folder, changed)
    if request.template is not None:  # it has names, so it is filled by them
        named = [Student(who.get(s.submission.name, s.submission), s.result) for s in students]
        problems += _fill(request, named, request.template)
    document = graded.document()
    if request.as_json:
        print(json.dumps(document))
    else:
        words.show(graded, request.out, key_table, problems)
    return FAILED_SOME if any(s.result.outcome in (FAILED, TO_REPEAT) for s in students) else DONE


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
    request: Request, roster: Roster, export: Export, folder: ResultsFolder
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

        for attempt in range(1, ATTEMPTS + 1):
            try:
                _run(request, missing, export, folder, known, done)
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
    known: Any,
    done: Any,
) -> None:
    """Check what is missing, and keep each result when it comes."""
    setup, unread = request.setup, []

    def wanted() -> Iterator[_Wanted]:
        for key, submission in list(missing.items()):
            try:
                task = _task(key, submission, export, setup, pseudonym=request.pseudonyms)
            except BadInput as error:
                unread.append((key, without_marks(setup.rubric, NO_FILE, error.diagnostic)))
                continue
            digest = task.digest(setup.digest)
            found = known(key, digest)
            if found is not None:
                unread.append((key, found))
                continue
            yield _Wanted(task, digest)

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
            for key, digest, files in answers:
                done(key, _stored(folder, key, digest, files))
                while unread:
                    done(*unread.pop())
        finally:
            grader.close_all()
    while unread:
        done(*unread.pop())


def _graded(setup: Setup, scratch: str, owner: int, wanted: _Wanted) -> Answer:
    """Check one submission, wherever this runs."""
    return wanted.task.key, wanted.digest, grader.checked(setup, wanted.task, scratch, owner)


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
    return Task(key, submission.name, tuple(_unnamed(key, files) if pseudonym else files))


def _unnamed(key: str, files: Sequence[tuple[str, bytes]]) -> list[tuple[str, bytes]]:
    """Return files under names that say nothing; a cell names its motions by them."""
    names = {
        name: f"{key}-{n}{_ending(name)}" if n > 1 else f"{key}{_ending(name)}"
        for n, (name, _) in enumerate(files, 1)
    }
    if not any(name.lower().endswith(CELLS) for name in names):
        return [(names[name], content) for name, content in files]
    longest = sorted(names, key=len, reverse=True)
    known = re.compile(b"|".join(re.escape(name.encode()) for name in longest))
    return [
        (
            names[name],
            known.sub(lambda found: names[found[0].decode()].encode(), content)
            if name.lower().endswith(CELLS)
            else content,
        )
        for name, content in files
    ]


def _ending(name: str) -> str:
    return next(
        (s for s in sorted(SUFFIXES, key=len, reverse=True) if name.lower().endswith(s)), ""
    )


def _stored(folder: ResultsFolder, key: str, digest: str, files: dict[str, bytes]) -> Result:
    """Write what was found of a submission, the result last; return it."""
    document = orjson.loads(files[worker.RESULT])
    result = Result(**document)
    folder.forget(key)
    if worker.TRAJECTORY in files:
        folder.write(f"{TRAJECTORIES}/{key}.json", files[worker.TRAJECTORY])
    if worker.PAGE in files:
        folder.write(f"{PAGES}/{key}.html", files[worker.PAGE])
        folder.write(f"{FEEDBACK}/{key}.html", files.get(worker.FEEDBACK, files[worker.PAGE]))
    if result.outcome in (MARKED, NO_FILE):
        folder.keep(key, digest, document)
    return result


def _known(request: Request, folder: ResultsFolder) -> Any:
    """Return what looks up the kept result of a key under a digest, with all files of it there."""

    def known(key: str, digest: str) -> Result | None:
        document = None if request.fresh else folder.kept(key, digest)
        if document is None:
            return None
        try:
            result = Result(**document)
        except TypeError:
            return None
        if request.setup.pages and result.has_trajectory and not result.has_page:
            return None  # it was checked without pages
        there = (not result.has_trajectory or folder.has(f"{TRAJECTORIES}/{key}.json")) and (
            not result.has_page
            or (folder.has(f"{PAGES}/{key}.html") and folder.has(f"{FEEDBACK}/{key}.html"))
        )
        return result if there else None

    return known


def _changes(
    folder: ResultsFolder, students: Sequence[Student]
) -> tuple[dict[str, dict[str, float]], list[Diagnostic]]:
    """Return the marks that were changed by hand, now or before, and what cannot be read."""
    kept, table = folder.document(CHANGES), folder.content(TABLE)
    new: dict[str, dict[str, float]] = {}
    problems: list[Diagnostic] = []
    before = folder.document(CLASS)
    if table and before and changes.digest(table) not in kept.get("written", ()):
        new, problems = changes.found(table.decode("utf-8", "replace"), before)
    every = changes.merged(kept.get("changes", {}), new, students)
    if every:
        problems.append(MARKS_CHANGED(count=len(every)))
    return every, problems


def _write(graded: GradedClass, folder: ResultsFolder, changed: Mapping[str, Any]) -> None:
    """Write pages and tables."""
    from mrlab_ros.classroom.page import class_page

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
    table = gradebook.table(graded.rubric, graded.students).encode()
    # a kill between these leaves one of two tables that no hand changed
    written = [changes.digest(table)]
    before = [changes.digest(folder.content(TABLE)), *written]
    folder.write_json(CHANGES, {"written": before, "changes": changed})
    folder.write(TABLE, table)
    folder.write_json(CLASS, graded.document())
    folder.write_json(CHANGES, {"written": written, "changes": changed})
    folder.write(INDEX, class_page(graded, share.directory()).encode())


def _fill(request: Request, students: Sequence[Student], template: Path) -> list[Diagnostic]:
    """Write Moodle's worksheet with the grades beside the folder of the class."""
    out = request.out.with_name(f"{request.out.name}-{template.name}")
    try:
        content = template.read_bytes().decode("utf-8")
        text, problems = gradebook.filled(content, students, template.name)
        out.write_text(text, encoding="utf-8", newline="")
    except (OSError, UnicodeDecodeError) as error:
        raise BadInput(
            WORKSHEET_FAILED(file=str(template), out=str(out), why=str(error))
        ) from None
    return [WORKSHEET_WRITTEN(file=str(out)), *problems]


def _pseudonyms(roster: Roster, out: Path) -> tuple[Roster, Path, dict[str, Submission]]:
    """Return the roster without names, the file beside the class that says who is who, and who."""
    path = out.with_name(f"{out.name}-names.json")
    try:
        known = json.loads(path.read_text(encoding="utf-8")) if path.exists() else {}
        secret = bytes.fromhex(known["secret"]) if known else secrets.token_bytes(32)
    except (OSError, ValueError, LookupError, TypeError) as error:
        raise BadInput(KEY_TABLE_NOT_READ(file=str(path), why=str(error))) from None
    changed, who = pseudonymous(roster, secret)
    students = {
        name: {"name": s.name, "identifier": s.identifier, "email": s.email, "folder": s.folder}
        for name, s in who.items()
    }
    content = {"secret": secret.hex(), "students": {**known.get("students", {}), **students}}
    try:
        written = path.with_name(f".{path.name}-writing")
        descriptor = os.open(written, os.O_WRONLY | os.O_CREAT | os.O_TRUNC, 0o600)
        with os.fdopen(descriptor, "wb") as file:
            file.write(orjson.dumps(content, option=orjson.OPT_INDENT_2))
        os.replace(written, path)
    except OSError as error:
        raise BadInput(KEY_TABLE_NOT_WRITTEN(file=str(path), why=error.strerror)) from None
    return changed, path, who
