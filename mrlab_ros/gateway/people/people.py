"""Everything about people in one place: accounts, sign-ins, pairing, limits, and the cookie."""

from __future__ import annotations

import asyncio
import ipaddress
import time
from collections.abc import Callable
from http.cookies import CookieError, SimpleCookie
from typing import Annotated

from fastapi import Depends, Response
from fastapi.requests import HTTPConnection

from mrlab_ros.core.bridge.rules import Role
from mrlab_ros.gateway.people.accounts import Accounts, Passwords
from mrlab_ros.gateway.people.known_browsers import LIFETIME_S as BROWSER_LIFETIME_S
from mrlab_ros.gateway.people.known_browsers import KnownBrowsers
from mrlab_ros.gateway.people.pairing import Pairings
from mrlab_ros.gateway.people.person import LOCAL, Limit, Person, RateLimit
from mrlab_ros.gateway.people.sign_ins import (
    DEVICE_LIFETIME_S,
    FILE,
    FOLLOW_PERIOD_S,
    LIFETIME_S,
    TOKEN_PREFIX,
    Database,
    SignIns,
    new_token,
)
from mrlab_ros.gateway.settings import Settings, is_loopback

SIGN_INS_BY_ADDRESS = Limit("sign_ins_by_address", 60, 2.0)
SIGN_INS_BY_NAME = Limit("sign_ins_by_name", 10, 15.0)
LINKS_BY_ADDRESS = Limit("links", 30, 2.0)
PAIRINGS_BY_ADDRESS = Limit("pairings", 10, 10.0)


