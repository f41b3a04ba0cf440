"""Numbers of a request come in the types of its fields; other values are refused by name."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from geometry_msgs.msg import Pose
from mrlab_msgs import msg, srv
from rclpy.serialization import deserialize_message, serialize_message

from mrlab_ros.client.robot import standing
from mrlab_ros.core.base.errors import Misuse
from mrlab_ros.messages.requests import fitted


@pytest.mark.parametrize("number", [2, 2.0, np.float32(2.0), np.int64(2)])
def test_whole_numbers_are_taken_for_reals(number):
    request = fitted(srv.SetRate.Request(rate=number))
    assert (request.rate, type(request.rate)) == (2.0, float)
    serialize_message(request)


def test_parts_of_a_request_are_looked_at_too():
    request = srv.PlaceRobot.Request(robot="ur5e_1")
    request.pose.position.x = 1
    serialize_message(fitted(request))
    assert isinstance(request.pose.position.x, float)


@pytest.mark.parametrize(
    ("request_", "words"),
    [
        (srv.SetRate.Request(rate="2"), "rate is '2'; expected a number"),
        (srv.SetRate.Request(rate=True), "rate is True; expected a number"),
        (srv.ConvertTrajectory.Request(path=Path("/q.mat")), "path is .*; expected a text"),
        (srv.ConvertTrajectory.Request(transpose=1), "transpose is 1; expected True or False"),
        (srv.CreateSystem.Request(mode=1.5), "mode is 1.5; expected a whole number"),
        (
            srv.CreateSystem.Request(members=[msg.SystemMember(robot=5)]),
            "members.robot is 5; expected a text",
        ),
        (srv.StartRecording.Request(topics=[7]), "topics is 7; expected a text"),
    ],
)
def test_what_would_abort_the_process_is_refused_by_name(request_, words):
    with pytest.raises(Misuse, match=words):
        fitted(request_)


def test_every_request_of_the_lab_fits_as_it_is_made():
    kinds = [kind for kind in vars(srv).values() if hasattr(kind, "Request")]
    assert len(kinds) > 20
    for kind in kinds:
        serialize_message(fitted(kind.Request()))


def test_a_pose_of_whole_numbers_arrives() -> None:
    """`robot.place(2, -1)` put the robot on the origin where messages are built without checks."""
    found = deserialize_message(serialize_message(standing(2, -1, 0, 1)), Pose).position
    assert (found.x, found.y, found.z) == (2.0, -1.0, 1.0)
