"""Scenes without physics, and what a restart of the lab brings back, in a real graph."""

from __future__ import annotations

import json
from pathlib import Path
from types import SimpleNamespace

import pytest
import small_lab
from graph import Graph, wait_for
from mrlab_msgs import msg, srv
from mrlab_msgs.srv import SetLoop, Trigger
from small_lab import Catalogue, listen_state, load, spawn

from mrlab_ros.adapters.robots.diagnostics import NO_ROBOT_MODEL
from mrlab_ros.adapters.scenes.diagnostics import BAD_SCENE_NAME, NO_SCENE
from mrlab_ros.core.base.diagnostics import RESERVED_NAME
from mrlab_ros.core.scene.diagnostics import (
    BAD_PLACE_NAME,
    CONTENTS_LEFT_OUT,
    LOADED_IN_PART,
    NO_ACT_TO_UNDO,
    NO_SUCH_PLACE,
    NOT_BACK,
    PLACE_SET,
    POSITION_BEYOND,
    TRAJECTORY_NOT_FITTING,
    UNDONE,
)
from mrlab_ros.core.systems.diagnostics import DISSOLVED
from mrlab_ros.messages import qos
from mrlab_ros.nodes.coordinator.node import CoordinatorNode
from mrlab_ros.nodes.lab.diagnostics import (
    NO_PHYSICS_TO_SAVE,
    NO_PLAYBACK_RUNS,
    ROBOT_REMOVED,
    SCENE_LOADED,
    SCENE_SAVED,
)
from mrlab_ros.nodes.lab.node import LabNode
from mrlab_ros.nodes.playback.host import PlaybackHostNode

KUKA = "kuka_kr6_r900_sixx"


@pytest.fixture
def lab(graph: Graph, tmp_path: Path) -> SimpleNamespace:
    graph.add(Catalogue)
    return SimpleNamespace(
        file=tmp_path / "scene.json",
        scenes=tmp_path / "scenes",
        lab=graph.add(LabNode, state_dir=str(tmp_path)),
        host=graph.add(PlaybackHostNode),
        coordinator=graph.add(CoordinatorNode),
        robots=graph.listen(msg.Robots, "/robots", qos.LATCHED_EVENTS),
        systems=graph.listen(msg.RobotSystems, "/systems", qos.LATCHED_EVENTS),
    )


def names(lab) -> list[str]:
    return [robot.name for robot in lab.robots[-1].robots] if lab.robots else []


def system(lab):
    return next(iter(lab.systems[-1].systems), None) if lab.systems else None


def scene(graph: Graph, verb: str, name: str):
    return graph.call(srv.SceneFile, f"/lab/{verb}_scene", name=name, timeout=60)


def done(answer):
    assert answer.success, answer.message
    return answer


def seek(graph: Graph, name: str, position: float) -> None:
    done(graph.call(srv.Seek, f"/{name}/seek", position=position))


def make_system(graph: Graph, *members: tuple[str, str]) -> None:
    done(
        graph.call(
            srv.CreateSystem,
            "/coordinator/create_system",
            name="cell",
            mode=msg.RobotSystem.SEQUENTIAL,
            policy=msg.RobotSystem.HALT_MEMBER,
            loop=True,
            members=[
                msg.SystemMember(robot=robot, trajectory_id=trajectory, dwell=0.5)
                for robot, trajectory in members
            ],
        )
    )


def furnish(graph: Graph, lab) -> SimpleNamespace:
    """Bring robots and a system into the lab, each with a place that is not the start."""
    alone, first, second = spawn(graph), spawn(graph), spawn(graph, KUKA)
    load(graph, alone, "long")
    done(graph.call(srv.SetRate, f"/{alone}/set_rate", rate=2.0))
    done(graph.call(SetLoop, f"/{alone}/set_loop", loop=True))
    seek(graph, alone, 3.25)
    make_system(graph, (first, "wave"), (second, "kuka"))
    done(graph.call(srv.SetRate, "/cell/set_rate", rate=0.5))
    seek(graph, "cell", 0.75)
    wait_for(lambda: system(lab) and system(lab).label == "PAUSED", "the system's place")
    return SimpleNamespace(alone=alone, members=[first, second])


