"""/api/class: the desk of a class for its teachers; its submissions with marks and motions."""

from __future__ import annotations

import time
from collections.abc import Mapping
from dataclasses import asdict
from functools import cache
from typing import Annotated, Any, Literal
from urllib.parse import quote

import orjson
from fastapi import APIRouter, Depends, Path, Request, Response
from fastapi.concurrency import run_in_threadpool
from fastapi.responses import FileResponse
from pydantic import BaseModel, Field
from starlette.background import BackgroundTask

from mrlab_ros.adapters.trajectories import formats
from mrlab_ros.app.show import document
from mrlab_ros.classroom import job
from mrlab_ros.classroom.desk import Desk, Run
from mrlab_ros.classroom.diagnostics import NO_CLASS
from mrlab_ros.classroom.folder import CLASS, TABLE, WORKSHEET
from mrlab_ros.classroom.marks import changes
from mrlab_ros.classroom.marks.exports import REFERENCE
from mrlab_ros.classroom.marks.journal import RELEASE, Entry, State, differing, state_of
from mrlab_ros.classroom.shown import findings
from mrlab_ros.core.base.diagnostic import Fix, from_plain, plain
from mrlab_ros.gateway.checks.desk import CheckFinding
from mrlab_ros.gateway.errors import NotFound
from mrlab_ros.gateway.people.person import CurrentPerson
from mrlab_ros.gateway.store.answers import Strict
from mrlab_ros.gateway.store.shelf import Shelf, shelf_of

MOST_ACTS, MOST_LEFT_OUT, MOST_UNMATCHED = 200, 200, 100
NOT_MARKED: Mapping[str, Any] = {
    "title": "", "form": "", "rubric": {"robot": ""}, "students": [], "left_out": [],
}  # fmt: skip


class Change(BaseModel):
    """Points that a teacher gave. at: s since 1970. given: those of the test."""

    points: float
    given: float
    who: str
    at: float
    reason: str


class Mark(BaseModel):
    """The result of a test of the rubric. time: s, where points were lost; null: no instant.
    change: by the teacher who marks; second: by a second marker, which does not hold."""

    name: str
    points: float
    of: float
    passed: bool
    found: CheckFinding
    hint: str
    hidden: bool
    time: float | None
    bonus: bool = False
    change: Change | None = None
    second: Change | None = None


class Submission(BaseModel):
    """One student's submission. motion: there is one to show. found: why there is none, or
    the verdict of its check."""

    key: str
    name: str
    points: float
    of: float
    found: CheckFinding
    duration: float | None
    robot: str
    tool: str
    motion: bool
    marks: list[Mark]
    late: bool = False
    comment: str = ""


class Source(BaseModel):
    """A file that the next run reads. size: bytes."""

    name: str
    size: int


class Running(BaseModel):
    """A run of the class. how: propose, hold, back or final. problem: why it failed;
    notes: what its teacher has to know."""

    how: str
    running: bool
    done: int
    all: int
    problem: CheckFinding | None
    notes: list[CheckFinding]


class ChangedTest(BaseModel):
    """What proposed marks change in a test; null: the test is not in that rubric."""

    name: str
    before: float | None
    after: float | None


class Difference(BaseModel):
    """What proposed marks change for a student; null: not in that class."""

    key: str
    name: str
    before: float | None
    after: float | None
    tests: list[ChangedTest]


class Act(BaseModel):
    """What somebody did. at: s since 1970."""

    at: float
    who: str
    did: str
    name: str
    test: str
    points: float | None
    text: str


class LeftOut(BaseModel):
    """A file that belongs to nobody, and why."""

    file: str
    why: CheckFinding


class Unmatched(BaseModel):
    """A file of nobody, or a student in no row of the platform's table. what: path, or the
    student's key. proposal: a key, or the identifier of a row, empty: nobody is near; proposed:
    the name there. decided: since the last run."""

    kind: Literal["file", "student"]
    what: str
    name: str
    why: CheckFinding
    proposal: str
    proposed: str
    decided: bool


class Row(BaseModel):
    """A row of the platform's table that nobody has. key: of a submission that it would have."""

    key: str
    name: str
    identifier: str


