"""The playback host and its nodes, in a real graph with a lab and a catalogue."""

from __future__ import annotations

import threading
import time
from types import SimpleNamespace

import numpy as np
import pytest
import small_lab
from geometry_msgs.msg import Point, Pose
from graph import Graph, wait_for
from mrlab_msgs import msg, srv
from mrlab_msgs.srv import SetLoop, Trigger
from rclpy.serialization import deserialize_message
from sensor_msgs.msg import JointState
from small_lab import LIBRARY, TRAJECTORIES, labels, listen_state, load, spawn

from mrlab_ros.adapters.robots.diagnostics import NO_END_EFFECTOR, NO_ROBOT_MODEL
from mrlab_ros.core.base.diagnostics import BAD_NAME, ILLEGAL_EVENT, RESERVED_NAME
from mrlab_ros.core.base.errors import LabError
from mrlab_ros.core.runtime.freezes import Freezes
from mrlab_ros.core.scene.diagnostics import NO_LEVEL_SURFACE
from mrlab_ros.messages import qos
from mrlab_ros.messages.joint_states import JointStateEncoder
from mrlab_ros.messages.time import make_header, time_from_message
from mrlab_ros.nodes.lab.node import LabNode
from mrlab_ros.nodes.playback import node
from mrlab_ros.nodes.playback.host import PlaybackHostNode
from mrlab_ros.ros import clock


@pytest.fixture
def lab(graph: Graph):
    return small_lab.start(graph)


def test_streams_exactly_the_frames_of_the_trajectory(graph, lab):
    robot = spawn(graph)
    states = listen_state(graph, robot)
    joints = graph.listen(JointState, f"/{robot}/joint_states", qos.STREAM)
    load(graph, robot, "wave")
    assert graph.call(Trigger, f"/{robot}/play").success
    wait_for(lambda: "COMPLETE" in labels(states), "the end")
    trajectory = TRAJECTORIES["wave"]
    wait_for(
        lambda: joints and np.array_equal(joints[-1].position, trajectory.positions[-1]), "frames"
    )
    start = time_from_message(
        next(s for s in states if s.label == "PLAYING" and s.clock.rate == 1.0).clock.stamp
    )
    played = [j for j in joints if time_from_message(j.header.stamp) >= start][:60]
    assert np.array_equal([j.position for j in played], trajectory.positions)
    assert np.array_equal([j.velocity for j in played], trajectory.channels.velocities)
    assert tuple(played[0].name) == trajectory.joint_names
    assert list(played[0].effort) == []
    stamps = [time_from_message(j.header.stamp) - start for j in played]
    assert stamps == [i * 10_000_000 for i in range(60)]
    wait_for(
        lambda: labels(states)[-5:] == ["READY", "ADJUSTING", "PLAYING", "COMPLETE", "READY"],
        "the states in order",
    )


def test_the_encoder_writes_what_rclpy_would(graph):
    encoder = JointStateEncoder("ur5e_1", ("a", "bb", "ccc"))
    q, dq = np.array([0.1, -2.0, 3.5]), np.array([1.0, 0.0, -1e-9])
    message = JointState(
        header=make_header(1_700_000_000_123_456_789, "ur5e_1"),
        name=["a", "bb", "ccc"],
        position=q,
        velocity=dq,
    )
    written = encoder.encode(1_700_000_000_123_456_789, q, dq)
    publisher = graph.client.create_publisher(JointState, "/encoded", qos.LATCHED)
    publisher.publish(message)
    sent: list[bytes] = []
    graph.client.create_subscription(JointState, "/encoded", sent.append, qos.LATCHED, raw=True)
    wait_for(lambda: sent, "the message as it is sent")
    # What stands in the gaps before doubles is anything.
    assert len(written) == len(sent[0])
    assert deserialize_message(written, JointState) == message


