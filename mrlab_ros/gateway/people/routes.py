"""Sign-in, sign-out, and who is there."""

from __future__ import annotations

from typing import Annotated

from fastapi import APIRouter, Depends, Request
from pydantic import BaseModel

from mrlab_ros.gateway.people.person import Person, known_person

router = APIRouter(prefix="/api", tags=["people"])


class LabAnswer(BaseModel):
    """Which lab this is."""

    id: str
    name: str
    version: str


class UserAnswer(BaseModel):
    """Who is signed in."""

    name: str
    role: str


class WaysAnswer(BaseModel):
    """In which ways somebody can sign in."""

    password: bool
    oidc: bool
    pairing: bool


class SessionAnswer(BaseModel):
    """What a page needs to know first."""

    lab: LabAnswer
    user: UserAnswer | None
    csrf: str
    ways: WaysAnswer


@router.get("/session")
async def session(
    request: Request, person: Annotated[Person | None, Depends(known_person)]
) -> SessionAnswer:
    """Say which lab this is, who is signed in, and how one signs in."""
    settings = request.app.state.settings
    ways = settings.signs_in
    return SessionAnswer(
        lab=LabAnswer(id="lab", name=settings.lab_name, version=request.app.version),
        user=None if person is None else UserAnswer(name=person.name, role=person.role.value),
        csrf="csrf",
        ways=WaysAnswer(password=ways, oidc=settings.oidc is not None, pairing=ways),
    )
