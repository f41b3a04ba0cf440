"""From a workspace file to joint states: the same bits, whole or in parts, however long."""

from __future__ import annotations

import threading
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
import scipy.io
from graph import Graph, wait_for
from kept import Kept
from mrlab_msgs import msg, srv
from mrlab_msgs.srv import Trigger
from sensor_msgs.msg import JointState
from small_lab import labels, listen_state, load, make, spawn, value_of

from mrlab_ros.adapters.trajectories import npz_file
from mrlab_ros.core.trajectory.trajectory import Channels
from mrlab_ros.messages import qos
from mrlab_ros.nodes.converter import catalogue
from mrlab_ros.nodes.converter.node import ConverterNode
from mrlab_ros.nodes.lab.node import LabNode
from mrlab_ros.nodes.playback.host import PlaybackHostNode

LONG = 60.0  # s; far above what any of this takes


@pytest.fixture
def lab(graph: Graph, tmp_path):
    converter = graph.add(ConverterNode, state_dir=str(tmp_path))
    return SimpleNamespace(
        kept=Kept(converter.trajectories.catalogue, converter.trajectories.files),
        converter=converter,
        lab=graph.add(LabNode),
        host=graph.add(PlaybackHostNode),
    )


def loaded(lab, robot):
    return lab.host.nodes[robot].playback.trajectory


def elsewhere(path):
    raise FileNotFoundError(path)


@pytest.mark.parametrize("same_machine", [True, False])
def test_the_numbers_of_a_workspace_are_played_bit_for_bit(
    graph, lab, tmp_path, monkeypatch, same_machine
):
    if not same_machine:
        monkeypatch.setattr(catalogue.npz_file, "read", elsewhere)
        monkeypatch.setattr(catalogue, "CHUNK", 17)
    # degrees and back would change the last place of about half of these
    u = np.linspace(0, 1, 80)[:, None]
    q = (10 * u**3 - 15 * u**4 + 6 * u**5) * np.linspace(0.3, 0.9, 6) - 1 / 3
    assert (np.radians(np.degrees(q)) != q).sum() > 20
    path = tmp_path / "exact.mat"
    scipy.io.savemat(path, {"run": q, "fs": 100.0}, do_compression=True)
    answer = graph.call(
        srv.ConvertTrajectory, "/converter/convert", path=str(path), robot_model="ur5e"
    )
    assert answer.success, answer.message
    # A warning without a number holds NaN, which equals nothing.
    assert np.isnan(answer.trajectory.warnings[0].value)
    robot = spawn(graph)
    states = listen_state(graph, robot)
    joints = graph.listen(JointState, f"/{robot}/joint_states", qos.STREAM)
    load(graph, robot, "exact")
    np.testing.assert_array_equal(loaded(lab, robot).positions, q)
    assert graph.call(Trigger, f"/{robot}/play").success
    wait_for(lambda: "COMPLETE" in labels(states), "the end", LONG)
    wait_for(lambda: joints and np.array_equal(joints[-1].position, q[-1]), "the last frame")
    sent = {tuple(j.position) for j in joints}
    assert all(tuple(row) in sent for row in q)


def long_motion(frames):
    one = make("ur5e", "hours", frames=2)
    positions = np.zeros((frames, 6))
    positions += 1e-3 * np.sin(np.arange(frames) / 1000)[:, None]
    return replace(
        one, positions=positions, gripper=np.arange(frames) % 1000 > 500,
        channels=Channels(positions / 2, positions * 3),
    )  # fmt: skip


@pytest.mark.parametrize("same_machine", [True, False])
def test_hours_of_motion_can_be_loaded(graph, lab, monkeypatch, same_machine):
    if not same_machine:
        monkeypatch.setattr(catalogue.npz_file, "read", elsewhere)
    trajectory = long_motion(1_000_000)
    lab.kept.save(trajectory)
    robot = spawn(graph)
    answer = graph.call(srv.LoadTrajectory, f"/{robot}/load", timeout=LONG, id="hours")
    assert answer.success, answer.message
    assert answer.code == "loaded"
    assert value_of(answer, "frames") == "1000000"
    np.testing.assert_array_equal(loaded(lab, robot).positions, trajectory.positions)
    np.testing.assert_array_equal(loaded(lab, robot).gripper, trajectory.gripper)
    velocities = loaded(lab, robot).channels.velocities
    np.testing.assert_array_equal(velocities, trajectory.channels.velocities)


def test_robots_share_the_matrices_of_one_trajectory(graph, lab):
    lab.kept.save(make("ur5e", "wave"))
    robots = [spawn(graph), spawn(graph)]
    for robot in robots:
        load(graph, robot, "wave")
    one, other = (loaded(lab, robot) for robot in robots)
    assert one is other
    lab.kept.save(replace(make("ur5e", "wave", frames=90), created_ns=1))
    load(graph, robots[0], "wave")
    assert loaded(lab, robots[0]).frame_count == 90
    assert loaded(lab, robots[1]).frame_count == 60


def hold_reads(monkeypatch):
    """Stop every read of a trajectory file; return the events that one began and may go on."""
    entered, go_on, read = threading.Event(), threading.Event(), npz_file.read

    def held(path):
        entered.set()
        assert go_on.wait(LONG)
        return read(path)

    monkeypatch.setattr(catalogue.npz_file, "read", held)
    return entered, go_on


