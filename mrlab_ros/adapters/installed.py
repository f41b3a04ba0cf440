"""Folders of the installed ROS packages."""

from __future__ import annotations

import itertools
import os
from pathlib import Path

from ament_index_python.packages import get_packages_with_prefixes
from ament_index_python.search_paths import get_search_paths

MOST_LINKS = 8  # that follow one another to a file


def packages() -> list[Path]:
    """Return where the files of the installed packages lie: folders, and files of source trees.

    colcon's --symlink-install links each file to the one in the source tree.
    """
    shares = [Path(prefix, "share", n) for n, prefix in get_packages_with_prefixes().items()]
    return sorted({place for share in shares for place in _places(share)})


def _places(share: Path) -> set[Path]:
    """Return a package's share folder, and where its links lead, as far as something is there.

    Never a source tree as a whole: in it lies what is not installed, such as keys.
    """
    found = {share.resolve()}
    manifest = share / "package.xml"
    if manifest.is_symlink():
        tree = manifest.resolve().parent
        ends = {
            _end(os.path.join(folder, name))
            for folder, *names in os.walk(share)
            for name in itertools.chain(*names)
            if os.path.islink(os.path.join(folder, name))
        }
        # there are a thousand files, and their folders are few
        folders = {folder: Path(folder).resolve() for folder in set(map(os.path.dirname, ends))}
        for end in ends:
            folder = folders[os.path.dirname(end)]
            alone = folder == tree or os.path.isdir(end)
            found.add(Path(end).resolve() if alone else folder)
        found -= {tree, *tree.parents}
    # A file that left the source tree since it was built leaves a link to nothing.
    return {place for place in found if place.exists()}


def _end(path: str) -> str:
    """Return what a link leads to at last, as it is written there."""
    for _ in range(MOST_LINKS):
        if not os.path.islink(path):
            break
        path = os.path.join(os.path.dirname(path), os.readlink(path))
    return path


def indices() -> list[Path]:
    """Return the folders by which the packages are found, and the files that they link to."""
    found = [Path(prefix, "share", "ament_index") for prefix in get_search_paths()]
    folders = [folder for folder in found if folder.is_dir()]
    links = (path for folder in folders for path in folder.rglob("*") if path.is_symlink())
    return [*folders, *(path.resolve() for path in links if path.is_file())]
