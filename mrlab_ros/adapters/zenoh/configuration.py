"""zenoh's configuration and its log."""

from __future__ import annotations

import json
from collections.abc import Mapping
from pathlib import Path

import zenoh

from mrlab_ros.adapters.zenoh.diagnostics import BAD_ZENOH_FILE, BAD_ZENOH_SETTINGS
from mrlab_ros.core.base.diagnostic import of_text
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.bridge.links import LEASE_BEYOND, LEASE_WITHIN, healing, is_local

LOOPBACK = ("tcp/127.0.0.1:7447",)
# How long a put waits for a full link, us, before its message is dropped, and before the client of
# that link is disconnected. zenoh's defaults are 1,000 and 5,000,000.
WAIT_BEFORE_DROP = 0
WAIT_BEFORE_CLOSE = 1_000_000
# Size of a link's socket buffer, bytes. Linux alone would let it grow to megabytes, and a client
# that reads slowly would receive motion that is many seconds old.
SEND_BUFFER = 131_072
# Batches of 64 KiB that may wait at a link of this machine, for each priority of motion, states,
# events; beyond it they are the two of zenoh. No network is slow here, and a program that has
# no turn for 0.1 s loses nothing of 25,000 messages a second.
BATCHES_WITHIN = 16
PRIORITIES = ("real_time", "interactive_high", "interactive_low", "data_high", "data")
# The settings in config/zenoh/lab.json5.
LIMITS = (
    "scouting/multicast/enabled",
    "scouting/gossip/enabled",
    "adminspace/enabled",
    "transport/unicast/accept_timeout",
    "transport/unicast/accept_pending",
    "transport/unicast/max_sessions",
    "transport/link/protocols",
    "transport/link/rx/max_message_size",
)
# zenoh's log targets for TLS and for subjects unknown to access control, and for passwords.
# Without the certificates that each retry to a router reads anew.
LOGINS = (
    "error,zenoh_link_tls=debug,zenoh_link_tls::utils=warn,"
    "zenoh::net::routing::interceptor::access_control=info"
)
PASSWORDS = "zenoh_transport::unicast::establishment::accept=debug"


def configuration(
    file: Path | None = None,
    *,
    mode: str = "peer",
    listen: tuple[str, ...] = LOOPBACK,
    connect: tuple[str, ...] = (),
    base: Path | None = None,
    security: Mapping[str, object] | None = None,
    lease: float = 0.0,
) -> zenoh.Config:
    """Return zenoh's configuration: `file` (json5) where given, else from the other arguments.

    base: a json5 file that the others add to. security: path -> value, such as a keys folder's.
    lease: s after which a silent link counts as broken; 0: by the endpoints. Without a file
    multicast discovery is off. Raises BadInput where zenoh refuses one.
    """
    try:
        if file is not None:
            return zenoh.Config.from_file(str(file))
        config = zenoh.Config() if base is None else zenoh.Config.from_file(str(base))
        config.insert_json5("mode", json.dumps(mode))
        config.insert_json5("listen/endpoints", json.dumps(listen))
        config.insert_json5("connect/endpoints", json.dumps(connect))
        config.insert_json5("scouting/multicast/enabled", "false")
        # A client of this machine that offers it would have zenoh reserve 16 MB.
        config.insert_json5("transport/shared_memory/enabled", "false")
        queue = "transport/link/tx/queue/congestion_control"
        config.insert_json5(f"{queue}/drop/wait_before_drop", json.dumps(WAIT_BEFORE_DROP))
        config.insert_json5(f"{queue}/block/wait_before_close", json.dumps(WAIT_BEFORE_CLOSE))
        within = all(is_local(endpoint) for endpoint in (*listen, *connect))
        if within:
            for priority in PRIORITIES:
                size = f"transport/link/tx/queue/size/{priority}"
                config.insert_json5(size, json.dumps(BATCHES_WITHIN))
        lease = lease or (LEASE_WITHIN if within else LEASE_BEYOND)
        config.insert_json5("transport/link/tcp/so_sndbuf", json.dumps(SEND_BUFFER))
        config.insert_json5("transport/link/tls/so_sndbuf", json.dumps(SEND_BUFFER))
        for path, value in (healing(lease) | dict(security or {})).items():
            config.insert_json5(path, json.dumps(value))
    except (zenoh.ZError, OSError) as error:
        why = of_text(first_line(error))
        raise BadInput(
            BAD_ZENOH_FILE(file=str(file), why=why)
            if file
            else BAD_ZENOH_SETTINGS(mode=mode, listen=listen, connect=connect, why=why)
        ) from error
    return config


def limits(file: Path) -> dict[str, object]:
    """Return the settings in config/zenoh/lab.json5, path -> value."""
    config = zenoh.Config.from_file(str(file))
    return {path: json.loads(config.get_json(path)) for path in LIMITS}


def log_logins(*, passwords: bool) -> None:
    """Have zenoh log to stdout who connects and who is refused; RUST_LOG overrides that."""
    zenoh.init_log_from_env_or(f"{LOGINS},{PASSWORDS}" if passwords else LOGINS)


def first_line(error: Exception) -> str:
    """Return what zenoh says of an error, without the place in its source."""
    return str(error).split(" at /", 1)[0].strip()
