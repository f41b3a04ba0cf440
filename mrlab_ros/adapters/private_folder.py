"""Folders that only their owner can enter, on a machine with other users."""

from __future__ import annotations

import os
import stat
from pathlib import Path

from mrlab_ros.adapters.diagnostics import (
    FOLDER_OF_ANOTHER,
    FOLDER_UNUSABLE,
    NOT_A_FOLDER,
    OTHERS_EXCHANGE,
    OTHERS_WRITE,
)
from mrlab_ros.core.base.diagnostic import Diagnostic
from mrlab_ros.core.base.errors import BadInput

MODE = 0o700


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
