"""Sign-ins: rows on the server, so that they can be listed and taken back at once.

The file in which a gateway keeps people, sign-ins and one-time links.

SQLite, so that `mrlab users` and a running gateway can use it at the same time. Secrets are stored
as SHA-256 digests: a copy of the file signs nobody in.
"""

from __future__ import annotations

import asyncio
import errno
import hashlib
import hmac
import logging
import os
import secrets
import sqlite3
import threading
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from mrlab_ros.adapters.diagnostics import NO_ROOM_ON_DISK
from mrlab_ros.core.base.diagnostic import Diagnostic
from mrlab_ros.core.base.errors import BadInput, Unavailable
from mrlab_ros.core.base.foreign_text import visible
from mrlab_ros.core.base.machine import lack
from mrlab_ros.core.bridge.rules import Role
from mrlab_ros.core.runtime.bucket import Occurrences
from mrlab_ros.gateway.people.diagnostics import (
    USERS_LOCKED,
    USERS_OTHER_VERSION,
    USERS_UNUSABLE,
)
from mrlab_ros.gateway.people.person import LOCAL, Person

log = logging.getLogger("mrlab.gateway")

FILE = "users.sqlite"
# Of the tables below; a file with other tables is not touched.
SCHEMA_VERSION = 2
# How long a writer waits for another one, s.
BUSY_TIMEOUT_S = 5.0
SQLITE_FULL = 13  # sqlite3.SQLITE_FULL, from Python 3.11
SCHEMA = """
CREATE TABLE IF NOT EXISTS lab (id TEXT NOT NULL, secret BLOB NOT NULL);
CREATE TABLE IF NOT EXISTS people (
    name TEXT PRIMARY KEY COLLATE NOCASE, role TEXT NOT NULL, password TEXT, subject TEXT UNIQUE
);
CREATE TABLE IF NOT EXISTS ids (
    id TEXT PRIMARY KEY COLLATE NOCASE, name TEXT UNIQUE COLLATE NOCASE
);
CREATE TABLE IF NOT EXISTS sign_ins (
    id TEXT PRIMARY KEY, digest BLOB NOT NULL UNIQUE, name TEXT NOT NULL COLLATE NOCASE,
    role TEXT NOT NULL, device TEXT NOT NULL, created REAL NOT NULL, seen REAL NOT NULL,
    expires REAL NOT NULL, let_in_by TEXT NOT NULL
);
CREATE TABLE IF NOT EXISTS links (
    digest BLOB PRIMARY KEY, kind TEXT NOT NULL, name TEXT NOT NULL COLLATE NOCASE,
    expires REAL NOT NULL
);
"""


def new_secret() -> str:
    """Return a random text for a URL or a cookie, 256 bits."""
    return secrets.token_urlsafe(32)


# What the token of a program begins with, so that scanners for secrets know it; no cookie does.
TOKEN_PREFIX = "mrlab_"


def new_token() -> str:
    """Return a random text for a program, which sends it in the header Authorization."""
    return TOKEN_PREFIX + new_secret()


def digest(secret: str) -> bytes:
    """Return what is stored of a secret. It is random, so a fast hash is enough."""
    return hashlib.sha256(secret.encode(errors="replace")).digest()


