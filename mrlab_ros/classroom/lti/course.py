"""The course that a class belongs to: its people, what they handed in, and what of it is known."""

from __future__ import annotations

import hashlib
import json
import os
import shutil
import tempfile
import threading
import zipfile
from collections.abc import Mapping
from dataclasses import asdict, dataclass, field, replace
from datetime import datetime, timezone
from pathlib import Path
from typing import Any

import orjson

from mrlab_ros.adapters.whole_file import replaced
from mrlab_ros.classroom.folder import COURSE, HANDED_IN
from mrlab_ros.classroom.lti.diagnostics import NO_COURSE, NOT_OF_COURSE, NOTHING_HANDED_IN
from mrlab_ros.classroom.marks.exports import METADATA
from mrlab_ros.core.base.errors import BadInput

ABOUT, CHECK = ".about.json", ".check.json"  # no file that is taken has such a name


@dataclass(frozen=True)
class Member:
    """A student of the course. subject: by which the platform knows the student."""

    subject: str
    name: str
    email: str = ""


@dataclass(frozen=True)
class Connected:
    """The course and the task to which the marks go, as its teacher opened them. members: address
    of its list of people; scores: what the platform says of its gradebook."""

    course: str
    title: str
    task: str
    task_title: str
    members: str = ""
    scores: Mapping[str, Any] = field(default_factory=dict)


@dataclass(frozen=True)
class HandedIn:
    """The newest file of a student. at: s since 1970; number: how many were before it."""

    file: str
    at: float
    size: int
    sha256: str
    number: int


class Course:
    """The course of one class, in its folder. people: ids of this lab to members; roster: the
    members that the platform named."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self._lock = threading.Lock()
        self.connected: Connected | None = None
        self.people: dict[str, Member] = {}
        self.roster: list[Member] = []
        try:
            found = json.loads((folder / COURSE).read_bytes())
        except (OSError, ValueError):
            return
        self.connected = Connected(**found["connected"]) if found["connected"] else None
        self.people = {each: Member(**member) for each, member in found["people"].items()}
        self.roster = [Member(**member) for member in found["roster"]]

    def enter(self, person: str, member: Member) -> None:
        """Know a person of this lab as a student of the course."""
        with self._lock:
            if self.people.get(person) != member:
                self.people[person] = member
                self._write()

    def connect(self, to: Connected, *, anew: bool = False) -> None:
        """Connect the class with a course and a task where it is not; of the same one what the
        platform offers is known anew. anew: in place of another one."""
        with self._lock:
            known = self.connected
            same = known is not None and (known.course, known.task) == (to.course, to.task)
            if same and known is not None and not to.scores.get("lineitem"):
                column = known.scores.get("lineitem")
                to = replace(to, scores={**to.scores, **({"lineitem": column} if column else {})})
            if (known is None or same or anew) and known != to:
                self.connected = to
                self._write()

    def disconnect(self) -> None:
        """Let the next task that a teacher opens be the one of this class."""
        with self._lock:
            self.connected = None
            self._write()

    def found(self) -> Connected:
        """Return the course and the task; raise BadInput where none is connected."""
        if self.connected is None:
            raise BadInput(NO_COURSE())
        return self.connected

    def enrol(self, members: list[dict[str, str]]) -> None:
        """Take the list of people that the platform gives."""
        with self._lock:
            self.roster = [Member(**each) for each in members]
            self._write()

    def members(self) -> list[tuple[Member, str]]:
        """Return everybody known of the course by name, with the id here, empty: never came."""
        ids = {member.subject: person for person, member in self.people.items()}
        every = {m.subject: m for m in [*self.people.values(), *self.roster]}
        found = [(member, ids.get(subject, "")) for subject, member in every.items()]
        return sorted(found, key=lambda each: (each[0].name.casefold(), each[0].subject))

    # what is handed in

    def place(self, person: str) -> Path:
        """Return the folder of a person's file; raise BadInput for one of no course."""
        if person not in self.people:
            raise BadInput(NOT_OF_COURSE())
        return self.folder / HANDED_IN / person

    def handed_in(self, person: str) -> HandedIn | None:
        """Return what a person handed in, None: nothing."""
        try:
            about = json.loads((self.folder / HANDED_IN / person / ABOUT).read_bytes())
            return HandedIn(**about)
        except (OSError, ValueError, TypeError):
            return None

    def take(self, person: str, content: Path, name: str, now: float) -> HandedIn:
        """Take a file in place of the one before; it is moved. Raises BadInput."""
        place = self.place(person)
        before = self.handed_in(person)
        data = content.read_bytes()
        about = HandedIn(
            name, now, len(data), hashlib.sha256(data).hexdigest(),
            0 if before is None else before.number + 1,
        )  # fmt: skip
        place.parent.mkdir(mode=0o700, parents=True, exist_ok=True)
        with tempfile.TemporaryDirectory(dir=self.folder, prefix=".taking-") as new:
            whole = Path(new) / "whole"
            whole.mkdir()
            os.replace(content, whole / name)
            (whole / ABOUT).write_bytes(orjson.dumps(asdict(about)))
            with self._lock:
                if place.exists():
                    os.rename(place, Path(new) / "before")
                os.rename(whole, place)
        return about

    def file(self, person: str, about: HandedIn) -> Path:
        """Return the place of a file that was handed in."""
        return self.place(person) / about.file

    def checked(self, person: str, about: HandedIn) -> dict[str, Any] | None:
        """Return what the check of a file said, None: it is not checked yet."""
        try:
            found: dict[str, Any] = orjson.loads((self.place(person) / CHECK).read_bytes())
        except (OSError, ValueError):
            return None
        return found if found.get("sha256") == about.sha256 else None

    def note(self, person: str, about: HandedIn, said: Mapping[str, Any]) -> None:
        """Keep what the check of a file said, unless another file is there by now."""
        with self._lock:
            if self.handed_in(person) == about:
                with replaced(self.place(person) / CHECK) as file:
                    file.write(orjson.dumps({**said, "sha256": about.sha256}))

    def pack(self, target: Path) -> None:
        """Write all that was handed in as an export, with everybody of the course. Raises
        BadInput where there is nothing."""
        names: dict[str, Any] = {}
        with tempfile.TemporaryDirectory(dir=self.folder, prefix=".taking-") as place:
            packed = Path(place) / "export.zip"
            with zipfile.ZipFile(packed, "w", zipfile.ZIP_STORED) as archive:
                for number, (member, person) in enumerate(self.members(), 1):
                    folder = f"handed_in_{number}"
                    names[folder] = {
                        ":submitters": [
                            {":name": member.name, ":sid": member.subject, ":email": member.email}
                        ]
                    }
                    with self._lock:
                        about = self.handed_in(person) if person else None
                        if about is not None:
                            at = datetime.fromtimestamp(about.at, timezone.utc)
                            names[folder][":created_at"] = at.isoformat(timespec="seconds")
                            archive.write(self.file(person, about), f"{folder}/{about.file}")
                if not archive.namelist():
                    raise BadInput(NOTHING_HANDED_IN())
                archive.writestr(METADATA, json.dumps(names))
            target.parent.mkdir(parents=True, exist_ok=True)
            shutil.move(packed, target)

    def _write(self) -> None:
        self.folder.mkdir(parents=True, exist_ok=True)
        document = {
            "connected": asdict(self.connected) if self.connected else None,
            "people": {person: asdict(member) for person, member in self.people.items()},
            "roster": [asdict(member) for member in self.roster],
        }
        with replaced(self.folder / COURSE, 0o600) as file:
            file.write(orjson.dumps(document))
