"""The one form of errors over HTTP: {"error": {"kind": "...", "code": "...", ...}}."""

from __future__ import annotations

import json
import logging
from collections.abc import Mapping
from typing import Any, ClassVar

from fastapi import FastAPI, Request, WebSocket
from fastapi.exceptions import RequestValidationError
from fastapi.responses import JSONResponse
from pydantic import BaseModel
from starlette.exceptions import HTTPException

from mrlab_ros.adapters.store.port import Missing, StoreFailure
from mrlab_ros.adapters.trajectories.catalogue import NoTrajectory
from mrlab_ros.core.base.diagnostic import Diagnostic, plain
from mrlab_ros.core.base.diagnostics import BAD_REQUEST_FIELD
from mrlab_ros.core.base.errors import BadInput, LabError, Misuse, Unavailable
from mrlab_ros.core.base.foreign_text import visible
from mrlab_ros.core.base.machine import lacking
from mrlab_ros.gateway.diagnostics import (
    BAD_REQUEST,
    FIELD_MISSING,
    FIELD_OUT_OF_RANGE,
    FIELD_REFUSED,
    FIELD_UNKNOWN,
    GATEWAY_FAULT,
    HTTP_ERROR,
    METHOD_NOT_POSSIBLE,
    NOTHING_AT,
)
from mrlab_ros.gateway.lab.connection import NoAnswer, Refused
from mrlab_ros.gateway.store.answers import Finding

logger = logging.getLogger("mrlab.gateway")


class GatewayError(LabError):
    """An error with a status of its own; a subclass says which.

    kind: what clients steer by, coarser than the code of the diagnostic.
    """

    status: ClassVar[int] = 500
    kind: ClassVar[str] = "fault"

    def __init__(self, what: Diagnostic, headers: Mapping[str, str] | None = None) -> None:
        super().__init__(what)
        self.headers = dict(headers or {})


class NotSignedIn(GatewayError):
    """Nobody is signed in, or the sign-in has ended."""

    status = 401
    kind = "not_signed_in"


class NotAllowed(GatewayError):
    """Somebody is signed in whose role does not allow this."""

    status = 403
    kind = "not_allowed"


class NotFound(GatewayError):
    """There is no such thing, or not for this person."""

    status = 404
    kind = "not_found"


class TooLarge(GatewayError):
    """A body is larger than it may be."""

    status = 413
    kind = "too_large"


class NotTheFile(GatewayError):
    """A body is a form or another envelope instead of a file."""

    status = 415
    kind = "not_the_file"


class TooSlow(GatewayError):
    """The rest of a body did not come."""

    status = 408
    kind = "too_slow"


class TooMany(GatewayError):
    """A person or an address asks too often."""

    status = 429
    kind = "too_many"

    def __init__(self, what: Diagnostic, retry_after: float) -> None:
        """retry_after: s until it may work again."""
        super().__init__(what, {"Retry-After": str(max(1, round(retry_after)))})


class Fault(Finding):
    """A failure as a diagnostic. kind: a coarse word, such as not_found or bad_input."""

    kind: str


class Problem(BaseModel):
    """The body of every answer that is an error."""

    error: Fault


# The first class that fits decides.
STATUS: tuple[tuple[type[LabError], int, str], ...] = (
    (Missing, 404, "not_found"),
    (NoTrajectory, 404, "not_found"),
    (StoreFailure, 503, "store"),
    (NoAnswer, 504, "no_answer"),
    (Refused, 502, "refused"),
    (Unavailable, 503, "unavailable"),
    (BadInput, 400, "bad_input"),
    (Misuse, 409, "misuse"),
    (LabError, 502, "lab"),
)
# The code with which a socket is closed whose person may not have it.
SOCKET_REFUSED = 4003
# Answers that any route may give, for the OpenAPI description.
RESPONSES: dict[int | str, dict[str, Any]] = {
    status: {"model": Problem}
    for status in (400, 401, 403, 404, 405, 409, 413, 422, 429, 502, 503, 504)
}


def problem(
    status: int, kind: str, what: Diagnostic, headers: Mapping[str, str] | None = None
) -> JSONResponse:
    """Return the answer for an error."""
    body = {"error": {**plain(what), "kind": kind}}
    return JSONResponse(body, status, headers=dict(headers or {}))