def test_pause_seek_rate_loop_and_stop_answer_and_take_effect(graph, lab):
    robot = spawn(graph)
    states = listen_state(graph, robot)
    load(graph, robot, "long")
    assert graph.call(Trigger, f"/{robot}/play").success
    wait_for(lambda: states.last().label == "PLAYING" and states.last().frame > 5, "frames")
    assert graph.call(Trigger, f"/{robot}/pause").success
    wait_for(lambda: states.last().label == "PAUSED", "the pause")
    assert states.last().clock.rate == 0.0
    answer = graph.call(srv.Seek, f"/{robot}/seek", position=5.0)
    assert answer.success
    wait_for(lambda: states.last().frame == 500, "the place")
    assert graph.call(srv.SetRate, f"/{robot}/set_rate", rate=4.0).success
    assert graph.call(SetLoop, f"/{robot}/set_loop", loop=True).success
    wait_for(lambda: states.last().loop and states.last().rate == 4.0, "rate and loop")
    assert graph.call(Trigger, f"/{robot}/stop").success
    wait_for(lambda: states.last().label == "READY", "the stop")


def test_a_command_in_the_wrong_state_is_refused_with_what_is_possible(graph, lab):
    robot = spawn(graph)
    answer = graph.call(Trigger, f"/{robot}/play")
    assert (answer.success, answer.code) == (False, ILLEGAL_EVENT.code)
    answer = graph.call(srv.LoadTrajectory, f"/{robot}/load", id="nothing")
    assert not answer.success
    assert answer.code == "no_trajectory_of_name"
    answer = graph.call(srv.LoadTrajectory, f"/{robot}/load", id="kuka")
    assert not answer.success
    assert answer.code == "of_another_model"


@pytest.fixture
def thawed(monkeypatch):
    """Make this process one that was frozen until now, and all requests as old as `age` s."""

    def thaw(age: float, frozen: float = 30.0) -> None:
        now = time.monotonic()
        noted = Freezes("playback", lambda: 0.0)
        noted.begin()
        noted.look(now - frozen)
        noted.look(now)
        stamp = SimpleNamespace(
            monotonic=time.monotonic, time_ns=lambda: time.time_ns() + int(age * 1e9)
        )
        monkeypatch.setattr(clock, "PROCESS", noted)
        monkeypatch.setattr(clock, "time", stamp)

    return thaw


def test_what_waited_in_a_freeze_moves_no_robot_when_it_ends(graph, lab, thawed):
    robot = spawn(graph)
    load(graph, robot, "long")
    for age, carried_out in ((25.0, False), (0.0, True)):
        thawed(age)
        # A load is a deferred service.
        again = graph.call(srv.LoadTrajectory, f"/{robot}/load", id="long")
        played = graph.call(Trigger, f"/{robot}/play")
        assert (again.success, played.success) == (carried_out, carried_out)
        assert (played.code == "waited_in_freeze") is not carried_out
        orders = {"system": "", "orders": [msg.DriveOrder(robot=robot, command=4)]}
        host = "/playback_host/command_members"
        late = graph.call(srv.CommandMembers, host, **orders)
        assert late.code != "waited_in_freeze", "a pause is carried out however late"
        assert graph.call(Trigger, f"/{robot}/stop").success


def test_a_trajectory_for_another_end_effector_is_refused_until_it_is_fitted(graph, lab):
    robot = spawn(graph)
    answer = graph.call(srv.LoadTrajectory, f"/{robot}/load", id="tool")
    assert not answer.success
    assert answer.code == "of_another_end_effector"
    answer = graph.call(
        srv.SetEndEffector,
        "/lab/set_end_effector",
        robot=robot,
        end_effector="parallel_gripper",
    )
    assert answer.success, answer.message
    wait_for(
        lambda: graph.call(srv.LoadTrajectory, f"/{robot}/load", id="tool").success, "the load"
    )


