"""The pages of `mrlab up`: their address, and how to open them."""

from __future__ import annotations

import os
import socket
import sys
import time
import webbrowser
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from typing import Any

from mrlab_ros.commands.diagnostics import PAGES_PORT_TAKEN
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.processes.child_process import SELF
from mrlab_ros.processes.options import LabOptions, WebOptions
from mrlab_ros.processes.web import web_address

HTTP = "127.0.0.1:8080"
HTTP_WITH_KEYS = "0.0.0.0:8080"


def checked_web(
    http: str,
    *,
    keys: Path | None,
    insecure: bool = False,
    certificate: Path | None = None,
    certificate_key: Path | None = None,
    public_url: str = "",
    oidc: Path | None = None,
    limits: Path | None = None,
    classroom: Path | None = None,
    lti: Path | None = None,
) -> WebOptions:
    """Return where the pages are served; raises BadInput where they may not or cannot be.

    http: HOST:PORT; empty: 8080, on this machine alone unless there is HTTPS. Port 0: a free one.
    """
    from mrlab_ros.gateway.link.limits import read_limits
    from mrlab_ros.gateway.people.oidc import read_provider
    from mrlab_ros.gateway.settings import Settings, parsed_address

    read_limits(limits)
    if oidc is not None:
        read_provider(oidc)
    https = keys is not None or certificate is not None
    host, port = parsed_address(http or (HTTP_WITH_KEYS if https else HTTP))
    Settings(
        # Is not looked at: the gateway makes it.
        state_dir=Path(),
        host=host,
        port=port,
        keys=keys,
        certificate=certificate,
        certificate_key=certificate_key,
        public_url=public_url,
        oidc=oidc,
        classroom=classroom,
        lti=lti,
        insecure=insecure and not (https or public_url),
    ).check()
    return WebOptions(
        host,
        free_address(host, port),
        _absolute(certificate),
        _absolute(certificate_key),
        public_url,
        _absolute(oidc),
        _absolute(limits),
        _absolute(classroom),
        _absolute(lti),
    )


def free_address(host: str, port: int) -> int:
    """Return the port, any free one for 0; raises BadInput where nobody can listen there."""
    family = socket.AF_INET6 if ":" in host else socket.AF_INET
    with socket.socket(family) as probe:
        # As a server does: what a closed connection left behind is no hindrance.
        probe.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        try:
            probe.bind((host, port))
        except OSError as error:
            why = os.strerror(error.errno or 0)
            taken = PAGES_PORT_TAKEN(host=host, port=port, why=why, next=port + 1)
            raise BadInput(taken) from error
        return int(probe.getsockname()[1])


def prepare_keys(folder: Path) -> None:
    """Make the gateway's key where a keys folder has none yet, or an expired one."""
    from mrlab_ros.adapters.keys.folder import Keys, now

    keys = Keys(folder)
    if not keys.has_gateway(now()):
        keys.gateway(now())


def public_address(web: WebOptions, keys: Path | None, here: str) -> str:
    """Return the address by which people reach the pages; here: that for this machine."""
    from mrlab_ros.adapters.keys import certificates
    from mrlab_ros.adapters.keys.folder import Keys
    from mrlab_ros.gateway.settings import is_loopback

    if web.public_url:
        return web.public_url
    scheme = here.partition(":")[0]
    if web.certificate is not None:
        # Browsers accept it for its own names alone.
        named = certificates.hosts(certificates.read_certificate(web.certificate))
        whole = [host for host in named if not host.startswith("*")]
        if whole:
            return f"{scheme}://{whole[0]}:{web.port}"
    if is_loopback(web.host) or web.host not in ("0.0.0.0", "::"):
        return here
    host = Keys(keys).hosts[0] if keys is not None else socket.gethostname()
    return f"{scheme}://{f'[{host}]' if ':' in host else host}:{web.port}"


def run_facts(options: LabOptions) -> dict[str, Any]:
    """Return what the run file says of the pages.

    here: their address for this machine, without regard to certificates. open: that for its
    browser. address: that for everybody.
    """
    web, keys = options.web, options.keys
    assert web is not None
    here = web_address(options)
    address = public_address(web, keys, here)
    return {
        "here": here,
        "open": address if web.certificate is not None or web.public_url else here,
        "address": address,
        "users": str(users_file(options.state_dir, keys)),
        "signs_in": here.startswith("https") or bool(web.public_url),
    }


def users_file(state_dir: Path, keys: Path | None) -> Path:
    """Return the file of people and sign-ins that the gateway of a lab has."""
    from mrlab_ros.gateway.people.sign_ins import FILE

    return (keys.expanduser().resolve() if keys is not None else state_dir) / FILE


def opening_url(address: str, users: Path, path: str = "/") -> str:
    """Return a URL that signs this machine's user in, once."""
    from mrlab_ros.gateway.people.accounts import Accounts
    from mrlab_ros.gateway.people.sign_ins import Database

    database = Database(users)
    try:
        return f"{address}{path}?token={Accounts(database).open(time.time())}"
    finally:
        database.close()


def say_where(web: Mapping[str, Any], say: Callable[[str, str], None]) -> None:
    """Say by which addresses the pages are opened; web: that part of the run file."""
    say(SELF, f"open the pages on this machine: {opening_url(web['open'], Path(web['users']))}")
    if web["address"] == web["here"]:
        return
    say(SELF, f"everybody else: {web['address']}")
    if sys.stdout.isatty():
        for line in qr_lines(web["address"]):
            say(SELF, line)


def qr_lines(text: str) -> Iterator[str]:
    """Yield the lines of a QR code for a terminal."""
    import io

    import segno

    out = io.StringIO()
    segno.make(text, micro=False).terminal(out, compact=True, border=1)
    yield from out.getvalue().rstrip("\n").split("\n")


def open_in_browser(url: str) -> bool:
    """Open a page where there is a display; return whether a browser was started."""
    if not (os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY")):
        return False
    try:
        return webbrowser.open(url)
    except webbrowser.Error:
        return False


def _absolute(path: Path | None) -> Path | None:
    return path.expanduser().resolve() if path is not None else None
