"""Passwords: argon2id, with the parameters of RFC 9106 for little memory."""

from __future__ import annotations

import threading

from argon2 import PasswordHasher, profiles
from argon2.exceptions import Argon2Error, InvalidHashError

from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.gateway.people.diagnostics import PASSWORD_LENGTH

SHORTEST = 10
LONGEST = 200
# Each takes 64 MiB while it runs.
AT_ONCE = 2


class Passwords:
    """Makes and checks hashes of passwords; takes tens of milliseconds, so call it in a thread."""

    def __init__(self, hasher: PasswordHasher | None = None) -> None:
        self._hasher = hasher or PasswordHasher.from_parameters(profiles.RFC_9106_LOW_MEMORY)
        self._gate = threading.BoundedSemaphore(AT_ONCE)
        # Checked where there is no such person, so that both take equally long.
        self._nobody = self._hasher.hash("nobody")

    def hash(self, password: str) -> str:
        """Return the hash of a new password; raises BadInput where it is too short or long."""
        if not SHORTEST <= len(password) <= LONGEST:
            count = len(password)
            raise BadInput(PASSWORD_LENGTH(count=count, least=SHORTEST, most=LONGEST))
        with self._gate:
            return self._hasher.hash(password.encode(errors="surrogatepass"))

    def matches(self, stored: str | None, password: str) -> bool:
        """Return whether a password belongs to a stored hash; None: there is none."""
        with self._gate:
            try:
                self._hasher.verify(
                    stored or self._nobody, password[:LONGEST].encode(errors="surrogatepass")
                )
            except (Argon2Error, InvalidHashError):
                return False
        return stored is not None
