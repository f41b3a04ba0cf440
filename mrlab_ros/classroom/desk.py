"""The desk at which a class is marked: its sources, its runs, and what is done to its marks."""

from __future__ import annotations

import asyncio
import contextlib
import json
import os
import shutil
import signal
import tempfile
import time
import zipfile
from asyncio.subprocess import DEVNULL, PIPE
from collections.abc import AsyncIterator, Mapping
from dataclasses import dataclass
from pathlib import Path, PurePosixPath
from typing import Any

from mrlab_ros.adapters.sandbox import python_process
from mrlab_ros.adapters.workspaces.content import cause
from mrlab_ros.classroom import job
from mrlab_ros.classroom.diagnostics import (
    CLASS_RUN_ENDED,
    CLASS_RUNS,
    NO_WORKSHEET_GIVEN,
    NOT_RELEASED,
    NOTHING_PROPOSED,
    SOURCE_NAME,
    SOURCE_TOO_LARGE,
    SOURCES_MISSING,
)
from mrlab_ros.classroom.folder import BEFORE, CLASS, FEEDBACK, HELD, PROPOSED, SOURCES
from mrlab_ros.classroom.journal_file import JournalFile
from mrlab_ros.classroom.mark import read_rubric
from mrlab_ros.classroom.marks import changes, gradebook
from mrlab_ros.classroom.marks.diagnostics import NOTHING_TO_UNDO
from mrlab_ros.classroom.marks.exports import CANVAS_FORM, MOODLE_FORM
from mrlab_ros.classroom.marks.journal import (
    ADOPT,
    ASSIGN,
    RELEASE,
    TAKE_BACK,
    Entry,
    State,
    refusal,
)
from mrlab_ros.classroom.shown import ClassFolder
from mrlab_ros.classroom.who import sheet_of
from mrlab_ros.core.base.diagnostic import Diagnostic, from_plain
from mrlab_ros.core.base.errors import BadInput, LabError

MiB = 1 << 20
LARGEST = {job.EXPORT: 1024 * MiB, job.RUBRIC: MiB, job.SHEET: 16 * MiB}
LARGEST_OTHER = 256 * MiB
BESIDE = (".mat", ".json", ".csv", ".npz", ".yaml", ".yml", ".m", ".txt", ".mcap")
FORM = "form"  # the file that keeps the form of the export, where it was said


@dataclass
class Run:
    """A run of the class. how: as `job` takes it; who: started it; problem: why it failed;
    notes: what its teacher has to know."""

    how: str
    who: str
    done: int = 0
    all: int = 0
    running: bool = True
    stopped: bool = False
    problem: Diagnostic | None = None
    notes: tuple[Diagnostic, ...] = ()


