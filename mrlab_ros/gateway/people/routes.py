"""Sign-in and sign-out, one-time links, the people of the lab, and their devices.

Routes that hash passwords or write the database are plain functions, so that they run in threads.
"""

from __future__ import annotations

import io
import logging
from typing import Annotated, Literal

import segno
from fastapi import APIRouter, Depends, Query, Request, Response
from fastapi.concurrency import run_in_threadpool

from mrlab_ros.core.base.diagnostic import heard
from mrlab_ros.core.base.errors import BadInput, Unavailable
from mrlab_ros.core.base.foreign_text import visible
from mrlab_ros.core.bridge.access import Policy, Verb
from mrlab_ros.core.bridge.rules import Role
from mrlab_ros.gateway.diagnostics import GATEWAY_WITHOUT_LAB
from mrlab_ros.gateway.errors import NotAllowed, NotFound, NotSignedIn
from mrlab_ros.gateway.people import answers
from mrlab_ros.gateway.people.accounts import INVITATION_LIFETIME_S
from mrlab_ros.gateway.people.diagnostics import (
    DEVICE_LETS_IN,
    NO_DEVICE,
    ONE_LOCAL_USER,
    PAIRED_ROLE_TOO_HIGH,
    WITH_KEYS,
    WRONG_PASSWORD,
)
from mrlab_ros.gateway.people.people import People, ThePeople, address_of
from mrlab_ros.gateway.people.person import CurrentPerson, KnownPerson, Person
from mrlab_ros.gateway.ports import Ports, ports

log = logging.getLogger("mrlab.gateway")
router = APIRouter(prefix="/api", tags=["people"])
DAY_S = 24 * 3600.0


@router.get("/session")
async def read_session(
    request: Request, people: ThePeople, person: KnownPerson
) -> answers.Session:
    """Say which lab this is, who is signed in, and how one signs in."""
    csrf = people.sign_ins.csrf(people.secret(request.headers.get("cookie", "")))
    return session_answer(request, people, person, csrf)


@router.post("/session")
def sign_in(
    request: Request, response: Response, people: ThePeople, body: answers.Credentials
) -> answers.Session:
    """Sign in with name and password."""
    check_signs_in(people)
    people.check_attempt(body.name, request, people.steady())
    account = people.accounts.matching(body.name, body.password)
    if account is None:
        log.warning("a wrong password for '%s' from %s", visible(body.name), address_of(request))
        raise NotSignedIn(WRONG_PASSWORD())
    csrf = people.sign_in(response, account.name, account.role)
    people.remember_browser(account.name, request, response)
    person = Person(account.name, account.role, id=account.id)
    return session_answer(request, people, person, csrf)


@router.delete("/session", status_code=204)
def sign_out(response: Response, people: ThePeople, person: KnownPerson) -> None:
    """Sign out."""
    people.sign_out(response, person)


@router.get("/invitations/{token}")
def read_invitation(request: Request, people: ThePeople, token: str) -> answers.Invited:
    """Say whom a one-time link invites."""
    people.links_by_address.check(address_of(request), people.steady())
    account = people.accounts.invited(token, people.clock())
    return answers.Invited(name=account.name, role=account.role)


@router.post("/invitations/{token}")
def accept_invitation(
    request: Request,
    response: Response,
    people: ThePeople,
    token: str,
    body: answers.NewPassword,
) -> answers.Session:
    """Choose a password with a one-time link, and be signed in."""
    people.links_by_address.check(address_of(request), people.steady())
    account = people.accounts.accept(token, body.password, people.clock())
    csrf = people.sign_in(response, account.name, account.role)
    people.remember_browser(account.name, request, response)
    person = Person(account.name, account.role, id=account.id)
    return session_answer(request, people, person, csrf)


@router.get("/people")
def list_people(people: ThePeople) -> answers.People:
    """List the people of the lab."""
    return answers.People(
        people=[
            answers.PersonEntry(name=each.name, role=each.role, signs_in=each.signs_in)
            for each in people.accounts.all()
        ]
    )


@router.post("/people", status_code=201)
def add_person(request: Request, people: ThePeople, body: answers.NewPerson) -> answers.Invitation:
    """Let somebody in; the answer's link is for that person alone."""
    check_signs_in(people)
    account = people.accounts.add(body.name, body.role)
    return invitation(request, people, account.name, account.role)


@router.post("/people/{name}/invitation", status_code=201)
def invite_person(request: Request, people: ThePeople, name: str) -> answers.Invitation:
    """Make a new one-time link for somebody who lost the password, which counts until then."""
    account = people.accounts.get(name)
    return invitation(request, people, account.name, account.role)


@router.patch("/people/{name}")
def change_role(people: ThePeople, name: str, body: answers.RoleChange) -> answers.PersonEntry:
    """Give somebody another role, at once."""
    people.accounts.set_role(name, body.role)
    account = people.accounts.get(name)
    return answers.PersonEntry(name=account.name, role=account.role, signs_in=account.signs_in)


