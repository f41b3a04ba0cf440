"""The calls of two clients of ros2_control, in a lab of two robots.

What each client asks for is read from its source for Jazzy of August 2026:
rqt_joint_trajectory_controller, and Ros2ControlManager of moveit_ros_control_interface.
"""

from __future__ import annotations

import xml.etree.ElementTree as ET

import numpy as np
import pytest
import small_lab
from action_msgs.msg import GoalStatus
from builtin_interfaces.msg import Duration
from control_msgs.action import FollowJointTrajectory
from control_msgs.msg import JointTrajectoryControllerState
from control_msgs.srv import QueryTrajectoryState
from controller_manager_msgs.srv import (
    ListControllers,
    ListControllerTypes,
    LoadController,
    SwitchController,
)
from graph import wait_for
from mrlab_msgs.srv import Trigger
from rclpy.action import ActionClient
from sensor_msgs.msg import JointState
from small_lab import listen_state, load, make_system, spawn
from std_msgs.msg import String
from tf2_msgs.msg import TFMessage
from trajectory_msgs.msg import JointTrajectory, JointTrajectoryPoint

from mrlab_ros.core.base.clock import SECOND
from mrlab_ros.messages import qos
from mrlab_ros.messages.time import time_from_message
from mrlab_ros.nodes.frames.node import FramesNode

RQT_SERVICES = {
    "list_controllers": "ListControllers",
    "list_controller_types": "ListControllerTypes",
    "load_controller": "LoadController",
    "unload_controller": "UnloadController",
    "switch_controller": "SwitchController",
    "reload_controller_libraries": "ReloadControllerLibraries",
}


@pytest.fixture
def stage(graph):
    small_lab.start(graph)
    graph.add(FramesNode, rate=100.0, marker_rate=0.0)
    spawn(graph)
    spawn(graph, "kuka_kr3_r540")
    return graph


def of_cell(graph, robots=2):
    """Return the URDF of all robots, as `robot_description` of a node in the root namespace."""
    texts = graph.listen(String, "robot_description", qos.LATCHED)
    wait_for(lambda: texts and texts[-1].data.count('"floating"') == robots, "the URDF")
    return ET.fromstring(texts[-1].data)


