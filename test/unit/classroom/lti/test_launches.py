"""Launches from a platform of the tests' own, over HTTP: who is let in, and who is not."""

from __future__ import annotations

from typing import Any

import pytest
import yaml
from course_side import SITE, Course
from gateway_side import kind_of
from joserfc import jwk, jwt
from learning_platform import CLAIM, DL
from refusals import refused

from mrlab_ros.classroom.lti.diagnostics import LTI_WITHOUT_CLASS
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.bridge.rules import Role
from mrlab_ros.gateway.settings import Settings


@pytest.fixture
def course(tmp_path):
    made = Course(tmp_path)
    with made.gateway:
        yield made
    made.platform.close()


def problem_of(answer: Any) -> str:
    """Return with which word a browser is led back to the page of signing in."""
    assert answer.status_code == 303, answer.text
    page, _, problem = answer.headers["location"].partition("?problem=")
    assert page == "/sign-in"
    return str(problem)


def test_people_of_the_course_come_signed_in(course) -> None:
    for who, name, role in (("t", "Grace_Teacher", "instructor"), ("a", "Anna_Armel", "student")):
        browser = course.gateway.browser()
        answer = course.launch(browser, who)
        assert (answer.status_code, answer.headers["location"]) == (303, "/class"), answer.text
        assert browser.user == {"id": name, "name": name, "role": role}
    may = browser.get("/api/session").json()["may"]
    assert (may["grades"], may["hands_in"], may["commands"]) == (False, True, False)
    teacher = course.gateway.browser()
    course.launch(teacher, "t")
    assert len(course.gateway.people.accounts.all()) == 2
    state = teacher.get("/api/class/course").json()
    assert (state["connected"], state["course"], state["task"]) == (
        True, "Robotics 1", "Pick and place",
    )  # fmt: skip
    # who no longer teaches there is no teacher here, but the only instructor stays one
    course.platform.people["t"].role = "Learner"
    course.launch(teacher, "t")
    assert teacher.user["role"] == "instructor"
    course.gateway.people.accounts.add("hugo", Role.INSTRUCTOR)
    course.launch(teacher, "t")
    assert teacher.user["role"] == "student"


def test_a_launch_that_is_used_again_signs_nobody_in(course) -> None:
    browser = course.gateway.browser()
    form = course.platform.launched(course.begin(browser, "a"))
    cookie = dict(browser.http.cookies)
    assert course.finish(browser, form).status_code == 303
    # without the browser's cookie, and with it
    assert problem_of(course.finish(course.gateway.browser(), form)) == "not_begun"
    again = course.gateway.browser()
    again.http.cookies.update(cookie)
    assert problem_of(course.finish(again, form)) == "not_confirmed"
    assert again.user is None


def test_a_launch_of_another_browser_or_too_late_is_none(course) -> None:
    attacker, victim = course.gateway.browser(), course.gateway.browser()
    form = course.platform.launched(course.begin(attacker, "b"))
    course.begin(victim, "a")
    assert problem_of(course.finish(victim, form)) == "not_begun"
    form = course.platform.launched(course.begin(victim, "a"))
    course.gateway.clock.now += 700
    assert problem_of(course.finish(victim, form)) == "not_begun"
    assert problem_of(course.finish(victim, {**form, "state": f"9{form['state']}"})) == "not_begun"
    assert victim.user is None


@pytest.mark.parametrize(
    "claims",
    [
        {"iss": "https://evil.example"}, {"aud": "other"}, {"aud": ["mrlab-tool", "other"]},
        {"nonce": "old"}, {"exp": 1_000_000}, {"sub": None}, {"iat": None},
        {f"{CLAIM}version": "1.1"}, {f"{CLAIM}message_type": "Other"},
        {f"{CLAIM}deployment_id": "8"}, {f"{CLAIM}context": {"id": "robotics-2"}},
        {f"{CLAIM}context": None}, {f"{CLAIM}resource_link": None},
    ],
)  # fmt: skip
def test_a_launch_that_is_not_for_here_signs_nobody_in(course, claims) -> None:
    course.platform.claims = claims
    browser = course.gateway.browser()
    assert problem_of(course.launch(browser, "t")) in ("not_confirmed", "not_allowed")
    assert browser.user is None
    assert course.gateway.people.accounts.all() == []


def test_another_platform_cannot_begin(course) -> None:
    browser = course.gateway.browser()
    for change in ({"iss": "https://evil.example"}, {"client_id": "other"}):
        asked = course.platform.begins("t") | change
        answer = browser.http.get("/api/lti/login", params=asked, follow_redirects=False)
        assert problem_of(answer) == "not_confirmed"