@pytest.mark.parametrize(
    ("command", "label", "itself"),
    [("pause", "PAUSED", True), ("stop", "READY", True), ("pause", "PAUSED", False)],
)
def test_a_robot_pauses_and_stops_while_one_loads(graph, lab, monkeypatch, command, label, itself):
    lab.kept.save(make("ur5e", "wave", frames=3000))
    lab.kept.save(make("ur5e", "other"))
    robot = spawn(graph)
    loads = robot if itself else spawn(graph)
    states = listen_state(graph, robot)
    load(graph, robot, "wave")
    assert graph.call(Trigger, f"/{robot}/play").success
    wait_for(lambda: states.last().label == "PLAYING", "the motion")
    entered, go_on = hold_reads(monkeypatch)
    client = graph.client.create_client(srv.LoadTrajectory, f"/{loads}/load")
    assert client.wait_for_service(LONG)
    answer = client.call_async(srv.LoadTrajectory.Request(id="other"))
    assert entered.wait(LONG)
    assert graph.call(Trigger, f"/{robot}/{command}").success
    wait_for(lambda: states.last().label == label, "the end of the motion")
    if not itself:
        assert graph.call(Trigger, f"/{loads}/play").message.startswith("cannot play")
    assert not answer.done()
    assert loaded(lab, robot).id == "wave"
    go_on.set()
    wait_for(answer.done, "the load")
    assert answer.result().success, answer.result().message


def test_a_collision_halts_a_robot_while_it_loads_itself(graph, lab, monkeypatch):
    lab.kept.save(make("ur5e", "wave", frames=3000))
    lab.kept.save(make("ur5e", "other"))
    robot = spawn(graph)
    states = listen_state(graph, robot)
    load(graph, robot, "wave")
    assert graph.call(Trigger, f"/{robot}/play").success
    wait_for(lambda: states.last().label == "PLAYING", "the motion")
    entered, go_on = hold_reads(monkeypatch)
    collision = graph.client.create_publisher(msg.Collision, f"/{robot}/collision", qos.LATCHED)
    client = graph.client.create_client(srv.LoadTrajectory, f"/{robot}/load")
    assert client.wait_for_service(LONG)
    answer = client.call_async(srv.LoadTrajectory.Request(id="other"))
    assert entered.wait(LONG)
    contact = msg.Contact(link="forearm_link", other="cube_1")
    collision.publish(msg.Collision(colliding=True, contact=contact))
    wait_for(lambda: states.last().label == "COLLISION_HALT", "the halt")
    assert not answer.done()
    go_on.set()
    wait_for(answer.done, "the answer")


def test_a_robot_that_is_removed_while_it_loads_hurts_nobody(graph, lab, monkeypatch):
    lab.kept.save(make("ur5e", "wave"))
    robot, stays = spawn(graph), spawn(graph)
    entered, go_on = hold_reads(monkeypatch)
    client = graph.client.create_client(srv.LoadTrajectory, f"/{robot}/load")
    assert client.wait_for_service(LONG)
    answer = client.call_async(srv.LoadTrajectory.Request(id="wave"))
    assert entered.wait(LONG)
    assert graph.call(srv.Remove, "/lab/remove_robot", name=robot).success
    wait_for(lambda: robot not in lab.host.nodes, "the removal")
    wait_for(answer.done, "the answer of the robot that is gone")
    assert answer.result().code == "service_ended"
    comes = spawn(graph)
    wait_for(lambda: comes in lab.host.nodes, "a robot that comes meanwhile")
    go_on.set()
    load(graph, stays, "wave")


def test_a_load_that_takes_long_does_not_delay_that_of_another_robot(graph, lab, monkeypatch):
    lab.kept.save(make("ur5e", "wave"))
    lab.kept.save(make("ur5e", "slow"))
    first, second = spawn(graph), spawn(graph)
    entered, go_on, read = threading.Event(), threading.Event(), npz_file.read

    def held(path):
        if path.parent.name == "slow":
            entered.set()
            assert go_on.wait(LONG)
        return read(path)

    monkeypatch.setattr(catalogue.npz_file, "read", held)
    client = graph.client.create_client(srv.LoadTrajectory, f"/{first}/load")
    assert client.wait_for_service(LONG)
    answer = client.call_async(srv.LoadTrajectory.Request(id="slow"))
    assert entered.wait(LONG)
    load(graph, second, "wave")
    assert not answer.done()
    go_on.set()
    wait_for(answer.done, "the slow load")
    assert answer.result().success


def test_a_damaged_file_is_named_and_what_is_loaded_stays(graph, lab):
    lab.kept.save(make("ur5e", "wave"))
    path = lab.kept.save(make("ur5e", "broken"))
    content = bytearray(path.read_bytes())
    content[3000] ^= 1
    path.write_bytes(content)
    robot = spawn(graph)
    load(graph, robot, "wave")
    answer = graph.call(srv.LoadTrajectory, f"/{robot}/load", id="broken")
    assert not answer.success
    assert answer.code == "damaged_version"
    assert {v.key: v.value for v in answer.values}["id"] == "broken"
    assert loaded(lab, robot).id == "wave"
    assert lab.kept.ids() == ["wave"]
