"""A playback host and a coordinator that come back: what they had stands PAUSED in place."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import small_lab
from builtin_interfaces.msg import Duration
from graph import Graph, wait_for
from mrlab_msgs import msg, srv
from mrlab_msgs.srv import SetLoop, Trigger
from sensor_msgs.msg import JointState
from small_lab import (
    Catalogue,
    labels,
    listen_state,
    listen_systems,
    load,
    make_system,
    spawn,
    state_of,
)
from trajectory_msgs.msg import JointTrajectory, JointTrajectoryPoint

from mrlab_ros.adapters.scenes.files import SCENE_FILE
from mrlab_ros.messages import qos
from mrlab_ros.nodes.coordinator.node import CoordinatorNode
from mrlab_ros.nodes.lab.node import LabNode
from mrlab_ros.nodes.playback.host import PlaybackHostNode


@pytest.fixture
def folder(tmp_path):
    return str(tmp_path)


@pytest.fixture
def lab(graph: Graph, folder):
    graph.add(Catalogue)
    return small_lab.SimpleNamespace(
        lab=graph.add(LabNode),
        host=graph.add(PlaybackHostNode, state_dir=folder),
        coordinator=graph.add(CoordinatorNode, state_dir=folder),
    )


def restart(graph: Graph, lab, name: str, kind, folder: str) -> None:
    graph.drop(getattr(lab, name))
    setattr(lab, name, graph.add(kind, state_dir=folder))


def play(graph: Graph, robot: str, states) -> None:
    assert graph.call(Trigger, f"/{robot}/play").success
    wait_for(lambda: states.last().label == "PLAYING" and states.last().frame > 5, "frames")


def test_a_restarted_host_stands_paused_in_place_and_plays_on(graph, lab, folder):
    robot = spawn(graph)
    states = listen_state(graph, robot)
    load(graph, robot, "long")
    assert graph.call(srv.SetRate, f"/{robot}/set_rate", rate=0.5).success
    assert graph.call(SetLoop, f"/{robot}/set_loop", loop=True).success
    play(graph, robot, states)
    joints = graph.listen(JointState, f"/{robot}/joint_states", qos.STREAM)
    wait_for(lambda: len(joints) > 5, "joint states")
    graph.drop(lab.host)
    count, last = len(joints), joints[-1]
    states.clear()
    lab.host = graph.add(PlaybackHostNode, state_dir=folder)
    wait_for(lambda: states.last() and states.last().label == "PAUSED", "the return")
    back = states.last()
    assert (back.trajectory_id, back.rate, back.loop) == ("long", 0.5, True)
    assert back.code == "playback_restarted"
    wait_for(lambda: len(joints) > count, "the standing pose")
    # Not even for a moment did it stand at home.
    for message in joints[count:]:
        assert np.allclose(message.position, last.position, atol=0.01)
    before = back.frame
    assert graph.call(Trigger, f"/{robot}/play").success
    wait_for(lambda: states.last().label == "PLAYING", "playing on")
    assert "ADJUSTING" not in labels(states)
    assert states.last().frame >= before


def test_a_restarted_host_keeps_a_collision_halt_until_the_arm_is_clear(graph, lab, folder):
    robot = spawn(graph)
    states = listen_state(graph, robot)
    load(graph, robot, "long")
    play(graph, robot, states)
    collision = graph.client.create_publisher(msg.Collision, f"/{robot}/collision", qos.LATCHED)
    collision.publish(msg.Collision(colliding=True))
    wait_for(lambda: states.last().label == "COLLISION_HALT", "the halt")
    restart(graph, lab, "host", PlaybackHostNode, folder)
    wait_for(lambda: labels(states)[-2:] == ["IDLE", "COLLISION_HALT"], "the halt again")
    assert not graph.call(Trigger, f"/{robot}/play").success
    collision.publish(msg.Collision(colliding=False))
    wait_for(lambda: states.last().label == "PAUSED", "the pause")


def test_a_system_that_was_dissolved_does_not_come_back_with_the_lab(graph, folder, monkeypatch):
    # It is written before the next time that all is.
    monkeypatch.setattr("mrlab_ros.nodes.lab.node.SAVE_PERIOD_S", 600.0)
    small_lab.start(graph, state_dir=folder)
    robot = spawn(graph)
    load(graph, robot, "wave")
    file = Path(folder) / SCENE_FILE
    assert make_system(graph, {robot: "wave"}).success
    wait_for(lambda: "cell" in file.read_text(), "the system in the file")
    assert graph.call(srv.Remove, "/coordinator/dissolve_system", name="cell").success
    wait_for(lambda: "cell" not in file.read_text(), "the file without the system")


def test_a_scene_file_from_before_brings_no_dissolved_system_back(graph, folder):
    """A kill just after the answer leaves the scene's file as it was."""
    lab = small_lab.start(graph, state_dir=folder)
    robot = spawn(graph)
    load(graph, robot, "wave")
    file = Path(folder) / SCENE_FILE
    assert make_system(graph, {robot: "wave"}).success
    wait_for(lambda: "cell" in file.read_text(), "the system in the file")
    before = file.read_bytes()
    assert graph.call(srv.Remove, "/coordinator/dissolve_system", name="cell").success
    for node in (lab.lab, lab.coordinator):
        graph.drop(node)
    file.write_bytes(before)
    assert graph.add(LabNode, state_dir=folder)._return.pending.systems == ()


