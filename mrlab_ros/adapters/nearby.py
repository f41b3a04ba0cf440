"""Looks for the file that was meant where there is none of that name."""

from __future__ import annotations

import os
from pathlib import Path

from mrlab_ros.core.naming import did_you_mean


def like_file(path: Path) -> str:
    """Return "; did you mean 'NAME'?" with the entry beside `path` that is closest, or nothing."""
    try:
        beside = os.listdir(path.parent)
    except OSError:
        return ""
    return did_you_mean(path.name, (name for name in beside if not name.startswith(".")))
