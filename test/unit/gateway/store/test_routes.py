"""Uploads and trajectories over HTTP: what each person may see and do, and nothing else."""

import asyncio
import errno
import json
from functools import cache

import numpy as np
import pytest
import scipy.io
from fake_converter import FakeConverter
from fake_lab import FakeLab
from gateway_side import Gateway, code_of, kind_of, values_of
from memory_store import MemoryStore

from mrlab_ros.adapters.store import keys
from mrlab_ros.app.show.packed import unpacked
from mrlab_ros.core.bridge.rules import Role
from mrlab_ros.gateway.lab.definitions import installed_definitions
from mrlab_ros.gateway.uploads import receive
from mrlab_ros.gateway.uploads.receive import Bounds, Receiver
from mrlab_ros.gateway.uploads.routes import Desk

GOOD = b"good" + bytes(2000)
SITE = {"public_url": "https://lab.example.org"}


definitions = cache(installed_definitions)


class Class:
    """A gateway with a converter, and its people."""

    def __init__(self, tmp_path, **options):
        self.store, self.lab = MemoryStore(), FakeLab(definitions())
        self.converter = FakeConverter(self.lab, self.store)
        self.gateway = Gateway(tmp_path, lab=self.lab, store=self.store, **options)

    def __enter__(self):
        self.gateway.__enter__()
        return self

    def __exit__(self, *error):
        self.gateway.__exit__(*error)

    def person(self, name, role=Role.STUDENT):
        return Student(self.gateway.browser(name, role))


class Student:
    """What a page does for somebody."""

    def __init__(self, browser):
        self.browser = browser
        self.get = browser.get

    def send(self, method, path, **options):
        return self.browser.send(method, path, **options)

    def upload(self, data=GOOD, name="pick.mat"):
        return self.send("PUT", f"/api/uploads/{name}", content=data)

    def convert(self, data=GOOD, name="pick.mat", **options):
        upload = self.upload(data, name).json()["upload"]
        options = {"upload": upload, "robot_model": "ur5e", **options}
        return self.send("POST", "/api/conversions", json=options)

    def publish(self, name="pick", *, shared=False):
        draft = self.convert().json()["draft"]
        body = {"draft": draft, "id": name, "shared": shared}
        answer = self.send("POST", "/api/trajectories", json=body)
        assert answer.status_code == 200, answer.text
        return answer.json()

    def ids(self, **query):
        found = self.get("/api/trajectories", params=query).json()["trajectories"]
        return [f"{each['id']}@{each['version']}" for each in found]


@pytest.fixture
def school(tmp_path):
    with Class(tmp_path, **SITE) as school:
        yield school


@pytest.fixture
def anna(school):
    return school.person("anna")


@pytest.fixture
def ben(school):
    return school.person("ben")


@pytest.fixture
def teacher(school):
    return school.person("teacher", Role.INSTRUCTOR)


def test_from_a_file_to_a_trajectory_in_three_requests(school, anna):
    uploaded = anna.upload(name="Übung 1.mat")
    assert uploaded.status_code == 201
    body = uploaded.json()
    assert (body["file_name"], body["size"]) == ("Übung 1.mat", len(GOOD))
    converted = anna.send(
        "POST", "/api/conversions", json={"upload": body["upload"], "robot_model": "ur5e"}
    ).json()
    assert converted["outcome"] == "accepted"
    assert converted["trajectory"]["source_file"] == "Übung 1.mat"
    assert [w["code"] for w in converted["trajectory"]["warnings"]] == ["rate"]
    motion = anna.get(converted["motion"]).json()
    assert motion["verdict"] == "accepted"
    assert unpacked(motion["positions"]).shape == (60, 6)
    assert motion["robot"]["urdf"].startswith("<")
    published = anna.send(
        "POST", "/api/trajectories", json={"draft": converted["draft"], "id": "wave"}
    ).json()
    assert (published["id"], published["version"]) == ("anna/wave", 1)
    assert anna.ids() == ["anna/wave@1"]
    again = {"draft": converted["draft"], "id": "wave"}
    assert anna.send("POST", "/api/trajectories", json=again).json() == published


