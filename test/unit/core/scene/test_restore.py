"""The one restore: which steps a document leads to, and what a failure names."""

from __future__ import annotations

import re
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mrlab_ros.core.errors import BadInput, LabError, Misuse
from mrlab_ros.core.geometry import Pose
from mrlab_ros.core.physics.surfaces import Surface
from mrlab_ros.core.scene import restore
from mrlab_ros.core.scene.document import (
    MemberEntry,
    ObjectEntry,
    RobotEntry,
    SceneDocument,
    SystemEntry,
)
from mrlab_ros.core.scene.restore import (
    AwaitGrasps,
    CreateSystem,
    DissolveSystems,
    LoadTrajectory,
    Present,
    RemoveRobots,
    SetObjects,
    SpawnRobots,
    check_trajectories,
    plan_return,
    plan_scene,
)
from mrlab_ros.core.systems.members import Loaded

A = RobotEntry("a", "ur5e", "", Pose(), "wave", 0.5)
B = RobotEntry("b", "ur5e", "", Pose(), "wave")
C = RobotEntry("c", "ur5e", "", Pose())
CUBE = ObjectEntry("cube_1", "cube", Pose())
ROD = ObjectEntry("rod_1", "rod", Pose(), held_by="a", in_hand=Pose())
TABLE = Surface("table", "table", Pose(), np.eye(3), np.zeros((0, 3), np.int32))
CELL = SystemEntry("cell", (MemberEntry("b", "kick"), MemberEntry("c", "wave")))
SCENE = SceneDocument((A, B, C), (CUBE, ROD), (TABLE,), (CELL,))


def test_a_scene_replaces_all_that_is_there_in_an_order_that_works():
    present = Present(frozenset({"z", "a"}), {"a": "wave"}, frozenset({"old"}), physics=True)
    assert plan_scene(SCENE, present) == (
        DissolveSystems(("old",)),
        RemoveRobots(("a", "z")),
        SetObjects((CUBE, ROD), (TABLE,)),
        SpawnRobots((A, B, C)),
        # A member's trajectory is its system's to load.
        LoadTrajectory(A),
        CreateSystem(CELL),
        AwaitGrasps((ROD,)),
    )
    assert restore.left_out(SCENE, present) == ""


def test_without_physics_robots_and_systems_come_and_the_rest_is_named():
    present = Present()
    assert plan_scene(SCENE, present) == (
        SpawnRobots((A, B, C)),
        LoadTrajectory(A),
        CreateSystem(CELL),
    )
    said = restore.left_out(SCENE, present)
    assert said == "2 objects and 1 surface are left out: no physics runs"
    one = SceneDocument(objects=(CUBE,))
    assert restore.left_out(one, present) == "1 object is left out: no physics runs"
    assert restore.left_out(SceneDocument((A,)), present) == ""


def test_an_empty_scene_clears_the_objects():
    assert plan_scene(SceneDocument(), Present(physics=True)) == (SetObjects((), ()),)
    assert plan_scene(SceneDocument(), Present()) == ()


def test_a_return_leaves_alone_what_is_there():
    robots = frozenset({"a", "b", "c"})
    assert plan_return(SCENE, Present(robots, {"a": "other"}, frozenset({"cell"}))) == ()
    assert plan_return(SCENE, Present(robots, {"a": ""})) == (
        LoadTrajectory(A),
        CreateSystem(CELL),
    )
    assert plan_return(SCENE, Present(frozenset({"a"}), {"a": "wave"})) == (
        SpawnRobots((B, C)),
        CreateSystem(CELL),
    )


def test_a_member_that_names_nothing_plays_what_its_robot_has():
    cell = SystemEntry("cell", (MemberEntry("a"),))
    (_, create) = plan_scene(SceneDocument((A,), systems=(cell,)), Present())
    assert create == CreateSystem(SystemEntry("cell", (MemberEntry("a", "wave"),)))


names = st.sampled_from(["a", "b", "c", "d"])


