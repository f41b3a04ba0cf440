"""Documents of the lab as YAML files: scenes, shipped and saved, and cells.

A file named .json holds the same as JSON, which takes a tenth of the time.

The document that a node keeps for its restart. A damaged one never stops the node.
"""

from __future__ import annotations

import contextlib
import json
import os
from collections.abc import Callable
from pathlib import Path

import yaml

from mrlab_ros.adapters.diagnostics import (
    FILE_UNREADABLE,
    NO_ROOM_ON_DISK,
    NOT_OF_FORMAT,
)
from mrlab_ros.adapters.journal_file import set_aside
from mrlab_ros.adapters.scenes.diagnostics import BAD_SCENE_NAME, NO_SCENE
from mrlab_ros.adapters.whole_file import replaced, unwritable
from mrlab_ros.adapters.yaml_files import Loader, check_file, not_yaml
from mrlab_ros.core.base.errors import BadInput, LabError
from mrlab_ros.core.base.machine import lack, lacking
from mrlab_ros.core.base.names import NAME, close_to
from mrlab_ros.core.scene import document
from mrlab_ros.core.scene import document as scene_document
from mrlab_ros.core.scene.document import SceneDocument

SUFFIX = ".yaml"


class SceneFiles:
    """The scenes of two folders; a saved one hides a shipped one of the same name."""

    def __init__(self, shipped: Path, own: Path) -> None:
        self._shipped = shipped
        self._own = own

    def names(self) -> tuple[str, ...]:
        """Return the names of all scenes, sorted."""
        files = [*self._shipped.glob(f"*{SUFFIX}"), *self._own.glob(f"*{SUFFIX}")]
        return tuple(sorted({file.stem for file in files if NAME.fullmatch(file.stem)}))

    def load(self, name: str) -> SceneDocument:
        """Read a scene; raise BadInput where there is none or it is damaged."""
        _check(name)
        for folder in (self._own, self._shipped):
            path = folder / f"{name}{SUFFIX}"
            if os.path.lexists(path):
                return read(path)
        known = self.names()
        raise BadInput(NO_SCENE(scene=name, known=[*known], close=close_to(name, known)))

    def save(self, name: str, scene: SceneDocument) -> Path:
        """Write a scene as a whole: a reader sees the old file or the new one.

        Raises BadInput where the name is none or the folder cannot be written.
        """
        _check(name)
        path = self._own / f"{name}{SUFFIX}"
        try:
            write(path, scene)
        except OSError as error:
            raise BadInput(unwritable(path, error)) from None
        return path


def read(path: Path) -> SceneDocument:
    """Read one scene file; raise BadInput where it is damaged."""
    return scene_document.parse(content(path), path.name)


def content(path: Path) -> object:
    """Return what a YAML or JSON file holds; raise BadInput where it is not one."""
    check_file(path, path.name)
    try:
        data = path.read_bytes()
        as_json = path.suffix == ".json"
        return json.loads(data) if as_json else yaml.load(data, Loader=Loader)
    except OSError as error:
        why = error.strerror or str(error)
        raise BadInput(FILE_UNREADABLE(file=path.name, why=why)) from None
    except (ValueError, yaml.YAMLError, RecursionError) as error:
        if path.suffix != ".json":
            raise not_yaml(path.name, error) from None
        line = getattr(error, "lineno", None)
        why = getattr(error, "msg", None) or str(error)
        raise BadInput(NOT_OF_FORMAT(file=path.name, line=line, format="JSON", why=why)) from None


def write(path: Path, scene: SceneDocument) -> None:
    """Write one document at once; raise OSError where that fails."""
    dumper = getattr(yaml, "CSafeDumper", yaml.SafeDumper)
    plain = scene_document.plain(scene)
    if path.suffix == ".json":
        text = json.dumps(plain)
    else:
        text = yaml.dump(plain, Dumper=dumper, sort_keys=False, default_flow_style=None)
    path.parent.mkdir(parents=True, exist_ok=True)
    with replaced(path) as file:
        file.write(text.encode())


def _check(name: str) -> None:
    if not NAME.fullmatch(name):
        raise BadInput(BAD_SCENE_NAME(name=name))


# Most bytes that one change adds to a state file.
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
            scene, mistakes = document.parse_intact(content(path), path.name, whole=self._whole)
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
            found = lack(error)
            if found is not None and found.is_room:
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
            write(self._path, scene)
        except OSError as error:
            why = lacking(error) or error.strerror
            said = f"{self._path} cannot be written, a restart will not know: {why}"
            if said != self._failed:
                self._log(said)
            self._failed = said
            return False
        self._saved, self._failed = scene, ""
        return True
