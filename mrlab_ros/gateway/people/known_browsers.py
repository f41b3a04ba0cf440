"""Device cookies: attempts to sign in that one browser has for itself.

A cookie is a random number and the signature of it and of the name, as OWASP describes it. It
signs nobody in; wrong passwords in other browsers do not slow down a browser in which that person
has signed in before.
"""

from __future__ import annotations

import hashlib
import hmac
import secrets

LIFETIME_S = 365 * 24 * 3600.0


class KnownBrowsers:
    """Signs and checks device cookies with the secret of the lab."""

    def __init__(self, secret: bytes) -> None:
        self._secret = secret

    def new(self, name: str) -> str:
        """Return the value of a cookie for a browser in which `name` has signed in."""
        number = secrets.token_hex(16)
        return f"{number}.{self._signature(name, number)}"

    def number(self, name: str, cookie: str) -> str:
        """Return the number of a browser in which `name` has signed in; empty: it is unknown."""
        number, _, signature = cookie.partition(".")
        expected = self._signature(name, number).encode()
        return number if hmac.compare_digest(signature.encode(errors="replace"), expected) else ""

    def _signature(self, name: str, number: str) -> str:
        signed = f"device cookie\n{name.lower()}\n{number}".encode(errors="replace")
        return hmac.new(self._secret, signed, hashlib.sha256).hexdigest()
