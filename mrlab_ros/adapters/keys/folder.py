"""The keys folder: the lab's authority and certificate, and who may connect.

    ca.pem, ca.key          the authority, which signs everybody's certificate
    server.pem, server.key  the lab's certificate
    lab.pem, lab.key        with which the lab connects to a router of its own, where it has one
    router.json5            all that this router needs: to be handed over
    labs/NAME.json5         with which the router of the lab NAME connects to this one
    gateway.json5           all that the web gateway's zenoh needs to connect
    people.json             names, roles and certificates of who may connect
    passwords.txt           name:password, where people log in with passwords
    clients/NAME.json5      all that NAME's zenoh needs to connect: to be handed over

Files are for their owner only.
"""

from __future__ import annotations

import fcntl
import os
import secrets
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from datetime import datetime, timedelta, timezone
from pathlib import Path
from typing import Any

from mrlab_ros.adapters.keys import certificates, people, zenoh_settings
from mrlab_ros.adapters.keys.certificates import Signed
from mrlab_ros.adapters.keys.diagnostics import (
    BAD_KEY_NAME,
    CAMPUS_WITHOUT_LABS,
    FOLDER_NOT_EMPTY,
    HAS_NO_KEY,
    NEW_KEYS_NEEDED,
    RENEWAL_NEEDED,
    ROUTER_KEYS_NEEDED,
    ROUTER_TAKES_CERTIFICATES,
)
from mrlab_ros.adapters.keys.people import (
    GATEWAY,
    NOBODY,
    Entry,
    People,
    new_password,
    read_passwords,
    write_passwords,
)
from mrlab_ros.adapters.keys.zenoh_settings import LOCAL, SERVER, Hub
from mrlab_ros.core.base.diagnostic import Fix
from mrlab_ros.core.base.errors import BadInput, Misuse
from mrlab_ros.core.base.foreign_text import for_shell
from mrlab_ros.core.bridge.access import Login, Person, access_control, bounds
from mrlab_ros.core.bridge.rules import Role, Rules

AUTHORITY_LIFETIME = timedelta(days=5 * 365)
# Two school years; Apple's systems accept no certificate of a server for more than 825 days.
SERVER_LIFETIME = timedelta(days=2 * 365)
CLIENT_LIFETIME = timedelta(days=365)


