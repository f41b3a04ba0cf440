"""Assets and definitions over real zenoh sessions."""

from __future__ import annotations

import hashlib
import json
import threading
from pathlib import Path
from xml.etree import ElementTree

import pytest
import yaml
import yourdfpy
import zenoh
from child_process import HOST, start_child
from graph import wait_for
from zenoh_side import connect, start_client

from mrlab_ros.core.bridge.assets import (
    LARGEST_PIECE,
    asset_key,
    key_of_uri,
    read_attachment,
)
from mrlab_ros.nodes.bridge.node import BridgeNode

ROOT = Path(__file__).parents[2]
BASE = "assets/mrlab_ros/robots/ur5e/meshes/base_link_inertia.glb"


def get(session, selector):
    """Return a query's one answer: the sample, or the reason of the error."""
    replies = list(session.get(selector, timeout=10.0))
    assert len(replies) == 1, f"{len(replies)} answers on {selector}"
    return replies[0].ok or replies[0].err.payload.to_string()


def document(session, key):
    return json.loads(get(session, key).payload.to_bytes())


@pytest.fixture
def imported(tmp_path, monkeypatch):
    """A folder of imported robots with one robot."""
    monkeypatch.setenv("MRLAB_ROBOTS", str(tmp_path / "robots"))
    meshes = tmp_path / "robots" / "mine" / "meshes"
    meshes.mkdir(parents=True)
    for name in ("robot.yaml", "robot.urdf"):
        text = (ROOT / "robots" / "ur5e" / name).read_text()
        (meshes.parent / name).write_text(text.replace("id: ur5e", "id: mine"))
    return meshes


def test_a_mesh_is_got_by_the_key_of_its_uri(bridge, session):
    file = ROOT / "robots" / "ur5e" / "meshes" / "base_link_inertia.glb"
    sample = get(session, key_of_uri(f"package://{BASE.removeprefix('assets/')}"))
    assert sample.payload.to_bytes() == file.read_bytes()
    assert str(sample.key_expr) == BASE
    assert str(sample.encoding) == "model/gltf-binary"
    whole, offset = read_attachment(sample.attachment.to_bytes())
    assert whole.sha256 == hashlib.sha256(file.read_bytes()).hexdigest()
    assert (whole.size, whole.media_type, offset) == (
        file.stat().st_size,
        "model/gltf-binary",
        0,
    )


def test_a_robot_can_be_drawn_from_its_keys_alone(bridge, session):
    robots = {robot["id"]: robot for robot in document(session, "assets/robots.json")["robots"]}
    assert len(robots) >= 13
    for robot in robots.values():
        urdf = ElementTree.fromstring(get(session, robot["urdf"]).payload.to_bytes())
        joints = {joint.get("name") for joint in urdf.iterfind("joint")}
        assert joints.issuperset(joint["name"] for joint in robot["joints"])
        uris = {mesh.get("filename") for mesh in urdf.iterfind("link/visual/geometry/mesh")}
        assert uris
        for uri in uris:
            assert get(session, key_of_uri(uri)).payload.to_bytes()[:4] == b"glTF"


def test_a_urdf_has_the_end_effector_that_its_key_names(bridge, session):
    bare = get(session, "assets/robots/ur5e.urdf").payload.to_string()
    composed = get(session, "assets/robots/ur5e+parallel_gripper.urdf").payload.to_string()
    assert "gripper_left_finger_joint" in composed
    assert "gripper_left_finger_joint" not in bare
    reason = get(session, "assets/robots/ur5e+parallel_griper.urdf")
    assert "Did you mean 'parallel_gripper'" in reason


LIBRARY = yaml.safe_load((Path(__file__).parents[2] / "config" / "objects.yaml").read_text())


def test_each_type_of_object_can_be_drawn(bridge, session):
    objects = document(session, "assets/objects.json")["objects"]
    assert {entry["id"] for entry in objects} == set(LIBRARY["objects"])
    for entry in objects:
        assert entry["shape"] or entry["mesh"], entry["id"]
        if entry["mesh"]:
            assert get(session, entry["mesh"]).payload.to_bytes()[:4] == b"glTF"