def is_back(graph: Graph, lab, robots) -> None:
    """Wait until the robots and the system of furnish() are as they were."""
    states = listen_state(graph, robots.alone)
    latched = graph.listen(msg.PlaybackState, f"/{robots.alone}/playback_state", qos.LATCHED)
    wait_for(
        lambda: latched and latched[-1].label == "PAUSED" and latched[-1].rate == 2.0,
        "the robot's place",
    )
    state = latched[-1]
    assert (state.trajectory_id, state.loop) == ("long", True)
    assert state.clock.position == pytest.approx(3.25)
    wait_for(lambda: system(lab) and system(lab).label == "PAUSED", "the system")
    cell = system(lab)
    assert (cell.name, cell.mode, cell.policy, cell.rate, cell.loop) == ("cell", 1, 1, 0.5, True)
    assert cell.clock.position == pytest.approx(0.75)
    assert [(m.robot, m.trajectory_id, m.dwell) for m in cell.members] == [
        (robots.members[0], "wave", 0.5),
        (robots.members[1], "kuka", 0.5),
    ]
    states.clear()


def values_of(answer) -> dict[str, str]:
    return {each.key: each.value for each in answer.values}


def test_robots_and_systems_of_a_scene_come_back_without_physics(graph, lab):
    robots = furnish(graph, lab)
    answer = done(scene(graph, "save", "lesson"))
    assert (answer.code, values_of(answer)["robots"]) == (SCENE_SAVED.code, "3")
    assert NO_PHYSICS_TO_SAVE.code in values_of(answer)["missing"]
    before = lab.robots[-1].robots
    done(scene(graph, "load", "empty"))
    wait_for(lambda: names(lab) == [] and system(lab) is None, "an empty lab")
    answer = done(scene(graph, "load", "lesson"))
    assert answer.code == SCENE_LOADED.code
    assert values_of(answer) == {
        "scene": "lesson",
        "robots": "3",
        "systems": "1",
    }
    wait_for(lambda: len(names(lab)) == 3, "the robots")
    assert lab.robots[-1].robots == before
    is_back(graph, lab, robots)
    # A scene may follow itself.
    done(scene(graph, "load", "lesson"))
    is_back(graph, lab, robots)
    done(graph.call(Trigger, "/cell/play", timeout=30))


def test_what_was_loaded_removed_or_dissolved_is_undone_whoever_did_it(graph, lab):
    robots = furnish(graph, lab)
    undoable = graph.listen(msg.Undoable, "/undoable", qos.LATCHED)
    place = graph.listen(msg.Place, "/place", qos.LATCHED)
    named = graph.call(srv.SetPlace, "/lab/set_place", name="Lab A")
    assert done(named).code == PLACE_SET.code
    wait_for(lambda: place and place.last().name == "Lab A", "the place")
    done(scene(graph, "save", "lesson"))
    done(scene(graph, "load", "empty"))
    wait_for(lambda: undoable and undoable.last().code == SCENE_LOADED.code, "the act")
    done(graph.call(srv.SetPlace, "/lab/set_place", name="Lab B"))
    assert done(graph.call(srv.Undo, "/lab/undo", timeout=60)).code == UNDONE.code
    is_back(graph, lab, robots)
    wait_for(lambda: place.last().name == "Lab A", "the place of the scene")
    done(graph.call(srv.Remove, "/coordinator/dissolve_system", name="cell"))
    wait_for(lambda: undoable.last().code == DISSOLVED.code, "the system's end")
    done(graph.call(srv.Undo, "/lab/undo", id=undoable.last().id, timeout=60))
    # What was there before the first undo can be had back, and what came since.
    wait_for(lambda: undoable.last().code == UNDONE.code, "the other scene")
    done(graph.call(srv.Undo, "/lab/undo", timeout=60))
    wait_for(lambda: (names(lab), place.last().name) == ([], "Lab B"), "the other scene")
    done(graph.call(srv.Undo, "/lab/undo", timeout=60))
    is_back(graph, lab, robots)
    wait_for(lambda: place.last().name == "Lab A", "the place of the scene")
    done(graph.call(srv.Remove, "/lab/remove_robot", name=robots.alone))
    done(graph.call(srv.Remove, "/lab/remove_robot", name=robots.members[0]))
    wait_for(lambda: system(lab) is None, "the end of the system with its member")
    done(graph.call(srv.Undo, "/lab/undo", timeout=60))
    done(graph.call(srv.Undo, "/lab/undo", timeout=60))
    is_back(graph, lab, robots)
    answer = graph.call(srv.Undo, "/lab/undo", id="cow")
    assert (answer.success, answer.code) == (False, NO_ACT_TO_UNDO.code)


def test_acts_of_before_come_back_with_the_scene_that_another_replaced(graph, lab):
    robot = spawn(graph)
    wait_for(lambda: names(lab) == [robot], "the robot")
    done(graph.call(srv.Remove, "/lab/remove_robot", name=robot))
    for name, there in (("handover", ["ur5e_1", f"{KUKA}_1"]), ("empty", [])):
        done(scene(graph, "load", name))
        wait_for(lambda there=there: names(lab) == there, name)
    for there in (["ur5e_1", f"{KUKA}_1"], [], [robot]):
        done(graph.call(srv.Undo, "/lab/undo", timeout=60))
        wait_for(lambda there=there: names(lab) == there, "the scene of before")


