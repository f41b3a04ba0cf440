"""The frames node in a graph: every link of every robot has a frame, and things have markers."""

from __future__ import annotations

import io
import xml.etree.ElementTree as ET

import numpy as np
import pytest
import yourdfpy
from builtin_interfaces.msg import Time
from graph import wait_for
from mrlab_msgs import msg, srv
from rcl_interfaces.msg import Log
from sensor_msgs.msg import JointState
from shape_msgs.msg import SolidPrimitive
from std_msgs.msg import Header, String
from tf2_msgs.msg import TFMessage
from visualization_msgs.msg import Marker, MarkerArray

from mrlab_ros.core.base.clock import SECOND
from mrlab_ros.messages import qos
from mrlab_ros.messages.time import time_from_message
from mrlab_ros.nodes.frames.node import REST_S, FramesNode
from mrlab_ros.nodes.lab.node import LabNode

STAMP = Time(sec=1_700_000_000, nanosec=5)


@pytest.fixture
def stage(graph, monkeypatch, tmp_path):
    monkeypatch.setenv("MRLAB_ROBOTS", str(tmp_path))
    graph.add(LabNode)
    graph.add(FramesNode, rate=200.0, marker_rate=50.0)
    return graph


def spawn(graph, **fields):
    answer = graph.call(srv.SpawnRobot, "/lab/spawn_robot", automatic=True, **fields)
    assert answer.success, answer.message
    return answer.robot


def newest(inbox, condition=lambda message: True):
    found = [message for message in list(inbox) if condition(message)]
    return found[-1] if found else None


def children(message):
    return {t.child_frame_id for t in message.transforms}


def test_every_link_has_a_frame_and_moves_with_its_joints(stage):
    fixed = stage.listen(TFMessage, "/tf_static", qos.LATCHED)
    moving = stage.listen(TFMessage, "/tf", 100)
    both = stage.listen(String, "/robot_description", qos.LATCHED)
    for name in ("ur5e_1", "ur5e_2"):
        spawn(stage, model="ur5e", name=name, end_effector="parallel_gripper")
    wait_for(lambda: newest(both, lambda m: "ur5e_2/tcp" in m.data), "the URDF of both")
    links = [link.get("name") for link in ET.fromstring(newest(both).data).iterfind("link")]
    joints = [f"{part}_joint" for part in (
        "shoulder_pan", "shoulder_lift", "elbow", "wrist_1", "wrist_2", "wrist_3",
    )]  # fmt: skip
    positions = [0.1, -1.2, 1.3, -0.4, 0.5, 0.6]
    topics = {
        name: (
            stage.client.create_publisher(JointState, f"/{name}/joint_states", qos.STREAM),
            stage.client.create_publisher(JointState, f"/{name}/finger_states", qos.LATCHED),
        )
        for name in ("ur5e_1", "ur5e_2")
    }
    header = Header(stamp=STAMP, frame_id="ur5e")
    for arm, fingers in topics.values():
        wait_for(lambda arm=arm: arm.get_subscription_count(), "the frames node")
        fingers.publish(
            JointState(header=header, name=["gripper_left_finger_joint"], position=[0.02])
        )
    later = Header(stamp=Time(sec=STAMP.sec, nanosec=STAMP.nanosec + 1000), frame_id="ur5e")

    def complete():
        for arm, _ in topics.values():
            arm.publish(JointState(header=later, name=joints, position=positions))
        static, moved = newest(fixed), set().union(*map(children, list(moving)))
        return static is not None and children(static) | moved | {"world"} == set(links)

    wait_for(complete, "a frame of every link")
    assert not children(newest(fixed)) & children(newest(moving))
    turned = newest(moving, lambda m: "ur5e_1/wrist_3_link" in children(m))
    assert {(t.header.stamp.sec, t.header.stamp.nanosec) for t in turned.transforms} <= {
        (STAMP.sec, 5), (STAMP.sec, 1005)
    }  # fmt: skip
    elbow = next(t for t in turned.transforms if t.child_frame_id == "ur5e_1/forearm_link")
    assert elbow.header.frame_id == "ur5e_1/upper_arm_link"
    assert 2 * np.arccos(abs(elbow.transform.rotation.w)) == pytest.approx(1.3)
    # The second finger follows the first, as the URDF says.
    right = next(t for t in turned.transforms if t.child_frame_id.endswith("right_finger_link"))
    assert right.transform.translation.y == pytest.approx(-0.0425 + 0.02)
    # A robot that goes takes its frames along.
    assert stage.call(srv.Remove, "/lab/remove_robot", name="ur5e_1").success
    wait_for(lambda: "ur5e_1/" not in newest(both).data, "the URDF of the one that stays")
    assert not [c for c in children(newest(fixed)) if c.startswith("ur5e_1/")]


def test_the_frames_of_an_arm_that_stands_are_never_old(stage):
    robot = spawn(stage, model="ur5e")
    moving = stage.listen(TFMessage, "/tf", 100)
    arm = stage.client.create_publisher(JointState, f"/{robot.name}/joint_states", qos.STREAM)
    wait_for(arm.get_subscription_count, "the frames node")
    heard = stage.client.get_clock().now()
    names = list(robot.joint_names)
    state = JointState(header=Header(stamp=heard.to_msg()), name=names, position=[0.1] * 6)
    arm.publish(state)

    def later():
        stamps = sorted({time_from_message(t.header.stamp) for m in moving for t in m.transforms})
        return stamps if stamps and stamps[-1] - heard.nanoseconds > 0.5 * SECOND else []

    stamps = np.array(wait_for(later, "frames half a second after the joint state"))
    assert len(stamps) > 4
    assert np.diff(stamps).min() >= SECOND // 20


