"""Takes a file from a request's body into the store, whole or not at all.

The body is counted and hashed while it comes, into a file without a name: whatever is killed or
breaks off in between leaves nothing.
"""

from __future__ import annotations

import hashlib
import tempfile
from collections.abc import AsyncIterator, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from threading import Lock

from fastapi.concurrency import run_in_threadpool

from mrlab_ros.adapters.store import keys
from mrlab_ros.adapters.store.port import ObjectStore, StoreFailure
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.gateway.errors import TooLarge
from mrlab_ros.gateway.uploads.diagnostics import (
    EMPTY_UPLOAD,
    FILE_NAME_LENGTH,
    FILE_NAME_SIGNS,
    FILE_TOO_LARGE,
    NO_FILE_NAME,
    NO_ROOM,
    OTHER_ENDING,
    QUOTA_FULL,
)

MiB = 1 << 20
BLOCK = MiB  # bytes that are hashed and written at once
# Endings of files that the converter reads; it finds the real kind in the file.
ENDINGS = (
    *(".mat", ".m", ".csv", ".txt", ".tsv", ".npz", ".npy", ".json", ".yaml"),
    *(".mcap", ".db3", ".cdr"),
    *(".gz", ".zst", ".zstd"),
)
LONGEST_NAME = 255


@dataclass(frozen=True)
class Bounds:
    """largest: bytes of one file. quota: bytes that one person's uploads and drafts may take."""

    largest: int = 1024 * MiB
    quota: int = 2048 * MiB


@dataclass(frozen=True)
class Received:
    """A file in the store. number: names it, to the person who sent it."""

    number: str
    file_name: str
    size: int
    sha256: str


class Receiver:
    """Receives files for the people of one gateway."""

    def __init__(self, store: ObjectStore, work: Path, bounds: Bounds | None = None) -> None:
        self.bounds = bounds or Bounds()
        self._store, self._work = store, work
        # Bytes of bodies that are coming, by person: two files at once share a quota.
        self._coming: dict[str, int] = {}
        self._lock = Lock()

    async def receive(
        self, user: str, file_name: str, announced: int | None, body: AsyncIterator[bytes]
    ) -> Received:
        """Store a body; announced: the bytes that its sender names, None: not said.

        Raises TooLarge, BadInput, StoreFailure, or what reading the body raises.
        """
        checked_name(file_name)
        self._check_size(announced or 0)
        used = await run_in_threadpool(self._used, user)
        with room(file_name):
            opened = tempfile.TemporaryFile(dir=self._work)  # noqa: SIM115
        with opened as file, self._counted(user) as coming:
            digest, size, block = hashlib.sha256(), 0, bytearray()

            def keep(data: bytes) -> None:
                digest.update(data)
                with room(file_name):
                    file.write(data)
                    file.flush()

            self._check_quota(user, used, announced or 0)
            async for chunk in body:
                size += len(chunk)
                self._check_size(size)
                coming(len(chunk))
                self._check_quota(user, used, 0)
                block += chunk
                if len(block) >= BLOCK:
                    await run_in_threadpool(keep, bytes(block))
                    block.clear()
            await run_in_threadpool(keep, bytes(block))
            if size == 0:
                raise BadInput(EMPTY_UPLOAD(file=file_name))
            # Files that came meanwhile are in the store now.
            used = await run_in_threadpool(self._used, user)
            self._check_quota(user, used, 0)
            number = keys.unique()
            key = keys.upload(user, number, file_name)
            await run_in_threadpool(self._store.put_file, key, file)  # type: ignore[arg-type]
        return Received(number, file_name, size, digest.hexdigest())

    def _used(self, user: str) -> int:
        return sum(entry.size for entry in self._store.list(keys.user(user)))

    def _check_size(self, size: int) -> None:
        if size > self.bounds.largest:
            raise TooLarge(FILE_TOO_LARGE(most=self.bounds.largest))

    def _check_quota(self, user: str, used: int, announced: int) -> None:
        total = used + max(self._coming.get(user, 0), announced)
        if total > self.bounds.quota:
            raise TooLarge(QUOTA_FULL(used=used, most=self.bounds.quota))

    @contextmanager
    def _counted(self, user: str) -> Iterator[Coming]:
        """Yield what counts bytes that come for a person; they stop to count at the end."""
        coming = Coming(self._coming, self._lock, user)
        try:
            yield coming
        finally:
            coming(-coming.total)


@contextmanager
def room(file_name: str) -> Iterator[None]:
    """Say in a sentence that the gateway's own disk is full."""
    try:
        yield
    except OSError as error:
        raise StoreFailure(NO_ROOM(file=file_name, why=str(error.strerror))) from None


class Coming:
    """Counts the bytes of one body among those of its person."""

    def __init__(self, sums: dict[str, int], lock: Lock, user: str) -> None:
        self._sums, self._lock, self._user = sums, lock, user
        self.total = 0

    def __call__(self, count: int) -> None:
        with self._lock:
            self.total += count
            left = self._sums.get(self._user, 0) + count
            if left:
                self._sums[self._user] = left
            else:
                self._sums.pop(self._user, None)


def checked_name(name: str) -> str:
    """Return a file's name; raise BadInput for one that is too long or of another kind."""
    if len(name) > LONGEST_NAME:
        raise BadInput(FILE_NAME_LENGTH(count=len(name), most=LONGEST_NAME))
    if not name.strip(". "):
        raise BadInput(NO_FILE_NAME(file=name))
    if not name.isprintable():
        raise BadInput(FILE_NAME_SIGNS(file=repr(name)))
    if not name.lower().endswith(ENDINGS):
        raise BadInput(OTHER_ENDING(file=name, endings=ENDINGS))
    return name
