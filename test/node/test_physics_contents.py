"""All objects and surfaces at once: read, checked, replaced, and kept for a restart."""

from __future__ import annotations

import json
from pathlib import Path
from types import SimpleNamespace

import pytest
from geometry_msgs.msg import Point, Pose, Quaternion
from graph import Graph, wait_for
from mrlab_msgs import msg, srv

from mrlab_ros.core.base import diagnostics as base
from mrlab_ros.core.physics import diagnostics as physics
from mrlab_ros.core.scene.diagnostics import SURFACE_WITHOUT_NAME, SURFACES_OF_ONE_NAME
from mrlab_ros.messages import qos
from mrlab_ros.nodes.lab.node import LabNode
from mrlab_ros.nodes.physics import diagnostics as answers
from mrlab_ros.nodes.physics.node import PhysicsNode
from mrlab_ros.nodes.playback.host import PlaybackHostNode


@pytest.fixture
def lab(graph: Graph, tmp_path: Path) -> SimpleNamespace:
    return SimpleNamespace(
        file=tmp_path / "physics.json",
        physics=graph.add(PhysicsNode, state_dir=str(tmp_path)),
        objects=graph.listen(msg.SceneObjects, "/objects", qos.LATCHED),
        surfaces=graph.listen(msg.Surfaces, "/surfaces", qos.LATCHED),
    )


def pose(x: float, y: float, z: float) -> Pose:
    return Pose(position=Point(x=x, y=y, z=z), orientation=Quaternion(w=1.0))


def cube(name: str, x: float = 0.5, **fields) -> msg.ObjectPlacement:
    return msg.ObjectPlacement(name=name, type="cube", pose=pose(x, 0.0, 0.025), **fields)


def shelf() -> msg.Surface:
    corners = [Point(x=x, y=y) for x, y in ((0.0, 0.0), (1.0, 0.0), (0.0, 1.0))]
    return msg.Surface(name="shelf", label="shelf", vertices=corners, pose=pose(3.0, 0.0, 1.0))


def set_objects(graph: Graph, *objects: msg.ObjectPlacement, surfaces=(), dry_run: bool = False):
    return graph.call(
        srv.SetObjects,
        "/physics/set_objects",
        objects=list(objects),
        surfaces=list(surfaces),
        dry_run=dry_run,
    )


def get_objects(graph: Graph):
    return graph.call(srv.GetObjects, "/physics/get_objects")


def names(entries) -> list[str]:
    return [entry.name for entry in entries]


def test_all_objects_and_surfaces_are_replaced_at_once(graph, lab):
    assert set_objects(graph, cube("old")).success
    answer = set_objects(graph, cube("a", 0.3), cube("b", 3.2, automatic=True), surfaces=[shelf()])
    assert answer.success, answer.message
    assert answer.code == answers.CONTENTS_SET.code
    # Where the lab found a place for it: on the floor, beside nothing.
    assert answer.objects[1].pose.position.z == pytest.approx(0.0255, abs=0.001)
    assert not answer.objects[1].automatic
    now = get_objects(graph)
    assert (names(now.objects), names(now.surfaces)) == (["a", "b"], ["shelf", "floor"])
    wait_for(lambda: lab.objects and names(lab.objects[-1].objects) == ["a", "b"], "the objects")
    wait_for(lambda: names(lab.surfaces[-1].surfaces) == ["shelf", "floor"], "the surfaces")
    again = set_objects(graph, *now.objects, surfaces=now.surfaces)
    assert again.success, again.message
    assert names(get_objects(graph).objects) == ["a", "b"]


def test_a_dry_run_and_a_refusal_change_nothing(graph, lab):
    assert set_objects(graph, cube("old"), surfaces=[shelf()]).success
    before = get_objects(graph)
    answer = set_objects(graph, cube("a", 0.3), dry_run=True)
    assert (answer.success, answer.code) == (True, answers.CONTENTS_FIT.code)
    crowd = [cube(f"c{i}", 0.1 * i) for i in range(33)]
    for objects, surfaces, code in (
        ([cube("a"), msg.ObjectPlacement(name="b", type="cow")], [], physics.NO_OBJECT_TYPE),
        ([cube("a"), cube("a")], [], base.NAME_TAKEN),
        ([cube("A")], [], base.BAD_NAME),
        ([cube("a", 1e6)], [], base.BAD_VECTOR),
        ([cube("a", float("nan"))], [], base.POSE_NOT_FINITE),
        (crowd, [], answers.TOO_MANY_OBJECTS),
        ([cube("a")], [msg.Surface()], SURFACE_WITHOUT_NAME),
        ([cube("a")], [shelf(), shelf()], SURFACES_OF_ONE_NAME),
        (
            [msg.ObjectPlacement(name="a", type="table", held_by="r", in_hand=pose(0, 0, 0))],
            [],
            answers.CANNOT_HOLD_FIXED,
        ),
    ):
        for dry_run in (True, False):
            answer = set_objects(graph, *objects, surfaces=surfaces, dry_run=dry_run)
            assert not answer.success
            assert answer.code == code.code, answer.message
    now = get_objects(graph)
    assert (names(now.objects), names(now.surfaces)) == (
        names(before.objects),
        names(before.surfaces),
    )