@pytest.mark.parametrize(
    "key",
    [
        "assets/mrlab_ros/robots/ur5e/robot.yaml",
        "assets/mrlab_ros/config/bridge.yaml",
        "assets/mrlab_ros/config/objects/../objects.yaml",
        "assets/mrlab_ros/robots/ur5e/meshes/../../../package.xml",
        "assets/mrlab_ros/robots/ur5e/meshes/%2e%2e/robot.yaml",
        "assets/mrlab_ros/robots/ur5e/meshes/..%2F..%2F..%2Fpackage.xml",
        "assets/mrlab_ros/robots/ur5e/meshes/nothing.glb",
        "assets/rclpy/package.xml",
        "assets/etc/passwd",
        "assets/%2Fetc%2Fpasswd",
        "assets/mrlab_ros/robots/ur5e/meshes/a%00.glb",
        "assets/mrlab_ros/objects/no_such_thing.glb",
        "assets/robots/ur6.urdf",
        "assets/**",
        "assets/mrlab_ros/robots/*/meshes/base_link_inertia.glb",
        "schema/more",
    ],
)
def test_what_is_no_asset_is_refused_in_words(bridge, session, key):
    if key == "schema/more":
        assert not list(session.get(key, timeout=10.0))
        return
    reason = get(session, key)
    assert isinstance(reason, str)
    assert len(reason) > 30


@pytest.mark.parametrize("key", ["**", "*", "*/robots.json", "*/*/robots/ur5e/*/x.glb"])
def test_a_pattern_that_means_others_is_not_answered(bridge, session, key):
    assert not list(session.get(key, timeout=10.0))


def test_a_link_that_leads_out_of_the_folder_is_no_asset(imported, bridge, session):
    secret = imported.parents[2] / "secret.glb"
    secret.write_bytes(b"glTF secret")
    (imported / "inside.glb").write_bytes(b"glTF mine")
    (imported / "outside.glb").symlink_to(secret)
    folder = "assets/mrlab_ros/robots/mine/meshes"
    assert get(session, f"{folder}/inside.glb").payload.to_bytes() == b"glTF mine"
    assert "no asset" in get(session, f"{folder}/outside.glb")


def test_an_imported_robot_is_served_while_the_lab_runs(imported, bridge, session):
    (imported / "a name # with ?.glb").write_bytes(b"glTF")
    robots = document(session, "assets/robots.json")
    assert "mine" in {robot["id"] for robot in robots["robots"]}
    key = asset_key("mrlab_ros/robots/mine/meshes/a name # with ?.glb")
    assert get(session, key).payload.to_bytes() == b"glTF"
    (imported.parents[1] / "broken").mkdir()
    (imported.parents[1] / "broken" / "robot.yaml").write_text("id: broken\n")
    robots = document(session, "assets/robots.json")
    assert "mine" in {robot["id"] for robot in robots["robots"]}
    assert "broken" in " ".join(robots["problems"])