def test_what_cannot_come_back_is_named_and_a_new_lab_offers_nothing(graph, lab, tmp_path):
    undoable = graph.listen(msg.Undoable, "/undoable", qos.LATCHED_EVENTS)
    wait_for(lambda: undoable and undoable.last().id == "", "nothing to undo")
    robot = spawn(graph)
    done(graph.call(srv.Remove, "/lab/remove_robot", name=robot))
    wait_for(lambda: undoable.last().code == ROBOT_REMOVED.code, "the act")
    id = undoable.last().id
    assert spawn(graph) == robot
    for _ in range(2):
        answer = graph.call(srv.Undo, "/lab/undo", id=id, timeout=60)
        assert (answer.success, answer.code) == (False, NOT_BACK.code)
    done(graph.call(srv.Remove, "/lab/remove_robot", name=robot))
    done(graph.call(srv.Undo, "/lab/undo", id=id, timeout=60))
    wait_for(lambda: undoable.last().id not in ("", id), "the other act")
    graph.drop(lab.lab)
    undoable.clear()
    graph.add(LabNode, state_dir=str(tmp_path))
    wait_for(lambda: undoable and undoable.last().id == "", "nothing to undo")


def test_a_place_has_a_name_that_people_can_read_and_an_id_that_was_there_before(graph, lab):
    place = graph.listen(msg.Place, "/place", qos.LATCHED)
    wait_for(lambda: place, "the place")
    first = place.last().id
    for name in ("", "x" * 65, "a\nb", "  ", "a\u202eb", "\u200b"):
        answer = graph.call(srv.SetPlace, "/lab/set_place", name=name)
        assert (answer.success, answer.code) == (False, BAD_PLACE_NAME.code)
    answer = graph.call(srv.SetPlace, "/lab/set_place", id="cow", name="Hall")
    assert (answer.success, answer.code) == (False, NO_SUCH_PLACE.code)
    done(graph.call(srv.SetPlace, "/lab/set_place", name="Hall"))
    done(graph.call(srv.SetPlace, "/lab/set_place", id=first, name="Lab"))
    wait_for(lambda: (place.last().id, place.last().name) == (first, "Lab"), "the first place")


def test_objects_of_a_scene_are_named_as_left_out(graph, lab):
    answer = done(scene(graph, "load", "handover"))
    assert answer.code == SCENE_LOADED.code
    left_out = json.loads(values_of(answer)["missing"])
    assert left_out["code"] == CONTENTS_LEFT_OUT.code
    assert left_out["values"] == {"objects": 1, "surfaces": 0}
    wait_for(lambda: names(lab) == ["ur5e_1", f"{KUKA}_1"], "the robots")


def test_what_cannot_be_finished_is_named(graph, lab):
    lab.scenes.mkdir()
    (lab.scenes / "half.yaml").write_text(
        "robots: [{name: a, model: ur5e, trajectory: gone}, {name: b, model: ur5e}]\n"
        "systems: [{name: cell, members: [{robot: b, trajectory: wave}]}]"
    )
    # The catalogue lists it, and cannot give it.
    small_lab.TRAJECTORIES["gone"] = small_lab.make("ur5e", "gone")
    try:
        listed = graph.call(srv.ListTrajectories, "/converter/list_any", robot_model="ur5e")
        assert "gone" in [info.id for info in listed.trajectories]
        small_lab.UNREADABLE.add("gone")
        answer = scene(graph, "load", "half")
    finally:
        small_lab.UNREADABLE.clear()
        del small_lab.TRAJECTORIES["gone"]
    assert not answer.success
    assert answer.code == LOADED_IN_PART.code
    values = {name: json.loads(text) for name, text in values_of(answer).items()}
    assert [step["values"] for step in values["done"]] == [{"robots": ["a", "b"]}]
    assert values["why"]["values"]["step"]["values"] == {"trajectory": "gone", "robot": "a"}
    assert [step["values"] for step in values["rest"]] == [{"system": "cell"}]
    wait_for(lambda: names(lab) == ["a", "b"], "the robots")


