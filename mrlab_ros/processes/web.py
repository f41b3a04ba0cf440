"""The gateway as a process of the lab: a program of its own, no ROS node."""

from __future__ import annotations

import socket
from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING
from urllib.parse import urlsplit

from mrlab_ros.adapters.sandbox import python_process
from mrlab_ros.core.bridge.links import from_here
from mrlab_ros.core.runtime.process_states import GATEWAY
from mrlab_ros.processes.child_process import ProcessSpec
from mrlab_ros.processes.options import LabOptions

if TYPE_CHECKING:
    import ssl

GATEWAY_MODULE = "mrlab_ros.gateway"
ZENOH = "tcp/127.0.0.1:7447"
ZENOH_WITH_KEYS = "tls/localhost:7447"
# One request to a gateway of this machine, s.
HEALTH_TIMEOUT_S = 2.0


@dataclass(frozen=True)
class GatewayProcess:
    """The process that serves the pages."""

    name: str = GATEWAY
    nodes: tuple[str, ...] = ()

    def wanted(self, options: LabOptions) -> bool:
        """Return whether a lab with these options has pages: without a bridge there is no lab."""
        return options.web is not None and options.bridge

    @property
    def beside(self) -> str:
        """The process on whose machine it runs."""
        return "bridge"

    def arguments(self, options: LabOptions) -> tuple[str, ...]:
        """Return the gateway's command line."""
        from mrlab_ros.processes.parameter_file import parameter  # not for a mere list of names

        web = options.web
        assert web is not None
        keys = options.keys.expanduser().resolve() if options.keys is not None else None
        https = keys is not None or web.certificate is not None
        host = f"[{web.host}]" if ":" in web.host else web.host
        given: dict[str, object] = {
            "http": f"{host}:{web.port}",
            "state_dir": options.state_dir,
            "zenoh": zenoh_endpoint(options),
            "zenoh_config": keys / "gateway.json5" if keys is not None else None,
            "keys": keys,
            "prefix": parameter(options.config, "bridge", "prefix"),
            "allow_list": parameter(options.config, "bridge", "allow_list"),
            "certificate": web.certificate,
            "certificate_key": web.certificate_key,
            "public_url": web.public_url,
            "oidc": web.oidc,
            "limits": web.limits,
            "classroom": web.classroom,
            "lti": web.lti,
            "store": options.store or parameter(options.config, "converter", "store"),
        }
        arguments = [
            word
            for name, value in given.items()
            if value
            for word in (f"--{name.replace('_', '-')}", str(value))
        ]
        if options.insecure and not (https or web.public_url):
            arguments.append("--insecure")
        return tuple(arguments)

    def command(self, options: LabOptions) -> tuple[str, ...]:
        """Return the program and its arguments."""
        return python_process.command(GATEWAY_MODULE, *self.arguments(options))

    def spec(self, options: LabOptions) -> ProcessSpec:
        """Return the process as the supervisor starts it."""
        env = {"PYTHONUNBUFFERED": "1"}
        return ProcessSpec(
            self.name, self.command(options), env, unblocks_sigint=True, module=GATEWAY_MODULE
        )


def zenoh_endpoint(options: LabOptions) -> str:
    """Return where the gateway reaches the lab's keys: the router, or the bridge itself."""
    if options.connect:
        return options.connect
    listen = options.listen
    if not listen:
        from mrlab_ros.processes.parameter_file import parameter

        listed = parameter(options.config, "bridge", "listen")
        first = listed[0] if isinstance(listed, list) and listed else ""
        listen = first if "/" in str(first) else ""
    return from_here(listen or (ZENOH if options.keys is None else ZENOH_WITH_KEYS))


def web_address(options: LabOptions) -> str:
    """Return the address of the gateway as this machine reaches it, without a slash at its end."""
    web = options.web
    assert web is not None
    https = options.keys is not None or web.certificate is not None
    everywhere = web.host in ("0.0.0.0", "::")
    # The name is in the certificate of a keys folder.
    host = ("localhost" if https else "127.0.0.1") if everywhere else web.host
    host = f"[{host}]" if ":" in host else host
    return f"{'https' if https else 'http'}://{host}:{web.port}"


def gateway_answers(address: str) -> Callable[[], bool]:
    """Return a function that asks a gateway of this machine for its health.

    By a socket of its own: http.client and what it imports take a tenth of `mrlab status`.
    """
    where = urlsplit(address)
    secure = where.scheme == "https"
    context = _unverified() if secure else None
    host = where.hostname or "127.0.0.1"
    port = where.port or (443 if secure else 80)
    request = f"GET /healthz HTTP/1.0\r\nHost: {where.netloc}\r\n\r\n".encode()

    def answers() -> bool:
        try:
            with socket.create_connection((host, port), HEALTH_TIMEOUT_S) as connection:
                if context:
                    connection = context.wrap_socket(connection, server_hostname=host)
                with connection:
                    connection.sendall(request)
                    with connection.makefile("rb") as reader:
                        return reader.readline(64).split()[1:2] == [b"200"]
        except OSError:
            return False

    return answers


def _unverified() -> ssl.SSLContext:
    """Return a context for a gateway's own authority: it is only asked whether it is there."""
    import ssl  # a command of a lab without HTTPS need not wait for it

    # Without the machine's authorities, which take time to read.
    context = ssl.SSLContext(ssl.PROTOCOL_TLS_CLIENT)
    context.check_hostname = False
    context.verify_mode = ssl.CERT_NONE
    return context
