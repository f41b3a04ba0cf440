"""Keeps a process's journal in a file: always whole, and without new space on the disk.

Keeps what cannot be used under another name, so that nothing is lost.
"""

from __future__ import annotations

import os
import shutil
import threading
import time
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from mrlab_ros.adapters.diagnostics import COPY_KEPT, NOT_SET_ASIDE, SET_ASIDE
from mrlab_ros.core.base.diagnostic import Diagnostic
from mrlab_ros.core.base.machine import lacking
from mrlab_ros.core.runtime import journal_format


def set_aside(path: Path, *, copy: bool = False) -> Diagnostic:
    """Rename or copy what is damaged to NAME.damaged-TIME; return what is said of that."""
    stamp = time.strftime("%Y-%m-%dT%H-%M-%S")
    number = 1
    aside = path.with_name(f"{path.name}.damaged-{stamp}")
    while os.path.lexists(aside):
        number += 1
        aside = path.with_name(f"{path.name}.damaged-{stamp}-{number}")
    try:
        if copy:
            shutil.copy2(path, aside)
        else:
            path.rename(aside)
    except OSError as error:
        return NOT_SET_ASIDE(problem=error.strerror)
    return (COPY_KEPT if copy else SET_ASIDE)(file=aside.name)


SUFFIX = ".journal"


def peek(state_dir: str, name: str) -> dict[str, Any] | None:
    """Return what the journal of another node holds; None: none is there that can be read."""
    try:
        found = journal_format.newest(Path(state_dir, f"{name}{SUFFIX}").read_bytes())
    except OSError:
        return None
    return None if found is None else found[1]


OPENED = os.O_RDWR | os.O_CREAT | os.O_TRUNC | os.O_CLOEXEC | os.O_NOFOLLOW


class Journal:
    """One mapping, of texts, numbers, lists and mappings, that outlives the process.

    path: None: nothing is kept. log: takes what went wrong, once until it is something else. Safe
    from several threads.
    """

    def __init__(self, path: Path | None, log: Callable[[str], None]) -> None:
        self._path = path
        self._log = log
        self._lock = threading.Lock()
        self._file: int | None = None
        self._size = 0
        self._number = 0
        self._saved: Mapping[str, Any] | None = None
        self._failed = ""

    @classmethod
    def of(cls, state_dir: str, name: str, log: Callable[[str], None]) -> Journal:
        """Return the journal called `name` in a state folder; without a folder nothing is kept."""
        return cls(Path(state_dir) / f"{name}{SUFFIX}" if state_dir else None, log)

    def load(self) -> dict[str, Any]:
        """Return what was saved last, empty where nothing was.

        A file without one complete write is renamed and logged.
        """
        path = self._path
        if path is None or not os.path.lexists(path):
            return {}
        try:
            file = path.read_bytes()
        except OSError as error:
            self._log(f"{path} cannot be read: {error.strerror}; the node starts without it")
            return {}
        found = journal_format.newest(file)
        if found is None:
            if file:
                self._log(f"{path} is damaged. {set_aside(path)}; the node starts without it")
            return {}
        with self._lock:
            self._number = found[0]
        return found[1]

    def save(self, content: Mapping[str, Any]) -> bool:
        """Write `content` where it differs from the last one; return whether it is kept."""
        if self._path is None:
            return True
        with self._lock:
            if content == self._saved:
                return True
            try:
                self._write(self._path, journal_format.pack(self._number + 1, content))
            except OSError as error:
                why = lacking(error) or error.strerror
                said = f"{self._path} cannot be written, a restart will not know: {why}"
                if said != self._failed:
                    self._log(said)
                self._failed = said
                return False
            self._number += 1
            self._saved, self._failed = content, ""
            return True

    def close(self) -> None:
        with self._lock:
            if self._file is not None:
                os.close(self._file)
                self._file = None

    def _write(self, path: Path, slot: bytes) -> None:
        if self._file is None or len(slot) > self._size:
            self._begin(path, slot)
            return
        offset = self._size * ((self._number + 1) % 2)
        written = os.pwrite(self._file, slot, offset)
        if written != len(slot):
            raise OSError(0, "the disk took only a part")

    def _begin(self, path: Path, slot: bytes) -> None:
        """Replace the file by one with room for `slot`, which it holds already."""
        path.parent.mkdir(mode=0o700, parents=True, exist_ok=True)
        size = journal_format.slot_size(len(slot))
        new = path.with_name(f"{path.name}.new")
        file = os.open(new, OPENED, 0o600)
        try:
            # Space that is taken now cannot be missing later.
            os.posix_fallocate(file, 0, 2 * size)
            os.pwrite(file, slot, size * ((self._number + 1) % 2))
            new.replace(path)
        except OSError:
            os.close(file)
            raise
        if self._file is not None:
            os.close(self._file)
        self._file, self._size = file, size