class DeskState(BaseModel):
    """What stands on the desk. missing: files that the rubric names. form: that was said.
    proposed: differences, null: no marks are proposed. journal: the latest acts, newest first.
    locked, released: by whom; empty: not. differing: marks of second markers that do not hold.
    before: the marks of an earlier run can hold again. rows: of the platform's table that nobody
    has."""

    sources: list[Source]
    missing: list[str]
    form: str
    run: Running | None
    proposed: list[Difference] | None
    journal: list[Act]
    locked: str
    released: str
    undo: bool
    differing: int
    worksheet: bool
    before: bool
    left_out: list[LeftOut]
    unmatched: list[Unmatched] = []
    rows: list[Row] = []


class Class(BaseModel):
    """A graded class. marked: it was run. form: of its export. reference: the solution, to compare
    with; null: there is none."""

    title: str
    robot: str
    marked: bool
    form: str
    submissions: list[Submission]
    reference: Submission | None
    desk: DeskState


class NewRun(Strict):
    """Marks the class. form: of the export, null: as before, empty: recognise it."""

    form: Annotated[str, Field(max_length=20)] | None = None


Points = Annotated[float, Field(ge=-10_000, le=10_000, allow_inf_nan=False)]


class NewAct(Strict):
    """Something to do to marks. points: null takes a mark back. assign gives the file `text` to
    the student `key`, enrol the student `key` the row `text`; empty: nobody, or none."""

    did: Literal["mark", "second", "comment", "assign", "enrol", "lock", "undo"]
    key: Annotated[str, Field(max_length=300)] = ""
    test: Annotated[str, Field(max_length=300)] = ""
    points: Points | None = None
    text: Annotated[str, Field(max_length=4000)] = ""


router = APIRouter(prefix="/api/class", tags=["class"])


def desk_of(request: Request) -> Desk:
    """Return the desk of a gateway's class, as a dependency; raises NotFound where it has none."""
    folder = request.app.state.settings.classroom
    if folder is None:
        raise NotFound(NO_CLASS(fixes=(Fix(command="mrlab up --class FOLDER"),)))
    return _desk(folder)


# One of each: it keeps the document that it has read, and the run that it started.
_desk = cache(Desk)


TheShelf = Annotated[Shelf, Depends(shelf_of)]
TheDesk = Annotated[Desk, Depends(desk_of)]
Key = Annotated[str, Path(max_length=300, description="a student's key, or reference")]


@router.get("")
async def overview(desk: TheDesk) -> Class:
    """Return all submissions in the order of the class with their marks, and the desk."""
    return await run_in_threadpool(_overview, desk)


def _overview(desk: Desk) -> Class:
    entries = desk.journal.entries()
    state = state_of(entries)
    found: Mapping[str, Any] = (
        desk.graded.document() if (desk.folder / CLASS).exists() else NOT_MARKED
    )
    names = {each["key"]: each["name"] for each in found["students"]}
    reference = found.get("reference")
    latest = [
        asdict(e) | {"name": names.get(e.key, e.key)} for e in entries[: -MOST_ACTS - 1 : -1]
    ]
    return Class.model_validate(
        {
            "title": found["title"],
            "robot": found["rubric"]["robot"],
            "marked": found is not NOT_MARKED,
            "form": found["form"],
            "submissions": [_submission(each, state) for each in found["students"]],
            "reference": reference
            and _submission({"key": REFERENCE, "name": REFERENCE, **reference}, State()),
            "desk": {
                "sources": [{"name": name, "size": size} for name, size in desk.sources()],
                "missing": desk.missing(),
                "form": desk.form(),
                "run": desk.run and _run(desk.run),
                "proposed": desk.differences(),
                "journal": latest,
                "locked": state.locked.who if state.locked else "",
                "released": state.released.who if state.released else "",
                "undo": bool(state.done),
                "differing": differing(state, desk.points(state)) if state.seconds else 0,
                "worksheet": (desk.folder / WORKSHEET).exists(),
                "before": desk.has_before,
                "left_out": [
                    {"file": each["path"], "why": each["why"]}
                    for each in found["left_out"][:MOST_LEFT_OUT]
                ],
                "unmatched": desk.unmatched()[:MOST_UNMATCHED] if found is not NOT_MARKED else [],
                "rows": found.get("rows", []),
            },
        }
    )


@router.put("/sources/{name}", status_code=204)
async def source(desk: TheDesk, name: str, request: Request) -> None:
    """Take a file for the next run: export.zip, rubric.yaml, worksheet.csv, or one that the rubric
    names."""
    await desk.take(name, request.stream())


@router.post("/run", status_code=202)
async def run(desk: TheDesk, person: CurrentPerson, body: NewRun) -> None:
    """Mark the class; where it is marked already, the new marks are only proposed."""
    await desk.start(job.PROPOSE, person.name, body.form)


