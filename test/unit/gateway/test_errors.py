"""The kind and the status of errors, by their class; the code is that of the diagnostic."""

from __future__ import annotations

import json

import pytest

from mrlab_ros.adapters.store.diagnostics import NOT_IN_STORE, STORE_FAILED
from mrlab_ros.adapters.store.port import Missing, StoreFailure
from mrlab_ros.core.base.errors import BadInput, LabError, Misuse, Unavailable
from mrlab_ros.gateway import errors
from mrlab_ros.gateway.diagnostics import NOTHING_AT
from mrlab_ros.gateway.lab.connection import NoAnswer, Refused, TimedOut
from mrlab_ros.gateway.people.oidc import NotBegun, NotConfirmed

WHAT = NOTHING_AT(path="/x")


@pytest.mark.parametrize(
    ("error", "status", "kind"),
    [
        (errors.NotSignedIn(WHAT), 401, "not_signed_in"),
        (errors.NotAllowed(WHAT), 403, "not_allowed"),
        (NotBegun(WHAT), 403, "not_begun"),
        (NotConfirmed(WHAT), 403, "not_confirmed"),
        (errors.NotFound(WHAT), 404, "not_found"),
        (errors.TooSlow(WHAT), 408, "too_slow"),
        (errors.TooLarge(WHAT), 413, "too_large"),
        (errors.NotTheFile(WHAT), 415, "not_the_file"),
        (errors.TooMany(WHAT, 3.0), 429, "too_many"),
        (Missing(NOT_IN_STORE(key="k")), 404, "not_found"),
        (StoreFailure(STORE_FAILED(store="s", why="w")), 503, "store"),
        (NoAnswer(WHAT), 504, "no_answer"),
        (TimedOut(WHAT), 504, "no_answer"),
        (Refused(WHAT), 502, "refused"),
        (Unavailable(WHAT), 503, "unavailable"),
        (BadInput(WHAT), 400, "bad_input"),
        (Misuse(WHAT), 409, "misuse"),
        (LabError(WHAT), 502, "lab"),
    ],
    ids=lambda each: type(each).__name__ if isinstance(each, LabError) else str(each),
)
def test_an_error_is_a_diagnostic_of_a_kind(error: LabError, status: int, kind: str) -> None:
    answer = errors.of_lab_error(error)
    told = json.loads(answer.body)["error"]
    assert (answer.status_code, told["kind"]) == (status, kind)
    assert told["code"] == error.diagnostic.code
    assert told["values"] == dict(error.diagnostic.values)
    assert errors.Fault.model_validate(told).message == error.diagnostic.message


def test_who_asks_too_often_is_told_when_to_come_back() -> None:
    assert errors.of_lab_error(errors.TooMany(WHAT, 3.2)).headers["retry-after"] == "3"
