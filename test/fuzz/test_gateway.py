"""The gateway's HTTP interface, fuzzed from its own OpenAPI description.

Whatever is sent, the answer is as described and never a fault of the gateway.
"""

from __future__ import annotations

import itertools
import tempfile
from pathlib import Path
from typing import Any

import httpx
import pytest
import schemathesis
from fastapi import FastAPI
from gateway_side import Gateway
from hypothesis import HealthCheck, given, reject, settings
from hypothesis import strategies as st
from schemathesis import GenerationMode
from schemathesis.specs.openapi.checks import (
    content_type_conformance,
    response_schema_conformance,
    status_code_conformance,
)

from mrlab_ros.core.base.errors import LabError
from mrlab_ros.core.bridge.rules import Role
from mrlab_ros.gateway.app import ROUTERS
from mrlab_ros.gateway.errors import RESPONSES
from mrlab_ros.gateway.uploads import live

EXAMPLES = 10
ORIGIN = "https://lab.example.org"
CHECKS = [
    status_code_conformance,
    content_type_conformance,
    response_schema_conformance,
]


def described() -> dict[str, Any]:
    """Return the OpenAPI description of the gateway's routes."""
    app = FastAPI(responses=RESPONSES)
    for router in ROUTERS:
        app.include_router(router)
    return app.openapi()


DESCRIPTION = schemathesis.openapi.from_dict(described())
OPERATIONS = [
    (operation.ok().method.upper(), operation.ok().path)
    for operation in DESCRIPTION.get_all_operations()
]


@pytest.fixture(scope="module")
def lab() -> Any:
    # hypothesis runs examples where pytest's own folder of a test would be gone.
    with (
        pytest.MonkeyPatch.context() as patch,
        tempfile.TemporaryDirectory() as folder,
        Gateway(Path(folder), public_url=ORIGIN) as gateway,
    ):
        # Who waits for a motion that nobody shows waits in vain.
        patch.setattr(live, "LONGEST_WAIT_S", 0.1)
        # Each attempt is late enough for the limits of rates.
        attempts = itertools.count()
        gateway.people.steady = lambda: 1000.0 * next(attempts)
        yield gateway


def cases(method: str, path: str) -> st.SearchStrategy[Any]:
    """Return requests as described and, where something can be wrong in one, wrong ones."""
    operation = DESCRIPTION[path][method]
    right = operation.as_strategy()
    if not operation.definition.raw.get("requestBody"):
        return right
    return right | operation.as_strategy(generation_mode=GenerationMode.NEGATIVE)


def signed_in(lab: Gateway, role: Role) -> dict[str, str]:
    """Return the headers of a page of a person who is just signed in."""
    name = f"fuzz-{role.value}"
    try:
        lab.people.accounts.add(name, role)
    except LabError:
        # An earlier example may have changed the role of this very person.
        lab.people.accounts.set_role(name, role)
    secret = lab.people.sign_ins.begin(name, role, lab.clock())
    return {
        "host": "lab.example.org",
        "origin": ORIGIN,
        "cookie": f"{lab.people.cookie}={secret}",
        "x-csrf-token": lab.people.sign_ins.csrf(secret),
    }


@pytest.mark.parametrize(("method", "path"), OPERATIONS)
def test_every_answer_is_as_described(lab: Gateway, method: str, path: str) -> None:
    @given(case=cases(method, path), role=st.sampled_from(Role))
    @settings(
        max_examples=EXAMPLES,
        deadline=None,
        derandomize=True,
        database=None,
        suppress_health_check=list(HealthCheck),
    )
    def check(case: Any, role: Role) -> None:
        lab.anyone.http.cookies.clear()
        request = case.as_transport_kwargs(base_url=ORIGIN, headers=signed_in(lab, role))
        try:
            response = lab.anyone.http.request(**request, follow_redirects=False)
        except httpx.InvalidURL:
            # A query of more than 64 KiB: this client sends none.
            reject()
        # There is no lab: 502 to 504 say so.
        assert response.status_code != 500, response.text
        case.validate_response(response, checks=CHECKS)

    check()


def test_all_of_it_is_described() -> None:
    assert len(OPERATIONS) > 25
    assert {("PUT", "/api/uploads/{file_name}"), ("POST", "/api/session")} <= set(OPERATIONS)
