"""The folder of a graded class: every file is written as a whole, so a kill loses one at most."""

from __future__ import annotations

import fcntl
import json
import shutil
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import orjson

from mrlab_ros.adapters.whole_file import replaced, unwritable
from mrlab_ros.classroom.diagnostics import (
    CLASS_RUNS,
    NO_CLASS_FILE,
    NO_CLASS_FOLDER,
)
from mrlab_ros.core.base.diagnostic import Fix
from mrlab_ros.core.base.errors import BadInput, Misuse

CLASS, INDEX, TABLE, CHANGES = "class.json", "index.html", "grades.csv", "changes.json"
JOURNAL, WORKSHEET = "journal.jsonl", "worksheet.csv"
KEPT, PAGES, FEEDBACK, RESULTS, TRAJECTORIES, EVIDENCE = FOLDERS = (
    "kept", "pages", "feedback", "results", "trajectories", "evidence",
)  # fmt: skip
# What the next run reads, what the last one read, and the marks that a run proposes.
SOURCES, HELD, PROPOSED = "sources", "held", "proposed"
BEFORE = "before"  # what the run before the last one read, so that it can hold again
COURSE, HANDED_IN = "course.json", "handed_in"  # of the course that is connected
RUNNING = ".running"  # locked while a run writes
OWN = (
    CLASS, INDEX, TABLE, CHANGES, JOURNAL, WORKSHEET, *FOLDERS, SOURCES, HELD, PROPOSED, BEFORE,
    COURSE, HANDED_IN, RUNNING,
)  # fmt: skip


def check(folder: Path) -> None:
    """Raise BadInput where a folder holds what is not of a class, or cannot be made.

    An empty or a new one is one.
    """
    try:
        strange = [p.name for p in folder.iterdir() if p.name not in OWN]
    except FileNotFoundError as error:
        if not folder.absolute().parent.is_dir():
            raise BadInput(unwritable(folder, error)) from None
        return
    except OSError as error:
        raise BadInput(unwritable(folder, error)) from None
    if strange and not (folder / CLASS).is_file():
        make = Fix(command="mrlab class SUBMISSIONS --rubric RUBRIC.yaml --out FOLDER")
        raise BadInput(NO_CLASS_FILE(file=CLASS, folder=str(folder), fixes=(make,)))


class ResultsFolder:
    """A folder with the results of a class."""

    def __init__(self, path: Path) -> None:
        """Make the folder; raise Misuse where it holds what is not of a class."""
        self.path = path
        try:
            strange = (
                [p.name for p in path.iterdir() if p.name not in OWN] if path.exists() else []
            )
            own = any((path / name).exists() for name in (KEPT, CLASS, SOURCES))
            if strange and not own:
                raise Misuse(NO_CLASS_FOLDER(folder=str(path), found=strange[0]))
            for name in FOLDERS:
                (path / name).mkdir(parents=True, exist_ok=True)
        except OSError as error:
            raise BadInput(unwritable(path, error)) from None

    @contextmanager
    def alone(self) -> Iterator[None]:
        """Let nobody else write results here meanwhile; raise BadInput where somebody does."""
        with (self.path / RUNNING).open("wb") as file:
            try:
                fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
            except BlockingIOError:
                raise BadInput(CLASS_RUNS(folder=str(self.path))) from None
            yield

    def write(self, name: str, content: bytes) -> None:
        """Write a file by its path within the folder, replacing it as a whole."""
        path = self.path / name
        try:
            path.parent.mkdir(parents=True, exist_ok=True)
            with replaced(path) as file:
                file.write(content)
        except OSError as error:
            raise BadInput(unwritable(path, error)) from None

    def write_json(self, name: str, document: dict[str, Any]) -> None:
        """Write a mapping as a JSON file, as people read it."""
        self.write(name, orjson.dumps(document, option=orjson.OPT_INDENT_2))

    def kept(self, key: str, digest: str) -> dict[str, Any] | None:
        """Return the result of a key that was kept with a digest, None where none is whole."""
        content = self.document(f"{KEPT}/{key}.json")
        found = content.get("result") if content.get("digest") == digest else None
        return found if isinstance(found, dict) else None

    def keep(self, key: str, digest: str, result: dict[str, Any], checked: str) -> None:
        """Keep the result of a key, when everything else of it is written; checked: the digest of
        its evidence."""
        kept = {"digest": digest, "checked": checked, "result": result}
        self.write(f"{KEPT}/{key}.json", orjson.dumps(kept))

    def evidence(self, key: str, checked: str) -> bytes:
        """Return the evidence of a key that was kept with a digest, none where there is none."""
        if self.document(f"{KEPT}/{key}.json").get("checked") != checked:
            return b""
        return self.content(f"{EVIDENCE}/{key}")

    def forget(self, key: str) -> None:
        """Forget the result of a key, before anything of another one is written."""
        (self.path / KEPT / f"{key}.json").unlink(missing_ok=True)

    def document(self, name: str) -> dict[str, Any]:
        """Return the mapping in a JSON file, an empty one where there is none to be read."""
        try:
            content = json.loads(self.content(name))
        except ValueError:
            return {}
        return content if isinstance(content, dict) else {}

    def content(self, name: str) -> bytes:
        """Return the bytes of a file, none where it cannot be read."""
        try:
            return (self.path / name).read_bytes()
        except OSError:
            return b""

    def has(self, name: str) -> bool:
        """Return whether a file is there."""
        return (self.path / name).is_file()

    def tidy(self, folder: str, names: Iterable[str]) -> None:
        """Remove from one of the folders what is of nobody in the class any more."""
        wanted = set(names)
        for path in (self.path / folder).iterdir():
            if path.name in wanted:
                continue
            if path.is_dir() and not path.is_symlink():
                shutil.rmtree(path, ignore_errors=True)
            else:
                path.unlink(missing_ok=True)