@router.delete("/run", status_code=204)
async def stop(desk: TheDesk) -> None:
    """End the run; what it has checked is kept."""
    await desk.stop()


@router.post("/proposed", status_code=202)
async def adopt(desk: TheDesk, person: CurrentPerson) -> None:
    """Let the proposed marks hold."""
    await desk.start(job.HOLD, person.name)


@router.delete("/proposed", status_code=204)
async def discard(desk: TheDesk) -> None:
    """Take the proposed marks back, and the files that they come from."""
    await desk.discard()


@router.post("/before", status_code=202)
async def take_back(desk: TheDesk, person: CurrentPerson) -> None:
    """Let the marks of the run before the last one hold again; what was given by hand stays."""
    await desk.start(job.BACK, person.name)


@router.post("/acts", status_code=204)
async def act(desk: TheDesk, person: CurrentPerson, body: NewAct) -> None:
    """Give a mark or a comment, mark as the second marker, match a file or a row with a student,
    lock all marks, or undo the last."""
    made = Entry(time.time(), person.name, **body.model_dump())
    await run_in_threadpool(desk.act, made)


@router.post("/release", status_code=202)
async def release(desk: TheDesk, person: CurrentPerson) -> None:
    """Lock all marks and write the pages and tables that students get."""
    await run_in_threadpool(desk.check, Entry(0.0, person.name, RELEASE))
    await desk.start(job.FINAL, person.name)


@router.get("/feedback.zip", response_class=FileResponse)
async def feedback(desk: TheDesk) -> FileResponse:
    """Return what each student gets, in the folders that the learning system takes."""
    path = await run_in_threadpool(desk.feedback)
    return FileResponse(
        path, media_type="application/zip", filename="feedback.zip",
        background=BackgroundTask(path.unlink, missing_ok=True),
    )  # fmt: skip


@router.get("/{table}.csv", response_class=FileResponse)
async def table(desk: TheDesk, table: Literal["grades", "worksheet"]) -> FileResponse:
    """Return the table of all marks, or Moodle's worksheet with the grades; of released marks."""
    path = await run_in_threadpool(desk.table, TABLE if table == "grades" else WORKSHEET)
    return FileResponse(path, media_type="text/csv", filename=path.name)


@router.get("/{key}/motion", response_class=Response)
async def motion(desk: TheDesk, shelf: TheShelf, key: Key) -> Response:
    """Return a submission as a MotionDocument: lost points come first among its findings."""

    def made() -> bytes:
        entry, loaded = desk.graded.entry(key), desk.graded.trajectory(key)
        robot = shelf.robots.shown(loaded.robot_model, loaded.end_effector)
        shown = document.motion(
            loaded,
            robot,
            message=str(from_plain(entry["found"])),
            diagnostics=findings(entry, loaded),
        )
        return orjson.dumps(shown | {"title": entry["name"]})

    return Response(await run_in_threadpool(made), media_type="application/json")


@router.get("/{key}/file", response_class=Response)
async def file(desk: TheDesk, key: Key) -> Response:
    """Return a submission's motion as a trajectory file."""

    def made() -> bytes:
        return b"".join(formats.chunks(desk.graded.trajectory(key)))

    headers = {"Content-Disposition": f'attachment; filename="{quote(key)}.json"'}
    text = await run_in_threadpool(made)
    return Response(text, media_type="application/json", headers=headers)


def _submission(entry: Mapping[str, Any], state: State) -> dict[str, Any]:
    """Return a submission with the marks that hold."""
    key = entry["key"]
    shown = changes.shown(entry, state.columns(key))
    first, second = state.marks.get(key, {}), state.seconds.get(key, {})
    marks = [
        {
            **mark,
            "change": _change(first.get(mark["name"]), mark),
            "second": _change(second.get(mark["name"]), mark),
        }
        for mark in shown["marks"]
    ]
    return {
        **shown,
        "marks": marks,
        "motion": bool(entry.get("trajectory")),
        "comment": state.comment(key),
    }


def _change(entry: Entry | None, mark: Mapping[str, Any]) -> dict[str, Any] | None:
    if entry is None:
        return None
    given = mark.get("given", mark["points"])
    return {**asdict(entry), "given": given, "reason": entry.text}


def _run(run: Run) -> dict[str, Any]:
    problem = None if run.problem is None else plain(run.problem)
    return {**vars(run), "problem": problem, "notes": plain(run.notes)}
