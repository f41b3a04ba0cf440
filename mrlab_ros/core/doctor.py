"""What may keep a lab or its pages from working: facts of a machine, and what to do about each."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

PYTHON_FROM, PYTHON_TO = (3, 10), (3, 13)
PHYSICS_TO = (3, 11)
# A lab keeps trajectories and bags; below this a session may end in the middle.
LEAST_DISK = 1_000_000_000
# A clock that is off by more makes poses jump on a client that trusts it, s.
MOST_OFFSET = 0.5
# s before a certificate ends when it should be renewed
SOON = 14 * 24 * 3600.0
# Modules that a lab cannot do without, and what is lost without the others.
NEEDED = ("rclpy", "mrlab_msgs", "zenoh", "numpy")
OPTIONAL = {"pybullet": "the lab runs without physics: no contacts, no grasps"}


@dataclass(frozen=True)
class Finding:
    """One hop between a person and the lab. remedy: what to do; empty where it is well."""

    name: str
    ok: bool
    found: str
    remedy: str = ""


@dataclass(frozen=True)
class Port:
    """A port that a lab of this machine listens on. free: nobody does now; ours: the lab does."""

    number: int
    what: str
    free: bool
    ours: bool


@dataclass(frozen=True)
class Gateway:
    """What a gateway answered. version: of the lab behind it; offset: its clock minus ours, s.

    error: why it did not answer; empty: it did.
    """

    url: str
    version: str
    offset: float | None
    error: str


@dataclass(frozen=True)
class Certificate:
    """The certificate of the pages. day: on which it expires, YYYY-MM-DD; left: s until then."""

    name: str
    day: str
    left: float


@dataclass(frozen=True)
class Facts:
    """What was found on a machine. multicast: why a packet did not come back; empty: it did."""

    python: tuple[int, int]
    modules: Mapping[str, bool]
    middleware: str
    middlewares: Sequence[str]
    multicast: str
    pages: bool
    version: str
    ports: Sequence[Port]
    gateway: Gateway | None
    certificate: Certificate | None
    state_dir: str
    state_writable: bool
    free_bytes: int


def examine(facts: Facts) -> Iterator[Finding]:
    """Yield what is well and what is not, from the ground up."""
    yield _python(facts)
    yield from _modules(facts)
    yield _middleware(facts)
    yield Finding(
        "multicast",
        not facts.multicast,
        facts.multicast or "nodes find each other by it",
        ""
        if not facts.multicast
        else "set ROS_AUTOMATIC_DISCOVERY_RANGE=LOCALHOST for a lab on one machine, or allow UDP "
        "multicast to 239.255.0.1 in the firewall",
    )
    yield Finding(
        "pages",
        facts.pages,
        "built" if facts.pages else "not built",
        "" if facts.pages else "run make demo, or scripts/npm run build",
    )
    for port in facts.ports:
        yield _port(port)
    if facts.gateway is not None:
        yield from _gateway(facts.gateway, facts.version)
    if facts.certificate is not None:
        yield _certificate(facts.certificate)
    yield Finding(
        "store",
        facts.state_writable,
        f"{facts.state_dir} can{'' if facts.state_writable else 'not'} be written",
        ""
        if facts.state_writable
        else f"make {facts.state_dir} writable for this user, or give --state-dir",
    )
    enough = facts.free_bytes >= LEAST_DISK
    yield Finding(
        "disk",
        enough,
        f"{facts.free_bytes / 1e9:.1f} GB free",
        "" if enough else f"free {LEAST_DISK / 1e9:g} GB: bags and uploads need room",
    )


def _python(facts: Facts) -> Finding:
    said = ".".join(map(str, facts.python))
    if PYTHON_FROM <= facts.python <= PYTHON_TO:
        return Finding("python", True, said)
    return Finding(
        "python", False, said, "install Python 3.11 and run make demo with it (PYTHON=python3.11)"
    )


def _modules(facts: Facts) -> Iterator[Finding]:
    missing = [name for name in NEEDED if not facts.modules.get(name)]
    yield Finding(
        "wheels",
        not missing,
        f"missing: {', '.join(missing)}" if missing else "all there",
        "run make demo once; in a shell of its own: . .venv/mrlab.sh" if missing else "",
    )
    for name, loss in OPTIONAL.items():
        if facts.modules.get(name):
            yield Finding(name, True, "there")
        elif facts.python > PHYSICS_TO:
            yield Finding(
                name, False, f"no wheel for this Python; {loss}", "use Python 3.10 or 3.11"
            )
        else:
            yield Finding(name, False, f"missing; {loss}", f"pip install {name}")


def _middleware(facts: Facts) -> Finding:
    there = ", ".join(facts.middlewares) or "none"
    wanted = facts.middleware
    if not wanted and facts.middlewares:
        return Finding("middleware", True, there)
    if wanted in facts.middlewares:
        return Finding("middleware", True, wanted)
    if not wanted:
        return Finding("middleware", False, there, "run make demo: it installs rmw_fastrtps_cpp")
    return Finding(
        "middleware",
        False,
        f"RMW_IMPLEMENTATION is {wanted}; installed: {there}",
        "unset RMW_IMPLEMENTATION, or install that middleware",
    )


def _port(port: Port) -> Finding:
    name = f"port {port.number}"
    if port.ours:
        return Finding(name, True, f"{port.what}: the running lab has it")
    if port.free:
        return Finding(name, True, f"{port.what}: free")
    option = "--http" if port.what == "pages" else "--zenoh-listen"
    return Finding(
        name,
        False,
        f"{port.what}: another program has it",
        f"end that program, or start the lab with another port ({option})",
    )


def _gateway(gateway: Gateway, version: str) -> Iterator[Finding]:
    if gateway.error:
        yield Finding(
            "gateway",
            False,
            f"{gateway.url}: {gateway.error}",
            "start the lab with mrlab up; from another machine give it --keys or --https-cert and "
            "open its port in the firewall",
        )
        return
    same = gateway.version == version
    yield Finding(
        "gateway",
        same,
        f"{gateway.url} has version {gateway.version}, this machine {version}",
        "" if same else "bring both to one version, then reload the pages",
    )
    if gateway.offset is not None:
        near = abs(gateway.offset) <= MOST_OFFSET
        yield Finding(
            "clocks",
            near,
            f"{gateway.offset:+.1f} s between the gateway and this machine",
            "" if near else "switch on time synchronisation (timedatectl set-ntp true) on both",
        )


def _certificate(certificate: Certificate) -> Finding:
    said = f"{certificate.name} expires {certificate.day}"
    if certificate.left > SOON:
        return Finding("certificate", True, said)
    return Finding("certificate", False, said, "make a new one: mrlab keys renew")
