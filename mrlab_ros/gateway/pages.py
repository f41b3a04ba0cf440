"""The built pages: files with types, ETags and caching; any other path is the application."""

from __future__ import annotations

import gzip
import hashlib
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

from anyio import to_thread
from fastapi import APIRouter, Request, Response
from fastapi.responses import RedirectResponse

from mrlab_ros.adapters.share import directory
from mrlab_ros.core.bridge.rules import Role
from mrlab_ros.gateway.diagnostics import NOTHING_AT
from mrlab_ros.gateway.errors import NotFound
from mrlab_ros.gateway.people.people import People, ThePeople, address_of
from mrlab_ros.gateway.people.person import LOCAL

# Set here: what the machine's own table says differs between machines.
MIME_TYPES = {
    ".css": "text/css; charset=utf-8",
    ".glb": "model/gltf-binary",
    ".html": "text/html; charset=utf-8",
    ".ico": "image/x-icon",
    ".jpg": "image/jpeg",
    ".js": "text/javascript; charset=utf-8",
    ".json": "application/json",
    ".mjs": "text/javascript; charset=utf-8",
    ".png": "image/png",
    ".stl": "model/stl",
    ".svg": "image/svg+xml",
    ".txt": "text/plain; charset=utf-8",
    ".urdf": "application/xml",
    ".wasm": "application/wasm",
    ".webmanifest": "application/manifest+json",
    ".webp": "image/webp",
    ".woff2": "font/woff2",
}
COMPRESSED = (".css", ".html", ".js", ".json", ".mjs", ".svg", ".wasm", ".webmanifest")
# Files below /static/ have a fingerprint of their content in their names.
FOR_EVER = "public, max-age=31536000, immutable"
ASK_AGAIN = "no-cache"
# An API or a file answers 404 for an unknown path; other paths are the application's.
NOT_PAGES = ("api/", "assets/", "static/", "link")
# The one-time token in the URL that is opened on the lab's machine.
TOKEN = "token"
NOT_BUILT = (
    "<!doctype html><title>MR-Lab</title><p>The pages are not built. "
    "Run <code>make demo</code>, or <code>scripts/npm run build</code>, then load this again.</p>"
)

router = APIRouter(include_in_schema=False)


@dataclass(frozen=True)
class Page:
    """A file as it is sent; compressed: gzip of it, where that is worth it."""

    body: bytes
    compressed: bytes | None
    etag: str
    media_type: str


def pages_folder() -> Path:
    """Return the folder of the built pages: the installed ones, or those of the source tree."""
    installed = directory() / "web" / "dist"
    # A symlinked install points back at the source tree, which may have been built anew.
    index = installed / "index.html"
    return index.resolve().parent if index.exists() else installed


def read_page(folder: Path, path: str) -> Page | None:
    """Return the file at `path` below `folder`; None where there is none."""
    if "\0" in path:
        return None
    file = (folder / path).resolve()
    if not file.is_relative_to(folder.resolve()) or not file.is_file():
        return None
    return _page(file, file.stat().st_mtime_ns)


@lru_cache(maxsize=256)
def _page(file: Path, changed_at: int) -> Page:
    """Read a file; changed_at: ns, so that a newer file is read again."""
    body = file.read_bytes()
    compressed = gzip.compress(body, 9, mtime=0) if file.suffix in COMPRESSED else None
    return Page(
        body,
        compressed,
        hashlib.sha256(body).hexdigest()[:32],
        MIME_TYPES.get(file.suffix, "application/octet-stream"),
    )


def respond(request: Request, page: Page, cache: str) -> Response:
    """Return the page, compressed where the browser takes that; 304 where it has it."""
    packed = page.compressed is not None and accepts_gzip(request)
    etag = f'"{page.etag}{"-gzip" if packed else ""}"'
    headers = {"ETag": etag, "Cache-Control": cache, "Vary": "Accept-Encoding"}
    if is_known(request, etag):
        return Response(status_code=304, headers=headers)
    if packed:
        headers["Content-Encoding"] = "gzip"
    body = page.compressed if packed else page.body
    return Response(body, headers=headers, media_type=page.media_type)


def is_known(request: Request, etag: str) -> bool:
    """Return whether the browser has this version: the header If-None-Match."""
    known = request.headers.get("if-none-match", "")
    return known == "*" or etag in (each.strip().removeprefix("W/") for each in known.split(","))


def accepts_gzip(request: Request) -> bool:
    """Return whether the browser takes gzip."""
    accepted = request.headers.get("accept-encoding", "")
    kinds = (each.replace(" ", "").partition(";") for each in accepted.split(","))
    return any(kind == "gzip" and quality != "q=0" for kind, _, quality in kinds)


def enter(request: Request, people: People) -> Response:
    """Sign the local user in, where the token of the URL is one; go on without it in the URL."""
    people.links_by_address.check(address_of(request), people.steady())
    # Not request.url.path alone: //host would lead away.
    response = RedirectResponse("/" + request.url.path.lstrip("/"), 303)
    if people.accounts.opened(request.query_params[TOKEN], people.clock()):
        people.sign_in(response, LOCAL, Role.INSTRUCTOR)
    return response


@router.api_route("/{path:path}", methods=["GET", "HEAD"])
async def page(request: Request, people: ThePeople, path: str) -> Response:
    """Answer with a built file, or with the application, which reads the path itself.

    The one-time token in the URL that `mrlab up` and `mrlab open` print is taken out of it.
    """
    if TOKEN in request.query_params and request.method == "GET":
        return await to_thread.run_sync(enter, request, people)
    folder: Path = request.app.state.pages
    found = await to_thread.run_sync(read_page, folder, path or "index.html")
    if found is not None:
        return respond(request, found, FOR_EVER if path.startswith("static/") else ASK_AGAIN)
    if path.startswith(NOT_PAGES) or Path(path).suffix in MIME_TYPES:
        raise NotFound(NOTHING_AT(path=f"/{path}"))
    index = await to_thread.run_sync(read_page, folder, "index.html")
    if index is None:
        return Response(NOT_BUILT, 503, media_type="text/html")
    return respond(request, index, ASK_AGAIN)
