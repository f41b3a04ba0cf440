"""The gateway as a process of its own: HTTPS, guard, cookies, `mrlab users` beside it, its end.

There is no lab behind it: that is in test/node.
"""

from __future__ import annotations

import json
import re
import signal
import socket
import ssl
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from subprocess import TimeoutExpired
from typing import Any

import httpx
import in_process
import pytest
from child_process import start_child
from launched_lab import done
from own_port import free_endpoint
from websockets.exceptions import ConnectionClosed, InvalidStatus
from websockets.sync.client import ClientConnection, connect

from mrlab_ros.commands.up.web import opening_url
from mrlab_ros.core.base.errors import BadInput, Unavailable
from mrlab_ros.gateway.__main__ import WRONG_CONFIGURATION, serve, settings_of
from mrlab_ros.gateway.people.sign_ins import FILE

DEADLINE = 60.0
PASSWORD = "correct horse battery"
FOREIGN = "https://evil.example"


class Gateway:
    """A gateway on a free port, and what it prints."""

    def __init__(self, folder: Path, *options: str | Path) -> None:
        self.folder = folder
        self._log = folder / "gateway.log"
        with self._log.open("wb") as output:
            self.process = start_child(
                *(sys.executable, "-m", "mrlab_ros.gateway", "--http", "127.0.0.1:0"),
                *("--state-dir", str(folder), "--zenoh", free_endpoint()),
                *map(str, options),
                stdout=output,
                stderr=subprocess.STDOUT,
            )
        self.url = ""

    @property
    def said(self) -> str:
        return self._log.read_text()

    def wait(self) -> None:
        end = time.monotonic() + DEADLINE
        while not (found := re.search(r"serves the pages on (\S+)", self.said)):
            assert self.process.poll() is None, self.said
            assert time.monotonic() < end, self.said
            time.sleep(0.05)
        self.url = found[1]
        while True:
            with socket.socket() as probe:
                if probe.connect_ex(("127.0.0.1", int(self.url.rpartition(":")[2]))) == 0:
                    return
            assert time.monotonic() < end, self.said

    def send(
        self, browser: httpx.Client, method: str, path: str, **options: Any
    ) -> httpx.Response:
        """Send what a page of this gateway sends."""
        csrf = browser.get("/api/session").json()["csrf"]
        headers = {"origin": str(browser.base_url).rstrip("/"), "x-csrf-token": csrf}
        return browser.request(
            method, path, headers=headers | options.pop("headers", {}), **options
        )


@contextmanager
def running(folder: Path, *options: str | Path) -> Iterator[Gateway]:
    """Run a gateway that answers."""
    gateway = Gateway(folder, *options)
    try:
        gateway.wait()
        yield gateway
    finally:
        gateway.process.kill()
        gateway.process.wait()


@pytest.fixture
def own(tmp_path: Path) -> Iterator[Gateway]:
    """A gateway of one's own."""
    with running(tmp_path) as gateway:
        yield gateway


@pytest.fixture(scope="module")
def local(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Gateway]:
    """A gateway that several tests use."""
    with running(tmp_path_factory.mktemp("local")) as gateway:
        yield gateway


