"""The people of a lab: names, roles, passwords, and one-time links.

Passwords: argon2id, with the parameters of RFC 9106 for little memory.
"""

from __future__ import annotations

import itertools
import logging
import re
import sqlite3
import threading
import unicodedata
from dataclasses import dataclass

from argon2 import PasswordHasher, profiles
from argon2.exceptions import Argon2Error, InvalidHashError

from mrlab_ros.core.base.diagnostic import Fix
from mrlab_ros.core.base.errors import BadInput, LabError, Misuse
from mrlab_ros.core.bridge.rules import Role
from mrlab_ros.gateway.errors import NotAllowed, NotFound
from mrlab_ros.gateway.people.diagnostics import (
    BAD_PERSON_NAME,
    LAST_INSTRUCTOR,
    LINK_USED,
    NO_NAME_LEFT,
    NO_PERSON,
    PASSWORD_LENGTH,
    PERSON_EXISTS,
)
from mrlab_ros.gateway.people.person import LOCAL
from mrlab_ros.gateway.people.sign_ins import Database, digest, new_secret

SHORTEST = 12
LONGEST = 200
log = logging.getLogger("mrlab.gateway")

# Each takes 64 MiB while it runs.
AT_ONCE = 2


class Passwords:
    """Makes and checks hashes of passwords; takes tens of milliseconds, so call it in a thread."""

    def __init__(self, hasher: PasswordHasher | None = None) -> None:
        self._hasher = hasher or PasswordHasher.from_parameters(profiles.RFC_9106_LOW_MEMORY)
        self._gate = threading.BoundedSemaphore(AT_ONCE)
        # Checked where there is no such person, so that both take equally long.
        self._nobody = self._hasher.hash("nobody")

    def hash(self, password: str) -> str:
        """Return the hash of a new password; raises BadInput where it is too short or long."""
        if not SHORTEST <= len(password) <= LONGEST:
            count = len(password)
            raise BadInput(PASSWORD_LENGTH(count=count, least=SHORTEST, most=LONGEST))
        with self._gate:
            return self._hasher.hash(password.encode(errors="surrogatepass"))

    def matches(self, stored: str | None, password: str) -> bool:
        """Return whether a password belongs to a stored hash; None: there is none."""
        with self._gate:
            try:
                self._hasher.verify(
                    stored or self._nobody, password[:LONGEST].encode(errors="surrogatepass")
                )
            except (Argon2Error, InvalidHashError):
                return False
        return stored is not None


NAME = re.compile(r"[A-Za-z0-9][A-Za-z0-9_.-]{0,40}")
# Names of the store and of the lab itself.
RESERVED = (LOCAL, "lab", "shared", "gateway", "nobody")
INVITATION_LIFETIME_S = 7 * 24 * 3600.0
OPENING_LIFETIME_S = 24 * 3600.0
PEOPLE = "SELECT p.*, i.id FROM people p JOIN ids i ON i.name = p.name"
INVITATION = "invitation"
OPENING = "opening"


@dataclass(frozen=True)
class Account:
    """A person of the lab; signs_in: `password`, `oidc`, or empty until the link was used.

    id: never given to another person, although a name is free again after a removal.
    """

    name: str
    role: Role
    signs_in: str
    id: str


