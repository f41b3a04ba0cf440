"""Checks over HTTP: one at a time, of the lab's scene, said stale when that has changed."""

import asyncio
import time
from functools import cache

import pytest
from fake_converter import FakeConverter
from fake_lab import FakeLab
from gateway_side import Gateway, kind_of
from memory_store import MemoryStore

from mrlab_ros.app.check.diagnostics import NOT_IN_LAB
from mrlab_ros.core.base.diagnostic import plain
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.bridge.rules import Role
from mrlab_ros.core.checking.diagnostics import (
    CHECK_NOT_READY,
    CLAIM,
    COLLISION,
    IN_EMPTY_ROOM,
    NO_COLLISION,
)
from mrlab_ros.core.checking.report import Condition, State
from mrlab_ros.gateway.checks import desk, scene
from mrlab_ros.gateway.checks.desk import CheckDesk
from mrlab_ros.gateway.errors import TooMany
from mrlab_ros.gateway.lab.definitions import installed_definitions

definitions = cache(installed_definitions)
UPRIGHT = {"x": 0.0, "y": 0.0, "z": 0.0, "w": 1.0}
FINDING = COLLISION(
    robot="ur5e_1", link="wrist_3_link", kind="object", other="cube_1", time=0.4,
    point=(0.4, 0.1, 0.2), value=0.01, unit="m",
)  # fmt: skip
REPORT = {
    "verdict": "not_ready", "summary": plain(CHECK_NOT_READY(count=1, time=0.4, first=FINDING)),
    "claim": plain(CLAIM()), "hash": "abc", "duration": 0.5, "findings": [plain(FINDING)],
    "robots": [{"name": "ur5e_1", "hardware": [
        Condition(NO_COLLISION(), State.NOT, IN_EMPTY_ROOM()).plain()]}],
}  # fmt: skip


class FakeChecker:
    """Answers when it is told to."""

    def __init__(self):
        self.tasks, self.cancelled, self.problem = [], 0, None
        self.go = None  # an Event that holds the answer back; None: it comes at once

    async def check(self, task):
        self.tasks.append(task)
        try:
            if self.go is not None:
                await self.go.wait()
        except asyncio.CancelledError:
            self.cancelled += 1
            raise
        if self.problem:
            raise BadInput(self.problem)
        return REPORT


def placed(**more):
    return {"pose": {"position": {"x": 0.5, "y": 0.0, "z": 0.1}, "orientation": UPRIGHT}, **more}


class Lab:
    """A gateway with a lab of one robot and one object."""

    def __init__(self, tmp_path, **options):
        self.lab, store = FakeLab(definitions()), MemoryStore()
        FakeConverter(self.lab, store)
        self.checker = FakeChecker()
        self.gateway = Gateway(
            tmp_path, lab=self.lab, store=store, checker=self.checker, **options
        )
        joints = [f"joint_{n}" for n in range(6)]
        robot = placed(name="ur5e_1", model="ur5e", joint_names=joints)
        for key, kind in (("robots", "Robots"), ("surfaces", "Surfaces")):
            self.lab.offer(key, f"mrlab_msgs/msg/{kind}", latched=True)
        self.lab.publish("robots", {"robots": [robot]})
        self.lab.publish("surfaces", {})

    def signed_in(self, name, role):
        """Let somebody in at the one client whose requests share the application's loop."""
        self.gateway.browser(name, role)
        assert self.gateway.anyone.sign_in(name).status_code == 200
        return self.gateway.anyone

    def person(self, role=Role.OPERATOR):
        browser = self.signed_in(f"who_{role.value}", role)
        upload = browser.send("PUT", "/api/uploads/pick.mat", content=b"good" + bytes(99))
        wanted = {"upload": upload.json()["upload"], "robot_model": "ur5e"}
        draft = browser.send("POST", "/api/conversions", json=wanted).json()["draft"]
        body = {"draft": draft, "id": "pick", "shared": True}
        made = browser.send("POST", "/api/trajectories", json=body)
        assert made.status_code == 200, made.text
        return browser, f"{made.json()['id']}@{made.json()['version']}"


@pytest.fixture
def lab(tmp_path, monkeypatch):
    monkeypatch.setattr(scene, "FRESH_S", -1.0)
    made = Lab(tmp_path, public_url="https://lab.example.org")
    with made.gateway:
        made.gateway.app.state.checking.scenes._wait = 0.01
        yield made


def ask(browser, trajectory, robot="ur5e_1"):
    body = {"robot": robot, "trajectory": trajectory}
    return browser.send("POST", "/api/checks", json=body)


def state(browser, trajectory, robot="ur5e_1"):
    return browser.get("/api/checks", params={"robot": robot, "trajectory": trajectory}).json()


def when(browser, trajectory, *states):
    """Return what is known of a check once it is in one of these states."""
    deadline = time.monotonic() + 10
    while (found := state(browser, trajectory))["state"] not in states:
        assert time.monotonic() < deadline, found
    return found


def test_a_check_is_of_the_lab_as_it_stands_and_stale_when_that_has_changed(lab):
    browser, motion = lab.person()
    assert state(browser, motion)["state"] == "none"
    assert ask(browser, motion).status_code == 202
    found = when(browser, motion, "done")
    assert found["verdict"] == "not_ready"
    (first,) = found["findings"]
    assert (first["code"], first["time"], first["other"]) == ("collision", 0.4, "cube_1")
    assert found["conditions"][0]["condition"]["code"] == "no_collision"
    assert found["stale"] is None
    (task,) = lab.checker.tasks
    (entry,) = task.scene.document.robots
    assert (task.robot, entry.pose.position) == ("ur5e_1", (0.5, 0.0, 0.1))
    assert task.motion.is_file()
    # asked again in the same scene, nothing is computed
    assert ask(browser, motion).json()["state"] == "done"
    moved = placed(name="ur5e_1", model="ur5e", end_effector="hand")
    lab.lab.publish("robots", {"robots": [moved]})
    assert state(browser, motion)["stale"]["code"] == "other_model"
    ask(browser, motion)
    assert when(browser, motion, "done")["stale"] is None
    assert len(lab.checker.tasks) == 2


