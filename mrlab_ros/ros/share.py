"""Finds the lab's own data files."""

from __future__ import annotations

from functools import cache
from pathlib import Path

from ament_index_python.packages import PackageNotFoundError, get_package_share_directory


@cache
def directory() -> Path:
    """Return the folder with config/, robots/, launch/ and examples/.

    That is the installed share folder, or the source tree where nothing is installed.
    """
    try:
        return Path(get_package_share_directory("mrlab_ros"))
    except PackageNotFoundError:
        return Path(__file__).resolve().parents[2]
