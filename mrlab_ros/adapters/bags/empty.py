"""Removes what a recorder left that was killed before it had written any message."""

from __future__ import annotations

from pathlib import Path

from mrlab_ros.adapters.bags.mcap_file import open_file
from mrlab_ros.adapters.bags.reader import METADATA, mcap_files_in
from mrlab_ros.adapters.bags.writer import RESERVE, TAIL, is_being_written
from mrlab_ros.core.base.errors import LabError


def remove_empty(folder: Path) -> bool:
    """Remove the folder of a bag without messages, or an empty one; return whether it is gone.

    It stays where anything else is in it, where a file may hold more than can be read, and while
    it is being written.
    """
    if not folder.is_dir() or folder.is_symlink():
        return False
    try:
        files = mcap_files_in(folder)
        known = {METADATA, f"{METADATA}.new", RESERVE, *(file.name for file in files)}
        entries = list(folder.iterdir())
        if any(entry.name not in known or not entry.is_file() for entry in entries):
            return False
        if not all(map(_is_empty, files)):
            return False
        for entry in entries:
            entry.unlink()
        folder.rmdir()
    except (OSError, LabError):
        return False
    return True


def _is_empty(path: Path) -> bool:
    if is_being_written(path):
        return False
    found = open_file(path)
    if found.chunks or any(found.counts.values()):
        return False
    return found.indexed or path.stat().st_size - found.data_end <= len(TAIL)
