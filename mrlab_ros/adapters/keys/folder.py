"""The keys folder: the lab's authority and certificate, and who may connect.

    ca.pem, ca.key          the authority, which signs everybody's certificate
    server.pem, server.key  the lab's certificate
    lab.pem, lab.key        with which the lab connects to a router of its own, where it has one
    router.json5            all that this router needs: to be handed over
    people.json             names, roles and certificates of who may connect
    passwords.txt           name:password, where people log in with passwords
    clients/NAME.json5      all that NAME's zenoh needs to connect: to be handed over

Files are for their owner only. zenoh keeps passwords as they are, so they are random ones.
"""

from __future__ import annotations

import base64
import fcntl
import json
import os
import re
import secrets
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from datetime import datetime, timedelta, timezone
from pathlib import Path
from typing import Any

from mrlab_ros.adapters.keys import certificates, private_files
from mrlab_ros.adapters.keys.certificates import Signed
from mrlab_ros.core.bridge.access import Login, Person, access_control
from mrlab_ros.core.bridge.links import LEASE_BEYOND, healing, nested
from mrlab_ros.core.bridge.rules import Role, Rules
from mrlab_ros.core.errors import BadInput, Misuse

PORT = 7447
EVERYWHERE = (f"tls/0.0.0.0:{PORT}",)
LOCAL = ("localhost", "127.0.0.1")
AUTHORITY_LIFETIME = timedelta(days=5 * 365)
# Two school years; Apple's systems accept no certificate of a server for more than 825 days.
SERVER_LIFETIME = timedelta(days=2 * 365)
CLIENT_LIFETIME = timedelta(days=365)
NAME = re.compile(r"[A-Za-z0-9][A-Za-z0-9_.-]{0,40}")
# A user whose password nobody knows: zenoh demands passwords only where its file has a user.
NOBODY = "nobody"


@dataclass(frozen=True)
class Entry:
    """A person, and when the person's certificate expires (UTC)."""

    person: Person
    expires: datetime

    def record(self) -> dict[str, str]:
        return {
            "name": self.person.name,
            "role": self.person.role.value,
            "common_name": self.person.common_name,
            "expires": self.expires.isoformat(timespec="seconds"),
        }


