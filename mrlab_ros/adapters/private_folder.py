"""Folders that only their owner can enter, on a machine with other users."""

from __future__ import annotations

import fcntl
import os
import stat
from contextlib import suppress
from pathlib import Path

from mrlab_ros.adapters.diagnostics import (
    FOLDER_HELD,
    FOLDER_OF_ANOTHER,
    FOLDER_UNUSABLE,
    NOT_A_FOLDER,
    OTHERS_EXCHANGE,
    OTHERS_WRITE,
)
from mrlab_ros.core.base.diagnostic import Diagnostic
from mrlab_ros.core.base.errors import BadInput, Misuse

MODE = 0o700
LOCK = ".lock"


def make(path: Path) -> Path:
    """Make a folder of this user alone, or close one that is this user's; return it resolved.

    Raises BadInput where it is another user's, or cannot be made.
    """
    try:
        path.mkdir(mode=MODE, parents=True, exist_ok=True)
        folder = path.resolve()
        found = folder.stat()
        if found.st_uid != os.getuid():
            raise BadInput(FOLDER_OF_ANOTHER(path=str(path)))
        if stat.S_IMODE(found.st_mode) & 0o077:
            folder.chmod(MODE)
    except OSError as error:
        raise BadInput(FOLDER_UNUSABLE(path=str(path), problem=error.strerror)) from None
    return folder


def hold(folder: Path) -> int | None:
    """Take a folder for this process; raise Misuse where another process has it.

    Returns the descriptor of a lock, which the kernel releases with the process at the latest;
    None: nothing can be written there, so nobody has it.
    """
    try:
        lock = os.open(folder / LOCK, os.O_RDWR | os.O_CREAT | os.O_NOFOLLOW | os.O_CLOEXEC, 0o600)
    except OSError:
        return None
    try:
        fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        pid = os.read(lock, 20).decode("ascii", "ignore")
        os.close(lock)
        raise Misuse(FOLDER_HELD(path=str(folder), pid=pid)) from None
    with suppress(OSError):  # a full disk: only the number of the process is missing then
        os.truncate(lock, 0)
        os.write(lock, str(os.getpid()).encode())
    return lock


def why_not(path: Path) -> Diagnostic | None:
    """Return why nobody may rely on a folder of a known name being this user's; None: one may.

    It may be missing where nobody else could make it: then `make` makes it.
    """
    try:
        found = path.lstat()
    except FileNotFoundError:
        return _why_not_within(path.parent)
    except OSError as error:
        return FOLDER_UNUSABLE(path=str(path), problem=error.strerror)
    if not stat.S_ISDIR(found.st_mode):
        return NOT_A_FOLDER(path=str(path))
    if found.st_uid != os.getuid():
        return FOLDER_OF_ANOTHER(path=str(path))
    if stat.S_IMODE(found.st_mode) & 0o022:
        return OTHERS_WRITE(path=str(path))
    return _why_not_within(path.parent)


def _why_not_within(folder: Path) -> Diagnostic | None:
    """Return why others could exchange what this user makes in a folder; None: they cannot.

    Whoever may rename any folder above it can put another one in its place.
    """
    try:
        way = folder.resolve(strict=True)
        for above in (way, *way.parents):
            found = above.stat()
            if found.st_uid not in (os.getuid(), 0):
                return FOLDER_OF_ANOTHER(path=str(above))
            if stat.S_IMODE(found.st_mode) & 0o022 and not found.st_mode & stat.S_ISVTX:
                return OTHERS_EXCHANGE(path=str(above))
    except OSError as error:
        return FOLDER_UNUSABLE(path=str(folder), problem=error.strerror)
    return None