def test_a_robot_that_had_not_begun_is_ready_again(graph, lab, folder):
    robot = spawn(graph)
    states = listen_state(graph, robot)
    load(graph, robot, "wave")
    restart(graph, lab, "host", PlaybackHostNode, folder)
    wait_for(lambda: labels(states)[-2:] == ["IDLE", "READY"], "the return")
    assert states.last().trajectory_id == "wave"


def test_a_robot_whose_trajectory_is_gone_stands_idle(graph, lab, folder, monkeypatch):
    robot = spawn(graph)
    states = listen_state(graph, robot)
    load(graph, robot, "wave")
    graph.drop(lab.host)
    monkeypatch.setattr(small_lab, "UNREADABLE", {"wave"})
    graph.add(PlaybackHostNode, state_dir=folder)
    wait_for(lambda: states.last().label == "IDLE", "the end")
    load(graph, robot, "long")


def test_a_robot_that_followed_a_goal_stands_where_it_was(graph, lab, folder):
    robot = spawn(graph)
    states = listen_state(graph, robot)
    joints = graph.listen(JointState, f"/{robot}/joint_states", qos.STREAM)
    model = small_lab.LIBRARY.model("ur5e")
    publisher = graph.client.create_publisher(
        JointTrajectory, f"/{robot}/joint_trajectory", qos.EVENTS
    )
    wait_for(publisher.get_subscription_count, "the playback")
    there = (model.home + 0.1).tolist()
    point = JointTrajectoryPoint(positions=there, time_from_start=Duration(nanosec=10**9 // 2))
    publisher.publish(JointTrajectory(joint_names=list(model.joint_names), points=[point]))
    wait_for(lambda: "COMPLETE" in labels(states), "the end of the goal")
    graph.drop(lab.host)
    joints.clear()
    lab.host = graph.add(PlaybackHostNode, state_dir=folder)
    (lost,) = wait_for(lambda: lab.host.lost, "a word on the goal")
    assert (lost.code, lost.robot) == ("goal_lost", robot)
    wait_for(lambda: joints, "joint states")
    assert all(list(state.position) == pytest.approx(there) for state in list(joints))
    assert states.last().label == "IDLE"


def test_a_restarted_coordinator_has_its_systems_again(graph, lab, folder):
    a, b = spawn(graph), spawn(graph)
    states = {robot: listen_state(graph, robot) for robot in (a, b)}
    assert make_system(graph, {a: "long", b: "long"}).success
    assert graph.call(Trigger, "/cell/play").success
    wait_for(lambda: all(s.last().frame > 5 for s in states.values()), "frames")
    restart(graph, lab, "coordinator", CoordinatorNode, folder)
    systems = listen_systems(graph)
    wait_for(lambda: systems and state_of(systems).label == "PAUSED", "the system")
    wait_for(lambda: {s.last().label for s in states.values()} == {"PAUSED"}, "the pause")
    assert {s.last().system for s in states.values()} == {"cell"}
    assert state_of(systems).clock.position > 0.0
    assert graph.call(Trigger, "/cell/play").success
    wait_for(lambda: {s.last().label for s in states.values()} == {"PLAYING"}, "playing on")
    assert graph.call(srv.Remove, "/coordinator/dissolve_system", name="cell").success
    restart(graph, lab, "coordinator", CoordinatorNode, folder)
    systems = listen_systems(graph)
    wait_for(lambda: systems and not systems[-1].systems, "no system")


def test_robots_whose_coordinator_is_gone_stand_and_are_independent(graph, lab):
    a = spawn(graph)
    states = listen_state(graph, a)
    assert make_system(graph, {a: "long"}).success
    assert graph.call(Trigger, "/cell/play").success
    wait_for(lambda: states.last().frame > 5, "frames")
    graph.drop(lab.coordinator)
    wait_for(lambda: states.last().label == "PAUSED" and not states.last().system, "independence")
    assert graph.call(Trigger, f"/{a}/play").success


def test_systems_and_robots_come_back_when_both_processes_end(graph, lab, folder):
    a = spawn(graph)
    states = listen_state(graph, a)
    assert make_system(graph, {a: "long"}).success
    assert graph.call(Trigger, "/cell/play").success
    wait_for(lambda: states.last().frame > 5, "frames")
    graph.drop(lab.coordinator)
    graph.drop(lab.host)
    systems = listen_systems(graph)
    graph.add(CoordinatorNode, state_dir=folder)
    graph.add(PlaybackHostNode, state_dir=folder)
    wait_for(lambda: systems and systems[-1].systems, "the system")
    wait_for(lambda: states.last().label == "PAUSED" and states.last().system == "cell", "a claim")
    assert graph.call(Trigger, "/cell/play").success
    wait_for(lambda: state_of(systems).label == "PLAYING", "playing on")


def test_a_late_joiner_gets_the_newest_list_of_systems_alone(graph, lab):
    a = spawn(graph)
    assert make_system(graph, {a: "wave"}).success
    systems = listen_systems(graph)
    wait_for(lambda: systems, "the systems")
    assert state_of(systems[:1]).label == "READY"


def test_a_second_lab_on_the_domain_is_ignored_and_both_keep_their_robots(graph, tmp_path):
    graph.add(Catalogue)
    first = small_lab.SimpleNamespace(
        lab=graph.add(LabNode, lab_id="a1"),
        host=graph.add(PlaybackHostNode, lab_id="a1"),
        coordinator=graph.add(CoordinatorNode, lab_id="a1"),
    )
    robot = spawn(graph)
    wait_for(lambda: robot in first.host.nodes, "the playback")
    robots = graph.listen(msg.Robots, "/robots", qos.LATCHED_EVENTS)
    wait_for(lambda: robots, "the robots")
    second = graph.add(LabNode, lab_id="b2")
    wait_for(lambda: {m.lab for m in robots} == {"a1", "b2"}, "the other lab")
    wait_for(lambda: first.lab.lost, "a word on it")
    assert first.lab.lost[0].code == "other_lab"
    assert wait_for(lambda: second.lost, "a word there too")[0].code == "other_lab"
    load(graph, robot, "wave")
    assert list(first.host.nodes) == [robot]
    # The orders of a system have a name that no other lab's coordinator calls.
    second_host = graph.add(PlaybackHostNode, lab_id="b2")
    names = {name for name, _ in graph.client.get_service_names_and_types()}
    assert {name for name in names if name.endswith("command_members")} == {
        "/playback_host/lab_a1/command_members", "/playback_host/lab_b2/command_members",
    }  # fmt: skip
    assert make_system(graph, {robot: "wave"}).success
    assert first.host.nodes[robot].playback.system == "cell"
    assert not second_host.nodes
