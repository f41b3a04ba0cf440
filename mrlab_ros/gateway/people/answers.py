"""Requests and answers of the routes of people."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import BaseModel, Field

from mrlab_ros.core.bridge.rules import Role
from mrlab_ros.gateway.people.accounts import LONGEST

Name = Annotated[str, Field(max_length=200)]
# Longer than any allowed one, so that its length is judged in one place.
Password = Annotated[str, Field(max_length=10 * LONGEST)]


class Lab(BaseModel):
    """Which lab this is."""

    id: str
    name: str
    version: str


class User(BaseModel):
    """The signed-in user. id: owner of the user's things; name: what people read."""

    id: str
    name: str
    role: Role


class Ways(BaseModel):
    """In which ways somebody can sign in; none: open the link that `mrlab up` printed."""

    password: bool
    oidc: bool
    pairing: bool
    course: bool


class Rights(BaseModel):
    """Commands that the pages offer to a person; the socket checks each call by the same policy.

    commands: loads and plays robots. scene: puts robots there and takes them away. replay: plays
    bags. grades: steps through the class that this gateway shows. hands_in: hands in for it.
    """

    commands: bool
    scene: bool
    replay: bool
    grades: bool
    hands_in: bool


class Session(BaseModel):
    """First facts of a page. csrf: for the header X-CSRF-Token of unsafe requests."""

    lab: Lab
    user: User | None
    may: Rights
    csrf: str
    ways: Ways


class Credentials(BaseModel):
    """A name and a password."""

    name: Name
    password: Password


class NewPassword(BaseModel):
    """The password that somebody chooses with a one-time link."""

    password: Password


class PairingBegin(BaseModel):
    """The name of a device for the list of devices. program: it gets a token, no cookie."""

    device: Annotated[str, Field(max_length=80)] = "headset"
    program: bool = False


class PairingShown(BaseModel):
    """The code that a device shows, and the secret with which it asks. qr: an SVG document."""

    code: str
    secret: str
    url: str
    qr: str
    expires_in: float


class PairingState(BaseModel):
    """The state of a pairing; the cookie of an admitted device comes with this answer, once.

    token: an admitted program's, for the header Authorization.
    """

    state: Literal["waiting", "approved", "expired"]
    user: User | None
    token: str = ""


class PairingDevice(BaseModel):
    """What shows a code: the name that it gives itself, and whether it is a program."""

    device: str
    program: bool


class PairingApproval(BaseModel):
    """The code that a device shows, and as what it is let in."""

    code: Annotated[str, Field(max_length=40)]
    role: Role


class NewToken(BaseModel):
    """A program that shall act for a person, as what, and for how many days."""

    program: Annotated[str, Field(min_length=1, max_length=80)]
    role: Role
    days: Annotated[float, Field(gt=0, le=366)] = 90


class Token(BaseModel):
    """A program's token, for the header Authorization: Bearer; it is told once."""

    token: str


class PersonEntry(BaseModel):
    """A person of the lab; signs_in: password, oidc, or empty until the link was used."""

    name: str
    role: Role
    signs_in: str


class NewPerson(BaseModel):
    """Somebody to let in."""

    name: Name
    role: Role


class RoleChange(BaseModel):
    """Another role for a person."""

    role: Role


class Invitation(BaseModel):
    """A one-time link with which a person chooses a password. qr: an SVG document."""

    name: str
    role: Role
    url: str
    qr: str
    expires_in: float


class Invited(BaseModel):
    """Whom a link invites."""

    name: str
    role: Role


class Device(BaseModel):
    """A sign-in: a paired device, or a browser. Times are s since 1970.

    name: what the device calls itself. approved_by: whose it is. this: it is the one that asks.
    """

    id: str
    name: str
    role: Role
    approved_by: str
    created: float
    last_seen: float
    expires: float
    this: bool


class Devices(BaseModel):
    """Sign-ins, newest first."""

    devices: list[Device]


class People(BaseModel):
    """The people of the lab, by name."""

    people: list[PersonEntry]
