"""The object store as the lab needs it.

An object is written as a whole or not at all, also where the writing process is killed: nobody
ever sees a part of one. Keys are those of `keys`.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import BinaryIO, Protocol

from mrlab_ros.core.base.errors import BadInput, LabError


class Missing(BadInput):
    """There is no object under the key."""


class StoreFailure(LabError):
    """The store does not answer, refuses, or is full; what it holds is unchanged."""


@dataclass(frozen=True)
class Entry:
    """An object in a listing. size: bytes. modified: s since 1970. tag: changes with its bytes."""

    key: str
    size: int
    modified: float
    tag: str


class ObjectStore(Protocol):
    """Objects by key; safe from several threads. Every call may raise StoreFailure.

    place: the folder or URL, for sentences.
    """

    place: str

    def put(self, key: str, data: bytes) -> None:
        """Write an object, replacing one of that key."""

    def put_file(self, key: str, file: BinaryIO) -> None:
        """Write an object from all bytes of an open file, in pieces."""

    def get(self, key: str) -> bytes:
        """Return an object's bytes; raise Missing."""

    def get_file(self, key: str, file: BinaryIO) -> int:
        """Write an object's bytes into an open file, in pieces; return how many; raise Missing."""

    def size(self, key: str) -> int:
        """Return an object's size, bytes; raise Missing."""

    def list(self, prefix: str) -> list[Entry]:
        """Return every object below `prefix`, a folder without its last slash, in any order."""

    def copy(self, source: str, target: str) -> None:
        """Copy an object within the store; raise Missing."""

    def delete(self, keys: Iterable[str]) -> None:
        """Remove objects; one that is not there is no mistake."""

    def path(self, key: str) -> Path | None:
        """Return the file that holds the object, where the store is a folder of this machine."""

    def clear_interrupted(self, older_than: float) -> int:
        """Remove what writers left that were killed `older_than` s ago; return how many."""
