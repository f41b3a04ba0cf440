"""Signing in and out over HTTP: passwords, one-time links, the local user, cookies."""

from __future__ import annotations

import errno
import os
import re
import sqlite3
from typing import Any

import httpx
import pytest
from fastapi.testclient import TestClient
from gateway_side import PASSWORD, Gateway, code_of
from refusals import refused

from mrlab_ros.adapters.diagnostics import NO_ROOM_ON_DISK
from mrlab_ros.core.base.errors import Unavailable
from mrlab_ros.core.bridge.rules import Role
from mrlab_ros.gateway.people.accounts import INVITATION_LIFETIME_S, OPENING_LIFETIME_S
from mrlab_ros.gateway.people.sign_ins import LIFETIME_S, SEEN_PERIOD_S, Database


def test_nobody_is_signed_in_at_first_and_no_names_are_told(class_lab: Gateway) -> None:
    class_lab.browser("anna")
    stranger = class_lab.browser()
    answer = stranger.get("/api/session").json()
    assert answer["user"] is None
    ways = {"password": True, "oidc": False, "pairing": True, "course": False}
    assert answer["ways"] == ways
    for path in ("/api/people", "/api/devices"):
        response = stranger.get(path)
        assert code_of(response) == (401, "not_signed_in")
        assert "anna" not in response.text


def test_a_person_signs_in_and_out(class_lab: Gateway) -> None:
    anna = class_lab.browser("anna", Role.OPERATOR)
    assert anna.user == {"id": "anna", "name": "anna", "role": "operator"}
    assert anna.send("DELETE", "/api/session").status_code == 204
    assert anna.user is None


def test_a_wrong_name_and_a_wrong_password_get_the_same_answer(class_lab: Gateway) -> None:
    class_lab.browser("anna")
    wrong = [class_lab.browser().sign_in(*each) for each in (("anna", "nonsense"), ("eve", "no"))]
    assert [code_of(each) for each in wrong] == [(401, "wrong_password")] * 2
    assert wrong[0].text == wrong[1].text


@pytest.mark.parametrize("url", ["https://lab.example.org", "http://lab.example.org"])
def test_the_cookie_is_out_of_reach_of_scripts_and_other_sites(tmp_path, url) -> None:
    with Gateway(tmp_path, public_url=url) as lab:
        lab.browser("anna")
        cookie = lab.browser().sign_in("anna").headers["set-cookie"]
    assert {"HttpOnly", "SameSite=strict", "Path=/"} <= set(cookie.split("; "))
    assert "domain" not in cookie.lower()
    secure = url.startswith("https")
    assert ("Secure" in cookie) == secure
    assert cookie.startswith("__Host-mrlab-" if secure else "mrlab-")


def test_two_labs_of_one_machine_have_cookies_of_their_own(tmp_path) -> None:
    with Gateway(tmp_path / "a") as one, Gateway(tmp_path / "b") as other:
        assert one.people.cookie != other.people.cookie
        assert re.fullmatch(r"mrlab-[0-9a-f]{8}", one.people.cookie)


def test_nobody_waits_for_another_process_that_writes(class_lab: Gateway) -> None:
    anna = class_lab.browser("anna")
    seen = class_lab.people.sign_ins.all(class_lab.clock(), "anna")[0].seen
    class_lab.clock.now += 2 * SEEN_PERIOD_S
    with sqlite3.connect(class_lab.people.database.path, isolation_level=None) as other:
        other.execute("BEGIN IMMEDIATE")
        # Two minutes, where each waits.
        assert {anna.get("/api/session").json()["user"]["name"] for _ in range(24)} == {"anna"}
        assert class_lab.people.sign_ins.all(class_lab.clock(), "anna")[0].seen == seen
        other.execute("ROLLBACK")
    anna.get("/api/session")
    assert class_lab.people.sign_ins.all(class_lab.clock(), "anna")[0].seen > seen


def test_a_full_disk_signs_nobody_in_and_nobody_out(class_lab: Gateway) -> None:
    anna, ben = class_lab.browser("anna"), class_lab.browser("ben")
    execute = class_lab.people.database._connection.execute
    (used,) = execute("PRAGMA page_count").fetchone()
    execute(f"PRAGMA max_page_count = {used}")
    with refused(NO_ROOM_ON_DISK, Unavailable):
        for _ in range(1000):
            class_lab.people.sign_ins.begin("ben", Role.STUDENT, class_lab.clock())
    assert code_of(class_lab.browser().sign_in("ben")) == (503, "no_room_on_disk")
    class_lab.clock.now += 2 * SEEN_PERIOD_S
    assert all(browser.user for browser in (anna, ben))
    execute("PRAGMA max_page_count = 1000000")
    assert class_lab.browser().sign_in("ben").is_success


def test_a_full_disk_is_no_wrong_configuration(tmp_path, monkeypatch) -> None:
    def full(*_: object) -> int:
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    monkeypatch.setattr(os, "open", full)
    # the gateway is started again, where a BadInput that is no Unavailable would end the lab
    with refused(NO_ROOM_ON_DISK, Unavailable):
        Database(tmp_path / "users.sqlite")


