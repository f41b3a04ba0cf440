"""Folders that only their owner can enter, on a machine with other users."""

from __future__ import annotations

import os
import stat
from pathlib import Path

from mrlab_ros.core.errors import BadInput

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
            raise BadInput(f"{path} belongs to another user; expected a folder of yours")
        if stat.S_IMODE(found.st_mode) & 0o077:
            folder.chmod(MODE)
    except OSError as error:
        raise BadInput(
            f"{path} cannot be used: {error.strerror}; expected a folder, or a path where one can "
            "be made"
        ) from None
    return folder


def why_not(path: Path) -> str:
    """Return why nobody may rely on a folder of a known name being this user's; else empty.

    It may be missing where nobody else could make it: then `make` makes it.
    """
    try:
        found = path.lstat()
    except FileNotFoundError:
        return _why_not_within(path.parent)
    except OSError as error:
        return f"{path}: {error.strerror}"
    if not stat.S_ISDIR(found.st_mode):
        return f"{path} is no folder, or a link to one"
    if found.st_uid != os.getuid():
        return f"{path} belongs to another user"
    if stat.S_IMODE(found.st_mode) & 0o022:
        return f"others can write into {path}"
    return _why_not_within(path.parent)


def _why_not_within(folder: Path) -> str:
    """Return why others could exchange what this user makes in a folder; else empty."""
    try:
        found = folder.stat()
    except OSError as error:
        return f"{folder}: {error.strerror}"
    if found.st_uid not in (os.getuid(), 0):
        return f"{folder} belongs to another user"
    if stat.S_IMODE(found.st_mode) & 0o022 and not found.st_mode & stat.S_ISVTX:
        return f"others can exchange what lies in {folder}"
    return ""
