"""The physics node in a real graph: a lab, a playback host, a catalogue, and things to hit."""

from __future__ import annotations

import itertools
import time
from types import SimpleNamespace

import numpy as np
import pytest
from geometry_msgs.msg import Point, Pose, Quaternion, Twist, Vector3
from graph import Graph, wait_for
from mrlab_msgs import msg, srv
from mrlab_msgs.srv import Trigger
from rclpy.node import Node
from sensor_msgs.msg import JointState

from mrlab_ros.adapters import share
from mrlab_ros.adapters.robots.library import RobotLibrary
from mrlab_ros.adapters.scenes.diagnostics import BAD_SCENE_NAME, NO_SCENE
from mrlab_ros.adapters.scenes.files import read
from mrlab_ros.core.base.diagnostics import NAME_TAKEN, NO_ROBOT_IN_SCENE, POSE_NOT_FINITE
from mrlab_ros.core.physics.diagnostics import (
    LET_GO,
    NO_OBJECT_IN_SCENE,
    NO_OBJECT_TYPE,
    OPENED_UNSEEN,
)
from mrlab_ros.core.scene.diagnostics import SURFACE_WITHOUT_NAME
from mrlab_ros.core.trajectory.trajectory import Channels, Source, Trajectory
from mrlab_ros.messages import qos, trajectories
from mrlab_ros.nodes.coordinator.node import CoordinatorNode
from mrlab_ros.nodes.lab.node import LabNode
from mrlab_ros.nodes.physics import node
from mrlab_ros.nodes.physics.node import PhysicsNode
from mrlab_ros.nodes.playback.host import PlaybackHostNode

LIBRARY = RobotLibrary(share.directory() / "robots")
MODEL = LIBRARY.model("ur5e")
RATE = 100.0


def make(name: str, waypoints: list[tuple[float, np.ndarray, bool]]) -> Trajectory:
    """Smooth motion through (time, joints, gripper closed from here on)."""
    times = [w[0] for w in waypoints]
    t = np.arange(round(times[-1] * RATE) + 1) / RATE
    i = np.clip(np.searchsorted(times, t, side="right") - 1, 0, len(times) - 2)
    start, end = np.array(times)[i], np.array(times)[i + 1]
    share_ = (t - start) / (end - start)
    smooth = share_ * share_ * (3 - 2 * share_)
    q = np.array([w[1] for w in waypoints])
    positions = q[i] + smooth[:, None] * (q[i + 1] - q[i])
    closed = np.array([w[2] for w in waypoints])[i]
    velocities = np.gradient(positions, 1 / RATE, axis=0)
    zeros = np.zeros_like(positions)
    return Trajectory(
        name, "ur5e", None, MODEL.joint_names, RATE, positions, closed if closed.any() else None,
        Channels(velocities, zeros), Source("q.mat", "q", "0" * 64),
    )  # fmt: skip


def turned(pan: float, lift: float = 0.0) -> np.ndarray:
    return MODEL.home + np.array([pan, lift, 0, 0, 0, 0])


TRAJECTORIES = {
    "sweep": make("sweep", [(0, turned(0), False), (2, turned(1.2), False)]),
    "still": make("still", [(0, turned(0), False), (1, turned(0), False)]),
    "pick": make(
        "pick",
        [
            (0.0, turned(0), False),
            (0.3, turned(0), True),
            (2.0, turned(0), True),
            (3.5, turned(0.6), True),
            (3.8, turned(0.6), False),
            (4.8, turned(0.6), False),
        ],
    ),
}


class Catalogue(Node):
    """Answers /converter/get_any from TRAJECTORIES."""

    def __init__(self, **kwargs) -> None:
        super().__init__("converter", **kwargs)
        self.create_service(srv.GetTrajectory, "~/get_any", self._get)

    def _get(self, request, response):
        response.success = True
        trajectory = TRAJECTORIES[request.id]
        response.trajectory = trajectories.trajectory_to_message(trajectory)
        return response


@pytest.fixture
def lab(graph: Graph, tmp_path):
    graph.add(Catalogue)
    return SimpleNamespace(
        lab=graph.add(LabNode),
        host=graph.add(PlaybackHostNode),
        coordinator=graph.add(CoordinatorNode),
        physics=graph.add(PhysicsNode, state_dir=str(tmp_path)),
    )


def spawn(graph: Graph, end_effector: str = "", **fields) -> str:
    answer = graph.call(
        srv.SpawnRobot, "/lab/spawn_robot", model="ur5e", end_effector=end_effector, **fields
    )
    assert answer.success, answer.message
    return answer.robot.name


