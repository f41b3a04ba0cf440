"""All that clients draw the lab with, by path: files, URDFs, generated meshes and documents."""

from __future__ import annotations

import hashlib
import json
import re
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from mrlab_ros.adapters.assets import documents
from mrlab_ros.adapters.assets.diagnostics import NO_ASSET
from mrlab_ros.adapters.assets.files import PACKAGE, AssetFiles, Piece
from mrlab_ros.adapters.robots.library import RobotLibrary
from mrlab_ros.adapters.scenes.object_meshes import ObjectMeshes
from mrlab_ros.adapters.yaml_files import read_yaml
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.bridge.assets import (
    JSON,
    OBJECTS_DOCUMENT,
    ROBOTS_DOCUMENT,
    URDF,
    Described,
    Span,
    asset_key,
)
from mrlab_ros.core.physics import catalogue, drawing
from mrlab_ros.core.physics.catalogue import Catalogue
from mrlab_ros.core.physics.settings import Settings

COMPOSED = re.compile(r"robots/([^/+]+)(?:\+([^/+]+))?\.urdf")
DRAWN = re.compile(rf"{PACKAGE}/objects/([^/]+)\.glb")
GLB = "model/gltf-binary"


class Assets:
    """Reads assets by their path, the key without assets/.

    share: the folder with robots/ and config/. documents: further documents by path.
    """

    def __init__(
        self,
        share: Path,
        library: RobotLibrary,
        more: Mapping[str, Callable[[], bytes]] | None = None,
    ) -> None:
        self._share = share
        self._library = library
        self._files = AssetFiles(share, library)
        self._more = dict(more or {})
        # Sources of a document, and the document.
        self._made: dict[str, tuple[object, bytes]] = {}
        self._known: tuple[object, Catalogue] | None = None

    def read(self, path: str, part: Span) -> Piece:
        """Return a part of an asset.

        Raises BadInput where there is no such asset, or the part is too large for one reply.
        """
        made = self._generated(path)
        if made is None:
            piece = self._files.read(path, part)
            if piece is None:
                documents = [asset_key(ROBOTS_DOCUMENT), asset_key(OBJECTS_DOCUMENT)]
                raise BadInput(NO_ASSET(asset=asset_key(path), documents=documents))
            return piece
        data, kind = made
        wanted = part.of(len(data), asset_key(path))
        whole = Described(len(data), hashlib.sha256(data).hexdigest(), kind)
        return Piece(data[wanted.start : wanted.stop], wanted.start, whole)

    def _generated(self, path: str) -> tuple[bytes, str] | None:
        """Return an asset that is no file, and its media type; None where it is none."""
        if path in self._more:
            return self._more[path](), JSON
        if path == ROBOTS_DOCUMENT:
            ids = (self._library.ids(), self._library.end_effectors())
            return self._document(
                path, ids, lambda: documents.robots(self._library, self._files)
            ), JSON
        if path == OBJECTS_DOCUMENT:
            types = self._catalogue()
            return self._document(path, types, lambda: documents.objects(types, self._files)), JSON
        if composed := COMPOSED.fullmatch(path):
            return self._library.description(*composed.groups()).encode(), URDF
        if drawn := DRAWN.fullmatch(path):
            kind = self._catalogue().get(drawn[1])
            if kind.mesh == catalogue.DRAWN.format(kind.id):
                return drawing.glb(kind.body.parts, kind.color, kind.id), GLB
        return None

    def _document(self, path: str, source: object, make: Callable[[], Any]) -> bytes:
        """Return a JSON document, made anew where what it is made of has changed."""
        known = self._made.get(path)
        if known is None or known[0] != source:
            known = self._made[path] = (source, json.dumps(make()).encode())
        return known[1]

    def _catalogue(self) -> Catalogue:
        """Return the types of objects, read anew where the file has changed."""
        config = self._share / "config"
        file = config / "objects.yaml"
        changed = file.stat().st_mtime_ns if file.exists() else 0
        if self._known is None or self._known[0] != changed:
            settings = Settings.from_mapping(read_yaml(config / "physics.yaml"))
            meshes = ObjectMeshes(self._share, settings.max_triangles)
            self._known = (changed, catalogue.parse(read_yaml(file), meshes))
        return self._known[1]
