"""Calls a function on a file from outside in a process in the sandbox.

The function prints as any other; its output comes back as text.
"""

from __future__ import annotations

import io
import os
import shutil
import tempfile
from collections.abc import Callable, Iterable
from contextlib import redirect_stderr, redirect_stdout
from dataclasses import dataclass
from importlib import import_module
from pathlib import Path
from typing import Any

from mrlab_ros.adapters import installed, share
from mrlab_ros.adapters.sandbox import calls

# Of a bag: a session of hours is decoded whole, and inflated on the way.
MOST_MEMORY, MOST_TIME, MOST_FILE = 8 << 30, 3600.0, 1 << 40  # bytes, s, bytes
KEPT = ("HOME", "TZ", "MRLAB_ROBOTS")


@dataclass(frozen=True)
class Called:
    """The value that a function returned, and the text that it printed."""

    value: Any
    out: str
    err: str


def call(
    function: Callable[..., Any],
    *arguments: Any,
    name: str,
    read: Iterable[Path],
    write: Iterable[Path] = (),
) -> Called:
    """Call a function of a module; its arguments and its value are JSON.

    name: the file's, for errors. read, write: files and folders that it reaches, besides Python,
    the packages and the lab's own files. Raises BadInput where it does.
    """
    kept = {key: os.environ[key] for key in KEPT if key in os.environ}
    known = [
        *share.folders(),
        share.imported_folder(),
        *installed.packages(),
        *installed.indices(),
    ]
    with tempfile.TemporaryDirectory(prefix="mrlab-") as scratch:
        places = {"TMPDIR": scratch, "MPLCONFIGDIR": scratch}
        width = {"COLUMNS": str(shutil.get_terminal_size().columns)}
        said = calls.call(
            printed, function.__module__, function.__qualname__, arguments, name=name,
            read=[path for path in (*known, *read) if path.exists()],
            write=[Path(scratch), *write], memory=MOST_MEMORY, seconds=MOST_TIME,
            file_size=MOST_FILE, environment=kept | places | width, folder=Path.cwd(),
        )  # fmt: skip
    return Called(**said)


def printed(module: str, function: str, arguments: list[Any]) -> dict[str, Any]:
    """Call a function; return what it printed and what it returned."""
    out, err = io.StringIO(), io.StringIO()
    with redirect_stdout(out), redirect_stderr(err):
        value = getattr(import_module(module), function)(*arguments)
    return {"out": out.getvalue(), "err": err.getvalue(), "value": value}
