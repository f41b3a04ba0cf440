"""Where `mrlab convert` writes files and pictures; what cannot be written ends no batch."""

from __future__ import annotations

import contextlib
import os
import sys
import tempfile
from collections import Counter
from collections.abc import Iterable, Iterator
from pathlib import Path

from mrlab_ros.commands.convert.diagnostics import (
    FOLDER_NOT_WRITABLE,
    NOT_WRITTEN,
    ONE_PICTURE,
    TARGET_THERE,
    WOULD_REPLACE_INPUT,
)
from mrlab_ros.core.base.errors import BadInput, Misuse

PICTURES = (".png", ".svg", ".html")


def check_free(targets: Iterable[Path], inputs: Iterable[Path], *, force: bool) -> None:
    """Raise Misuse where writing `targets` would replace an input, or any file without `force`."""
    there = [path for path in targets if path.exists()]
    # not Path.resolve, which raises for a loop of links
    read = set(map(os.path.realpath, inputs))
    for path in there:
        if os.path.realpath(path) in read:
            raise Misuse(WOULD_REPLACE_INPUT(file=str(path)))
    if there and not force:
        raise Misuse(TARGET_THERE(file=str(there[0]), more=len(there) - 1 or None))


class Targets:
    """The folders of a batch, and what could not be written into them."""

    def __init__(self, out: Path | None, plot: Path | None, count: int) -> None:
        """Make the folders for `count` inputs.

        Raises BadInput where nothing can be written there, Misuse where several inputs have one
        picture.
        """
        self._problems: list[tuple[str, str]] = []
        folders = {"out": out}
        if plot is not None:
            is_picture = plot.suffix in PICTURES
            if is_picture and count > 1:
                raise Misuse(ONE_PICTURE(file=str(plot), count=count))
            folders["plot"] = plot.parent if is_picture else plot
        for option, folder in folders.items():
            if folder is not None:
                _make(option, folder)

    @contextlib.contextmanager
    def writing(self) -> Iterator[None]:
        """Keep what goes wrong while something is written for `report`."""
        try:
            yield
        except OSError as error:
            self._problems.append((error.strerror or str(error), str(error.filename or "")))

    def report(self) -> bool:
        """Say on stderr what was not written; return whether there was anything."""
        for (why, file), count in Counter(self._problems).items():
            times = count if count > 1 else None
            print(NOT_WRITTEN(times=times, error=why, file=file), file=sys.stderr)
        return bool(self._problems)


def _make(option: str, folder: Path) -> None:
    try:
        folder.mkdir(parents=True, exist_ok=True)
        tempfile.TemporaryFile(dir=folder).close()
    except OSError as error:
        raise BadInput(
            FOLDER_NOT_WRITABLE(option=option, folder=str(folder), error=error.strerror)
        ) from None
