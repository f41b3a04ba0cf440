"""Who a request comes from."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, Protocol

from fastapi import Depends
from fastapi.requests import HTTPConnection

from mrlab_ros.core.bridge.rules import Role
from mrlab_ros.gateway.diagnostics import NOT_SIGNED_IN
from mrlab_ros.gateway.errors import NotSignedIn

# The one person of a lab without keys, on its own machine.
LOCAL = "local"


@dataclass(frozen=True)
class Person:
    """Who a request comes from. The name scopes what is one's own; sign_in: id of the sign-in."""

    name: str
    role: Role
    sign_in: str = ""


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
