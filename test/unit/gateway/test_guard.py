"""The guard: Host, Origin, CSRF token, and the headers of every answer."""

from __future__ import annotations

import pytest
from gateway_side import Gateway, code_of
from starlette.websockets import WebSocketDisconnect

from mrlab_ros.gateway.guard import Hosts, without_port

OWN = "http://localhost:8080"


@pytest.mark.parametrize(
    "host",
    [
        "evil.example",
        "localhost.evil.example",
        "lab",
        "",
        "192.168.1.20",
        "127.0.0.1.nip.io",
        "127.0.0.1:8080@evil.example",
        "127.0.0.1:eighty",
    ],
)
def test_a_foreign_host_is_refused_everywhere(local_lab: Gateway, host: str) -> None:
    local = local_lab.local()
    for path in ("/", "/healthz", "/api/session", "/api/nothing"):
        assert code_of(local.get(path, headers={"host": host})) == (403, "wrong_host")


@pytest.mark.parametrize("host", ["localhost", "127.0.0.1:8080", "[::1]:9000", "LOCALHOST:1"])
def test_loopback_is_known_by_all_its_names_and_ports(local_lab: Gateway, host: str) -> None:
    assert local_lab.browser().get("/healthz", headers={"host": host}).status_code == 200


@pytest.mark.parametrize(
    "origin",
    [
        "https://evil.example", "http://localhost:3000", "https://localhost:8080", "null", "",
        "http://localhost:8080.evil.example", "http://localhost:8080/",
    ],
)  # fmt: skip
def test_unsafe_requests_of_another_origin_are_refused(local_lab: Gateway, origin: str) -> None:
    local = local_lab.local()
    response = local.send("DELETE", "/api/session", headers={"origin": origin})
    assert code_of(response) == (403, "wrong_origin")
    assert response.json()["error"]["values"]["expected"] == OWN
    assert local.user


def test_a_missing_origin_is_a_foreign_one(local_lab: Gateway) -> None:
    local = local_lab.local()
    csrf = local.get("/api/session").json()["csrf"]
    response = local.http.delete("/api/session", headers={"x-csrf-token": csrf})
    assert code_of(response) == (403, "wrong_origin")


@pytest.mark.parametrize("token", [None, "", "0" * 64, "é"])
def test_unsafe_requests_need_the_token_of_their_sign_in(local_lab, token) -> None:
    local = local_lab.local()
    headers = {"origin": OWN} | ({} if token is None else {"x-csrf-token": token.encode()})
    assert code_of(local.http.delete("/api/session", headers=headers)) == (403, "wrong_csrf")
    stranger = local_lab.browser().get("/api/session").json()["csrf"]
    headers["x-csrf-token"] = stranger
    assert code_of(local.http.delete("/api/session", headers=headers)) == (403, "wrong_csrf")
    assert local.user


def test_the_socket_has_the_same_guard(local_lab: Gateway) -> None:
    local = local_lab.local()
    for headers in (
        {},
        {"origin": "https://evil.example"},
        {"origin": OWN, "host": "evil.example"},
    ):
        socket = local.http.websocket_connect("/link", headers=headers)
        with pytest.raises(WebSocketDisconnect) as refused, socket:
            pass
        assert refused.value.code == 1008


@pytest.mark.parametrize("path", ["/", "/healthz", "/api/session", "/api/nothing", "/x.js"])
def test_every_answer_has_a_strict_policy(local_lab: Gateway, path: str) -> None:
    for host in ("localhost", "evil.example"):
        headers = local_lab.browser().get(path, headers={"host": host}).headers
        policy = dict(
            part.split(" ", 1) for part in headers["content-security-policy"].split("; ")
        )
        assert policy["default-src"] == "'none'"
        assert policy["script-src"] == "'self' 'wasm-unsafe-eval'"
        assert policy["frame-ancestors"] == policy["base-uri"] == "'none'"
        assert not any(word in str(policy) for word in ("unsafe-inline", "http:", "https:", "*"))
        assert headers["x-content-type-options"] == "nosniff"
        assert "server" not in headers


def test_what_is_about_a_person_is_not_cached(local_lab: Gateway) -> None:
    assert local_lab.local().get("/api/session").headers["cache-control"] == "no-store"


def test_a_proxys_origin_is_the_gateways_own(tmp_path) -> None:
    with Gateway(tmp_path, public_url="https://lab.example.org") as lab:
        assert lab.browser("anna").send("DELETE", "/api/session").status_code == 204
        assert lab.browser().get("/", headers={"host": "other.example.org"}).status_code == 403
        foreign = {"origin": "https://evil.example"}
        error = lab.browser("ben").send("DELETE", "/api/session", headers=foreign).json()["error"]
        assert error["values"]["expected"] == "https://lab.example.org"


def test_an_address_is_a_name_of_a_gateway_that_others_reach() -> None:
    for addresses in (True, False):
        hosts = Hosts(frozenset(), addresses)
        assert hosts.allows("192.168.1.20") is addresses
        assert not hosts.allows("evil.example")


def test_hosts_lose_their_ports() -> None:
    hosts = ("LAB:8080", "lab", "[::1]:80", "[fe80::1]", "10.0.0.1:1", "")
    assert [without_port(host) for host in hosts] == [
        "lab", "lab", "::1", "fe80::1", "10.0.0.1", "",
    ]  # fmt: skip