def test_a_refused_file_says_why_and_is_drawn(anna):
    body = anna.convert(b"bad").json()
    assert (body["outcome"], body["trajectory"], body["draft"]) == ("rejected", None, None)
    (finding,) = body["diagnostics"]
    assert (finding["severity"], finding["value"], finding["limit"]) == ("error", 4.0, None)
    (fix,) = finding["fixes"]
    assert (fix["option"], fix["value"]) == ("units", "deg")
    assert body["preview"]["values"][:7] == [1, 1, 1, 1, 1, 1, None]
    assert anna.get(body["motion"]).json()["verdict"] == "refused"


def test_options_reach_the_converter_with_whose_file_it_is(school, anna):
    anna.convert(columns="2:7", gripper="end", frame_rate=50.0, transpose=True)
    service, request = school.lab.calls[-1]
    assert service == "converter/convert"
    assert (request.columns, request.gripper, request.frame_rate) == ("2:7", "end", 50.0)
    assert request.transpose
    assert request.owner == "anna"
    assert request.upload.startswith("users/anna/uploads/")
    assert request.draft.startswith("users/anna/drafts/")
    assert (request.path, len(request.data)) == ("", 0)


def test_two_users_see_nothing_of_each_other(school, anna, ben, teacher):
    upload = anna.upload().json()["upload"]
    mine = anna.convert().json()
    refused = anna.convert(b"bad").json()
    anna.publish("secret")
    ben.publish("secret")
    assert anna.ids() == ["anna/secret@1"]
    assert ben.ids() == ["ben/secret@1"]
    assert teacher.ids() == ["anna/secret@1", "ben/secret@1"]
    here = "/api/trajectories/anna/secret"
    for method, path, body in [
        ("GET", f"{here}/motion", None),
        ("GET", f"{here}/sketch", None),
        ("GET", f"{here}/versions", None),
        ("GET", f"{here}/file", None),
        ("GET", f"{here}@1/file", None),
        ("PATCH", here, {"shared": True}),
        ("DELETE", here, None),
        ("POST", f"{here}/restore", {"version": 1}),
        ("GET", mine["motion"], None),
        ("GET", refused["motion"], None),
        ("POST", "/api/conversions", {"upload": upload, "robot_model": "ur5e"}),
    ]:
        answer = ben.send(method, path, json=body)
        assert kind_of(answer) == (404, "not_found"), path
        assert "anna/secret'" not in answer.text.replace("trajectory 'anna/secret'", "")
    draft = {"draft": mine["draft"], "id": "mine", "shared": False}
    assert ben.send("POST", "/api/trajectories", json=draft).status_code == 400
    assert anna.ids() == ["anna/secret@1"]


def test_what_is_shared_is_seen_and_not_changed(anna, ben, teacher):
    anna.publish("open", shared=True)
    assert ben.ids() == ["anna/open@1"]
    here = "/api/trajectories/anna/open"
    assert ben.get(f"{here}/motion").status_code == 200
    for method, path, body in [
        ("PATCH", here, {"shared": False}),
        ("DELETE", here, None),
        ("POST", f"{here}/restore", {"version": 1}),
    ]:
        assert code_of(ben.send(method, path, json=body)) == (403, "not_yours")
    assert anna.send("PATCH", here, json={"shared": False}).json()["shared"] is False
    assert ben.ids() == []
    assert teacher.send("PATCH", here, json={"shared": True}).status_code == 200
    assert ben.ids() == ["anna/open@1"]


