"""A session of a launched lab, recorded and brought back, as an instructor does it."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest
import zenoh
from child_process import start_child
from launched_lab import DEADLINE, MRLAB, done, launched_lab
from mrlab_msgs import msg
from own_port import free_endpoint
from sensor_msgs.msg import JointState

from mrlab_ros.adapters.bags.reader import Bag
from mrlab_ros.messages import qos
from mrlab_ros.processes.run_file import RunFile
from mrlab_ros.ros.environment import domain_id
from mrlab_ros.ros.graph_node import Graph

MOTION = Path(__file__).parents[2] / "examples" / "quintic_ur5e.mat"
JOINTS = "/ur5e_1/joint_states"


def wait_for(condition: Callable[[], Any], what: str) -> Any:
    end = time.monotonic() + DEADLINE
    while not (value := condition()):
        assert time.monotonic() < end, f"not within {DEADLINE} s: {what}"
        time.sleep(0.05)
    return value


@pytest.fixture(scope="module")
def endpoint(tmp_path_factory: pytest.TempPathFactory) -> Iterator[str]:
    """Where the bridge of a running lab with one robot listens."""
    # A short name: the path of a Unix socket has 107 bytes at most.
    folder, where = tmp_path_factory.mktemp("r"), free_endpoint()
    with (
        pytest.MonkeyPatch.context() as patch,
        launched_lab(folder, patch, "--robots", "ur5e", "--zenoh-listen", where),
    ):
        yield where


class Watcher:
    """Hears the joint states as a client of zenoh does."""

    def __init__(self, endpoint: str) -> None:
        config = zenoh.Config()
        config.insert_json5("mode", '"client"')
        config.insert_json5("connect/endpoints", json.dumps([endpoint]))
        self._session = zenoh.open(config)
        self.heard: list[bytes] = []
        self._subscriber = self._session.declare_subscriber(
            JOINTS[1:], lambda sample: self.heard.append(sample.payload.to_bytes())
        )

    def close(self) -> None:
        self._subscriber.undeclare()
        self._session.close()


@contextmanager
def recording(bag: Path) -> Iterator[subprocess.Popen[str]]:
    """Yield `mrlab record` once it records."""
    recorder = start_child(
        *MRLAB, "record", str(bag), stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    )
    assert recorder.stdout is not None
    try:
        assert f"records into {bag}" in recorder.stdout.readline()
        yield recorder
    finally:
        recorder.kill()


def record_a_play(bag: Path) -> None:
    with recording(bag) as recorder:
        # All of the motion is in the bag once the recorder listens to it.
        with Graph() as graph:
            wait_for(lambda: graph.node.count_subscribers(JOINTS) >= 2, "the recorder listening")
        assert "played 601 frames" in done("play", "ur5e_1", MOTION, "--speed", "4")
        recorder.send_signal(signal.SIGINT)
        said, trouble = recorder.communicate(timeout=DEADLINE)
        assert recorder.returncode == 0, trouble
        assert f"{bag} holds" in said


def recorder_process() -> int:
    """Return the process of the lab's recorder, once there is one."""

    def find() -> int | None:
        processes = (RunFile(domain_id()).read() or {})["processes"]
        return next(each["pid"] for each in processes if each["name"] == "recorder")

    return int(wait_for(find, "the recorder's process"))


@pytest.mark.parametrize("how", [signal.SIGKILL, signal.SIGTERM])
def test_a_recording_ends_as_asked_although_its_recorder_is_dead(
    endpoint: str, tmp_path: Path, how: signal.Signals
) -> None:
    bag = tmp_path / "session"
    with recording(bag) as recorder:
        wait_for(lambda: Bag(bag).message_count, "messages on the disk")
        os.kill(recorder_process(), how)
        recorder.send_signal(signal.SIGINT)
        _, trouble = recorder.communicate(timeout=DEADLINE)
        assert recorder.returncode == 0, trouble
    with Graph() as graph:
        state = graph.watch(msg.RecorderState, "/recorder/state")
        state.wait(lambda s: s.state == s.STOPPED, DEADLINE)
    assert Bag(bag).message_count


def test_what_a_student_did_comes_back(endpoint: str, tmp_path: Path) -> None:
    bag = tmp_path / "session"
    record_a_play(bag)
    recorded = [message.data for message in Bag(bag).messages(topics={JOINTS})]
    assert len(recorded) > 150
    facts = json.loads(done("bag", "info", bag, "--json"))
    assert {"robots/ur5e_1.urdf", "trajectories/quintic_ur5e.json"} <= set(facts["attachments"])
    report = json.loads(done("bag", "report", bag, "--json"))
    (robot,) = report["robots"]
    assert [span["label"] for span in robot["states"]][:2] == ["IDLE", "READY"]
    assert "PLAYING" in [span["label"] for span in robot["states"]]
    assert robot["tracking_error"]["count"] > 100
    assert robot["tracking_error"]["max"] < 1e-6

    heard: list[bytes] = []
    watcher = Watcher(endpoint)
    with Graph() as graph:
        graph.node.create_subscription(JointState, JOINTS, heard.append, qos.STREAM, raw=True)

        def publishers() -> set[str]:
            return {e.node_name for e in graph.node.get_publishers_info_by_topic(JOINTS)}

        wait_for(lambda: publishers() == {"_playback"}, "the lab's own playback")
        state = graph.watch(msg.RecorderState, "/recorder/state")
        replay = start_child(
            *MRLAB, "replay", str(bag), "--rate", "10", stdout=subprocess.PIPE, text=True
        )
        try:
            wait_for(lambda: publishers() == {"_recorder_streams"}, "the playback aside")
            state.wait(lambda s: s.state == s.REPLAYING, DEADLINE)
            assert state.value.bag == str(bag)
            assert "the replay is over" in replay.communicate(timeout=DEADLINE)[0]
        finally:
            replay.kill()
        # Before and after it the lab's own robot tells its pose; no stamp comes twice.
        first = heard.index(recorded[0])
        assert heard[first : first + len(recorded)] == recorded
        assert set(recorded) & set(watcher.heard)
        watcher.close()
        wait_for(lambda: publishers() == {"_playback"}, "the lab's own playback back")
        robot = graph.watch(msg.PlaybackState, "/ur5e_1/playback_state")
        robot.wait(
            lambda s: (s.label, s.trajectory_id) == ("READY", "quintic_ur5e"),
            DEADLINE,
        )
