"""A script's view of a robot: what its callbacks raise, and runs whose robot is heard no more."""

from __future__ import annotations

from typing import Any

import pytest
from mrlab_msgs import msg
from mrlab_msgs.srv import LoadTrajectory
from refusals import refused
from sensor_msgs.msg import JointState

from mrlab_ros.client import robot as under_test
from mrlab_ros.client.diagnostics import RUN_SILENT
from mrlab_ros.client.follow import Follower
from mrlab_ros.client.robot import LabRobot, Run, halted
from mrlab_ros.core.base.diagnostic import of_text
from mrlab_ros.core.base.diagnostics import ILLEGAL_EVENT
from mrlab_ros.core.base.errors import Misuse
from mrlab_ros.core.playback.diagnostics import AT_POSITION, BACK_AT_BEGIN, HALTED_BY_CONTACT
from mrlab_ros.messages.texts import tell
from mrlab_ros.ros.calls import NoAnswer


class FakeGraph:
    """Stands for a GraphClient: keeps the subscriptions."""

    def __init__(self) -> None:
        self.callbacks: dict[str, Any] = {}

    def subscribe(self, kind: Any, topic: str, callback: Any, quality: Any) -> None:
        self.callbacks[topic] = callback


@pytest.fixture
def graph() -> FakeGraph:
    return FakeGraph()


def playing(state: int = msg.PlaybackState.PLAYING) -> msg.PlaybackState:
    return msg.PlaybackState(state=state)


def test_a_callback_that_raises_gets_the_next_joint_state(graph, capsys) -> None:
    seen = []

    def callback(sample: Any) -> None:
        seen.append(sample.positions)
        raise ValueError("in a script")

    LabRobot(graph, msg.Robot(name="ur5e_1")).watch(callback)
    for position in (1.0, 2.0):
        graph.callbacks["/ur5e_1/joint_states"](JointState(position=[position]))
    assert seen == [(1.0,), (2.0,)]
    assert capsys.readouterr().err.count("ValueError: in a script") == 2


@pytest.mark.parametrize("state", under_test.MOVING)
def test_waiting_for_a_robot_that_is_heard_no_more_ends(graph, monkeypatch, state: int) -> None:
    clock = [100.0]
    monkeypatch.setattr("time.monotonic", lambda: clock[0])
    follower = Follower(graph, "ur5e_1")
    run = Run(follower, 0)
    graph.callbacks["/ur5e_1/playback_state"](playing(state))
    clock[0] += under_test.SILENCE_S
    run.advance()
    clock[0] += 1
    with refused(RUN_SILENT, NoAnswer, robot="ur5e_1", silent=11):
        run.wait()
    # Its telemetry alone is a sign of life; and one that stands paused need give none.
    graph.callbacks["/ur5e_1/telemetry"](msg.Telemetry())
    run.advance()
    graph.callbacks["/ur5e_1/playback_state"](playing(msg.PlaybackState.PAUSED))
    clock[0] += 100
    run.advance()


def touches(other: str):
    return HALTED_BY_CONTACT(link="forearm_link", other=other)


def commands(said) -> list[str]:
    return [fix.command for fix in said.fixes]


def test_a_halt_names_what_ends_it_in_the_order_in_which_it_is_done():
    said = halted("ur5e_1", touches("cube_1"), ["cube_1"])
    assert said.code == "halted"
    assert commands(said) == [
        "mrlab stop ur5e_1",
        "mrlab objects remove cube_1",
        "mrlab place ur5e_1 --at X,Y",
        "mrlab resume ur5e_1",
    ]


@pytest.mark.parametrize("why", [BACK_AT_BEGIN(), AT_POSITION(position=1.5)])
def test_a_halted_robot_that_was_taken_elsewhere_is_not_sent_there_again(why):
    said = halted("ur5e_1", why, ["cube_1"])
    assert (said.code, said.values["why"]) == ("still_halted", why)
    assert commands(said) == [
        "mrlab objects list",
        "mrlab place ur5e_1 --at X,Y",
        "mrlab resume ur5e_1",
    ]


def test_a_robot_or_a_surface_is_not_removed():
    for other in ("kuka_1", "floor"):
        said = halted("ur5e_1", touches(other), ["post"])
        assert commands(said) == [
            "mrlab stop ur5e_1",
            "mrlab place ur5e_1 --at X,Y",
            "mrlab resume ur5e_1",
        ]


def test_a_halt_of_which_nothing_is_known_is_one():
    assert halted("ur5e_1", of_text("")).code == "halted"


def test_a_robot_that_moves_names_what_stops_it(graph) -> None:
    answer = LoadTrajectory.Response()
    why = ILLEGAL_EVENT(event="load", state="PLAYING", possible=["pause", "stop"])
    tell(answer, False, why)
    graph.call = lambda kind, service, request: answer
    robot = LabRobot(graph, msg.Robot(name="ur5e_1"))
    robot._follower = Follower(graph, "ur5e_1")
    graph.callbacks["/ur5e_1/playback_state"](playing())
    with pytest.raises(Misuse) as raised:
        robot.load("quintic")
    said = raised.value.diagnostic
    assert said.code == "moves_already"
    assert commands(said) == ["mrlab stop ur5e_1"]
