"""One HTML file that shows something in 3D: code, data and meshes in it, and nothing from outside.

What must be readable without a script (verdict, findings, tables, a picture) is plain HTML, which
the report takes the place of.
"""

from __future__ import annotations

import base64
import hashlib
import json
import struct
import zlib
from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

from mrlab_ros.core.base.foreign_text import for_html as escape
from mrlab_ros.core.base.foreign_text import visible_lines

LEVEL = 9  # of compression
# Texts of a document that nobody reads: arrays, descriptions of robots.
UNSHOWN = ("data", "urdf")
# Unpacks code and data, and starts the code: the only script that the page trusts by itself.
LOADER = """
(async () => {
  const old = document.getElementById('old-browser')
  try {
    const unpack = async (id) => {
      const text = atob(document.getElementById(id).textContent)
      const bytes = Uint8Array.from(text, (c) => c.charCodeAt(0))
      const inflated = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('deflate'))
      return new Response(inflated).arrayBuffer()
    }
    globalThis.mrlabData = await unpack('data')
    const code = new Blob([await unpack('code')], { type: 'text/javascript' })
    const script = document.createElement('script')
    script.src = URL.createObjectURL(code)
    script.onerror = () => { old.hidden = false }
    document.body.append(script)
  } catch (error) {
    old.hidden = false
    console.error(error)
  }
})()
"""


@dataclass(frozen=True)
class Code:
    """The built script and style sheet of the page."""

    script: bytes
    style: str


def page(
    title: str,
    body: str,
    document: Mapping[str, Any],
    meshes: Mapping[str, bytes],
    code: Code,
    language: str = "en",
) -> str:
    """Return the page. body: HTML that is there until the report is drawn.

    document: what the code reads, JSON. meshes: GLB files by their URIs; equal ones are stored
    once.
    """
    style = code.style.replace("</style", "<\\/style")
    policy = "; ".join(
        (
            "default-src 'none'",
            f"script-src '{_hash(LOADER)}' 'strict-dynamic'",
            f"style-src '{_hash(style)}'",
            "img-src data: blob:",
            "connect-src blob:",
            "base-uri 'none'",
            "form-action 'none'",
        )
    )
    return "\n".join(
        (
            "<!doctype html>",
            f'<html lang="{language}">',
            "<head>",
            '<meta charset="utf-8">',
            f'<meta http-equiv="Content-Security-Policy" content="{policy}">',
            '<meta name="viewport" content="width=device-width, initial-scale=1">',
            '<meta name="referrer" content="no-referrer">',
            f"<title>{escape(title)}</title>",
            f"<style>{style}</style>",
            "</head>",
            "<body>",
            f'<div id="report">{body}</div>',
            '<p id="old-browser" hidden>This browser is too old to draw this report; its findings '
            "and tables are complete.</p>",
            f'<script type="text/plain" id="data">{packed(_data(document, meshes))}</script>',
            f'<script type="text/plain" id="code">{packed(code.script)}</script>',
            f"<script>{LOADER}</script>",
            "</body>",
            "</html>",
            "",
        )
    )


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
