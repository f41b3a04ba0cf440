"""Folders of robot models beside those of the lab."""

from __future__ import annotations

import os
from pathlib import Path


def imported_folder() -> Path:
    """Return where `mrlab robots import` puts robots: MRLAB_ROBOTS, or the user's data folder."""
    named = os.environ.get("MRLAB_ROBOTS")
    if named:
        return Path(named)
    data = os.environ.get("XDG_DATA_HOME") or Path.home() / ".local" / "share"
    return Path(data) / "mrlab" / "robots"
