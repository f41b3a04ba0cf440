"""Reads the export of a class, a folder or a zip archive, without writing or following anything.

Whatever an archive says of itself, no more is read than the limits allow: bytes are counted as
they are inflated, and names are only names.
"""

from __future__ import annotations

import io
import os
import stat
import zipfile
import zlib
from collections.abc import Iterator, Mapping
from pathlib import Path, PurePosixPath
from typing import Any

import yaml

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
from mrlab_ros.core.base.diagnostic import Diagnostic
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.base.foreign_text import file_name

MiB = 1 << 20
MOST_FILES = 200_000
MOST_BYTES = 64 * MiB  # of one file
MOST_INNER_FILES, MOST_INNER_BYTES = 500, 256 * MiB  # of an archive that a student sent
ENCRYPTED = 0x1


class Export:
    """The files of an export. problems: path and why of what is not read."""

    def __init__(self, path: Path) -> None:
        """List what is there; raise BadInput where it is neither a folder nor a zip archive."""
        self.path = path
        self.problems: list[tuple[str, Diagnostic]] = []
        self._archive: zipfile.ZipFile | None = None
        self._members: dict[str, zipfile.ZipInfo] = {}
        self._inner: dict[str, tuple[str, str]] = {}
        self._places: dict[str, Path] = {}
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

    def __enter__(self) -> Export:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def read(self, path: str) -> bytes:
        """Return the bytes of an entry; raise BadInput where they cannot be read."""
        if path in self._inner:
            outer, member = self._inner[path]
            with _opened(io.BytesIO(self._bytes(outer)), outer) as archive:
                return _inflated(archive, archive.getinfo(member), path)
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
                self._places[path] = Path(folder) / name
                try:
                    about = os.lstat(Path(folder) / name)
                except OSError as error:
                    self.problems.append((path, NOT_READABLE(file=path, why=error.strerror)))
                    continue
                if not stat.S_ISREG(about.st_mode):
                    link = stat.S_ISLNK(about.st_mode)
                    why = LINK_NOT_FOLLOWED if link else NO_ORDINARY_FILE
                    self.problems.append((path, why()))
                    continue
                count += 1
                if count > MOST_FILES:
                    raise BadInput(TOO_MANY_FILES(file=str(self.path), most=MOST_FILES))
                yield Entry(path, about.st_size, (int(about.st_mtime),))

    def _listed(
        self, archive: zipfile.ZipFile, name: str, most: int
    ) -> tuple[dict[str, zipfile.ZipInfo], list[Entry]]:
        members: dict[str, zipfile.ZipInfo] = {}
        if len(archive.infolist()) > most:
            raise BadInput(TOO_MANY_FILES(file=name, most=most))
        for info in archive.infolist():
            path = _name(info)
            if info.is_dir():
                continue
            parts = PurePosixPath(path).parts
            if path.startswith("/") or ".." in parts or not parts or ":" in parts[0]:
                self.problems.append((path, NAME_LEADS_OUT()))
            elif stat.S_ISLNK(info.external_attr >> 16):
                self.problems.append((path, LINK_NOT_FOLLOWED()))
            elif info.flag_bits & ENCRYPTED:
                self.problems.append((path, ENCRYPTED_FILE()))
            else:
                if path in members:
                    self.problems.append((path, TWICE_IN_ARCHIVE()))
                members[path] = info
        entries = [Entry(p, i.file_size, tuple(i.date_time)) for p, i in members.items()]
        return members, entries

    def _with_inner(self, entry: Entry) -> Iterator[Entry]:
        """Yield an entry; of an archive that a student sent, what is in it, one level deep."""
        if not entry.path.lower().endswith(ARCHIVE):
            yield entry
            return
        try:
            with _opened(io.BytesIO(self._bytes(entry.path)), entry.path) as archive:
                members, found = self._listed(archive, entry.path, MOST_INNER_FILES)
                if sum(each.size for each in found) > MOST_INNER_BYTES:
                    raise BadInput(INFLATES_TOO_FAR(file=entry.path, most=MOST_INNER_BYTES))
                for each in found:
                    path = f"{entry.path}/{each.path}"
                    self._inner[path] = (entry.path, members[each.path].filename)
                    yield Entry(path, each.size, each.modified)
        except BadInput as error:
            self.problems.append((entry.path, error.diagnostic))
            yield entry


def _opened(file: Path | io.BytesIO, name: str) -> zipfile.ZipFile:
    try:
        return zipfile.ZipFile(file)
    except (zipfile.BadZipFile, OSError, ValueError, NotImplementedError) as error:
        raise BadInput(NO_ZIP(file=name, why=str(error))) from None


def _name(info: zipfile.ZipInfo) -> str:
    """Return a member's name: many programs write UTF-8 without saying so."""
    name = info.filename
    if not info.flag_bits & 0x800:
        try:
            name = name.encode("cp437").decode("utf-8")
        except UnicodeError:
            name = info.filename
    return name.replace("\\", "/")


def _inflated(archive: zipfile.ZipFile, info: zipfile.ZipInfo, path: str) -> bytes:
    try:
        with archive.open(info) as file:
            return _bounded(file.read(MOST_BYTES + 1), path)
    except (
        zipfile.BadZipFile, OSError, EOFError, zlib.error, RuntimeError, NotImplementedError,
        ValueError,
    ) as error:  # fmt: skip
        raise BadInput(NOT_UNPACKED(file=path, why=str(error))) from None


def _bounded(content: bytes, path: str) -> bytes:
    if len(content) > MOST_BYTES:
        raise BadInput(LARGER_THAN_NEEDED(file=path, most=MOST_BYTES))
    return content
