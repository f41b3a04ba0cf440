"""A real S3 server in a process of its own: moto's, without a network beyond this machine."""

from __future__ import annotations

import os
import subprocess
import sys
import urllib.request
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from child_process import start_child
from graph import wait_for
from own_port import free_port

BUCKET = "lab"


class S3Server:
    """moto's server on a port that it keeps when it is started again."""

    def __init__(self) -> None:
        self.port = free_port()
        self.url = f"http://127.0.0.1:{self.port}"
        self.environment = {
            "AWS_ENDPOINT_URL": self.url,
            "AWS_ALLOW_HTTP": "true",
            "AWS_ACCESS_KEY_ID": "test",
            "AWS_SECRET_ACCESS_KEY": "test",
            "AWS_REGION": "us-east-1",
        }
        self._process: subprocess.Popen[Any] | None = None

    def start(self) -> None:
        argv = [sys.executable, "-m", "moto.server", "-H", "127.0.0.1", "-p", str(self.port)]
        quiet = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
        self._process = start_child(*argv, **quiet)
        wait_for(self._answers, "the S3 server", 60.0)
        self.ask("PUT", BUCKET)

    def kill(self) -> None:
        """Kill the server; moto keeps objects in memory, so they are gone as well."""
        if self._process is not None:
            self._process.kill()
            self._process.wait()

    def ask(self, method: str, path: str) -> bytes:
        """Send a request without obstore and return the answer's body."""
        request = urllib.request.Request(f"{self.url}/{path}", method=method)
        with urllib.request.urlopen(request, timeout=10) as answer:
            body: bytes = answer.read()
            return body

    def _answers(self) -> bool:
        try:
            return bool(self.ask("GET", "moto-api/data.json"))
        except OSError:
            return False


@contextmanager
def s3_server() -> Iterator[S3Server]:
    """Run a server with an empty bucket; its environment is this process' until the end."""
    server = S3Server()
    before = dict(os.environ)
    try:
        server.start()
        os.environ |= server.environment
        yield server
    finally:
        os.environ.clear()
        os.environ |= before
        server.kill()
