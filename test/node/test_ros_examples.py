"""The scripts in examples/ros, as their first lines say, against a lab's playback."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
import small_lab
from graph import Graph, wait_for
from sensor_msgs.msg import JointState
from small_lab import labels, listen_state, spawn

from mrlab_ros.messages import qos

EXAMPLES = Path(__file__).parents[2] / "examples" / "ros"
DEADLINE = 60.0


def run(script: str, *arguments: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        (sys.executable, EXAMPLES / script, *arguments),
        capture_output=True,
        text=True,
        timeout=DEADLINE,
        check=False,
    )


@pytest.fixture
def robot(graph: Graph) -> str:
    small_lab.start(graph)
    return spawn(graph)


def test_the_action(graph: Graph, robot: str) -> None:
    states = listen_state(graph, robot)
    done = run("follow_joint_trajectory.py", robot)
    assert done.returncode == 0, done.stderr
    assert f"{robot}: Goal successfully reached!" in done.stdout
    wait_for(lambda: "COMPLETE" in labels(states), "the end")


def test_the_stream(graph: Graph, robot: str) -> None:
    states = listen_state(graph, robot)
    joints = graph.listen(JointState, f"/{robot}/joint_states", qos.STREAM)
    sent = graph.listen(JointState, f"/{robot}/joint_command", qos.STREAM)
    done = run("joint_command.py", robot, "1.2")
    assert done.returncode == 0, done.stderr
    wait_for(lambda: labels(states)[-1:] == ["PAUSED"], "the end of the stream")
    assert "refused" not in " ".join(state.message for state in states)
    asked, moved = (np.ptp([each.position[0] for each in inbox]) for inbox in (sent, joints))
    # A busy machine sends few of the set-points, and the furthest may be missing.
    assert 0.1 < asked < 0.301
    assert moved == pytest.approx(asked, abs=0.03)


# What the ROS Toolbox offers, as far as the script uses it, for Octave.
STANDINS = {
    "ros2node": "function n = ros2node(name)\n  n = name;\nend\n",
    "ros2subscriber": "function s = ros2subscriber(varargin)\n  s = varargin{2};\nend\n",
    "ros2publisher": "function p = ros2publisher(varargin)\n  p = varargin{2};\nend\n",
    "ros2message": (
        "function m = ros2message(p)\n  m = struct('name', {{}}, 'position', []);\nend\n"
    ),
    "receive": (
        "function m = receive(s, t)\n"
        "  m = struct('name', {{'a'; 'b'}}, 'position', [1; 2]);\nend\n"
    ),
    "send": (
        "function send(p, m)\n  f = fopen('sent.txt', 'a');\n"
        "  fprintf(f, '%s %s %.6f %.6f\\n', p, m.name{1}, m.position);\n  fclose(f);\nend\n"
    ),
}


def test_the_matlab_script_sends_what_it_says(tmp_path: Path) -> None:
    octave = shutil.which("octave-cli")
    assert octave is not None, "make test installs octave-cli"
    for name, text in STANDINS.items():
        (tmp_path / f"{name}.m").write_text(text)
    script = (EXAMPLES / "joint_command.m").read_text().replace("seconds = 10;", "seconds = 0.5;")
    (tmp_path / "script.m").write_text(script)
    done = subprocess.run(
        (octave, "--no-gui", "--quiet", "script.m"),
        cwd=tmp_path,
        capture_output=True,
        text=True,
        timeout=DEADLINE,
        check=False,
        env=os.environ | {"HOME": str(tmp_path)},
    )
    assert done.returncode == 0, done.stderr
    sent = [line.split() for line in (tmp_path / "sent.txt").read_text().splitlines()]
    assert {tuple(line[:2]) for line in sent} == {("/ur5e_1/joint_command", "a")}
    positions = np.array([line[2:] for line in sent], dtype=float)
    assert positions[:, 1] - positions[:, 0] == pytest.approx(1.0)
    assert positions[-1, 0] > 1.01
