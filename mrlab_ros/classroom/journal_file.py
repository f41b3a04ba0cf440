"""The file of a class' journal: a line an act, appended whole under a lock."""

from __future__ import annotations

import errno
import fcntl
import json
import os
from collections.abc import Callable
from dataclasses import asdict
from pathlib import Path

from mrlab_ros.adapters.whole_file import unwritable
from mrlab_ros.classroom.folder import JOURNAL
from mrlab_ros.classroom.marks.journal import Entry, State, state_of
from mrlab_ros.core.base.errors import BadInput


class JournalFile:
    """The journal in a folder of a class."""

    def __init__(self, folder: Path) -> None:
        self.path = folder / JOURNAL

    def entries(self) -> list[Entry]:
        """Return all acts; a line that a kill cut off is none. Raises BadInput."""
        try:
            text = self.path.read_bytes()
        except FileNotFoundError:
            return []
        except OSError as error:
            raise BadInput(unwritable(self.path, error)) from None
        found = []
        for line in text.splitlines():
            try:
                found.append(Entry(**json.loads(line)))
            except (ValueError, TypeError):
                continue
        return found

    def state(self) -> State:
        """Return what holds now."""
        return state_of(self.entries())

    def append(self, made: Callable[[State], list[Entry]]) -> State:
        """Append the acts that are made from what holds, while nobody else does; return what holds
        then. Raises BadInput, and what `made` raises."""
        try:
            with self.path.open("a+b", buffering=0) as file:
                fcntl.flock(file, fcntl.LOCK_EX)
                before = self.entries()
                new = made(state_of(before))
                size = file.tell()
                whole = not size or self.path.read_bytes().endswith(b"\n")
                lines = [json.dumps(asdict(entry)) for entry in new]
                text = "".join([*([] if whole else ["\n"]), *(f"{line}\n" for line in lines)])
                data = text.encode()
                try:
                    if file.write(data) < len(data):
                        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
                    os.fsync(file.fileno())
                except OSError:
                    file.truncate(size)  # acts of one press hold all or none
                    raise
        except OSError as error:
            raise BadInput(unwritable(self.path, error)) from None
        return state_of([*before, *new])
