"""What students of the course hand in: taken, checked at once; their marks once released."""

from __future__ import annotations

import asyncio
from collections.abc import AsyncIterator, Mapping
from typing import Any

from mrlab_ros.classroom import job
from mrlab_ros.classroom.desk import Desk, check_name, taken
from mrlab_ros.classroom.folder import CLASS
from mrlab_ros.classroom.instant import InstantChecks, sources_of
from mrlab_ros.classroom.lti.course import Course, HandedIn
from mrlab_ros.classroom.lti.diagnostics import CHECKED_AT_ONCE, NOTHING_TO_HAND_IN_FOR
from mrlab_ros.classroom.mark import read_rubric
from mrlab_ros.classroom.marks.diagnostics import CLASS_IS_LOCKED
from mrlab_ros.classroom.marks.exports import COURSE_FORM, file_label
from mrlab_ros.classroom.marks.result import TO_REPEAT
from mrlab_ros.classroom.rubrics.rubric import Rubric
from mrlab_ros.core.base.diagnostic import plain
from mrlab_ros.core.base.errors import BadInput

MOST_BYTES = 64 << 20


class HandIns:
    """The hand-ins of one class; its calls belong to one event loop."""

    def __init__(self, desk: Desk, course: Course) -> None:
        self.desk = desk
        self.course = course
        self._checks = InstantChecks(desk.folder)
        self._checking: dict[str, asyncio.Task[None]] = {}

    def rubric(self) -> Rubric | None:
        """Return the rubric by which students are checked, None: there is none yet."""
        path = sources_of(self.desk.folder) / job.RUBRIC
        return read_rubric(path) if path.exists() else None

    async def take(self, person: str, name: str, body: AsyncIterator[bytes], now: float) -> None:
        """Take a person's file in place of the one before, and begin to check it.

        Raises BadInput where it is none, the marks are locked, or the person is not of the course.
        """
        check_name(name)
        place = self.course.place(person)
        state = await asyncio.to_thread(self.desk.journal.state)
        if fixed := state.released or state.locked:
            raise BadInput(CLASS_IS_LOCKED(who=fixed.who))
        if await asyncio.to_thread(self.rubric) is None:
            raise BadInput(NOTHING_TO_HAND_IN_FOR())
        place.parent.mkdir(mode=0o700, parents=True, exist_ok=True)
        name = file_label(name)
        async with taken(body, self.desk.folder, name, MOST_BYTES) as path:
            about = await asyncio.to_thread(self.course.take, person, path, name, now)
        self._check(person, about)

    async def state(self, person: str) -> dict[str, Any]:
        """Return what a person sees of the own hand-in. Raises BadInput."""
        about = await asyncio.to_thread(self.course.handed_in, person)
        said = None
        if about is not None:
            said = await asyncio.to_thread(self.course.checked, person, about)
            if said is None:  # nobody was here when it should have been checked
                self._check(person, about)
        shown = await asyncio.to_thread(self._shown, person)
        return {**shown, "handed_in": about and vars(about), "check": said}

    def _shown(self, person: str) -> dict[str, Any]:
        connected, rubric = self.course.connected, self.rubric()
        state = self.desk.journal.state()
        fixed = state.released or state.locked
        return {
            "course": connected.title if connected else "",
            "task": rubric.name if rubric else "",
            "robot": rubric.robot if rubric else "",
            "closed": fixed.who if fixed else "",
            "member": person in self.course.people,
            "mark": self._mark(person) if state.released else None,
        }

    def _mark(self, person: str) -> dict[str, Any] | None:
        """Return the mark of a person that was released, None: it is not of what was handed in."""
        member = self.course.people.get(person)
        if member is None or not (self.desk.folder / CLASS).exists():
            return None
        document = self.desk.graded.document()
        if document["form"] != COURSE_FORM:
            return None
        for each in document["students"]:
            if each["identifier"] == member.subject and each["outcome"] != TO_REPEAT:
                return {
                    "points": each["points"],
                    "of": each["of"],
                    "comment": self.desk.journal.state().comment(each["key"]),
                    **_public(each["marks"], each["hints"], each["found"]),
                }
        return None

    def _check(self, person: str, about: HandedIn) -> None:
        """Begin to check a file, unless that goes on."""
        name = f"{person} {about.number}"
        if name not in self._checking:
            self._checking[name] = asyncio.create_task(self._checked(name, person, about))

    async def _checked(self, name: str, person: str, about: HandedIn) -> None:
        try:
            if self.course.handed_in(person) != about:
                return
            answer = await self._checks.check(self.course.file(person, about), about.file)
            said = said_of(answer)
            await asyncio.to_thread(self.course.note, person, about, said)
        finally:
            del self._checking[name]


def said_of(answer: Mapping[str, Any]) -> dict[str, Any]:
    """Return what a student is told at once: how many tests pass, and of each that is not hidden
    what was found; no points."""
    if "problem" in answer:
        return {"said": answer["problem"], "tests": [], "hints": []}
    result = answer["result"]
    return _public(result["public"]["tests"], result["public"]["hints"], result["found"])


def _public(marks: Any, hints: Any, found: Mapping[str, Any]) -> dict[str, Any]:
    tests = [
        {**{k: each[k] for k in ("name", "passed", "found", "hint", "points", "of")}}
        for each in marks
        if not each.get("hidden") and (each["of"] or each["points"])
    ]
    passed = sum(each["passed"] for each in tests)
    said = plain(CHECKED_AT_ONCE(passed=passed, lost=len(tests) - passed or None))
    none = not any(each["passed"] or each["points"] for each in tests)
    return {"said": found if none else said, "tests": tests, "hints": list(hints)}
