"""Finds the files that are installed with the package."""

from __future__ import annotations

from functools import cache
from pathlib import Path


@cache
def directory() -> Path:
    """Return the folder with config/, robots/ and web/: the share folder, or the source tree."""
    # Imported here: with its folders given, a gateway needs no ROS index.
    from ament_index_python.packages import PackageNotFoundError, get_package_share_directory

    try:
        return Path(get_package_share_directory("mrlab_ros"))
    except PackageNotFoundError:
        return Path(__file__).resolve().parents[2]
