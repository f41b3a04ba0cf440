"""The one restore: which steps a document leads to, and what a failure names."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from refusals import refused

from mrlab_ros.core.base.errors import BadInput, Misuse
from mrlab_ros.core.base.geometry import Pose
from mrlab_ros.core.scene import diagnostics as codes
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
from mrlab_ros.core.scene.surfaces import Surface
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
    assert restore.left_out(SCENE, present) is None


def test_without_physics_robots_and_systems_come_and_the_rest_is_named():
    present = Present()
    assert plan_scene(SCENE, present) == (
        SpawnRobots((A, B, C)),
        LoadTrajectory(A),
        CreateSystem(CELL),
    )
    assert restore.left_out(SCENE, present) == codes.CONTENTS_LEFT_OUT(objects=2, surfaces=1)
    one = SceneDocument(objects=(CUBE,))
    assert restore.left_out(one, present) == codes.CONTENTS_LEFT_OUT(objects=1, surfaces=0)
    assert restore.left_out(SceneDocument((A,)), present) is None


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
            raise Misuse("gone")
        done.append(step)

    with refused(
        codes.LOADED_IN_PART,
        done=[
            codes.SET_CONTENTS(objects=2, surfaces=1),
            codes.SPAWN_ROBOTS(robots=["a", "b", "c"]),
        ],
        why=codes.STEP_FAILED(
            step=codes.LOAD_TRAJECTORY(trajectory="wave", robot="a"), why=Misuse("gone")
        ),
        rest=[
            codes.CREATE_SYSTEM(system="cell"),
            codes.GRIP_OBJECTS(robots=["a"], objects=["rod_1"]),
        ],
    ):
        restore.run(plan_scene(SCENE, Present(physics=True)), execute)
    assert len(done) == 2
    with refused(codes.LOADED_IN_PART, done=[], rest=[]):
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
    ("scene", "code", "values"),
    [
        (
            SceneDocument((replace(A, trajectory="x"),)),
            codes.TRAJECTORY_NOT_FITTING,
            {"robot": "a", "trajectory": "x", "known": ["wave", "kick"]},
        ),
        (
            SceneDocument((replace(A, at=1.5),)),
            codes.POSITION_BEYOND,
            {"trajectory": "wave", "position": 1.5, "duration": 1.0, "most": 1.0},
        ),
        (system(MemberEntry("c")), codes.NO_TRAJECTORY_NAMED, {"system": "cell", "robot": "c"}),
        (system(MemberEntry("c", "x")), codes.TRAJECTORY_NOT_FITTING, {"robot": "c"}),
    ],
)
def test_trajectories_that_cannot_be_are_refused_before_anything_changes(scene, code, values):
    with refused(code, BadInput, **values):
        check_trajectories(scene, lambda robot: CATALOGUE)


@pytest.mark.parametrize("wait", ["frame 101: object o free", "frame 0: after d.frame 3"])
def test_waits_that_cannot_be_are_refused_before_anything_changes(wait):
    with pytest.raises(BadInput):
        check_trajectories(system(MemberEntry("c", "wave", 0.0, (wait,))), lambda robot: CATALOGUE)


def test_trajectories_that_can_be_are_asked_for_once_a_robot():
    asked = []

    def catalogue(robot):
        asked.append(robot.name)
        return CATALOGUE

    check_trajectories(SCENE, catalogue)
    assert sorted(asked) == ["a", "b", "c"]
    check_trajectories(SceneDocument((C,), (CUBE,)), catalogue)
    assert len(asked) == 3
