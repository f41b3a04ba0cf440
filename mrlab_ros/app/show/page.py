"""One HTML file that shows something in 3D: code, data and meshes in it, and nothing from outside.

`page.html` is its template. The text of the report and its pictures, which are read without a
script, stand there until the report is drawn.
"""

from __future__ import annotations

import base64
import hashlib
import json
import struct
import zlib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from string import Template
from typing import Any

from mrlab_ros.core.base.foreign_text import for_html as escape
from mrlab_ros.core.base.foreign_text import visible_lines

LEVEL = 9  # of compression
# Texts of a document that nobody reads: arrays, descriptions of robots.
UNSHOWN = ("data", "urdf")
TEMPLATE = Path(__file__).with_name("page.html")


@dataclass(frozen=True)
class Code:
    """The built script and style sheet of the page."""

    script: bytes
    style: str


@dataclass(frozen=True)
class Picture:
    """A picture that stands in the page. url: a data: URL."""

    url: str
    text: str


def page(
    title: str,
    text: str,
    document: Mapping[str, Any],
    meshes: Mapping[str, bytes],
    code: Code,
    pictures: Sequence[Picture] = (),
) -> str:
    """Return the page.

    text, pictures: the report for where no script runs. document: JSON that the report of its
    "schema" draws, a row of web/src/reports.tsx. meshes: GLB files by their URIs; equal ones are
    stored once.
    """
    template = _with_pictures(TEMPLATE.read_text(encoding="utf-8"), pictures)
    loader = template.rpartition("<script>")[2].partition("</script>")[0]
    style = code.style.replace("</style", "<\\/style")
    policy = "; ".join(
        (
            "default-src 'none'",
            f"script-src '{_hash(loader)}' 'strict-dynamic'",
            f"style-src '{_hash(style)}'",
            "img-src data: blob:",
            "connect-src blob:",
            "base-uri 'none'",
            "form-action 'none'",
        )
    )
    return Template(template).substitute(
        policy=policy,
        title=escape(title),
        style=style,
        text=escape(text),
        data=packed(_data(document, meshes)),
        code=packed(code.script),
    )


def _with_pictures(template: str, pictures: Sequence[Picture]) -> str:
    """Return the template with its line of a picture once for each of them."""
    lines = []
    for line in template.splitlines(keepends=True):
        if "$picture" not in line:
            lines.append(line)
            continue
        for each in pictures:
            values = {"picture": each.url, "picture_text": escape(each.text)}
            lines.append(Template(line).substitute(values).replace("$", "$$"))
    return "".join(lines)


def _data(document: Mapping[str, Any], meshes: Mapping[str, bytes]) -> bytes:
    """Return the length of the head, the head, and each mesh once by its sha256."""
    places: dict[str, list[int]] = {}
    stored: dict[bytes, int] = {}
    content: list[bytes] = []
    size = 0
    for uri, mesh in meshes.items():
        digest = hashlib.sha256(mesh).digest()
        if digest not in stored:
            stored[digest] = size
            content.append(mesh)
            size += len(mesh)
        places[uri] = [stored[digest], len(mesh)]
    shown = _visible(document)
    head = json.dumps({"document": shown, "meshes": places}, separators=(",", ":")).encode()
    return struct.pack("<I", len(head)) + head + b"".join(content)


def _visible(value: Any, name: str = "") -> Any:
    """Return a document in whose texts nothing acts on what shows them; its arrays stay."""
    if isinstance(value, Mapping):
        return {key: _visible(each, key) for key, each in value.items()}
    if isinstance(value, str) and name not in UNSHOWN:
        return visible_lines(value)
    return [_visible(each) for each in value] if isinstance(value, list | tuple) else value


@lru_cache(maxsize=2)
def packed(content: bytes) -> str:
    """Return bytes as a page carries them; the code of all pages is packed once."""
    return base64.b64encode(zlib.compress(content, LEVEL)).decode("ascii")


def _hash(text: str) -> str:
    digest = hashlib.sha256(text.encode()).digest()
    return f"sha256-{base64.b64encode(digest).decode('ascii')}"
