"""What a gateway is started with."""

from __future__ import annotations

import ipaddress
from dataclasses import dataclass, field
from pathlib import Path

from mrlab_ros.adapters.keys import private_files
from mrlab_ros.core.errors import BadInput

HOST = "127.0.0.1"
PORT = 8080
LARGEST_PORT = 65535
# What `mrlab class` writes for pages and other tools.
CLASS_FILE = "class.json"


@dataclass(frozen=True)
class Settings:
    """What a gateway is started with.

    state_dir: folder of people, sign-ins and the store. host, port: where it listens; port 0: any
    free one. zenoh: endpoint of the lab's bridge or router; empty: that of zenoh_config, or
    tcp/127.0.0.1:7447. zenoh_config: a zenoh client file that holds its key, such as
    keys/gateway.json5. prefix: what the lab's keys begin with. keys: the lab's keys folder: people
    sign in, and its certificate serves HTTPS. certificate, certificate_key: another one for HTTPS.
    public_url: the address by which a reverse proxy offers this gateway. insecure: listen beyond
    this machine without keys. allow_list: the bridge's YAML file, the shipped one if None. store:
    URL or folder of the object store; empty: in state_dir. oidc: YAML file of an OpenID Connect
    provider. limits: YAML file of what pages may take. pages: folder of the built pages; None: the
    installed ones. classroom: a folder of `mrlab class` for instructors to step through.
    """

    state_dir: Path
    host: str = HOST
    port: int = PORT
    zenoh: str = ""
    zenoh_config: Path | None = None
    prefix: str = ""
    keys: Path | None = None
    certificate: Path | None = None
    certificate_key: Path | None = None
    public_url: str = ""
    insecure: bool = False
    allow_list: Path | None = None
    store: str = ""
    oidc: Path | None = None
    limits: Path | None = None
    pages: Path | None = None
    classroom: Path | None = None
    lab_name: str = field(default="MR-Lab")

    @property
    def https(self) -> bool:
        """Whether this gateway itself serves HTTPS."""
        return self.keys is not None or self.certificate is not None

    @property
    def certificate_file(self) -> Path:
        """The certificate for HTTPS."""
        return self.certificate or (self.keys or Path()) / "server.pem"

    @property
    def certificate_key_file(self) -> Path:
        """The key of the certificate for HTTPS."""
        return self.certificate_key or (self.keys or Path()) / "server.key"

    @property
    def signs_in(self) -> bool:
        """Whether people sign in; otherwise one local user needs no password."""
        return self.keys is not None or self.certificate is not None or bool(self.public_url)

    def check(self) -> None:
        """Raise BadInput where a gateway may not, or cannot, be run with these settings."""
        if self.insecure and (self.https or self.public_url):
            raise BadInput("--insecure and keys exclude each other; leave one of them out")
        if (self.certificate is None) != (self.certificate_key is None):
            raise BadInput(
                "a certificate for HTTPS needs its key; give both --https-cert and --https-key"
            )
        if not (self.https or self.insecure or is_loopback(self.host)):
            raise BadInput(
                f"the pages are to be served on {self.host}:{self.port}, where anybody in the "
                "network could read and change everything; give the lab keys (mrlab keys init, "
                "then mrlab up --keys FOLDER), listen on 127.0.0.1, or accept it with --insecure"
            )
        if self.classroom is not None and not (self.classroom / CLASS_FILE).is_file():
            raise BadInput(
                f"there is no {CLASS_FILE} in {self.classroom}; make the folder with mrlab class "
                "SUBMISSIONS --rubric RUBRIC.yaml --out FOLDER, and name that one"
            )
        if self.https:
            for file in (self.certificate_file, self.certificate_key_file):
                if not file.is_file():
                    raise BadInput(
                        f"there is no file {file}, which HTTPS needs; make one with mrlab keys "
                        "init, or name your own with --https-cert and --https-key"
                    )
            private_files.check(self.certificate_key_file)


def parsed_address(text: str) -> tuple[str, int]:
    """Return host and port of HOST:PORT, PORT or [IPV6]:PORT; raise BadInput for another text."""
    host, colon, port = text.rpartition(":")
    host = host.strip("[]") if colon else HOST
    if not (host and port.isascii() and port.isdigit() and int(port) <= LARGEST_PORT):
        raise BadInput(
            f"--http {text} is no address to listen on; expected HOST:PORT such as "
            f"{HOST}:{PORT} or 0.0.0.0:{PORT}"
        )
    return host, int(port)


def is_loopback(host: str) -> bool:
    """Return whether `host`, a name or an address without a port, is this machine alone."""
    if host == "localhost":
        return True
    try:
        return ipaddress.ip_address(host).is_loopback
    except ValueError:
        return False