def test_a_robot_that_is_placed_has_its_base_there(stage):
    fixed = stage.listen(TFMessage, "/tf_static", qos.LATCHED)
    robot = spawn(stage, model="kuka_kr3_r540")
    robot.pose.position.x = 2.5
    place = {"robot": robot.name, "pose": robot.pose}
    assert stage.call(srv.PlaceRobot, "/lab/place_robot", **place).success

    def base():
        found = [t for t in (newest(fixed) or TFMessage()).transforms
                 if t.child_frame_id == f"{robot.name}/base_link"]  # fmt: skip
        return found and found[0].transform.translation.x == 2.5

    wait_for(base, "the base at its new place")


def test_the_description_of_one_robot_names_the_frames(stage):
    robot = spawn(stage, model="ur5e", end_effector="vacuum_cup")
    described = stage.listen(String, f"/{robot.name}/robot_description", qos.LATCHED)
    wait_for(lambda: described, "the description")
    model = yourdfpy.URDF.load(
        io.BytesIO(described[-1].data.encode()), build_scene_graph=False, load_meshes=False
    )
    assert all(link.startswith(f"{robot.name}/") for link in model.link_map)
    assert list(model.actuated_joint_names) == list(robot.joint_names)


def test_objects_surfaces_contacts_and_robots_have_markers(stage):
    robot = spawn(stage, model="ur5e")
    boxes = {t: stage.listen(MarkerArray, f"/markers/{t}", qos.LATCHED)
             for t in ("objects", "surfaces", "robots")}  # fmt: skip
    contacts = stage.listen(MarkerArray, "/markers/contacts", qos.EVENTS)
    things = stage.client.create_publisher(msg.SceneObjects, "/objects", qos.LATCHED)
    cube = msg.SceneObject(name="cube_1", primitive=SolidPrimitive(type=SolidPrimitive.BOX))
    can = msg.SceneObject(name="can_1", mesh="package://mrlab_ros/config/objects/can.glb")
    things.publish(msg.SceneObjects(objects=[cube, can]))
    wait_for(lambda: newest(boxes["objects"]), "the objects")
    first = {m.ns: m for m in newest(boxes["objects"]).markers}
    assert first["objects/cube_1"].type == Marker.CUBE
    assert first["objects/can_1"].type == Marker.MESH_RESOURCE
    things.publish(msg.SceneObjects(objects=[cube]))
    wait_for(
        lambda: (
            {m.ns: m.action for m in newest(boxes["objects"]).markers}
            == {"objects/cube_1": Marker.ADD, "objects/can_1": Marker.DELETE}
        ),
        "the can to be deleted",
    )
    stage.client.create_publisher(msg.Surfaces, "/surfaces", qos.LATCHED).publish(
        msg.Surfaces(surfaces=[msg.Surface(name="floor")])
    )
    wait_for(lambda: newest(boxes["surfaces"]), "the floor")
    touches = stage.client.create_publisher(msg.Contacts, "/contacts", qos.EVENTS)
    wait_for(touches.get_subscription_count, "the frames node")
    touches.publish(msg.Contacts(contacts=[msg.Contact(robot=robot.name)]))
    wait_for(lambda: newest(contacts), "the contact")
    assert newest(contacts).markers[0].lifetime.nanosec > 0
    halt = stage.client.create_publisher(msg.Collision, f"/{robot.name}/collision", qos.LATCHED)
    halt.publish(msg.Collision(colliding=True))
    red = f"{robot.name}/collision"
    wait_for(
        lambda: newest(boxes["robots"], lambda a: red in [m.ns for m in a.markers]), "the halt"
    )
    halt.publish(msg.Collision(colliding=False))
    wait_for(
        lambda: (
            {m.ns: m.action for m in newest(boxes["robots"]).markers}.get(red) == Marker.DELETE
        ),
        "the end of the halt",
    )


def test_an_error_that_repeats_is_logged_once_a_second(stage):
    robot = spawn(stage, model="ur5e")
    logged = stage.listen(Log, "/rosout", qos.LATCHED_EVENTS)
    fingers = stage.client.create_publisher(
        JointState, f"/{robot.name}/finger_states", qos.LATCHED
    )
    wait_for(fingers.get_subscription_count, "the frames node")

    def errors():
        fingers.publish(JointState(name=["a finger without a position"]))
        return [line for line in list(logged) if line.msg.startswith("frames:")]

    wait_for(lambda: len(errors()) > 1, "two errors")
    first, second = (time_from_message(line.stamp) for line in errors()[:2])
    assert second - first > 0.9 * SECOND


def test_it_looks_seldom_while_nobody_takes_what_moves(stage):
    robot = spawn(stage, model="ur5e")
    arm = stage.client.create_publisher(JointState, f"/{robot.name}/joint_states", qos.STREAM)
    wait_for(arm.get_subscription_count, "the frames node")
    (frames,) = [node for node in stage._spun if isinstance(node, FramesNode)]
    wait_for(lambda: frames._poll.period == REST_S, "the rest")
    moving = stage.listen(TFMessage, "/tf", 100)
    names = list(robot.joint_names)

    def quick():
        stamp = stage.client.get_clock().now().to_msg()
        arm.publish(JointState(header=Header(stamp=stamp), name=names, position=[0.1] * 6))
        stamps = sorted({time_from_message(t.header.stamp) for m in moving for t in m.transforms})
        return sum(np.diff(stamps) < REST_S * SECOND / 2) > 5

    wait_for(quick, "frames at the rate of the parameter")
