"""Sign-in by a fake OpenID Connect provider."""

from __future__ import annotations

import base64
import hashlib
import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any
from urllib.parse import parse_qs, urlsplit

import httpx
import pytest
from gateway_side import Browser, Gateway, code_of
from joserfc import jwk, jwt

from mrlab_ros.core.base.errors import BadInput, Unavailable
from mrlab_ros.core.bridge.rules import Role
from mrlab_ros.gateway.errors import NotAllowed, TooMany
from mrlab_ros.gateway.people.accounts import plain_name
from mrlab_ros.gateway.people.oidc import (
    PENDING_LIFETIME_S,
    NotBegun,
    NotConfirmed,
    Provider,
    read_provider,
)

ROOT = Path(__file__).parents[4]
ISSUER = "https://id.uni.example"


class FakeProvider:
    """A provider in memory: what `claims` say is put over the right ones."""

    def __init__(self) -> None:
        self.key = jwk.ECKey.generate_key("P-256", {"kid": "one", "use": "sig"})
        self.signs_with = self.key
        self.claims: dict[str, Any] = {}
        self.asked: dict[str, str] = {}
        self.down = False

    def __call__(self, request: httpx.Request) -> httpx.Response:
        if self.down:
            raise httpx.ConnectError("no route to host")
        path = request.url.path
        if path == "/.well-known/openid-configuration":
            return httpx.Response(200, json={
                "issuer": ISSUER,
                "authorization_endpoint": f"{ISSUER}/auth",
                "token_endpoint": f"{ISSUER}/token",
                "jwks_uri": f"{ISSUER}/keys",
            })  # fmt: skip
        if path == "/keys":
            return httpx.Response(200, json={"keys": [self.key.as_dict(private=False)]})
        assert path == "/token"
        sent = {name: values[0] for name, values in parse_qs(request.content.decode()).items()}
        challenge = hashlib.sha256(sent["code_verifier"].encode()).digest()
        if (
            base64.urlsafe_b64encode(challenge).decode().rstrip("=")
            != self.asked["code_challenge"]
        ):
            return httpx.Response(400, json={"error": "invalid_grant"})
        claims = {
            "iss": ISSUER, "aud": "lab", "sub": "42", "exp": 4_000_000_000,
            "nonce": self.asked["nonce"], "preferred_username": "anna@uni.example",
            "email": "anna@uni.example", "email_verified": True, **self.claims,
        }  # fmt: skip
        token = jwt.encode({"alg": "ES256", "kid": "one"}, claims, self.signs_with)
        return httpx.Response(
            200, json={"access_token": "a", "token_type": "Bearer", "id_token": token}
        )


@pytest.fixture
def provider() -> FakeProvider:
    return FakeProvider()


@pytest.fixture
def lab(tmp_path: Path, provider: FakeProvider) -> Iterator[Gateway]:
    settings = Provider(ISSUER, "lab", "secret", emails="*@uni.example")
    chosen = (settings, httpx.MockTransport(provider))
    # The file is not read where the port is given.
    with Gateway(
        tmp_path, public_url="https://lab.example.org", provider=chosen, oidc=Path("oidc.yaml")
    ) as gateway:
        yield gateway


def problem_of(browser: Browser, url: str) -> str:
    """Return with which word a browser is led back to the page of signing in."""
    response = browser.get(url, follow_redirects=False)
    assert response.status_code == 303, response.text
    page, _, problem = response.headers["location"].partition("?problem=")
    assert page == "/sign-in"
    return problem


def begin(browser: Browser, provider: FakeProvider) -> str:
    response = browser.get("/api/oidc/start", follow_redirects=False)
    assert response.status_code == 303, response.text
    url = urlsplit(response.headers["location"])
    assert f"{url.scheme}://{url.netloc}{url.path}" == f"{ISSUER}/auth"
    provider.asked = {name: values[0] for name, values in parse_qs(url.query).items()}
    assert provider.asked["redirect_uri"] == "https://lab.example.org/api/oidc/callback"
    assert provider.asked["code_challenge_method"] == "S256"
    return f"/api/oidc/callback?code=xyz&state={provider.asked['state']}"


