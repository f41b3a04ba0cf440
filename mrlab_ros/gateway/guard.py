"""One guard for HTTP and the WebSocket: Host, Origin, CSRF token, and the headers of answers.

A page of another site can neither read nor change the lab: its Origin is foreign. A name that was
made to point here (DNS rebinding) is no Host of this gateway.

By which names a gateway may be opened: any other Host is a name that was made to point here.
"""

from __future__ import annotations

import ipaddress
import re
import socket
from collections.abc import Callable, Collection
from dataclasses import dataclass

from starlette.datastructures import Headers, MutableHeaders
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from mrlab_ros.core.base.diagnostic import Diagnostic
from mrlab_ros.gateway.diagnostics import WRONG_CSRF, WRONG_HOST, WRONG_ORIGIN
from mrlab_ros.gateway.errors import problem
from mrlab_ros.gateway.settings import Settings, is_loopback, site_of


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
            url = site_of(settings.public_url)
            names.add(url.hostname or "")
            origin = f"{url.scheme}://{url.netloc}"
        if settings.https:
            from mrlab_ros.adapters.keys import certificates  # only what has one needs it

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


# A name or an address, IPv6 in brackets, and maybe a port.
HOST = re.compile(r"(?:\[(?P<address>[0-9A-Fa-f:.%]+)\]|(?P<name>[^\s:@/\[\]]+))(?::\d+)?")
SAFE = ("GET", "HEAD", "OPTIONS")
CSRF_HEADER = "x-csrf-token"
# A program begins here to be let in. It has nothing yet that a page of another site could use.
BEGINS = "/api/pairings"
# wasm-unsafe-eval: meshes are unpacked by WebAssembly. blob: textures of glTF files.
POLICY = "; ".join(
    (
        "default-src 'none'",
        "script-src 'self' 'wasm-unsafe-eval'",
        "style-src 'self'",
        "img-src 'self' blob:",
        "font-src 'self'",
        "media-src 'self'",
        "connect-src 'self' blob:",
        "worker-src 'self'",
        "manifest-src 'self'",
        "form-action 'self'",
        "base-uri 'none'",
        "frame-ancestors 'none'",
    )
)
HEADERS = {
    "Content-Security-Policy": POLICY,
    "Cross-Origin-Opener-Policy": "same-origin",
    "Cross-Origin-Resource-Policy": "same-origin",
    "Permissions-Policy": "camera=(), geolocation=(), microphone=(), xr-spatial-tracking=(self)",
    "Referrer-Policy": "no-referrer",
    "X-Content-Type-Options": "nosniff",
    "X-Frame-Options": "DENY",
}


class Guard:
    """Refuses requests with a wrong Host, Origin or CSRF token; adds HEADERS to every answer.

    host_allowed: whether a Host, without its port, is a name of this gateway. public_origin: that
    of a reverse proxy before it, or empty. csrf_matches: whether a token is the right one for the
    Cookie header of its request. token_of: finds a program's token in a header Authorization,
    which no page of another site can send. posted: paths to which other sites may post; what is
    posted there proves itself.
    """

    def __init__(
        self,
        app: ASGIApp,
        host_allowed: Callable[[str], bool],
        public_origin: str,
        csrf_matches: Callable[[str, str], bool],
        token_of: Callable[[str], str],
        posted: Collection[str] = (),
    ) -> None:
        self._app = app
        self._host_allowed = host_allowed
        self._public_origin = public_origin
        self._csrf_matches = csrf_matches
        self._token_of = token_of
        self._posted = frozenset(posted)

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Pass a request on, or refuse it."""
        if scope["type"] not in ("http", "websocket"):
            await self._app(scope, receive, send)
            return
        refusal = self._refusal(scope)
        if scope["type"] == "websocket":
            if refusal is not None:
                await send({"type": "websocket.close", "code": 1008, "reason": refusal[1].code})
                return
            await self._app(scope, receive, send)
            return

        async def send_with_headers(message: Message) -> None:
            if message["type"] == "http.response.start":
                headers = MutableHeaders(scope=message)
                for name, value in HEADERS.items():
                    headers.setdefault(name, value)
                # An answer is for this person alone unless its route says otherwise.
                headers.setdefault("Cache-Control", "no-store")
            await send(message)

        if refusal is not None:
            await problem(403, *refusal)(scope, receive, send_with_headers)
            return
        await self._app(scope, receive, send_with_headers)

    def _refusal(self, scope: Scope) -> tuple[str, Diagnostic] | None:
        """Return the kind and what is wrong where the request is refused."""
        headers = Headers(scope=scope)
        host = headers.get("host", "")
        if not self._host_allowed(without_port(host)):
            return "host", WRONG_HOST(host=host[:100])
        unsafe = scope["type"] == "websocket" or scope["method"] not in SAFE
        elsewhere = scope["type"] == "http" and scope["path"] in self._posted
        if not unsafe or elsewhere or self._is_program(scope, headers):
            return None
        origin = headers.get("origin", "")
        secure = scope.get("scheme") in ("https", "wss")
        own = f"{'https' if secure else 'http'}://{host}"
        if not origin or origin not in (own, self._public_origin):
            expected = self._public_origin or own
            return "origin", WRONG_ORIGIN(origin=origin[:100], expected=expected)
        if scope["type"] == "http" and not self._csrf_matches(
            headers.get(CSRF_HEADER, ""), headers.get("cookie", "")
        ):
            return "csrf", WRONG_CSRF()
        return None

    def _is_program(self, scope: Scope, headers: Headers) -> bool:
        begins = scope["path"] == BEGINS and not (headers.get("origin") or headers.get("cookie"))
        return begins or bool(self._token_of(headers.get("authorization", "")))


def without_port(host: str) -> str:
    """Return the name or address of a Host header, in lower case and without brackets.

    Empty for what is no host and port.
    """
    found = HOST.fullmatch(host)
    return "" if found is None else (found["address"] or found["name"]).lower()
