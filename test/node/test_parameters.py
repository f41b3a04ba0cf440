"""Parameters of real nodes: refused starts, refused changes, changes that take effect."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
import small_lab
from graph import wait_for
from mrlab_msgs import msg, srv
from mrlab_msgs.srv import Trigger
from rcl_interfaces.msg import ParameterType
from rcl_interfaces.srv import DescribeParameters, GetParameters, SetParameters
from rclpy.parameter import Parameter
from sensor_msgs.msg import JointState

from mrlab_ros.messages import qos
from mrlab_ros.nodes.bridge.node import BridgeNode
from mrlab_ros.nodes.converter.node import ConverterNode
from mrlab_ros.nodes.coordinator.node import CoordinatorNode
from mrlab_ros.nodes.lab.node import LabNode
from mrlab_ros.nodes.playback.host import PlaybackHostNode
from mrlab_ros.nodes.recorder.node import RecorderNode
from mrlab_ros.processes.child_process import WRONG_CONFIGURATION


def host(*arguments: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        (sys.executable, "-m", "mrlab_ros.processes.host", *arguments),
        capture_output=True,
        text=True,
        timeout=60,
        check=False,
    )


def change(graph, node, name, value):
    parameter = Parameter(name, value=value).to_parameter_msg()
    return graph.call(
        SetParameters, f"/{node.get_name()}/set_parameters", parameters=[parameter]
    ).results[0]


def test_a_start_with_bad_values_names_all_of_them_and_ends():
    done = host(
        "playback", "recorder", "converter", "--ros-args",
        "-p", "telemetry_rate:=-5", "-p", "standing_rate:=.nan", "-p", "staging.jerk:=-1",
        "-p", "playback_host:staging.velocity_share:=7", "-p", "split_size:=-5",
        "-p", "default_frame_rate:=-3", "-p", "memory_limit:=0", "-p", "robot:=[ur5e]",
    )  # fmt: skip
    assert done.returncode == WRONG_CONFIGURATION
    for words in (
        "telemetry_rate is -5; expected a number above 0",
        "standing_rate is nan",
        "staging.jerk is -1",
        "staging.velocity_share is 7",
        "split_size is -5",
        "default_frame_rate is -3",
        "memory_limit is 0",
        "'robot' is unknown",
        "Did you mean 'robots'",
    ):
        assert words in done.stderr
    assert "Traceback" not in done.stdout + done.stderr
    assert "docs/parameters.md" in done.stderr


@pytest.mark.parametrize(
    ("arguments", "says"),
    [
        (("-p", "telemetry_rate:=fast"), "telemetry_rate is 'fast'; expected a number"),
        (("-p", "telemetry_rate:=0"), "telemetry_rate is 0; expected a number above 0"),
        (("-p", "telemetry_rate"), "ROS refuses the command line"),
        (("--params-file", "/nowhere.yaml"), "/nowhere.yaml"),
        (("--nonsense",), "ROS refuses the command line"),
    ],
)
def test_each_bad_start_is_a_sentence(arguments, says):
    done = host("playback", "--ros-args", *arguments)
    assert done.returncode == WRONG_CONFIGURATION
    assert says in done.stderr
    assert "Traceback" not in done.stdout + done.stderr


def test_every_node_refuses_a_change_that_it_cannot_make(graph, endpoint, tmp_path):
    nodes = {
        graph.add(BridgeNode, listen=[endpoint]): ("listen", ["tcp/127.0.0.1:1"]),
        graph.add(LabNode): ("robots", ["ur5e"]),
        graph.add(ConverterNode, state_dir=str(tmp_path)): ("state_dir", "/tmp"),
        graph.add(PlaybackHostNode): ("robots", ["ur5e_1"]),
        graph.add(RecorderNode): ("nonsense", 1),
        graph.add(CoordinatorNode): ("nonsense", 1),
    }
    for node, (name, value) in nodes.items():
        before = node.parameters
        result = change(graph, node, name, value)
        assert not result.successful
        expected = "is unknown" if name == "nonsense" else f"is read when {node.get_name()} starts"
        assert f"{name}" in result.reason
        assert expected in result.reason
        assert node.parameters == before
        if name != "nonsense":
            answer = graph.call(
                DescribeParameters, f"/{node.get_name()}/describe_parameters", names=[name]
            )
            assert answer.descriptors[0].read_only


def test_bad_changes_are_refused_through_the_service(graph):
    node = graph.add(PlaybackHostNode)
    for name, value in (("telemetry_rate", 0.0), ("telemetry_rate", float("nan")),
                        ("staging.velocity_share", 7.0), ("staging.jerk", "high")):  # fmt: skip
        result = change(graph, node, name, value)
        assert not result.successful
        assert f"{name} is " in result.reason
        assert "expected a number" in result.reason
    answer = graph.call(GetParameters, "/playback_host/get_parameters", names=["telemetry_rate"])
    assert answer.values[0].type == ParameterType.PARAMETER_DOUBLE
    assert answer.values[0].double_value == 10.0


def test_the_telemetry_rate_changes_while_a_robot_moves(graph):
    lab = small_lab.start(graph)
    robot = small_lab.spawn(graph)
    small_lab.load(graph, robot, "long")
    inbox = graph.listen(msg.Telemetry, f"/{robot}/telemetry", qos.STREAM)
    assert change(graph, lab.host, "telemetry_rate", 1).successful
    assert graph.call(Trigger, f"/{robot}/play").success
    assert change(graph, lab.host, "telemetry_rate", 100).successful

    def fast() -> bool:
        stamps = [m.header.stamp.sec + m.header.stamp.nanosec * 1e-9 for m in inbox[-6:]]
        return len(stamps) == 6 and stamps[-1] - stamps[0] < 0.5

    wait_for(fast, "six messages within half a second")


def test_the_standing_rate_counts_for_robots_that_stand(graph):
    lab = small_lab.start(graph)
    robot = small_lab.spawn(graph)
    inbox = graph.listen(JointState, f"/{robot}/joint_states", qos.STREAM)
    assert change(graph, lab.host, "standing_rate", 0).successful
    node = wait_for(lambda: lab.host.nodes.get(robot), "the robot's playback")
    wait_for(lambda: node.playback.due_ns() is None, "no repetition")
    assert change(graph, lab.host, "standing_rate", 50).successful
    before = len(inbox)
    wait_for(lambda: len(inbox) > before + 5, "poses of the standing robot")


def test_who_subscribes_to_a_robot_that_stands_gets_its_pose_at_once(graph):
    lab = small_lab.start(graph)
    robot = small_lab.spawn(graph)
    assert change(graph, lab.host, "standing_rate", 0.01).successful
    node = wait_for(lambda: lab.host.nodes.get(robot), "the robot's playback")
    node.playback.tick(node.playback.due_ns())
    inbox = graph.listen(JointState, f"/{robot}/joint_states", qos.STREAM)
    wait_for(lambda: inbox, "its pose, which is repeated after 100 s")


def test_a_gentler_staging_takes_longer(graph):
    lab = small_lab.start(graph)
    robot = small_lab.spawn(graph)
    small_lab.load(graph, robot, "wave")
    playback = lab.host.nodes[robot]
    motion = (playback.model, playback.model.home, playback.model.home + 0.5)
    before = lab.host._planner.plan(*motion).duration
    assert change(graph, lab.host, "staging.velocity_share", 0.05).successful
    assert lab.host._planner.plan(*motion).duration > 2 * before


def test_the_default_frame_rate_counts_from_the_next_conversion(graph, tmp_path):
    from scipy.io import savemat

    node = graph.add(ConverterNode, state_dir=str(tmp_path))
    path = tmp_path / "plain.mat"
    savemat(path, {"q": np.linspace(0, 0.5, 50)[:, None] * np.ones(6)})
    convert = {"path": str(path), "robot_model": "ur5e"}
    first = graph.call(srv.ConvertTrajectory, "/converter/convert", **convert, id="first")
    assert change(graph, node, "default_frame_rate", 50).successful
    second = graph.call(srv.ConvertTrajectory, "/converter/convert", **convert, id="second")
    assert (first.trajectory.frame_rate, second.trajectory.frame_rate) == (100.0, 50.0)
    assert change(graph, node, "file_size_limit", 1).successful
    big = tmp_path / "big.mat"
    savemat(big, {"q": np.zeros((60_000, 6))})
    refused = graph.call(srv.ConvertTrajectory, "/converter/convert", path=str(big),
                         robot_model="ur5e")  # fmt: skip
    assert not refused.success
    assert "too large" in refused.message


def test_the_recorder_takes_a_new_folder_and_new_topics(graph, tmp_path):
    node = graph.add(RecorderNode, bag_dir=str(tmp_path / "old"))
    assert change(graph, node, "bag_dir", str(tmp_path / "new")).successful
    assert change(graph, node, "topics", ["/robots"]).successful
    answer = graph.call(srv.StartRecording, "/recorder/start", bag="session")
    assert answer.success, answer.message
    assert Path(answer.bag) == tmp_path / "new" / "session"
    assert graph.call(Trigger, "/recorder/stop").success


def test_the_bridge_checks_the_graph_as_often_as_it_is_set(graph, endpoint):
    node = graph.add(BridgeNode, listen=[endpoint], discovery_period=60.0)
    out = graph.client.create_publisher(msg.Robots, "robots", qos.LATCHED)
    # While the graph changes, the set period counts.
    assert change(graph, node, "discovery_period", 0.02).successful
    wait_for(out.get_subscription_count, "the bridge to find a topic")
