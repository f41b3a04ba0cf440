"""The document that a node keeps for its restart. A damaged one never stops the node."""

from __future__ import annotations

import contextlib
import errno
import os
from collections.abc import Callable
from pathlib import Path

from mrlab_ros.adapters.diagnostics import NO_ROOM_ON_DISK
from mrlab_ros.adapters.scenes import files
from mrlab_ros.adapters.set_aside import set_aside
from mrlab_ros.core.base.errors import BadInput, LabError
from mrlab_ros.core.scene import document
from mrlab_ros.core.scene.document import SceneDocument

FULL = (errno.ENOSPC, errno.EDQUOT)
# What one change may add to a state file, bytes.
ROOM = 65_536
# The lab's own, with its robots and systems.
SCENE_FILE = "scene.json"


class StateFile:
    """One JSON file below a node's state folder; without a path nothing is kept.

    whole: as in document.parse(). log: takes what went wrong.
    """

    def __init__(self, path: Path | None, log: Callable[[str], None], *, whole: bool) -> None:
        self._path = path
        self._log = log
        self._whole = whole
        self._saved: SceneDocument | None = None
        self._failed = ""

    def load(self) -> SceneDocument | None:
        """Return what is kept, None where nothing is.

        A damaged file is renamed and logged. Of one with damaged entries the rest is returned,
        and a copy is kept as it was.
        """
        path = self._path
        if path is None or not os.path.lexists(path):
            return None
        try:
            scene, mistakes = document.parse_intact(
                files.content(path), path.name, whole=self._whole
            )
        except BadInput as error:
            self._log(f"{error} {set_aside(path)}; the lab starts without it")
            return None
        if mistakes:
            self.keep_copy(f"left out of {path}: {' '.join(map(str, mistakes))}")
        return scene

    def keep_copy(self, why: str) -> None:
        """Log why a part of the file is left out; copy it, as the next save() replaces it."""
        if self._path is not None:
            self._log(f"{why.rstrip('.')}. {set_aside(self._path, copy=True)}")

    def check_room(self) -> None:
        """Raise LabError where the disk has no room for the next save(); nothing is changed.

        A folder that cannot be written at all does not stop a lab: save() says so.
        """
        path = self._path
        if path is None:
            return
        probe = path.with_name(f"{path.name}.probe")
        try:
            size = path.stat().st_size if path.exists() else 0
            path.parent.mkdir(parents=True, exist_ok=True)
            with open(probe, "wb") as file:
                os.posix_fallocate(file.fileno(), 0, 2 * size + ROOM)
        except OSError as error:
            if error.errno in FULL:
                why = error.strerror or str(error)
                raise LabError(NO_ROOM_ON_DISK(folder=str(path.parent), why=why)) from None
        finally:
            with contextlib.suppress(OSError):
                probe.unlink()

    def save(self, scene: SceneDocument) -> bool:
        """Write the document where it differs from the last one; return whether it is kept.

        A failure is logged once, until it is another one.
        """
        if self._path is None or scene == self._saved:
            return True
        try:
            files.write(self._path, scene)
        except OSError as error:
            said = f"{self._path} cannot be written, a restart will not know: {error.strerror}"
            if said != self._failed:
                self._log(said)
            self._failed = said
            return False
        self._saved, self._failed = scene, ""
        return True