def load(graph: Graph, robot: str, trajectory: str) -> None:
    answer = graph.call(srv.LoadTrajectory, f"/{robot}/load", id=trajectory)
    assert answer.success, answer.message


def pose(position, turn=(0.0, 0.0, 0.0, 1.0)) -> Pose:
    x, y, z = (float(v) for v in position)
    a, b, c, d = turn
    return Pose(position=Point(x=x, y=y, z=z), orientation=Quaternion(x=a, y=b, z=c, w=d))


def place(graph: Graph, kind: str, position, *, held: bool = False) -> str:
    """Put an object somewhere; `held` keeps it in the air."""
    answer = graph.call(srv.SpawnObject, "/physics/spawn_object", type=kind, pose=pose(position))
    assert answer.success, answer.message
    if held:
        move(graph, answer.object.name, position, held=True)
    return answer.object.name


def move(graph: Graph, name: str, position, *, held: bool, velocity=(0.0, 0.0, 0.0)) -> None:
    x, y, z = velocity
    answer = graph.call(
        srv.MoveObject, "/physics/move_object", name=name, pose=pose(position), held=held,
        twist=Twist(linear=Vector3(x=x, y=y, z=z)),
    )  # fmt: skip
    assert answer.success, answer.message


def tool(pan: float, below: float = 0.0) -> np.ndarray:
    """Return the place of tool0, `below` m further along its z."""
    pose = MODEL.chain.tool0(turned(pan))
    return pose[:3, 3] + below * pose[:3, 2]


def test_a_box_in_the_way_halts_the_arm_and_moving_it_away_lets_it_play_on(graph, lab):
    robot = spawn(graph)
    states = graph.listen(msg.PlaybackState, f"/{robot}/playback_state", qos.EVENTS)
    collisions = graph.listen(msg.Collision, f"/{robot}/collision", qos.EVENTS)
    contacts = graph.listen(msg.Contacts, "/contacts", qos.EVENTS)
    joints = graph.listen(JointState, f"/{robot}/joint_states", qos.STREAM)
    box = place(graph, "cube_large", tool(0.7), held=True)
    load(graph, robot, "sweep")
    assert graph.call(Trigger, f"/{robot}/play").success
    wait_for(lambda: states.last() and states.last().label == "COLLISION_HALT", "the halt")
    halted = states.last()
    first = wait_for(lambda: next((c for c in collisions if c.colliding), None), "a collision")
    assert first.contact.other == box
    assert first.contact.kind == msg.Contact.OBJECT
    assert first.contact.depth >= 0
    assert halted.message == f"{first.contact.link} touches {box}"
    # How many frames later is a matter of timing: bench/run.py physics.
    assert first.contact.frame <= halted.frame < halted.frame_count - 1
    point = first.contact.point
    assert np.allclose([point.x, point.y, point.z], tool(0.7), atol=0.12)
    wait_for(lambda: contacts, "contacts")
    sent = len(joints)
    wait_for(lambda: len(joints) > sent, "a standing joint state")
    trajectory = TRAJECTORIES["sweep"]
    assert np.array_equal(joints[-1].position, trajectory.positions[halted.frame])
    assert not graph.call(Trigger, f"/{robot}/clear_halt").success

    move(graph, box, (-2, 0, 1), held=False)
    wait_for(lambda: states.last().label == "PAUSED", "the pause")
    assert [c.colliding for c in collisions if c.contact.link or not c.colliding][-1] is False
    assert graph.call(Trigger, f"/{robot}/play").success
    wait_for(lambda: any(s.label == "COMPLETE" for s in states), "the end")
    wait_for(lambda: np.array_equal(joints[-1].position, trajectory.positions[-1]), "its frame")
    start = next(s for s in states if s.label == "PLAYING" and s.clock.position > 0)
    assert start.clock.position == pytest.approx(halted.frame / RATE)


def grasped(graph: Graph, robot: str):
    return graph.listen(msg.Grasp, f"/{robot}/grasp", qos.LATCHED)


def where(objects, name: str) -> np.ndarray:
    p = next(o for o in objects.last().objects if o.name == name).pose.position
    return np.array([p.x, p.y, p.z])


