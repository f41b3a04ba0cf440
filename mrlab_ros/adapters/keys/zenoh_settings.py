"""zenoh's configuration for a keys folder: lab, router and clients.

Settings are path -> value, as zenoh's Config takes them; documents are whole JSON5 files.
"""

from __future__ import annotations

import base64
import json
from collections.abc import Mapping
from datetime import datetime
from pathlib import Path
from typing import Any

from mrlab_ros.adapters.keys.certificates import Signed
from mrlab_ros.adapters.keys.people import Entry, People
from mrlab_ros.core.bridge.access import LINKS, access_control, bounds
from mrlab_ros.core.bridge.links import (
    EVERYWHERE,
    LEASE_BEYOND,
    LOCAL_PROTOCOL,
    PORT,
    healing,
    nested,
)
from mrlab_ros.core.bridge.rules import Rules

LOCAL = ("localhost", "127.0.0.1")


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


def router_document(
    folder: Path,
    people: People,
    rules: Rules,
    prefix: str,
    limits: Mapping[str, object],
    lab: str,
    now: datetime,
) -> str:
    """Return the configuration of a router between the lab, of common name `lab`, and people.

    limits: further settings. It needs no other file.
    """
    tls = {
        "root_ca_certificate_base64": "ca.pem",
        "listen_certificate_base64": "server.pem",
        "listen_private_key_base64": "server.key",
    }
    settings: dict[str, Any] = {
        "mode": "router",
        "listen/endpoints": list(EVERYWHERE),
        "transport/link/tls": {
            **{k: _base64((folder / v).read_bytes()) for k, v in tls.items()},
            "enable_mtls": True,
            "close_link_on_expiration": True,
        },
        "access_control": access_control(rules, people.at(now), people.login, prefix, lab),
        **bounds(rules, prefix),
    }
    return json.dumps(nested({**settings, **limits, **healing(LEASE_BEYOND)}), indent=2)


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