def test_delete_undo_and_versions(anna):
    for _ in range(3):
        anna.publish("pick")
    here = "/api/trajectories/anna/pick"
    listed = anna.get(f"{here}/versions").json()["versions"]
    assert [each["version"] for each in listed] == [3, 2, 1]
    assert anna.send("DELETE", here).status_code == 204
    assert anna.ids() == []
    assert anna.ids(deleted=True) == ["anna/pick@3"]
    assert anna.get(f"{here}/motion").status_code == 404
    assert anna.send("POST", f"{here}/restore", json={"version": 0}).json()["version"] == 3
    assert anna.send("POST", f"{here}/restore", json={"version": 1}).json()["version"] == 4
    assert kind_of(anna.send("POST", f"{here}/restore", json={"version": 9})) == (400, "bad_input")
    assert anna.ids() == ["anna/pick@4"]


@pytest.mark.parametrize("form", ["json", "csv", "mat"])
def test_a_trajectory_is_downloaded(anna, tmp_path, form):
    anna.publish("pick")
    answer = anna.get(f"/api/trajectories/anna/pick/file?format={form}")
    assert answer.headers["content-disposition"] == f'attachment; filename="pick.{form}"'
    assert int(answer.headers["content-length"]) == len(answer.content)
    if form == "json":
        assert json.loads(answer.content)["id"] == "pick"
    elif form == "csv":
        assert answer.text.startswith("t,")
    else:
        path = tmp_path / "a.mat"
        path.write_bytes(answer.content)
        assert scipy.io.loadmat(path)["q"].shape == (60, 6)


def test_one_local_user_makes_the_labs_own(tmp_path):
    with Class(tmp_path) as school:
        local = Student(school.gateway.local())
        assert local.publish("quintic")["id"] == "quintic"
        assert local.ids() == ["quintic@1"]
        assert local.send("DELETE", "/api/trajectories/quintic").status_code == 204


@pytest.mark.parametrize(("name", "size", "expected"), [
    ("a.exe", 10, (400, "other_ending")), ("a.mat", 0, (400, "empty_upload")),
    ("a.mat", 5000, (413, "upload_too_large")),
    ("x" * 300 + ".mat", 10, (400, "file_name_length")),
    ("a%0Ab.mat", 10, (400, "file_name_signs")), ("a%00b.mat", 10, (400, "file_name_signs")),
    ("%2E%2E", 10, (400, "no_file_name")), ("", 10, (400, "no_file_name")),
])  # fmt: skip
def test_files_that_cannot_be_taken_leave_nothing(school, anna, name, size, expected):
    school.gateway.app.state.desk.receiver.bounds = Bounds(largest=4000, quota=100_000)
    assert code_of(anna.upload(bytes(size), name)) == expected
    assert school.store.list("users") == []


def test_a_form_is_no_file(school, anna):
    answer = anna.send("PUT", "/api/uploads/q.mat", files={"file": b"q"})
    assert code_of(answer) == (415, "came_as_form")
    assert school.store.list("users") == []


def test_a_quota_bounds_one_person_alone(school, anna, ben):
    school.gateway.app.state.desk.receiver.bounds = Bounds(largest=4000, quota=5000)
    assert anna.upload().status_code == 201
    assert anna.upload().status_code == 201
    answer = anna.upload()
    assert code_of(answer) == (413, "quota_full")
    assert ben.upload().status_code == 201
    assert len(school.store.list("users/anna")) == 2


def test_too_many_uploads_are_refused_with_a_time(school, anna):
    state = school.gateway.app.state
    state.desk = Desk(state.desk.receiver, steady=lambda: 0.0)
    codes = [anna.upload(b"").status_code for _ in range(101)]
    assert codes[-1] == 429
    assert set(codes[:-1]) == {400}


def test_a_store_that_fails_is_a_sentence_and_loses_nothing(school, anna):
    anna.publish("pick")
    school.store.broken = "it is away"
    for answer in (anna.upload(), anna.get("/api/trajectories/anna/pick/motion")):
        assert code_of(answer) == (503, "store_failed")
        assert values_of(answer)["why"] == "it is away"
    # What was read before is in memory, and is said to be that.
    listed = anna.get("/api/trajectories").json()
    assert [each["id"] for each in listed["trajectories"]] == ["anna/pick"]
    assert listed["problem"]["code"] == "last_known"
    school.store.broken = ""
    assert anna.ids() == ["anna/pick@1"]
    assert anna.get("/api/trajectories").json()["problem"] is None
    assert anna.get("/api/trajectories/anna/pick/motion").status_code == 200


