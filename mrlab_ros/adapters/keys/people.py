"""People who may connect to a lab: the files people.json and passwords.txt of a keys folder.

zenoh keeps passwords as they are, so they are random ones.

Files that only their owner can read.
"""

from __future__ import annotations

import json
import os
import re
import secrets
import stat
from collections.abc import Mapping
from dataclasses import dataclass, field
from datetime import datetime
from pathlib import Path

from mrlab_ros.adapters.keys.diagnostics import (
    BAD_KEY_NAME,
    HAS_KEY,
    KEY_FILE_OPEN,
    KEY_FILE_UNREADABLE,
    KEYS_DAMAGED,
    NO_KEY_FILE,
    NO_KEYS,
)
from mrlab_ros.core.base.diagnostic import Fix
from mrlab_ros.core.base.errors import BadInput, Misuse
from mrlab_ros.core.base.foreign_text import for_shell
from mrlab_ros.core.bridge.access import Login, Person
from mrlab_ros.core.bridge.rules import Role


def write(path: Path, data: bytes) -> None:
    """Write a file that only its owner can read; a reader sees all of it or the one before."""
    new = path.with_name(f".{path.name}.new")
    new.unlink(missing_ok=True)
    with open(os.open(new, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o600), "wb") as file:
        file.write(data)
        file.flush()
        os.fsync(file.fileno())
    new.replace(path)


def changed_at(path: Path) -> int:
    """Return when a file was changed last, ns since 1970; 0 where it cannot be seen."""
    try:
        return path.stat().st_mtime_ns
    except OSError:
        return 0


def check(path: Path) -> None:
    """Raise BadInput where a file is missing, or others on this machine can read it."""
    try:
        mode = stat.S_IMODE(path.stat().st_mode)
    except FileNotFoundError as error:
        raise BadInput(
            NO_KEY_FILE(path=str(path), fixes=(Fix(command="mrlab keys init"),))
        ) from error
    except OSError as error:
        why = os.strerror(error.errno or 0)
        raise BadInput(KEY_FILE_UNREADABLE(path=str(path), why=why)) from error
    if mode & 0o077:
        raise BadInput(KEY_FILE_OPEN(path=str(path), mode=f"{mode:o}"))


NAME = re.compile(r"[A-Za-z0-9][A-Za-z0-9_.-]{0,40}")
# A user whose password nobody knows: zenoh demands passwords only where its file has a user.
NOBODY = "nobody"
# The lab's web gateway; it asks for people who have signed in there, and so may do what all of
# them together may do.
GATEWAY = "gateway"


@dataclass(frozen=True)
class Entry:
    """A person, and when the person's certificate expires (UTC)."""

    person: Person
    expires: datetime

    @classmethod
    def from_record(cls, record: Mapping[str, str]) -> Entry:
        """Return the entry that record() wrote; ValueError or KeyError where it is none."""
        person = Person(record["name"], Role(record["role"]), record["common_name"])
        return cls(person, datetime.fromisoformat(record["expires"]))

    def record(self) -> dict[str, str]:
        return {
            "name": self.person.name,
            "role": self.person.role.value,
            "common_name": self.person.common_name,
            "expires": self.expires.isoformat(timespec="seconds"),
        }


@dataclass
class People:
    """How people log in, at which hosts they reach the lab, and each person by name.

    gateway: the lab's web gateway, None where it has no key. labs: by name, of a campus's router.
    router: the options with which `mrlab keys router` made the router's file last.
    """

    login: Login
    hosts: list[str]
    by_name: dict[str, Entry] = field(default_factory=dict)
    gateway: Entry | None = None
    labs: dict[str, Entry] = field(default_factory=dict)
    router: list[str] = field(default_factory=list)

    @classmethod
    def read(cls, path: Path) -> People:
        """Read people.json; raise BadInput where it is missing, unreadable or damaged."""
        try:
            document = json.loads(path.read_text())
            return cls(
                Login(document["login"]),
                [str(host) for host in document["hosts"]],
                {record["name"]: Entry.from_record(record) for record in document["people"]},
                Entry.from_record(document["gateway"]) if document.get("gateway") else None,
                {each["name"]: Entry.from_record(each) for each in document.get("labs", [])},
                [str(option) for option in document.get("router", [])],
            )
        except FileNotFoundError as error:
            folder = str(path.parent)
            make = Fix(command=for_shell(["mrlab", "keys", "init", "--dir", folder]))
            raise BadInput(NO_KEYS(folder=folder, fixes=(make,))) from error
        except OSError as error:
            why = os.strerror(error.errno or 0)
            raise BadInput(KEY_FILE_UNREADABLE(path=str(path), why=why)) from error
        except (ValueError, KeyError, TypeError) as error:
            why, fixes = f"{type(error).__name__}: {error}", (Fix(command="mrlab keys init"),)
            raise BadInput(KEYS_DAMAGED(path=str(path), why=why, fixes=fixes)) from error

    def write(self, path: Path) -> None:
        """Write people.json, for its owner only."""
        document = {
            "login": self.login.value,
            "hosts": self.hosts,
            "people": [entry.record() for entry in self.entries],
            "gateway": self.gateway.record() if self.gateway else None,
            "labs": [entry.record() for entry in self.labs.values()],
            "router": self.router,
        }
        write(path, json.dumps(document, indent=2).encode())

    @property
    def entries(self) -> list[Entry]:
        """All entries, by name."""
        return sorted(self.by_name.values(), key=lambda entry: entry.person.name)

    def at(self, now: datetime) -> list[Person]:
        """Return who may connect, the gateway too: whose certificate has not expired.

        A password never expires.
        """
        entries = [*self.entries, *([self.gateway] if self.gateway else [])]
        return [entry.person for entry in entries if entry.expires > now]

    def check_new(self, name: str) -> None:
        """Raise BadInput where `name` cannot be one, Misuse where it has a key already."""
        if not NAME.fullmatch(name) or name in (NOBODY, GATEWAY):
            raise BadInput(BAD_KEY_NAME(name=name, reserved=[NOBODY, GATEWAY]))
        if name in self.by_name:
            role, revoke = self.by_name[name].person.role.value, f"mrlab keys revoke {name}"
            raise Misuse(HAS_KEY(name=name, role=role, fixes=(Fix(command=revoke),)))


def new_password() -> str:
    """Return a random password with 128 bits of entropy."""
    return secrets.token_urlsafe(16)


def read_passwords(path: Path) -> dict[str, str]:
    """Return name -> password; raise BadInput where the file cannot be read."""
    try:
        pairs = (line.partition(":") for line in path.read_text().splitlines() if line.strip())
        return {name: password for name, _, password in pairs}
    except OSError as error:
        why = os.strerror(error.errno or 0)
        raise BadInput(KEY_FILE_UNREADABLE(path=str(path), why=why)) from error


def write_passwords(path: Path, passwords: Mapping[str, str]) -> None:
    """Write name -> password as zenoh reads it, for the file's owner only."""
    lines = [f"{name}:{password}\n" for name, password in passwords.items()]
    write(path, "".join(lines).encode())
