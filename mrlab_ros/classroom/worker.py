"""The sandboxed process that checks submissions; started by `grader`.

It imports everything, reads the library, checks the reference solution, and then forks once for
each submission. Only the fork touches a student's bytes, in the sandbox of `adapters/sandbox` and
under limits that the kernel keeps: memory, processor time, wall time, size of files, no core dump.
It reads the submission's folder and the lab's own files. What it finds it leaves as files in a
folder of its own; whatever a submission does to it, others see no more than an exit status.

It converts files itself: it is in the sandbox already, so that no other process is started.
"""

from __future__ import annotations

import contextlib
import gc
import hashlib
import importlib
import json
import os
import pickle
import shutil
import signal
import socket
import sys
import tempfile
import traceback
import zlib
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import orjson

from mrlab_ros.adapters import installed, share
from mrlab_ros.adapters.robots.library import RobotLibrary
from mrlab_ros.adapters.sandbox import restrictions
from mrlab_ros.adapters.sandbox.inert_output import guard
from mrlab_ros.adapters.trajectories import formats
from mrlab_ros.adapters.trajectories.files import load_coefficients
from mrlab_ros.adapters.workspaces import content, worker
from mrlab_ros.adapters.workspaces.reader import Limits, opened
from mrlab_ros.adapters.workspaces.results import Task, converted, refused
from mrlab_ros.app.check.file import CELLS, CheckedFile, Setting
from mrlab_ros.app.convert import of_trajectory_file_here
from mrlab_ros.app.show.page import packed
from mrlab_ros.classroom.diagnostics import NO_FILE, NO_ROBOT_IN_RUBRIC, REFERENCE_NOT_MARKED
from mrlab_ros.classroom.mark import check_rubric_file
from mrlab_ros.classroom.marks import changes
from mrlab_ros.classroom.marks.diagnostics import (
    MACHINE_REFUSED,
    SUBMISSION_FAILED,
    SUBMISSION_OUT_OF_MEMORY,
)
from mrlab_ros.classroom.marks.result import (
    FAILED,
    MARKED,
    MOST_FINDINGS,
    MOST_PATH,
    REFUSED,
    TO_REPEAT,
    Result,
    without_marks,
)
from mrlab_ros.classroom.marks.similarity import signature
from mrlab_ros.classroom.rubrics.marking import mark
from mrlab_ros.classroom.setup import Bounds, Setup
from mrlab_ros.core.base.diagnostic import Diagnostic, plain
from mrlab_ros.core.base.errors import BadInput, LabError, Misuse
from mrlab_ros.core.base.machine import lack
from mrlab_ros.core.checking.check_record import Checked
from mrlab_ros.core.conversion.convert import ConversionResult, id_from
from mrlab_ros.core.conversion.options import DEFAULT_FRAME_RATE, Options
from mrlab_ros.core.conversion.workspace import Workspace


class Inside:
    """Converts files here; callable as `app.convert.converted` is.

    limits: of time, s, for what the second reader says; memory: bytes, for words and buffers.
    """

    def __init__(self, limits: Limits) -> None:
        self.limits = limits
        worker.load_encodings()
        importlib.import_module("scipy.io")  # of the second reader, which opens no file
        for module in worker.SELDOM:
            with contextlib.suppress(ImportError):  # mat-io is not there for every Python
                worker.import_whole(module)
        path = share.directory() / "config" / "torque_proxy.yaml"
        self._coefficients = load_coefficients(path)

    def __call__(
        self, file: Path, robot: str, end_effector: str, options: Options, library: RobotLibrary
    ) -> ConversionResult:
        """Return what became of a file; a refusal is a result. Raises LabError."""
        found = of_trajectory_file_here(file)
        if found is not None:
            return found
        if not robot:
            raise Misuse(NO_ROBOT_IN_RUBRIC(file=file.name))
        task = Task(
            file=file.name,
            options=options,
            robot=library.model(robot),
            coefficients=self._coefficients,
            end_effector=end_effector or None,
            trajectory_id=id_from(file.name),
            created_ns=0,  # equal files give equal trajectories
            default_frame_rate=DEFAULT_FRAME_RATE,
        )
        limits = self.limits
        request = {
            **vars(limits),
            "wall": limits.time,
            "name": file.name,
            "joints": task.robot.joint_names,
        }
        try:
            with opened(file) as source:
                copy = content.copied(source, limits.file_size, file.name)

                def read() -> Workspace:
                    return worker.workspace(copy, request)

                return converted(task, read, limits.memory, limits.rows)
        except BadInput as error:
            return refused(file.name, error.diagnostic)


