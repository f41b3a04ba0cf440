"""zenoh's configuration for a keys folder: lab, router and clients.

Settings are path -> value, as zenoh's Config takes them; documents are whole JSON5 files.
"""

from __future__ import annotations

import base64
import json
from collections.abc import Mapping
from dataclasses import dataclass
from datetime import datetime
from pathlib import Path
from typing import Any

from mrlab_ros.adapters.keys.certificates import Signed
from mrlab_ros.adapters.keys.diagnostics import NO_HUB_FILE
from mrlab_ros.adapters.keys.people import Entry, People
from mrlab_ros.core.base.diagnostic import of_text
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.bridge.access import LINKS, Person, access_control
from mrlab_ros.core.bridge.links import (
    EVERYWHERE,
    LEASE_BEYOND,
    LOCAL_PROTOCOL,
    PORT,
    healing,
    is_local,
    nested,
)
from mrlab_ros.core.bridge.rules import Role, Rules

LOCAL = ("localhost", "127.0.0.1")
# The name in the certificate of every lab's server.
SERVER = "MR-Lab"
# Whom the router of a campus is for that of a lab; a person's name cannot contain a space.
HUB = "the campus"


def listening_settings(
    folder: Path, people: People, rules: Rules, prefix: str, now: datetime, *, local: bool = False
) -> dict[str, Any]:
    """Return the settings of a lab that lets these people in.

    local: and whoever connects through the lab's Unix socket. Where people log in with passwords
    zenoh asks for one there, too.
    """
    tls = {
        "root_ca_certificate": str(folder / "ca.pem"),
        "listen_certificate": str(folder / "server.pem"),
        "listen_private_key": str(folder / "server.key"),
        "enable_mtls": people.login.by_certificate,
        # Without clients' certificates there is nothing to expire.
        "close_link_on_expiration": people.login.by_certificate,
    }
    found: dict[str, Any] = {f"transport/link/tls/{name}": v for name, v in tls.items()}
    if people.login.by_password:
        file = folder / "passwords.txt"
        found["transport/auth/usrpwd/dictionary_file"] = str(file)
    found["access_control"] = access_control(
        rules, people.at(now), people.login, prefix, local=local
    )
    if local:
        found["transport/link/protocols"] = [*LINKS, LOCAL_PROTOCOL]
    return found


def connecting_settings(folder: Path) -> dict[str, Any]:
    """Return the settings of a lab that connects to its router."""
    tls = {
        "root_ca_certificate": str(folder / "ca.pem"),
        "connect_certificate": str(folder / "lab.pem"),
        "connect_private_key": str(folder / "lab.key"),
        "enable_mtls": True,
        "verify_name_on_connect": True,
    }
    return {f"transport/link/tls/{name}": value for name, value in tls.items()}


@dataclass(frozen=True)
class Hub:
    """A campus's router that a lab's router connects to, from the file that the campus made.

    endpoints: where it is. authority: its certificate, PEM. certificate, key: with which the lab's
    router connects, base64 of PEM. role: what people there may do in this lab.
    """

    endpoints: list[str]
    authority: bytes
    certificate: str
    key: str
    role: Role

    @classmethod
    def read(cls, file: Path, role: Role) -> Hub:
        """Read labs/NAME.json5 of a campus's keys folder; raise BadInput for another file."""
        try:
            text = file.read_text()
            said = json.loads("\n".join(x for x in text.splitlines() if not x.startswith("//")))
            if said["mode"] != "client":
                raise ValueError(f"its mode is {said['mode']}")
            tls = said["transport"]["link"]["tls"]
            endpoints = [str(each) for each in said["connect"]["endpoints"]]
            return cls(
                # Not those of the campus's own machine, where there are others.
                [e for e in endpoints if not is_local(e)] or endpoints,
                base64.b64decode(tls["root_ca_certificate_base64"], validate=True),
                str(tls["connect_certificate_base64"]),
                str(tls["connect_private_key_base64"]),
                role,
            )
        except (OSError, ValueError, KeyError, TypeError) as error:
            reason = getattr(error, "strerror", None) or f"{type(error).__name__}: {error}"
            why = of_text(reason)
            raise BadInput(NO_HUB_FILE(path=str(file), why=why)) from error

    @property
    def person(self) -> Person:
        """Whom a lab's router takes it for, by the name that every server's certificate has."""
        return Person(HUB, self.role, SERVER)


def router_document(folder: Path, further: Mapping[str, object], hub: Hub | None) -> str:
    """Return the configuration of a router, which needs no other file.

    further: settings, path -> value, such as who may do what. hub: another router it connects to.
    """
    authority = (folder / "ca.pem").read_bytes()
    tls = {
        "listen_certificate_base64": _base64((folder / "server.pem").read_bytes()),
        "listen_private_key_base64": _base64((folder / "server.key").read_bytes()),
        "enable_mtls": True,
        "close_link_on_expiration": True,
    }
    settings: dict[str, Any] = {"mode": "router", "listen/endpoints": list(EVERYWHERE)}
    if hub is not None:
        authority += hub.authority
        tls["connect_certificate_base64"] = hub.certificate
        tls["connect_private_key_base64"] = hub.key
        tls["verify_name_on_connect"] = True
        settings["connect/endpoints"] = hub.endpoints
    tls["root_ca_certificate_base64"] = _base64(authority)
    settings["transport/link/tls"] = tls
    # Where the other router is not there yet, it is tried for ever.
    settings["connect/exit_on_failure"] = False
    return json.dumps(nested({**settings, **further, **healing(LEASE_BEYOND)}), indent=2)


def client_document(
    folder: Path, people: People, entry: Entry, signed: Signed, password: str
) -> str:
    """Return a person's configuration, which needs no other file; password: empty for none."""
    tls: dict[str, Any] = {
        "root_ca_certificate_base64": _base64((folder / "ca.pem").read_bytes()),
        "verify_name_on_connect": True,
    }
    if people.login.by_certificate:
        tls["enable_mtls"] = True
        tls["connect_certificate_base64"] = _base64(signed.certificate_pem)
        tls["connect_private_key_base64"] = _base64(signed.key_pem)
    # In the order in which clients try them.
    hosts = [*(host for host in people.hosts if host not in LOCAL), LOCAL[0]]
    settings: dict[str, Any] = {
        "mode": "client",
        "connect/endpoints": [_endpoint(host) for host in hosts],
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


def _endpoint(host: str) -> str:
    return f"tls/[{host}]:{PORT}" if ":" in host else f"tls/{host}:{PORT}"


def _base64(data: bytes) -> str:
    return base64.b64encode(data).decode()