@pytest.fixture(scope="module")
def keys(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("lab") / "keys"
    done("keys", "init", "--dir", folder)
    return folder


@pytest.fixture(scope="module")
def secured(tmp_path_factory: pytest.TempPathFactory, keys: Path) -> Iterator[Gateway]:
    with running(tmp_path_factory.mktemp("secured"), "--keys", keys) as gateway:
        gateway.url = gateway.url.replace("127.0.0.1", "localhost")
        yield gateway


def browser_of(gateway: Gateway, keys: Path) -> httpx.Client:
    """Return a client that trusts the lab's authority and nobody else."""
    context = ssl.create_default_context(cafile=str(keys / "ca.pem"))
    return httpx.Client(base_url=gateway.url, verify=context, follow_redirects=True)


def refusal(response: httpx.Response) -> tuple[int, str]:
    return response.status_code, response.json()["error"]["code"]


def test_only_the_opened_browser_reaches_a_local_lab(local: Gateway) -> None:
    with httpx.Client(base_url=local.url, follow_redirects=True) as browser:
        assert refusal(browser.get("/api/devices")) == (401, "not_signed_in")
        browser.get(opening_url(local.url, local.folder / FILE))
        assert browser.get("/api/session").json()["user"]["name"] == "local"
        # A name that was made to point here, and a page of another site.
        for path in ("/", "/api/devices"):
            answer = browser.get(path, headers={"host": "evil.example"})
            assert refusal(answer) == (403, "wrong_host")
        foreign = local.send(browser, "DELETE", "/api/session", headers={"origin": FOREIGN})
        assert refusal(foreign) == (403, "wrong_origin")
        without = browser.delete("/api/session", headers={"origin": local.url})
        assert refusal(without) == (403, "wrong_csrf")
        assert local.send(browser, "DELETE", "/api/session").status_code == 204
        assert browser.get("/api/session").json()["user"] is None


def users(*words: str, keys: Path) -> subprocess.CompletedProcess[str]:
    """Run `mrlab users` in this process."""
    return in_process.mrlab("users", *words, "--dir", keys)


def test_people_sign_in_over_https_until_they_are_removed(secured: Gateway, keys: Path) -> None:
    (made,) = json.loads(
        done("users", "add", "anna", "--role", "student", "--dir", keys, "--json")
    )
    token = made["url"].rpartition("/")[2]
    assert made["url"].startswith("https://")
    with browser_of(secured, keys) as browser:
        answer = secured.send(
            browser, "POST", f"/api/invitations/{token}", json={"password": PASSWORD}
        )
        assert answer.json()["user"] == {"id": "anna", "name": "anna", "role": "student"}
        cookie = answer.headers["set-cookie"]
        assert cookie.startswith("__Host-mrlab-")
        assert {"HttpOnly", "Secure", "SameSite=strict"} <= set(cookie.split("; "))
        assert users("role", "anna", "operator", keys=keys).returncode == 0
        assert browser.get("/api/session").json()["user"]["role"] == "operator"
        listed = users("list", keys=keys)
        assert listed.returncode == 0
        assert "operator" in listed.stdout
        assert users("remove", "anna", keys=keys).returncode == 0
        assert browser.get("/api/session").json()["user"] is None
        again = secured.send(
            browser, "POST", "/api/session", json={"name": "anna", "password": PASSWORD}
        )
        assert refusal(again) == (401, "wrong_password")
    for name, words in (("anna", "nobody called 'anna'"), ("ben", "nobody called 'ben'")):
        assert words in users("remove", name, keys=keys).stderr


def handshake(gateway: Gateway, browser: httpx.Client) -> dict[str, Any]:
    """Return the arguments of websockets' connect for a socket of this browser."""
    cookies = "; ".join(f"{cookie.name}={cookie.value}" for cookie in browser.cookies.jar)
    return {
        "uri": f"{gateway.url.replace('http', 'ws', 1)}/link",
        "subprotocols": ["mrlab.1"],
        "additional_headers": {"Cookie": cookies},
    }


def reason_of_end(link: ClientConnection) -> str:
    """Return the code of why the gateway ends a socket."""
    said = ""
    try:
        while True:
            frame = link.recv(DEADLINE)
            if isinstance(frame, str) and (text := json.loads(frame))["op"] == "closing":
                said = text["diagnostic"]["code"]
    except ConnectionClosed:
        return said


def test_a_sign_in_that_ends_closes_its_socket(local: Gateway) -> None:
    with httpx.Client(base_url=local.url, follow_redirects=True) as browser:
        browser.get(opening_url(local.url, local.folder / FILE))
        with (
            pytest.raises(InvalidStatus, match="403"),
            connect(**handshake(local, browser), origin=FOREIGN),
        ):
            pass
        own = handshake(local, browser) | {"origin": local.url}
        with connect(**own) as one, connect(**own) as two:
            for link in (one, two):
                # Compression was offered.
                assert link.protocol.extensions == []
                link.send(json.dumps({"op": "hello"}))
                assert json.loads(link.recv(DEADLINE))["op"] == "welcome"
            assert local.send(browser, "DELETE", "/api/session").status_code == 204
            for link in (one, two):
                assert reason_of_end(link) == "sign_in_ended"
        with connect(**own) as late:
            assert reason_of_end(late) == "not_signed_in"


def test_who_does_not_trust_the_authority_does_not_connect(secured: Gateway) -> None:
    with pytest.raises(httpx.ConnectError, match="CERTIFICATE_VERIFY_FAILED"):
        httpx.get(secured.url)


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_it_ends_when_it_is_asked_to(own: Gateway, number: signal.Signals) -> None:
    with httpx.Client(base_url=own.url) as browser:
        browser.get("/healthz")
        own.process.send_signal(number)
        # Of a terminal's Ctrl-C a launcher sends another one.
        with suppress(TimeoutExpired):
            own.process.wait(0.02)
        own.process.send_signal(number)
        assert own.process.wait(DEADLINE) in (0, -number)
    assert "Traceback" not in own.said
    assert "ERROR" not in own.said


def test_a_wrong_configuration_is_one_sentence(tmp_path: Path) -> None:
    gateway = Gateway(tmp_path, "--oidc", "/nowhere.yaml")
    assert gateway.process.wait(DEADLINE) == WRONG_CONFIGURATION
    assert "/nowhere.yaml cannot be read" in gateway.said
    assert gateway.said.count("\n") == 1


@pytest.mark.parametrize(
    ("options", "values"),
    [
        (("--http", "0.0.0.0:0"), {"host": "0.0.0.0", "port": 0}),
        (("--http", "127.0.0.1:port"), {"address": "127.0.0.1:port"}),
        (("--allow-list", "/nowhere.yaml"), {"path": "/nowhere.yaml"}),
        (("--keys", "/nowhere"), {"path": "/nowhere/server.pem"}),
    ],
)
def test_each_wrong_configuration_is_refused_for_good(
    tmp_path: Path, options: tuple[str, ...], values: dict[str, object]
) -> None:
    given = {"--http": "127.0.0.1:0", "--state-dir": str(tmp_path), "--zenoh": free_endpoint()}
    given.update([options])
    with pytest.raises(BadInput) as refused:
        serve(settings_of([word for option in given.items() for word in option]))
    # A supervisor starts again what another program's port ends.
    assert not isinstance(refused.value, Unavailable)
    assert values.items() <= dict(refused.value.diagnostic.values).items()


def test_a_port_in_use_says_what_to_do(local: Gateway, tmp_path: Path) -> None:
    where = local.url.removeprefix("http://")
    other = Gateway(tmp_path, "--http", where)
    # Not lasting: the other program may end.
    assert other.process.wait(DEADLINE) == 1
    assert "Address already in use" in other.said
    assert "try: mrlab up --http" in other.said
    refused = in_process.mrlab("up", "--http", where)
    assert refused.returncode == 1
    assert "Address already in use" in refused.stderr
