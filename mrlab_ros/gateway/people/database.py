"""The file in which a gateway keeps people, sign-ins and one-time links.

SQLite, so that `mrlab users` and a running gateway can use it at the same time. Secrets are stored
as SHA-256 digests: a copy of the file signs nobody in.
"""

from __future__ import annotations

import hashlib
import os
import secrets
import sqlite3
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.gateway.people.diagnostics import USERS_UNUSABLE

FILE = "users.sqlite"
# How long a writer waits for another one, s.
BUSY_TIMEOUT_S = 5.0
SCHEMA = """
CREATE TABLE IF NOT EXISTS lab (id TEXT NOT NULL, secret BLOB NOT NULL);
CREATE TABLE IF NOT EXISTS people (
    name TEXT PRIMARY KEY COLLATE NOCASE, role TEXT NOT NULL, password TEXT, subject TEXT UNIQUE
);
CREATE TABLE IF NOT EXISTS sign_ins (
    id TEXT PRIMARY KEY, digest BLOB NOT NULL UNIQUE, name TEXT NOT NULL COLLATE NOCASE,
    role TEXT NOT NULL, device TEXT NOT NULL, created REAL NOT NULL, seen REAL NOT NULL,
    expires REAL NOT NULL
);
CREATE TABLE IF NOT EXISTS links (
    digest BLOB PRIMARY KEY, kind TEXT NOT NULL, name TEXT NOT NULL COLLATE NOCASE,
    expires REAL NOT NULL
);
"""


def new_secret() -> str:
    """Return a random text for a URL or a cookie, 256 bits."""
    return secrets.token_urlsafe(32)


def digest(secret: str) -> bytes:
    """Return what is stored of a secret. It is random, so a fast hash is enough."""
    return hashlib.sha256(secret.encode(errors="replace")).digest()


class Database:
    """The open file; its methods may be called from any thread."""

    def __init__(self, path: Path) -> None:
        """Open the file, or make it; raises BadInput where that is impossible."""
        self._lock = threading.RLock()
        self.path = path
        try:
            path.parent.mkdir(mode=0o700, parents=True, exist_ok=True)
            # SQLite would give it the mode of the umask.
            os.close(os.open(path, os.O_RDWR | os.O_CREAT, 0o600))
            self._connection = sqlite3.connect(
                path, timeout=BUSY_TIMEOUT_S, isolation_level=None, check_same_thread=False
            )
            self._connection.row_factory = sqlite3.Row
            self._connection.execute("PRAGMA synchronous = NORMAL")
            self._connection.execute("PRAGMA journal_mode = WAL")
            self._connection.executescript(SCHEMA)
            with self.writing() as connection:
                if connection.execute("SELECT 1 FROM lab").fetchone() is None:
                    row = (secrets.token_hex(4), secrets.token_bytes(32))
                    connection.execute("INSERT INTO lab VALUES (?, ?)", row)
            found = self.rows("SELECT id, secret FROM lab")[0]
        except (OSError, sqlite3.Error) as error:
            raise BadInput(USERS_UNUSABLE(path=str(path), why=str(error))) from error
        self.lab_id: str = found["id"]
        self.secret: bytes = found["secret"]

    def rows(self, query: str, *values: Any) -> list[sqlite3.Row]:
        """Return what a query finds."""
        with self._lock:
            return self._connection.execute(query, values).fetchall()

    @contextmanager
    def writing(self) -> Iterator[sqlite3.Connection]:
        """Change several rows at once, or none of them."""
        with self._lock:
            self._connection.execute("BEGIN IMMEDIATE")
            try:
                yield self._connection
            except BaseException:
                self._connection.execute("ROLLBACK")
                raise
            self._connection.execute("COMMIT")

    def close(self) -> None:
        """Close the file."""
        with self._lock:
            self._connection.close()
