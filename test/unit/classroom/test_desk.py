"""The desk of a class as a teacher uses it, over HTTP, with the runs that it starts."""

from __future__ import annotations

import csv
import io
import time
import zipfile
from pathlib import Path

import pytest
from fake_lab import FakeLab
from gateway_side import Gateway, kind_of
from memory_store import MemoryStore

from mrlab_ros.core.bridge.rules import Role
from mrlab_ros.gateway.lab.definitions import installed_definitions

# runs start processes that import everything and check the reference: slow on a busy machine
pytestmark = [pytest.mark.slow, pytest.mark.timeout(400)]

ROOT = Path(__file__).parents[3]
PICK = ROOT / "examples" / "pick_and_place_ur5e.mat"
RUBRIC = """
name: Take it
robot: ur5e
scene: pick_and_place
reference: solution.mat
tests:
  - {name: Takes the cube, expect: grasps cube_1 between 1 s and 4 s, points: 2}
  - {name: In time, expect: cycle < 30 s, points: POINTS}
"""
SHEET = "Identifier,Full name,Grade,Maximum Grade\n" + "".join(
    f"Participant {n},{name},,6\n" for n, name in enumerate(("Anna", "Ben", "Cem Roe"), 1)
)


@pytest.fixture
def gateway(tmp_path):
    lab, store = FakeLab(installed_definitions()), MemoryStore()
    folder = tmp_path / "class"
    with Gateway(
        tmp_path, lab=lab, store=store, classroom=folder, public_url="https://x.org"
    ) as g:
        yield g


def signed_in(gateway, name):
    """Return a teacher's browser, whose requests share the gateway's event loop."""
    teacher = gateway.browser(name, Role.INSTRUCTOR)
    teacher.http.portal = gateway.anyone.http.portal
    return teacher


def export():
    content = io.BytesIO()
    with zipfile.ZipFile(content, "w") as archive:
        archive.write(PICK, "Anna_1_assignsubmission_file_/run.mat")
        archive.writestr("Ben_2_assignsubmission_file_/run.mat", b"no workspace")
        archive.write(PICK, "by mail/roe_cem.mat")
    return content.getvalue()


def ran(teacher):
    """Wait for the end of a run; return the class."""
    deadline = time.monotonic() + 180
    while time.monotonic() < deadline:
        shown = teacher.get("/api/class").json()
        if not shown["desk"]["run"]["running"]:
            assert shown["desk"]["run"]["problem"] is None
            return shown
        time.sleep(0.2)
    raise AssertionError("the run does not end")


def hand_in(teacher, name, content):
    answer = teacher.send("PUT", f"/api/class/sources/{name}", content=content)
    assert answer.status_code == 204, answer.text


def act(teacher, **values):
    return teacher.send("POST", "/api/class/acts", json=values)