def test_a_sign_in_ends_after_its_time(class_lab: Gateway) -> None:
    anna = class_lab.browser("anna")
    class_lab.clock.now += LIFETIME_S - 1
    assert anna.user
    class_lab.clock.now += 2
    assert anna.user is None


def test_an_invitation_is_good_once(class_lab: Gateway) -> None:
    teacher = class_lab.browser("teacher", Role.INSTRUCTOR)
    made = teacher.send("POST", "/api/people", json={"name": "anna", "role": "student"})
    assert made.status_code == 201
    assert made.json()["qr"].startswith("<svg")
    base, _, token = made.json()["url"].rpartition("/")
    assert base == "https://lab.example.org/invitation"
    anna = class_lab.browser()
    path = f"/api/invitations/{token}"
    assert anna.get(path).json() == {"name": "anna", "role": "student"}
    assert code_of(anna.send("POST", path, json={"password": "x" * 11})) == (
        400,
        "password_length",
    )
    accepted = anna.send("POST", path, json={"password": PASSWORD})
    assert accepted.json()["user"] == {"id": "anna", "name": "anna", "role": "student"}
    assert anna.user == {"id": "anna", "name": "anna", "role": "student"}
    again = class_lab.browser().send("POST", path, json={"password": PASSWORD})
    assert code_of(again) == (404, "link_used")
    assert class_lab.browser().sign_in("anna").status_code == 200


def test_an_invitation_expires_and_a_new_one_replaces_it(class_lab: Gateway) -> None:
    class_lab.browser("anna")
    accounts, clock = class_lab.people.accounts, class_lab.clock
    first = accounts.invite("anna", clock())
    second = accounts.invite("anna", clock())
    stranger = class_lab.browser()
    assert stranger.get(f"/api/invitations/{first}").status_code == 404
    assert stranger.get(f"/api/invitations/{second}").status_code == 200
    clock.now += INVITATION_LIFETIME_S + 1
    assert stranger.get(f"/api/invitations/{second}").status_code == 404


def test_a_new_password_ends_earlier_sign_ins(class_lab: Gateway) -> None:
    anna = class_lab.browser("anna")
    secret = class_lab.people.accounts.invite("anna", class_lab.clock())
    assert anna.user
    body = {"password": "another long one"}
    other = class_lab.browser()
    assert other.send("POST", f"/api/invitations/{secret}", json=body).status_code == 200
    assert anna.user is None
    assert other.user


def test_the_local_user_enters_by_the_link_once(local_lab: Gateway) -> None:
    token = local_lab.people.accounts.open(local_lab.clock())
    mine, theirs = local_lab.browser(), local_lab.browser()
    response = mine.get(f"/lab?token={token}", follow_redirects=False)
    assert response.status_code == 303
    assert response.headers["location"] == "/lab"
    assert mine.user == {"id": "local", "name": "local", "role": "instructor"}
    theirs.get(f"/?token={token}")
    assert theirs.user is None
    assert code_of(theirs.get("/api/devices")) == (401, "not_signed_in")


def test_the_link_does_not_lead_away_and_expires(local_lab: Gateway) -> None:
    token = local_lab.people.accounts.open(local_lab.clock())
    local_lab.clock.now += OPENING_LIFETIME_S + 1
    late = local_lab.browser()
    response = late.http.get(
        f"http://localhost:8080//evil.example?token={token}", follow_redirects=False
    )
    assert response.headers["location"] == "/evil.example"
    assert late.user is None


def test_the_pages_know_what_a_person_may(class_lab: Gateway, local_lab: Gateway) -> None:
    student = class_lab.browser("anna").get("/api/session").json()["may"]
    assert not any(student.values())
    assert class_lab.browser().get("/api/session").json()["may"] == student
    # this lab shows no class
    assert local_lab.local().get("/api/session").json()["may"] == {
        "commands": True, "scene": True, "replay": True, "grades": False, "hands_in": False,
    }  # fmt: skip


def test_without_keys_nobody_else_can_be_let_in(local_lab: Gateway) -> None:
    local = local_lab.local()
    assert local.get("/api/session").json()["ways"] == {
        "password": False, "oidc": False, "pairing": False, "course": False,
    }  # fmt: skip
    body = {"name": "anna", "role": "student"}
    assert code_of(local.send("POST", "/api/people", json=body)) == (403, "one_local_user")
    assert code_of(local.sign_in("anna")) == (403, "one_local_user")


def test_sign_ins_are_slowed_down(class_lab: Gateway) -> None:
    class_lab.browser("anna")
    stranger = class_lab.browser()
    tries = [stranger.sign_in("anna", "guess") for _ in range(15)]
    assert tries[0].status_code == 401
    assert code_of(tries[-1]) == (429, "too_many_requests")
    assert int(tries[-1].headers["retry-after"]) > 0
    class_lab.clock.now += 300
    assert stranger.sign_in("anna").status_code == 200


