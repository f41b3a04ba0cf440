"""The people of a lab over HTTP: who may let whom in, and what removal ends."""

from __future__ import annotations

import asyncio
import sqlite3
import threading
from pathlib import Path
from typing import Any

import pytest
from fake_lab import FakeLab
from fastapi.requests import HTTPConnection
from gateway_side import PASSWORD, Gateway, code_of

from mrlab_ros.core.bridge.rules import Role
from mrlab_ros.gateway.people.people import address_of
from mrlab_ros.gateway.people.person import Person


@pytest.mark.parametrize("role", [Role.DISPLAY, Role.STUDENT, Role.OPERATOR])
def test_only_instructors_see_and_change_people(class_lab: Gateway, role: Role) -> None:
    somebody = class_lab.browser("somebody", role)
    body = {"name": "eve", "role": "instructor"}
    tries = [
        somebody.get("/api/people"),
        somebody.send("POST", "/api/people", json=body),
        somebody.send("PATCH", "/api/people/somebody", json={"role": "instructor"}),
        somebody.send("DELETE", "/api/people/somebody"),
    ]
    assert [code_of(each) for each in tries] == [(403, "role_too_low")] * 4
    assert [each.name for each in class_lab.people.accounts.all()] == ["somebody"]


def test_an_instructor_lists_changes_and_removes(class_lab: Gateway) -> None:
    teacher = class_lab.browser("teacher", Role.INSTRUCTOR)
    anna = class_lab.browser("anna")
    assert teacher.get("/api/people").json() == {
        "people": [
            {"name": "anna", "role": "student", "signs_in": "password"},
            {"name": "teacher", "role": "instructor", "signs_in": "password"},
        ]
    }
    changed = teacher.send("PATCH", "/api/people/anna", json={"role": "operator"})
    assert changed.json()["role"] == "operator"
    assert anna.user == {"id": "anna", "name": "anna", "role": "operator"}
    assert teacher.send("DELETE", "/api/people/anna").status_code == 204
    assert anna.user is None
    assert code_of(teacher.send("DELETE", "/api/people/anna")) == (404, "no_person")


@pytest.mark.parametrize("name", ["", "local", "LOCAL", "lab", "a b", "../x", "a/b", "x" * 60])
def test_a_name_must_be_one_for_keys_and_folders(class_lab: Gateway, name: str) -> None:
    teacher = class_lab.browser("teacher", Role.INSTRUCTOR)
    body = {"name": name, "role": "student"}
    assert teacher.send("POST", "/api/people", json=body).status_code == 400


def test_names_differ_by_more_than_case(class_lab: Gateway) -> None:
    teacher = class_lab.browser("teacher", Role.INSTRUCTOR)
    body = {"name": "Teacher", "role": "student"}
    assert code_of(teacher.send("POST", "/api/people", json=body)) == (409, "person_exists")


def test_a_removed_name_that_comes_back_has_no_old_sign_in(class_lab: Gateway) -> None:
    anna = class_lab.browser("anna")
    class_lab.people.accounts.remove("anna")
    class_lab.people.accounts.add("anna", Role.INSTRUCTOR)
    assert anna.user is None


def test_everybody_ends_their_own_sign_ins_and_no_others(class_lab: Gateway) -> None:
    anna, ben = class_lab.browser("anna"), class_lab.browser("ben")
    phone = class_lab.browser()
    phone.sign_in("anna")
    mine = anna.get("/api/devices").json()["devices"]
    assert [(each["approved_by"], each["this"]) for each in mine].count(("anna", True)) == 1
    assert {each["approved_by"] for each in mine} == {"anna"}
    (other,) = [each["id"] for each in mine if not each["this"]]
    assert code_of(ben.send("DELETE", f"/api/devices/{other}")) == (404, "no_device")
    assert phone.user
    assert anna.send("DELETE", f"/api/devices/{other}").status_code == 204
    assert phone.user is None
    assert anna.user


def test_the_end_of_a_sign_in_and_a_new_role_are_events(class_lab: Gateway) -> None:
    sign_ins, accounts, clock = (
        class_lab.people.sign_ins,
        class_lab.people.accounts,
        class_lab.clock,
    )
    for name in ("anna", "ben", "carla"):
        accounts.add(name, Role.STUDENT)
    people = {}
    for name in ("anna", "ben", "carla"):
        person = sign_ins.person(sign_ins.begin(name, Role.STUDENT, clock()), clock())
        assert isinstance(person, Person)
        people[name] = person

    async def check() -> list[bool]:
        with (
            sign_ins.ending(people["anna"]) as one,
            sign_ins.ending(people["ben"]) as two,
            sign_ins.ending(people["carla"]) as three,
        ):
            await sign_ins.check(clock())
            assert not any(event.is_set() for event in (one, two, three))
            sign_ins.end(people["anna"].sign_in)
            accounts.set_role("ben", Role.DISPLAY)
            await sign_ins.check(clock())
            return [one.is_set(), two.is_set(), three.is_set()]

    assert asyncio.run(check()) == [True, True, False]


