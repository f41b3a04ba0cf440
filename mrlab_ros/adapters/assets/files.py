"""The files that clients may get: meshes, textures and pictures of robots and objects."""

from __future__ import annotations

import hashlib
import os
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import BinaryIO

from mrlab_ros.adapters.diagnostics import FILE_UNREADABLE
from mrlab_ros.adapters.robots.end_effectors import END_EFFECTORS
from mrlab_ros.adapters.robots.library import RobotLibrary
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.bridge.assets import Described, Span, media_type

PACKAGE = "mrlab_ros"
THUMBNAIL = "thumbnail.webp"
# Folders of a robot.
SERVED = ("meshes", "lod")
BLOCK = 1 << 20


@dataclass(frozen=True)
class Piece:
    """A part of an asset that begins at `offset`, and what the whole is."""

    data: bytes
    offset: int
    whole: Described


@dataclass(frozen=True)
class _Folder:
    """A folder of which files are served; linked: where they are in an installation of links."""

    path: Path
    linked: Path

    def file(self, name: str) -> Path | None:
        """Return a file of the folder; None where it is missing or a link leads elsewhere."""
        file = self.path / name
        real = os.path.realpath(file)
        homes = (os.path.realpath(self.path), str(self.linked))
        inside = any(real.startswith(home + os.sep) for home in homes)
        return file if inside and os.path.isfile(real) else None


class AssetFiles:
    """Finds and reads the files below robots/ and config/objects/ that are meant for clients.

    share: the folder with robots/ and config/. Of a robot and an end effector these are the
    folders meshes/ and lod/ and the thumbnail; of the objects all in config/objects/. Files of
    other kinds or elsewhere do not exist for clients.
    """

    def __init__(self, share: Path, library: RobotLibrary) -> None:
        self._share = share
        self._library = library
        # By device, inode, size and time: the hash of a file that did not change is kept.
        self._hashes: dict[tuple[int, int, int, int], str] = {}

    def read(self, path: str, part: Span) -> Piece | None:
        """Read a part of the file of a path such as mrlab_ros/robots/ur5e/meshes/base_link.glb.

        None where there is no such file for clients. Raises BadInput where the part is too large
        for a reply, or the file cannot be read.
        """
        file = self.find(path)
        if file is None:
            return None
        try:
            with file.open("rb") as stream:
                whole = self._describe(stream, media_type(path))
                wanted = part.of(whole.size, path)
                stream.seek(wanted.start)
                return Piece(stream.read(len(wanted)), wanted.start, whole)
        except OSError as error:
            why = error.strerror or str(error)
            raise BadInput(FILE_UNREADABLE(file=path, why=why)) from None

    def find(self, path: str) -> Path | None:
        """Return the file of an asset's path; None where there is none for clients."""
        package, _, place = path.partition("/")
        if package != PACKAGE or not media_type(place):
            return None
        found = (folder.file(name) for folder, name in self._places(place))
        return next((file for file in found if file is not None), None)

    def _places(self, place: str) -> Iterator[tuple[_Folder, str]]:
        """Yield the folders that may hold what `place` names, and its name in them."""
        match place.split("/"):
            case ["config", "objects", *rest] if rest:
                config = self._share / "config"
                linked = _real_folder(config / "objects.yaml") / "objects"
                yield _Folder(config / "objects", linked), "/".join(rest)
            case ["robots", tops, tool, *rest] if tops == END_EFFECTORS and _is_served(rest):
                folder = self._library.folder / END_EFFECTORS / tool
                linked = _real_folder(folder / "end_effector.yaml")
                yield _Folder(folder, linked), "/".join(rest)
            case ["robots", robot, *rest] if _is_served(rest):
                for folder in (self._library.folder / robot, self._library.imported / robot):
                    yield _Folder(folder, _real_folder(folder / "robot.yaml")), "/".join(rest)

    def _describe(self, stream: BinaryIO, kind: str) -> Described:
        status = os.fstat(stream.fileno())
        mark = (status.st_dev, status.st_ino, status.st_size, status.st_mtime_ns)
        known = self._hashes.get(mark)
        if known is None:
            digest = hashlib.sha256()
            while block := stream.read(BLOCK):
                digest.update(block)
            known = self._hashes[mark] = digest.hexdigest()
        return Described(status.st_size, known, kind)


def _real_folder(file: Path) -> Path:
    """Return the folder in which a file is that may be a link."""
    return Path(os.path.realpath(file)).parent


def _is_served(names: list[str]) -> bool:
    """Return whether clients may get this file of a robot's folder, given as the path's parts."""
    return names == [THUMBNAIL] or (len(names) > 1 and names[0] in SERVED)
