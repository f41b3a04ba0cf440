"""Finds the lab's own data files."""

from __future__ import annotations

from functools import cache
from pathlib import Path

from ament_index_python.packages import PackageNotFoundError, get_package_share_directory

DATA = ("config", "robots", "launch", "examples", "web", "msg_schemas")


@cache
def directory() -> Path:
    """Return the folder with config/, robots/, launch/ and examples/.

    That is the installed share folder, or the source tree where nothing is installed.
    """
    try:
        return Path(get_package_share_directory("mrlab_ros"))
    except PackageNotFoundError:
        return Path(__file__).resolve().parents[2]


def folders() -> list[Path]:
    """Return the folders of directory() that hold data; in a source tree others lie beside."""
    return [directory() / name for name in DATA if (directory() / name).is_dir()]
