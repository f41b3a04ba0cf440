"""Where `mrlab up` serves the pages, and by which addresses they are opened."""

from __future__ import annotations

import socket
from collections.abc import Iterator
from pathlib import Path

import pytest
from refusals import refused

from mrlab_ros.adapters.keys.folder import Keys, now
from mrlab_ros.commands.up.web import (
    checked_web,
    open_in_browser,
    opening_url,
    qr_lines,
    run_facts,
    say_where,
)
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.bridge.access import Login
from mrlab_ros.gateway.diagnostics import OPEN_TO_NETWORK
from mrlab_ros.gateway.people.accounts import Accounts
from mrlab_ros.gateway.people.sign_ins import FILE, Database
from mrlab_ros.processes.options import LabOptions


@pytest.fixture(scope="module")
def keys(tmp_path_factory: pytest.TempPathFactory) -> Keys:
    folder = tmp_path_factory.mktemp("lab") / "keys"
    return Keys.create(folder, ["lab.example.org"], Login.CERTIFICATE, now())


@pytest.fixture
def taken() -> Iterator[int]:
    with socket.socket() as listening:
        listening.bind(("127.0.0.1", 0))
        listening.listen()
        yield listening.getsockname()[1]


def test_a_port_that_is_taken_says_what_to_do(taken: int) -> None:
    with pytest.raises(BadInput, match=f"{taken}: Address already in use.*--http 127.0.0.1:"):
        checked_web(f"127.0.0.1:{taken}", keys=None)


def test_port_0_is_any_free_one() -> None:
    assert checked_web("127.0.0.1:0", keys=None).port > 0


def test_beyond_this_machine_it_needs_keys_or_insecure(keys: Keys) -> None:
    with refused(OPEN_TO_NETWORK, BadInput, host="0.0.0.0"):
        checked_web("0.0.0.0:0", keys=None)
    assert checked_web("0.0.0.0:0", keys=None, insecure=True).host == "0.0.0.0"
    assert checked_web("0.0.0.0:0", keys=keys.folder).host == "0.0.0.0"


def facts(tmp_path: Path, http: str, keys: Keys | None = None, **options) -> dict[str, object]:
    folder = keys.folder if keys is not None else None
    web = checked_web(http, keys=folder, **options)
    found = run_facts(LabOptions(tmp_path / "lab.yaml", tmp_path, keys=folder, web=web))
    return {name: str(value).replace(str(web.port), "PORT") for name, value in found.items()}


def test_without_keys_there_is_one_address(tmp_path: Path) -> None:
    here = "http://127.0.0.1:PORT"
    assert facts(tmp_path, "127.0.0.1:0") == {
        "here": here, "open": here, "address": here, "signs_in": "False",
        "users": str(tmp_path / FILE),
    }  # fmt: skip


def test_with_keys_people_come_by_the_first_host(tmp_path: Path, keys: Keys) -> None:
    here = "https://localhost:PORT"
    assert facts(tmp_path, "0.0.0.0:0", keys) == {
        "here": here, "open": here, "address": "https://lab.example.org:PORT", "signs_in": "True",
        "users": str(keys.folder / FILE),
    }  # fmt: skip


def test_a_certificate_of_ones_own_is_for_its_own_names(tmp_path: Path, keys: Keys) -> None:
    pair = {
        "certificate": keys.folder / "server.pem", "certificate_key": keys.folder / "server.key",
    }  # fmt: skip
    found = facts(tmp_path, "0.0.0.0:0", **pair)
    assert found["open"] == found["address"] == "https://lab.example.org:PORT"
    assert found["users"] == str(tmp_path / FILE)


def test_behind_a_proxy_its_address_counts(tmp_path: Path) -> None:
    found = facts(tmp_path, "127.0.0.1:0", public_url="https://lab.uni.example")
    assert found["open"] == found["address"] == "https://lab.uni.example"
    assert found["here"] == "http://127.0.0.1:PORT"
    assert found["signs_in"] == "True"


def test_the_printed_address_signs_in_once(tmp_path: Path) -> None:
    users, said = tmp_path / FILE, []
    web = {"open": "http://127.0.0.1:1", "here": "", "address": "https://l", "users": str(users)}
    say_where(web, lambda _, line: said.append(line))
    token = said[0].partition("?token=")[2]
    assert said[0].startswith("open the pages on this machine: http://127.0.0.1:1/?token=")
    assert said[1] == "everybody else: https://l"
    accounts = Accounts(Database(users))
    assert [accounts.opened(token, now().timestamp()) for _ in range(2)] == [True, False]
    assert opening_url("http://h", users, "/lab").startswith("http://h/lab?token=")


def test_a_qr_code_is_printed_in_half_blocks() -> None:
    lines = list(qr_lines("https://lab.example.org:8080"))
    assert len(lines) > 10
    assert all("\n" not in line for line in lines)


def test_without_a_display_nothing_is_opened(monkeypatch: pytest.MonkeyPatch) -> None:
    for name in ("DISPLAY", "WAYLAND_DISPLAY"):
        monkeypatch.delenv(name, raising=False)
    assert not open_in_browser("http://127.0.0.1:1")
