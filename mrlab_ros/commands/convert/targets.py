"""Where `mrlab convert` writes files and pictures; what cannot be written ends no batch."""

from __future__ import annotations

import contextlib
import sys
import tempfile
from collections import Counter
from collections.abc import Iterable, Iterator
from pathlib import Path

from mrlab_ros.core.errors import BadInput, Misuse

PICTURES = (".png", ".svg", ".html")


def check_free(targets: Iterable[Path], inputs: Iterable[Path], *, force: bool) -> None:
    """Raise Misuse where writing `targets` would replace an input, or any file without `force`."""
    there = [path for path in targets if path.exists()]
    read = {path.resolve(): path for path in inputs}
    for path in there:
        if path.resolve() in read:
            raise Misuse(
                f"'{path}' would be written and is read as well; give another folder with --out"
            )
    if there and not force:
        more = f" and {len(there) - 1} more" if len(there) > 1 else ""
        raise Misuse(
            f"'{there[0]}'{more} is there already and nothing was written; give another folder, "
            "or replace what is there with --force"
        )


class Targets:
    """The folders of a batch, and what could not be written into them."""

    def __init__(self, out: Path | None, plot: Path | None, count: int) -> None:
        """Make the folders for `count` inputs.

        Raises BadInput where nothing can be written there, Misuse where several inputs have one
        picture.
        """
        self._problems: list[str] = []
        folders = {"--out": out}
        if plot is not None:
            is_picture = plot.suffix in PICTURES
            if is_picture and count > 1:
                raise Misuse(
                    f"--plot '{plot}' is one picture, and there are {count} files; give a folder"
                )
            folders["--plot"] = plot.parent if is_picture else plot
        for option, folder in folders.items():
            if folder is not None:
                _make(option, folder)

    @contextlib.contextmanager
    def writing(self) -> Iterator[None]:
        """Keep what goes wrong while something is written for `report`."""
        try:
            yield
        except OSError as error:
            place = f" '{error.filename}'" if error.filename else ""
            self._problems.append(f"{error.strerror or error}{place}")

    def report(self) -> bool:
        """Say on stderr what was not written; return whether there was anything."""
        for problem, count in Counter(self._problems).items():
            times = f" ({count} times)" if count > 1 else ""
            print(f"not written{times}: {problem}", file=sys.stderr)
        return bool(self._problems)


def _make(option: str, folder: Path) -> None:
    try:
        folder.mkdir(parents=True, exist_ok=True)
        tempfile.TemporaryFile(dir=folder).close()
    except OSError as error:
        raise BadInput(
            f"{option} '{folder}' cannot be written ({error.strerror}); give a folder that you "
            "may write to"
        ) from None