@router.delete("/people/{name}", status_code=204)
async def remove_person(
    people: ThePeople,
    there: Annotated[Ports, Depends(ports)],
    name: str,
    data: Annotated[Literal["keep", "erase", "hand_over"], Query()] = "keep",
    to: Annotated[str, Query(description="who gets the trajectories")] = "",
) -> None:
    """Remove somebody; every sign-in of that person ends.

    data: what happens to all that the person uploaded and published; instructors keep seeing what
    is kept. Where that fails, the person stays.
    """
    account = await run_in_threadpool(people.accounts.check_leaves, name)
    if data != "keep":
        heir = await run_in_threadpool(people.accounts.get, to) if data == "hand_over" else None
        service, kind, request = settling(account.id, heir.id if heir else "")
        if there.lab is None:
            raise Unavailable(GATEWAY_WITHOUT_LAB())
        answer = await there.lab.call(service, kind, request)
        if not answer.success:
            raise BadInput(heard(answer))
    await run_in_threadpool(people.accounts.remove, name)


def settling(owner: str, heir: str) -> tuple[str, str, dict[str, str]]:
    """Return the converter's service, its type and the request for a removed person's data.

    heir: the id of who gets it; empty: it is erased.
    """
    if heir:
        request = {"owner": owner, "to": heir}
        return "converter/hand_over", "mrlab_msgs/srv/HandOver", request
    return "converter/erase", "mrlab_msgs/srv/Remove", {"name": owner}


@router.get("/devices")
def list_devices(people: ThePeople, person: CurrentPerson) -> answers.Devices:
    """List the sign-ins: one's own, and for an instructor everybody's."""
    name = None if person.role.may(Role.INSTRUCTOR) else person.name
    found = people.sign_ins.all(people.clock(), name)
    return answers.Devices(
        devices=[
            answers.Device(
                id=each.id,
                name=each.device or "browser",
                role=each.role,
                approved_by=each.name,
                created=each.created,
                last_seen=each.seen,
                expires=each.expires,
                this=each.id == person.sign_in,
            )
            for each in found
        ]
    )


@router.post("/tokens", status_code=201)
def make_token(people: ThePeople, person: CurrentPerson, body: answers.NewToken) -> answers.Token:
    """Let a program act for the person who asks, in a role that the person has."""
    if person.paired:
        raise NotAllowed(DEVICE_LETS_IN())
    if not person.role.may(body.role):
        own = person.role.value
        raise BadInput(PAIRED_ROLE_TOO_HIGH(person=person.name, role=own, wanted=body.role.value))
    token = people.program(
        person.name, body.role, body.program, let_in_by=person.sign_in, lifetime=body.days * DAY_S
    )
    return answers.Token(token=token)


@router.delete("/devices/{sign_in}", status_code=204)
def end_device(people: ThePeople, person: CurrentPerson, sign_in: str) -> None:
    """End a sign-in, and those of the devices that it let in; their sockets close."""
    found = [each for each in people.sign_ins.all(people.clock()) if each.id == sign_in]
    # To others' people a foreign sign-in does not exist.
    if not found or not (person.role.may(Role.INSTRUCTOR) or found[0].name == person.name):
        raise NotFound(NO_DEVICE())
    people.sign_ins.end_with_devices(sign_in)


def session_answer(
    request: Request, people: People, person: Person | None, csrf: str
) -> answers.Session:
    """Return what a page needs to know first."""
    settings = people.settings
    return answers.Session(
        lab=answers.Lab(
            id=people.database.lab_id, name=settings.lab_name, version=request.app.version
        ),
        user=None
        if person is None
        else answers.User(id=person.id, name=person.name, role=person.role),
        may=rights(
            request.app.state.policy,
            person,
            graded=settings.classroom is not None,
            hands_in=settings.lti is not None,
        ),
        csrf=csrf,
        ways=answers.Ways(
            password=settings.signs_in,
            oidc=settings.oidc is not None,
            pairing=settings.signs_in,
            course=settings.lti is not None,
        ),
    )


def rights(
    policy: Policy, person: Person | None, *, graded: bool, hands_in: bool
) -> answers.Rights:
    """Return what the pages offer to a person. graded: the gateway shows a class; hands_in: its
    students hand in here."""

    def calls(*services: str) -> bool:
        return person is not None and all(
            policy.may(person.role, Verb.CALL, service) for service in services
        )

    teaches = person is not None and person.role.may(Role.INSTRUCTOR)
    return answers.Rights(
        commands=calls("robot/load", "robot/play"),
        scene=calls("lab/spawn_robot", "lab/remove_robot"),
        replay=calls("recorder/replay", "recorder/stop"),
        grades=graded and teaches,
        hands_in=hands_in and person is not None and person.role.may(Role.STUDENT) and not teaches,
    )


def invitation(request: Request, people: People, name: str, role: Role) -> answers.Invitation:
    """Make a one-time link for a person."""
    secret = people.accounts.invite(name, people.clock())
    url = f"{base_url(request, people)}/invitation/{secret}"
    return answers.Invitation(
        name=name, role=role, url=url, qr=qr_svg(url), expires_in=INVITATION_LIFETIME_S
    )


def base_url(request: Request, people: People) -> str:
    """Return the address by which people reach this gateway, without a slash at its end."""
    return people.settings.public_url or str(request.base_url).rstrip("/")


def qr_svg(text: str) -> str:
    """Return a QR code as an SVG document without styles, so that any policy shows it."""
    out = io.BytesIO()
    segno.make(text, micro=False).save(out, kind="svg", xmldecl=False, border=2, omitsize=True)
    return out.getvalue().decode()


def check_signs_in(people: People) -> None:
    """Raise NotAllowed where nobody signs in, as there is one local user."""
    if not people.settings.signs_in:
        raise NotAllowed(ONE_LOCAL_USER(fixes=WITH_KEYS))
