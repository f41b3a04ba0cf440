"""Pairing of devices, pure and over HTTP."""

from __future__ import annotations

import pytest
from gateway_side import Browser, Gateway, code_of
from refusals import refused

from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.bridge.rules import Role
from mrlab_ros.gateway.errors import NotFound, TooMany
from mrlab_ros.gateway.people.diagnostics import PAIRED_ROLE_TOO_HIGH
from mrlab_ros.gateway.people.pairing import (
    LETTERS,
    LIFETIME_S,
    TRIES,
    WAITING,
    Pairings,
    normal,
    shown,
)
from mrlab_ros.gateway.people.person import Person

ANNA = Person("anna", Role.STUDENT)
TEACHER = Person("teacher", Role.INSTRUCTOR)


def test_a_device_is_let_in_by_its_code_once() -> None:
    pairings = Pairings()
    pairing = pairings.begin("Quest 3", 0.0)
    assert set(pairing.code) <= set(LETTERS)
    assert pairings.collect(pairing.secret, 1.0) is None
    pairings.approve(shown(pairing.code).lower(), ANNA, Role.STUDENT, 2.0)
    found = pairings.collect(pairing.secret, 3.0)
    assert found is not None
    assert found.granted == (ANNA, Role.STUDENT)
    with pytest.raises(NotFound):
        pairings.collect(pairing.secret, 4.0)


def test_a_code_is_good_for_two_minutes_and_one_approval() -> None:
    pairings = Pairings()
    late, twice = pairings.begin("a", 0.0), pairings.begin("b", 1.0)
    pairings.approve(twice.code, ANNA, Role.STUDENT, 2.0)
    with pytest.raises(NotFound):
        pairings.approve(twice.code, TEACHER, Role.INSTRUCTOR, 3.0)
    with pytest.raises(NotFound):
        pairings.approve(late.code, ANNA, Role.STUDENT, LIFETIME_S)
    with pytest.raises(NotFound):
        pairings.collect(late.secret, LIFETIME_S)


def test_after_five_wrong_codes_a_person_waits() -> None:
    pairings = Pairings()
    right = pairings.begin("a", 0.0).code
    for i in range(TRIES):
        with pytest.raises(NotFound):
            pairings.approve("BBBB-BBBB", ANNA, Role.STUDENT, float(i))
    with pytest.raises(TooMany):
        pairings.approve(right, ANNA, Role.STUDENT, 10.0)
    pairings.approve(right, TEACHER, Role.DISPLAY, 10.0)
    again = pairings.begin("a", LIFETIME_S).code
    pairings.approve(again, ANNA, Role.STUDENT, LIFETIME_S + 1)


def test_a_device_gets_no_more_than_its_person_has() -> None:
    pairings = Pairings()
    code = pairings.begin("a", 0.0).code
    with refused(PAIRED_ROLE_TOO_HIGH, BadInput, person="anna", wanted="operator"):
        pairings.approve(code, ANNA, Role.OPERATOR, 1.0)
    pairings.approve(code, ANNA, Role.DISPLAY, 2.0)


def test_devices_that_wait_are_bounded() -> None:
    pairings = Pairings()
    for _ in range(WAITING):
        pairings.begin("a", 0.0)
    with pytest.raises(TooMany):
        pairings.begin("a", 1.0)
    pairings.begin("a", LIFETIME_S)


def test_codes_are_read_as_people_type_them() -> None:
    assert normal(" bcdf ghjk ") == normal("BCDF-GHJK") == "BCDFGHJK"
    assert shown("BCDFGHJK") == "BCDF-GHJK"


