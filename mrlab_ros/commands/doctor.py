"""`mrlab doctor`: what keeps a lab or its pages from working, and what to do."""

from __future__ import annotations

import errno
import importlib.util
import json
import os
import shutil
import socket
import ssl
import sys
import time
import urllib.error
import urllib.request
from datetime import datetime, timezone
from email.utils import parsedate_to_datetime
from pathlib import Path
from typing import Annotated

import typer

from mrlab_ros import __version__
from mrlab_ros.core.base.diagnostic import plain
from mrlab_ros.core.runtime.doctor import (
    GROUP,
    NEEDED,
    OPTIONAL,
    Certificate,
    Facts,
    Gateway,
    Port,
    examine,
)

TIMEOUT_S = 1.0
MIDDLEWARES = ("rmw_fastrtps_cpp", "rmw_cyclonedds_cpp", "rmw_zenoh_cpp", "rmw_connextdds")
PAGES_PORT, ZENOH_PORT = 8080, 7447


def doctor(
    url: Annotated[
        str, typer.Option("--url", help="A gateway to ask; not given: the one that runs here.")
    ] = "",
    certificate: Annotated[
        Path | None, typer.Option(help="The certificate of the pages, PEM.")
    ] = None,
    state_dir: Annotated[Path | None, typer.Option(help="The lab's state folder.")] = None,
    as_json: Annotated[bool, typer.Option("--json", help="Print JSON.")] = False,
) -> None:
    """Examine this machine and a lab's gateway; say of each hop that it is well, or what to do.

    Ends with 0 where all is well, else with 1.
    """
    findings = list(examine(gather(url, certificate, state_dir)))
    if as_json:
        print(json.dumps(plain(findings), indent=1))
    else:
        for finding in findings:
            print(f"{'FAIL' if finding.refuses else 'ok  '} {finding.message}")
            fixes = [f"try: {fix.command}" for fix in finding.fixes if fix.command]
            for line in filter(None, (finding.remedy, *fixes)):
                print(f"     {line}")
    if any(finding.refuses for finding in findings):
        raise typer.Exit(1)


def gather(url: str, certificate: Path | None, state_dir: Path | None) -> Facts:
    """Return the facts of this machine and of the gateway at `url`, else of its own lab."""
    from mrlab_ros.adapters.sandbox import restrictions
    from mrlab_ros.adapters.set_up import ROOT, outdated, set_up_here
    from mrlab_ros.gateway.pages import pages_folder
    from mrlab_ros.processes.run_file import RunFile
    from mrlab_ros.ros.environment import domain_id

    run = RunFile(domain_id()).read()
    web = (run or {}).get("web") or {}
    address = url or str(web.get("here", ""))
    folder = Path(str((run or {}).get("state_dir", "")) or Path.home() / ".local/share/mrlab")
    folder = state_dir or folder
    there = next(path for path in (folder, *folder.parents) if path.exists())
    return Facts(
        python=sys.version_info[:2],
        set_up=(str(ROOT), outdated()) if set_up_here() else None,
        modules={name: _has(name) for name in (*NEEDED, *OPTIONAL)},
        middleware=os.environ.get("RMW_IMPLEMENTATION", ""),
        middlewares=_middlewares(),
        multicast=_multicast(),
        pages=(pages_folder() / "index.html").exists(),
        version=__version__,
        ports=[
            _port(PAGES_PORT, "pages", address),
            _port(ZENOH_PORT, "zenoh", str((run or {}).get("zenoh", ""))),
        ],
        gateway=_ask(address.rstrip("/")) if address else None,
        certificate=None if certificate is None else _expiry(certificate),
        state_dir=str(folder),
        state_writable=os.access(there, os.W_OK),
        free_bytes=shutil.disk_usage(there).free,
        sandbox=restrictions.layers(),
    )


def _has(module: str) -> bool:
    return importlib.util.find_spec(module) is not None


def _middlewares() -> list[str]:
    folders = os.environ.get("AMENT_PREFIX_PATH", "").split(os.pathsep)
    return [
        name
        for name in MIDDLEWARES
        if any((Path(each) / "share" / name).exists() for each in folders if each)
    ]


def _multicast() -> str | None:
    """Return why a multicast packet does not come back on this machine; None: it does."""
    asked = os.urandom(8)
    try:
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as here:
            here.settimeout(TIMEOUT_S)
            here.bind(("", 0))
            member = socket.inet_aton(GROUP) + socket.inet_aton("0.0.0.0")
            here.setsockopt(socket.IPPROTO_IP, socket.IP_ADD_MEMBERSHIP, member)
            here.setsockopt(socket.IPPROTO_IP, socket.IP_MULTICAST_LOOP, 1)
            here.sendto(asked, (GROUP, here.getsockname()[1]))
            while here.recv(64) != asked:
                pass
    except OSError as error:
        return str(error)
    return None


def _port(number: int, what: str, address: str) -> Port:
    with socket.socket() as tried:
        tried.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        try:
            tried.bind(("127.0.0.1", number))
            free = True
        except OSError as error:
            free = error.errno != errno.EADDRINUSE
    return Port(number, what, free, ours=address.rstrip("/").endswith(f":{number}"))


def _ask(url: str) -> Gateway:
    # The lab's own certificate is not known here; what counts is whether somebody answers.
    context = ssl.create_default_context()
    context.check_hostname = False
    context.verify_mode = ssl.CERT_NONE
    try:
        with urllib.request.urlopen(
            f"{url}/api/session", timeout=5 * TIMEOUT_S, context=context
        ) as answer:
            now = time.time()
            version = str(json.loads(answer.read())["lab"]["version"])
            date = answer.headers.get("Date")
    except (OSError, ValueError, KeyError, TypeError, urllib.error.URLError) as error:
        return Gateway(url, "", None, str(error))
    # The header has whole seconds, cut off.
    offset = None if date is None else parsedate_to_datetime(date).timestamp() + 0.5 - now
    return Gateway(url, version, offset if offset is None or abs(offset) > 1 else 0.0, "")


def _expiry(certificate: Path) -> Certificate:
    from cryptography import x509

    from mrlab_ros.commands.diagnostics import NO_PEM
    from mrlab_ros.core.base.diagnostic import of_text
    from mrlab_ros.core.base.errors import BadInput

    try:
        read = x509.load_pem_x509_certificate(certificate.read_bytes())
    except (OSError, ValueError) as error:
        why = of_text(str(error))
        raise BadInput(NO_PEM(path=str(certificate), why=why)) from None
    end = read.not_valid_after_utc
    left = (end - datetime.now(timezone.utc)).total_seconds()
    return Certificate(str(certificate), f"{end:%Y-%m-%d}", left)
