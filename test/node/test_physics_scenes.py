"""Scenes in a real graph: a whole lab brought to what a file says, or left as it was."""

from __future__ import annotations

from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from graph import Graph, wait_for
from mrlab_msgs import msg, srv
from mrlab_msgs.srv import Trigger

from mrlab_ros.adapters import share
from mrlab_ros.adapters.robots import diagnostics as robots
from mrlab_ros.core.base import diagnostics as base
from mrlab_ros.core.physics import diagnostics as physics
from mrlab_ros.core.scene import diagnostics as scenes
from mrlab_ros.messages import qos
from mrlab_ros.nodes.converter.node import ConverterNode
from mrlab_ros.nodes.coordinator.node import CoordinatorNode
from mrlab_ros.nodes.lab.node import LabNode
from mrlab_ros.nodes.physics.diagnostics import CANNOT_HOLD_FIXED, TOO_MANY_OBJECTS
from mrlab_ros.nodes.physics.node import PhysicsNode
from mrlab_ros.nodes.playback.host import PlaybackHostNode

EXAMPLES = share.directory() / "examples"
GIVER, TAKER = "ur5e_1", "kuka_kr6_r900_sixx_1"
TOOL = "parallel_gripper"
# Where the rod of the hand-over stands before and after, m.
TAKEN, STOOD = (0.3536, -0.3536, 0.08), (0.817, -0.321, 0.08)


@pytest.fixture
def lab(graph: Graph, tmp_path: Path):
    graph.add(ConverterNode, state_dir=str(tmp_path))
    graph.add(LabNode, state_dir=str(tmp_path))
    graph.add(PlaybackHostNode)
    graph.add(CoordinatorNode)
    graph.add(PhysicsNode, state_dir=str(tmp_path))
    return SimpleNamespace(
        scenes=tmp_path / "scenes",
        robots=graph.listen(msg.Robots, "/robots", qos.LATCHED),
        objects=graph.listen(msg.SceneObjects, "/objects", qos.LATCHED),
        systems=graph.listen(msg.RobotSystems, "/systems", qos.LATCHED_EVENTS),
        grasps={r: graph.listen(msg.Grasp, f"/{r}/grasp", qos.EVENTS) for r in (GIVER, TAKER)},
        collisions={
            r: graph.listen(msg.Collision, f"/{r}/collision", qos.EVENTS) for r in (GIVER, TAKER)
        },
    )


def load_scene(graph: Graph, name: str):
    return graph.call(srv.SceneFile, "/lab/load_scene", name=name, timeout=60)


def done(answer):
    assert answer.success, answer.message
    return answer


def where(lab, name: str) -> np.ndarray:
    p = thing(lab, name).pose.position
    return np.array([p.x, p.y, p.z])


def thing(lab, name: str):
    return next(o for o in lab.objects.last().objects if o.name == name)


def system(lab):
    return next(iter(lab.systems.last().systems), None) if lab.systems else None


def convert(graph: Graph, file: str, model: str) -> str:
    answer = graph.call(
        srv.ConvertTrajectory, "/converter/convert", path=str(EXAMPLES / file), robot_model=model,
        end_effector=TOOL, timeout=60,
    )  # fmt: skip
    return done(answer).trajectory.id


def hand_over(graph: Graph, lab, members: list[msg.SystemMember]) -> None:
    """Play the hand-over from its start until the taker has the rod."""
    done(load_scene(graph, "handover"))
    wait_for(lambda: lab.objects.last() and lab.objects.last().objects, "the rod")
    assert np.abs(where(lab, "rod_1") - TAKEN).max() < 0.003
    done(graph.call(srv.CreateSystem, "/coordinator/create_system", name="cell", members=members))
    for inbox in (*lab.grasps.values(), *lab.collisions.values()):
        inbox.clear()
    done(graph.call(Trigger, "/cell/play", timeout=30))
    wait_for(lambda: system(lab).label == "PLAYING", "the start")
    wait_for(
        lambda: thing(lab, "rod_1").held_by == TAKER or system(lab).label != "PLAYING",
        "the hand-over or the end",
        30.0,
    )
    assert thing(lab, "rod_1").held_by == TAKER


