"""The action, the topic and the stream by which others drive a robot, in a graph."""

from __future__ import annotations

import time
from collections.abc import Callable
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
import small_lab
from action_msgs.msg import GoalStatus
from builtin_interfaces.msg import Duration
from control_msgs.action import FollowJointTrajectory
from control_msgs.msg import JointTolerance
from graph import Graph, wait_for
from mrlab_msgs import msg
from mrlab_msgs.srv import Trigger
from rcl_interfaces.msg import Log
from rclpy.action import ActionClient
from rclpy.action.client import ClientGoalHandle
from rclpy.qos import QoSProfile
from rclpy.task import Future
from sensor_msgs.msg import JointState
from small_lab import LIBRARY, labels, listen_state, spawn
from trajectory_msgs.msg import JointTrajectory, JointTrajectoryPoint

from mrlab_ros.core.runtime.freezes import Freezes
from mrlab_ros.messages import qos
from mrlab_ros.nodes.playback import commanders
from mrlab_ros.ros import clock

Result = FollowJointTrajectory.Result


@pytest.fixture
def stage(graph: Graph):
    small_lab.start(graph)
    robot = spawn(graph)
    return graph, robot, LIBRARY.model("ur5e")


def path(model, *at: tuple[float, float]) -> JointTrajectory:
    return JointTrajectory(
        joint_names=list(model.joint_names),
        points=[
            JointTrajectoryPoint(
                positions=(model.home + way).tolist(),
                time_from_start=Duration(sec=int(time), nanosec=round(time % 1 * 1e9)),
            )
            for time, way in at
        ],
    )


class Client:
    """An action client as MoveIt's."""

    def __init__(self, graph: Graph, robot: str) -> None:
        self.feedback: list[Any] = []
        self._node = graph.client
        self._client = ActionClient(
            graph.client, FollowJointTrajectory, f"/{robot}/follow_joint_trajectory"
        )
        assert self._client.wait_for_server(timeout_sec=15.0)

    def send(self, goal: FollowJointTrajectory.Goal) -> ClientGoalHandle:
        sent = self.ask(
            lambda: self._client.send_goal_async(
                goal, feedback_callback=lambda message: self.feedback.append(message.feedback)
            )
        )
        wait_for(sent.done, "the goal's acceptance")
        return sent.result()

    def result(self, handle: ClientGoalHandle) -> Any:
        asked = self.ask(handle.get_result_async)
        wait_for(asked.done, "the goal's end")
        return asked.result()

    def ask(self, request: Callable[[], Future]) -> Future:
        """Send a request from the thread that takes its response.

        rclpy's action client knows a request only after it was sent: a response that another
        thread takes before is dropped.
        """
        sent: list[Future] = []

        def send() -> None:
            timer.cancel()
            sent.append(request())

        timer = self._node.create_timer(0.001, send)
        wait_for(lambda: sent, "the request")
        self._node.destroy_timer(timer)
        return sent[0]


def goal(trajectory: JointTrajectory, **fields: Any) -> FollowJointTrajectory.Goal:
    return FollowJointTrajectory.Goal(trajectory=trajectory, **fields)


def test_a_goal_is_followed_with_feedback_and_ends_with_a_result(stage) -> None:
    graph, robot, model = stage
    joints = graph.listen(JointState, f"/{robot}/joint_states", qos.STREAM)
    client = Client(graph, robot)
    tolerance = [
        JointTolerance(name=name, position=0.05, velocity=2.0) for name in model.joint_names
    ]
    handle = client.send(
        goal(path(model, (0.2, 0.1), (0.6, 0.3)), path_tolerance=tolerance,
             goal_tolerance=tolerance, goal_time_tolerance=Duration(sec=2))
    )  # fmt: skip
    assert handle.accepted
    done = client.result(handle)
    assert (done.status, done.result.error_code) == (GoalStatus.STATUS_SUCCEEDED, 0)
    assert done.result.error_string.startswith("Goal successfully reached! After 0.60 s of 0.60 s")
    wait_for(lambda: joints[-1].position[0] == pytest.approx(model.home[0] + 0.3), "the place")
    told = client.feedback[-1]
    assert told.joint_names == list(model.joint_names)
    assert told.desired.positions[0] - told.actual.positions[0] == told.error.positions[0]
    assert len(told.actual.velocities) == len(told.error.velocities) == len(model.joint_names)


