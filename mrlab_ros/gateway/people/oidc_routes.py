"""Sign-in by an OpenID Connect provider over HTTP.

A person sees these addresses in the browser, so what fails leads to the page of signing in, which
says it in the person's language; the log has the details.
"""

from __future__ import annotations

import logging
import secrets
from typing import Annotated

from anyio import to_thread
from fastapi import APIRouter, Depends, Request, Response
from fastapi.responses import RedirectResponse

from mrlab_ros.core.base.errors import LabError
from mrlab_ros.gateway.errors import GatewayError, NotFound
from mrlab_ros.gateway.people.diagnostics import NO_PROVIDER, SIGN_IN_NOT_BEGUN
from mrlab_ros.gateway.people.oidc import PENDING_LIFETIME_S, NotBegun, Oidc
from mrlab_ros.gateway.people.people import People, ThePeople, address_of
from mrlab_ros.gateway.people.routes import base_url

PATH = "/api/oidc"
logger = logging.getLogger("mrlab.gateway")
router = APIRouter(prefix=PATH, include_in_schema=False)


def oidc_of(request: Request) -> Oidc:
    """Return the provider of this gateway; raises NotFound where it has none."""
    found: Oidc | None = request.app.state.oidc
    if found is None:
        raise NotFound(NO_PROVIDER())
    return found


TheOidc = Annotated[Oidc, Depends(oidc_of)]


@router.get("/start")
async def start(request: Request, people: ThePeople, oidc: TheOidc) -> Response:
    """Send somebody to the provider."""
    try:
        people.sign_ins_by_address.check(address_of(request), people.steady())
        url, state = await oidc.begin(f"{base_url(request, people)}{PATH}/callback")
    except LabError as error:
        return back_to_sign_in(error)
    response = RedirectResponse(url, 303)
    # Lax: the provider's page leads back here. It proves that this browser began.
    response.set_cookie(
        state_cookie(people),
        state,
        max_age=int(PENDING_LIFETIME_S),
        path=PATH,
        secure=people.secure,
        httponly=True,
        samesite="lax",
    )
    return response


@router.get("/callback")
async def callback(request: Request, people: ThePeople, oidc: TheOidc) -> Response:
    """Sign in whom the provider sends back."""
    state = request.query_params.get("state", "")
    begun = request.cookies.get(state_cookie(people), "")
    try:
        if not state or not secrets.compare_digest(state.encode(), begun.encode()):
            raise NotBegun(SIGN_IN_NOT_BEGUN())
        claims = await oidc.finish(str(request.url), state)
        account = await to_thread.run_sync(oidc.account, claims, people.accounts)
    except LabError as error:
        return back_to_sign_in(error)
    response = RedirectResponse("/", 303)
    response.delete_cookie(state_cookie(people), path=PATH)
    await to_thread.run_sync(people.sign_in, response, account.name, account.role)
    return response


def back_to_sign_in(error: LabError) -> Response:
    """Lead to the page of signing in, which knows a sentence for each of these words."""
    logger.warning("nobody was signed in by the provider: %s", error)
    word = error.kind if isinstance(error, GatewayError) else "unavailable"
    return RedirectResponse(f"/sign-in?problem={word}", 303)


def state_cookie(people: People) -> str:
    """Return the name of the cookie that binds a sign-in to its browser."""
    return f"mrlab-oidc-{people.database.lab_id}"
