"""Finds the lab's own data files, and the folder of imported robot models."""

from __future__ import annotations

import os
from functools import cache
from pathlib import Path

DATA = ("config", "robots", "launch", "examples", "web", "msg_schemas")


@cache
def directory() -> Path:
    """Return the folder with config/, robots/, launch/ and examples/.

    That is the installed share folder, or the source tree where nothing is installed.
    """
    # Imported here: with its folders given, a gateway needs no ROS index.
    from ament_index_python.packages import PackageNotFoundError, get_package_share_directory

    try:
        return Path(get_package_share_directory("mrlab_ros"))
    except PackageNotFoundError:
        return Path(__file__).resolve().parents[2]


def folders() -> list[Path]:
    """Return the folders of directory() that hold data; in a source tree others lie beside."""
    return [directory() / name for name in DATA if (directory() / name).is_dir()]


def imported_folder() -> Path:
    """Return where `mrlab robots import` puts robots: MRLAB_ROBOTS, or the user's data folder."""
    named = os.environ.get("MRLAB_ROBOTS")
    if named:
        return Path(named)
    data = os.environ.get("XDG_DATA_HOME") or Path.home() / ".local" / "share"
    return Path(data) / "mrlab" / "robots"