def test_a_class_is_marked_changed_marked_again_released_and_downloaded(gateway, tmp_path):
    teacher, second = (signed_in(gateway, n) for n in ("grace", "hugo"))
    empty = teacher.get("/api/class").json()
    assert (empty["marked"], empty["submissions"]) == (False, [])
    refused = teacher.send("POST", "/api/class/run", json={})
    assert refused.json()["error"]["code"] == "sources_missing"
    hand_in(teacher, "export.zip", export())
    hand_in(teacher, "rubric.yaml", RUBRIC.replace("POINTS", "1").encode())
    assert teacher.get("/api/class").json()["desk"]["missing"] == ["solution.mat"]
    hand_in(teacher, "solution.mat", PICK.read_bytes())
    hand_in(teacher, "worksheet.csv", SHEET.encode())
    assert teacher.send("POST", "/api/class/run", json={"form": ""}).status_code == 202
    shown = ran(teacher)
    assert (shown["form"], shown["marked"]) == ("Moodle", True)
    ben = shown["submissions"][1]["key"]
    assert [s["points"] for s in shown["submissions"]] == [3, 0]

    # a mark by hand, a comment, a second marker
    assert (
        act(teacher, did="mark", key=ben, test="Takes the cube", points=1.5).json()["error"][
            "code"
        ]
        == "mark_without_reason"
    )
    mark = {"did": "mark", "key": ben, "test": "Takes the cube", "points": 1.5, "text": "on paper"}
    said = act(teacher, **(mark | {"points": 99})).json()["error"]
    assert (said["code"], said["values"]["most"]) == ("changed_mark_out_of_range", 2)
    assert act(teacher, **mark).status_code == 204
    assert act(teacher, did="comment", key=ben, text="Come and see me").status_code == 204
    said = act(teacher, did="second", key=ben, test="Takes the cube", points=1)
    assert said.json()["error"]["code"] == "second_is_first"
    assert act(second, did="second", key=ben, test="Takes the cube", points=1).status_code == 204
    shown = teacher.get("/api/class").json()
    of_ben = shown["submissions"][1]
    assert (of_ben["points"], of_ben["comment"]) == (1.5, "Come and see me")
    change = of_ben["marks"][0]["change"]
    assert (change["who"], change["given"], change["reason"]) == ("grace", 0, "on paper")
    assert (of_ben["marks"][0]["second"]["points"], shown["desk"]["differing"]) == (1, 1)
    assert (
        teacher.send("POST", "/api/class/release").json()["error"]["code"] == "second_marks_differ"
    )
    assert act(second, did="undo").status_code == 204

    # a file of nobody is of somebody who is in the table, and then marked like the others
    (stray,) = shown["desk"]["unmatched"]
    assert (stray["what"], stray["proposed"], stray["decided"]) == ("by mail", "Cem Roe", False)
    assigned = act(teacher, did="assign", key=stray["proposal"], text=stray["what"])
    assert assigned.status_code == 204
    assert teacher.get("/api/class").json()["desk"]["unmatched"][0]["decided"] is True

    # another rubric: the differences are shown, nothing is simulated, and the mark by hand holds
    evidence = {p.name: p.read_bytes() for p in (tmp_path / "class" / "evidence").iterdir()}
    hand_in(teacher, "rubric.yaml", RUBRIC.replace("POINTS", "4").encode())
    teacher.send("POST", "/api/class/run", json={})
    shown = ran(teacher)
    assert [s["points"] for s in shown["submissions"]] == [3, 1.5]
    changed = shown["desk"]["proposed"]
    assert [(d["name"], d["before"], d["after"]) for d in changed] == [
        ("Anna", 3, 6), ("Cem Roe", None, 6),
    ]  # fmt: skip
    assert teacher.send("POST", "/api/class/proposed").status_code == 202
    shown = ran(teacher)
    assert [s["points"] for s in shown["submissions"]] == [6, 1.5, 6]
    assert (shown["desk"]["proposed"], shown["desk"]["unmatched"]) == (None, [])
    folder = tmp_path / "class" / "evidence"
    after = {p.name: p.read_bytes() for p in folder.iterdir()}
    assert {name: after[name] for name in evidence} == evidence

    # the marks of the run before hold again, with those that were given by hand
    assert teacher.send("POST", "/api/class/before").status_code == 202
    shown = ran(teacher)
    assert [s["points"] for s in shown["submissions"]] == [3, 1.5, 3]
    assert (shown["desk"]["before"], shown["desk"]["journal"][0]["did"]) == (False, "take_back")
    again = teacher.send("POST", "/api/class/before")
    assert again.json()["error"]["code"] == "nothing_to_undo"
    assert {p.name: p.read_bytes() for p in folder.iterdir()} == after

    # released: one total everywhere, and no change any more
    assert teacher.get("/api/class/feedback.zip").json()["error"]["code"] == "not_released"
    assert teacher.send("POST", "/api/class/release").status_code == 202
    shown = ran(teacher)
    assert shown["desk"]["released"] == "grace"
    assert [note["code"] for note in shown["desk"]["run"]["notes"]] == ["maximum_differs"]
    assert act(teacher, **mark).json()["error"]["code"] == "class_is_locked"
    rows = list(csv.DictReader(io.StringIO(teacher.get("/api/class/grades.csv").text[1:])))
    assert [row["points"] for row in rows] == ["3", "1.5", "3"]
    sheet = teacher.get("/api/class/worksheet.csv").text
    assert [row["Grade"] for row in csv.DictReader(io.StringIO(sheet))] == ["3", "1.5", "3"]
    with zipfile.ZipFile(io.BytesIO(teacher.get("/api/class/feedback.zip").content)) as archive:
        place = "Ben_2_assignsubmission_file_/feedback.txt"
        assert archive.namelist().count("Anna_1_assignsubmission_file_/feedback.html") == 1
        told = archive.read(place).decode()
    assert told.startswith("1.5 of 3 points")
    assert "Come and see me" in told
    assert act(teacher, did="undo").status_code == 204
    assert act(teacher, **mark).status_code == 204


def test_students_reach_nothing_of_it(gateway):
    student = gateway.browser("greta", Role.STUDENT)
    for method, path in (
        ("PUT", "sources/rubric.yaml"), ("POST", "run"), ("POST", "acts"), ("POST", "release"),
        ("GET", "feedback.zip"), ("GET", "grades.csv"), ("DELETE", "proposed"),
    ):  # fmt: skip
        assert kind_of(student.send(method, f"/api/class/{path}")) == (403, "not_allowed")


@pytest.mark.parametrize("name", ["..%2Fx.mat", ".hidden.mat", "run.sh"])
def test_files_stay_in_their_folder(gateway, name):
    teacher = signed_in(gateway, "grace")
    answer = teacher.send("PUT", f"/api/class/sources/{name}", content=b"1")
    assert answer.status_code in (400, 404, 422)
    rubric = RUBRIC.replace("solution.mat", "../../etc/passwd").replace("POINTS", "1")
    answer = teacher.send("PUT", "/api/class/sources/rubric.yaml", content=rubric.encode())
    assert answer.status_code == 204
    assert teacher.get("/api/class").json()["desk"]["missing"] == ["passwd"]
    answer = teacher.send("PUT", "/api/class/sources/rubric.yaml", content=b"PK\xff")
    assert answer.json()["error"]["values"]["file"] == "rubric.yaml"