class Database:
    """The open file; its methods may be called from any thread."""

    def __init__(self, path: Path) -> None:
        """Open the file, or make it; raises BadInput where that is impossible, Unavailable where
        the disk is full."""
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
            self._make_tables()
            with self.writing() as connection:
                if connection.execute("SELECT 1 FROM lab").fetchone() is None:
                    row = (secrets.token_hex(4), secrets.token_bytes(32))
                    connection.execute("INSERT INTO lab VALUES (?, ?)", row)
            found = self.rows("SELECT id, secret FROM lab")[0]
        except (OSError, sqlite3.Error) as error:
            full = _no_room(error, path)
            if full is not None:
                raise Unavailable(full) from error
            raise BadInput(USERS_UNUSABLE(path=str(path), why=str(error))) from error
        self.lab_id: str = found["id"]
        self.secret: bytes = found["secret"]

    def _make_tables(self) -> None:
        """Make the tables; raise BadInput where the file has those of another version."""
        (version,) = self._connection.execute("PRAGMA user_version").fetchone()
        (tables,) = self._connection.execute("SELECT count(*) FROM sqlite_master").fetchone()
        if tables and version != SCHEMA_VERSION:
            raise BadInput(USERS_OTHER_VERSION(path=str(self.path)))
        self._connection.executescript(SCHEMA)
        self._connection.execute(f"PRAGMA user_version = {SCHEMA_VERSION}")

    def rows(self, query: str, *values: Any) -> list[sqlite3.Row]:
        """Return what a query finds."""
        with self._lock:
            return self._connection.execute(query, values).fetchall()

    @contextmanager
    def writing(self, wait: float = BUSY_TIMEOUT_S) -> Iterator[sqlite3.Connection]:
        """Change several rows at once, or none of them.

        wait: for another process that writes, s; sqlite3.OperationalError where it takes longer.
        Raises Unavailable where the disk is full.
        """
        with self._lock:
            self._connection.execute(f"PRAGMA busy_timeout = {round(wait * 1000)}")
            self._connection.execute("BEGIN IMMEDIATE")
            try:
                yield self._connection
                self._connection.execute("COMMIT")
            except BaseException as error:
                # on a full disk SQLite has taken everything back already
                if self._connection.in_transaction:
                    self._connection.execute("ROLLBACK")
                full = _no_room(error, self.path)
                if full is not None:
                    raise Unavailable(full) from None
                raise

    def close(self) -> None:
        """Close the file."""
        with self._lock:
            self._connection.close()


def _no_room(error: BaseException, path: Path) -> Diagnostic | None:
    """Return what is said where the file at `path` finds no room; None: that is not the cause."""
    found = lack(error)
    full = getattr(error, "sqlite_errorcode", None) == SQLITE_FULL
    if not full and (found is None or not found.is_room):
        return None
    return NO_ROOM_ON_DISK(folder=str(path.parent), why=os.strerror(errno.ENOSPC))


LIFETIME_S = 7 * 24 * 3600.0
DEVICE_LIFETIME_S = 90 * 24 * 3600.0
# How often `seen` is written for a sign-in that is in use, s.
SEEN_PERIOD_S = 60.0
# How often a gateway looks for changes by `mrlab users` and for sign-ins that expired, s.
FOLLOW_PERIOD_S = 0.5


@dataclass(frozen=True)
class SignIn:
    """A sign-in; device: a paired one's name, empty for a browser. Times are s since 1970."""

    id: str
    name: str
    role: Role
    device: str
    created: float
    seen: float
    expires: float


# A person's role now; a device has at most the role that it was paired as. The local user has no
# row in people.
VALID = (
    "SELECT s.*, p.role AS now_role, i.id AS person FROM sign_ins s "
    "LEFT JOIN people p ON p.name = s.name LEFT JOIN ids i ON i.name = s.name "
    f"WHERE s.expires > ? AND (p.name IS NOT NULL OR s.name = '{LOCAL}')"
)