def test_a_program_that_locks_the_file_stops_no_page(
    class_lab: Gateway, monkeypatch: pytest.MonkeyPatch
) -> None:
    sign_ins, clock = class_lab.people.sign_ins, class_lab.clock
    class_lab.people.accounts.add("anna", Role.STUDENT)
    person = sign_ins.person(sign_ins.begin("anna", Role.STUDENT, clock()), clock())
    assert person is not None
    asked, free = threading.Event(), threading.Event()

    def locked(now: float) -> None:
        asked.set()
        free.wait(20)
        raise sqlite3.OperationalError("database is locked")

    monkeypatch.setattr(sign_ins, "_roles", locked)

    async def check() -> bool:
        with sign_ins.ending(person) as ended:
            checking = asyncio.create_task(sign_ins.check(clock()))
            # The loop goes on while the file is locked.
            while not asked.is_set():
                await asyncio.sleep(0.01)
            free.set()
            await checking
            return ended.is_set()

    assert asyncio.run(check()) is False


def test_who_gets_a_removed_name_is_another_person(class_lab: Gateway) -> None:
    accounts = class_lab.people.accounts
    ids = []
    for _ in range(3):
        anna = class_lab.browser("anna")
        ids.append(anna.user["id"])
        accounts.remove("anna")
    accounts.add("anna-2", Role.STUDENT)
    assert [*ids, accounts.get("anna-2").id] == ["anna", "anna-2", "anna-3", "anna-2-2"]


def test_the_last_instructor_stays_one(class_lab: Gateway) -> None:
    teacher = class_lab.browser("teacher", Role.INSTRUCTOR)
    demotion = {"json": {"role": "student"}}
    for ending in ({"method": "PATCH", **demotion}, {"method": "DELETE"}):
        answer = teacher.send(path="/api/people/Teacher", **ending)
        assert code_of(answer) == (409, "last_instructor")
    class_lab.browser("other", Role.INSTRUCTOR)
    assert teacher.send("PATCH", "/api/people/teacher", **demotion).status_code == 200


@pytest.mark.parametrize(
    ("host", "counted"),
    [
        ("192.0.2.7", "192.0.2.7"),
        ("::ffff:192.0.2.7", "192.0.2.7"),
        ("2001:db8:1:2:3:4:5:6", "2001:db8:1:2::/64"),
        ("2001:db8:1:2::1", "2001:db8:1:2::/64"),
        ("testclient", "testclient"),
    ],
)
def test_limits_count_an_ipv6_network_as_one_client(host: str, counted: str) -> None:
    assert address_of(HTTPConnection({"type": "http", "client": (host, 1)})) == counted


def test_what_a_removed_person_owned_is_kept_given_or_erased(tmp_path: Path) -> None:
    lab, refuse = FakeLab(), True

    def answer(request: Any) -> dict[str, Any]:
        return {"success": not refuse, "code": "handed_over"}

    lab.serve("converter/hand_over", "mrlab_msgs/srv/HandOver", answer)
    lab.serve("converter/erase", "mrlab_msgs/srv/Remove", answer)
    with Gateway(tmp_path, public_url="https://lab.example.org", lab=lab) as gateway:
        teacher = gateway.browser("teacher", Role.INSTRUCTOR)
        for name in ("anna", "ben", "carla", "dora"):
            gateway.people.accounts.add(name, Role.STUDENT)

        def remove(path: str) -> tuple[int, str]:
            response = teacher.send("DELETE", f"/api/people/{path}")
            return (204, "") if response.status_code == 204 else code_of(response)

        assert remove("anna?data=hand_over&to=nobody-here") == (404, "no_person")
        assert remove("teacher?data=erase") == (409, "last_instructor")
        assert not lab.calls
        # Where the store does not do it the person stays, to try it again.
        assert remove("anna?data=hand_over&to=dora") == (400, "handed_over")
        assert gateway.people.accounts.get("anna")
        refuse = False
        assert remove("anna?data=hand_over&to=dora") == (204, "")
        assert remove("ben?data=erase") == (204, "")
        assert remove("carla") == (204, "")
        assert [each.name for each in gateway.people.accounts.all()] == ["dora", "teacher"]
        given, erased = (request for _, request in lab.calls[-2:])
        assert (given.owner, given.to, erased.name) == ("anna", "dora", "ben")


def test_the_log_names_who_did_what_and_no_secret(
    class_lab: Gateway, caplog: pytest.LogCaptureFixture
) -> None:
    caplog.set_level("INFO", "mrlab.gateway")
    teacher = class_lab.browser("teacher", Role.INSTRUCTOR)
    anna = class_lab.browser("anna")
    for _ in range(3):
        anna.get("/api/people")
    made = anna.send("POST", "/api/tokens", json={"program": "m\x1b[2J", "role": "student"})
    class_lab.browser().sign_in("an\x1bna", "wrong horse battery")
    teacher.send("PATCH", "/api/people/anna", json={"role": "operator"})
    teacher.send("DELETE", "/api/people/anna")
    lines = [each.getMessage() for each in caplog.records if each.name == "mrlab.gateway"]
    said = "\n".join(lines)
    assert sum("anna may not GET /api/people" in line for line in lines) == 1
    for part in ("anna signed in as student", "wrong password", "anna is operator", "removed"):
        assert part in said
    assert "\x1b" not in said
    for secret in (made.json()["token"], "wrong horse battery", PASSWORD):
        assert secret not in said
