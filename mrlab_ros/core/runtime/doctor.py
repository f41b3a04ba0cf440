"""Faults that may keep a lab or its pages from working: facts of a machine, and remedies."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

from mrlab_ros.core.base.diagnostic import Diagnostic, of_text
from mrlab_ros.core.runtime import diagnostics as say

PYTHON_FROM, PYTHON_TO = (3, 10), (3, 13)
PHYSICS_TO = (3, 11)
# A lab keeps trajectories and bags; below this a session may end in the middle.
LEAST_DISK = 1_000_000_000
# A clock that is off by more makes poses jump on a client that trusts it, s.
MOST_OFFSET = 0.5
# s before a certificate ends when it should be renewed
SOON = 14 * 24 * 3600.0
# Modules that a lab cannot do without, and those of its physics.
NEEDED = ("rclpy", "mrlab_msgs", "zenoh", "numpy")
OPTIONAL = ("pybullet",)
# Layers of the sandbox of readers of files, and the consequences where the kernel lacks them.
WITHOUT_LAYER = {"landlock": say.NO_LANDLOCK, "seccomp": say.NO_SECCOMP}
# By which nodes find each other.
GROUP = "239.255.0.1"


@dataclass(frozen=True)
class Port:
    """A port that a lab of this machine listens on. free: nobody does now; ours: the lab does."""

    number: int
    what: str
    free: bool
    ours: bool


@dataclass(frozen=True)
class Gateway:
    """The answer of a gateway. version: of the lab behind it; offset: its clock minus ours, s.

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
    """Facts of a machine. multicast: why a packet did not come back; None: it did.

    set_up: the folder that set-up works in, and its steps that are to be done again; None: it did
    not set this up. sandbox: the layers of the sandbox of readers of files, and whether the kernel
    has them.
    """

    python: tuple[int, int]
    set_up: tuple[str, Sequence[str]] | None
    modules: Mapping[str, bool]
    middleware: str
    middlewares: Sequence[str]
    multicast: str | None
    pages: bool
    version: str
    ports: Sequence[Port]
    gateway: Gateway | None
    certificate: Certificate | None
    state_dir: str
    state_writable: bool
    free_bytes: int
    sandbox: Mapping[str, bool]


def examine(facts: Facts) -> Iterator[Diagnostic]:
    """Yield what is well (INFO) and what is not (ERROR), from the ground up."""
    yield _python(facts)
    if facts.set_up is not None:
        folder, steps = facts.set_up
        outdated = say.SET_UP_OUTDATED(folder=folder, steps=list(steps)) if steps else None
        yield outdated or say.SET_UP_CURRENT()
    yield from _modules(facts)
    yield _middleware(facts)
    yield (
        say.MULTICAST_WORKS()
        if facts.multicast is None
        else say.MULTICAST_BLOCKED(group=GROUP, why=of_text(facts.multicast))
    )
    yield say.PAGES_BUILT() if facts.pages else say.PAGES_NOT_BUILT()
    for port in facts.ports:
        yield _port(port)
    if facts.gateway is not None:
        yield from _gateway(facts.gateway, facts.version)
    if facts.certificate is not None:
        certificate = facts.certificate
        ends = say.CERTIFICATE_LASTS if certificate.left > SOON else say.CERTIFICATE_ENDS
        yield ends(path=certificate.name, day=certificate.day)
    store = say.STORE_WRITABLE if facts.state_writable else say.STORE_READ_ONLY
    yield store(folder=facts.state_dir)
    if facts.free_bytes >= LEAST_DISK:
        yield say.DISK_ROOM(free=facts.free_bytes)
    else:
        yield say.DISK_FULL(free=facts.free_bytes, least=LEAST_DISK)
    yield from _sandbox(facts.sandbox)


def _python(facts: Facts) -> Diagnostic:
    version, first, last = (
        ".".join(map(str, each)) for each in (facts.python, PYTHON_FROM, PYTHON_TO)
    )
    if PYTHON_FROM <= facts.python <= PYTHON_TO:
        return say.PYTHON_FITS(version=version)
    return say.PYTHON_UNFIT(version=version, first=first, last=last)


def _modules(facts: Facts) -> Iterator[Diagnostic]:
    missing = [name for name in NEEDED if not facts.modules.get(name)]
    yield say.WHEELS_MISSING(modules=missing) if missing else say.WHEELS_THERE()
    for name in OPTIONAL:
        if facts.modules.get(name):
            yield say.MODULE_THERE(module=name)
        elif facts.python > PHYSICS_TO:
            yield say.MODULE_WITHOUT_WHEEL(module=name)
        else:
            yield say.MODULE_MISSING(module=name)


def _sandbox(layers: Mapping[str, bool]) -> Iterator[Diagnostic]:
    there = [name for name in WITHOUT_LAYER if layers.get(name)]
    if there:
        yield say.SANDBOX_HAS(layers=there)
    for name, without in WITHOUT_LAYER.items():
        if name not in there:
            yield without()


def _middleware(facts: Facts) -> Diagnostic:
    wanted, there = facts.middleware, list(facts.middlewares)
    if wanted in there or (there and not wanted):
        return say.MIDDLEWARE_THERE(middlewares=[wanted] if wanted else there)
    if wanted:
        return say.MIDDLEWARE_OTHER(wanted=wanted, middlewares=there)
    return say.MIDDLEWARE_NONE()


def _port(port: Port) -> Diagnostic:
    if port.ours:
        return say.PORT_OURS(port=port.number, what=port.what)
    if port.free:
        return say.PORT_FREE(port=port.number, what=port.what)
    return say.PORT_IN_USE(port=port.number, what=port.what)


def _gateway(gateway: Gateway, own: str) -> Iterator[Diagnostic]:
    url, version = gateway.url, gateway.version
    if gateway.error:
        yield say.GATEWAY_SILENT(url=url, why=of_text(gateway.error))
        return
    if version == own:
        yield say.GATEWAY_SAME(url=url, version=version)
    else:
        yield say.GATEWAY_DIFFERS(url=url, version=version, own=own)
    if gateway.offset is None:
        return
    if abs(gateway.offset) <= MOST_OFFSET:
        yield say.CLOCKS_AGREE(offset=gateway.offset)
    else:
        yield say.CLOCKS_DIFFER(offset=gateway.offset, limit=MOST_OFFSET)