MiB = 1 << 20
MOST_WRITTEN = 512 * MiB  # bytes of one file that a check may write
RESULT, TRAJECTORY, PAGE, FEEDBACK = "result.json", "trajectory.json", "page.html", "feedback.html"
EVIDENCE, GIVEN = "evidence", ".evidence"  # what a check leaves for the next one, and takes
MESSAGE_SIZE = 1 << 16
# A checked file, its name, and why it could not be checked.
First = tuple[CheckedFile | None, str, Diagnostic | None]


class Warm:
    """Shared by all submissions: the stage, the rubric, and the reference as it was checked."""

    def __init__(self, setup: Setup, scratch: Path) -> None:
        self.setup = setup
        self.share = share.directory()
        self.readable = (*restrictions.libraries(), *share.folders(), *installed.packages())
        convert = Inside(Limits(memory=setup.bounds.memory, time=setup.bounds.wall))
        base = setup.setting(self.share)
        values = {**vars(base), "convert": convert, "drawn": True, "enclosed": True}
        self.setting = Setting(**values)
        self.reference: Checked | None = None
        if setup.reference is not None:
            folder = scratch / "reference"
            folder.mkdir()
            for name, content in setup.references:
                (folder / name).write_bytes(content)
            name = setup.reference[0]
            # the converter's second reader takes what is left of this
            signal.setitimer(signal.ITIMER_REAL, setup.bounds.wall)
            found = check_rubric_file(folder / name, setup.rubric, self.setting)
            if found.played is None:
                raise BadInput(
                    REFERENCE_NOT_MARKED(rubric=setup.rubric.origin, file=name, why=found.why)
                )
            self.reference = found.checked
            signal.setitimer(signal.ITIMER_REAL, 0)
        if setup.pages:
            # what all pages need is imported and packed once, for all forks
            from mrlab_ros.app.show import check, motion, refusal  # noqa: F401
            from mrlab_ros.app.show.ingredients import code

            packed(code(self.share).script)

    def check(self, request: Mapping[str, Any], folder: Path, out: Path) -> None:
        """Check the first of some files that holds a motion, and write what was found.

        What an earlier check left is taken for it; it was written here, and nobody else reads it.
        """
        given, problem = folder / GIVEN, None
        found: CheckedFile | None
        if given.exists():
            found, file = pickle.loads(zlib.decompress(given.read_bytes()))
        else:
            found, file, problem = self._first(request["files"], folder)
        if found is None:
            why = problem or NO_FILE()
            result = without_marks(self.setup.rubric, REFUSED, why, file)
        else:
            result = self._result(found, folder / file, request, out)
            if not given.exists():
                evidence = pickle.dumps((found, file), pickle.HIGHEST_PROTOCOL)
                (out / EVIDENCE).write_bytes(zlib.compress(evidence, 1))
        if self.setup.pages:
            result = replace(result, has_page=True)
            self._pages(found, result, request, out)
        (out / RESULT).write_bytes(orjson.dumps(result.plain()))

    def _first(
        self, files: list[str], folder: Path
    ) -> tuple[CheckedFile | None, str, Diagnostic | None]:
        """Return the first file that holds a motion, else the first that can be told about."""
        told: First | None = None
        ordered = sorted(files, key=lambda name: not name.lower().endswith(CELLS))
        for name in ordered:
            try:
                found = check_rubric_file(folder / name, self.setup.rubric, self.setting)
            except LabError as error:
                told = told or (None, name, error.diagnostic)
                continue
            if found.holds_motion:
                return found, name, None
            told = told or (found, name, None)
        return told or (None, "", None)

    def _result(
        self, found: CheckedFile, source: Path, request: Mapping[str, Any], out: Path
    ) -> Result:
        file = source.name
        checked = found.checked
        marks = mark(self.setup.rubric, checked, self.reference, request["late"])
        trajectory, figures = checked.trajectory, checked.figures
        if trajectory is not None:
            with (out / TRAJECTORY).open("wb") as written:
                written.writelines(formats.chunks(trajectory))
        path: Any = ()
        if figures is not None:
            at = np.linspace(0, len(figures.tool) - 1, MOST_PATH).round().astype(int)
            path = figures.tool[np.unique(at)].round(4).tolist()
        # of the bytes that were handed in, whatever a trajectory file says of its source
        sha256 = "" if trajectory is None else hashlib.sha256(source.read_bytes()).hexdigest()
        robot = found.robots[0]
        return Result(
            MARKED if marks.note is None else REFUSED,
            plain(marks.note or checked.report.summary),
            marks.plain(),
            marks.public().plain(),
            file,
            sha256,
            checked.report.verdict,
            str(checked.document["hash"]),
            robot.model.id,
            robot.end_effector,
            checked.report.duration,
            [plain(f) for f in checked.report.findings[:MOST_FINDINGS]],
            () if trajectory is None else signature(trajectory.positions).tolist(),
            path,
            trajectory is not None,
        )

    def _pages(
        self, found: CheckedFile | None, result: Result, request: Mapping[str, Any], out: Path
    ) -> None:
        """Write the teacher's page, and the student's where it is another one, with the marks and
        the comment that the teacher gives."""
        pages = {PAGE: result.marks}
        if any(one["hidden"] for one in result.marks["tests"]):
            pages[FEEDBACK] = result.public
        title = f"{request['shown']}: {result.file}"
        for name, shown in pages.items():
            given = changes.marks(shown, request["changes"], request["comment"])
            text = self._page(found, result, title, given)
            (out / name).write_text(text, encoding="utf-8")

    def _page(
        self, found: CheckedFile | None, result: Result, title: str, marks: Mapping[str, Any]
    ) -> str:
        """Return the page of what was rehearsed; of what was refused that of its matrix, or of
        its findings alone."""
        from mrlab_ros.app.show.check import page_of
        from mrlab_ros.app.show.motion import motion_page
        from mrlab_ros.app.show.refusal import refusal_page

        stage, share = self.setting.stage, self.share
        if found is not None and found.played is not None:
            return page_of(found, stage, share, marks, title=title, with_film=False)
        if found is not None and found.result is not None:
            robot = found.robots[0]
            model, tool = robot.model.id, robot.end_effector or None
            with contextlib.suppress(BadInput):  # no matrix was found
                return motion_page(
                    found.result, model, tool, stage.library, share, marks,
                    title=title, pictured=False,
                )  # fmt: skip
        return refusal_page(title, result.findings or [result.found], marks, share)


