"""A gateway in a process of its own, with its local user signed in."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

import httpx
from partner import free_port, program, until

from mrlab_ros.commands.up.web import opening_url, users_file

# For one request, s.
REQUEST_S = 60.0


@dataclass(frozen=True)
class Gateway:
    """A gateway, and its local user's client. pid: of the gateway's process."""

    client: httpx.Client
    url: str
    state: Path
    pid: int

    def opening(self) -> str:
        """Return an address that signs the local user in, once."""
        return opening_url(self.url, users_file(self.state, None))

    def cookie(self) -> str:
        """Sign in; return the cookie of that."""
        answer = httpx.get(self.opening())
        return answer.headers["set-cookie"].partition(";")[0]

    def answers(self) -> bool:
        try:
            return self.client.get("/healthz").is_success
        except httpx.HTTPError:
            return False


@contextmanager
def gateway(state: Path, zenoh: str, *options: object) -> Iterator[Gateway]:
    """Run a gateway over a lab's state folder; its client is signed in."""
    port = free_port()
    url = f"http://127.0.0.1:{port}"
    command = (
        *(sys.executable, "-m", "mrlab_ros.gateway", "--http", f"127.0.0.1:{port}"),
        *("--state-dir", state, "--zenoh", zenoh, *options),
    )
    with (
        program(*command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) as process,
        httpx.Client(base_url=url, timeout=REQUEST_S, follow_redirects=True) as client,
    ):
        found = Gateway(client, url, state, process.pid)
        until(found.answers, "the gateway")
        client.get(found.opening())
        yield found
