"""Reads the folder of a graded class: class.json, and the motion of each student."""

from __future__ import annotations

import threading
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import orjson

from mrlab_ros.adapters.trajectories import formats
from mrlab_ros.classroom.diagnostics import (
    CLASS_FILE_TOO_LARGE,
    CLASS_NO_JSON,
    CLASS_NOT_READ,
    LOST_POINTS,
    MOTION_NOT_THERE,
    MOTION_OUTSIDE,
    NO_MOTION_TO_SHOW,
    NO_SUBMISSION,
    OTHER_CLASS_SCHEMA,
)
from mrlab_ros.classroom.folder import CLASS
from mrlab_ros.classroom.marks.exports import REFERENCE
from mrlab_ros.core.base.diagnostic import PLACE, Diagnostic, from_plain
from mrlab_ros.core.base.errors import BadInput, Unavailable
from mrlab_ros.core.trajectory.trajectory import Trajectory
from mrlab_ros.gateway.errors import NotFound

SCHEMA = "mrlab.class.1"
MiB = 1 << 20
LARGEST_CLASS, LARGEST_MOTION = 256 * MiB, 256 * MiB


class ClassFolder:
    """One class; read again when its file has changed, so that a class may go on meanwhile."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self._lock = threading.Lock()
        self._known: tuple[tuple[int, int], dict[str, Any]] | None = None

    def document(self) -> dict[str, Any]:
        """Return class.json; raise Unavailable where it is gone, BadInput where it is none."""
        path = self.folder / CLASS
        with self._lock:
            try:
                status = path.stat()
                identity = (status.st_mtime_ns, status.st_size)
                if self._known is not None and self._known[0] == identity:
                    return self._known[1]
                text = _read(path, LARGEST_CLASS)
            except OSError as error:
                raise Unavailable(CLASS_NOT_READ(why=error.strerror)) from None
            try:
                found: dict[str, Any] = orjson.loads(text)
            except orjson.JSONDecodeError as error:
                raise BadInput(CLASS_NO_JSON(file=CLASS, why=str(error))) from None
            schema = found.get("schema") if isinstance(found, dict) else None
            if schema != SCHEMA:
                raise BadInput(OTHER_CLASS_SCHEMA(file=CLASS, found=repr(schema), expected=SCHEMA))
            self._known = identity, found
            return found

    def entry(self, key: str) -> Mapping[str, Any]:
        """Return what is said of one student, or of the reference; raise NotFound."""
        document = self.document()
        every = [*document["students"]]
        if document.get("reference"):
            every.append({"key": REFERENCE, "name": REFERENCE, **document["reference"]})
        for each in every:
            if each["key"] == key:
                found: Mapping[str, Any] = each
                return found
        raise NotFound(NO_SUBMISSION(key=key))

    def trajectory(self, key: str) -> Trajectory:
        """Return a student's motion; raise NotFound where there is none."""
        entry = self.entry(key)
        named = entry.get("trajectory")
        if not named:
            why = from_plain(entry["found"]) if entry.get("found") else None
            raise NotFound(NO_MOTION_TO_SHOW(key=key, why=why))
        path = (self.folder / named).resolve()
        if not path.is_relative_to(self.folder.resolve()):
            raise NotFound(MOTION_OUTSIDE(key=key))
        try:
            return formats.parse(_read(path, LARGEST_MOTION), path.name)
        except OSError as error:
            raise NotFound(MOTION_NOT_THERE(key=key, why=error.strerror)) from None


def findings(entry: Mapping[str, Any], trajectory: Trajectory) -> list[Diagnostic]:
    """Return lost points, then what the check found, as findings of the motion's frames."""
    found = [*_lost(entry), *map(from_plain, entry.get("findings", ()))]
    return [_in_rows(each, trajectory) for each in found]


def _lost(entry: Mapping[str, Any]) -> Iterator[Diagnostic]:
    for mark in entry.get("marks", ()):
        if not mark["passed"]:
            found = from_plain(mark["found"])
            placed = {k: v for k, v in found.values.items() if k in PLACE}
            yield LOST_POINTS(
                **{**placed, "time": mark["time"]},
                test=mark["name"],
                found=found,
                hint=mark.get("hint"),
                severity=found.severity,
            )


def _in_rows(found: Diagnostic, trajectory: Trajectory) -> Diagnostic:
    """Return a finding with the rows of its instants."""

    def row(time: float | None) -> int:
        if time is None:
            return 0
        return min(round(time * trajectory.frame_rate), trajectory.frame_count - 1) + 1

    first = row(found.time)
    return found.with_values(first_row=first, last_row=max(row(found.end), first))


def _read(path: Path, most: int) -> bytes:
    with path.open("rb") as file:
        text = file.read(most + 1)
    if len(text) > most:
        raise BadInput(CLASS_FILE_TOO_LARGE(file=path.name, most=most))
    return text