@pytest.mark.parametrize(
    ("change", "code", "words"),
    [
        ({"joint_names": ["a"]}, Result.INVALID_JOINTS, "unknown: a"),
        ({"points": []}, Result.INVALID_GOAL, "no points"),
    ],
)
def test_a_bad_goal_is_aborted_with_code_and_sentence_and_disturbs_none(
    stage, change, code, words
) -> None:
    graph, robot, model = stage
    client = Client(graph, robot)
    first = client.send(goal(path(model, (0.8, 0.2))))
    bad = path(model, (1.0, 0.1))
    for name, value in change.items():
        setattr(bad, name, value)
    done = client.result(client.send(goal(bad)))
    assert (done.status, done.result.error_code) == (GoalStatus.STATUS_ABORTED, code)
    assert words in done.result.error_string
    assert client.result(first).status == GoalStatus.STATUS_SUCCEEDED


def test_a_goal_that_may_have_waited_in_a_freeze_is_aborted(stage, monkeypatch) -> None:
    graph, robot, model = stage
    client = Client(graph, robot)
    thawed = Freezes("playback", lambda: 0.0)
    thawed.begin()
    # It ran 30 s ago, and runs again from now on.
    thawed.look(time.monotonic() - 30.0)
    monkeypatch.setattr(clock, "PROCESS", thawed)
    done = client.result(client.send(goal(path(model, (0.2, 0.1)))))
    assert (done.status, done.result.error_code) == (
        GoalStatus.STATUS_ABORTED,
        Result.INVALID_GOAL,
    )
    assert "playback did not run for 30 s" in done.result.error_string


def test_a_cancelled_goal_holds_and_a_new_one_replaces_it(stage) -> None:
    graph, robot, model = stage
    states = listen_state(graph, robot)
    client = Client(graph, robot)
    handle = client.send(goal(path(model, (5.0, 0.5))))
    wait_for(lambda: "PLAYING" in labels(states), "the motion")
    cancelled = client.ask(handle.cancel_goal_async)
    wait_for(cancelled.done, "the cancelling")
    assert cancelled.result().goals_canceling
    assert client.result(handle).status == GoalStatus.STATUS_CANCELED
    wait_for(lambda: states.last().label == "PAUSED", "the hold")
    second = client.send(goal(path(model, (5.0, 0.1))))
    third = client.send(goal(path(model, (0.3, 0.05))))
    done = client.result(second)
    assert done.status == GoalStatus.STATUS_ABORTED
    assert "new goal came" in done.result.error_string
    assert client.result(third).status == GoalStatus.STATUS_SUCCEEDED


def test_a_halt_and_a_stop_abort_a_goal(stage) -> None:
    graph, robot, model = stage
    states = listen_state(graph, robot)
    client = Client(graph, robot)
    handle = client.send(goal(path(model, (5.0, 0.5))))
    wait_for(lambda: "PLAYING" in labels(states), "the motion")
    assert graph.call(Trigger, f"/{robot}/stop").success
    done = client.result(handle)
    assert done.status == GoalStatus.STATUS_ABORTED
    assert done.result.error_string.startswith("The robot was stopped.")
    handle = client.send(goal(path(model, (5.0, 0.5))))
    physics = graph.client.create_publisher(msg.Collision, f"/{robot}/collision", qos.LATCHED)
    physics.publish(msg.Collision(colliding=True, contact=msg.Contact(link="a", other="b")))
    done = client.result(handle)
    assert done.result.error_code == Result.PATH_TOLERANCE_VIOLATED
    assert "a touches b" in done.result.error_string


def test_a_trajectory_on_the_topic_is_played(stage) -> None:
    graph, robot, model = stage
    states = listen_state(graph, robot)
    publisher = graph.client.create_publisher(
        JointTrajectory, f"/{robot}/joint_trajectory", qos.EVENTS
    )
    wait_for(publisher.get_subscription_count, "the playback")
    publisher.publish(path(model, (0.2, 0.1)))
    wait_for(lambda: "COMPLETE" in labels(states), "the end")
    assert states.last().trajectory_id == "follow_joint_trajectory"
    assert states.last().trajectory_version == 0, "it is in no catalogue"