def test_a_new_person_is_a_student_and_comes_back_as_the_same(lab, provider) -> None:
    for _ in range(2):
        browser = lab.browser()
        back = browser.get(begin(browser, provider), follow_redirects=False)
        assert (back.status_code, back.headers["location"]) == (303, "/"), back.text
        assert browser.user == {"id": "anna", "name": "anna", "role": "student"}
        provider.claims = {"preferred_username": "renamed"}
        lab.people.accounts.set_role("anna", Role.STUDENT)
    assert [account.signs_in for account in lab.people.accounts.all()] == ["oidc"]


def test_who_has_the_name_already_keeps_it(lab, provider) -> None:
    lab.browser("anna", Role.INSTRUCTOR)
    browser = lab.browser()
    browser.get(begin(browser, provider))
    assert browser.user == {"id": "anna-2", "name": "anna-2", "role": "student"}


@pytest.mark.parametrize(
    "claims",
    [
        {"iss": "https://evil.example"}, {"aud": "other"}, {"nonce": "old"}, {"exp": 1_000_000},
        {"sub": None}, {"email": "eve@evil.example"}, {"email_verified": False}, {"email": None},
    ],
)  # fmt: skip
def test_a_token_that_is_not_for_here_signs_nobody_in(lab, provider, claims) -> None:
    provider.claims = claims
    browser = lab.browser()
    assert problem_of(browser, begin(browser, provider)) in ("not_confirmed", "not_allowed")
    assert browser.user is None
    assert lab.people.accounts.all() == []


def test_a_token_of_a_foreign_key_signs_nobody_in(lab, provider) -> None:
    provider.signs_with = jwk.ECKey.generate_key("P-256", {"kid": "one"})
    browser = lab.browser()
    assert problem_of(browser, begin(browser, provider)) == "not_confirmed"


def test_only_the_browser_that_began_comes_back_in_time_and_once(lab, provider) -> None:
    mine, other = lab.browser(), lab.browser()
    back = begin(mine, provider)
    assert problem_of(other, back) == "not_begun"
    assert mine.get(back, follow_redirects=False).status_code == 303
    assert problem_of(mine, back) == "not_begun"
    late = begin(mine, provider)
    lab.clock.now += PENDING_LIFETIME_S + 1
    assert problem_of(mine, late) == "not_begun"


def test_a_provider_that_is_down_is_named_in_the_log(lab, provider, caplog) -> None:
    provider.down = True
    assert problem_of(lab.browser(), "/api/oidc/start") == "unavailable"
    assert ISSUER in caplog.text


def test_each_problem_has_a_sentence_on_the_page() -> None:
    words = (ROOT / "web" / "src" / "words" / "en.ts").read_text()
    for kind in (NotBegun, NotConfirmed, NotAllowed, TooMany, Unavailable):
        assert f"      {getattr(kind, 'code', 'unavailable')}: '" in words


def test_without_a_provider_there_is_nothing_to_begin(class_lab: Gateway) -> None:
    assert code_of(class_lab.browser().get("/api/oidc/start")) == (404, "no_provider")


def test_the_file_names_its_mistakes(tmp_path: Path) -> None:
    file = tmp_path / "oidc.yaml"
    file.write_text(json.dumps({"issuer": ISSUER, "client_id": "lab", "role": "operator"}))
    assert read_provider(file) == Provider(ISSUER, "lab", role=Role.OPERATOR)
    file.write_text(json.dumps({"issuer": "uni", "clientid": "lab"}))
    with pytest.raises(BadInput, match="issuer") as refused:
        read_provider(file)
    assert "clientid" in str(refused.value)


@pytest.mark.parametrize(
    ("text", "name"),
    [
        ("anna@uni.example", "anna"), ("Ä b/c", "A_b_c"), ("local", "person-local"),
        ("@", "person"), ("x" * 80, "x" * 41),
    ],
)  # fmt: skip
def test_names_become_such_as_this_lab_takes(text: str, name: str) -> None:
    assert plain_name(text) == name
