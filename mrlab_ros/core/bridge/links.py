"""Keys, leases and retries of the bridge's links.

A key is the name of a topic or service without its leading slash, under the lab's prefix. The
bridge checks the graph often while it changes and seldom otherwise.
"""

from __future__ import annotations

import ipaddress
import re
from collections.abc import Mapping
from typing import Any

from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.bridge import diagnostics as say

# A link that is silent for so long, s, counts as broken. Beyond this machine that is short, so a
# broken link heals within 2 s. On loopback a link only breaks when its process dies, which TCP
# reports at once, and a stall of the machine must not count as a break: 10 s is zenoh's default.
LEASE_BEYOND = 1.5
LEASE_WITHIN = 10.0
# Timeout of one attempt to connect and periods of the retries, ms: TCP itself repeats less often
# after the first second. zenoh's defaults are 1 to 4 s, and 10 s.
OPEN_TIMEOUT = 2000
LOCAL_PROTOCOL = "unixsock-stream"
PORT = 7447
# Endpoints of a lab with keys.
EVERYWHERE = (f"tls/0.0.0.0:{PORT}",)
RETRY = {"period_init_ms": 250, "period_max_ms": 500, "period_increase_factor": 1.5}


def healing(lease: float) -> dict[str, Any]:
    """Return zenoh's settings, path -> value, for links that heal quickly. lease: s."""
    return {
        "transport/link/tx/lease": round(1000 * lease),
        "transport/unicast/open_timeout": OPEN_TIMEOUT,
        "connect/retry": RETRY,
    }


def nested(settings: Mapping[str, object]) -> dict[str, Any]:
    """Return settings, path -> value, as the nested mappings of a configuration file."""
    document: dict[str, Any] = {}
    for path, value in settings.items():
        *folders, last = path.split("/")
        place = document
        for part in folders:
            place = place.setdefault(part, {})
        place[last] = value
    return document


def is_local(endpoint: str) -> bool:
    """Return whether an endpoint such as tcp/127.0.0.1:7447 is on this machine."""
    protocol, _, address = endpoint.partition("/")
    host = address.rsplit(":", 1)[0].strip("[]")
    if protocol == LOCAL_PROTOCOL or host == "localhost":
        return True
    try:
        return ipaddress.ip_address(host).is_loopback
    except ValueError:
        # A host name may resolve to any address, even one that begins with 127.
        return False


def local_endpoint(socket: str) -> str:
    """Return the endpoint of a Unix socket: only who may enter its folder can connect."""
    return f"{LOCAL_PROTOCOL}/{socket}"


def from_here(endpoint: str) -> str:
    """Return how this machine connects to an endpoint on which it listens itself."""
    protocol, _, address = endpoint.partition("/")
    host, _, port = address.rpartition(":")
    if host not in ("0.0.0.0", "[::]"):
        return endpoint
    # The certificate of a keys folder has both; a name is not for all protocols.
    return f"{protocol}/{'localhost' if protocol in ('tls', 'quic') else '127.0.0.1'}:{port}"


def check_router(mode: str, listen: tuple[str, ...], connect: tuple[str, ...]) -> None:
    """Raise BadInput where a lab with keys cannot connect to a router with these settings.

    Such a lab does not listen: only the router accepts people, and it enforces the rules.
    """
    if mode != "client" or listen:
        raise BadInput(
            say.ROUTER_NEEDS_CLIENT(endpoints=list(connect), mode=mode, listen=list(listen))
        )
    for endpoint in connect:
        if not endpoint.startswith(("tls/", "quic/")):
            raise BadInput(say.ROUTER_WITHOUT_TLS(endpoint=endpoint))


def check_endpoints(listen: tuple[str, ...], insecure: bool, keys: bool = False) -> None:
    """Raise BadInput where an endpoint is open to other machines without encryption.

    insecure: allow it. keys: the lab has a keys folder and listens with TLS only.
    """
    for endpoint in listen:
        if not re.fullmatch(r"[a-z][a-z-]*/.+", endpoint):
            raise BadInput(say.BAD_ENDPOINT(endpoint=endpoint))
        protocol, address = endpoint.split("/", 1)
        if protocol == "quic":
            raise BadInput(say.QUIC_UNBOUNDED(endpoint=endpoint, better=f"tls/{address}"))
        encrypted = protocol == "tls"
        if keys and not encrypted:
            raise BadInput(say.KEYS_NEED_TLS(endpoint=endpoint, better=f"tls/{address}"))
        if encrypted and not keys:
            raise BadInput(say.TLS_NEEDS_KEYS(endpoint=endpoint, protocol=protocol))
        if not (is_local(endpoint) or encrypted or insecure):
            raise BadInput(say.OPEN_ENDPOINT(endpoint=endpoint))


def key_of(name: str, prefix: str = "") -> str:
    """Return the zenoh key of a topic or service name, such as ur5e_1/joint_states."""
    return f"{prefix}{name}" if prefix else name[1:]


# How long after a change checks go on, s: the endpoints of a new node are matched one by one.
SETTLE_S = 1.0
# Time between two checks of a graph that does not change, s.
REST_S = 5.0


class Pace:
    """Times of the checks, s on any clock that never goes back; the first one is due at once.

    period: between two checks while the graph changes.
    """

    def __init__(self, period: float) -> None:
        self.period = period
        self._last = float("-inf")
        self._settle_until = float("-inf")
        self._settled = False

    def changed(self, now: float) -> None:
        """Note that the graph has changed."""
        self._settle_until = now + SETTLE_S
        self._settled = False

    def wait(self, now: float) -> float:
        """Return the time until the next check; 0: it is due."""
        return max(self._last + (REST_S if self._settled else self.period) - now, 0.0)

    def check(self, now: float) -> bool:
        """Note that a check begins; return whether it is to be thorough.

        That is the last one after a change, and each one without a change.
        """
        self._last = now
        if now >= self._settle_until:
            self._settled = True
        return self._settled