def test_a_large_mesh_comes_in_pieces(imported, bridge, session):
    data = bytes(range(256)) * (LARGEST_PIECE // 256 * 3) + b"end"
    (imported / "large.glb").write_bytes(data)
    key = "assets/mrlab_ros/robots/mine/meshes/large.glb"
    assert f"one reply holds {LARGEST_PIECE} at most" in get(session, key)
    head = get(session, f"{key}?length=0")
    whole, _ = read_attachment(head.attachment.to_bytes())
    assert (whole.size, head.payload.to_bytes()) == (len(data), b"")
    got = b""
    while len(got) < whole.size:
        sample = get(session, f"{key}?offset={len(got)};length=700000")
        assert read_attachment(sample.attachment.to_bytes()) == (whole, len(got))
        got += sample.payload.to_bytes()
    assert hashlib.sha256(got).hexdigest() == whole.sha256
    assert get(session, f"{key}?offset={len(data)};length=10").payload.to_bytes() == b""
    assert "the offset is" in get(session, f"{key}?offset={len(data) + 1};length=10")
    assert "expected a number of bytes" in get(session, f"{key}?offset=-1;length=10")


def test_two_clients_get_assets_at_once(bridge, session, endpoint):
    expected = (ROOT / BASE.removeprefix("assets/mrlab_ros/")).read_bytes()
    wrong = []

    def fetch():
        with connect(endpoint) as other:
            for _ in range(30):
                sample = get(other, BASE)
                if sample.payload.to_bytes() != expected:
                    wrong.append(sample)

    threads = [threading.Thread(target=fetch) for _ in range(2)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join(60)
    assert not wrong
    assert not any(thread.is_alive() for thread in threads)


def test_a_changed_file_has_another_hash(imported, bridge, session):
    file = imported / "part.glb"
    key = "assets/mrlab_ros/robots/mine/meshes/part.glb"
    hashes = []
    for content in (b"glTF one", b"glTF two"):
        file.with_suffix(".new").write_bytes(content)
        file.with_suffix(".new").replace(file)
        sample = get(session, key)
        assert sample.payload.to_bytes() == content
        hashes.append(read_attachment(sample.attachment.to_bytes())[0].sha256)
    assert hashes[0] != hashes[1]


def test_assets_lie_below_the_prefix(graph, endpoint):
    graph.add(BridgeNode, listen=[endpoint], prefix="campus/lab_1")
    with connect(endpoint) as session:
        assert get(session, f"campus/lab_1/{BASE}").payload.to_bytes()[:4] == b"glTF"
        assert document(session, "campus/lab_1/schema")["messages"]
        assert not list(session.get(BASE, timeout=10.0))


def test_a_bridge_that_was_started_again_serves_assets(graph, bridge, session, endpoint):
    assert isinstance(get(session, BASE), zenoh.Sample)
    graph.drop(bridge)
    wait_for(lambda: not list(session.get(BASE, timeout=1.0)), "the bridge to be gone")
    graph.add(BridgeNode, listen=[endpoint])
    wait_for(lambda: list(session.get(BASE, timeout=1.0)), "the bridge to be back")
    assert isinstance(get(session, BASE), zenoh.Sample)


def test_a_killed_bridge_comes_back_with_its_assets(endpoint):
    def start():
        arguments = ("bridge", "--ros-args", "-p", f"listen:=['{endpoint}']")
        return start_child(*HOST, *arguments, cwd=ROOT)

    bridge = start()
    with connect(endpoint, connect__exit_on_failure=False, connect__timeout_ms=-1) as session:
        try:
            wait_for(lambda: list(session.get(BASE, timeout=1.0)), "the bridge", timeout=60)
            bridge.kill()
            bridge.wait(20)
            assert not list(session.get(BASE, timeout=1.0))
            bridge = start()
            wait_for(lambda: list(session.get(BASE, timeout=1.0)), "the new bridge", timeout=60)
        finally:
            bridge.kill()
            bridge.wait(20)


def test_the_schema_has_every_type_that_crosses(bridge, session):
    sample = get(session, "schema")
    assert str(sample.encoding) == "application/json"
    bundle = json.loads(sample.payload.to_bytes())
    assert bundle == document(session, "assets/schema.json")
    messages, services = bundle["messages"], bundle["services"]
    own = {f"mrlab_msgs/msg/{f.stem}" for f in (ROOT / "msg_schemas/msg").glob("*.msg")}
    assert own <= set(messages)
    standard = {
        "sensor_msgs/msg/JointState",
        "std_msgs/msg/Header",
        "shape_msgs/msg/SolidPrimitive",
    }
    assert standard <= set(messages)
    assert {"mrlab_msgs/srv/Seek", "mrlab_msgs/srv/Trigger"} <= set(services)
    assert bundle["hashes"].keys() >= {*messages, *services, "mrlab_msgs/srv/Trigger_Request"}
    assert all(value.startswith("RIHS01_") for value in bundle["hashes"].values())


def test_the_python_client_draws_a_robot_from_the_lab_alone(bridge, endpoint, tmp_path):
    path = "robots/ur5e+parallel_gripper.urdf"
    client = start_client("mrlab_assets.py", "--connect", endpoint, path, str(tmp_path))
    out, err = client.communicate(timeout=60)
    assert client.returncode == 0, err
    urdf = Path(out.strip())
    model = yourdfpy.URDF.load(
        str(urdf), filename_handler=lambda fname: str(tmp_path / fname), load_collision_meshes=True
    )
    assert len(model.scene.geometry) >= 8
    assert "gripper_left_finger_joint" in model.joint_names
    listing = start_client("mrlab_assets.py", "--connect", endpoint)
    out, err = listing.communicate(timeout=60)
    assert listing.returncode == 0, err
    assert "Universal Robots UR5e, 6 joints, 5 kg" in out
    assert "a tennis ball" in out
    missing = start_client("mrlab_assets.py", "--connect", endpoint, "robots/ur6.urdf")
    _, err = missing.communicate(timeout=60)
    assert missing.returncode == 1
    assert "Did you mean 'ur5e'" in err