def test_grasp_targets_are_announced_with_the_trajectory(graph, lab):
    robot = spawn(graph)
    targets = graph.listen(msg.GraspTargets, f"/{robot}/targets", qos.LATCHED)
    load(graph, robot, "pick")
    wait_for(lambda: targets and targets[-1].targets, "targets")
    (target,) = targets[-1].targets
    assert (target.frame, target.close, target.time) == (30, True, 0.3)
    tool0 = LIBRARY.model("ur5e").chain.tool0(TRAJECTORIES["pick"].positions[30])
    p = target.tool0.position
    assert np.allclose([p.x, p.y, p.z], tool0[:3, 3])


def test_telemetry_reports_the_motion(graph, lab):
    robot = spawn(graph)
    telemetry = graph.listen(msg.Telemetry, f"/{robot}/telemetry", qos.STREAM)
    load(graph, robot, "long")
    assert graph.call(Trigger, f"/{robot}/play").success
    wait_for(lambda: telemetry and telemetry[-1].frames_sent > 20, "telemetry")
    last = telemetry[-1]
    assert last.frames_lost == 0
    assert 0 < last.deadline_error <= last.deadline_error_max
    assert list(last.effort_proxy) == [1.0] * 6
    # What the grasp bears, for as long as there is somebody who says so.
    assert (last.held_object, last.held_mass) == ("", 0.0)
    physics = graph.client.create_publisher(msg.Grasp, f"/{robot}/grasp", qos.LATCHED)
    grasp = msg.Grasp(
        state=msg.Grasp.HOLDING,
        object="cube_1",
        mass=0.2,
        payload=3.95,
        slip_margin=1.5,
        wrist_moment=0.3,
    )
    physics.publish(grasp)
    wait_for(lambda: telemetry[-1].held_object == "cube_1", "what is held")
    last = telemetry[-1]
    found = (last.held_mass, last.payload, last.slip_margin, last.wrist_moment)
    assert found == (0.2, 3.95, 1.5, 0.3)
    graph.client.destroy_publisher(physics)
    wait_for(lambda: telemetry[-1].held_object == "", "nothing of a physics that is gone")


def test_a_collision_halts_and_its_end_pauses(graph, lab):
    robot = spawn(graph)
    states = listen_state(graph, robot)
    load(graph, robot, "long")
    graph.call(Trigger, f"/{robot}/play")
    wait_for(lambda: states.last().label == "PLAYING" and states.last().frame > 5, "frames")
    collision = graph.client.create_publisher(msg.Collision, f"/{robot}/collision", qos.LATCHED)
    contact = msg.Contact(link="tool0", held="bar_1", other="cube_1")
    collision.publish(msg.Collision(colliding=True, contact=contact))
    wait_for(lambda: states.last().label == "COLLISION_HALT", "the halt")
    assert states.last().code == "halted_by_contact"
    values = {each.key: each.value for each in states.last().values}
    assert values == {"held": "bar_1", "other": "cube_1"}
    answer = graph.call(Trigger, f"/{robot}/clear_halt")
    assert not answer.success
    assert answer.code == "still_touches"
    collision.publish(msg.Collision(colliding=False))
    wait_for(lambda: states.last().label == "PAUSED", "the pause")


def test_playback_nodes_come_and_go_with_their_robots(graph, lab):
    robot = spawn(graph)
    wait_for(lambda: robot in lab.host.nodes, "the playback node")
    assert graph.call(srv.Remove, "/lab/remove_robot", name=robot).success
    wait_for(lambda: robot not in lab.host.nodes, "its end")
    assert spawn(graph) == robot
    load(graph, robot, "wave")


def test_a_new_playback_host_finds_the_robots_and_starts_idle(graph, lab):
    robot = spawn(graph)
    load(graph, robot, "wave")
    graph.drop(lab.host)
    graph.add(PlaybackHostNode)
    states = graph.listen(msg.PlaybackState, f"/{robot}/playback_state", qos.LATCHED)
    wait_for(lambda: states and states[-1].label == "IDLE", "a fresh playback")