def test_a_scene_that_cannot_be_changes_nothing(graph, lab):
    robots = furnish(graph, lab)
    lab.scenes.mkdir()
    before = lab.robots[-1], system(lab)
    for text, code in (
        ("robots: [{name: a, model: cow}]", NO_ROBOT_MODEL.code),
        ("robots: [{name: a, model: ur5e, trajectory: x}]", TRAJECTORY_NOT_FITTING.code),
        ("robots: [{name: a, model: ur5e, trajectory: kuka}]", TRAJECTORY_NOT_FITTING.code),
        ("robots: [{name: a, model: ur5e, trajectory: tool}]", TRAJECTORY_NOT_FITTING.code),
        ("robots: [{name: a, model: ur5e, trajectory: wave, at: 9}]", POSITION_BEYOND.code),
        ("robots: [{name: lab, model: ur5e}]", RESERVED_NAME.code),
        (
            "robots: [{name: a, model: ur5e}]\n"
            "systems: [{name: s, members: [{robot: a, trajectory: wave,"
            " waits: ['frame 99: object c free']}]}]",
            None,
        ),
    ):
        (lab.scenes / "bad.yaml").write_text(text)
        answer = scene(graph, "load", "bad")
        assert not answer.success
        assert code in (None, answer.code), answer.message
    assert (lab.robots[-1], system(lab)) == before
    is_back(graph, lab, robots)
    for name, code in (("nothing", NO_SCENE), ("../x", BAD_SCENE_NAME)):
        answer = scene(graph, "load", name)
        assert (answer.success, answer.code) == (False, code.code)
    answer = scene(graph, "save", "../x")
    assert (answer.success, answer.code) == (False, BAD_SCENE_NAME.code)


def test_a_trajectory_without_a_playback_is_refused_before_anything_changes(
    graph, tmp_path, monkeypatch
):
    monkeypatch.setattr("mrlab_ros.nodes.lab.scenes.ARRIVAL_TIMEOUT_S", 0.5)
    graph.add(Catalogue)
    graph.add(LabNode, state_dir=str(tmp_path))
    robots = graph.listen(msg.Robots, "/robots", qos.LATCHED)
    (tmp_path / "scenes").mkdir()
    text = "robots: [{name: a, model: ur5e, trajectory: wave}]"
    (tmp_path / "scenes" / "one.yaml").write_text(text)
    answer = scene(graph, "load", "one")
    assert (answer.success, answer.code) == (False, NO_PLAYBACK_RUNS.code)
    wait_for(lambda: robots and not robots[-1].robots, "the robots")


# a restart ----------------------------------------------------------------------------------


def test_a_restarted_lab_brings_back_what_robots_had_loaded_and_the_systems(graph, lab, tmp_path):
    robots = furnish(graph, lab)
    before = lab.robots[-1].robots
    for node in (lab.lab, lab.coordinator, lab.host):
        graph.drop(node)
    lab.systems.clear()
    graph.add(LabNode, state_dir=str(tmp_path))
    graph.add(PlaybackHostNode)
    graph.add(CoordinatorNode)
    wait_for(lambda: lab.robots[-1].robots == before, "the robots")
    is_back(graph, lab, robots)


def test_a_lab_that_is_killed_early_in_its_restart_forgets_nothing(graph, lab, tmp_path):
    robots = furnish(graph, lab)
    for node in (lab.lab, lab.coordinator, lab.host):
        graph.drop(node)
    for _ in range(2):
        # Nobody is there yet to load a trajectory.
        graph.drop(graph.add(LabNode, state_dir=str(tmp_path)))
    lab.systems.clear()
    graph.add(LabNode, state_dir=str(tmp_path))
    graph.add(PlaybackHostNode)
    graph.add(CoordinatorNode)
    is_back(graph, lab, robots)


def test_a_lab_restarted_alone_leaves_what_plays_alone(graph, lab, tmp_path):
    robot = spawn(graph)
    load(graph, robot, "long")
    states = listen_state(graph, robot)
    done(graph.call(Trigger, f"/{robot}/play"))
    wait_for(lambda: states and states[-1].label == "PLAYING", "the motion")
    wait_for(lambda: "long" in lab.file.read_text(), "the file")
    graph.drop(lab.lab)
    announced = len(lab.robots)
    graph.add(LabNode, state_dir=str(tmp_path))
    wait_for(lambda: len(lab.robots) > announced, "the new lab")
    frame = states[-1].frame
    wait_for(lambda: states[-1].frame > frame + 50, "frames")
    assert {state.label for state in states if state.frame > frame} == {"PLAYING"}


def test_systems_come_back_where_only_the_coordinator_s_process_died(graph, lab, tmp_path):
    robots = furnish(graph, lab)
    for node in (lab.lab, lab.coordinator):
        graph.drop(node)
    lab.systems.clear()
    graph.add(LabNode, state_dir=str(tmp_path))
    graph.add(CoordinatorNode)
    is_back(graph, lab, robots)
    done(graph.call(Trigger, "/cell/play", timeout=30))