def test_a_class_behind_one_address_signs_in_while_one_of_them_guesses(
    class_lab: Gateway,
) -> None:
    students = {name: class_lab.browser(name) for name in ("anna", "ben", "carla")}
    for browser in students.values():
        assert browser.send("DELETE", "/api/session").status_code == 204
    stranger = class_lab.browser()
    for number in range(100):
        stranger.sign_in(f"anna{number % 9}" if number % 2 else "anna", "guess")
    assert code_of(class_lab.browser().sign_in("ben")) == (429, "too_many_requests")
    for name, browser in students.items():
        assert browser.sign_in(name).status_code == 200


def test_a_known_browser_is_slowed_down_too_and_known_for_its_own_person_alone(
    class_lab: Gateway,
) -> None:
    class_lab.browser("anna")
    ben = class_lab.browser("ben")
    for name in ("ben", "anna"):
        tries = [code_of(ben.sign_in(name, "guess")) for _ in range(12)]
        assert tries[0] == (401, "wrong_password")
        assert tries[-1] == (429, "too_many_requests")
    # ben's browser has no attempts of its own for anna: these counted for the address
    assert code_of(class_lab.browser().sign_in("anna")) == (429, "too_many_requests")
    assert class_lab.browser().sign_in("ben").status_code == 200


def test_a_copy_of_the_file_holds_no_secret(class_lab: Gateway) -> None:
    anna = class_lab.browser("anna")
    cookies = [str(each.value) for each in anna.http.cookies.jar]
    assert len(cookies) == 2
    link = class_lab.people.accounts.invite("anna", class_lab.clock())
    folder = class_lab.people.database.path.parent
    stored = b"".join(file.read_bytes() for file in folder.glob("users.sqlite*"))
    assert b"anna" in stored
    assert not any(each.encode() in stored for each in (*cookies, link, PASSWORD))
    assert class_lab.people.database.path.stat().st_mode & 0o077 == 0


def asked(
    class_lab: Gateway, method: str, path: str, token: str, **options: Any
) -> httpx.Response:
    """Ask as a program does: without Origin, cookie and CSRF token."""
    headers = {"authorization": f"Bearer {token}"}
    http = TestClient(class_lab.app, base_url=class_lab.url)
    return http.request(method, path, headers=headers, **options)


def test_a_program_acts_for_a_person_until_it_is_ended(class_lab: Gateway) -> None:
    anna = class_lab.browser("anna", Role.OPERATOR)
    body = {"program": "matlab", "role": "student", "days": 1}
    token = anna.send("POST", "/api/tokens", json=body).json()["token"]
    session = asked(class_lab, "GET", "/api/session", token).json()
    assert session["user"] == {"id": "anna", "name": "anna", "role": "student"}
    (row,) = [
        each for each in anna.get("/api/devices").json()["devices"] if each["name"] == "matlab"
    ]
    # It lets nobody in, changes what it may without an Origin, and is no cookie.
    refused = asked(class_lab, "POST", "/api/tokens", token, json=body)
    assert code_of(refused) == (403, "device_lets_in")
    as_cookie = {"cookie": f"{class_lab.people.cookie}={token}"}
    assert class_lab.anyone.get("/api/session", headers=as_cookie).json()["user"] is None
    ended = asked(class_lab, "DELETE", f"/api/devices/{row['id']}", token)
    assert ended.status_code == 204
    assert asked(class_lab, "GET", "/api/session", token).json()["user"] is None


def test_a_token_is_no_more_than_its_person_and_expires(class_lab: Gateway) -> None:
    anna = class_lab.browser("anna")
    body = {"program": "matlab", "role": "instructor"}
    answer = anna.send("POST", "/api/tokens", json=body)
    assert code_of(answer) == (400, "paired_role_too_high")
    body |= {"role": "student", "days": 1}
    token = anna.send("POST", "/api/tokens", json=body).json()["token"]
    class_lab.clock.now += 2 * 24 * 3600
    assert asked(class_lab, "GET", "/api/session", token).json()["user"] is None


def test_a_program_is_let_in_by_the_code_that_it_shows(class_lab: Gateway) -> None:
    anna = class_lab.browser("anna")
    program = TestClient(class_lab.app, base_url=class_lab.url)
    begun = program.post("/api/pairings", json={"device": "matlab", "program": True}).json()
    path = f"/api/pairings/{begun['secret']}"
    assert program.get(path).json()["token"] == ""
    body = {"code": begun["code"], "role": "student"}
    anna.send("POST", "/api/pairings/approve", json=body)
    token = program.get(path).json()["token"]
    assert not program.cookies
    user = asked(class_lab, "GET", "/api/session", token).json()["user"]
    assert (user["id"], user["role"]) == ("anna", "student")


def test_the_local_user_lets_a_program_in(local_lab: Gateway) -> None:
    program = TestClient(local_lab.app, base_url=local_lab.url)
    begun = program.post("/api/pairings", json={"program": True}).json()
    body = {"code": begun["code"], "role": "operator"}
    assert local_lab.local().send("POST", "/api/pairings/approve", json=body).status_code == 200
    token = program.get(f"/api/pairings/{begun['secret']}").json()["token"]
    user = asked(local_lab, "GET", "/api/session", token).json()["user"]
    assert user == {"id": "local", "name": "local", "role": "operator"}
