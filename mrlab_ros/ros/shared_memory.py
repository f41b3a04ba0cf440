"""Clears shared memory that a killed process left half-made, on which the next one would wait.

Fast DDS, with which the wheels of ROS come, makes a segment for each of its ports under /dev/shm:
it creates the file, gives it a size, and writes 2 into its first word (Boost.Interprocess,
`managed_open_or_create_impl`). Who opens a segment that is not finished waits for its maker, and
for ever where that was killed; some ports are the same for all domains of a machine.
"""

from __future__ import annotations

import contextlib
import os
import time
from pathlib import Path

FOLDER = Path("/dev/shm")
PORTS = "fastrtps_port*"
# Beside a segment: an empty file that is only locked.
LOCK = "_el"
INITIALIZED = (2).to_bytes(4, "little")
# Making a segment takes well below a millisecond; a maker that needs longer than this, s, is dead.
LONGEST_S = 2.0


def remove_abandoned(folder: Path = FOLDER) -> list[str]:
    """Remove the segments of ports that nobody will finish; return their names."""
    now, removed = time.time(), []
    for path in folder.glob(PORTS):
        # Gone meanwhile, or of another user: not ours to remove.
        with contextlib.suppress(OSError):
            if path.name.endswith(LOCK) or now - path.stat().st_mtime < LONGEST_S:
                continue
            with path.open("rb") as segment:
                finished = os.pread(segment.fileno(), len(INITIALIZED), 0) == INITIALIZED
            if not finished:
                path.unlink()
                removed.append(path.name)
    return sorted(removed)