def test_what_refers_to_a_missing_trajectory_is_named_once_and_a_copy_is_kept(
    graph, lab, tmp_path, capfd
):
    robots = furnish(graph, lab)
    for node in (lab.lab, lab.coordinator, lab.host):
        graph.drop(node)
    before = lab.file.read_text().replace('"kuka"', '"gone"')
    lab.file.write_text(before)
    capfd.readouterr()
    graph.add(LabNode, state_dir=str(tmp_path))
    graph.add(PlaybackHostNode)
    graph.add(CoordinatorNode)
    wait_for(lambda: list(tmp_path.glob("scene.json.damaged-*")), "the copy", 30)
    (aside,) = tmp_path.glob("scene.json.damaged-*")
    kept = json.loads(aside.read_text())
    assert [entry["name"] for entry in kept["systems"]] == ["cell"]
    assert kept["systems"][0]["members"][1]["trajectory"] == "gone"
    wait_for(lambda: not json.loads(lab.file.read_text())["systems"], "the file without it")
    said = capfd.readouterr().err
    assert said.count("cell") == 1, said
    assert "create the system cell" in said
    assert aside.name in said
    assert names(lab) == [robots.alone, *robots.members]


def damaged(path: Path, text: str | bytes) -> None:
    path.write_bytes(text if isinstance(text, bytes) else text.encode())


ROBOT = {"name": "ur5e_1", "model": "ur5e"}
WHOLE = {
    "truncated": b'[{"name": "ur5e_1", "model": "ur',
    "types": b'{"robots": 7}',
    "binary": bytes(range(256)),
    "nothing": b"",
}


@pytest.mark.parametrize("content", WHOLE.values(), ids=WHOLE)
def test_a_lab_starts_with_a_damaged_file_and_keeps_its_robots_from_then_on(
    graph, tmp_path, content, capfd
):
    file = tmp_path / "scene.json"
    damaged(file, content)
    first = graph.add(LabNode, state_dir=str(tmp_path))
    robots = graph.listen(msg.Robots, "/robots", qos.LATCHED)
    assert spawn(graph) == "ur5e_1"
    (aside,) = tmp_path.glob("scene.json.damaged-*")
    assert aside.read_bytes() == content
    wait_for(lambda: robots and len(robots[-1].robots) == 1, "the robot")
    graph.drop(first)
    robots.clear()
    graph.add(LabNode, state_dir=str(tmp_path))
    wait_for(lambda: robots and len(robots[-1].robots) == 1, "the robot of the last run")
    said = capfd.readouterr().err
    assert "[ERROR]" in said
    assert aside.name in said


def test_robots_that_cannot_be_are_left_out_alone_and_named(graph, tmp_path, capfd):
    file = tmp_path / "scene.json"
    file.write_text(
        json.dumps(
            {
                "robots": [
                    ROBOT,
                    {"name": "cow_1", "model": "cow"},
                    {"name": "ur5e_2", "model": "ur5e", "position": [float("nan"), 0, 0]},
                    {"name": "ur5e_3", "model": "ur5e", "end_effector": "hand"},
                    {"name": "ur5e_4", "model": "ur5e", "position": [2, 0, 0]},
                ],
                "systems": [{"name": "cell", "members": [{"robot": "cow_1"}]}],
            }
        )
    )
    graph.add(LabNode, state_dir=str(tmp_path))
    robots = graph.listen(msg.Robots, "/robots", qos.LATCHED)
    wait_for(lambda: robots, "the robots")
    assert [robot.name for robot in robots[-1].robots] == ["ur5e_1", "ur5e_4"]
    said = capfd.readouterr().err
    for words in ("robot 3: position is", "no robot 'cow'", "ur5e_3"):
        assert words in said, words
    assert len(list(tmp_path.glob("scene.json.damaged-*"))) == 2


def test_a_folder_or_a_file_in_the_way_does_not_stop_the_lab(graph, tmp_path, capfd):
    (tmp_path / "a" / "scene.json").mkdir(parents=True)
    (tmp_path / "b").write_text("")
    first = graph.add(LabNode, state_dir=str(tmp_path / "a"), robots=["ur5e"])
    assert (tmp_path / "a" / "scene.json").is_file()
    graph.drop(first)
    graph.add(LabNode, state_dir=str(tmp_path / "b"))
    assert spawn(graph) == "ur5e_1"
    assert "cannot be written, a restart will not know" in capfd.readouterr().err