def test_a_gripper_picks_carries_and_releases_and_the_timeline_can_be_scrubbed(graph, lab):
    robot = spawn(graph, "parallel_gripper")
    grasp = grasped(graph, robot)
    objects = graph.listen(msg.SceneObjects, "/objects", qos.LATCHED)
    states = graph.listen(msg.PlaybackState, f"/{robot}/playback_state", qos.EVENTS)
    wait_for(lambda: grasp.last() and len(grasp.last().fingers) == 2, "the gripper")
    fingers = graph.listen(JointState, f"/{robot}/finger_states", qos.LATCHED)
    wait_for(lambda: fingers, "the fingers")
    assert list(fingers.last().name) == list(grasp.last().fingers)
    opened = fingers.last().position[0]
    # 12 mm of adapter plate, then 154 mm to the tool centre point. A cube on a pedestal.
    center = tool(0, 0.012 + 0.150)
    pedestal = place(graph, "pedestal", center - [0, 0, 0.2251])
    assert pedestal == "pedestal_1"
    cube = place(graph, "cube", center)
    load(graph, robot, "pick")
    assert graph.call(Trigger, f"/{robot}/play").success
    wait_for(lambda: grasp.last().state == msg.Grasp.HOLDING, "the grasp")
    assert grasp.last().object == cube
    wait_for(lambda: fingers.last().position[0] > opened + 0.005, "fingers that closed")
    start = where(objects, cube)
    wait_for(lambda: states.last().label == "PLAYING" and states.last().frame > 350, "the way")
    wait_for(lambda: grasp.last().state == msg.Grasp.OPEN, "the release")
    moved = where(objects, cube)
    reach = np.hypot(*center[:2])
    assert np.hypot(*(moved - start)[:2]) == pytest.approx(2 * reach * np.sin(0.3), abs=0.03)
    wait_for(lambda: states.last().label == "READY", "the end")
    wait_for(lambda: where(objects, cube)[2] < 0.1, "the fall")

    assert graph.call(srv.Seek, f"/{robot}/seek", position=3.0).success
    wait_for(lambda: grasp.last().state == msg.Grasp.HOLDING, "the cube back in the hand")
    assert graph.call(srv.Seek, f"/{robot}/seek", position=0.2).success
    wait_for(lambda: np.abs(where(objects, cube) - start).max() < 0.003, "it back on the table")
    assert grasp.last().state == msg.Grasp.OPEN


def test_objects_come_and_go_by_service_and_bad_requests_are_refused_in_words(graph, lab):
    objects = graph.listen(msg.SceneObjects, "/objects", qos.LATCHED)
    surfaces = graph.listen(msg.Surfaces, "/surfaces", qos.LATCHED)
    wait_for(lambda: surfaces and surfaces[-1].surfaces[0].label == "floor", "the floor")
    spawn_object = "/physics/spawn_object"
    answer = graph.call(
        srv.SpawnObject, spawn_object, type="cube", automatic=True, pose=pose((1, 1, 0))
    )
    assert answer.success
    assert answer.object.mass == pytest.approx(0.1)
    wait_for(lambda: objects and [o.name for o in objects[-1].objects] == ["cube_1"], "a cube")
    nowhere = {"type": "cube", "pose": pose((np.nan, 0, 0))}
    unnamed = {"surfaces": [msg.Surface()]}
    for kind, service, fields, code in (
        (srv.SpawnObject, spawn_object, {"type": "cow"}, NO_OBJECT_TYPE),
        (srv.SpawnObject, spawn_object, nowhere, POSE_NOT_FINITE),
        (srv.SpawnObject, spawn_object, {"type": "cube", "name": "cube_1"}, NAME_TAKEN),
        (srv.MoveObject, "/physics/move_object", {"name": "x"}, NO_OBJECT_IN_SCENE),
        (srv.Remove, "/physics/remove_object", {"name": "x"}, NO_OBJECT_IN_SCENE),
        (srv.Attach, "/physics/attach", {"robot": "r", "object": "cube_1"}, NO_ROBOT_IN_SCENE),
        (srv.Detach, "/physics/detach", {"robot": "r"}, NO_ROBOT_IN_SCENE),
        (srv.SceneFile, "/lab/load_scene", {"name": "nothing"}, NO_SCENE),
        (srv.SceneFile, "/lab/save_scene", {"name": "../x"}, BAD_SCENE_NAME),
        (srv.SetSurfaces, "/physics/set_surfaces", unnamed, SURFACE_WITHOUT_NAME),
    ):
        answer = graph.call(kind, service, **fields)
        assert not answer.success
        assert answer.code == code.code
    hand = graph.client.create_publisher(msg.Move, "/moves", qos.NEWEST)
    take = {"name": "cube_1", "pose": pose((2, 2, 0.5)), "held": True, "hand": "left"}
    assert graph.call(srv.MoveObject, "/physics/move_object", **take).success
    wait_for(lambda: hand.get_subscription_count() > 1, "the readers of moves")
    sequence = itertools.count(1)

    def carried() -> bool:
        to = {"object": "cube_1", "hand": "left", "pose": pose((1, 2, 0.5))}
        hand.publish(msg.Move(sequence=next(sequence), **to))
        return where(objects, "cube_1")[0] == 1.0

    wait_for(carried, "the cube where the hand is")
    move(graph, "cube_1", (2, 2, 0.5), held=False, velocity=(0.0, 0.0, 1.0))
    wait_for(lambda: where(objects, "cube_1")[0] > 1.9, "the throw")
    assert graph.call(Trigger, "/physics/clear_objects").success
    wait_for(lambda: not objects[-1].objects, "an empty room")