class Desk:
    """The desk of one class; its runs belong to one event loop."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.graded = ClassFolder(folder)
        self.journal = JournalFile(folder)
        self.run: Run | None = None
        self._work: asyncio.Task[None] | None = None
        self._process: asyncio.subprocess.Process | None = None

    # sources

    def sources(self) -> list[tuple[str, int]]:
        """Return names and sizes, bytes, of the files that the next run reads."""
        with contextlib.suppress(FileNotFoundError):
            files = sorted((self.folder / SOURCES).iterdir())
            return [(f.name, f.stat().st_size) for f in files if f.name != FORM]
        return []

    @property
    def export(self) -> Path:
        """Return the place of the export that the next run marks."""
        return self.folder / SOURCES / job.EXPORT

    @property
    def has_before(self) -> bool:
        """Return whether the marks of the run before can hold again."""
        return (self.folder / BEFORE).exists()

    def missing(self) -> list[str]:
        """Return the files that the rubric names and that are not there. Raises BadInput."""
        path = self.folder / SOURCES / job.RUBRIC
        if not path.exists():
            return []
        rubric = read_rubric(path, beside=True)
        reference = Path(rubric.reference)
        return [reference.name] if rubric.reference and not reference.exists() else []

    def form(self, place: str = SOURCES) -> str:
        """Return the form of the export that was said, empty: it is recognised."""
        with contextlib.suppress(OSError):
            return (self.folder / place / FORM).read_text()
        return ""

    async def take(self, name: str, body: AsyncIterator[bytes]) -> None:
        """Take a file for the next run, in place of one of its name. Raises BadInput."""
        if name not in LARGEST:
            check_name(name)
        most = LARGEST.get(name, LARGEST_OTHER)
        folder = self.folder / SOURCES
        folder.mkdir(parents=True, exist_ok=True)
        async with taken(body, folder.parent, name, most) as path:
            if name == job.RUBRIC:
                await asyncio.to_thread(read_rubric, path, beside=True)
            if name == job.SHEET:
                await asyncio.to_thread(self._check_sheet, path)
            os.replace(path, folder / name)

    def _check_sheet(self, path: Path) -> None:
        """Raise BadInput where a file is no platform's table."""
        rubric = self.folder / SOURCES / job.RUBRIC
        sheet_of(path, read_rubric(rubric).name if rubric.exists() else "")

    # runs

    async def start(self, how: str, who: str, form: str | None = None) -> None:
        """Begin a run; the first one of a class holds at once. Raises BadInput."""
        if self.run is not None and self.run.running:
            raise BadInput(CLASS_RUNS(folder=self.folder.name))
        there = {name for name, _ in self.sources()}
        for name, what in ((job.EXPORT, "export"), (job.RUBRIC, "rubric")):
            if name not in there and how not in (job.FINAL, job.BACK):
                raise BadInput(SOURCES_MISSING(what=what))
        if how == job.HOLD and not (self.folder / PROPOSED / CLASS).exists():
            raise BadInput(NOTHING_PROPOSED())
        if how == job.BACK and not self.has_before:
            raise BadInput(NOTHING_TO_UNDO())
        if how == job.PROPOSE and not (self.folder / CLASS).exists():
            how = job.HOLD
        if form is not None:
            (self.folder / SOURCES / FORM).write_text(form)
        self.run = Run(how, who)
        self._work = asyncio.create_task(self._follow(self.run))

    async def stop(self) -> None:
        """End the run; what it has checked is kept."""
        if self.run is not None and self._process is not None and self._process.returncode is None:
            self.run.stopped = True
            with contextlib.suppress(ProcessLookupError):
                os.killpg(self._process.pid, signal.SIGINT)
        if self._work is not None:
            await asyncio.wait([self._work], timeout=10)

    async def discard(self) -> None:
        """Take back proposed marks, and the sources that they come from."""
        await self.stop()
        await asyncio.to_thread(self._discard)

    def _discard(self) -> None:
        shutil.rmtree(self.folder / PROPOSED, ignore_errors=True)
        if (self.folder / HELD).exists():
            job.hold(self.folder / HELD, self.folder / SOURCES)
        self.run = None

    async def _follow(self, run: Run) -> None:
        command = python_process.command(
            job.__name__, str(self.folder.absolute()), run.how,
            self.form(BEFORE if run.how == job.BACK else SOURCES),
        )  # fmt: skip
        environment = {**os.environ, "PYTHONPATH": python_process.search_path()}
        ended = False
        try:
            self._process = process = await asyncio.create_subprocess_exec(
                *command, stdin=DEVNULL, stdout=PIPE, stderr=DEVNULL, env=environment,
                start_new_session=True,
            )  # fmt: skip
            assert process.stdout is not None
            async for line in process.stdout:
                told = json.loads(line)
                ended = ended or "ended" in told
                run.done, run.all = told.get("done", run.done), told.get("all", run.all)
                run.notes = tuple(map(from_plain, told.get("notes", ())))
                if "problem" in told:
                    run.problem = from_plain(told["problem"])
            status = await process.wait()
            if not ended and run.problem is None and not run.stopped:
                run.problem = CLASS_RUN_ENDED(why=cause(status or 1))
            if ended and run.how != job.PROPOSE:
                did = {job.FINAL: RELEASE, job.BACK: TAKE_BACK}.get(run.how, ADOPT)
                await asyncio.to_thread(self.act, Entry(time.time(), run.who, did))
        except LabError as error:
            run.problem = error.diagnostic
        finally:
            run.running = False

    # marks

    def act(self, entry: Entry) -> State:
        """Write an act into the journal; raise BadInput where it cannot be done."""

        def made(state: State) -> list[Entry]:
            if entry.did not in (ADOPT, TAKE_BACK) and (
                why := refusal(state, entry, self.points(state))
            ):
                raise BadInput(why)
            return [entry]

        if entry.key and entry.did != ASSIGN:  # a file may be of somebody who is not in the class
            student = self.graded.entry(entry.key)
            if entry.points is not None and (
                out := changes.out_of_range(student, entry.test, entry.points)
            ):
                raise BadInput(out)
        return self.journal.append(made)

    def check(self, entry: Entry) -> None:
        """Raise BadInput where an act cannot be done."""
        state = self.journal.state()
        if why := refusal(state, entry, self.points(state)):
            raise BadInput(why)

    def points(self, state: State) -> dict[tuple[str, str], float]:
        """Return the points that hold, by key and test."""
        return {
            (each["key"], test): points
            for each in self.graded.document()["students"]
            for test, points in changes.columns_of(
                changes.shown(each, state.columns(each["key"]))
            ).items()
        }

    def differences(self) -> list[dict[str, Any]] | None:
        """Return what proposed marks change, a student each, None where none are proposed.

        before, after: points, None: the student is not in that class.
        """
        if not (self.folder / PROPOSED / CLASS).exists():
            return None
        state = self.journal.state()

        def of(document: Mapping[str, Any]) -> dict[str, dict[str, Any]]:
            return {
                s["key"]: changes.shown(s, state.columns(s["key"])) for s in document["students"]
            }

        before = of(self.graded.document())
        after = of(ClassFolder(self.folder / PROPOSED).document())
        found = []
        for key in [*before, *(k for k in after if k not in before)]:
            old, new = before.get(key), after.get(key)
            had, has = (changes.columns_of(s) if s else {} for s in (old, new))
            if had != has:
                found.append({
                    "key": key,
                    "name": (new or old or {})["name"],
                    "before": old and old["points"],
                    "after": new and new["points"],
                    "tests": [
                        {"name": t, "before": had.get(t), "after": has.get(t)}
                        for t in dict.fromkeys([*had, *has])
                        if t != changes.POINTS and had.get(t) != has.get(t)
                    ],
                })  # fmt: skip
        return found

    def unmatched(self) -> list[dict[str, Any]]:
        """Return what a teacher has to decide about, as the last run left it. decided: it was
        decided since."""
        state = self.journal.state()
        return [
            each | {"decided": each["what"] in (state.owners | state.rows)}
            for each in self.graded.document().get("unmatched", ())
        ]

    def table(self, name: str) -> Path:
        """Return the file of a table; raises BadInput before the release."""
        if not self.journal.state().released:
            raise BadInput(NOT_RELEASED())
        path = self.folder / name
        if not path.exists():
            raise BadInput(NO_WORKSHEET_GIVEN())
        return path

    def feedback(self) -> Path:
        """Return a ZIP archive with what each student gets, in the folders of the learning system;
        the caller removes it. Raises BadInput before the release."""
        if not self.journal.state().released:
            raise BadInput(NOT_RELEASED())
        document = self.graded.document()
        with tempfile.NamedTemporaryFile(suffix=".zip", delete=False) as file:
            path = Path(file.name)
        with zipfile.ZipFile(path, "w", zipfile.ZIP_STORED) as archive:
            for student in document["students"]:
                page = self.folder / FEEDBACK / f"{student['key']}.html"
                if page.exists():
                    archive.write(page, _place(document["form"], student, "html"))
                text = gradebook.words_of(student)
                archive.writestr(_place(document["form"], student, "txt"), text)
        return path