@pytest.mark.parametrize("reliability", ["RELIABLE", "BEST_EFFORT"])
def test_a_stream_of_set_points_moves_the_robot(stage, reliability) -> None:
    from rclpy.qos import ReliabilityPolicy

    graph, robot, model = stage
    states = listen_state(graph, robot)
    joints = graph.listen(JointState, f"/{robot}/joint_states", qos.STREAM)
    publisher = graph.client.create_publisher(
        JointState,
        f"/{robot}/joint_command",
        QoSProfile(depth=1, reliability=ReliabilityPolicy[reliability]),
    )
    wait_for(publisher.get_subscription_count, "the playback")
    command = JointState(name=list(model.joint_names), position=(model.home + 0.05).tolist())

    def moved():
        publisher.publish(command)
        return joints and joints[-1].position[0] == pytest.approx(model.home[0] + 0.05)

    wait_for(moved, "the robot at the set-point")
    assert "PLAYING" in labels(states)
    assert states.last().trajectory_id == "live"
    command.position = [99.0] * 6

    def refused():
        publisher.publish(command)
        return states.last().code == "command_refused"

    wait_for(refused, "the refusal in the robot's state")
    wait_for(lambda: states.last().label == "PAUSED", "the end of the stream")


def test_a_fast_stream_is_followed_and_the_robot_stands_when_it_ends(stage) -> None:
    graph, robot, model = stage
    states = listen_state(graph, robot)
    joints = graph.listen(JointState, f"/{robot}/joint_states", qos.STREAM)
    publisher = graph.client.create_publisher(
        JointState, f"/{robot}/joint_command", QoSProfile(depth=1)
    )
    wait_for(publisher.get_subscription_count, "the playback")
    speed, began = 0.2, time.time()
    while (passed := time.time() - began) < 2.0:
        publisher.publish(JointState(position=(model.home + speed * passed).tolist()))
        time.sleep(0.002)
    ended = time.time()
    wait_for(lambda: states.last().label == "PAUSED", "the end of the stream")
    sent = [(j.header.stamp.sec + j.header.stamp.nanosec * 1e-9, j.position[0]) for j in joints]
    assert sent[-1][1] == pytest.approx(model.home[0] + speed * passed, abs=0.02)
    late = [t - began - (q - model.home[0]) / speed for t, q in sent if began + 1 < t < ended]
    assert np.median(late) < 0.03, "s; 0.3 rad were 1.5 s"
    places = [q for t, q in sent if t > ended + 0.1]
    assert np.ptp(places) < 1e-6, "it stands"


def test_what_is_refused_again_and_again_is_logged_once_a_second(stage, monkeypatch) -> None:
    graph, robot, model = stage
    now = 100.0
    monkeypatch.setattr(commanders, "time", SimpleNamespace(monotonic=lambda: now))
    logged = graph.listen(Log, "/rosout", qos.LATCHED_EVENTS)
    many = QoSProfile(depth=1000)
    node, name = graph.client, f"/{robot}/joint"
    commands = node.create_publisher(JointState, f"{name}_command", many)
    trajectories = node.create_publisher(JointTrajectory, f"{name}_trajectory", many)
    for publisher in (commands, trajectories):
        wait_for(publisher.get_subscription_count, "the playback")
    states = listen_state(graph, robot)

    def said(words: str) -> int:
        return sum(words in line.msg for line in list(logged))

    def refuse() -> None:
        """Send good and bad set-points in turn, and bad trajectories."""
        for i in range(50):
            commands.publish(JointState(position=(model.home + 0.001 * i).tolist()))
            commands.publish(JointState(position=[99.0] * 6))
            trajectories.publish(path(model, (1.0, 99.0)))

    def refused_again() -> bool:
        refuse()
        return said("refuses a joint_trajectory") > 1

    refuse()
    wait_for(lambda: said(f"{robot}: shoulder") and said("refuses a joint_traj"), "the warnings")
    wait_for(lambda: "live" in {state.trajectory_id for state in states}, "the stream")
    # A good trajectory is played when all before it were refused.
    wait_for(lambda: states.last().label == "PAUSED", "the end of the stream")
    trajectories.publish(path(model, (0.1, 0.05)))
    wait_for(lambda: states.last().trajectory_id == "follow_joint_trajectory", "the motion")
    assert said(f"{robot}: shoulder") == said("refuses a joint_trajectory") == 1
    now += 1.5
    wait_for(refused_again, "the next warning")
