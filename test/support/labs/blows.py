"""What happens to the machine of a lab: its wall clock is set, its disk fills up."""

from __future__ import annotations

import shutil
import struct
import subprocess
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

SHIM = Path(__file__).parents[2] / "clock_shim.c"
# Of the disk that fills up.
DISK = "48m"


class Clock:
    """The wall clock of the lab's processes, which nobody else's follows."""

    def __init__(self, folder: Path) -> None:
        self._file = folder / "clock_offset"
        self._file.write_bytes(bytes(8))
        self._library = folder / "clock_shim.so"
        subprocess.run(
            ("cc", "-shared", "-fPIC", "-O1", "-o", self._library, SHIM, "-ldl"), check=True
        )

    @property
    def environment(self) -> dict[str, str]:
        return {"LD_PRELOAD": str(self._library), "CLOCK_SHIM": str(self._file)}

    def set_by(self, seconds: float) -> None:
        with self._file.open("r+b") as file:
            (offset,) = struct.unpack("<q", file.read())
            file.seek(0)
            file.write(struct.pack("<q", offset + round(seconds * 1e9)))


class Disk:
    """A small disk for the state of a lab, where one may be mounted here; see `small`."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        folder.mkdir()
        mount = ("mount", "-t", "tmpfs", "-o", f"size={DISK}", "mrlab_chaos", folder)
        self.small = (
            shutil.which("mount") is not None
            and subprocess.run(mount, capture_output=True, check=False).returncode == 0
        )

    def fill(self) -> None:
        with (self.folder / "filler").open("wb", buffering=0) as file:
            try:
                while True:
                    file.write(bytes(1 << 16))
            except OSError:
                return

    def free(self) -> None:
        (self.folder / "filler").unlink()

    @contextmanager
    def full(self) -> Iterator[None]:
        """Fill the disk for a while."""
        self.fill()
        try:
            yield
        finally:
            self.free()

    def close(self) -> None:
        if self.small:
            subprocess.run(("umount", "-l", self.folder), check=True)


@contextmanager
def small_disk(folder: Path) -> Iterator[Disk]:
    disk = Disk(folder)
    try:
        yield disk
    finally:
        disk.close()