def test_what_a_page_carries_falls_when_its_gateway_dies_unless_its_hand_moves_on(
    graph, lab, monkeypatch
):
    monkeypatch.setattr(node, "RETURN_S", 1.0)
    objects = graph.listen(msg.SceneObjects, "/objects", qos.LATCHED)
    hand = graph.client.create_publisher(msg.Move, "/moves", qos.NEWEST)
    processes = graph.client.create_publisher(msg.LabProcesses, "/processes", qos.LATCHED_EVENTS)
    cubes = [place(graph, "cube", (1.0, y, 0.025)) for y in (1.0, 2.0)]
    for cube in cubes:
        take = {"name": cube, "pose": pose((2, 2, 0.5)), "held": True, "hand": cube}
        assert graph.call(srv.MoveObject, "/physics/move_object", **take).success
    wait_for(lambda: processes.get_subscription_count(), "the reader of deaths")
    wait_for(lambda: hand.get_subscription_count() > 1, "the readers of moves")
    down = msg.LabProcess(
        name="web", state=msg.LabProcess.WAITING, down_steady_ns=time.monotonic_ns()
    )
    processes.publish(msg.LabProcesses(processes=[down]))
    sequence = itertools.count(1)

    def fallen() -> list[str]:
        to = {"object": cubes[1], "hand": cubes[1], "pose": pose((2, 2, 0.5))}
        hand.publish(msg.Move(sequence=next(sequence), **to))
        seen = objects.last().objects if objects else ()
        return [each.name for each in seen if not each.held_by]

    wait_for(lambda: fallen() == cubes[:1], "the fall of the one that nobody moves")


def test_a_restarted_physics_has_its_objects_and_robots_back(graph, lab, tmp_path):
    objects = graph.listen(msg.SceneObjects, "/objects", qos.LATCHED)
    holds, idle = spawn(graph, "vacuum_cup"), spawn(graph, pose=pose((3, 0, 0)))
    lying, held, lost = (place(graph, "cube", (1.0, y, 0.025)) for y in (1.0, 2.0, 3.0))
    move(graph, held, tool(0, 0.3), held=True)
    move(graph, lost, np.add(tool(0, 0.1), (3, 0, 0)), held=True)
    for robot, cube in ((holds, held), (idle, lost)):
        wait_for(
            lambda robot=robot, cube=cube: (
                graph.call(srv.Attach, "/physics/attach", robot=robot, object=cube).success
            ),
            "the attachment",
        )
    wait_for(
        lambda: objects and [o.held_by for o in objects.last().objects] == ["", holds, idle],
        "the holders",
    )
    before = {name: where(objects, name) for name in (lying, held)}
    graph.drop(lab.physics)
    assert graph.call(srv.Remove, "/lab/remove_robot", name=idle).success
    objects.clear()
    again = graph.add(PhysicsNode, state_dir=str(tmp_path))
    # What a robot held it holds again; what one held that is gone falls.
    wait_for(
        lambda: objects and [o.held_by for o in objects.last().objects] == ["", holds, ""],
        "the holder again",
    )
    wait_for(lambda: where(objects, lost)[2] < 0.1, "the fall")
    assert again._world.robots == (holds,)
    for name, at in before.items():
        assert np.allclose(where(objects, name), at, atol=0.005), name