def test_rqt_finds_a_robot_shows_its_joints_and_moves_it(stage) -> None:
    node = stage.client
    wait_for(lambda: "/controller_manager/list_controllers" in dict(
        node.get_service_names_and_types()), "a controller manager")  # fmt: skip
    services = dict(node.get_service_names_and_types())
    managers = [
        name.split("/list_controllers")[0] for name in services if "/list_controllers" in name
    ]
    assert managers == ["/controller_manager"]
    for name, kind in RQT_SERVICES.items():
        assert services[f"{managers[0]}/{name}"] == [f"controller_manager_msgs/srv/{kind}"]
    listed = stage.call(ListControllers, f"{managers[0]}/list_controllers").controller
    active = [c for c in listed if "JointTrajectoryController" in c.type and c.state == "active"]
    joints = {
        c.name: list(dict.fromkeys(
            name.rpartition("/")[0] for name in c.required_state_interfaces
            if name.endswith("/position")
        ))
        for c in active
    }  # fmt: skip
    limits = {
        joint.get("name"): joint.find("limit")
        for joint in of_cell(stage).iterfind("joint") if joint.find("limit") is not None
    }  # fmt: skip
    assert set(joints) == {"ur5e_1", "kuka_kr3_r540_1"}
    for name in (name for names in joints.values() for name in names):
        assert {"lower", "upper", "velocity"} <= limits[name].attrib.keys()

    # Controllers live one level above their manager.
    above = managers[0].rsplit("/", 1)[0] + "/ur5e_1"
    states = stage.listen(JointTrajectoryControllerState, f"{above}/controller_state", 1)
    wait_for(lambda: states, "the state")
    assert states[-1].joint_names == joints["ur5e_1"]
    begin = list(states[-1].feedback.positions)
    commands = node.create_publisher(JointTrajectory, f"{above}/joint_trajectory", 1)
    wait_for(commands.get_subscription_count, "the controller")
    target = [begin[0] + 0.1, *begin[1:]]
    lasts = Duration(nanosec=SECOND // 2)

    def reached():
        commands.publish(
            JointTrajectory(
                joint_names=joints["ur5e_1"],
                points=[JointTrajectoryPoint(positions=target, time_from_start=lasts)],
            )
        )
        return abs(states[-1].feedback.positions[0] - target[0]) < 0.01

    wait_for(reached, "the arm at the slider's place")


def test_moveit_knows_the_state_of_all_and_sends_goals_to_one(stage) -> None:
    node = stage.client
    urdf = of_cell(stage)
    states = stage.listen(JointState, "/joint_states", qos.EVENTS)
    fixed = stage.listen(TFMessage, "/tf_static", qos.LATCHED)
    wanted = {
        joint.get("name") for joint in urdf.iterfind("joint")
        if joint.get("type") in ("revolute", "continuous", "prismatic")
        and joint.find("mimic") is None
    }  # fmt: skip

    def newest():
        return {name: state for state in list(states) for name in state.name}

    wait_for(lambda: wanted <= newest().keys(), "the states of all joints of the URDF")
    now = node.get_clock().now().nanoseconds
    assert all(now - time_from_message(state.header.stamp) < SECOND for state in newest().values())
    assert wanted == newest().keys()
    # A floating joint's state is a frame.
    bases = {t.child_frame_id for t in fixed[-1].transforms if t.header.frame_id == "world"}
    assert bases == {
        joint.find("child").get("link") for joint in urdf.iterfind("joint")
        if joint.get("type") == "floating"
    }  # fmt: skip

    services = dict(node.get_service_names_and_types())
    found = [name for name in services if "controller_manager/list_controllers" in name]
    above = found[0].removesuffix("controller_manager/list_controllers")
    listed = stage.call(ListControllers, found[0]).controller
    assert not [c for c in listed if c.chain_connections]
    ur5e = next(c for c in listed if c.name == "ur5e_1")
    types = stage.call(ListControllerTypes, "/controller_manager/list_controller_types").types
    assert ur5e.type in types
    # What follows the first slash is taken for the interface.
    joints = [name.partition("/")[0] for name in ur5e.required_command_interfaces]
    assert set(joints) <= wanted
    client = ActionClient(
        node, FollowJointTrajectory, f"{above}{ur5e.name}/follow_joint_trajectory"
    )
    assert client.wait_for_server(timeout_sec=15.0)
    arm = newest()[joints[0]]
    there = np.array([dict(zip(arm.name, arm.position, strict=True))[name] for name in joints])
    goal = FollowJointTrajectory.Goal()
    goal.trajectory.joint_names = joints
    for time, way in ((0, 0.0), (1, 0.1)):
        goal.trajectory.points.append(JointTrajectoryPoint(
            positions=(there + way).tolist(), velocities=[0.0] * 6, accelerations=[0.0] * 6,
            time_from_start=Duration(sec=time),
        ))  # fmt: skip
    asked: list = []
    node.create_timer(0.05, lambda: asked or asked.append(client.send_goal_async(goal)))
    wait_for(lambda: asked and asked[0].done(), "the goal's acceptance")
    query = {"time": node.get_clock().now().to_msg()}
    course = stage.call(QueryTrajectoryState, "/ur5e_1/query_state", **query)
    assert course.success, course.message
    assert course.name == joints
    assert there[0] <= course.position[0] <= there[0] + 0.1
    ended = asked[0].result().get_result_async()
    wait_for(ended.done, "the goal's end")
    assert ended.result().status == GoalStatus.STATUS_SUCCEEDED
    late = stage.call(QueryTrajectoryState, "/ur5e_1/query_state", **query)
    assert (late.success, late.name) == (False, joints)
    assert late.message


def test_a_robot_of_a_system_is_inactive_and_nothing_switches_it(stage) -> None:
    states = listen_state(stage, "ur5e_1")
    load(stage, "ur5e_1", "long")
    assert make_system(stage, {"ur5e_1": "long"}).success
    wait_for(lambda: states.last().system == "cell", "the claim")

    def inactive():
        listed = stage.call(ListControllers, "/controller_manager/list_controllers").controller
        return {c.name: c for c in listed}["ur5e_1"].state == "inactive"

    wait_for(inactive, "the controller's state")
    switch = "/controller_manager/switch_controller"
    strict = {"strictness": SwitchController.Request.STRICT}
    refused = stage.call(SwitchController, switch, activate_controllers=["ur5e_1"], **strict)
    assert (refused.ok, "cell" in refused.message) == (False, True)
    assert stage.call(SwitchController, switch, deactivate_controllers=["ur5e_1"], **strict).ok
    other = ["kuka_kr3_r540_1"]
    assert stage.call(SwitchController, switch, activate_controllers=other, **strict).ok
    assert not stage.call(SwitchController, switch, deactivate_controllers=other, **strict).ok
    assert not stage.call(SwitchController, switch, activate_controllers=["x"], **strict).ok
    assert not stage.call(LoadController, "/controller_manager/load_controller", name="x").ok
    assert stage.call(Trigger, "/cell/play").success
