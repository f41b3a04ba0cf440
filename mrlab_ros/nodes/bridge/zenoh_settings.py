"""zenoh's configuration of the bridge, from its parameters."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from mrlab_ros.adapters.zenoh.configuration import LOOPBACK, configuration, log_logins
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.bridge.access import bounds
from mrlab_ros.core.bridge.diagnostics import CLIENT_WITHOUT_ROUTER, CONFIG_AND_KEYS
from mrlab_ros.core.bridge.guests import Guests, Share
from mrlab_ros.core.bridge.links import EVERYWHERE, check_endpoints, check_router, local_endpoint
from mrlab_ros.core.bridge.rules import Rules
from mrlab_ros.nodes.parameters import AUTOMATIC, BridgeParameters
from mrlab_ros.ros import share

# zenoh's setting of the sessions of all people together, and its least value.
MAX_SESSIONS = "transport/unicast/max_sessions"
LEAST_SESSIONS = 200


def zenoh_settings(values: BridgeParameters, rules: Rules) -> tuple[Any, Guests | None]:
    """Return zenoh's configuration, and who may connect; None: anybody who reaches it.

    rules: the allow-list, whose bounds hold for all. Raises BadInput where parameters contradict
    each other, and where the keys are not in order.
    """
    file, folder, mode = values.zenoh_config, values.keys, values.mode
    connect, listen, lease = values.connect, values.listen, values.lease
    if AUTOMATIC in listen:
        listen = () if folder and connect else EVERYWHERE if folder else LOOPBACK
    if file and folder:
        raise BadInput(CONFIG_AND_KEYS(file=file, folder=folder))
    if folder and mode == "client" and not connect:
        raise BadInput(CLIENT_WITHOUT_ROUTER(folder=folder))
    if file:
        return configuration(Path(file)), None
    check_endpoints(listen, values.insecure, bool(folder))
    limits = bounds(rules, values.prefix)
    # A client of a router listens nowhere.
    door = values.socket if mode != "client" else ""
    if door:
        listen = (*listen, local_endpoint(door))
    if not folder:
        settings = configuration(
            mode=mode, listen=listen, connect=connect, lease=lease, security=limits
        )
        return settings, None
    # Here: a lab without keys needs no cryptography in its memory.
    from mrlab_ros.adapters.keys.folder import Keys, now

    keys = Keys(Path(folder))
    keys.check(now())
    guests: Guests | None = None
    if connect:
        check_router(mode, listen, connect)
        security = keys.lab_settings(now())
    else:
        security = keys.settings(rules, values.prefix, now(), local=bool(door)) | limits
        share_of_each = Share(values.sessions_each, values.guest_rate, values.guest_burst)
        guests = Guests(
            keys.people(now()), share_of_each, by_certificate=keys.login.by_certificate
        )
        security[MAX_SESSIONS] = max(LEAST_SESSIONS, guests.room)
    log_logins(passwords=keys.login.by_password)
    settings = configuration(
        mode=mode,
        listen=listen,
        connect=connect,
        lease=lease,
        base=share.directory() / "config" / "zenoh" / "lab.json5",
        security=security,
    )
    return settings, guests