def test_a_headset_is_paired_by_a_phone(class_lab: Gateway) -> None:
    headset, phone = class_lab.browser(), class_lab.browser("anna", Role.OPERATOR)
    shown_there = headset.send("POST", "/api/pairings", json={"device": "Quest 3"}).json()
    assert shown_there["url"].startswith("https://lab.example.org/pair/")
    asked = f"/api/pairings/{shown_there['secret']}"
    assert headset.get(asked).json()["state"] == "waiting"
    shows = phone.get(f"/api/pairings/shown/{shown_there['code']}")
    assert shows.json() == {"device": "Quest 3", "program": False}
    body = {"code": shown_there["code"], "role": "student"}
    approved = phone.send("POST", "/api/pairings/approve", json=body)
    user = {"id": "anna", "name": "Quest 3", "role": "student"}
    assert approved.json() == {"state": "approved", "user": user, "token": ""}
    assert headset.get(asked).json()["state"] == "approved"
    assert headset.user == {"id": "anna", "name": "anna", "role": "student"}
    devices = phone.get("/api/devices").json()["devices"]
    (device,) = [each for each in devices if each["name"] == "Quest 3"]
    phone.send("DELETE", f"/api/devices/{device['id']}")
    assert headset.user is None
    assert headset.get(asked).json()["state"] == "expired"


def paired(class_lab: Gateway, by: Browser) -> Browser:
    device = class_lab.browser()
    begun = device.send("POST", "/api/pairings").json()
    body = {"code": begun["code"], "role": "student"}
    assert by.send("POST", "/api/pairings/approve", json=body).status_code == 200
    device.get(f"/api/pairings/{begun['secret']}")
    assert device.user is not None
    return device


def test_a_device_lets_no_device_in_and_ends_with_who_let_it_in(class_lab: Gateway) -> None:
    phone = class_lab.browser("anna")
    headset, waiting = paired(class_lab, by=phone), class_lab.browser()
    code = waiting.send("POST", "/api/pairings").json()["code"]
    body = {"code": code, "role": "student"}
    answer = headset.send("POST", "/api/pairings/approve", json=body)
    assert code_of(answer) == (403, "device_lets_in")
    browser = class_lab.browser()
    browser.sign_in("anna")
    (first,) = [each["id"] for each in phone.get("/api/devices").json()["devices"] if each["this"]]
    assert browser.send("DELETE", f"/api/devices/{first}").status_code == 204
    assert (phone.user, headset.user) == (None, None)
    assert browser.user is not None


def test_a_device_loses_what_its_person_loses(class_lab: Gateway) -> None:
    class_lab.browser("teacher", Role.INSTRUCTOR)
    headset, phone = class_lab.browser(), class_lab.browser("anna", Role.OPERATOR)
    begun = headset.send("POST", "/api/pairings").json()
    phone.send("POST", "/api/pairings/approve", json={"code": begun["code"], "role": "operator"})
    headset.get(f"/api/pairings/{begun['secret']}")
    assert headset.user == {"id": "anna", "name": "anna", "role": "operator"}
    class_lab.people.accounts.set_role("anna", Role.STUDENT)
    assert headset.user == {"id": "anna", "name": "anna", "role": "student"}
    class_lab.people.accounts.set_role("anna", Role.INSTRUCTOR)
    assert headset.user == {"id": "anna", "name": "anna", "role": "operator"}
    class_lab.people.accounts.remove("anna")
    assert headset.user is None


def test_no_other_site_can_collect_a_sign_in_for_its_visitor(class_lab: Gateway) -> None:
    phone, begun = (
        class_lab.browser("eve"),
        class_lab.browser().send("POST", "/api/pairings").json(),
    )
    phone.send("POST", "/api/pairings/approve", json={"code": begun["code"], "role": "student"})
    victim = class_lab.browser()
    headers = {"sec-fetch-site": "cross-site"}
    response = victim.get(f"/api/pairings/{begun['secret']}", headers=headers)
    assert code_of(response) == (403, "own_pages_only")
    assert victim.user is None


def test_a_display_and_a_stranger_let_nothing_in(class_lab: Gateway) -> None:
    display, stranger = class_lab.browser("screen", Role.DISPLAY), class_lab.browser()
    begun = stranger.send("POST", "/api/pairings").json()
    body = {"code": begun["code"], "role": "display"}
    assert code_of(display.send("POST", "/api/pairings/approve", json=body)) == (
        403, "role_too_low",
    )  # fmt: skip
    assert code_of(stranger.send("POST", "/api/pairings/approve", json=body)) == (
        401, "not_signed_in",
    )  # fmt: skip
