"""What `scripts/bootstrap.py` made in this clone, and what of it is older than the sources."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
SCRIPT = ROOT / "scripts" / "bootstrap.py"
# Reading the sources takes a fraction of a second; a disk that hangs must not keep a lab from
# starting, s.
TIMEOUT_S = 20.0


def set_up_here() -> bool:
    """Return whether set-up made what runs here, in this clone."""
    return SCRIPT.is_file() and Path(sys.prefix) == ROOT / ".venv"


def outdated() -> list[str]:
    """Return the steps of set-up that have to be done again; none where it did not set this up.

    By the stamps that set-up leaves, so after `git pull` as after a change of one's own.
    """
    if not set_up_here():
        return []
    try:
        looked = subprocess.run(
            [sys.executable, str(SCRIPT), "--look"],
            capture_output=True,
            text=True,
            timeout=TIMEOUT_S,
            check=True,
        )
    except (OSError, subprocess.SubprocessError):
        return []
    return looked.stdout.splitlines()
