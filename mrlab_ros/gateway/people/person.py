"""The person that a request comes from.

How often somebody may try: buckets of tokens, one a subject. Pure; time is an argument.
"""

from __future__ import annotations

from collections import OrderedDict
from dataclasses import dataclass
from typing import Annotated, Protocol

from fastapi import Depends
from fastapi.requests import HTTPConnection

from mrlab_ros.core.bridge.rules import Role
from mrlab_ros.gateway.diagnostics import NOT_SIGNED_IN, TOO_MANY_REQUESTS
from mrlab_ros.gateway.errors import NotSignedIn, TooMany

# The one person of a lab without keys, on its own machine.
LOCAL = "local"


@dataclass(frozen=True)
class Person:
    """The person that a request comes from.

    name: what people read. sign_in: id of the sign-in; paired: it is a paired device's. id: owns
    things and bounds what one person does; no other person ever gets it, whatever their name.
    """

    name: str
    role: Role
    sign_in: str = ""
    paired: bool = False
    id: str = ""

    def __post_init__(self) -> None:
        object.__setattr__(self, "id", self.id or self.name)


class Knows(Protocol):
    """Knows people by their requests."""

    def known(self, connection: HTTPConnection) -> Person | None: ...


def known_person(connection: HTTPConnection) -> Person | None:
    """Return who is signed in, None where nobody is: a dependency of routes and sockets."""
    people: Knows = connection.app.state.people
    return people.known(connection)


def current_person(person: Annotated[Person | None, Depends(known_person)]) -> Person:
    """Return who is signed in, as a dependency of routes and sockets; raises NotSignedIn."""
    if person is None:
        raise NotSignedIn(NOT_SIGNED_IN())
    return person


KnownPerson = Annotated[Person | None, Depends(known_person)]
CurrentPerson = Annotated[Person, Depends(current_person)]


@dataclass(frozen=True)
class Limit:
    """`burst` attempts at once, then one every `period` s. what: a word of the code."""

    what: str
    burst: int
    period: float


class RateLimit:
    """Counts attempts by subject, such as an address or a name.

    It remembers at most `subjects` of them, the latest ones, so that it cannot be filled.
    """

    def __init__(self, limit: Limit, subjects: int = 10_000) -> None:
        self._limit = limit
        self._subjects = subjects
        # When the bucket of a subject is full again, s.
        self._full_at: OrderedDict[str, float] = OrderedDict()

    def check(self, subject: str, now: float) -> None:
        """Count an attempt at `now` (s, monotonic); raises TooMany where it is one too many."""
        limit = self._limit
        full_at = max(self._full_at.pop(subject, now), now)
        wait = full_at + limit.period - limit.period * limit.burst - now
        if wait > 0:
            self._full_at[subject] = full_at
            raise TooMany(TOO_MANY_REQUESTS(what=limit.what, wait=wait), wait)
        self._full_at[subject] = full_at + limit.period
        while len(self._full_at) > self._subjects:
            self._full_at.popitem(last=False)