class Accounts:
    """The people of a lab. Times are s since 1970.

    passwords: None where nobody's is set or checked.
    """

    def __init__(self, database: Database, passwords: Passwords | None = None) -> None:
        self._database = database
        self._passwords = passwords

    def all(self) -> list[Account]:
        """Return everybody, by name."""
        return [_account(row) for row in self._database.rows(f"{PEOPLE} ORDER BY p.name")]

    def get(self, name: str) -> Account:
        """Return a person; raises NotFound where there is none."""
        rows = self._database.rows(f"{PEOPLE} WHERE p.name = ?", name)
        if not rows:
            raise NotFound(NO_PERSON(name=name[:60], fixes=(Fix(command="mrlab users list"),)))
        return _account(rows[0])

    def check_new(self, name: str) -> None:
        """Raise BadInput where `name` cannot be one, Misuse where somebody has it."""
        check_name(name)
        if self._database.rows("SELECT 1 FROM people WHERE name = ?", name):
            raise _taken(name)

    def add(self, name: str, role: Role, subject: str | None = None) -> Account:
        """Add a person; subject: what the OpenID Connect provider calls the person."""
        check_name(name)
        try:
            with self._database.writing() as connection:
                connection.execute(
                    "INSERT INTO people VALUES (?, ?, NULL, ?)", (name, role.value, subject)
                )
                connection.execute(
                    "INSERT INTO ids VALUES (?, ?)", (_unused_id(connection, name), name)
                )
        except sqlite3.IntegrityError:
            raise _taken(name) from None
        log.info("%s was added as %s", name, role.value)
        return self.get(name)

    def check_leaves(self, name: str) -> Account:
        """Return a person who may be removed.

        Raises NotFound where there is no such person, Misuse for the last instructor.
        """
        found = self.get(name)
        with self._database.writing() as connection:
            _keep_an_instructor(connection, name)
        return found

    def remove(self, name: str) -> None:
        """Remove a person, the links and the sign-ins.

        What the person owned stays under an id that nobody else gets: instructors see it. Raises
        NotFound where there is no such person, Misuse for the last instructor.
        """
        self.get(name)
        with self._database.writing() as connection:
            _keep_an_instructor(connection, name)
            connection.execute("UPDATE ids SET name = NULL WHERE name = ?", (name,))
            for table in ("people", "sign_ins", "links"):
                connection.execute(f"DELETE FROM {table} WHERE name = ?", (name,))
        log.info("%s was removed", name)

    def set_role(self, name: str, role: Role) -> None:
        """Give a person another role.

        Raises NotFound where there is no such person, Misuse for the last instructor.
        """
        self.get(name)
        with self._database.writing() as connection:
            if role is not Role.INSTRUCTOR:
                _keep_an_instructor(connection, name)
            connection.execute("UPDATE people SET role = ? WHERE name = ?", (role.value, name))
        log.info("%s is %s now", name, role.value)

    def invite(self, name: str, now: float) -> str:
        """Return the secret of a link with which a person chooses a password, once."""
        self.get(name)
        return self._link(INVITATION, name, now + INVITATION_LIFETIME_S)

    def invited(self, secret: str, now: float) -> Account:
        """Return whom a link invites; raises NotFound where it is used, old or none."""
        return self.get(self._named(INVITATION, secret, now))

    def accept(self, secret: str, password: str, now: float) -> Account:
        """Use up a link and set the password; earlier sign-ins of the person end."""
        self.invited(secret, now)
        assert self._passwords is not None
        hashed = self._passwords.hash(password)
        with self._database.writing() as connection:
            row = connection.execute(
                "DELETE FROM links WHERE digest = ? RETURNING name", (digest(secret),)
            ).fetchone()
            if row is None:
                raise _no_link()
            connection.execute(
                "UPDATE people SET password = ? WHERE name = ?", (hashed, row["name"])
            )
            for table in ("sign_ins", "links"):
                connection.execute(f"DELETE FROM {table} WHERE name = ?", (row["name"],))
        log.info("%s chose a password", row["name"])
        return self.get(row["name"])

    def open(self, now: float) -> str:
        """Return the secret of a link that signs the local user in, once."""
        return self._link(OPENING, LOCAL, now + OPENING_LIFETIME_S)

    def opened(self, secret: str, now: float) -> bool:
        """Use up a link of the local user; return whether it was one."""
        with self._database.writing() as connection:
            row = connection.execute(
                "DELETE FROM links WHERE digest = ? AND kind = ? AND expires > ? RETURNING name",
                (digest(secret), OPENING, now),
            ).fetchone()
        return row is not None

    def matching(self, name: str, password: str) -> Account | None:
        """Return the person with this name and password; None where there is none."""
        rows = self._database.rows(f"{PEOPLE} WHERE p.name = ?", name)
        stored = rows[0]["password"] if rows else None
        assert self._passwords is not None
        return _account(rows[0]) if self._passwords.matches(stored, password) else None

    def of_subject(self, subject: str) -> Account | None:
        """Return the person whom an OpenID Connect provider calls so; None: there is none."""
        rows = self._database.rows(f"{PEOPLE} WHERE p.subject = ?", subject)
        return _account(rows[0]) if rows else None

    def of_provider(self, subject: str, wanted: str, role: Role) -> Account:
        """Return the person whom a provider calls so, a new one with a name such as `wanted` where
        there is none. Raises NotAllowed where no such name is left."""
        known = self.of_subject(subject)
        if known is not None:
            return known
        for name in (wanted, *(f"{wanted[:36]}-{i}" for i in range(2, 100))):
            try:
                return self.add(name, role, subject)
            except LabError:
                continue
        raise NotAllowed(NO_NAME_LEFT(name=wanted))

    def _link(self, kind: str, name: str, expires: float) -> str:
        secret = new_secret()
        with self._database.writing() as connection:
            # A new invitation replaces the one before.
            if kind == INVITATION:
                connection.execute("DELETE FROM links WHERE name = ?", (name,))
            connection.execute(
                "INSERT INTO links VALUES (?, ?, ?, ?)", (digest(secret), kind, name, expires)
            )
        return secret

    def _named(self, kind: str, secret: str, now: float) -> str:
        rows = self._database.rows(
            "SELECT name FROM links WHERE digest = ? AND kind = ? AND expires > ?",
            digest(secret),
            kind,
            now,
        )
        if not rows:
            raise _no_link()
        return str(rows[0]["name"])


