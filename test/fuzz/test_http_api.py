"""Uploads and trajectories over HTTP with a converter behind them, fuzzed from the description."""

from __future__ import annotations

import re
import threading
from collections.abc import Iterator
from typing import Any

import httpx
import pytest
import schemathesis
import uvicorn
from fake_converter import FakeConverter
from fake_lab import FakeLab
from gateway_side import Gateway
from graph import wait_for
from hypothesis import HealthCheck, given, settings
from memory_store import MemoryStore
from schemathesis.specs.openapi.checks import positive_data_acceptance

from mrlab_ros.gateway.uploads.routes import Desk

OURS = re.compile("/api/(trajectories|uploads|conversions|motions)")
EXAMPLES = 25


@pytest.fixture(scope="module")
def served(tmp_path_factory: pytest.TempPathFactory) -> Iterator[tuple[str, dict[str, str]]]:
    """Serve a gateway with one trajectory; yield its address and the local user's headers."""
    store, lab = MemoryStore(), FakeLab()
    FakeConverter(lab, store)
    gateway = Gateway(tmp_path_factory.mktemp("gateway"), lab=lab, store=store)
    state = gateway.app.state
    ticks = iter(range(0, 10**9, 1000))
    state.desk = Desk(state.desk.receiver, steady=lambda: float(next(ticks)))
    config = uvicorn.Config(gateway.app, port=0, log_level="error", ws="none")
    server = uvicorn.Server(config)
    thread = threading.Thread(target=server.run)
    thread.start()
    try:
        wait_for(lambda: server.started, "the server")
        port = server.servers[0].sockets[0].getsockname()[1]
        address = f"http://localhost:{port}"
        token = gateway.people.accounts.open(gateway.clock())
        with httpx.Client(base_url=address, follow_redirects=True) as browser:
            browser.get(f"/?token={token}")
            headers = {
                "Origin": address,
                "X-CSRF-Token": browser.get("/api/session").json()["csrf"],
                "Cookie": "; ".join(f"{k}={v}" for k, v in browser.cookies.items()),
            }
            publish_one(browser, headers)
        yield address, headers
    finally:
        server.should_exit = True
        thread.join()


def publish_one(browser: httpx.Client, headers: dict[str, str]) -> None:
    sent = browser.put("/api/uploads/a.mat", content=b"good", headers=headers).json()
    asked = {"upload": sent["upload"], "robot_model": "ur5e"}
    made = browser.post("/api/conversions", json=asked, headers=headers).json()
    body = {"draft": made["draft"], "id": "pick"}
    assert browser.post("/api/trajectories", json=body, headers=headers).status_code == 200


def test_no_request_finds_an_answer_that_is_not_described(
    served: tuple[str, dict[str, str]],
) -> None:
    address, headers = served
    schema = schemathesis.openapi.from_url(f"{address}/api/openapi.json")
    tried = []
    for operation in (found.ok() for found in schema.get_all_operations()):
        if OURS.match(operation.path):
            fuzz(operation, headers)
            tried.append((operation.method, operation.path))
    assert len(tried) == 12, tried


def fuzz(operation: Any, headers: dict[str, str]) -> None:
    """Send requests of every kind that an operation describes, and check the answers."""

    @settings(
        max_examples=EXAMPLES,
        deadline=None,
        derandomize=True,
        database=None,
        suppress_health_check=list(HealthCheck),
    )
    @given(case=operation.as_strategy())
    def check(case: Any) -> None:
        # What a file's name ends with, or which draft there is, no schema says.
        case.call_and_validate(headers=headers, excluded_checks=[positive_data_acceptance])

    check()
