"""The sandboxed process that reads the export of a class; started by `submissions`.

It reads a folder or a zip archive without writing or following anything. Whatever an archive says
of itself, no more is read than the limits allow, and names are only names. A file that is not read
is an entry all the same, so that its student has a row that says why. Decompressors that inflate a
whole block at once meet the limit of memory that the kernel keeps.
"""

from __future__ import annotations

import io
import json
import os
import re
import stat
import sys
import zipfile
from collections.abc import Callable, Iterator, Mapping
from multiprocessing.connection import Connection
from pathlib import Path, PurePosixPath
from typing import Any

import yaml

from mrlab_ros.adapters.sandbox import restrictions
from mrlab_ros.adapters.sandbox.inert_output import guard
from mrlab_ros.classroom.diagnostics import (
    ENCRYPTED_FILE,
    INFLATES_TOO_FAR,
    LARGER_THAN_NEEDED,
    LINK_NOT_FOLLOWED,
    NAME_LEADS_OUT,
    NAMES_NOT_KNOWN,
    NO_EXPORT,
    NO_ORDINARY_FILE,
    NO_ZIP,
    NOT_READABLE,
    NOT_UNPACKED,
    TOO_MANY_FILES,
    TWICE_IN_ARCHIVE,
)
from mrlab_ros.classroom.marks.exports import ARCHIVE, METADATA, Entry
from mrlab_ros.core.base.diagnostic import Diagnostic, from_plain, plain
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.base.foreign_text import file_name

MiB = 1 << 20
MOST_FILES = 200_000
MOST_BYTES = 64 * MiB  # of one file
MOST_INNER_FILES, MOST_INNER_BYTES = 500, 256 * MiB  # of an archive that a student sent
ENCRYPTED = 0x1
DRIVE = re.compile(r"[A-Za-z]:.*", re.DOTALL)
NAMELESS = "no name"
MEMORY, SECONDS = 1024 * MiB, 900.0  # of the process, for a whole export
# First bytes of what it sends: an archive that it opens, the listing, a file, a problem.
OPENS, LISTED, CONTENT, PROBLEM = b"@", b"=", b"+", b"!"