def test_an_object_waits_in_the_air_for_the_robot_that_is_to_hold_it(graph, lab):
    held = cube("a", 1.0, held_by="ur5e_1", in_hand=pose(0.0, 0.0, 0.08))
    held.pose.position.z = 1.5
    assert set_objects(graph, held).success
    (waiting,) = get_objects(graph).objects
    assert waiting.held_by == "ur5e_1"
    assert waiting.pose.position.z == pytest.approx(1.5, abs=0.001)
    wait_for(
        lambda: lab.objects and any(o.held_by == "hand" for o in lab.objects[-1].objects),
        "the hand",
    )
    graph.add(LabNode)
    graph.add(PlaybackHostNode)
    answer = graph.call(
        srv.SpawnRobot, "/lab/spawn_robot", model="ur5e", end_effector="vacuum_cup"
    )
    assert answer.robot.name == "ur5e_1"
    wait_for(lambda: lab.objects[-1].objects[0].held_by == "ur5e_1", "the robot to hold it")
    (now,) = get_objects(graph).objects
    assert now.held_by == "ur5e_1"
    assert now.in_hand.position.z == pytest.approx(0.08, abs=1e-6)


def test_physics_offers_nothing_of_robots_or_scenes(graph, lab):
    offered = {
        name
        for name, _ in graph.client.get_service_names_and_types_by_node("physics", "/")
        if "parameter" not in name and "type_description" not in name
    }
    assert offered == {
        f"/physics/{name}"
        for name in (
            "spawn_object", "move_object", "remove_object", "clear_objects", "list_catalogue",
            "get_objects", "set_objects", "set_surfaces", "attach", "detach",
        )
    }  # fmt: skip


WHOLE = {"truncated": b'{"objects": [{"na', "types": b"[7, 8]", "binary": bytes(range(256))}


@pytest.mark.parametrize("content", WHOLE.values(), ids=WHOLE)
def test_physics_starts_with_a_damaged_file(graph, tmp_path, content, capfd):
    (tmp_path / "physics.json").write_bytes(content)
    graph.add(PhysicsNode, state_dir=str(tmp_path))
    assert set_objects(graph, cube("a")).success
    (aside,) = tmp_path.glob("physics.json.damaged-*")
    assert aside.read_bytes() == content
    said = capfd.readouterr().err
    assert "[ERROR]" in said
    assert aside.name in said


def test_physics_leaves_out_what_cannot_be_and_names_it(graph, tmp_path, capfd):
    thing = {"name": "a", "type": "cube", "position": [0.5, 0, 0.025]}
    floor = {"vertices": [[0, 0, 0], [1, 0, 0], [0, 1, 0]], "position": [3, 0, 0.5]}
    (tmp_path / "physics.json").write_text(
        json.dumps(
            {
                "objects": [
                    thing,
                    {**thing, "name": "b", "type": "cow"},
                    {**thing, "name": "c", "position": [1e300, 0, 0]},
                    {**thing, "name": "d", "position": [float("nan"), 0, 0]},
                    {**thing, "name": "e", "position": [1.5, 0, 0.025]},
                ],
                "surfaces": [
                    {"name": "shelf", **floor},
                    {"name": "line", "vertices": [[0, 0, 0], [1, 0, 0], [2, 0, 0]]},
                ],
            }
        )
    )
    graph.add(PhysicsNode, state_dir=str(tmp_path))
    now = get_objects(graph)
    assert (names(now.objects), names(now.surfaces)) == (["a", "e"], ["shelf", "floor"])
    said = capfd.readouterr().err
    for words in ("object 4: position is", "no object 'cow'", "c: The position", "is a line"):
        assert words in said, words
