"""The motion that a program shows: the newest counts, and it is its person's alone."""

from __future__ import annotations

import asyncio
import io
from collections.abc import Awaitable, Callable, Iterator
from pathlib import Path
from typing import Any

import httpx
import pytest
import scipy.io
from fake_converter import FakeConverter
from fake_lab import FakeLab
from gateway_side import Browser, Gateway, code_of, kind_of
from memory_store import MemoryStore

from mrlab_ros.adapters.store import keys
from mrlab_ros.core.bridge.rules import Role

GOOD = b"good" + bytes(2000)
DEADLINE_S = 20.0


class School:
    """A gateway with a converter at which people sign in."""

    def __init__(self, folder: Path) -> None:
        self.store, self.lab = MemoryStore(), FakeLab()
        FakeConverter(self.lab, self.store)
        self.gateway = Gateway(
            folder, lab=self.lab, store=self.store, public_url="https://lab.example.org"
        )


@pytest.fixture
def school(tmp_path: Path) -> Iterator[School]:
    school = School(tmp_path)
    with school.gateway:
        yield school


def show(person: Browser, data: bytes = GOOD, name: str = "script_line_3.mat", **more: Any) -> Any:
    options = {"robot_model": "ur5e", **more}
    return person.send("PUT", f"/api/live/{name}", content=data, params=options)


def shown(person: Browser, **query: str) -> Any:
    return person.get("/api/live", params=query).json()["now"]


async def with_token(school: School, act: Callable[[httpx.AsyncClient], Awaitable[Any]]) -> Any:
    """Let a program of anna's do something, in one event loop with the gateway."""
    people = school.gateway.people
    people.accounts.add("anna", Role.STUDENT)
    token = people.program("anna", Role.STUDENT, "matlab", let_in_by="")
    async with httpx.AsyncClient(
        transport=httpx.ASGITransport(app=school.gateway.app),
        base_url=school.gateway.url,
        headers={"authorization": f"Bearer {token}"},
    ) as client:
        return await act(client)


def test_a_motion_is_shown_to_its_person_and_to_nobody_else(school: School) -> None:
    anna, ben = school.gateway.browser("anna"), school.gateway.browser("ben")
    answer = show(anna, frame_rate=50)
    assert answer.status_code == 201
    assert answer.json()["conversion"]["outcome"] == "accepted"
    assert shown(anna) == answer.json()
    assert shown(anna)["options"]["frame_rate"] == 50
    assert shown(ben) is None
    draft = answer.json()["conversion"]["draft"]
    file = anna.get(f"/api/live/{draft}/file", params={"format": "mat"})
    assert scipy.io.loadmat(io.BytesIO(file.content))["q"].shape == (60, 6)
    assert kind_of(ben.get(f"/api/live/{draft}/file")) == (404, "not_found")


def test_a_refused_motion_is_shown_with_its_findings(school: School) -> None:
    anna = school.gateway.browser("anna")
    answer = show(anna, b"bad").json()
    assert [each["code"] for each in answer["conversion"]["diagnostics"]] == ["joint_limit"]
    assert shown(anna) == answer


def test_what_is_only_asked_is_not_shown(school: School) -> None:
    anna = school.gateway.browser("anna")
    assert show(anna, shown=False).json()["conversion"]["outcome"] == "accepted"
    assert shown(anna) is None


def test_the_store_holds_two_generations_however_often_a_script_runs(school: School) -> None:
    anna = school.gateway.browser("anna")
    for _ in range(3):
        show(anna)
    held = len(school.store.list(keys.user("anna")))
    for _ in range(20):
        newest = show(anna).json()
    assert len(school.store.list(keys.user("anna"))) == held
    assert anna.get(newest["conversion"]["motion"]).status_code == 200


def test_of_those_that_wait_the_newest_is_converted(school: School) -> None:
    release = school.lab.hold("converter/convert")

    async def three_at_once(anna: httpx.AsyncClient) -> list[httpx.Response]:
        answers = []
        for number in range(3):
            url = f"/api/live/script_line_{number}.mat"
            sent = anna.put(url, content=GOOD, params={"robot_model": "ur5e"})
            answers.append(asyncio.create_task(sent))
            while len(school.store.list(keys.uploads("anna"))) <= number:
                await asyncio.sleep(0)
        release()
        return await asyncio.gather(*answers)

    found = asyncio.run(with_token(school, three_at_once))
    assert [each.status_code for each in found] == [201, 409, 201]
    assert code_of(found[1]) == (409, "newer_is_shown")
    assert len(school.store.list(keys.uploads("anna"))) == 2


def test_a_page_that_waits_gets_the_next_one(school: School) -> None:
    async def wait(anna: httpx.AsyncClient) -> tuple[Any, Any]:
        sent = {"content": GOOD, "params": {"robot_model": "ur5e"}}
        first = (await anna.put("/api/live/a.mat", **sent)).json()
        waiting = asyncio.create_task(anna.get("/api/live", params={"after": first["live"]}))
        second = (await anna.put("/api/live/b.mat", **sent)).json()
        return (await waiting).json()["now"], second

    got, second = asyncio.run(asyncio.wait_for(with_token(school, wait), DEADLINE_S))
    assert got == second
