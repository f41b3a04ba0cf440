from __future__ import annotations

import math

import numpy as np
import pytest
from mrlab_msgs.msg import Robots
from rclpy.serialization import deserialize_message, serialize_message
from refusals import refused
from sensor_msgs.msg import JointState

from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.gateway.lab.definitions import Definitions, installed_definitions, plain
from mrlab_ros.gateway.lab.diagnostics import (
    BYTES_NOT_OF_TYPE,
    NO_SUCH_FIELD,
    NOT_OF_TYPE,
    UNKNOWN_TYPE,
)

pytestmark = pytest.mark.fast


@pytest.fixture(scope="module")
def definitions() -> Definitions:
    return installed_definitions()


def test_reads_what_ros_writes(definitions: Definitions) -> None:
    message = JointState(name=["a", "b"], position=[1.5, -2.0])
    message.header.frame_id = "ur5e_1"
    read = definitions.decode("sensor_msgs/msg/JointState", serialize_message(message))
    assert read.header.frame_id == "ur5e_1"
    assert list(read.name) == ["a", "b"]
    assert list(read.position) == [1.5, -2.0]


def test_ros_reads_what_it_writes(definitions: Definitions) -> None:
    cdr = definitions.encode("mrlab_msgs/msg/Robots", {"robots": [{"name": "ur5e_1"}, {}]})
    read = deserialize_message(cdr, Robots)
    assert [robot.name for robot in read.robots] == ["ur5e_1", ""]


def test_a_service_has_two_halves_and_an_empty_one_is_a_byte(definitions: Definitions) -> None:
    assert definitions.encode("mrlab_msgs/srv/Trigger_Request", {}) == b"\0\1\0\0\0"
    answer = definitions.encode("mrlab_msgs/srv/Seek_Response", {"success": True, "message": "x"})
    assert plain(definitions.decode("mrlab_msgs/srv/Seek_Response", answer)) == {
        "success": True,
        "message": "x",
        "code": "",
        "values": [],
    }


def test_bytes_fill_an_array_of_bytes(definitions: Definitions) -> None:
    name = "mrlab_msgs/srv/ConvertTrajectory_Request"
    read = definitions.decode(name, definitions.encode(name, {"data": b"\1\2", "degrees": True}))
    assert read.data.tolist() == [1, 2]
    assert read.degrees


def test_plain_is_what_json_holds(definitions: Definitions) -> None:
    name = "mrlab_msgs/msg/Diagnostic"
    values = {"value": math.nan, "limit": 2.0, "fixes": [{"option": "units"}]}
    found = plain(definitions.decode(name, definitions.encode(name, values)))
    assert found["value"] is None
    assert found["limit"] == 2.0
    assert found["fixes"][0]["option"] == "units"
    assert plain(np.float64(1.0)) == 1.0


def test_types_are_learned_and_others_of_the_same_name_told(definitions: Definitions) -> None:
    fresh = Definitions({})
    texts = {
        "mrlab_msgs/srv/Seek": "float64 position\n---\nbool success\nstring message\n",
        "std_msgs/msg/Header": "builtin_interfaces/Time stamp\nstring frame_id\n",
        "geometry_msgs/msg/Point": "float64 x\nfloat64 y\n",
    }
    assert fresh.learn(texts) == ["geometry_msgs/msg/Point"]
    name = "mrlab_msgs/srv/Seek_Request"
    assert fresh.encode(name, {"position": 2.0}) == definitions.encode(name, {"position": 2.0})
    assert fresh.learn(texts) == ["geometry_msgs/msg/Point"]


def test_an_unknown_type_field_or_payload_is_named(definitions: Definitions) -> None:
    with refused(UNKNOWN_TYPE, BadInput, type="mrlab_msgs/msg/Robotz"):
        definitions.encode("mrlab_msgs/msg/Robotz", {})
    with refused(NO_SUCH_FIELD, BadInput, names=["speed"], fields=["rate"]):
        definitions.encode("mrlab_msgs/srv/SetRate_Request", {"speed": 1.0})
    with refused(NOT_OF_TYPE, BadInput, type="mrlab_msgs/srv/SetRate_Request"):
        definitions.encode("mrlab_msgs/srv/SetRate_Request", {"rate": "fast"})
    with refused(BYTES_NOT_OF_TYPE, BadInput, size=3, type="mrlab_msgs/msg/Robots"):
        definitions.decode("mrlab_msgs/msg/Robots", b"abc")
