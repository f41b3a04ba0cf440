"""A course as it is taught: files handed in and checked at once, marks in the gradebook."""

from __future__ import annotations

import time
from pathlib import Path

import pytest
from course_side import Course
from gateway_side import Gateway, code_of, kind_of

ROOT = Path(__file__).parents[4]
PICK = ROOT / "examples" / "pick_and_place_ur5e.mat"
SHORT = ROOT / "examples" / "quintic_ur5e.mat"
RUBRIC = """
name: Take it
robot: ur5e
scene: pick_and_place
reference: solution.mat
late: {due: "2026-09-20 12:00 +00:00", per_day: 10%}
tests:
  - {name: Takes the cube, expect: grasps cube_1 between 1 s and 4 s, points: 2, hint: Close it}
  - {name: In time, expect: cycle < 30 s, points: 1}
  - {name: Stays free, expect: no collision, points: 1, hidden: true}
"""


@pytest.fixture
def course(tmp_path):
    made = Course(tmp_path)
    with made.gateway:
        yield made
    made.platform.close()


def came(course: Course, who: str):
    """Return the browser of somebody who came from the course; it shares the event loop."""
    browser = course.gateway.browser()
    browser.http.portal = course.gateway.anyone.http.portal
    assert course.launch(browser, who).headers["location"] == "/class"
    return browser


def until(read, done):
    deadline = time.monotonic() + 240
    while time.monotonic() < deadline:
        found = read()
        if done(found):
            return found
        time.sleep(0.2)
    raise AssertionError(found)


def hand_in(browser, name: str, content: bytes):
    answer = browser.send("PUT", f"/api/hand_in/{name}", content=content)
    assert answer.status_code == 202, answer.text
    return until(lambda: browser.get("/api/hand_in").json(), lambda s: s["check"] is not None)


@pytest.mark.slow
@pytest.mark.timeout(600)
def test_a_course_from_the_first_file_to_the_gradebook(course, tmp_path) -> None:
    teacher, anna, ben = (came(course, who) for who in "tab")
    refused = anna.send("PUT", "/api/hand_in/run.mat", content=b"1")
    assert code_of(refused) == (400, "nothing_to_hand_in_for")
    for name, content in (("rubric.yaml", RUBRIC.encode()), ("solution.mat", PICK.read_bytes())):
        answer = teacher.send("PUT", f"/api/class/sources/{name}", content=content)
        assert answer.status_code == 204, answer.text
    assert code_of(teacher.send("POST", "/api/class/course/export")) == (400, "nothing_handed_in")

    # at once: how many pass, nothing of what is hidden, no points that count
    state = hand_in(anna, "run.mat", PICK.read_bytes())
    assert (state["course"], state["task"], state["member"]) == ("Robotics 1", "Take it", True)
    said = state["check"]["said"]
    assert (said["code"], said["values"]) == ("checked_at_once", {"passed": 2})
    assert [t["name"] for t in state["check"]["tests"]] == ["Takes the cube", "In time"]
    state = hand_in(ben, "run.mat", b"no workspace")
    assert state["check"]["said"]["severity"] == "error"
    state = hand_in(ben, "second.mat", SHORT.read_bytes())  # in place of the first
    assert state["handed_in"]["file"] == "second.mat"
    assert state["check"]["said"]["values"] == {"passed": 1, "lost": 1}
    assert state["check"]["tests"][0]["hint"] == "Close it"
    for name in ("..%2Fx.mat", ".about.json", "run.sh"):
        answer = ben.send("PUT", f"/api/hand_in/{name}", content=b"1")
        assert answer.status_code in (400, 404), name
    # whoever has an account here and does not come from the course
    other = course.gateway.browser("dora")
    assert code_of(other.send("PUT", "/api/hand_in/run.mat", content=b"1")) == (
        400, "not_of_course",
    )  # fmt: skip
    for method, path in (("GET", ""), ("POST", "/members"), ("POST", "/marks"), ("DELETE", "")):
        assert kind_of(ben.send(method, f"/api/class/course{path}")) == (403, "not_allowed")

    # the list of the course, page by page, and who is missing
    assert teacher.send("POST", "/api/class/course/members").status_code == 204
    state = teacher.get("/api/class/course").json()
    assert (state["count"], state["handed_in"], state["silent"]) == (3, 2, ["Cleo Klein"])

    # marked: a row for everybody of the course
    assert teacher.send("POST", "/api/class/course/export").status_code == 204
    ran(teacher, "/api/class/run", {"form": ""})
    shown = teacher.get("/api/class").json()
    assert shown["form"] == "course"
    assert [(s["name"], s["points"]) for s in shown["submissions"]] == [
        ("Anna Ärmel", 3.2), ("Ben Bauer", 1.6), ("Cleo Klein", 0),
    ]  # fmt: skip
    key = shown["submissions"][1]["key"]
    act = {"did": "mark", "key": key, "test": "Takes the cube", "points": 1.5, "text": "by hand"}
    assert teacher.send("POST", "/api/class/acts", json=act).status_code == 204
    assert code_of(teacher.send("POST", "/api/class/course/marks")) == (400, "not_released")
    assert ben.get("/api/hand_in").json()["mark"] is None
    ran(teacher, "/api/class/release")

    # one total: the student's, the gradebook's and the teacher's
    answer = teacher.send("POST", "/api/class/course/marks")
    assert answer.json()["said"]["values"] == {"count": 3}, answer.text
    assert answer.json()["problems"] == []
    scores = course.platform.scores
    assert {who: (s["scoreGiven"], s["scoreMaximum"]) for who, s in scores.items()} == {
        "a": (3.2, 4), "b": (3.1, 4), "c": (0, 4),
    }  # fmt: skip
    assert "Takes the cube: 1.5 of 2" in scores["b"]["comment"]
    assert "Stays free" not in scores["b"]["comment"]
    assert "Late: -0.4. Handed in 2 days late" in scores["b"]["comment"]
    mark = ben.get("/api/hand_in").json()["mark"]
    assert (mark["points"], mark["of"]) == (3.1, 4)
    assert "Stays free" not in str(mark)
    late = ben.send("PUT", "/api/hand_in/run.mat", content=PICK.read_bytes())
    assert code_of(late) == (400, "class_is_locked")

    # again: into the same column, also after who left the course is refused
    del course.platform.people["c"]
    answer = teacher.send("POST", "/api/class/course/marks").json()
    assert answer["said"]["values"] == {"count": 2}
    assert [p["values"]["student"] for p in answer["problems"]] == ["Cleo Klein"]
    assert len(course.platform.columns) == 1


