"""Keys, pieces and media types of the lab's assets; without zenoh and files.

An asset is what a client draws with: meshes, textures, pictures, and documents that the lab makes.
The key of package://mrlab_ros/robots/ur5e/meshes/base_link.glb is
assets/mrlab_ros/robots/ur5e/meshes/base_link.glb.
"""

from __future__ import annotations

import json
import re
from dataclasses import dataclass
from pathlib import PurePosixPath
from urllib.parse import quote, unquote

from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.bridge import diagnostics as say

ASSETS = "assets"
SCHEMA = "schema"
ROBOTS_DOCUMENT = "robots.json"
OBJECTS_DOCUMENT = "objects.json"
# The most bytes of one reply. A client on a slow link asks for less at a time.
LARGEST_PIECE = 1 << 20
PACKAGE = "package://"
# Characters of a key beside letters, digits and _.-~; zenoh forbids # ? $ * in a key.
SAFE = "/+@,=()!"
DIGITS = re.compile(r"[0-9]{1,15}")
JSON = "application/json"
URDF = "application/xml"
MEDIA_TYPES = {
    ".bin": "application/octet-stream",
    ".bmp": "image/bmp",
    ".dae": "model/vnd.collada+xml",
    ".dds": "image/vnd-ms.dds",
    ".gif": "image/gif",
    ".glb": "model/gltf-binary",
    ".gltf": "model/gltf+json",
    ".jpeg": "image/jpeg",
    ".jpg": "image/jpeg",
    ".mtl": "model/mtl",
    ".obj": "model/obj",
    ".png": "image/png",
    ".stl": "model/stl",
    ".tga": "image/x-tga",
    ".tif": "image/tiff",
    ".tiff": "image/tiff",
    ".webp": "image/webp",
}


def asset_key(path: str) -> str:
    """Return the key of an asset, such as assets/robots.json, below the bridge's prefix."""
    return f"{ASSETS}/{quote(path, safe=SAFE)}"


def key_of_uri(uri: str) -> str:
    """Return the key of a package:// URI; raise BadInput for any other."""
    if not uri.startswith(PACKAGE):
        raise BadInput(say.NOT_A_PACKAGE_URI(uri=uri, begin=PACKAGE))
    return asset_key(uri.removeprefix(PACKAGE))


def path_of_key(key: str) -> str:
    """Return the path of an asset's key, such as robots.json.

    Raises BadInput for a key expression and for a path with empty, hidden or relative parts.
    """
    if "*" in key:
        robots, objects = asset_key(ROBOTS_DOCUMENT), asset_key(OBJECTS_DOCUMENT)
        raise BadInput(say.SEVERAL_ASSETS(key=key, robots=robots, objects=objects))
    path = unquote(key.removeprefix(f"{ASSETS}/"))
    parts = path.split("/")
    if any(not part or part.startswith(".") or "\\" in part or "\0" in part for part in parts):
        raise BadInput(say.NO_ASSET_NAME(path=path))
    return path


def media_type(path: str) -> str:
    """Return the media type of a file by its suffix; empty: the lab serves no such files."""
    return MEDIA_TYPES.get(PurePosixPath(path).suffix.lower(), "")


@dataclass(frozen=True)
class Span:
    """The part of an asset that a query names; length None: to the end."""

    offset: int = 0
    length: int | None = None

    def of(self, size: int, key: str) -> range:
        """Return the bytes of an asset of `size` bytes that the reply holds.

        Raises BadInput where they begin behind its end, or are more than one reply may hold.
        """
        if self.offset > size:
            raise BadInput(say.ASSET_OFFSET_BEYOND(key=key, size=size, offset=self.offset))
        end = size if self.length is None else min(size, self.offset + self.length)
        if end - self.offset > LARGEST_PIECE:
            raise BadInput(say.ASSET_IN_PIECES(key=key, size=size, largest=LARGEST_PIECE))
        return range(self.offset, end)


def span(offset: str | None, length: str | None) -> Span:
    """Read a query's parameters `offset` and `length`, in bytes; raise BadInput."""
    for name, value in (("offset", offset), ("length", length)):
        if value is not None and not DIGITS.fullmatch(value):
            raise BadInput(say.BAD_ASSET_PARAMETER(parameter=name, found=value))
    return Span(int(offset or 0), None if length is None else int(length))


@dataclass(frozen=True)
class Described:
    """The attachment of an asset as a whole: bytes, hexadecimal SHA-256, media type."""

    size: int
    sha256: str
    media_type: str

    def attachment(self, offset: int) -> bytes:
        """Return the attachment of the piece that begins at `offset`: JSON."""
        return json.dumps(vars(self) | {"offset": offset}).encode()


def read_attachment(attachment: bytes) -> tuple[Described, int]:
    """Return what an attachment says of the asset, and where its piece begins.

    Raises BadInput where it is none.
    """
    try:
        found = json.loads(attachment)
        offset = int(found.pop("offset"))
        described = Described(int(found["size"]), str(found["sha256"]), str(found["media_type"]))
    except (ValueError, TypeError, KeyError, AttributeError):
        raise BadInput(say.BAD_ASSET_ATTACHMENT(found=repr(attachment[:80]))) from None
    return described, offset
