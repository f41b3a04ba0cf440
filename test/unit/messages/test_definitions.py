"""Message definitions as bags carry them."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
from ament_index_python.packages import get_package_share_directory
from geometry_msgs.msg import Pose
from mrlab_msgs import msg, srv
from rclpy.serialization import deserialize_message, serialize_message
from refusals import refused
from rosbags.typesys import Stores, get_types_from_msg, get_typestore

from mrlab_ros.client.robot import standing
from mrlab_ros.core.base.diagnostics import TYPE_NOT_INSTALLED
from mrlab_ros.core.base.errors import BadInput, Misuse
from mrlab_ros.messages.definitions import SEPARATOR, definition, fitted

SHARE = Path(get_package_share_directory("mrlab_msgs")) / "msg"
KINDS = sorted(f"mrlab_msgs/msg/{path.stem}" for path in SHARE.glob("*.msg"))


def test_every_type_within_follows_once() -> None:
    own, *inner = definition("mrlab_msgs/msg/PlaybackState").split(SEPARATOR + "\n")
    # The comments stay: they give the units.
    assert own == (SHARE / "PlaybackState.msg").read_text()
    heads = [part.splitlines()[0] for part in inner]
    assert heads == [
        "MSG: std_msgs/Header",
        "MSG: diagnostic_msgs/KeyValue",
        "MSG: mrlab_msgs/PlaybackClock",
        "MSG: builtin_interfaces/Time",
    ]


@pytest.mark.parametrize("kind", KINDS)
def test_another_reader_finds_the_generators_type_in_it(kind: str) -> None:
    store = get_typestore(Stores.EMPTY)
    store.register(get_types_from_msg(definition(kind), kind))
    generated = json.loads((SHARE / f"{kind.rpartition('/')[2]}.json").read_text())
    expected = {one["type_name"]: one["hash_string"] for one in generated["type_hashes"]}
    assert store.hash_rihs01(kind) == expected[kind]


@pytest.mark.parametrize("kind", ["none_msgs/msg/String", "std_msgs/msg/Nothing"])
def test_a_type_that_is_not_installed_is_refused(kind: str) -> None:
    with refused(TYPE_NOT_INSTALLED, BadInput, type=kind):
        definition(kind)


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
