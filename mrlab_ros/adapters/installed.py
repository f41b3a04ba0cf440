"""Where the installed ROS packages lie."""

from __future__ import annotations

import os
from pathlib import Path

from ament_index_python.packages import get_packages_with_prefixes
from ament_index_python.search_paths import get_search_paths


def packages() -> list[Path]:
    """Return where the files of the installed packages lie: folders, and files of source trees.

    colcon's --symlink-install links each file to the one in the source tree.
    """
    shares = [Path(prefix, "share", n) for n, prefix in get_packages_with_prefixes().items()]
    return sorted({place for share in shares for place in _places(share)})


def _places(share: Path) -> set[Path]:
    """Return a package's share folder, and where its links lead.

    Never a source tree as a whole: in it lies what is not installed, such as keys.
    """
    found = {share.resolve()}
    manifest = share / "package.xml"
    if manifest.is_symlink():
        tree = manifest.resolve().parent
        for folder, folders, files in os.walk(share):
            paths = (Path(folder, name) for name in (*folders, *files))
            for target in (path.resolve() for path in paths if path.is_symlink()):
                alone = target.is_dir() or target.parent == tree
                found.add(target if alone else target.parent)
        found -= {tree, *tree.parents}
    return found


def indices() -> list[Path]:
    """Return the folders by which the packages are found."""
    found = [Path(prefix, "share", "ament_index") for prefix in get_search_paths()]
    return [folder for folder in found if folder.is_dir()]