def test_a_playback_that_fails_while_it_is_made_leaves_nothing_in_the_graph(
    graph, lab, monkeypatch
):
    failed = []

    def fail(*_: object) -> None:
        failed.append(graph.client.count_services("/ur5e_1/load"))
        raise LabError("no commander today")

    monkeypatch.setattr(node, "Commanders", fail)
    robot = spawn(graph)
    wait_for(lambda: failed, "the failure")
    assert failed == [1]
    wait_for(lambda: f"load {robot}" not in {t.name for t in threading.enumerate()}, "its end")
    wait_for(lambda: not graph.client.count_services(f"/{robot}/load"), "its services gone")
    wait_for(lambda: not graph.client.count_publishers(f"/{robot}/telemetry"), "its topics gone")
    assert not lab.host.nodes


@pytest.mark.parametrize(
    ("request_fields", "code"),
    [
        ({"model": "r2d2"}, NO_ROBOT_MODEL),
        ({"model": "ur5e", "name": "UR 5"}, BAD_NAME),
        ({"model": "ur5e", "name": "lab"}, RESERVED_NAME),
        ({"model": "ur5e", "end_effector": "chainsaw"}, NO_END_EFFECTOR),
        ({"model": "ur5e", "surface": "table_1"}, NO_LEVEL_SURFACE),
    ],
)
def test_a_robot_that_cannot_be_is_refused(graph, lab, request_fields, code):
    answer = graph.call(srv.SpawnRobot, "/lab/spawn_robot", automatic=True, **request_fields)
    assert (answer.success, answer.code) == (False, code.code)
    assert not lab.host.nodes


def test_a_robot_stands_on_a_table_before_who_asked_for_it(graph, lab):
    corners = [Point(x=x, y=y) for x, y in ((-0.5, -0.4), (0.5, -0.4), (0.5, 0.4), (-0.5, 0.4))]
    table = msg.Surface(name="table_1", label="table", vertices=corners)
    table.pose.position.x, table.pose.position.z = 1.1, 0.72
    publisher = graph.client.create_publisher(msg.Surfaces, "/surfaces", qos.LATCHED)
    publisher.publish(msg.Surfaces(surfaces=[table]))
    request = {
        "model": "ur5e",
        "automatic": True,
        "surface": "table_1",
        "has_viewer": True,
        "viewer": Pose(position=Point(z=1.6)),
    }

    def placed():
        answer = graph.call(srv.SpawnRobot, "/lab/spawn_robot", **request)
        return answer.robot if answer.success else None

    robot = wait_for(placed, "a robot on the table")
    assert robot.pose.position.z == pytest.approx(0.72)
    # it faces the viewer, who stands at the origin
    assert abs(robot.pose.orientation.z) > 0.95


def test_robots_are_placed_apart_and_a_restarted_lab_has_them_back(graph, tmp_path):
    first = graph.add(LabNode, state_dir=str(tmp_path))
    a, b = spawn(graph), spawn(graph, "kuka_kr6_r900_sixx")
    robots = graph.listen(msg.Robots, "/robots", qos.LATCHED)
    wait_for(lambda: robots and len(robots[-1].robots) == 2, "two robots")
    before, seen = robots[-1].robots, robots[-1].header
    p, q = (r.pose.position for r in before)
    assert np.hypot(p.x - q.x, p.y - q.y) > 0.9
    graph.drop(first)
    graph.add(LabNode, state_dir=str(tmp_path))
    wait_for(lambda: robots[-1].header != seen, "the new lab's robots")
    assert [r.name for r in robots[-1].robots] == [a, b]
    assert robots[-1].robots == before


def test_a_playback_has_no_service_whose_memory_rcl_never_frees(graph, lab):
    robot = spawn(graph)
    wait_for(lambda: graph.client.count_services(f"/{robot}/play"), "the playback")
    names = [name for name, _ in graph.client.get_service_names_and_types()]
    assert not [n for n in names if n.startswith(f"/{robot}/") and "type_description" in n]
