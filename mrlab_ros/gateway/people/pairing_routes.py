"""Pairing over HTTP: a device begins and asks, a person who is signed in approves."""

from __future__ import annotations

from typing import Annotated

from fastapi import APIRouter, Path, Request, Response

from mrlab_ros.gateway.errors import NotAllowed, NotFound
from mrlab_ros.gateway.people import answers
from mrlab_ros.gateway.people.diagnostics import OWN_PAGES_ONLY
from mrlab_ros.gateway.people.pairing import LIFETIME_S, shown
from mrlab_ros.gateway.people.people import ThePeople, address_of
from mrlab_ros.gateway.people.person import LOCAL, CurrentPerson
from mrlab_ros.gateway.people.routes import base_url, check_signs_in, qr_svg
from mrlab_ros.gateway.people.sign_ins import DEVICE_LIFETIME_S

router = APIRouter(prefix="/api/pairings", tags=["people"])


@router.post("", status_code=201)
async def begin(
    request: Request, people: ThePeople, body: answers.PairingBegin | None = None
) -> answers.PairingShown:
    """Begin to pair a device or a program: it shows the code, and asks every two seconds."""
    program = body is not None and body.program
    if not program:
        check_signs_in(people)
    people.pairings_by_address.check(address_of(request), people.steady())
    device = (body or answers.PairingBegin()).device or "headset"
    pairing = people.pairings.begin(device, people.steady(), program=program)
    url = f"{base_url(request, people)}/pair/{pairing.code}"
    return answers.PairingShown(
        code=shown(pairing.code),
        secret=pairing.secret,
        url=url,
        qr=qr_svg(url),
        expires_in=LIFETIME_S,
    )


@router.get("/{secret}")
async def collect(
    request: Request, response: Response, people: ThePeople, secret: str
) -> answers.PairingState:
    """Ask whether the device was let in; then it is signed in by a cookie."""
    # A page of another site could otherwise sign its visitor in as somebody else.
    if request.headers.get("sec-fetch-site", "same-origin") != "same-origin":
        raise NotAllowed(OWN_PAGES_ONLY())
    try:
        pairing = people.pairings.collect(secret, people.steady())
    except NotFound:
        return answers.PairingState(state="expired", user=None)
    if pairing is None or pairing.granted is None:
        return answers.PairingState(state="waiting", user=None)
    person, role = pairing.granted
    user = answers.User(id=person.id, name=person.name, role=role)
    if pairing.program:
        token = people.program(person.name, role, pairing.device, let_in_by=person.sign_in)
        return answers.PairingState(state="approved", user=user, token=token)
    people.sign_in(
        response,
        person.name,
        role,
        device=pairing.device,
        let_in_by=person.sign_in,
        lifetime=DEVICE_LIFETIME_S,
    )
    return answers.PairingState(state="approved", user=user)


@router.get("/shown/{code}")
async def shown_by(
    people: ThePeople, person: CurrentPerson, code: Annotated[str, Path(max_length=40)]
) -> answers.PairingDevice:
    """Return what shows a code, so that a person sees what they let in."""
    pairing = people.pairings.waiting(code, person, people.steady())
    return answers.PairingDevice(device=pairing.device, program=pairing.program)


@router.post("/approve")
async def approve(
    people: ThePeople, person: CurrentPerson, body: answers.PairingApproval
) -> answers.PairingState:
    """Let the device that shows a code in, as a role that one has oneself."""
    now = people.steady()
    if person.name == LOCAL and not people.pairings.waiting(body.code, person, now).program:
        check_signs_in(people)
    pairing = people.pairings.approve(body.code, person, body.role, now)
    user = answers.User(id=person.id, name=pairing.device, role=body.role)
    return answers.PairingState(state="approved", user=user)