class Keys:
    """A keys folder that exists; `create` makes one."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder.expanduser().resolve()
        self._people = People.read(self._people_file)

    @property
    def login(self) -> Login:
        """How people log in."""
        return self._people.login

    @property
    def hosts(self) -> list[str]:
        """The names and addresses that the lab's certificate is for."""
        return self._people.hosts

    @classmethod
    def create(cls, folder: Path, hosts: list[str], login: Login, now: datetime) -> Keys:
        """Make a folder with an authority and the lab's certificate; Misuse where one exists."""
        folder = folder.expanduser().resolve()
        if folder.exists() and (not folder.is_dir() or any(folder.iterdir())):
            fixes = (Fix(command="mrlab keys init --dir FOLDER"),)
            raise Misuse(FOLDER_NOT_EMPTY(folder=str(folder), fixes=fixes))
        mark = secrets.token_hex(3)
        authority = certificates.authority(f"MR-Lab authority {mark}", now, AUTHORITY_LIFETIME)
        all_hosts = list(dict.fromkeys([*hosts, *LOCAL]))
        server = certificates.server(authority, SERVER, all_hosts, now, SERVER_LIFETIME)
        folder.mkdir(mode=0o700, parents=True, exist_ok=True)
        folder.chmod(0o700)
        (folder / "clients").mkdir(mode=0o700)
        people.write(folder / ".gitignore", b"*\n")
        for name, signed in (("ca", authority), ("server", server)):
            people.write(folder / f"{name}.pem", signed.certificate_pem)
            people.write(folder / f"{name}.key", signed.key_pem)
        write_passwords(folder / "passwords.txt", {NOBODY: new_password()})
        People(login, all_hosts).write(folder / "people.json")
        keys = cls(folder)
        keys.gateway(now)
        return keys

    @property
    def entries(self) -> list[Entry]:
        """Return the people who may connect, by name."""
        return self._people.entries

    def people(self, now: datetime) -> list[Person]:
        """Return who may connect at `now`, the gateway too."""
        return self._people.at(now)

    @property
    def fingerprint(self) -> str:
        """The SHA-256 fingerprint of the authority, in two lines."""
        return certificates.fingerprint(certificates.read_certificate(self.folder / "ca.pem"))

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
        self._people.check_new(name)

    def _add(self, name: str, role: Role, now: datetime, lifetime: timedelta) -> Entry:
        self.client_file(name).parent.mkdir(mode=0o700, exist_ok=True)
        entry = self._sign(name, role, now, lifetime, self.client_file(name))
        self._people.by_name[name] = entry
        self._people.write(self._people_file)
        return entry

    def _sign(
        self, name: str, role: Role, now: datetime, lifetime: timedelta, file: Path
    ) -> Entry:
        """Make a key, and write the file with which its owner's zenoh connects."""
        authority = self._authority(now)
        # With a random mark: a new person of the same name does not revive the old certificate.
        person = Person(name, role, f"{name}.{secrets.token_hex(4)}")
        signed = certificates.client(authority, person.common_name, now, lifetime)
        entry = Entry(person, certificates.validity(signed.certificate)[1])
        password = new_password() if self.login.by_password else ""
        document = zenoh_settings.client_document(
            self.folder, self._people, entry, signed, password
        )
        people.write(file, document.encode())
        if password:
            write_passwords(self._passwords, {**read_passwords(self._passwords), name: password})
        return entry

    @property
    def gateway_file(self) -> Path:
        """The file that lets the web gateway connect."""
        return self.folder / "gateway.json5"

    def gateway(self, now: datetime) -> Path:
        """Make the web gateway's key anew; return the file that lets it connect.

        It has the largest role, which includes all others: it asks for people of every role, and
        allows each what that person's role allows.
        """
        with self._alone():
            largest = list(Role)[-1]
            self._people.gateway = self._sign(
                GATEWAY, largest, now, SERVER_LIFETIME, self.gateway_file
            )
            self._people.write(self._people_file)
        return self.gateway_file

    def has_gateway(self, now: datetime) -> bool:
        """Return whether the web gateway has a key that is valid."""
        entry = self._people.gateway
        return entry is not None and entry.expires > now and self.gateway_file.exists()

    def revoke(self, name: str) -> Entry:
        """Take back what lets `name` connect; it counts once the bridge is started again."""
        with self._alone():
            self.check_known(name)
            entry = self._people.by_name.pop(name)
            self._people.write(self._people_file)
            passwords = read_passwords(self._passwords)
            if passwords.pop(name, None) is not None:
                write_passwords(self._passwords, passwords)
            self.client_file(name).unlink(missing_ok=True)
        return entry

    def check_known(self, name: str) -> None:
        """Raise BadInput where `name` has no key."""
        if name not in self._people.by_name:
            known = sorted(self._people.by_name)
            raise BadInput(HAS_NO_KEY(name=name, folder=str(self.folder), known=known))

    def renew(self, hosts: list[str], now: datetime) -> datetime:
        """Make a new certificate of the lab, for `hosts` too; return when it expires."""
        with self._alone():
            all_hosts = list(dict.fromkeys([*hosts, *self.hosts]))
            authority = self._authority(now)
            server = certificates.server(authority, SERVER, all_hosts, now, SERVER_LIFETIME)
            people.write(self.folder / "server.pem", server.certificate_pem)
            people.write(self.folder / "server.key", server.key_pem)
            self._people.hosts = all_hosts
            self._people.write(self._people_file)
        return certificates.validity(server.certificate)[1]

    def server_expires(self, *, router: bool = False) -> datetime:
        """Return when the lab's certificate expires, UTC; router: or that for its router."""
        names = ("server.pem", "lab.pem") if router else ("server.pem",)
        found = (certificates.read_certificate(self.folder / name) for name in names)
        return min(certificates.validity(each)[1] for each in found)

    def check(self, now: datetime) -> None:
        """Raise BadInput where a lab cannot be run with this folder, and say what to do."""
        authority = certificates.read_certificate(self.folder / "ca.pem")
        try:
            certificates.check(authority, authority, now, self.folder / "ca.pem")
        except BadInput as error:
            make = Fix(command="mrlab keys init --dir FOLDER")
            raise BadInput(NEW_KEYS_NEEDED(why=error, fixes=(make,))) from error
        try:
            path = self.folder / "server.pem"
            server = certificates.read(path, self.folder / "server.key")
            certificates.check(server.certificate, authority, now, path)
        except BadInput as error:
            raise BadInput(RENEWAL_NEEDED(why=error, fixes=(self._fix("renew"),))) from error
        for secret in ("server.key", "passwords.txt"):
            people.check(self.folder / secret)

    def changed_at(self) -> tuple[int, ...]:
        """Return when what a lab reads was changed last, ns of each file; 0: it is gone."""
        files = ("people.json", "passwords.txt", "server.pem", "server.key", "ca.pem")
        return tuple(people.changed_at(self.folder / name) for name in files)

    def settings(
        self, rules: Rules, prefix: str, now: datetime, *, local: bool = False
    ) -> dict[str, Any]:
        """Return zenoh's settings, path -> value, of a lab that lets these people in.

        local: and this machine's user, without keys, through a Unix socket.
        """
        return zenoh_settings.listening_settings(
            self.folder, self._people, rules, prefix, now, local=local
        )

    def router(
        self,
        rules: Rules,
        prefix: str,
        limits: Mapping[str, object],
        now: datetime,
        *,
        labs: Sequence[str] = (),
        hub: Hub | None = None,
        options: Sequence[str] = (),
    ) -> Path:
        """Write what a router between the lab and its people needs; return the file.

        It listens with the lab's certificate and knows who may do what. limits: further settings,
        path -> value. labs: of the labs whose routers connect to this one; each has keys below the
        prefix and its name, and gets the file `lab_file`, which stays as it is where there is one.
        hub: such a router that this one connects to. options: of the command that says all this,
        for `command`. Raises Misuse where people log in with
        passwords, which zenoh reads from a file of its own.
        """
        if self.login.by_password:
            fixes = (Fix(command="mrlab keys init --login certificate"),)
            folder, login = str(self.folder), self.login.value
            raise Misuse(ROUTER_TAKES_CERTIFICATES(folder=folder, login=login, fixes=fixes))
        with self._alone():
            self.check(now)
            if self._people.labs and not labs:
                known = list(self._people.labs)
                fixes = (self._fix("router"),)
                raise Misuse(CAMPUS_WITHOUT_LABS(folder=str(self.folder), labs=known, fixes=fixes))
            self._people.router = list(options)
            if labs:
                return self._campus(rules, prefix, limits, labs, now)
            lab = f"lab.{secrets.token_hex(4)}"
            if (self.folder / "lab.pem").exists():
                # A lab that runs is known by this name.
                lab = certificates.common_name(
                    certificates.read_certificate(self.folder / "lab.pem")
                )
            made = certificates.client(self._authority(now), lab, now, SERVER_LIFETIME)
            people.write(self.folder / "lab.pem", made.certificate_pem)
            people.write(self.folder / "lab.key", made.key_pem)
            people_here = [*self._people.at(now), *([hub.person] if hub else [])]
            self._people.write(self._people_file)
            self._write_router(rules, prefix, people_here, {lab: prefix}, limits, hub)
        return self.router_file

    @property
    def router_file(self) -> Path:
        """All that a router needs, for this lab or, of a campus, for all labs."""
        return self.folder / "router.json5"

    def lab_file(self, name: str) -> Path:
        """The file with which the router of a lab connects to this one."""
        return self.folder / "labs" / f"{name}.json5"

    def _campus(
        self,
        rules: Rules,
        prefix: str,
        limits: Mapping[str, object],
        labs: Sequence[str],
        now: datetime,
    ) -> Path:
        for name in labs:
            if not people.NAME.fullmatch(name):
                raise BadInput(BAD_KEY_NAME(name=name, reserved=[NOBODY, GATEWAY]))
        known, self._people.labs = self._people.labs, {}
        (self.folder / "labs").mkdir(mode=0o700, exist_ok=True)
        for name in dict.fromkeys(labs):
            entry = known.get(name)
            if entry is None or entry.expires <= now or not self.lab_file(name).exists():
                entry = self._sign(name, list(Role)[-1], now, SERVER_LIFETIME, self.lab_file(name))
            self._people.labs[name] = entry
        self._people.write(self._people_file)
        below = f"{prefix}/" if prefix else ""
        found = {e.person.common_name: below + name for name, e in self._people.labs.items()}
        self._write_router(rules, f"{below}*", self._people.at(now), found, limits, None)
        return self.router_file

    def _write_router(
        self,
        rules: Rules,
        prefix: str,
        persons: list[Person],
        labs: Mapping[str, str],
        limits: Mapping[str, object],
        hub: Hub | None,
    ) -> None:
        access = access_control(rules, persons, self.login, prefix, labs)
        document = zenoh_settings.router_document(
            self.folder, {"access_control": access, **bounds(rules, prefix), **limits}, hub
        )
        people.write(self.router_file, document.encode())

    def lab_settings(self, now: datetime) -> dict[str, Any]:
        """Return zenoh's settings, path -> value, of a lab that connects to its router."""
        ours = {name: self.folder / name for name in ("ca.pem", "lab.pem", "lab.key")}
        try:
            found = certificates.read(ours["lab.pem"], ours["lab.key"]).certificate
            authority = certificates.read_certificate(ours["ca.pem"])
            certificates.check(found, authority, now, ours["lab.pem"])
        except BadInput as error:
            fixes = (self._fix("router"),)
            raise BadInput(ROUTER_KEYS_NEEDED(why=error, fixes=fixes)) from error
        people.check(ours["lab.key"])
        return zenoh_settings.connecting_settings(self.folder)

    @property
    def _people_file(self) -> Path:
        return self.folder / "people.json"

    @property
    def _passwords(self) -> Path:
        return self.folder / "passwords.txt"

    def _authority(self, now: datetime) -> Signed:
        found = certificates.read(self.folder / "ca.pem", self.folder / "ca.key")
        path = self.folder / "ca.pem"
        certificates.check(found.certificate, found.certificate, now, path)
        return found

    def command(self, name: str) -> str:
        """Return the line of `mrlab keys NAME` for this folder; router: as its file was made."""
        more = self._people.router if name == "router" else []
        return for_shell(["mrlab", "keys", name, "--dir", str(self.folder), *more])

    def _fix(self, name: str) -> Fix:
        return Fix(command=self.command(name))

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
            self._people = People.read(self._people_file)
            yield
        finally:
            os.close(handle)


def now() -> datetime:
    """Return the time of this machine's clock, in UTC."""
    return datetime.now(timezone.utc)
