"""The object stores of obstore: a folder, S3, Google Cloud Storage or Azure Blob Storage.

Credentials come from the environment, as the tools of each service expect them (docs/store.md).
"""

from __future__ import annotations

import contextlib
import errno
import os
import re
import time
from collections.abc import Iterable, Iterator
from datetime import timedelta
from pathlib import Path
from typing import Any, BinaryIO

import obstore
from obstore.exceptions import BaseError
from obstore.store import LocalStore, from_url

from mrlab_ros.adapters import private_folder
from mrlab_ros.adapters.diagnostics import NO_ROOM_ON_DISK
from mrlab_ros.adapters.store.diagnostics import (
    NO_STORE,
    NOT_IN_STORE,
    STORE_FAILED,
    STORE_FOLDER_UNUSABLE,
    STORE_SILENT,
    STORE_UNUSABLE,
)
from mrlab_ros.adapters.store.port import Entry, Missing, ObjectStore, StoreFailure
from mrlab_ros.core.base.diagnostic import Diagnostic
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.base.machine import lack

MiB = 1 << 20
# A larger object is written in parts; a smaller one in a single request, which leaves nothing
# where it is interrupted.
SINGLE_REQUEST = 64 * MiB
PART = 16 * MiB
WRITERS = 4  # parts at once: 64 MiB of memory
SCHEMES = ("s3", "s3a", "gs", "az", "azure", "abfs", "abfss", "adl")
URL = re.compile(r"([a-z][a-z0-9]*)://(.*)", re.DOTALL)
# A store that is down is noticed within seconds, and one that hiccups is asked again.
RETRY: Any = {
    "max_retries": 3,
    "retry_timeout": timedelta(seconds=8),
    "backoff": {"init_backoff": timedelta(milliseconds=200), "max_backoff": timedelta(seconds=2)},
}
CLIENT: Any = {"connect_timeout": "3 seconds", "timeout": "60 seconds"}
# obstore's files beside one that a killed process was writing.
UNFINISHED = re.compile(r".+#[0-9]+")
# A service says of a bucket that is not there what it says of an object.
NO_BUCKET = re.compile("NoSuchBucket|ContainerNotFound|bucket does not exist")
SERVICE_ERROR = re.compile(r"<Code>(\w+)</Code>\s*<Message>([^<]*)")
OS_ERROR = re.compile(r"\(os error (\d+)\)")  # how Rust names one of the system
UNREACHABLE = re.compile("error sending request|tcp connect error|operation timed out")
LONGEST_REASON = 200


def open_store(place: str) -> ObstoreStore:
    """Open a store by URL or folder, which is made; raise BadInput where it cannot be used.

    A service is not asked yet: one that does not answer is a StoreFailure of the first call.
    """
    url = URL.fullmatch(place)
    if url is None:
        path = Path(place).expanduser().absolute()
        return ObstoreStore(_folder(path), str(path))
    if url[1] not in SCHEMES or not url[2].strip("/"):
        raise BadInput(NO_STORE(store=place))
    try:
        inside: Any = from_url(place, retry_config=RETRY, client_options=_client(url[1]))
    except (BaseError, ValueError, OSError) as error:
        raise BadInput(STORE_UNUSABLE(store=place, why=_reason(error))) from None
    return ObstoreStore(inside, place)


def _client(scheme: str) -> Any:
    # A store on this network, such as MinIO, is reached without TLS only where it is asked for.
    plain = scheme.startswith("s3") and os.environ.get("AWS_ALLOW_HTTP", "").lower() == "true"
    return CLIENT | ({"allow_http": True} if plain else {})


def _folder(path: Path) -> Any:
    try:
        return LocalStore(private_folder.make(path))
    except (OSError, BaseError, BadInput) as error:
        why = error if isinstance(error, BadInput) else _reason(error)
        why = getattr(error, "strerror", None) or why
        raise BadInput(STORE_FOLDER_UNUSABLE(folder=str(path), why=why)) from None


