"""Settings of a gateway."""

from __future__ import annotations

import ipaddress
from dataclasses import dataclass, field
from pathlib import Path
from urllib.parse import SplitResult, urlsplit

from mrlab_ros.adapters.keys import people
from mrlab_ros.core.base.diagnostic import Fix
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.extensions import extensions
from mrlab_ros.gateway.diagnostics import (
    BAD_ADDRESS,
    BAD_PUBLIC_URL,
    CERTIFICATE_WITHOUT_KEY,
    INSECURE_WITH_KEYS,
    NO_HTTPS_FILE,
    OPEN_TO_NETWORK,
)

HOST = "127.0.0.1"
PORT = 8080
LARGEST_PORT = 65535


@dataclass(frozen=True)
class Settings:
    """Settings of a gateway.

    state_dir: folder of people, sign-ins and the store. host, port: where it listens; port 0: any
    free one. zenoh: endpoint of the lab's bridge or router; empty: that of zenoh_config, or
    tcp/127.0.0.1:7447. zenoh_config: a zenoh client file that holds its key, such as
    keys/gateway.json5. prefix: what the lab's keys begin with. keys: the lab's keys folder: people
    sign in, and its certificate serves HTTPS. certificate, certificate_key: another one for HTTPS.
    public_url: the address by which a reverse proxy offers this gateway. insecure: listen beyond
    this machine without keys. allow_list: the bridge's YAML file, the shipped one if None. store:
    URL or folder of the object store; empty: in state_dir. oidc: YAML file of an OpenID Connect
    provider. limits: YAML file of what pages may take. pages: folder of the built pages; None: the
    installed ones. classroom: a folder of `mrlab class` for instructors to step through. lti:
    YAML file of the learning platform whose course the class is.
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
    lti: Path | None = None
    lab_name: str = field(default="MR-Lab")

    @property
    def https(self) -> bool:
        """Return whether this gateway itself serves HTTPS."""
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
        """Return whether people sign in; otherwise one local user needs no password."""
        return self.keys is not None or self.certificate is not None or bool(self.public_url)

    def check(self) -> None:
        """Raise BadInput where a gateway may not, or cannot, be run with these settings."""
        if self.insecure and (self.https or self.public_url):
            raise BadInput(INSECURE_WITH_KEYS())
        if self.public_url:
            site_of(self.public_url)
        if (self.certificate is None) != (self.certificate_key is None):
            raise BadInput(CERTIFICATE_WITHOUT_KEY())
        if not (self.https or self.insecure or is_loopback(self.host)):
            ways = ("mrlab keys init", "mrlab up --keys keys", "mrlab up --insecure")
            fixes = tuple(Fix(command=way) for way in ways)
            raise BadInput(OPEN_TO_NETWORK(host=self.host, port=self.port, fixes=fixes))
        for extension in extensions():
            extension.check(self)
        if self.https:
            for file in (self.certificate_file, self.certificate_key_file):
                if not file.is_file():
                    make = Fix(command="mrlab keys init")
                    raise BadInput(NO_HTTPS_FILE(path=str(file), fixes=(make,)))
            people.check(self.certificate_key_file)


def site_of(url: str) -> SplitResult:
    """Return the parts of a site's address; raise BadInput for another text."""
    try:
        site = urlsplit(url)
        rest = site.path.strip("/") + site.query + site.fragment + (site.username or "")
        if site.scheme in ("http", "https") and site.hostname and site.port != 0 and not rest:
            return site
    except ValueError:  # a port that is no number
        pass
    raise BadInput(BAD_PUBLIC_URL(url=url))


def parsed_address(text: str) -> tuple[str, int]:
    """Return host and port of HOST:PORT, PORT or [IPV6]:PORT; raise BadInput for another text."""
    host, colon, port = text.rpartition(":")
    host = host.strip("[]") if colon else HOST
    if not (host and port.isascii() and port.isdigit() and int(port) <= LARGEST_PORT):
        raise BadInput(BAD_ADDRESS(address=text))
    return host, int(port)


def is_loopback(host: str) -> bool:
    """Return whether `host`, a name or an address without a port, is this machine alone."""
    if host == "localhost":
        return True
    try:
        return ipaddress.ip_address(host).is_loopback
    except ValueError:
        return False
