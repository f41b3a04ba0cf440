"""By which names a gateway may be opened: any other Host is a name that was made to point here."""

from __future__ import annotations

import ipaddress
import socket
from dataclasses import dataclass
from urllib.parse import urlsplit

from mrlab_ros.adapters.keys import certificates
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.gateway.diagnostics import BAD_PUBLIC_URL
from mrlab_ros.gateway.settings import Settings, is_loopback


@dataclass(frozen=True)
class Hosts:
    """The names of a gateway, in lower case; `*.` stands for one label.

    addresses: any address is a name too, as it cannot be made to point elsewhere. public_origin:
    that of a reverse proxy, or empty.
    """

    names: frozenset[str]
    addresses: bool = False
    public_origin: str = ""

    @classmethod
    def of(cls, settings: Settings) -> Hosts:
        """Return the names by which this gateway may be opened; raises BadInput for a bad URL."""
        names, origin = {"localhost"}, ""
        if settings.public_url:
            url = urlsplit(settings.public_url)
            if url.scheme not in ("http", "https") or not url.hostname or url.path.strip("/"):
                raise BadInput(BAD_PUBLIC_URL(url=settings.public_url))
            names.add(url.hostname)
            origin = f"{url.scheme}://{url.netloc}"
        if settings.https:
            found = certificates.read_certificate(settings.certificate_file)
            names.update(host.lower() for host in certificates.hosts(found))
        beyond = not is_loopback(settings.host)
        if beyond:
            names.add(socket.gethostname().lower())
        return cls(frozenset(names), beyond, origin)

    def allows(self, host: str) -> bool:
        """Return whether `host`, a name or an address without a port, is this gateway."""
        host = host.lower().removesuffix(".")
        if host in self.names or is_loopback(host):
            return True
        _, dot, rest = host.partition(".")
        if dot and f"*.{rest}" in self.names:
            return True
        try:
            ipaddress.ip_address(host)
        except ValueError:
            return False
        return self.addresses
