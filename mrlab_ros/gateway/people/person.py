"""Who a request comes from."""

from __future__ import annotations

from dataclasses import dataclass

from fastapi.requests import HTTPConnection

from mrlab_ros.core.bridge.rules import Role
from mrlab_ros.gateway.errors import NotSignedIn

# The one person of a lab without keys, on its own machine.
LOCAL = "local"


@dataclass(frozen=True)
class Person:
    """Who a request comes from; the name scopes what is one's own."""

    name: str
    role: Role


def known_person(connection: HTTPConnection) -> Person | None:
    """Return who is signed in, None where nobody is: a dependency of routes and sockets."""
    if connection.app.state.settings.signs_in:
        return None
    return Person(LOCAL, Role.INSTRUCTOR)


def current_person(connection: HTTPConnection) -> Person:
    """Return who is signed in, as a dependency of routes and sockets; raises NotSignedIn."""
    person = known_person(connection)
    if person is None:
        raise NotSignedIn("nobody is signed in; sign in first")
    return person
