"""Fetches assets from the lab once for all browsers; checks now and then for newer ones."""

from __future__ import annotations

import asyncio
import gzip
import hashlib
import time
from collections import OrderedDict
from collections.abc import AsyncIterator, Callable
from dataclasses import dataclass

from mrlab_ros.core.base.errors import BadInput, LabError, Unavailable
from mrlab_ros.core.bridge.assets import (
    LARGEST_PIECE,
    Described,
    asset_key,
    path_of_key,
    read_attachment,
)
from mrlab_ros.gateway.diagnostics import ASSET_CHANGED, ASSET_UNANSWERED, ASSET_UNSTEADY
from mrlab_ros.gateway.errors import NotFound
from mrlab_ros.gateway.lab.connection import LabConnection, NoAnswer, Refused, Sample
from mrlab_ros.gateway.pages import Page

MIB = 1 << 20
# An asset that was asked for is compared with the lab's at most this often, s.
FRESH_S = 5.0
# A file that changes while it is fetched is fetched anew; this often in all.
ATTEMPTS = 3
# Media types that compression does not shrink: pictures.
NOT_COMPRESSED = ("image/png", "image/jpeg", "image/webp", "image/gif")


class Changed(LabError):
    """An asset changed while its pieces were fetched."""


@dataclass
class _Entry:
    """An asset that was fetched; checked: when it was last compared with the lab's, s."""

    page: Page
    checked: float

    @property
    def size(self) -> int:
        return len(self.page.body) + len(self.page.compressed or b"")


class AssetCache:
    """The assets that browsers asked for, up to `room` bytes; the least used go first.

    largest: bytes of an asset that is kept; a larger one is streamed piece by piece.
    """

    def __init__(
        self,
        lab: LabConnection,
        *,
        room: int = 256 * MIB,
        largest: int = 32 * MIB,
        now: Callable[[], float] = time.monotonic,
    ) -> None:
        self._lab = lab
        self._room = room
        self._largest = largest
        self._now = now
        self._entries: OrderedDict[str, _Entry] = OrderedDict()
        self._fetching: dict[str, asyncio.Task[Page | Described]] = {}

    async def get(self, path: str) -> Page | Described:
        """Return an asset; only its description where it is too large to be kept.

        Requests for one asset share one fetch. An asset that is kept is served while the lab is
        away. Raises NotFound, Unavailable or NoAnswer.
        """
        try:
            path_of_key(asset_key(path))
        except BadInput as error:
            raise NotFound(error.diagnostic) from None
        entry = self._entries.get(path)
        if entry is not None and self._now() - entry.checked < FRESH_S:
            self._entries.move_to_end(path)
            return entry.page
        task = self._fetching.get(path)
        if task is None:
            task = self._fetching[path] = asyncio.create_task(self._refresh(path, entry))
            task.add_done_callback(lambda _: self._fetching.pop(path, None))
        # One browser that goes away does not end the fetch of the others.
        return await asyncio.shield(task)

    async def pieces(self, path: str, whole: Described, at: int = 0) -> AsyncIterator[bytes]:
        """Yield an asset from byte `at` on; raise Changed where it is another one meanwhile."""
        while at < whole.size:
            found, data = await self._piece(path, at, LARGEST_PIECE)
            if found != whole or not data:
                raise Changed(ASSET_CHANGED(asset=asset_key(path)))
            at += len(data)
            yield data

    async def _refresh(self, path: str, entry: _Entry | None) -> Page | Described:
        try:
            if entry is not None and (await self._piece(path, 0, 0))[0].sha256 == entry.page.etag:
                entry.checked = self._now()
                return entry.page
            fetched = await self._fetch(path)
        except NotFound:
            self._entries.pop(path, None)
            raise
        except (NoAnswer, Unavailable):
            if entry is None:
                raise
            return entry.page
        if isinstance(fetched, Page):
            self._keep(path, _Entry(fetched, self._now()))
        return fetched

    async def _fetch(self, path: str) -> Page | Described:
        for _ in range(ATTEMPTS):
            whole, first = await self._piece(path, 0, LARGEST_PIECE)
            if whole.size > self._largest:
                return whole
            try:
                rest = [data async for data in self.pieces(path, whole, len(first))]
            except Changed:
                continue
            body = b"".join([first, *rest])
            if hashlib.sha256(body).hexdigest() == whole.sha256:
                packed = None
                if whole.media_type not in NOT_COMPRESSED:
                    packed = await asyncio.to_thread(gzip.compress, body, 6, mtime=0)
                return Page(body, packed, whole.sha256, whole.media_type)
        raise Unavailable(ASSET_UNSTEADY(asset=asset_key(path)))

    async def _piece(self, path: str, offset: int, length: int) -> tuple[Described, bytes]:
        key = asset_key(path)
        try:
            sample: Sample | None = await self._lab.get(f"{key}?offset={offset};length={length}")
        except Refused as error:
            raise NotFound(error.diagnostic) from None
        if sample is None:
            raise Unavailable(ASSET_UNANSWERED(asset=key))
        return read_attachment(sample.attachment)[0], sample.payload

    def _keep(self, path: str, entry: _Entry) -> None:
        self._entries[path] = entry
        self._entries.move_to_end(path)
        while sum(each.size for each in self._entries.values()) > self._room:
            self._entries.popitem(last=False)
