"""A gateway in this process, and clients that behave as a browser does."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import argon2
import httpx
from fastapi import FastAPI
from fastapi.testclient import TestClient

from mrlab_ros.core.bridge.rules import Role
from mrlab_ros.gateway.app import create_app
from mrlab_ros.gateway.people.accounts import Passwords
from mrlab_ros.gateway.people.oidc import Oidc
from mrlab_ros.gateway.people.people import People
from mrlab_ros.gateway.ports import Ports
from mrlab_ros.gateway.settings import Settings

PASSWORD = "correct horse battery"


class Clock:
    """A clock that tests move by hand, s."""

    def __init__(self) -> None:
        self.now = 1_790_000_000.0

    def __call__(self) -> float:
        return self.now


def quick_passwords() -> Passwords:
    """Return a hasher that takes no time; the parameters are in the hash."""
    return Passwords(argon2.PasswordHasher(time_cost=1, memory_cost=8, parallelism=1))


class Gateway:
    """A gateway with fakes; `browser` opens clients of it. Use it as a context manager."""

    def __init__(self, folder: Path, **options: Any) -> None:
        ports = {
            name: options.pop(name) for name in ("lab", "store", "checker") if name in options
        }
        provider = options.pop("provider", None)
        # Without a signing-in setting there is one local user.
        self.settings = Settings(state_dir=folder / "state", **options)
        self.clock = Clock()
        self.people = People(
            self.settings, passwords=quick_passwords(), clock=self.clock, steady=self.clock
        )
        oidc = None
        if provider is not None:
            oidc = Oidc(provider[0], transport=provider[1], steady=self.clock)
        made = Ports(people=self.people, oidc=oidc, **ports)
        self.app: FastAPI = create_app(self.settings, made)
        self.url = self.settings.public_url or "http://localhost:8080"
        self._entered: list[TestClient] = []
        self.anyone = Browser(self)

    def __enter__(self) -> Gateway:
        self.anyone.http.__enter__()
        return self

    def __exit__(self, *error: object) -> None:
        self.anyone.http.__exit__()

    def browser(self, name: str = "", role: Role = Role.STUDENT) -> Browser:
        """Return a browser; with a name, that person is added and signed in."""
        browser = Browser(self)
        if name:
            self.people.accounts.add(name, role)
            secret = self.people.accounts.invite(name, self.clock())
            self.people.accounts.accept(secret, PASSWORD, self.clock())
            assert browser.sign_in(name).status_code == 200
        return browser

    def local(self) -> Browser:
        """Return the browser of the local user, who opened the link."""
        browser = Browser(self)
        token = self.people.accounts.open(self.clock())
        assert browser.get(f"/?token={token}").status_code in (200, 503)
        return browser


class Browser:
    """Sends what a page of this gateway sends: its Origin and the CSRF token."""

    def __init__(self, gateway: Gateway) -> None:
        self.gateway = gateway
        self.http = TestClient(gateway.app, base_url=gateway.url)

    def sign_in(self, name: str, password: str = PASSWORD) -> httpx.Response:
        return self.send("POST", "/api/session", json={"name": name, "password": password})

    def get(self, path: str, **options: Any) -> Any:
        return self.http.get(path, **options)

    def send(self, method: str, path: str, **options: Any) -> Any:
        csrf = self.http.get("/api/session").json()["csrf"]
        headers = {"origin": self.gateway.url, "x-csrf-token": csrf}
        headers |= options.pop("headers", {})
        return self.http.request(method, path, headers=headers, **options)

    @property
    def user(self) -> Any:
        return self.get("/api/session").json()["user"]


def code_of(response: Any) -> tuple[int, str]:
    """Return the status and the code of an error."""
    return response.status_code, response.json()["error"]["code"]


def kind_of(response: Any) -> tuple[int, str]:
    """Return the status and the kind of an error, which clients steer by."""
    return response.status_code, response.json()["error"]["kind"]


def values_of(response: Any) -> dict[str, Any]:
    """Return the values of an error."""
    found: dict[str, Any] = response.json()["error"]["values"]
    return found