class People:
    """The people of a gateway, and who a request comes from.

    clock: s since 1970; steady: s, monotonic.
    """

    def __init__(
        self,
        settings: Settings,
        *,
        passwords: Passwords | None = None,
        clock: Callable[[], float] = time.time,
        steady: Callable[[], float] = time.monotonic,
    ) -> None:
        self.settings = settings
        self.clock, self.steady = clock, steady
        self.database = Database((settings.keys or settings.state_dir) / FILE)
        self.accounts = Accounts(self.database, passwords or Passwords())
        self.sign_ins = SignIns(self.database)
        self.pairings = Pairings()
        self._browsers = KnownBrowsers(self.database.secret)
        self.sign_ins_by_address = RateLimit(SIGN_INS_BY_ADDRESS)
        self.sign_ins_by_name = RateLimit(SIGN_INS_BY_NAME)
        self.links_by_address = RateLimit(LINKS_BY_ADDRESS)
        self.pairings_by_address = RateLimit(PAIRINGS_BY_ADDRESS)
        # Cookies ignore ports, so several labs of one machine need names of their own. Browsers
        # take __Host- from this very host over HTTPS only, never from a neighbour of its domain.
        self.secure = settings.https or settings.public_url.startswith("https:")
        prefix = "__Host-" if self.secure else ""
        self.cookie = f"{prefix}mrlab-{self.database.lab_id}"
        self.browser_cookie = f"{prefix}mrlab-browser-{self.database.lab_id}"
        # With --insecure whoever reaches this gateway may do everything, as over zenoh.
        self._open = not settings.signs_in and not is_loopback(settings.host)

    def known(self, connection: HTTPConnection) -> Person | None:
        """Return who is signed in, None where nobody is."""
        if self._open:
            return Person(LOCAL, Role.INSTRUCTOR)
        token = token_of(connection.headers.get("authorization", ""))
        secret = token or self.secret(connection.headers.get("cookie", ""))
        return self.sign_ins.person(secret, self.clock()) if secret else None

    def secret(self, cookies: str) -> str:
        """Return the secret in a Cookie header; empty: there is none."""
        found = _value(cookies, self.cookie)
        # A token is a program's: its requests bring no CSRF token.
        return "" if found.startswith(TOKEN_PREFIX) else found

    def check_attempt(self, name: str, connection: HTTPConnection, now: float) -> None:
        """Count an attempt to sign in with a password; raises TooMany.

        A browser in which this person has signed in before has attempts of its own. Other attempts
        count for the address, and for the name at that address, so that nobody elsewhere locks
        the name.
        """
        place = self._known_browser(name, connection)
        if not place:
            place = address_of(connection)
            self.sign_ins_by_address.check(place, now)
        self.sign_ins_by_name.check(f"{name.lower()} {place}", now)

    def remember_browser(self, name: str, connection: HTTPConnection, response: Response) -> None:
        """Let the browser keep attempts of its own after its person has proved the password."""
        if not self._known_browser(name, connection):
            cookie = self._browsers.new(name)
            self._set_cookie(response, self.browser_cookie, cookie, BROWSER_LIFETIME_S)

    def _known_browser(self, name: str, connection: HTTPConnection) -> str:
        cookie = _value(connection.headers.get("cookie", ""), self.browser_cookie)
        return self._browsers.number(name, cookie)

    def csrf_matches(self, token: str, cookies: str) -> bool:
        """Return whether a CSRF token is the one for a Cookie header."""
        return self.sign_ins.csrf_matches(token, self.secret(cookies))

    def sign_in(
        self,
        response: Response,
        name: str,
        role: Role,
        *,
        device: str = "",
        let_in_by: str = "",
        lifetime: float = LIFETIME_S,
    ) -> str:
        """Sign somebody in with a cookie of `response`; return the new CSRF token."""
        secret = self.sign_ins.begin(
            name, role, self.clock(), device=device, let_in_by=let_in_by, lifetime=lifetime
        )
        self._set_cookie(response, self.cookie, secret, lifetime)
        return self.sign_ins.csrf(secret)

    def _set_cookie(self, response: Response, name: str, value: str, lifetime: float) -> None:
        response.set_cookie(
            name,
            value,
            max_age=int(lifetime),
            path="/",
            secure=self.secure,
            httponly=True,
            samesite="strict",
        )

    def program(
        self,
        name: str,
        role: Role,
        program: str,
        *,
        let_in_by: str = "",
        lifetime: float = DEVICE_LIFETIME_S,
    ) -> str:
        """Sign a program in; return its token, which is told once."""
        return self.sign_ins.begin(
            name,
            role,
            self.clock(),
            device=program,
            let_in_by=let_in_by,
            lifetime=lifetime,
            secret=new_token(),
        )

    def sign_out(self, response: Response, person: Person | None) -> None:
        """End the sign-in of a request, and its cookie."""
        if person is not None:
            self.sign_ins.end(person.sign_in)
        response.delete_cookie(
            self.cookie, path="/", secure=self.secure, httponly=True, samesite="strict"
        )

    async def follow(self) -> None:
        """End the sockets of sign-ins that have ended, until cancelled."""
        while True:
            await asyncio.sleep(FOLLOW_PERIOD_S)
            await self.sign_ins.check(self.clock())


def _value(cookies: str, name: str) -> str:
    """Return the value of a cookie in a Cookie header; empty: there is none."""
    try:
        found = SimpleCookie(cookies).get(name)
    except CookieError:
        return ""
    return "" if found is None else found.value


def token_of(authorization: str) -> str:
    """Return the token in a header Authorization; empty: there is none of a program."""
    scheme, _, token = authorization.partition(" ")
    token = token.strip()
    known = scheme.lower() == "bearer" and token.startswith(TOKEN_PREFIX)
    return token if known else ""


def people_of(connection: HTTPConnection) -> People:
    """Return the people of a gateway, as a dependency."""
    found: People = connection.app.state.people
    return found


def address_of(connection: HTTPConnection) -> str:
    """Return whom rate limits count as one client: an IPv4 address, or an IPv6 network of /64.

    One person's machine has as many addresses of such a network as it likes.
    """
    host = connection.client.host if connection.client else ""
    try:
        address = ipaddress.ip_address(host)
    except ValueError:
        return host
    if isinstance(address, ipaddress.IPv4Address):
        return host
    if address.ipv4_mapped is not None:
        return str(address.ipv4_mapped)
    return str(ipaddress.ip_network((address.packed, 64), strict=False))


ThePeople = Annotated[People, Depends(people_of)]
