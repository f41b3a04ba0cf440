"""Scenes as YAML files: those that came with the lab, and those saved here.

A file named .json holds the same as JSON, which takes a tenth of the time.
"""

from __future__ import annotations

import json
import os
import tempfile
from pathlib import Path

import yaml

from mrlab_ros.core.errors import BadInput
from mrlab_ros.core.naming import NAME
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
        return tuple(sorted({file.stem for file in files}))

    def load(self, name: str) -> SceneDocument:
        """Read a scene; raise BadInput where there is none or it is damaged."""
        _check(name)
        for folder in (self._own, self._shipped):
            path = folder / f"{name}{SUFFIX}"
            if path.is_file():
                return read(path)
        raise BadInput(f"there is no scene '{name}'; there are: {', '.join(self.names())}")

    def save(self, name: str, scene: SceneDocument) -> Path:
        """Write a scene; a reader sees the old file or the new one."""
        _check(name)
        path = self._own / f"{name}{SUFFIX}"
        write(path, scene)
        return path


def read(path: Path) -> SceneDocument:
    """Read one scene file; raise BadInput where it is damaged."""
    loader = getattr(yaml, "CSafeLoader", yaml.SafeLoader)
    try:
        content = path.read_bytes()
        as_json = path.suffix == ".json"
        document = json.loads(content) if as_json else yaml.load(content, Loader=loader)
    except (OSError, ValueError, yaml.YAMLError) as error:
        raise BadInput(f"{path.name} cannot be read: {error}; save the scene again") from None
    return scene_document.parse(document, path.name)


def write(path: Path, scene: SceneDocument) -> None:
    """Write one scene file at once."""
    path.parent.mkdir(parents=True, exist_ok=True)
    dumper = getattr(yaml, "CSafeDumper", yaml.SafeDumper)
    plain = scene_document.plain(scene)
    if path.suffix == ".json":
        text = json.dumps(plain)
    else:
        text = yaml.dump(plain, Dumper=dumper, sort_keys=False, default_flow_style=None)
    descriptor, new = tempfile.mkstemp(dir=path.parent, prefix=".writing-")
    try:
        with os.fdopen(descriptor, "w") as file:
            file.write(text)
        os.chmod(new, 0o644)
        os.replace(new, path)
    except BaseException:
        os.unlink(new)
        raise


def _check(name: str) -> None:
    if not NAME.fullmatch(name):
        raise BadInput(
            f"'{name}' cannot name a scene; expected lower-case letters, digits and underscores, "
            "such as class_3"
        )