class Keys:
    """A keys folder that exists; `create` makes one."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder.expanduser().resolve()
        self._read()

    def _read(self) -> None:
        path = self._people_file
        try:
            document = json.loads(path.read_text())
            self.login = Login(document["login"])
            self.hosts: list[str] = [str(host) for host in document["hosts"]]
            self._entries = {record["name"]: _entry(record) for record in document["people"]}
        except FileNotFoundError as error:
            raise BadInput(
                f"{self.folder} has no keys; make them with: mrlab keys init --dir {self.folder}"
            ) from error
        except OSError as error:
            raise BadInput(f"{path} cannot be read: {os.strerror(error.errno or 0)}") from error
        except (ValueError, KeyError, TypeError) as error:
            raise BadInput(
                f"{path} is damaged ({type(error).__name__}: {error}); put back a copy, or make "
                "new keys with mrlab keys init"
            ) from error

    @classmethod
    def create(cls, folder: Path, hosts: list[str], login: Login, now: datetime) -> Keys:
        """Make a folder with an authority and the lab's certificate; Misuse where one exists."""
        folder = folder.expanduser().resolve()
        if folder.exists() and (not folder.is_dir() or any(folder.iterdir())):
            raise Misuse(
                f"{folder} exists and is not empty; nothing was changed. Name another folder with "
                "--dir, or remove this one: whoever has keys from it then needs new ones"
            )
        mark = secrets.token_hex(3)
        authority = certificates.authority(f"MR-Lab authority {mark}", now, AUTHORITY_LIFETIME)
        all_hosts = list(dict.fromkeys([*hosts, *LOCAL]))
        server = certificates.server(authority, "MR-Lab", all_hosts, now, SERVER_LIFETIME)
        folder.mkdir(mode=0o700, parents=True, exist_ok=True)
        folder.chmod(0o700)
        (folder / "clients").mkdir(mode=0o700)
        private_files.write(folder / ".gitignore", b"*\n")
        for name, signed in (("ca", authority), ("server", server)):
            private_files.write(folder / f"{name}.pem", signed.certificate_pem)
            private_files.write(folder / f"{name}.key", signed.key_pem)
        private_files.write(folder / "passwords.txt", f"{NOBODY}:{_password()}\n".encode())
        document = {"login": login.value, "hosts": all_hosts, "people": []}
        private_files.write(folder / "people.json", json.dumps(document, indent=2).encode())
        return cls(folder)

    @property
    def entries(self) -> list[Entry]:
        """Who may connect, by name."""
        return sorted(self._entries.values(), key=lambda entry: entry.person.name)

    def client_file(self, name: str) -> Path:
        """Return the file that lets `name` connect."""
        return self.folder / "clients" / f"{name}.json5"

    def add(
        self, name: str, role: Role, now: datetime, lifetime: timedelta = CLIENT_LIFETIME
    ) -> Entry:
        """Let `name` connect, and write the file to hand over."""
        with self._alone():
            self.check_new(name)
            return self._add(name, role, now, lifetime)

    def check_new(self, name: str) -> None:
        """Raise BadInput where `name` cannot be one, Misuse where it has a key already."""
        if not NAME.fullmatch(name) or name == NOBODY:
            raise BadInput(
                f"{name!r} is no name for a key; expected up to 41 letters, digits, '_', '-' and "
                f"'.', beginning with a letter or digit, and not {NOBODY!r}"
            )
        if name in self._entries:
            raise Misuse(
                f"{name} has a key already, as {self._entries[name].person.role.value}; take it "
                f"back first with: mrlab keys revoke {name}"
            )

    def _add(self, name: str, role: Role, now: datetime, lifetime: timedelta) -> Entry:
        authority = self._authority(now)
        # With a random mark: a new person of the same name does not revive the old certificate.
        person = Person(name, role, f"{name}.{secrets.token_hex(4)}")
        signed = certificates.client(authority, person.common_name, now, lifetime)
        entry = Entry(person, certificates.validity(signed.certificate)[1])
        password = _password() if self.login.by_password else ""
        self.client_file(name).parent.mkdir(mode=0o700, exist_ok=True)
        private_files.write(
            self.client_file(name), self._client_document(entry, signed, password).encode()
        )
        if password:
            self._set_passwords({**self._passwords(), name: password})
        self._entries[name] = entry
        self._save()
        return entry

    def revoke(self, name: str) -> Entry:
        """Take back what lets `name` connect; it counts once the bridge is started again."""
        with self._alone():
            self.check_known(name)
            entry = self._entries.pop(name)
            self._save()
            passwords = self._passwords()
            if passwords.pop(name, None) is not None:
                self._set_passwords(passwords)
            self.client_file(name).unlink(missing_ok=True)
        return entry

    def check_known(self, name: str) -> None:
        """Raise BadInput where `name` has no key."""
        if name not in self._entries:
            known = ", ".join(sorted(self._entries)) or "nobody yet"
            raise BadInput(f"{name} has no key in {self.folder}; who has one: {known}")

    def renew(self, hosts: list[str], now: datetime) -> datetime:
        """Make a new certificate of the lab, for `hosts` too; return when it expires."""
        with self._alone():
            all_hosts = list(dict.fromkeys([*hosts, *self.hosts]))
            authority = self._authority(now)
            server = certificates.server(authority, "MR-Lab", all_hosts, now, SERVER_LIFETIME)
            private_files.write(self.folder / "server.pem", server.certificate_pem)
            private_files.write(self.folder / "server.key", server.key_pem)
            self.hosts = all_hosts
            self._save()
        return certificates.validity(server.certificate)[1]

    def server_expires(self, *, router: bool = False) -> datetime:
        """Return when the lab's certificate expires, UTC; router: or that for its router."""
        names = ("server.pem", "lab.pem") if router else ("server.pem",)
        found = (certificates.read_certificate(self.folder / name) for name in names)
        return min(certificates.validity(each)[1] for each in found)

    def check(self, now: datetime) -> None:
        """Raise BadInput where a lab cannot be run with this folder, and say what to do."""
        again = f"; make a new one with: mrlab keys renew --dir {self.folder}"
        anew = "; make new keys in another folder with mrlab keys init, and hand them out again"
        authority = certificates.read_certificate(self.folder / "ca.pem")
        name = f"the authority {self.folder / 'ca.pem'}"
        try:
            certificates.check(authority, authority, now, name)
        except BadInput as error:
            raise BadInput(f"{error}{anew}") from error
        try:
            path = self.folder / "server.pem"
            server = certificates.read(path, self.folder / "server.key")
            certificates.check(server.certificate, authority, now, f"the certificate {path}")
        except BadInput as error:
            raise BadInput(f"{error}{again}") from error
        for secret in ("server.key", "passwords.txt"):
            private_files.check(self.folder / secret)

    def changed_at(self) -> tuple[int, ...]:
        """Return when what a lab reads was changed last, ns of each file; 0: it is gone."""
        files = ("people.json", "passwords.txt", "server.pem", "server.key", "ca.pem")
        return tuple(private_files.changed_at(self.folder / name) for name in files)

    def settings(self, rules: Rules, prefix: str, now: datetime) -> dict[str, Any]:
        """Return zenoh's settings, path -> value, of a lab that lets these people in."""
        tls = {
            "root_ca_certificate": str(self.folder / "ca.pem"),
            "listen_certificate": str(self.folder / "server.pem"),
            "listen_private_key": str(self.folder / "server.key"),
            "enable_mtls": self.login.by_certificate,
            # Without clients' certificates there is nothing to expire.
            "close_link_on_expiration": self.login.by_certificate,
        }
        found: dict[str, Any] = {f"transport/link/tls/{name}": v for name, v in tls.items()}
        if self.login.by_password:
            file = self.folder / "passwords.txt"
            found["transport/auth/usrpwd/dictionary_file"] = str(file)
        # A password does not expire by itself.
        people = [entry.person for entry in self.entries if entry.expires > now]
        found["access_control"] = access_control(rules, people, self.login, prefix)
        return found

    def router(
        self, rules: Rules, prefix: str, limits: Mapping[str, object], now: datetime
    ) -> Path:
        """Write what a router between the lab and its people needs; return the file.

        It listens with the lab's certificate and knows who may do what. limits: further settings,
        path -> value. Raises Misuse where people log in with passwords, which zenoh reads from a
        file of its own.
        """
        if self.login.by_password:
            raise Misuse(
                f"the people of {self.folder} log in by {self.login.value}, and a router takes "
                "certificates only; make a folder with: mrlab keys init --login certificate"
            )
        with self._alone():
            self.check(now)
            lab = f"lab.{secrets.token_hex(4)}"
            if (self.folder / "lab.pem").exists():
                # A lab that runs is known by this name.
                lab = certificates.common_name(
                    certificates.read_certificate(self.folder / "lab.pem")
                )
            made = certificates.client(self._authority(now), lab, now, SERVER_LIFETIME)
            private_files.write(self.folder / "lab.pem", made.certificate_pem)
            private_files.write(self.folder / "lab.key", made.key_pem)
            tls = {
                "root_ca_certificate_base64": "ca.pem",
                "listen_certificate_base64": "server.pem",
                "listen_private_key_base64": "server.key",
            }
            people = [entry.person for entry in self.entries if entry.expires > now]
            settings: dict[str, Any] = {
                "mode": "router",
                "listen/endpoints": list(EVERYWHERE),
                "transport/link/tls": {
                    **{k: _base64((self.folder / v).read_bytes()) for k, v in tls.items()},
                    "enable_mtls": True,
                    "close_link_on_expiration": True,
                },
                "access_control": access_control(rules, people, self.login, prefix, lab),
            }
            document = nested({**settings, **limits, **healing(LEASE_BEYOND)})
            private_files.write(
                self.folder / "router.json5", json.dumps(document, indent=2).encode()
            )
        return self.folder / "router.json5"

    def lab_settings(self, now: datetime) -> dict[str, Any]:
        """Return zenoh's settings, path -> value, of a lab that connects to its router."""
        ours = {name: self.folder / name for name in ("ca.pem", "lab.pem", "lab.key")}
        try:
            found = certificates.read(ours["lab.pem"], ours["lab.key"]).certificate
            authority = certificates.read_certificate(ours["ca.pem"])
            certificates.check(found, authority, now, f"the certificate {ours['lab.pem']}")
        except BadInput as error:
            raise BadInput(
                f"{error}; make it, and the router's file, with: mrlab keys router --dir "
                f"{self.folder}"
            ) from error
        private_files.check(ours["lab.key"])
        tls = {
            "root_ca_certificate": str(ours["ca.pem"]),
            "connect_certificate": str(ours["lab.pem"]),
            "connect_private_key": str(ours["lab.key"]),
            "enable_mtls": True,
            "verify_name_on_connect": True,
        }
        return {f"transport/link/tls/{name}": value for name, value in tls.items()}

    @property
    def _people_file(self) -> Path:
        return self.folder / "people.json"

    def _authority(self, now: datetime) -> Signed:
        found = certificates.read(self.folder / "ca.pem", self.folder / "ca.key")
        certificates.check(found.certificate, found.certificate, now, "the authority")
        return found

    @classmethod
    @contextmanager
    def while_unchanged(cls, folder: Path) -> Iterator[Keys | None]:
        """Open a keys folder and keep commands from changing it; None: one changes it now.

        A command writes several files, one after the other: without the lock a reader could see
        a new certificate beside an old key.
        """
        try:
            handle = os.open(folder.expanduser().resolve(), os.O_RDONLY)
        except OSError:
            yield cls(folder)  # raises BadInput, which says what is wrong with the folder
            return
        try:
            try:
                fcntl.flock(handle, fcntl.LOCK_SH | fcntl.LOCK_NB)
            except BlockingIOError:
                yield None
            else:
                yield cls(folder)
        finally:
            os.close(handle)

    @contextmanager
    def _alone(self) -> Iterator[None]:
        """Lock the folder against other commands, and read what earlier ones changed."""
        handle = os.open(self.folder, os.O_RDONLY)
        try:
            fcntl.flock(handle, fcntl.LOCK_EX)
            self._read()
            yield
        finally:
            os.close(handle)

    def _save(self) -> None:
        document = {
            "login": self.login.value,
            "hosts": self.hosts,
            "people": [entry.record() for entry in self.entries],
        }
        private_files.write(self._people_file, json.dumps(document, indent=2).encode())

    def _passwords(self) -> dict[str, str]:
        path = self.folder / "passwords.txt"
        try:
            pairs = (line.partition(":") for line in path.read_text().splitlines() if line.strip())
            return {name: password for name, _, password in pairs}
        except OSError as error:
            raise BadInput(f"{path} cannot be read: {os.strerror(error.errno or 0)}") from error

    def _set_passwords(self, passwords: dict[str, str]) -> None:
        lines = [f"{name}:{password}\n" for name, password in passwords.items()]
        private_files.write(self.folder / "passwords.txt", "".join(lines).encode())

    def _client_document(self, entry: Entry, signed: Signed, password: str) -> str:
        """Return a zenoh configuration that needs no other file."""
        tls: dict[str, Any] = {
            "root_ca_certificate_base64": _base64((self.folder / "ca.pem").read_bytes()),
            "verify_name_on_connect": True,
        }
        if self.login.by_certificate:
            tls["enable_mtls"] = True
            tls["connect_certificate_base64"] = _base64(signed.certificate_pem)
            tls["connect_private_key_base64"] = _base64(signed.key_pem)
        settings: dict[str, Any] = {
            "mode": "client",
            "connect/endpoints": [_endpoint(host) for host in self._reached()],
            "scouting/multicast/enabled": False,
            "transport/link/tls": tls,
        }
        if password:
            login = {"user": entry.person.name, "password": password}
            settings["transport/auth/usrpwd"] = login
        document = nested(settings | healing(LEASE_BEYOND))
        return (
            f"// {entry.person.name} ({entry.person.role.value}), until "
            f"{entry.expires:%d %B %Y}. Whoever has this file is {entry.person.name}.\n"
            f"{json.dumps(document, indent=2)}\n"
        )

    def _reached(self) -> list[str]:
        """Return the hosts at which clients try to reach the lab, in order; localhost last."""
        return [*(host for host in self.hosts if host not in LOCAL), LOCAL[0]]


def now() -> datetime:
    """Return the time of this machine's clock, in UTC."""
    return datetime.now(timezone.utc)


def _entry(record: dict[str, str]) -> Entry:
    person = Person(record["name"], Role(record["role"]), record["common_name"])
    return Entry(person, datetime.fromisoformat(record["expires"]))


def _endpoint(host: str) -> str:
    return f"tls/[{host}]:{PORT}" if ":" in host else f"tls/{host}:{PORT}"


def _password() -> str:
    return secrets.token_urlsafe(16)


def _base64(data: bytes) -> str:
    return base64.b64encode(data).decode()
