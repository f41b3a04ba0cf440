"""Writes files as a whole: a reader sees all of a file, or the one before it."""

from __future__ import annotations

import os
import secrets
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import BinaryIO

from mrlab_ros.adapters.diagnostics import FILE_UNWRITABLE
from mrlab_ros.core.base.diagnostic import Diagnostic
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.base.machine import remedy

TEMPORARY = ".writing-"  # with which the names of files begin that are not whole


@contextmanager
def replaced(path: Path, mode: int = 0o666) -> Iterator[BinaryIO]:
    """Yield a file that takes the place of `path` at the end; an error leaves the old one.

    mode: what the umask leaves of it is the new file's. A link is replaced, too: others could have
    put it there. Raises OSError that names `path`.
    """
    new = path.with_name(f"{TEMPORARY}{secrets.token_hex(8)}")
    flags = os.O_WRONLY | os.O_CREAT | os.O_EXCL | os.O_CLOEXEC
    try:
        with open(os.open(new, flags, mode), "wb", buffering=1 << 20) as file:
            yield file
        os.replace(new, path)
    except BaseException as error:
        with suppress(OSError):
            os.unlink(new)
        if isinstance(error, OSError) and error.filename in (None, str(new)):
            error.filename, error.filename2 = str(path), None
        raise


@contextmanager
def named_output(path: Path) -> Iterator[BinaryIO]:
    """Yield a file as replaced() does, for a path that the user of a command names.

    A link stays, and what it names is replaced; what is no file, such as /dev/stdout, is written.
    """
    if path.exists() and not path.is_file():
        with open(path, "wb") as file:
            yield file
    else:
        with replaced(Path(os.path.realpath(path))) as file:
            yield file


def write_text(path: Path, text: str) -> None:
    """Write a text as a whole, and the folder that it needs; raise BadInput where that fails."""
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        with named_output(path) as file:
            file.write(text.encode())
    except OSError as error:
        raise BadInput(unwritable(path, error)) from None


def unwritable(path: Path, error: OSError) -> Diagnostic:
    """Return what is said where a file or a folder cannot be written."""
    why = error.strerror or str(error)
    return FILE_UNWRITABLE(file=str(path), why=why, remedy=remedy(error))