def test_what_was_to_be_released_while_physics_was_away_lies_where_it_was(
    graph, lab, tmp_path, monkeypatch
):
    # What is held is written at once: physics may be killed a moment later.
    monkeypatch.setattr("mrlab_ros.nodes.physics.contents.SAVE_PERIOD_S", 600.0)
    robot = spawn(graph, "parallel_gripper")
    grasp = grasped(graph, robot)
    objects = graph.listen(msg.SceneObjects, "/objects", qos.LATCHED)
    states = graph.listen(msg.PlaybackState, f"/{robot}/playback_state", qos.EVENTS)
    wait_for(lambda: grasp.last() and len(grasp.last().fingers) == 2, "the gripper")
    center = tool(0, 0.012 + 0.150)
    place(graph, "pedestal", center - [0, 0, 0.2251])
    cube = place(graph, "cube", center)
    load(graph, robot, "pick")
    assert graph.call(Trigger, f"/{robot}/play").success
    wait_for(lambda: grasp.last().state == msg.Grasp.HOLDING, "the grasp")
    kept = tmp_path / "physics.json"
    wait_for(lambda: kept.exists() and f'"held_by": "{robot}"' in kept.read_text(), "the file")
    graph.drop(lab.physics)
    wait_for(lambda: states.last().label == "READY", "the end")
    grasp.clear()
    again = graph.add(PhysicsNode, state_dir=str(tmp_path))
    said = OPENED_UNSEEN(object=cube, robot=robot)
    wait_for(lambda: grasp.last() and grasp.last().code == said.code, "the release")
    assert grasp.last().state == msg.Grasp.OPEN
    assert again.lost == [said]
    wait_for(lambda: where(objects, cube)[2] < 0.1, "the fall")
    released = tool(0.6, 0.012 + 0.150)
    assert np.allclose(where(objects, cube)[:2], released[:2], atol=0.02)
    assert msg.Grasp.HOLDING not in [each.state for each in grasp]


def test_a_room_is_kept_for_a_restart_that_nobody_planned(graph, lab, tmp_path):
    corners = [Point(x=x, y=y, z=0.0) for x, y in ((0.0, 0.0), (1.0, 0.0), (0.0, 1.0))]
    shelf = msg.Surface(name="shelf", label="shelf", vertices=corners, pose=pose((3, 0, 1)))
    assert graph.call(srv.SetSurfaces, "/physics/set_surfaces", surfaces=[shelf]).success
    seen = {"source": "quest", "surfaces": [shelf]}
    assert graph.call(srv.SetSurfaces, "/physics/set_surfaces", **seen).success
    kept = tmp_path / "physics.json"
    wait_for(
        lambda: (
            kept.exists()
            and [(s.name, s.source) for s in read(kept).surfaces]
            == [("shelf", ""), ("floor", ""), ("shelf_2", "quest")]
        ),
        "the file",
    )


def test_a_robot_that_goes_while_it_holds_something_leaves_it_and_may_come_back(graph, lab):
    robot = spawn(graph, "vacuum_cup")
    objects = graph.listen(msg.SceneObjects, "/objects", qos.LATCHED)
    grasp = grasped(graph, robot)
    cube = place(graph, "cube", tool(0, 0.2), held=True)
    joints = graph.listen(JointState, f"/{robot}/joint_states", qos.STREAM)
    wait_for(lambda: joints, "a joint state")
    wait_for(
        lambda: graph.call(srv.Attach, "/physics/attach", robot=robot, object=cube).success,
        "the attachment",
    )
    wait_for(lambda: grasp.last() and grasp.last().object == cube, "its news")
    wait_for(
        lambda: objects and [o.held_by for o in objects.last().objects] == [robot], "the holder"
    )
    answer = graph.call(srv.SetEndEffector, "/lab/set_end_effector", robot=robot)
    assert answer.success, answer.message
    wait_for(lambda: grasp.last().code == LET_GO.code, "what was let go")
    assert {value.key: value.value for value in grasp.last().values} == {
        "object": cube,
        "robot": robot,
    }
    assert (grasp.last().state, grasp.last().object) == (msg.Grasp.OPEN, "")
    wait_for(lambda: [o.held_by for o in objects.last().objects] == [""], "the fall")
    other = place(graph, "cube", tool(0, 0.1), held=True)
    wait_for(
        lambda: graph.call(srv.Attach, "/physics/attach", robot=robot, object=other).success,
        "the attachment to the flange",
    )
    wait_for(lambda: [o.held_by for o in objects.last().objects] == ["", robot], "the holder")
    assert graph.call(srv.Remove, "/lab/remove_robot", name=robot).success
    wait_for(lambda: [o.held_by for o in objects.last().objects] == ["", ""], "the second fall")
    assert spawn(graph) == robot
    wait_for(lambda: robot in lab.physics._world.robots, "the robot")
