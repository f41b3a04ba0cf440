"""`mrlab demo --once`: from the shipped files to every frame received over zenoh."""

from __future__ import annotations

import json
import socket
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from own_domain import own_domain
from rclpy.serialization import serialize_message
from sensor_msgs.msg import JointState

from mrlab_ros.commands.demo.arrivals import frames_in_order
from mrlab_ros.commands.demo.lab import (
    ZENOH_PORT,
    claim_free_domain,
    domain_is_free,
    free_port,
)
from mrlab_ros.core.trajectory.trajectory import Channels, Source, Trajectory
from mrlab_ros.messages import trajectories
from mrlab_ros.messages.time import time_to_message

EXAMPLES = Path(__file__).parents[2] / "examples"
START_NS = 1_700_000_000_000_000_000


def demo(*arguments: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        (sys.executable, "-m", "mrlab_ros.cli", "demo", "--once", *arguments),
        capture_output=True,
        text=True,
        timeout=100,
        check=False,
    )


@pytest.fixture(autouse=True)
def runtime(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    monkeypatch.setenv("XDG_RUNTIME_DIR", str(tmp_path))
    with own_domain() as domain:
        monkeypatch.setenv("ROS_DOMAIN_ID", str(domain))
        yield


def test_two_robots_play_and_every_frame_arrives() -> None:
    done = demo("--json")
    assert done.returncode == 0, done.stdout + done.stderr
    summary = json.loads(done.stdout)
    assert summary["success"]
    assert [robot["robot"] for robot in summary["robots"]] == ["ur5e_1", "kuka_kr6_r900_sixx_1"]
    for robot in summary["robots"]:
        assert robot["frames_received"] == robot["frames_expected"] == 801
        assert robot["frames_lost"] == 0
        assert robot["zenoh_messages"] >= 801


def test_a_file_of_ones_own_plays_on_one_robot() -> None:
    done = demo("--file", str(EXAMPLES / "quintic_ur5e.mat"))
    assert done.returncode == 0, done.stdout + done.stderr
    assert "601/601" in done.stdout
    assert "Every frame arrived." in done.stdout


def test_a_refused_file_is_one_sentence_and_exit_code_1(tmp_path: Path) -> None:
    file = tmp_path / "words.mat"
    file.write_text("this is no workspace")
    done = demo("--file", str(file))
    assert done.returncode == 1
    assert "words.mat" in done.stderr
    assert done.stderr.count("\n") == 1
    assert "Traceback" not in done.stdout


class TestFramesInOrder:
    """What counts as a frame that arrived."""

    trajectory = Trajectory(
        "t",
        "ur5e",
        None,
        ("a", "b"),
        100.0,
        np.arange(8.0).reshape(4, 2),
        None,
        Channels(np.zeros((4, 2)), np.zeros((4, 2))),
        Source("t.mat", "q", "0" * 64),
    )

    def payload(self, frame: int, *, late_ns: int = 0, error: float = 0.0) -> bytes:
        message = JointState(name=["a", "b"])
        message.header.stamp = time_to_message(START_NS + frame * 10_000_000 + late_ns)
        message.position = (np.array([2.0 * frame, 2.0 * frame + 1]) + error).tolist()
        return bytes(serialize_message(message))

    def count(self, payloads: list[bytes]) -> tuple[int, list[str]]:
        message = trajectories.trajectory_to_message(self.trajectory)
        return frames_in_order(payloads, message, START_NS)

    def test_all_in_order(self) -> None:
        assert self.count([self.payload(i) for i in range(4)]) == (4, [])

    def test_what_was_sent_before_and_after_the_run_is_none_of_it(self) -> None:
        assert self.count([self.payload(i) for i in (-50, -1, 0, 1, 2, 3, 4)]) == (4, [])

    def test_a_missing_frame(self) -> None:
        found, wrong = self.count([self.payload(i) for i in (0, 1, 3)])
        assert (found, wrong) == (3, ["frame 3 came where frame 2 was due"])

    def test_a_frame_that_comes_twice_counts_once(self) -> None:
        found, wrong = self.count([self.payload(i) for i in (0, 1, 1, 2, 3)])
        assert (found, wrong) == (4, ["frame 1 came where frame 2 was due"])

    def test_a_wrong_value_or_stamp_is_no_frame(self) -> None:
        payloads = [self.payload(0), self.payload(1, error=1e-15), self.payload(2, late_ns=50_000)]
        found, wrong = self.count([*payloads, self.payload(3)])
        assert found == 2
        assert wrong[0] == "frame 1 has other positions than the file"


def test_a_port_in_use_is_not_chosen() -> None:
    with socket.socket() as server:
        server.bind(("127.0.0.1", 0))
        server.listen()
        taken = server.getsockname()[1]
        assert free_port(taken) != taken
    assert free_port(ZENOH_PORT) > 0


def test_a_domain_in_use_is_not_chosen() -> None:
    first, domain = claim_free_domain()
    second, other = claim_free_domain()
    assert other != domain
    second.release()
    first.release()
    again, same = claim_free_domain()
    assert same == domain
    again.release()
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as participant:
        participant.bind(("", 7400 + 250 * domain + 10))
        assert not domain_is_free(domain)