def test_a_rod_goes_from_hand_to_hand_and_the_class_starts_where_it_stopped(graph, lab):
    members = [
        msg.SystemMember(
            robot=GIVER, trajectory_id=convert(graph, "two_robot_handover_ur5e.mat", "ur5e")
        ),
        msg.SystemMember(
            robot=TAKER,
            trajectory_id=convert(graph, "two_robot_handover_kr6.mat", "kuka_kr6_r900_sixx"),
        ),
    ]
    hand_over(graph, lab, members)
    wait_for(lambda: lab.grasps[GIVER].last().state == msg.Grasp.OPEN, "the giver's opening")
    assert not any(c.colliding for inbox in lab.collisions.values() for c in inbox)
    states = [grasp.state for grasp in lab.grasps[GIVER]]
    kind = msg.Grasp
    assert [s for i, s in enumerate(states) if i == 0 or s != states[i - 1]][-4:] == [
        kind.CLOSING, kind.HOLDING, kind.EMPTY, kind.OPEN,
    ]  # fmt: skip

    # Physics may have been late, and all of this in an instant: let the taker carry it a while.
    taken = where(lab, "rod_1")
    wait_for(lambda: np.abs(where(lab, "rod_1") - taken).max() > 0.05, "the rod on its way")

    # Scrubbing both robots takes the rod back: to the giver's hand, to the floor, and on again.
    done(graph.call(Trigger, "/cell/pause"))
    # Wherever a slow machine came to pause it: there the taker still has the rod.
    last = min(system(lab).clock.position - 0.05, 6.0)
    for position, holder in ((3.0, GIVER), (1.0, ""), (last, TAKER)):
        done(graph.call(srv.Seek, "/cell/seek", position=position))
        wait_for(lambda holder=holder: thing(lab, "rod_1").held_by == holder, f"at {position} s")
        if not holder:
            wait_for(lambda: np.abs(where(lab, "rod_1") - TAKEN).max() < 0.003, "the floor")
    place = where(lab, "rod_1")
    wait_for(lambda: system(lab).label == "PAUSED", "the pause")

    # The lesson ends, and begins again where it ended.
    done(graph.call(srv.SceneFile, "/lab/save_scene", name="lesson"))
    done(load_scene(graph, "empty"))
    wait_for(lambda: not lab.objects.last().objects and not lab.robots.last().robots, "no scene")
    done(load_scene(graph, "lesson"))
    wait_for(
        lambda: [o.held_by for o in lab.objects.last().objects] == [TAKER], "the rod in its hand"
    )
    wait_for(lambda: np.abs(where(lab, "rod_1") - place).max() < 0.005, "the rod's place")
    wait_for(lambda: system(lab) and system(lab).label == "PAUSED", "the system")
    assert system(lab).clock.position == pytest.approx(last, abs=0.02)
    assert [m.robot for m in system(lab).members] == [GIVER, TAKER]

    # Who removes the robot takes the rod from it, who undoes that gives it back.
    for at_once in (False, True):
        done(graph.call(srv.Remove, "/lab/remove_robot", name=TAKER))
        if not at_once:
            wait_for(lambda: thing(lab, "rod_1").held_by == "" and not system(lab), "the fall")
            wait_for(lambda: np.abs(where(lab, "rod_1") - place).max() > 0.05, "the floor")
        done(graph.call(srv.Undo, "/lab/undo", timeout=60))
        wait_for(lambda: thing(lab, "rod_1").held_by == TAKER, "the rod in its hand")
        wait_for(lambda: np.abs(where(lab, "rod_1") - place).max() < 0.005, "the rod's place")
        wait_for(lambda: system(lab) and system(lab).label == "PAUSED", "the system")
    done(graph.call(Trigger, "/cell/play", timeout=30))
    wait_for(lambda: system(lab).message == "played to the end", "the end", 30.0)
    wait_for(lambda: thing(lab, "rod_1").held_by == "", "the release")
    wait_for(lambda: where(lab, "rod_1")[2] < 0.1, "the rod on the floor")
    assert np.abs(where(lab, "rod_1") - STOOD).max() < 0.02


