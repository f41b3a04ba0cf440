"""The one place that tells by an error what this machine has run out of, or cannot give."""

from __future__ import annotations

import errno
from enum import Enum

from mrlab_ros.core.base.diagnostic import Diagnostic
from mrlab_ros.core.base.diagnostics import MACHINE_LACKS


class Lack(str, Enum):
    """What a machine lacks; the values are those of MACHINE_LACKS."""

    DISK = "disk"
    QUOTA = "quota"
    READ_ONLY = "read_only"
    DEVICE = "device"
    DESCRIPTORS = "descriptors"
    FILES = "files"
    MEMORY = "memory"

    @property
    def is_room(self) -> bool:
        """Whether room on a disk is missing."""
        return self in (Lack.DISK, Lack.QUOTA)

    @property
    def is_shared(self) -> bool:
        """Whether every process meets it, and not the one alone that asked for too much."""
        return self.is_room or self in (Lack.DEVICE, Lack.FILES)


NUMBERS = {
    errno.ENOSPC: Lack.DISK,
    errno.EDQUOT: Lack.QUOTA,
    errno.EROFS: Lack.READ_ONLY,
    errno.EIO: Lack.DEVICE,
    errno.EMFILE: Lack.DESCRIPTORS,
    errno.ENFILE: Lack.FILES,
    errno.ENOMEM: Lack.MEMORY,
}


def lack(error: BaseException) -> Lack | None:
    """Return what the machine lacked where it raised `error`; None: nothing."""
    if isinstance(error, MemoryError):
        return Lack.MEMORY
    return NUMBERS.get(error.errno or 0) if isinstance(error, OSError) else None


def remedy(error: OSError) -> str | None:
    """Return what helps where a file cannot be written: `room`, `may` or None, it is unknown."""
    found = lack(error)
    if found is Lack.READ_ONLY or isinstance(error, PermissionError):
        return "may"
    return "room" if found is not None and found.is_room else None


def lacking(error: BaseException) -> Diagnostic | None:
    """Return what is said of a machine that lacks something; None: `error` has another cause."""
    found = lack(error)
    return None if found is None else MACHINE_LACKS(lack=found.value)