def test_the_platform_s_keys_may_change_and_foreign_ones_sign_nobody_in(course) -> None:
    browser = course.gateway.browser()
    assert course.launch(browser, "a").headers["location"] == "/class"
    asked = course.platform.keys_asked
    course.launch(course.gateway.browser(), "b")
    assert course.platform.keys_asked == asked  # known by then
    course.gateway.clock.now += 20
    course.platform.rotate()
    assert course.launch(course.gateway.browser(), "c").headers["location"] == "/class"
    # a key that the platform does not publish, under its name and under another one
    course.platform.signs_with = jwk.RSAKey.generate_key(2048)
    assert problem_of(course.launch(course.gateway.browser(), "t")) == "not_confirmed"
    form = course.platform.launched(course.begin(browser, "t"))
    own = jwk.RSAKey.generate_key(2048, {"kid": "evil"})
    claims = jwt.decode(form["id_token"], course.platform.signs_with).claims
    for algorithm, key in (("RS256", own), ("HS256", jwk.OctKey.generate_key(256))):
        head = {"alg": algorithm, "kid": "evil"}
        form["id_token"] = jwt.encode(head, claims, key, algorithms=[algorithm])
        assert problem_of(course.finish(browser, form)) == "not_confirmed"
    # who asks with names of keys again and again makes this lab ask the platform seldom
    asked = course.platform.keys_asked
    for _ in range(5):
        course.finish(browser, form)
    assert course.platform.keys_asked == asked


def test_a_teacher_adds_the_task_to_the_course(course, tmp_path) -> None:
    sources = tmp_path / "class" / "sources"
    sources.mkdir(parents=True)
    (sources / "rubric.yaml").write_text(
        "name: Greifen & <setzen>\nrobot: ur5e\ntests:\n"
        "  - {name: In time, expect: cycle < 30 s, points: 12}\n"
    )
    browser = course.gateway.browser()
    asked = course.platform.begins("t")
    begun = browser.http.post("/api/lti/login", data=asked, follow_redirects=False)
    assert {"secure", "httponly", "samesite=none", "partitioned"} <= {
        part.strip().lower() for part in begun.headers["set-cookie"].split(";")
    }  # the platform shows this in a frame
    page = course.launch(browser, "t", "link")
    assert page.status_code == 200
    assert "Diese Aufgabe in den Kurs aufnehmen" in page.text
    assert "Greifen &amp; &lt;setzen&gt;" in page.text
    policy = page.headers["content-security-policy"]
    assert f"frame-ancestors {course.platform.url}" in policy
    assert f"form-action {course.platform.url};" in policy
    assert browser.user is None  # the course's frame needs no sign-in
    token = page.text.partition('name="JWT" value="')[2].partition('"')[0]
    sent = browser.http.build_request("POST", "/", data={"JWT": token}).content
    assert course.platform.answer("POST", "/linked", {}, sent)[0] == 200
    claims = course.platform.linked[0]
    assert claims[f"{CLAIM}message_type"] == "LtiDeepLinkingResponse"
    assert claims[f"{DL}data"] == "of the platform"
    (item,) = claims[f"{DL}content_items"]
    assert item["lineItem"] == {"label": "Greifen & <setzen>", "scoreMaximum": 12.0}
    assert item["url"] == f"{SITE}/class"
    assert problem_of(course.launch(browser, "a", "link")) == "not_confirmed"


def test_other_posts_of_other_sites_are_refused_as_ever(course) -> None:
    browser = course.gateway.browser()
    course.launch(browser, "a")
    elsewhere = {"origin": course.platform.url}
    for path in ("/api/hand_in/a.mat", "/api/lti/launch/", "/api/session", "/api/lti/keys"):
        answer = browser.http.request("PUT", path, headers=elsewhere)
        assert kind_of(answer) == (403, "origin"), path
    course.gateway.anyone.get("/api/session")
    for state in ("9" * 6000, "1790000000.x", "\u0660.x", ".x", ""):
        browser.http.cookies.set(
            f"mrlab-lti-{course.gateway.people.database.lab_id}",
            state if state.isascii() else "",
            domain="lab.example.org", path="/api/lti",
        )  # fmt: skip
        problem = problem_of(course.finish(browser, {"state": state, "id_token": "x.y.z"}))
        assert problem in ("not_begun", "not_confirmed"), state
    large = {"state": "x" * 300_000}
    assert problem_of(course.finish(browser, large)) == "too_large"


def test_a_platform_needs_a_class(tmp_path) -> None:
    file = tmp_path / "lti.yaml"
    file.write_text(yaml.safe_dump({**dict.fromkeys(
        ("issuer", "sign_in", "tokens", "keys"), "https://moodle.example"
    ), "client_id": "x", "deployments": "1", "courses": "2"}))  # fmt: skip
    with refused(LTI_WITHOUT_CLASS, BadInput):
        Settings(state_dir=tmp_path, lti=file).check()
    file.write_text("issuer: moodle\n")
    with pytest.raises(BadInput):
        Settings(state_dir=tmp_path, lti=file, classroom=tmp_path / "class").check()
