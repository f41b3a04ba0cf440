"""`mrlab scene` and `mrlab objects` on a graph in this process."""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path

import pytest
from graph import Graph, wait_for
from typer.testing import CliRunner

from mrlab_ros import cli
from mrlab_ros.core.base.errors import LabError
from mrlab_ros.nodes.lab.node import LabNode
from mrlab_ros.nodes.physics.node import PhysicsNode
from mrlab_ros.ros import graph_node


def mrlab(*arguments: str) -> str:
    """Return what a command prints; raise what it raises."""
    result = CliRunner().invoke(cli.make_app(), arguments)
    if result.exception is not None:
        raise result.exception
    return result.stdout


def objects() -> dict[str, dict]:
    return {thing["name"]: thing for thing in json.loads(mrlab("objects", "list", "--json"))}


class ObjectSnapshot(graph_node.Graph):
    """One client for all commands: each of its own would be found by the graph anew."""

    def close(self) -> None:
        return


@pytest.fixture
def commands(graph: Graph, monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    kept = ObjectSnapshot()
    monkeypatch.setattr(graph_node, "Graph", lambda: kept)
    yield
    super(ObjectSnapshot, kept).close()


def test_objects_and_scenes_are_listed_changed_and_refused_in_words(
    graph: Graph, commands: None, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
):
    graph.add(LabNode, state_dir=str(tmp_path))
    with monkeypatch.context() as patched:
        patched.setattr(graph_node, "FIND_TIMEOUT_S", 0.5)
        with pytest.raises(LabError, match="runs without physics"):
            mrlab("objects", "list")
    graph.add(PhysicsNode, state_dir=str(tmp_path))
    assert mrlab("objects", "list").strip() == "no objects in the scene"
    types = json.loads(mrlab("objects", "types", "--json"))
    assert types["limit"] == 32
    assert "a cup, hollow and open above" in {t["about"] for t in types["types"]}
    assert "a cup" in mrlab("objects", "types")
    placed = mrlab("objects", "spawn", "table", "--at", "-0.5,0.25,0.37", "--yaw", "90")
    assert "table_1 is at" in placed
    assert "mug is at" in mrlab("objects", "spawn", "cup", "--on", "--at", "-0.5,0.25,1",
                                "--name", "mug")  # fmt: skip
    mug = wait_for(lambda: objects().get("mug"), "it in the list")
    assert mug["position"] == pytest.approx([-0.5, 0.25, 0.78], abs=0.005)
    assert "cube_1 is at" in mrlab("objects", "spawn", "cube")
    for arguments, says in (
        (("spawn", "cube", "--at", "here"), "expected x,y,z in m"),
        (("spawn", "cow"), "no object 'cow'"),
        (("remove", "cow"), "there are: table_1, mug and cube_1"),
    ):
        with pytest.raises(LabError, match=says):
            mrlab("objects", *arguments)
    assert "cube_1 is removed" in mrlab("objects", "remove", "cube_1")
    assert "Saved 0 robots, 2 objects" in mrlab("scene", "save", "lesson_1")
    assert "lesson_1" in json.loads(mrlab("scene", "list", "--json"))
    assert "2 objects are removed" in mrlab("objects", "clear")
    assert "handover" in mrlab("scene", "list").split()
    assert "Loaded lesson_1: 0 robots, 2 objects" in mrlab("scene", "load", "lesson_1")
    wait_for(lambda: objects().keys() == {"table_1", "mug"}, "both in the list")
    with pytest.raises(LabError, match="no scene 'lesson_2'"):
        mrlab("scene", "load", "lesson_2")
