"""A robot's joint states are captured and compared with what was planned, by the command line."""

from __future__ import annotations

import json
import math
import threading
import time

import in_process
import launched_lab
import numpy as np
import pytest
import rclpy
from scipy.io import savemat
from sensor_msgs.msg import JointState

from mrlab_ros.adapters.robots.library import RobotLibrary
from mrlab_ros.adapters.share import directory
from mrlab_ros.messages import qos
from mrlab_ros.messages.time import time_to_message

UR5E = RobotLibrary(directory() / "robots").model("ur5e")
# What the robot does later than planned, s, and by how much its elbow is off, rad.
LATE, OFF = 0.12, 0.02
PERIOD = 4.0


def course(seconds: float) -> np.ndarray:
    """The joints again and again on their way, (J,) rad."""
    return UR5E.home + 0.2 * math.sin(2 * math.pi * seconds / PERIOD) * np.linspace(1, 0.5, 6)


@pytest.fixture
def robot():
    """A robot that follows the course, with its joints in another order, beside its plan."""
    context = rclpy.Context()
    context.init()
    node = rclpy.create_node("robot", context=context)
    planned = node.create_publisher(JointState, "/planned", qos.STREAM)
    measured = node.create_publisher(JointState, "/joint_states", qos.NEWEST)
    names, ended, began = list(UR5E.joint_names), threading.Event(), time.time()

    def publish() -> None:
        while not ended.wait(0.008):
            now = time.time()
            message = JointState(name=names, position=course(now - began).tolist())
            message.header.stamp = time_to_message(round(now * 1e9))
            planned.publish(message)
            arm = course(now - began - LATE)
            arm[2] += OFF
            message.name = [*reversed(names), "tool_joint"]
            message.position = [*arm[::-1].tolist(), 0.0]
            measured.publish(message)

    thread = threading.Thread(target=publish)
    thread.start()
    yield
    ended.set()
    thread.join()
    node.destroy_node()
    context.try_shutdown()


def run(*words, start=in_process.mrlab):
    return start(*map(str, words), "--robot", "ur5e")


def test_a_robot_is_compared_with_a_topic_by_stamps_and_with_a_file(robot, tmp_path) -> None:
    bag = tmp_path / "real"
    done = run("capture", "joint_states", "--seconds", 3, "--timeout", 30, "--out", bag,
               "--against", "/planned", "--json", start=launched_lab.mrlab)  # fmt: skip
    assert done.returncode == 0, done.stderr
    facts = json.loads(done.stdout)
    found = facts["comparison"]
    assert (facts["bags"][0], facts["duration"]) == (str(bag), pytest.approx(3.0, abs=0.5))
    assert found["delay"] == pytest.approx(LATE, abs=0.02)
    most = {joint["name"]: joint["most"] for joint in found["joints"]}
    assert max(most, key=most.get) == UR5E.joint_names[2]
    assert most[UR5E.joint_names[2]] == pytest.approx(OFF, abs=0.01)

    plan = tmp_path / "plan.mat"
    savemat(plan, {"q": np.stack([course(k / 100) for k in range(1001)]), "fs": 100.0})
    again = run("compare", plan, bag)
    assert again.returncode == 0, again.stderr
    assert "counted from the first frame of each" in again.stdout
    assert "elbow_joint" in again.stdout


def test_what_cannot_be_captured_is_one_sentence(tmp_path, monkeypatch) -> None:
    monkeypatch.chdir(tmp_path)
    for words, said in (
        (("/nobody", "--timeout", 0.1), "/nobody"),
        (("/nobody", "--seconds", "nan"), "--seconds"),
        (("/nobody", "--from-ros-domain", 233), "--from-ros-domain"),
        (("/nobody", "--against", "none.mat"), "none.mat"),
        (("a b",), "'a b'"),
    ):
        done = run("capture", *words)
        assert done.returncode in (1, 2)
        assert said in done.stderr + done.stdout
        assert "Traceback" not in done.stderr
    assert not list(tmp_path.iterdir())


def test_what_is_advised_of_a_refused_plan_makes_one_that_is_compared(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    rows = np.stack([course(k / 100) for k in range(401)])
    savemat("plan.mat", {"q": np.degrees(rows), "fs": 100.0})
    savemat("real.mat", {"q": rows, "fs": 100.0})
    refused = run("compare", "plan.mat", "real.mat")
    assert refused.returncode == 1
    advised = next(line for line in refused.stdout.splitlines() if "try: mrlab " in line)
    assert in_process.mrlab(*advised.split("try: mrlab ")[1].split()).returncode == 0
    done = run("compare", "mended/plan.mat", "real.mat", "--json")
    assert json.loads(done.stdout)["comparison"]["delay"] == pytest.approx(0, abs=1e-3)