BAD_SCENES = {
    "cow": ("robots: [{name: cow_1, model: cow}]", robots.NO_ROBOT_MODEL),
    "hand": ("robots: [{name: a, model: ur5e, end_effector: hand}]", robots.NO_END_EFFECTOR),
    "thing": ("objects: [{name: a, type: cow}]", physics.NO_OBJECT_TYPE),
    "far": ("objects: [{name: a, type: cube, position: [0, 100000, 0]}]", base.BAD_VECTOR),
    "lost": (
        "robots: [{name: a, model: ur5e, trajectory: nothing}]",
        scenes.TRAJECTORY_NOT_FITTING,
    ),
    "member": (
        "robots: [{name: a, model: ur5e}]\n"
        "systems: [{name: s, members: [{robot: b, trajectory: t}]}]",
        scenes.ROBOT_NOT_AMONG,
    ),
    "crowd": (
        "objects:\n" + "\n".join(f"- {{name: cube_{i}, type: cube}}" for i in range(1, 40)),
        TOO_MANY_OBJECTS,
    ),
    "wait": (
        "robots: [{name: a, model: ur5e, trajectory: two_robot_handover_ur5e}]\n"
        "systems: [{name: s, members: [{robot: a, waits: ['frame 0: after b.frame 1']}]}]",
        scenes.TRAJECTORY_NOT_FITTING,
    ),
    "fixed": (
        "robots: [{name: a, model: ur5e}]\n"
        "objects: [{name: b, type: table, held_by: a, in_hand: {}}]",
        CANNOT_HOLD_FIXED,
    ),
    "cell": ("members: [{robot: a}]", scenes.CELL_NOT_SCENE),
    "nowhere": (
        "surfaces: [{name: floor, label: floor, vertices: [[0, 0, 0], [1, 0, 0], [0, 1, 0]]}]\n"
        "objects: [{name: a, type: cube, position: [5, 5, 1], automatic: true}]",
        physics.NO_SURFACE_BELOW,
    ),
}


def test_a_scene_that_cannot_be_is_refused_and_changes_nothing(graph, lab):
    done(load_scene(graph, "pick_and_place"))
    wait_for(lambda: lab.robots and lab.robots.last().robots, "the robot")
    wait_for(lambda: lab.objects and len(lab.objects.last().objects) == 3, "the objects")
    lab.scenes.mkdir(exist_ok=True)
    before = lab.robots.last()
    poses = {o.name: where(lab, o.name) for o in lab.objects.last().objects}
    for name, (text, code) in BAD_SCENES.items():
        (lab.scenes / f"{name}.yaml").write_text(text)
        answer = load_scene(graph, name)
        assert not answer.success
        assert answer.code == code.code, answer.message
    assert lab.robots.last() is before
    sent = len(lab.objects)
    wait_for(lambda: len(lab.objects) > sent, "the objects again")
    assert {o.name for o in lab.objects.last().objects} == poses.keys()
    for name, place in poses.items():
        assert np.abs(where(lab, name) - place).max() < 0.003, name


def test_one_scene_follows_another_at_once_and_leaves_nothing_of_it(graph, lab):
    for name, count in (("handover", 2), ("table", 1), ("handover", 2), ("empty", 0)):
        done(load_scene(graph, name))
        wait_for(lambda n=count: lab.robots and len(lab.robots.last().robots) == n, name)
    done(load_scene(graph, "obstacle_course"))
    wait_for(lambda: [r.name for r in lab.robots.last().robots] == ["ur5e_1"], "the robot")
    wait_for(
        lambda: [o.name for o in lab.objects.last().objects][-1:] == ["ball_1"], "the objects"
    )


def test_the_catalogue_is_listed_and_what_the_lab_removes_is_announced(graph, lab):
    answer = graph.call(srv.ListCatalogue, "/physics/list_catalogue")
    types = {kind.id: kind for kind in answer.types}
    assert types["cube"].mass == pytest.approx(0.1)
    assert types["cube"].about == "a wooden cube of 5 cm"
    assert types["table"].mass == 0
    listed = graph.call(srv.ListScenes, "/lab/list_scenes").scenes
    assert {"empty", "handover", "pick_and_place"} <= set(listed)
    removed = graph.listen(msg.ObjectRemoved, "/objects/removed", qos.EVENTS)
    wait_for(lambda: graph.client.count_publishers("/objects/removed"), "the topic")
    for _ in range(answer.limit + 1):
        made = graph.call(srv.SpawnObject, "/physics/spawn_object", type="ball", automatic=True)
        done(made)
    wait_for(lambda: removed, "the news")
    assert (removed[0].name, removed[0].type) == ("ball_1", "ball")
    assert "made room" in removed[0].reason
    done(graph.call(srv.Remove, "/physics/remove_object", name="ball_2"))
    done(graph.call(Trigger, "/physics/clear_objects"))
    wait_for(lambda: lab.objects and not lab.objects.last().objects, "an empty room")
    assert len(removed) == 1
    undo = graph.call(srv.Undo, "/lab/undo", timeout=60)
    assert done(undo).code == scenes.UNDONE.code
    wait_for(lambda: len(lab.objects.last().objects) == answer.limit - 1, "what was cleared")
    done(graph.call(srv.Undo, "/lab/undo", timeout=60))
    wait_for(lambda: any(o.name == "ball_2" for o in lab.objects.last().objects), "the ball")
