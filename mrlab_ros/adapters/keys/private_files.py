"""Files that only their owner can read."""

from __future__ import annotations

import os
import stat
from pathlib import Path

from mrlab_ros.adapters.keys.diagnostics import KEY_FILE_OPEN, KEY_FILE_UNREADABLE, NO_KEY_FILE
from mrlab_ros.core.base.diagnostic import Fix
from mrlab_ros.core.base.errors import BadInput


def write(path: Path, data: bytes) -> None:
    """Write a file that only its owner can read; a reader sees all of it or the one before."""
    new = path.with_name(f".{path.name}.new")
    new.unlink(missing_ok=True)
    with open(os.open(new, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o600), "wb") as file:
        file.write(data)
        file.flush()
        os.fsync(file.fileno())
    new.replace(path)


def changed_at(path: Path) -> int:
    """Return when a file was changed last, ns since 1970; 0 where it cannot be seen."""
    try:
        return path.stat().st_mtime_ns
    except OSError:
        return 0


def check(path: Path) -> None:
    """Raise BadInput where a file is missing, or others on this machine can read it."""
    try:
        mode = stat.S_IMODE(path.stat().st_mode)
    except FileNotFoundError as error:
        raise BadInput(NO_KEY_FILE(path=str(path), fixes=(Fix(command="keys init"),))) from error
    except OSError as error:
        why = os.strerror(error.errno or 0)
        raise BadInput(KEY_FILE_UNREADABLE(path=str(path), why=why)) from error
    if mode & 0o077:
        raise BadInput(KEY_FILE_OPEN(path=str(path), mode=f"{mode:o}"))