def check_name(name: str) -> None:
    """Raise BadInput where a file cannot be handed in under this name."""
    if (
        PurePosixPath(name).name != name
        or not name.isprintable()
        or name.startswith(".")
        or not name.lower().endswith(BESIDE)
    ):
        raise BadInput(SOURCE_NAME(file=name))


@contextlib.asynccontextmanager
async def taken(
    body: AsyncIterator[bytes], beside: Path, name: str, most: int
) -> AsyncIterator[Path]:
    """Yield a file with a body, in a folder of its own. Raises BadInput where it is too large."""
    with tempfile.TemporaryDirectory(dir=beside, prefix=".taking-") as place:
        path, size = Path(place) / name, 0
        with path.open("wb") as file:
            async for chunk in body:
                size += len(chunk)
                if size > most:
                    raise BadInput(SOURCE_TOO_LARGE(file=name, most=most))
                await asyncio.to_thread(file.write, chunk)
        yield path


def _place(form: str, student: Mapping[str, Any], ending: str) -> str:
    """Return where a learning system expects feedback: Canvas by the name of the file that was
    sent, the others in the student's folder."""
    if form == CANVAS_FORM and student["sent"]:
        return f"{PurePosixPath(student['sent']).stem}.{ending}"
    folder = student["folder"]
    if form == MOODLE_FORM and not folder:
        folder = f"{student['name']}_{student['identifier']}_assignsubmission_file_"
    return f"{folder or student['key']}/feedback.{ending}"
