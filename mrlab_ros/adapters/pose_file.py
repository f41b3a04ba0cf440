"""The last pose of a robot in a file that its process shares with the kernel.

Writing it is a copy in memory, so the newest joint state is there at whatever instant the process
is killed. A journal, which costs system calls, is written ten times a second and lies behind.
"""

from __future__ import annotations

import math
import mmap
import os
import struct
from collections.abc import Sequence
from pathlib import Path

OPENED = os.O_RDWR | os.O_CREAT | os.O_CLOEXEC | os.O_NOFOLLOW
COUNT = struct.Struct("@Q")


class PoseFile:
    """Holds a position on a trajectory, s, and joint positions, rad.

    A count before and after them is odd while they are written: a reader of what a killed process
    left does not take one half for the whole.
    """

    def __init__(self, path: Path, joints: int) -> None:
        """Open the file, with what it holds, or make it; raise OSError where that cannot be."""
        self._record = struct.Struct(f"@Qd{joints}d")
        path.parent.mkdir(mode=0o700, parents=True, exist_ok=True)
        file = os.open(path, OPENED, 0o600)
        try:
            # Space that is taken now cannot be missing later: writing would end the process.
            os.posix_fallocate(file, 0, mmap.PAGESIZE)
            self._memory = mmap.mmap(file, mmap.PAGESIZE)
        finally:
            os.close(file)
        (self._count,) = COUNT.unpack_from(self._memory)

    def put(self, position: float, joints: Sequence[float]) -> None:
        """Replace what the file holds."""
        COUNT.pack_into(self._memory, 0, self._count | 1)
        self._count = (self._count | 1) + 1
        self._record.pack_into(self._memory, 0, self._count - 1, position, *joints)
        COUNT.pack_into(self._memory, 0, self._count)

    def get(self) -> tuple[float, list[float]] | None:
        """Return position and joints; None where nothing was written completely."""
        count, position, *joints = self._record.unpack_from(self._memory)
        if count == 0 or count % 2 or not all(map(math.isfinite, (position, *joints))):
            return None
        return position, joints

    def close(self) -> None:
        self._memory.close()
