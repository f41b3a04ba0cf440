"""The class of a gateway over HTTP: for instructors, and as its folder is now."""

import errno
import json
import os

import pytest
from class_folder import make_class
from fake_converter import FakeConverter
from fake_lab import FakeLab
from gateway_side import Gateway, code_of, kind_of
from memory_store import MemoryStore
from refusals import refused

from mrlab_ros.adapters.trajectories import formats
from mrlab_ros.classroom import desk
from mrlab_ros.classroom.diagnostics import NO_CLASS_FILE
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.bridge.rules import Role
from mrlab_ros.gateway.lab.definitions import installed_definitions
from mrlab_ros.gateway.settings import Settings

SITE = "https://lab.example.org"


@pytest.fixture
def folder(tmp_path):
    return make_class(tmp_path / "class")


@pytest.fixture
def gateway(tmp_path, folder):
    lab, store = FakeLab(installed_definitions()), MemoryStore()
    FakeConverter(lab, store)
    with Gateway(tmp_path, lab=lab, store=store, public_url=SITE, classroom=folder) as gateway:
        yield gateway


def test_a_teacher_steps_through_a_class(gateway, folder):
    teacher = gateway.browser("grace", Role.INSTRUCTOR)
    assert teacher.get("/api/session").json()["may"]["grades"] is True
    shown = teacher.get("/api/class").json()
    assert [(s["key"], s["points"], s["motion"]) for s in shown["submissions"]] == [
        ("anna", 3, True),
        ("ben", 0.5, True),
        ("cleo", 0, False),
    ]
    assert shown["reference"]["key"] == "reference"
    motion = teacher.get("/api/class/ben/motion").json()
    assert (motion["schema"], motion["title"]) == ("mrlab.motion.1", "Ben")
    lost, partly, collision = motion["findings"]
    rate = motion["frame_rate"]
    assert (lost["code"], lost["values"]["test"]) == ("lost_points", "no collision")
    assert lost["values"]["found"]["code"] == "touches"
    assert (lost["severity"], lost["first_row"]) == ("error", round(0.2 * rate) + 1)
    assert (partly["severity"], partly["first_row"]) == ("warning", 0)
    assert (collision["code"], collision["last_row"]) == ("collision", round(0.3 * rate) + 1)
    file = teacher.get("/api/class/ben/file")
    assert formats.parse(file.content, "ben.json").robot_model == "ur5e"
    answer = teacher.get("/api/class/cleo/motion")
    assert kind_of(answer) == (404, "not_found")
    assert answer.json()["error"]["code"] == "no_motion_to_show"
    assert kind_of(teacher.get("/api/class/dora/motion")) == (404, "not_found")
    # marked again meanwhile
    path = folder / "class.json"
    path.write_text(path.read_text().replace('"Pick and place"', '"Pick again"'))
    assert teacher.get("/api/class").json()["title"] == "Pick again"


def test_names_and_marks_are_the_teachers(gateway):
    for role in (Role.STUDENT, Role.OPERATOR):
        browser = gateway.browser(f"who_{role.value}", role)
        assert browser.get("/api/session").json()["may"]["grades"] is False
        for path in ("/api/class", "/api/class/anna/motion", "/api/class/anna/file"):
            assert kind_of(browser.get(path)) == (403, "not_allowed")


def test_a_full_disk_is_said_of_whatever_is_sent(gateway, monkeypatch):
    def full(*_, **__):
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    teacher = gateway.browser("grace", Role.INSTRUCTOR)
    monkeypatch.setattr(desk.tempfile, "TemporaryDirectory", full)
    answer = teacher.send("PUT", "/api/class/sources/rubric.yaml", content=b"name: x")
    assert code_of(answer) == (503, "machine_lacks")
    assert answer.json()["error"]["values"] == {"lack": "disk"}


def test_no_path_leads_out_of_the_folder(gateway, folder):
    teacher = gateway.browser("grace", Role.INSTRUCTOR)
    path = folder / "class.json"
    document = json.loads(path.read_text())
    document["students"][0]["trajectory"] = "../../secret.json"
    (folder.parent.parent / "secret.json").write_text("{}")
    path.write_text(json.dumps(document))
    answer = teacher.get("/api/class/anna/motion")
    assert answer.json()["error"]["code"] == "motion_outside"


def test_what_is_no_class_is_said(gateway, folder, tmp_path):
    teacher = gateway.browser("grace", Role.INSTRUCTOR)
    (folder / "class.json").write_text('{"schema": "mrlab.class.9"}')
    answer = teacher.get("/api/class")
    assert answer.json()["error"]["code"] == "other_class_schema"
    (folder / "class.json").unlink()
    assert teacher.get("/api/class").json()["marked"] is False
    Settings(state_dir=tmp_path, classroom=folder).check()
    (folder / "thesis.txt").write_text("not of a class")
    with refused(NO_CLASS_FILE, BadInput, file="class.json"):
        Settings(state_dir=tmp_path, classroom=folder).check()


def test_a_gateway_without_a_class_says_how_to_show_one(tmp_path):
    with Gateway(tmp_path) as gateway:
        answer = gateway.local().get("/api/class")
    assert kind_of(answer) == (404, "not_found")