class Contents:
    """The files of an export. problems: path and why of what is not read."""

    def __init__(
        self,
        path: Path,
        skipped: Mapping[str, Diagnostic] | None = None,
        opens: Callable[[str], None] = lambda _: None,
    ) -> None:
        """List what is there; raise BadInput where it is neither a folder nor a zip archive.

        skipped: archives that are not opened, and why. opens: called with the path of each other.
        """
        self.path = path
        self._skipped, self._opens = skipped or {}, opens
        self.problems: list[tuple[str, Diagnostic]] = []
        self._archive: zipfile.ZipFile | None = None
        self._members: dict[str, zipfile.ZipInfo] = {}
        self._inner: dict[str, tuple[str, zipfile.ZipInfo]] = {}
        self._places: dict[str, Path] = {}
        self._refused: dict[str, Diagnostic] = {}
        if path.is_dir():
            found = list(self._folder())
        elif path.is_file():
            self._archive = _opened(path, path.name)
            self._members, found = self._listed(self._archive, path.name, MOST_FILES)
        else:
            raise BadInput(NO_EXPORT(file=str(path)))
        self.entries = [each for entry in found for each in self._with_inner(entry)]

    def close(self) -> None:
        if self._archive is not None:
            self._archive.close()

    def __enter__(self) -> Contents:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def read(self, path: str) -> bytes:
        """Return the bytes of an entry; raise BadInput where they cannot be read."""
        if path in self._refused:
            raise BadInput(self._refused[path])
        if path in self._inner:
            outer, member = self._inner[path]
            with _opened(io.BytesIO(self._bytes(outer)), outer) as archive:
                return _inflated(archive, member, path)
        return self._bytes(path)

    def metadata(self) -> Mapping[str, Any]:
        """Return Gradescope's submission_metadata.yml; empty where there is none to be read."""
        named = [p for p in self._paths if PurePosixPath(p).name == METADATA]
        if not named:
            return {}
        try:
            # Every value as it is written: a number such as 0412346 is no octal one, and the
            # times are objects of Ruby.
            content = yaml.load(self._bytes(named[0]), yaml.CBaseLoader)
        except (yaml.YAMLError, BadInput, RecursionError, ValueError) as error:
            why = getattr(error, "diagnostic", None) or str(error)
            self.problems.append((named[0], NAMES_NOT_KNOWN(why=why)))
            return {}
        return content if isinstance(content, Mapping) else {}

    @property
    def _paths(self) -> list[str]:
        return list(self._members) or [e.path for e in self.entries]

    def _bytes(self, path: str) -> bytes:
        if self._archive is not None:
            return _inflated(self._archive, self._members[path], path)
        try:
            source = os.open(self._places[path], os.O_RDONLY | os.O_NONBLOCK | os.O_NOFOLLOW)
            with os.fdopen(source, "rb") as file:
                content = file.read(MOST_BYTES + 1)
        except OSError as error:
            raise BadInput(NOT_READABLE(file=path, why=error.strerror)) from None
        return _bounded(content, path)

    def _folder(self) -> Iterator[Entry]:
        count = 0
        for folder, folders, files in os.walk(self.path):
            folders.sort()
            within = Path(folder).relative_to(self.path)
            for name in [n for n in folders if (Path(folder) / n).is_symlink()]:
                path = file_name((within / name).as_posix())
                self.problems.append((path, LINK_NOT_FOLLOWED()))
            for name in sorted(files):
                path = file_name((within / name).as_posix())
                while path in self._places:  # two names whose bytes are no UTF-8
                    path = f"{path.removesuffix(Path(path).suffix)}+{Path(path).suffix}"
                self._places[path] = Path(folder) / name
                try:
                    about = os.lstat(Path(folder) / name)
                except OSError as error:
                    yield self._refuse(path, NOT_READABLE(file=path, why=error.strerror))
                    continue
                if not stat.S_ISREG(about.st_mode):
                    link = stat.S_ISLNK(about.st_mode)
                    yield self._refuse(path, LINK_NOT_FOLLOWED() if link else NO_ORDINARY_FILE())
                    continue
                count += 1
                if count > MOST_FILES:
                    raise BadInput(TOO_MANY_FILES(file=str(self.path), most=MOST_FILES))
                yield Entry(path, about.st_size, (int(about.st_mtime),))

    def _refuse(self, path: str, why: Diagnostic) -> Entry:
        """Return the entry of a file that is not read."""
        self._refused[path] = why
        self.problems.append((path, why))
        return Entry(path)

    def _listed(
        self, archive: zipfile.ZipFile, name: str, most: int, folder: str = ""
    ) -> tuple[dict[str, zipfile.ZipInfo], list[Entry]]:
        """Return the members that are read, and all entries. folder: put before the paths."""
        members: dict[str, zipfile.ZipInfo] = {}
        entries: dict[str, Entry] = {}
        if len(archive.infolist()) > most:
            raise BadInput(TOO_MANY_FILES(file=name, most=most))
        for info in archive.infolist():
            path = _name(info)
            if path.endswith("/"):
                continue
            inside = folder + _inside(path)
            why = _not_read(info, path)
            if why is not None:
                if inside not in members:
                    entries[inside] = self._refuse(inside, why)
                continue
            if inside in members:
                self.problems.append((inside, TWICE_IN_ARCHIVE()))
            self._refused.pop(inside, None)
            members[inside] = info
            entries[inside] = Entry(inside, info.file_size, tuple(info.date_time))
        return members, list(entries.values())

    def _with_inner(self, entry: Entry) -> Iterator[Entry]:
        """Yield an entry; of an archive that a student sent, what is in it, one level deep."""
        if not entry.path.lower().endswith(ARCHIVE) or entry.path in self._refused:
            yield entry
            return
        if entry.path in self._skipped:
            yield self._refuse(entry.path, self._skipped[entry.path])
            return
        self._opens(entry.path)
        try:
            with _opened(io.BytesIO(self._bytes(entry.path)), entry.path) as archive:
                folder = f"{entry.path}/"
                members, found = self._listed(archive, entry.path, MOST_INNER_FILES, folder)
                if sum(each.size for each in found) > MOST_INNER_BYTES:
                    raise BadInput(INFLATES_TOO_FAR(file=entry.path, most=MOST_INNER_BYTES))
                for path, info in members.items():
                    self._inner[path] = (entry.path, info)
                yield from found
        except BadInput as error:
            self._refuse(entry.path, error.diagnostic)
            yield entry


