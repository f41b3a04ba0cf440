"""Looks for the file that was meant where there is none of that name."""

from __future__ import annotations

import os
from pathlib import Path

from mrlab_ros.adapters.diagnostics import FILE_MISSING, NOT_A_FILE
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.base.names import close_to


def close_file(path: Path) -> str | None:
    """Return the entry beside `path` whose name is closest; None where none is close."""
    try:
        beside = os.listdir(path.parent)
    except OSError:
        return None
    return close_to(path.name, (name for name in beside if not name.startswith(".")))


def check_file(path: Path, name: str = "") -> None:
    """Raise BadInput where `path` is no file: reading a pipe would wait forever.

    name: what the error calls it; empty: the path.
    """
    if path.is_file():
        return
    name = name or str(path)
    if not path.exists():
        raise BadInput(FILE_MISSING(file=name, close=close_file(path)))
    raise BadInput(NOT_A_FILE(file=name, what="folder" if path.is_dir() else "special"))
