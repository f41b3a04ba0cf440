"""Pairing of a device without a keyboard, as in RFC 8628. Pure; time is an argument.

The headset shows a code and a QR code. Somebody who is signed in types or scans it and chooses a
role; the headset, which asks again and again with its secret, is then signed in.
"""

from __future__ import annotations

import secrets
from dataclasses import dataclass

from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.bridge.rules import Role
from mrlab_ros.gateway.errors import NotAllowed, NotFound, TooMany
from mrlab_ros.gateway.people.diagnostics import (
    CODES_WRONG,
    DEVICE_LETS_IN,
    DEVICES_FULL,
    NO_DEVICE_SHOWS,
    PAIRED_ROLE_TOO_HIGH,
    PAIRING_ENDED,
)
from mrlab_ros.gateway.people.person import Person
from mrlab_ros.gateway.people.sign_ins import new_secret

# RFC 8628 6.1: letters that make no words and are not mistaken for each other.
LETTERS = "BCDFGHJKLMNPQRSTVWXZ"
LENGTH = 8
LIFETIME_S = 120.0
# Codes that one person may get wrong within LIFETIME_S.
TRIES = 5
# Devices that may wait at once.
WAITING = 200


@dataclass
class Pairing:
    """A device that waits; granted: who approved it, and as what. program: it keeps no cookie."""

    code: str
    secret: str
    device: str
    expires: float
    program: bool
    granted: tuple[Person, Role] | None = None


class Pairings:
    """The devices that wait to be paired. Times are s, monotonic."""

    def __init__(self) -> None:
        self._waiting: dict[str, Pairing] = {}
        self._wrong: dict[str, list[float]] = {}

    def begin(self, device: str, now: float, *, program: bool = False) -> Pairing:
        """Have a device or a program wait; raises TooMany where WAITING do already."""
        self._forget(now)
        if len(self._waiting) >= WAITING:
            raise TooMany(DEVICES_FULL(), LIFETIME_S)
        code = ""
        while not code or code in (pairing.code for pairing in self._waiting.values()):
            code = "".join(secrets.choice(LETTERS) for _ in range(LENGTH))
        pairing = Pairing(code, new_secret(), device, now + LIFETIME_S, program)
        self._waiting[pairing.secret] = pairing
        return pairing

    def waiting(self, code: str, person: Person, now: float) -> Pairing:
        """Return the device that shows `code`.

        Raises NotFound where none does, TooMany where `person` was wrong TRIES times.
        """
        self._forget(now)
        wrong = self._wrong.get(person.id, [])
        if len(wrong) >= TRIES:
            raise TooMany(CODES_WRONG(count=TRIES), wrong[0] + LIFETIME_S - now)
        plain = normal(code)
        for pairing in self._waiting.values():
            if secrets.compare_digest(pairing.code, plain) and pairing.granted is None:
                return pairing
        self._wrong[person.id] = [*wrong, now]
        raise NotFound(
            NO_DEVICE_SHOWS(shown=shown(plain[:LENGTH]), minutes=round(LIFETIME_S / 60))
        )

    def approve(self, code: str, person: Person, role: Role, now: float) -> Pairing:
        """Let the device that shows `code` in, for `person` and as `role`.

        Raises BadInput where that is more than the person may do, NotAllowed where a device asks.
        """
        if person.paired:
            raise NotAllowed(DEVICE_LETS_IN())
        pairing = self.waiting(code, person, now)
        if not person.role.may(role):
            own = person.role.value
            raise BadInput(PAIRED_ROLE_TOO_HIGH(person=person.name, role=own, wanted=role.value))
        pairing.granted = (person, role)
        return pairing

    def collect(self, secret: str, now: float) -> Pairing | None:
        """Return the device once it was approved, and forget it; None while it waits.

        Raises NotFound where it has waited too long.
        """
        self._forget(now)
        pairing = self._waiting.get(secret)
        if pairing is None:
            raise NotFound(PAIRING_ENDED())
        if pairing.granted is None:
            return None
        return self._waiting.pop(secret)

    def _forget(self, now: float) -> None:
        self._waiting = {s: p for s, p in self._waiting.items() if p.expires > now}
        recent = {n: [t for t in w if t + LIFETIME_S > now] for n, w in self._wrong.items()}
        self._wrong = {name: times for name, times in recent.items() if times}


def normal(code: str) -> str:
    """Return a code as it is compared: upper case, without what divides it."""
    return "".join(letter for letter in code.upper() if letter.isascii() and letter.isalnum())


def shown(code: str) -> str:
    """Return a code as people read it: BCDF-GHJK."""
    return f"{code[: LENGTH // 2]}-{code[LENGTH // 2 :]}"