def _opened(file: Path | io.BytesIO, name: str) -> zipfile.ZipFile:
    try:
        return zipfile.ZipFile(file)
    except Exception as error:  # a damaged directory ends in whatever reads it first
        raise BadInput(NO_ZIP(file=name, why=_why(error))) from None


def _name(info: zipfile.ZipInfo) -> str:
    """Return a member's name: many programs write UTF-8 without saying so."""
    name = info.filename
    if not info.flag_bits & 0x800:
        try:
            name = name.encode("cp437").decode("utf-8")
        except UnicodeError:
            name = info.filename
    return file_name(name.replace("\\", "/"))


def _inside(path: str) -> str:
    """Return a member's name as a path within its archive, never empty."""
    parts = [p for p in path.split("/") if p not in ("", ".", "..") and not DRIVE.fullmatch(p)]
    return "/".join(parts) or NAMELESS


def _not_read(info: zipfile.ZipInfo, path: str) -> Diagnostic | None:
    """Return why a member is not read, None where it is."""
    parts = PurePosixPath(path).parts
    if path.startswith("/") or ".." in parts or not parts or DRIVE.fullmatch(parts[0]):
        return NAME_LEADS_OUT()
    if stat.S_ISLNK(info.external_attr >> 16):
        return LINK_NOT_FOLLOWED()
    if info.flag_bits & ENCRYPTED:
        return ENCRYPTED_FILE()
    return None


def _inflated(archive: zipfile.ZipFile, info: zipfile.ZipInfo, path: str) -> bytes:
    try:
        with archive.open(info) as file:
            return _bounded(file.read(MOST_BYTES + 1), path)
    except BadInput:
        raise
    except MemoryError:
        raise BadInput(LARGER_THAN_NEEDED(file=path, most=MOST_BYTES)) from None
    except Exception as error:  # as above
        raise BadInput(NOT_UNPACKED(file=path, why=_why(error))) from None


def _why(error: Exception) -> str:
    return str(error) or type(error).__name__


def _bounded(content: bytes, path: str) -> bytes:
    if len(content) > MOST_BYTES:
        raise BadInput(LARGER_THAN_NEEDED(file=path, most=MOST_BYTES))
    return content


def main() -> None:
    """Answer over the connection whose descriptor is the first argument, until it closes.

    The second argument is the export. The first message holds the archives to skip, all later ones
    are paths to read.
    """
    guard()
    connection, path = Connection(int(sys.argv[1])), Path(sys.argv[2])
    skipped = {name: from_plain(why) for name, why in json.loads(connection.recv_bytes()).items()}
    restrictions.confine(memory=MEMORY, seconds=SECONDS, file_size=0)
    restrictions.shut(read=[*restrictions.libraries(), path.resolve()], opens=True)

    def said(tag: bytes, value: Any) -> None:
        connection.send_bytes(tag + json.dumps(value).encode())

    try:
        contents = Contents(path, skipped, lambda name: said(OPENS, name))
        listed = {
            "metadata": contents.metadata(),
            "entries": [[e.path, e.size, e.modified] for e in contents.entries],
            "problems": [[name, plain(why)] for name, why in contents.problems],
        }
    except BadInput as error:
        said(PROBLEM, plain(error.diagnostic))
        return
    said(LISTED, listed)
    while True:
        try:
            name = connection.recv_bytes().decode("utf-8", "surrogatepass")
        except (EOFError, ConnectionError):
            return
        try:
            content = contents.read(name)
        except BadInput as error:
            said(PROBLEM, plain(error.diagnostic))
        else:
            connection.send_bytes(CONTENT + content)


if __name__ == "__main__":
    main()
