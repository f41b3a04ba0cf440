"""Reads the folder of a graded class: class.json, and the motion of each student."""

from __future__ import annotations

import threading
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import orjson

from mrlab_ros.adapters.trajectories import json_file
from mrlab_ros.core.base.diagnostic import Diagnostic, Severity
from mrlab_ros.core.errors import BadInput, Unavailable
from mrlab_ros.core.trajectory.trajectory import Trajectory
from mrlab_ros.gateway.errors import NotFound
from mrlab_ros.gateway.settings import CLASS_FILE

SCHEMA = "mrlab.class.1"
MiB = 1 << 20
LARGEST_CLASS, LARGEST_MOTION = 256 * MiB, 256 * MiB
# The motion of the solution has this key.
REFERENCE = "reference"
# The code of lost points, beside those of a check.
LOST = "test"


class ClassFolder:
    """One class; read again when its file has changed, so that a class may go on meanwhile."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self._lock = threading.Lock()
        self._known: tuple[tuple[int, int], dict[str, Any]] | None = None

    def document(self) -> dict[str, Any]:
        """Return class.json; raise Unavailable where it is gone, BadInput where it is none."""
        path = self.folder / CLASS_FILE
        with self._lock:
            try:
                status = path.stat()
                identity = (status.st_mtime_ns, status.st_size)
                if self._known is not None and self._known[0] == identity:
                    return self._known[1]
                text = _read(path, LARGEST_CLASS)
            except OSError as error:
                raise Unavailable(
                    f"the class cannot be read: {error.strerror}; let mrlab class write it again"
                ) from None
            try:
                found: dict[str, Any] = orjson.loads(text)
            except orjson.JSONDecodeError as error:
                raise BadInput(
                    f"{CLASS_FILE} is no JSON: {error}; run mrlab class again"
                ) from None
            schema = found.get("schema") if isinstance(found, dict) else None
            if schema != SCHEMA:
                raise BadInput(
                    f"{CLASS_FILE} has the schema {schema!r}; expected {SCHEMA}: run mrlab "
                    "class of this version again"
                )
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
        raise NotFound(f"there is no submission '{key}' in this class; choose one of its list")

    def trajectory(self, key: str) -> Trajectory:
        """Return a student's motion; raise NotFound where there is none."""
        entry = self.entry(key)
        named = entry.get("trajectory")
        if not named:
            words = entry.get("words") or "no motion was found in it"
            raise NotFound(f"the submission '{key}' has no motion to show: {words}")
        path = (self.folder / named).resolve()
        if not path.is_relative_to(self.folder.resolve()):
            raise NotFound(f"the motion of '{key}' lies outside the folder of the class")
        try:
            return json_file.parse(_read(path, LARGEST_MOTION), path.name)
        except OSError as error:
            raise NotFound(
                f"the motion of '{key}' is not there ({error.strerror}); run mrlab class again"
            ) from None


def findings(entry: Mapping[str, Any], trajectory: Trajectory) -> list[Diagnostic]:
    """Return lost points, then what the check found, as findings of the motion's frames."""
    found = list(_lost(entry))
    found += entry.get("findings", ())
    return [_diagnostic(each, trajectory) for each in found]


def _lost(entry: Mapping[str, Any]) -> Iterator[Mapping[str, Any]]:
    for mark in entry.get("marks", ()):
        if not mark["passed"]:
            yield {
                **mark,
                "code": LOST,
                "severity": "warning" if mark["points"] > 0 else "error",
                "message": f"{mark['name']}: {mark['words']}",
                "remedy": mark.get("hint", ""),
            }


def _diagnostic(found: Mapping[str, Any], trajectory: Trajectory) -> Diagnostic:
    def row(time: float | None) -> int:
        if time is None:
            return 0
        return min(round(time * trajectory.frame_rate), trajectory.frame_count - 1) + 1

    first = row(found.get("time"))
    last = row(found.get("end"))
    return Diagnostic(
        str(found["code"]),
        Severity[str(found["severity"]).upper()],
        str(found["message"]),
        str(found.get("remedy", "")),
        {
            "first_row": first,
            "last_row": max(last, first),
            "joint": found.get("link"),
            "value": found.get("value", found.get("measured")),
            "limit": found.get("limit"),
            "unit": found.get("unit"),
        },
    )


def _read(path: Path, most: int) -> bytes:
    with path.open("rb") as file:
        text = file.read(most + 1)
    if len(text) > most:
        raise BadInput(f"{path.name} has more than {most / MiB:.0f} MiB; it is no file of a class")
    return text