def of_lab_error(error: LabError) -> JSONResponse:
    """Return the answer for an error that was raised on purpose."""
    if isinstance(error, GatewayError):
        return problem(error.status, error.kind, error.diagnostic, error.headers)
    for each, status, kind in STATUS:
        if isinstance(error, each):
            return problem(status, kind, error.diagnostic)
    raise AssertionError(error)


async def refuse(websocket: WebSocket, error: LabError) -> None:
    """Close a socket with the reason: a browser shows a page none for a refused handshake."""
    offered = websocket.scope.get("subprotocols", [])
    await websocket.accept(subprotocol=offered[0] if offered else None)
    await close(websocket, SOCKET_REFUSED, error.diagnostic)


async def close(websocket: WebSocket, code: int, why: Diagnostic | None) -> None:
    """Close a socket that was accepted, and say why: first in a text frame, as data."""
    reason = ""
    if why is not None:
        # The reason of a close has 123 bytes at most, and no room for values.
        reason = str(why).encode()[:120].decode(errors="ignore")
        said = {"op": "closing", "code": code, "diagnostic": plain(why)}
        await websocket.send_text(json.dumps(said))
    await websocket.close(code, reason)


# What the reader of requests calls a value of another type, and what is expected then.
KINDS = {"float": "number", "int": "integer", "bool": "boolean", "string": "text"}
LEAST, MOST = ("ge", "gt", "min_length"), ("le", "lt", "max_length")


def _mistake(error: Mapping[str, Any]) -> Diagnostic:
    """Return what is wrong with a field of a request, of an entry of pydantic's errors."""
    place = [str(part) for part in error["loc"][1:]] or [str(part) for part in error["loc"]]
    field, kind, bounds = ".".join(place), str(error["type"]), error.get("ctx", {})
    if kind == "extra_forbidden":
        return FIELD_UNKNOWN(field=field)
    if kind == "missing":
        return FIELD_MISSING(field=field)
    found = visible(repr(error["input"]))[:80]
    name, _, rest = kind.partition("_")
    if name in KINDS and rest in ("parsing", "type"):
        return BAD_REQUEST_FIELD(field=field, found=found, expected=KINDS[name])
    least = next((bounds[each] for each in LEAST if each in bounds), None)
    most = next((bounds[each] for each in MOST if each in bounds), None)
    if least is not None or most is not None:
        return FIELD_OUT_OF_RANGE(field=field, found=found, least=least, most=most)
    return FIELD_REFUSED(field=field, found=found, why=str(error["msg"]))


def _is_page(request: Request) -> bool:
    """Return whether a request matched the route of the pages, which takes any path."""
    return getattr(request.scope.get("route"), "path", "") == "/{path:path}"


def install(app: FastAPI) -> None:
    """Have every error of `app` answered in the one form."""

    @app.exception_handler(LabError)
    async def _(connection: Request | WebSocket, error: LabError) -> JSONResponse | None:
        if isinstance(connection, WebSocket):
            await refuse(connection, error)
            return None
        return of_lab_error(error)

    @app.exception_handler(OSError)
    async def _(connection: Request | WebSocket, error: OSError) -> JSONResponse:
        found = lacking(error)
        if found is None or isinstance(connection, WebSocket):
            raise error
        logger.error("%s %s: %s", connection.method, connection.url.path, found)
        return problem(503, "unavailable", found)

    @app.exception_handler(HTTPException)
    async def _(request: Request, error: HTTPException) -> JSONResponse:
        path = request.url.path
        status, headers = error.status_code, error.headers
        # below /api any path is one of the pages' route to the router, which takes GET alone
        if status == 405 and path.startswith("/api/") and _is_page(request):
            status, headers = 404, None
        if status == 404:
            return problem(status, "not_found", NOTHING_AT(path=path), headers)
        if status == 405:
            what = METHOD_NOT_POSSIBLE(method=request.method, path=path)
            return problem(status, "method", what, headers)
        return problem(status, "http", HTTP_ERROR(detail=str(error.detail)), headers)

    @app.exception_handler(RequestValidationError)
    async def _(_: Request, error: RequestValidationError) -> JSONResponse:
        found = [_mistake(each) for each in error.errors()]
        return problem(422, "bad_request", BAD_REQUEST(mistakes=found))

    @app.exception_handler(Exception)
    async def _(request: Request, error: Exception) -> JSONResponse:
        logger.error("%s %s failed", request.method, request.url.path, exc_info=error)
        return problem(500, "fault", GATEWAY_FAULT())