@given(st.sets(names), st.dictionaries(names, st.sampled_from(["", "wave"])), st.booleans())
def test_after_a_return_nothing_more_is_to_be_done(robots, loaded, system):
    present = Present(frozenset(robots), loaded, frozenset({"cell"} if system else ()))
    steps = plan_return(SCENE, present)
    robots, systems, loaded = set(robots), set(present.systems), dict(loaded)
    for step in steps:
        match step:
            case SpawnRobots(new):
                assert not robots & {robot.name for robot in new}
                robots |= {robot.name for robot in new}
            case LoadTrajectory(robot):
                assert robot.name in robots
                loaded[robot.name] = robot.trajectory
            case CreateSystem(made):
                assert {m.robot for m in made.members} <= robots
                systems.add(made.name)
    assert plan_return(SCENE, Present(frozenset(robots), loaded, frozenset(systems))) == ()


def test_a_failure_names_what_was_done_and_what_was_not():
    done = []

    def execute(step):
        if isinstance(step, LoadTrajectory):
            raise Misuse("the catalogue is gone")
        done.append(step)

    with pytest.raises(LabError) as caught:
        restore.run(plan_scene(SCENE, Present(physics=True)), execute)
    assert str(caught.value) == (
        "the scene is loaded in part. Done: set 2 objects and 1 surface; spawn a, b, c. Failed: "
        "load wave into a: the catalogue is gone. Not tried: create the system cell; grip rod_1 "
        "with a. Load it again"
    )
    assert len(done) == 2
    with pytest.raises(LabError, match="Done: nothing. Failed: spawn a: x. Load it again"):
        restore.run([SpawnRobots((A,))], lambda _: (_ for _ in ()).throw(Misuse("x")))


def test_what_is_about_to_be_restored_counts_as_there():
    now = SceneDocument((replace(A, trajectory="", at=0.0), B))
    merged = restore.with_pending(now, SceneDocument((A,), systems=(CELL,)))
    assert merged == SceneDocument((A, B), systems=(CELL,))
    # Where it stands now counts; a robot that was removed meanwhile does not come back.
    moved = SceneDocument((replace(C, pose=Pose((1.0, 0.0, 0.0))),), systems=(CELL,))
    assert restore.with_pending(moved, SceneDocument((A, replace(C, trajectory="kick")))) == (
        SceneDocument(
            (replace(moved.robots[0], trajectory="kick"),), systems=(CELL,)
        )
    )  # fmt: skip


def test_what_names_a_robot_that_just_left_is_no_part_of_a_scene():
    kept = restore.self_contained(replace(SCENE, robots=(B,)))
    assert kept == SceneDocument(
        (B,), (CUBE, replace(ROD, held_by="", in_hand=None)), (TABLE,)
    )  # fmt: skip
    assert restore.self_contained(SCENE) == SCENE


CATALOGUE = [Loaded("wave", 1.0, 100.0), Loaded("kick", 2.0, 100.0)]


def system(*members: MemberEntry) -> SceneDocument:
    return SceneDocument((C, replace(C, name="d")), systems=(SystemEntry("cell", members),))


@pytest.mark.parametrize(
    ("scene", "says"),
    [
        (
            SceneDocument((replace(A, trajectory="x"),)),
            "wants a to play 'x', which the catalogue does not have for it; there are: wave, kick",
        ),
        (
            SceneDocument((replace(A, at=1.5),)),
            "'wave', which lasts 1 s; set at to 1.0 at most",
        ),
        (system(MemberEntry("c")), "the system cell names no trajectory for c"),
        (system(MemberEntry("c", "x")), "wants c to play 'x'"),
        (
            system(MemberEntry("c", "wave", 0.0, ("frame 101: object o free",))),
            "c waits at frame 101, its trajectory has frames 0 to 100",
        ),
        (
            system(MemberEntry("c", "wave", 0.0, ("frame 0: after d.frame 3",))),
            "names d; expected a member of the system: c",
        ),
    ],
)
def test_trajectories_that_cannot_be_are_refused_before_anything_changes(scene, says):
    with pytest.raises(BadInput, match=re.escape(says)):
        check_trajectories(scene, lambda robot: CATALOGUE)


def test_trajectories_that_can_be_are_asked_for_once_a_robot():
    asked = []

    def catalogue(robot):
        asked.append(robot.name)
        return CATALOGUE

    check_trajectories(SCENE, catalogue)
    assert sorted(asked) == ["a", "b", "c"]
    check_trajectories(SceneDocument((C,), (CUBE,)), catalogue)
    assert len(asked) == 3