class ObstoreStore(ObjectStore):
    """A store of obstore behind the port."""

    def __init__(self, inside: Any, place: str) -> None:
        self.place = place
        self._inside = inside
        self._root = Path(str(inside.prefix)) if isinstance(inside, LocalStore) else None

    def put(self, key: str, data: bytes) -> None:
        with self._as_errors(key, writes=True):
            obstore.put(self._inside, key, data, use_multipart=False)

    def put_file(self, key: str, file: BinaryIO) -> None:
        file.seek(0, os.SEEK_END)
        size = file.tell()
        file.seek(0)
        with self._as_errors(key, writes=True):
            if size <= SINGLE_REQUEST and self._root is None:
                obstore.put(self._inside, key, file.read(), use_multipart=False)
            else:
                parts = iter(lambda: file.read(PART), b"")
                obstore.put(self._inside, key, parts, chunk_size=PART, max_concurrency=WRITERS)

    def get(self, key: str) -> bytes:
        with self._as_errors(key):
            return bytes(obstore.get(self._inside, key).bytes())

    def get_file(self, key: str, file: BinaryIO) -> int:
        size = self.size(key)
        with self._as_errors(key):
            for begin in range(0, size, PART):
                end = min(begin + PART, size)
                file.write(obstore.get_range(self._inside, key, start=begin, end=end))
        return size

    def size(self, key: str) -> int:
        with self._as_errors(key):
            return int(obstore.head(self._inside, key)["size"])

    def list(self, prefix: str) -> list[Entry]:
        with self._as_errors(prefix):
            found = [one for part in obstore.list(self._inside, prefix) for one in part]
        return [
            Entry(one["path"], one["size"], one["last_modified"].timestamp(), one["e_tag"] or "")
            for one in found
        ]

    def copy(self, source: str, target: str) -> None:
        with self._as_errors(source):
            obstore.copy(self._inside, source, target)

    def delete(self, keys: Iterable[str]) -> None:
        for key in keys:
            with contextlib.suppress(Missing), self._as_errors(key):
                obstore.delete(self._inside, key)

    def path(self, key: str) -> Path | None:
        return None if self._root is None else self._root / key

    def clear_interrupted(self, older_than: float) -> int:
        """Remove what killed writers left in a folder; a service never shows unfinished objects.

        Parts that an interrupted writer sent to a service are removed by a rule of the bucket
        (docs/store.md).
        """
        count = 0
        for folder, _, files in os.walk(self._root) if self._root is not None else ():
            for name in filter(UNFINISHED.fullmatch, files):
                path = Path(folder, name)
                with contextlib.suppress(OSError):
                    if path.stat().st_mtime <= time.time() - older_than:
                        path.unlink()
                        count += 1
        return count

    @contextlib.contextmanager
    def _as_errors(self, key: str, *, writes: bool = False) -> Iterator[None]:
        """Raise what obstore raises as an error of the port."""
        try:
            yield
        except (BaseError, OSError, ValueError) as error:
            missing = isinstance(error, FileNotFoundError) and not NO_BUCKET.search(str(error))
            if missing and not writes:
                raise Missing(NOT_IN_STORE(key=key)) from None
            full = _without_room(error)
            if full is not None:
                raise StoreFailure(NO_ROOM_ON_DISK(folder=self.place, why=full)) from None
            raise StoreFailure(STORE_FAILED(store=self.place, why=_reason(error))) from None


def _without_room(error: BaseException) -> str | None:
    """Return what the system calls a disk that is full; None: the cause is another one."""
    number = OS_ERROR.search(str(error))
    found = lack(OSError(int(number[1]), "") if number else error)
    return os.strerror(errno.ENOSPC) if found is not None and found.is_room else None


def _reason(error: BaseException) -> Diagnostic | str:
    """Return the cause that obstore's text names, in one short line."""
    text = " ".join(str(error).split("Debug source:", 1)[0].split())
    if UNREACHABLE.search(text):
        return STORE_SILENT()
    if answer := SERVICE_ERROR.search(text):
        return f"{answer[1]}: {answer[2].strip(' .')}"
    # the cause stands at the end, after what was tried
    return text.rsplit(" - ", 1)[-1].strip(" .")[-LONGEST_REASON:] or type(error).__name__
