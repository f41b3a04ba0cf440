"""The client in C draws on nothing but zenoh's protocol; it is built with gcc and run here."""

from __future__ import annotations

import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest
from child_process import start_child
from graph import wait_for
from mrlab_msgs.msg import Robot, Robots
from sensor_msgs.msg import JointState
from zenoh_side import ask, heard

from mrlab_ros.adapters.robots.library import RobotLibrary
from mrlab_ros.messages import qos

ROOT = Path(__file__).parents[2]
SOURCES = ROOT / "examples" / "clients" / "c"


@pytest.fixture(scope="module")
def program(tmp_path_factory):
    """The client, built with the checks of the address and undefined-behaviour sanitizers."""
    if shutil.which("gcc") is None:
        pytest.fail("gcc is missing; install it, the set-up needs it as well")
    path = tmp_path_factory.mktemp("c") / "lab_client"
    flags = "-O1 -g -Werror -fsanitize=address,undefined -fno-sanitize-recover=all"
    built = subprocess.run(
        ["make", "-C", str(SOURCES), f"OUT={path}", "CC=gcc", f"CFLAGS={flags}"],
        capture_output=True,
        text=True,
        check=False,
    )
    assert built.returncode == 0, built.stderr
    return path


@pytest.fixture
def client(program, endpoint):
    """Start the client with arguments."""

    def start(*arguments):
        host, port = endpoint.removeprefix("tcp/").split(":")
        return start_child(
            *(str(program), "--host", host, "--port", port, *arguments),
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
        )

    return start


@pytest.fixture
def scene(graph, bridge, session):
    robots = [
        Robot(name="ur5e_1", model="ur5e", joint_names=["a", "bc"]),
        Robot(name="kr3_1", model="kuka_kr3_r540", end_effector="parallel_gripper"),
    ]
    publisher = graph.client.create_publisher(Robots, "robots", qos.LATCHED)
    publisher.publish(Robots(robots=robots))
    wait_for(lambda: list(session.get("robots")), "the scene on zenoh")
    return {robot.name: robot for robot in robots}


def test_it_lists_the_robots_in_the_scene(scene, client):
    out, err = client().communicate(timeout=60)
    assert out.splitlines() == ["robot ur5e_1 ur5e ", "robot kr3_1 kuka_kr3_r540 parallel_gripper"]
    assert err == ""


# Small batches make the bridge send fragments, and small pieces several answers a file.
@pytest.mark.parametrize(
    ("name", "sizes"),
    [("ur5e_1", ()), ("kr3_1", ("--batch", "1024", "--piece", "16000"))],
)
def test_it_follows_the_tool_with_what_the_keys_deliver(
    graph, scene, session, client, name, sizes
):
    model = RobotLibrary(ROOT / "robots").model(scene[name].model)
    publisher = graph.client.create_publisher(JointState, f"{name}/joint_states", qos.STREAM)
    follower = client(*sizes, name, "3")
    wait_for(
        lambda: heard(session, f"{name}/joint_states") or follower.poll() is not None,
        "the client",
        timeout=60,
    )
    positions = model.home + np.linspace(0.1, 0.6, len(model.joints))
    for step in range(3):
        message = JointState(name=model.joint_names, position=(positions + 0.1 * step).tolist())
        publisher.publish(message)
    out, err = follower.communicate(timeout=60)
    assert (follower.returncode, err) == (0, "")
    lines = out.splitlines()
    urdf = next(line for line in lines if line.startswith("urdf"))
    assert (scene[name].end_effector or ".urdf") in urdf
    assert any(line.startswith("meshes ") for line in lines)
    tools = [list(map(float, line.split()[1:])) for line in lines if line.startswith("tool0")]
    for step, tool in enumerate(tools):
        expected = model.chain.tool0(positions + 0.1 * step)[:3, 3]
        assert tool == pytest.approx(expected.tolist(), abs=2e-6)
    assert len(tools) == 3


def test_a_message_larger_than_a_batch_is_put_together(scene, session, client):
    whole = ask(session, "assets/robots/kuka_kr3_r540+parallel_gripper.urdf")[0]
    follower = client("--batch", "512", "kr3_1", "0")
    out, err = follower.communicate(timeout=120)
    assert (follower.returncode, err) == (0, "")
    assert f"{len(whole)} bytes" in out


def test_it_says_why_not(scene, client, program):
    stranger = client("ur5e_9")
    assert "there is no robot ur5e_9" in stranger.communicate(timeout=60)[1]
    assert stranger.returncode == 1
    nobody = subprocess.run(
        [program, "--port", "1"], capture_output=True, text=True, timeout=60, check=False
    )
    assert nobody.returncode == 1
    assert "no lab at 127.0.0.1 port 1" in nobody.stderr