def test_a_check_that_fails_says_why_and_is_run_again(lab):
    browser, motion = lab.person()
    lab.checker.problem = NOT_IN_LAB(robot="ur5e_1")
    ask(browser, motion)
    assert when(browser, motion, "failed")["problem"]["code"] == "not_in_lab"
    lab.checker.problem = None
    ask(browser, motion)
    when(browser, motion, "done")


def test_a_check_is_cancelled_by_whoever_may_drive(lab):
    browser, motion = lab.person()
    lab.checker.go = asyncio.Event()
    ask(browser, motion)
    when(browser, motion, "running")
    query = {"robot": "ur5e_1", "trajectory": motion}
    assert browser.send("DELETE", "/api/checks", params=query).status_code == 204
    assert state(browser, motion)["state"] == "none"
    assert lab.checker.cancelled == 1


def test_who_may_not_drive_reads_what_was_found_and_asks_for_nothing(lab):
    browser, motion = lab.person()
    ask(browser, motion)
    when(browser, motion, "done")
    assert kind_of(ask(browser, "no_such")) == (404, "not_found")
    assert ask(browser, motion, "").status_code == 422
    student = lab.signed_in("greta", Role.STUDENT)
    assert state(student, motion)["summary"]["code"] == "check_not_ready"
    assert kind_of(ask(student, motion)) == (403, "not_allowed")


def test_a_draft_is_checked_alone_and_found_in_its_rows(lab):
    browser, _ = lab.person()
    upload = browser.send("PUT", "/api/uploads/next.mat", content=b"good" + bytes(99)).json()
    wanted = {"upload": upload["upload"], "robot_model": "ur5e"}
    draft = browser.send("POST", "/api/conversions", json=wanted).json()["draft"]
    (found,) = browser.get(f"/api/checks/drafts/{draft}").json()
    task = lab.checker.tasks[-1]
    assert (found["code"], found["first_row"]) == ("collision", 0.4 * task.motion.frame_rate + 1)
    assert [entry.model for entry in task.scene.document.robots] == ["ur5e"]
    assert task.scene.document.objects == ()
    lab.checker.problem = NOT_IN_LAB(robot="ur5e_1")
    other = browser.send("POST", "/api/conversions", json=wanted).json()["draft"]
    assert browser.get(f"/api/checks/drafts/{other}").status_code == 503
    stranger = lab.signed_in("greta", Role.STUDENT)
    assert kind_of(stranger.get(f"/api/checks/drafts/{draft}")) == (404, "not_found")


def test_another_motion_of_the_same_robot_ends_the_check_and_others_wait():
    async def run() -> None:
        checker = FakeChecker()
        checker.go = asyncio.Event()
        found = CheckDesk(checker)
        here = scene.LabScene(scene.SceneDocument())

        def asked(robot, motion):
            return found.ask((robot, motion), lambda: motion, here, motion)

        first = asked("a", "one@1")
        await asyncio.sleep(0)
        assert first.state == "running"
        assert asked("a", "one@1") is first
        waits = asked("b", "one@1")
        second = asked("a", "two@1")
        await asyncio.gather(first.work, return_exceptions=True)
        assert found.find(("a", "one@1")) is None
        assert checker.cancelled == 1
        for i in range(desk.MOST_WAITING - 2):
            asked(f"c{i}", "one@1")
        with pytest.raises(TooMany):
            asked("d", "one@1")
        checker.go.set()
        await asyncio.gather(waits.work, second.work)
        assert (waits.state, second.state) == ("done", "done")
        assert checker.tasks[:3] == ["one@1", "one@1", "two@1"]
        await found.close()

    asyncio.run(run())


def test_a_scene_is_read_from_the_messages_of_the_lab():
    known = definitions()

    def sample(key, kind, message):
        return scene.Sample(key, known.encode(kind, message))

    names = ["j1", "j2"]
    robots = sample("robots", scene.ROBOTS, {
        "robots": [placed(name="a", model="ur5e", joint_names=names),
                   placed(name="b", model="ur5e", joint_names=names)]})  # fmt: skip
    here = {"position": {"x": 0.0, "y": 0.0, "z": 0.2}, "orientation": UPRIGHT}
    objects = [placed(name="cube_1", type="cube", held_by="a", in_tool=here),
               placed(name="cube_2", type="cube", held_by="hand", in_tool=here)]  # fmt: skip
    newest = {
        "objects": sample("objects", scene.OBJECTS, {"objects": objects}),
        "a/joint_states": sample(
            "a/joint_states", scene.JOINTS,
            {"name": ["j2", "finger", "j1"], "position": [2.0, 0.5, 1.0]},
        ),
    }  # fmt: skip
    outline = [{"x": x, "y": y, "z": 0.0} for x, y in ((0, 0), (1, 0), (1, 1))]
    plane = placed(name="table_1", label="table", vertices=outline)
    surfaces = sample("surfaces", scene.SURFACES, {"surfaces": [plane]})
    found = scene.scene_of(known, robots, surfaces, newest)
    assert found.stands == {"a": (1.0, 2.0)}
    cube, other = found.document.objects
    assert (cube.held_by, other.held_by) == ("a", "")
    assert found.in_tool["cube_1"].position == (0.0, 0.0, 0.2)
    assert found.document.surfaces[0].vertices.shape == (3, 3)
    assert found.shown.values == {"objects": 2, "robots": 2}