def confine(bounds: Bounds) -> None:
    """Put the kernel's limits on this process."""
    signal.setitimer(signal.ITIMER_REAL, bounds.wall)
    restrictions.confine(memory=bounds.memory, seconds=bounds.time, file_size=MOST_WRITTEN)


def work(warm: Warm, request: dict[str, Any]) -> None:
    """Check one submission, in the forked process; before the sandbox is shut nothing is its
    fault."""
    folder, out = Path(request["folder"]), Path(request["out"])
    outcome = TO_REPEAT
    try:
        confine(warm.setup.bounds)
        tempfile.tempdir = str(out)
        restrictions.shut(read=[folder, *warm.readable], write=[out], opens=True)
        outcome = FAILED
        warm.check(request, folder, out)
    except MemoryError:
        why = SUBMISSION_OUT_OF_MEMORY(limit=warm.setup.bounds.memory)
    except OSError as error:
        traceback.print_exc()
        found = lack(error)
        if outcome == TO_REPEAT or (found is not None and found.is_shared):
            outcome, why = TO_REPEAT, MACHINE_REFUSED(why=error.strerror)
        else:
            why = SUBMISSION_FAILED(error=f"{type(error).__name__}: {error}")
    except Exception as error:
        # one submission may end neither the class nor its teacher's patience
        traceback.print_exc()
        why = SUBMISSION_FAILED(error=f"{type(error).__name__}: {error}")
    else:
        return
    result = without_marks(warm.setup.rubric, outcome, why)
    (out / RESULT).write_bytes(orjson.dumps(result.plain()))


def answer(connection: socket.socket, warm: Warm) -> None:
    """Answer one request after another until the connection is closed."""
    connection.send(b"{}")
    while message := connection.recv(MESSAGE_SIZE):
        child = os.fork()
        if child == 0:
            connection.close()
            try:
                work(warm, json.loads(message))
                sys.stderr.flush()
                os._exit(0)
            except BaseException:
                traceback.print_exc()
            finally:
                os._exit(1)
        _, status = os.waitpid(child, 0)
        connection.send(json.dumps({"status": os.waitstatus_to_exitcode(status)}).encode())


def main() -> None:
    """Serve requests from the socket whose descriptor is the first argument, until it closes.

    The second argument is a folder with the file `setup`, which the class' own process wrote.
    """
    guard()
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    scratch = Path(sys.argv[2])
    connection = socket.socket(fileno=int(sys.argv[1]))
    setup: Setup = pickle.loads((scratch / "setup").read_bytes())
    try:
        warm = Warm(setup, scratch)
    except LabError as error:
        connection.send(json.dumps({"error": plain(error)}).encode())
        return
    # objects that the collector does not visit stay shared with the forks
    gc.collect()
    gc.freeze()
    with contextlib.suppress(ConnectionError):
        answer(connection, warm)
    # the class was killed: nobody else removes what it left
    shutil.rmtree(scratch, ignore_errors=True)


if __name__ == "__main__":
    main()
