"""/api/robots: where the robots stand, and what is loaded and played."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from fake_converter import FakeConverter
from fake_lab import FakeLab
from gateway_side import Gateway, code_of
from memory_store import MemoryStore

from mrlab_ros.core.bridge.rules import Role
from mrlab_ros.core.playback.states import State

NAMES = ["a", "b"]
REFUSED = {"success": False, "code": "illegal_event", "message": "cannot load in PLAYING"}


class Served:
    """A lab with one robot that plays and refuses to load while it does."""

    def __init__(self, folder: Path) -> None:
        self.lab, self.store = FakeLab(), MemoryStore()
        FakeConverter(self.lab, self.store)
        self.moving = True
        self.asked: list[tuple[str, Any]] = []
        for verb, kind in (
            ("load", "LoadTrajectory"), ("play", "Trigger"), ("pause", "Trigger"),
            ("set_rate", "SetRate"), ("stop", "Trigger"),
        ):  # fmt: skip
            self.lab.serve(f"ur5e_1/{verb}", f"mrlab_msgs/srv/{kind}", self._answer(verb))
        latched = {"latched": True}
        robot = {"name": "ur5e_1", "model": "ur5e", "joint_names": NAMES,
                 "pose": {"orientation": {"w": 1.0}}}  # fmt: skip
        self.lab.offer("robots", "mrlab_msgs/msg/Robots", **latched)
        self.lab.publish("robots", {"robots": [robot]})
        self.lab.offer("ur5e_1/joint_states", "sensor_msgs/msg/JointState")
        self.lab.offer("ur5e_1/playback_state", "mrlab_msgs/msg/PlaybackState", **latched)
        self.is_in(State.PLAYING)
        self.gateway = Gateway(
            folder, lab=self.lab, store=self.store, public_url="https://lab.example.org"
        )

    def is_in(self, state: State) -> None:
        playing = {"state": state.value, "label": state.name, "trajectory_id": "pick",
                   "trajectory_version": 2, "duration": 8.0, "rate": 1.0}  # fmt: skip
        self.lab.publish("ur5e_1/playback_state", playing)

    def _answer(self, verb: str) -> Any:
        def answer(request: Any) -> dict[str, Any]:
            self.asked.append((verb, getattr(request, "id", getattr(request, "rate", None))))
            if verb in ("pause", "stop"):
                self.moving = False
            if verb == "stop":
                self.is_in(State.PAUSED)
            return REFUSED if verb == "load" and self.moving else {"success": True}

        return answer


@pytest.fixture
def served(tmp_path: Path) -> Iterator[Served]:
    served = Served(tmp_path)
    with served.gateway:
        yield served


def drafted(person: Any) -> dict[str, str]:
    found = person.send(
        "PUT", "/api/live/a.mat", content=b"good" + bytes(9), params={"robot_model": "ur5e"}
    ).json()
    return {"draft": found["conversion"]["draft"], "id": "pick"}


def published(person: Any) -> None:
    body = drafted(person)
    assert person.send("POST", "/api/trajectories", json=body).status_code == 200


def test_the_robots_and_what_they_play(served: Served) -> None:
    anna = served.gateway.browser("anna")
    (robot,) = anna.get("/api/robots").json()["robots"]
    assert (robot["name"], robot["state"], robot["trajectory"]) == ("ur5e_1", "PLAYING", "pick@2")
    assert robot["positions"] is None


def test_a_robot_that_moves_is_paused_where_that_is_asked_for(served: Served) -> None:
    anna = served.gateway.browser("anna", Role.OPERATOR)
    published(anna)
    play = {"trajectory": "anna/pick"}
    refused = anna.send("POST", "/api/robots/ur5e_1/play", json=play)
    assert code_of(refused) == (409, "illegal_event")
    served.asked.clear()
    play |= {"replace": True, "rate": 0.5}
    assert anna.send("POST", "/api/robots/ur5e_1/play", json=play).status_code == 200
    assert served.asked == [
        ("pause", None), ("load", "anna/pick@1"), ("set_rate", 0.5), ("play", None)
    ]  # fmt: skip


def test_nobody_plays_what_they_may_not_see_or_without_the_right(served: Served) -> None:
    anna, ben = (served.gateway.browser(name, Role.OPERATOR) for name in ("anna", "ben"))
    published(anna)
    play = {"trajectory": "anna/pick", "replace": True}
    answer = ben.send("POST", "/api/robots/ur5e_1/play", json=play)
    assert code_of(answer) == (404, "no_trajectory_of_name")
    screen = served.gateway.browser("screen", Role.DISPLAY)
    answer = screen.send("POST", "/api/robots/ur5e_1/play", json=play)
    assert code_of(answer) == (403, "role_too_low")
    assert served.asked == []


def test_a_robot_that_a_collision_halted_is_stopped_or_replaced(served: Served) -> None:
    anna = served.gateway.browser("anna", Role.OPERATOR)
    published(anna)
    play = {"trajectory": "anna/pick"}
    served.is_in(State.COLLISION_HALT)
    answer = anna.send("POST", "/api/robots/ur5e_1/play", json=play)
    assert code_of(answer) == (409, "illegal_event")
    assert served.asked == []
    answer = anna.send("POST", "/api/robots/ur5e_1/play", json=play | {"replace": True})
    assert answer.status_code == 200
    assert [verb for verb, _ in served.asked] == ["stop", "load", "set_rate", "play"]
    served.is_in(State.COLLISION_HALT)
    assert anna.send("POST", "/api/robots/ur5e_1/stop").json()["state"] == "PAUSED"
    answer = anna.send("POST", "/api/robots/nobody/stop")
    assert code_of(answer) == (404, "no_robot_in_scene")


def test_a_draft_is_published_by_a_play_that_is_carried_out_alone(served: Served) -> None:
    anna = served.gateway.browser("anna", Role.OPERATOR)
    play = {"publish": drafted(anna)}
    answer = anna.send("POST", "/api/robots/ur5e_1/play", json=play)
    assert code_of(answer) == (409, "illegal_event")
    assert anna.get("/api/trajectories").json()["trajectories"] == []
    answer = anna.send("POST", "/api/robots/ur5e_1/play", json=play | {"replace": True})
    assert answer.json()["trajectory"] == "anna/pick@1"
    answer = anna.send("POST", "/api/robots/ur5e_1/play", json={})
    assert code_of(answer) == (422, "bad_request")