def plain_name(text: str) -> str:
    """Return a name as this lab takes them: what is before an @, accents gone, the rest as _."""
    plain = "".join(
        c
        for c in unicodedata.normalize("NFKD", text.partition("@")[0])
        if not unicodedata.combining(c)
    )
    name = re.sub(r"[^A-Za-z0-9_.-]", "_", plain)[:41].lstrip("_.-")
    try:
        check_name(name)
    except BadInput:
        return f"person-{name}"[:41].rstrip("-")
    return name


def check_name(name: str) -> None:
    """Raise BadInput where a person cannot have this name."""
    if not NAME.fullmatch(name) or name.lower() in RESERVED:
        raise BadInput(BAD_PERSON_NAME(name=name[:60], reserved=RESERVED))


def _taken(name: str) -> Misuse:
    return Misuse(PERSON_EXISTS(name=name, fixes=(Fix(command=f"mrlab users remove {name}"),)))


def _account(row: sqlite3.Row) -> Account:
    way = "oidc" if row["subject"] else "password" if row["password"] else ""
    return Account(row["name"], Role(row["role"]), way, row["id"])


def _unused_id(connection: sqlite3.Connection, name: str) -> str:
    """Return the name where nobody ever had it as an id, else the name with a number."""
    used = {row["id"].lower() for row in connection.execute("SELECT id FROM ids")}
    others = (f"{name}-{number}" for number in itertools.count(2))
    return next(each for each in itertools.chain([name], others) if each.lower() not in used)


def _keep_an_instructor(connection: sqlite3.Connection, name: str) -> None:
    """Raise Misuse where `name` is the only instructor."""
    query = "SELECT name FROM people WHERE role = ?"
    found = [row["name"].lower() for row in connection.execute(query, (Role.INSTRUCTOR.value,))]
    if found == [name.lower()]:
        raise Misuse(LAST_INSTRUCTOR(name=name))


def _no_link() -> NotFound:
    return NotFound(LINK_USED(fixes=(Fix(command="mrlab users invite NAME"),)))
