"""Documents of the lab as YAML files: scenes, shipped and saved, and cells.

A file named .json holds the same as JSON, which takes a tenth of the time.
"""

from __future__ import annotations

import json
import os
from pathlib import Path

import yaml

from mrlab_ros.adapters.diagnostics import FILE_UNREADABLE, FILE_UNWRITABLE, NOT_OF_FORMAT
from mrlab_ros.adapters.nearby import check_file
from mrlab_ros.adapters.scenes.diagnostics import BAD_SCENE_NAME, NO_SCENE
from mrlab_ros.adapters.whole_file import replaced
from mrlab_ros.adapters.yaml_files import Loader, not_yaml
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.base.names import NAME, close_to
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
            why = error.strerror or str(error)
            raise BadInput(FILE_UNWRITABLE(file=str(path), why=why)) from None
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
