"""The example client in Python reads every message and answer of the lab as ROS writes it."""

from __future__ import annotations

import importlib.util
from pathlib import Path

import mrlab_msgs.msg
import mrlab_msgs.srv
import pytest
from rclpy.serialization import serialize_message
from rosbags.serde import SerdeError

ROOT = Path(__file__).parents[3]
FILE = ROOT / "examples" / "clients" / "python" / "mrlab_client.py"
SPEC = importlib.util.spec_from_file_location("mrlab_client", FILE)
assert SPEC is not None
assert SPEC.loader is not None
client = importlib.util.module_from_spec(SPEC)
SPEC.loader.exec_module(client)
SPAWN = "mrlab_msgs/msg/SpawnObject_Request"


@pytest.fixture(scope="module")
def store():
    return client.typestore(*client.folder(ROOT / "msg_schemas"))


def kinds():
    for file in sorted((ROOT / "msg_schemas").glob("*/*.*")):
        if file.suffix == ".msg":
            yield f"mrlab_msgs/msg/{file.stem}", getattr(mrlab_msgs.msg, file.stem)
        else:
            service = getattr(mrlab_msgs.srv, file.stem)
            for half in ("Request", "Response"):
                yield f"mrlab_msgs/msg/{file.stem}_{half}", getattr(service, half)


def test_what_ros_writes_is_read(store):
    for name, kind in kinds():
        if name not in store.types:
            assert {*kind.get_fields_and_field_types()} <= {"structure_needs_at_least_one_member"}
            continue
        payload = serialize_message(kind())
        assert client.decode(store, payload, name) is not None, name
        # So many bytes may follow where ROS counts padding that it does not write.
        assert client.decode(store, payload + bytes(8), name) is not None, name


def test_what_is_cut_off_is_refused(store):
    payload = serialize_message(mrlab_msgs.msg.SceneObject(name="cube_1"))
    with pytest.raises(SerdeError):
        client.decode(store, payload[:40], "mrlab_msgs/msg/SceneObject")


def test_an_orientation_that_is_not_given_is_no_turn(store):
    request = client.fill(store, SPAWN, {"type": "cup", "pose": {"position": {"x": 0.5}}})
    assert request.pose.orientation.w == 1.0
    assert request.pose.position.x == 0.5


@pytest.mark.parametrize(
    ("values", "says"),
    [
        ({"typ": "cup"}, "has no field typ"),
        ({"pose": 7}, "is no geometry_msgs/msg/Pose"),
        ({"pose": {"position": {"x": "here"}}}, "'here' is no float64"),
    ],
)
def test_a_value_that_cannot_be_is_refused(store, values, says):
    with pytest.raises(SystemExit, match=says):
        client.fill(store, SPAWN, values)