def ran(teacher, path, body=None) -> None:
    answer = teacher.send("POST", path, json=body)
    assert answer.status_code == 202, answer.text

    def run():
        return teacher.get("/api/class").json()["desk"]["run"]

    assert until(run, lambda found: not found["running"])["problem"] is None


def test_the_marks_go_to_the_task_that_was_connected(course) -> None:
    teacher = course.gateway.browser()
    course.launch(teacher, "t")
    course.launch(teacher, "t", "task-2")
    anna, ben = course.gateway.browser(), course.gateway.browser()
    course.launch(anna, "a", "task-2")
    course.launch(ben, "b")
    assert anna.get("/api/hand_in").json()["member"] is False
    assert ben.get("/api/hand_in").json()["member"] is True
    assert teacher.send("DELETE", "/api/class/course").status_code == 204
    assert teacher.get("/api/class/course").json()["connected"] is False
    assert code_of(teacher.send("POST", "/api/class/course/members")) == (400, "no_course")
    course.launch(teacher, "t", "task-2")
    course.launch(anna, "a", "task-2")
    assert anna.get("/api/hand_in").json()["member"] is True


def test_no_other_host_gets_the_access(course) -> None:
    teacher = course.gateway.browser()
    elsewhere = {"context_memberships_url": "https://evil.example/members"}
    claim = "https://purl.imsglobal.org/spec/lti-nrps/claim/namesroleservice"
    course.platform.claims = {claim: elsewhere}
    course.launch(teacher, "t")
    answer = teacher.send("POST", "/api/class/course/members")
    assert code_of(answer) == (503, "course_leads_away")
    course.platform.claims = {claim: {"context_memberships_url": "http://[evil"}}
    course.launch(teacher, "t")
    answer = teacher.send("POST", "/api/class/course/members")
    assert code_of(answer) == (503, "course_leads_away")
    course.platform.claims = {claim: None}
    course.launch(teacher, "t")
    answer = teacher.send("POST", "/api/class/course/members")
    assert code_of(answer) == (400, "course_offers_not")


def test_a_platform_that_does_not_answer_is_named(course) -> None:
    teacher = course.gateway.browser()
    course.launch(teacher, "t")
    course.platform.close()
    answer = teacher.send("POST", "/api/class/course/members")
    assert code_of(answer) == (503, "course_silent")


def test_a_lab_without_a_platform_has_none_of_it(tmp_path) -> None:
    with Gateway(tmp_path, public_url="https://lab.example.org") as gateway:
        browser = gateway.browser("anna")
        assert browser.get("/api/session").json()["may"]["hands_in"] is False
        assert code_of(browser.get("/api/hand_in")) == (404, "no_lti")
        answer = browser.get("/api/lti/login", follow_redirects=False)
        assert answer.headers["location"] == "/sign-in?problem=not_found"