class SignIns:
    """The sign-ins of a lab; `follow` runs while the gateway does."""

    def __init__(self, database: Database) -> None:
        self._database = database
        # By id: for whom somebody waits for the end of the sign-in, and the role at that time.
        self._waiting: dict[str, list[tuple[Role, asyncio.Event]]] = {}
        self._failures = Occurrences()

    def begin(
        self,
        name: str,
        role: Role,
        now: float,
        *,
        device: str = "",
        let_in_by: str = "",
        lifetime: float = LIFETIME_S,
        secret: str = "",
    ) -> str:
        """Sign somebody in; return the secret for the cookie.

        device: name of a paired device or a program. let_in_by: id of the sign-in that let it in.
        secret: a program's token.
        """
        secret = secret or new_secret()
        row = (
            secrets.token_hex(8), digest(secret), name, role.value, device, now, now,
            now + lifetime, let_in_by,
        )  # fmt: skip
        with self._database.writing() as connection:
            connection.execute("DELETE FROM sign_ins WHERE expires <= ?", (now,))
            connection.execute("INSERT INTO sign_ins VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?)", row)
        log.info("%s signed in as %s: %s", name, role.value, visible(device) or "browser")
        return secret

    def person(self, secret: str, now: float) -> Person | None:
        """Return whom a cookie's secret signs in; None where it signs in nobody (any more)."""
        rows = self._database.rows(f"{VALID} AND s.digest = ?", now, digest(secret))
        if not rows:
            return None
        found = _sign_in(rows[0])
        if now - found.seen > SEEN_PERIOD_S:
            # Another process may be writing; the next request tries again. Requests do not wait.
            # A full disk signs nobody out.
            busy = suppress(sqlite3.OperationalError, Unavailable)
            with busy, self._database.writing(wait=0) as connection:
                connection.execute("UPDATE sign_ins SET seen = ? WHERE id = ?", (now, found.id))
        person = rows[0]["person"] or found.name
        return Person(found.name, found.role, found.id, bool(found.device), person)

    def all(self, now: float, name: str | None = None) -> list[SignIn]:
        """Return the sign-ins of a person, or of everybody, newest first."""
        if name is None:
            rows = self._database.rows(f"{VALID} ORDER BY s.created DESC", now)
        else:
            rows = self._database.rows(
                f"{VALID} AND s.name = ? ORDER BY s.created DESC", now, name
            )
        return [_sign_in(row) for row in rows]

    def end(self, sign_in: str) -> None:
        """End a sign-in; its sockets close. Nothing happens where there is none."""
        with self._database.writing() as connection:
            connection.execute("DELETE FROM sign_ins WHERE id = ?", (sign_in,))

    def end_with_devices(self, sign_in: str) -> None:
        """End a sign-in, and those of the devices that it let in."""
        with self._database.writing() as connection:
            connection.execute(
                "DELETE FROM sign_ins WHERE id = ? OR let_in_by = ?", (sign_in, sign_in)
            )
        log.info("sign-in %s was ended, and what it let in", sign_in)

    def csrf(self, secret: str) -> str:
        """Return the CSRF token that belongs to a cookie's secret; empty: nobody is signed in."""
        message = b"csrf:" + secret.encode(errors="replace")
        return hmac.new(self._database.secret, message, "sha256").hexdigest()

    def csrf_matches(self, token: str, secret: str) -> bool:
        """Return whether a CSRF token belongs to a cookie's secret."""
        return hmac.compare_digest(token.encode(errors="replace"), self.csrf(secret).encode())

    @contextmanager
    def ending(self, person: Person) -> Iterator[asyncio.Event]:
        """Yield an event that is set when the sign-in of `person` ends or changes its role.

        For sockets: they close then. In the event loop of the gateway only.
        """
        entry = (person.role, asyncio.Event())
        self._waiting.setdefault(person.sign_in, []).append(entry)
        try:
            yield entry[1]
        finally:
            entries = self._waiting[person.sign_in]
            entries.remove(entry)
            if not entries:
                del self._waiting[person.sign_in]

    async def check(self, now: float) -> None:
        """Set the events of sign-ins that have ended or have another role.

        The file is read in a thread: a program that has locked it stops no page. Where it stays
        locked, the next check finds what has changed.
        """
        if not self._waiting:
            return
        try:
            roles = await asyncio.to_thread(self._roles, now)
        except sqlite3.OperationalError as error:
            if self._failures.again((str(error),), now) is not None:
                logging.warning("%s", USERS_LOCKED(path=str(self._database.path), why=str(error)))
            return
        for sign_in, entries in list(self._waiting.items()):
            # With --insecure nobody has a sign-in that could end.
            if not sign_in:
                continue
            for role, event in entries:
                if roles.get(sign_in) is not role:
                    event.set()

    def _roles(self, now: float) -> dict[str, Role]:
        return {each.id: each.role for each in self.all(now)}


def _sign_in(row: sqlite3.Row) -> SignIn:
    role = Role(row["role"])
    if row["now_role"] is not None:
        now_role = Role(row["now_role"])
        # A browser has the person's role; a device at most that.
        role = now_role if not row["device"] or role.may(now_role) else role
    return SignIn(
        row["id"], row["name"], role, row["device"], row["created"], row["seen"], row["expires"]
    )
