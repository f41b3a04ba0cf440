"""`mrlab up --keys` as an instructor runs it, and a client with the file it was given."""

from __future__ import annotations

import json
import ssl
import time
from collections.abc import Callable, Iterator
from contextlib import suppress
from pathlib import Path
from typing import Any

import httpx
import in_process
import pytest
import zenoh
from launched_lab import DEADLINE, done, launched_lab, mrlab
from own_port import free_endpoint, free_port


@pytest.fixture
def keys(tmp_path: Path) -> Path:
    folder = tmp_path / "keys"
    for words in (("init",), ("add", "anna", "--role", "display")):
        assert in_process.mrlab("keys", *words, "--dir", folder).returncode == 0
    return folder


@pytest.fixture
def endpoint(keys: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[str]:
    where = free_endpoint("tls")
    options = ("--keys", keys, "--zenoh-listen", where, "--robots", "ur5e")
    with launched_lab(tmp_path, monkeypatch, *options):
        yield where


def robots(config: zenoh.Config, endpoint: str) -> bytes:
    """Return the newest state of the robots, as soon as the bridge has one."""
    config.insert_json5("mode", '"client"')
    config.insert_json5("connect/endpoints", f'["{endpoint}"]')
    with zenoh.open(config) as session:
        end = time.monotonic() + DEADLINE
        while time.monotonic() < end:
            for reply in session.get("robots", timeout=5.0):
                if reply.ok and b"ur5e_1" in reply.ok.payload.to_bytes():
                    return reply.ok.payload.to_bytes()
    raise AssertionError("no state of the robots")


def patiently(call: Callable[[], Any], what: str = "the bridge") -> Any:
    """Return the first true value of `call`, which may fail while the bridge starts again."""
    end = time.monotonic() + DEADLINE
    while time.monotonic() < end:
        with suppress(zenoh.ZError):
            if value := call():
                return value
        time.sleep(0.05)
    raise AssertionError(f"waited {DEADLINE:g} s in vain for {what}")


def test_keys_are_given_and_taken_back_while_the_lab_runs(keys: Path, endpoint: str) -> None:
    with pytest.raises(zenoh.ZError, match="Unable to connect"):
        robots(zenoh.Config(), endpoint)
    kept = zenoh.Config.from_file(str(keys / "clients" / "anna.json5"))
    assert robots(kept, endpoint)
    with zenoh.open(kept) as anna:
        # In this order: where ben may see the robots, anna may no longer.
        assert mrlab("keys", "revoke", "anna", "--dir", keys).returncode == 0
        assert mrlab("keys", "add", "ben", "--role", "display", "--dir", keys).returncode == 0
        ben = zenoh.Config.from_file(str(keys / "clients" / "ben.json5"))
        assert patiently(lambda: robots(ben, endpoint))
        assert patiently(lambda: list(anna.info.peers_zid()), "anna's client to come back")
        assert not any(reply.ok for reply in anna.get("robots", timeout=5.0))


def test_people_reach_a_lab_with_keys_by_its_pages(
    keys: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The gateway has its own key, and people of its own sign in over HTTPS."""
    listen, http = free_endpoint("tls"), f"127.0.0.1:{free_port()}"
    options = ("--keys", keys, "--zenoh-listen", listen, "--http", http, "--robots", "ur5e")
    trusted = ssl.create_default_context(cafile=str(keys / "ca.pem"))
    with (
        launched_lab(tmp_path, monkeypatch, *options),
        httpx.Client(verify=trusted, follow_redirects=True) as browser,
    ):
        assert browser.get(f"https://{http}/assets/robots.json").status_code == 401
        browser.get(done("open", "--print").strip())
        assert browser.get(f"https://{http}/api/session").json()["user"]["name"] == "local"

        def robots_file() -> httpx.Response | None:
            answer = browser.get(f"https://{http}/assets/robots.json")
            return answer if answer.status_code == 200 else None

        assert "ur5e" in patiently(robots_file, "the assets").text
        (link,) = json.loads(done("users", "add", "ben", "--role", "student", "--json"))
        assert link["url"].startswith(f"https://{http}/invitation/")


def test_a_lab_that_may_not_listen_so_does_not_start(keys: Path) -> None:
    for arguments, words in (
        (("--zenoh-listen", "tcp/0.0.0.0:7447"), "try: mrlab keys init"),
        (("--zenoh-listen", "tcp/127.0.0.1:7447", "--keys", str(keys)), "leave the keys out"),
        (("--keys", str(keys / "clients")), "mrlab keys init"),
        (("--keys", str(keys), "--insecure"), "--keys and --insecure"),
    ):
        refused = in_process.mrlab("up", *arguments)
        assert refused.returncode == 1
        assert words in refused.stderr
