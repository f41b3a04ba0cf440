"""A `mrlab up` with pages for browser tests and screenshots; beside it a gateway with people."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import time
import urllib.error
import urllib.request
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

from child_process import start_child
from own_domain import own_domain
from own_port import free_endpoint, free_port

from mrlab_ros.core.bridge.rules import Role

MRLAB = (sys.executable, "-m", "mrlab_ros.cli")
# For a start and for an end, s.
DEADLINE = 90.0


@dataclass(frozen=True)
class ServedLab:
    """A lab with pages. url: of the pages; environment: of commands that talk to it."""

    url: str
    zenoh: str
    state: Path
    environment: dict[str, str]

    def signed_in_url(self, path: str = "/") -> str:
        """Return an address that signs one browser in, once."""
        return self.done("open", "--print", path).strip()

    def done(self, *arguments: str) -> str:
        """Run a command that has to succeed; return what it printed."""
        answer = subprocess.run(
            (*MRLAB, *arguments),
            env=self.environment,
            capture_output=True,
            text=True,
            timeout=DEADLINE,
            check=False,
        )
        assert answer.returncode == 0, answer.stdout + answer.stderr
        return answer.stdout


@dataclass(frozen=True)
class Gateway:
    """A gateway at which people sign in."""

    url: str
    state: Path

    def invite(self, name: str, role: Role) -> str:
        """Let somebody in; return the one-time link."""
        from mrlab_ros.gateway.people.accounts import Accounts
        from mrlab_ros.gateway.people.sign_ins import Database

        accounts = Accounts(Database(self.state / "users.sqlite"))
        accounts.add(name, role)
        return f"{self.url}/invitation/{accounts.invite(name, time.time())}"


@contextmanager
def process(log: Path, *argv: str, env: dict[str, str], ready: str) -> Iterator[None]:
    """Run a process until the block ends; it is ready when its page `ready` answers."""
    with log.open("wb") as output:
        started = start_child(*argv, env=env, stdout=output, stderr=subprocess.STDOUT)
    try:
        end = time.monotonic() + DEADLINE
        while not answers(ready):
            assert started.poll() is None, log.read_text()
            assert time.monotonic() < end, log.read_text()
            time.sleep(0.1)
        yield
    finally:
        started.send_signal(signal.SIGINT)
        try:
            started.wait(DEADLINE)
        finally:
            started.kill()
            started.wait()


def answers(url: str) -> bool:
    """Return whether a page is there."""
    try:
        with urllib.request.urlopen(url, timeout=2) as answer:
            return json.loads(answer.read()) is not None
    except (OSError, urllib.error.URLError, json.JSONDecodeError):
        return False


@contextmanager
def served_lab(folder: Path, *options: str) -> Iterator[ServedLab]:
    """Run a lab with one UR5e and its pages on free ports."""
    http, zenoh = free_port(), free_endpoint()
    state = folder / "state"
    url = f"http://127.0.0.1:{http}"
    command = (
        *(*MRLAB, "up", "--robots", "ur5e", "--http", f"127.0.0.1:{http}"),
        *("--zenoh-listen", zenoh, "--state-dir", str(state), *options),
    )
    log = folder / "up.log"
    with own_domain() as domain:
        environment = dict(
            os.environ,
            ROS_DOMAIN_ID=str(domain),
            ROS_AUTOMATIC_DISCOVERY_RANGE="LOCALHOST",
            XDG_RUNTIME_DIR=str(folder),
        )
        with process(log, *command, env=environment, ready=f"{url}/api/session"):
            end = time.monotonic() + DEADLINE
            while "is ready" not in log.read_text():
                assert time.monotonic() < end, log.read_text()
                time.sleep(0.1)
            yield ServedLab(url, zenoh, state, environment)


@contextmanager
def second_gateway(lab: ServedLab, folder: Path) -> Iterator[str]:
    """Run another gateway of a lab on the same state; yield its address."""
    url = f"http://127.0.0.1:{free_port()}"
    command = (
        *(sys.executable, "-m", "mrlab_ros.gateway", "--http", url.removeprefix("http://")),
        *("--zenoh", lab.zenoh, "--state-dir", str(lab.state)),
    )
    log = folder / "gateway.log"
    with process(log, *command, env=lab.environment, ready=f"{url}/api/session"):
        yield url


@contextmanager
def gateway_with_people(
    lab: ServedLab, folder: Path, port: int = 0, *options: str
) -> Iterator[Gateway]:
    """Run another gateway of a lab, with the lab's store and people of its own.

    port: 0: a free one. The same folder and port bring a gateway back that ended.
    """
    port = port or free_port()
    url = f"http://127.0.0.1:{port}"
    state = folder / "state"
    state.mkdir(exist_ok=True)
    command = (
        *(sys.executable, "-m", "mrlab_ros.gateway", "--http", f"127.0.0.1:{port}"),
        *("--public-url", url, "--zenoh", lab.zenoh, "--state-dir", str(state)),
        *options,
        *("--store", str(lab.state / "store")),
    )
    with process(
        folder / "gateway.log", *command, env=lab.environment, ready=f"{url}/api/session"
    ):
        yield Gateway(url, state)
