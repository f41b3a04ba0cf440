"""Where the installed ROS packages lie."""

from __future__ import annotations

from pathlib import Path

from ament_index_python.packages import get_packages_with_prefixes
from ament_index_python.search_paths import get_search_paths


def packages() -> list[Path]:
    """Return the folders of the installed packages, and their sources where these are linked to.

    colcon's --symlink-install links each file to the one in the source tree.
    """
    shares = [Path(prefix, "share", n) for n, prefix in get_packages_with_prefixes().items()]
    places = {share.resolve() for share in shares}
    return sorted(places | {(share / "package.xml").resolve().parent for share in shares})


def indices() -> list[Path]:
    """Return the folders by which the packages are found."""
    found = [Path(prefix, "share", "ament_index") for prefix in get_search_paths()]
    return [folder for folder in found if folder.is_dir()]