def test_a_lab_that_is_not_there_is_a_sentence(school, anna):
    school.lab.withdraw("converter/convert")
    assert code_of(anna.convert())[0] == 504


@pytest.mark.parametrize("path", [
    "/api/trajectories/nothing/motion", "/api/trajectories/anna/x@0/file",
    "/api/trajectories/../x/versions", "/api/motions/" + "0" * 32,
    "/api/trajectories/a%00b/motion", "/api/trajectories/%F0%9F%A6%BE/motion",
])  # fmt: skip
def test_what_is_not_there_is_not_found(anna, path):
    assert anna.get(path).status_code in (404, 422)


def test_nobody_is_let_in_without_a_sign_in(school):
    stranger = Student(school.gateway.browser())
    assert stranger.get("/api/trajectories").status_code == 401
    assert stranger.upload().status_code == 401
    assert school.store.list("users") == []


def test_a_display_may_look_and_nothing_else(school, anna):
    anna.publish("open", shared=True)
    anna.publish("mine")
    screen = school.person("screen", Role.DISPLAY)
    assert screen.ids() == ["anna/open@1"]
    assert screen.upload().status_code == 403
    assert screen.send("DELETE", "/api/trajectories/anna/open").status_code == 403


def test_a_body_that_breaks_off_leaves_nothing(tmp_path):
    store = MemoryStore()
    receiver = Receiver(store, tmp_path)

    async def broken():
        yield bytes(3 << 20)
        raise ConnectionError("gone")

    with pytest.raises(ConnectionError):
        asyncio.run(receiver.receive("anna", "a.mat", None, broken()))
    assert store.list("users") == []
    assert list(tmp_path.iterdir()) == []


def test_two_bodies_at_once_share_a_quota(tmp_path):
    store = MemoryStore()
    receiver = Receiver(store, tmp_path, Bounds(largest=1 << 20, quota=150_000))

    async def slowly(other):
        for _ in range(10):
            yield bytes(10_000)
            other.set()
            await asyncio.sleep(0)

    async def both():
        event = asyncio.Event()
        return await asyncio.gather(
            *(receiver.receive("anna", f"{i}.mat", None, slowly(event)) for i in range(2)),
            return_exceptions=True,
        )

    results = asyncio.run(both())
    assert sum(isinstance(r, Exception) for r in results) >= 1
    assert sum(e.size for e in store.list("users")) <= 150_000
    assert asyncio.run(receiver.receive("anna", "last.mat", 10, _one(bytes(10)))).size == 10


async def _one(data):
    yield data


def test_an_upload_is_hashed_as_it_comes(anna):
    import hashlib

    data = np.random.default_rng(1).bytes(3 << 20)
    body = anna.upload(data).json()
    assert body["sha256"] == hashlib.sha256(data).hexdigest()


def test_keys_of_an_upload_keep_any_name(school, anna):
    anna.upload(name="ä ?#☃.mat".replace("?", "%3F").replace("#", "%23"))
    (entry,) = school.store.list("users/anna/uploads")
    assert keys.name_of(entry.key.rsplit("/", 1)[1]) == "ä ?#☃.mat"


def test_a_full_disk_is_a_sentence(school, anna, monkeypatch):
    def full(**_):
        raise OSError(errno.ENOSPC, "No space left on device")

    monkeypatch.setattr(receive.tempfile, "TemporaryFile", full)
    answer = anna.upload()
    assert code_of(answer) == (503, "gateway_disk_full")
    assert values_of(answer)["why"] == "No space left on device"
    assert school.store.list("users") == []
