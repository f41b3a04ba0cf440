"""What can be undone, for how long, and what comes back."""

from __future__ import annotations

import pytest
from refusals import refused

from mrlab_ros.core.base.diagnostic import INFO, Code
from mrlab_ros.core.base.errors import Misuse
from mrlab_ros.core.base.geometry import Pose
from mrlab_ros.core.scene.diagnostics import NO_ACT_TO_UNDO
from mrlab_ros.core.scene.document import (
    MemberEntry,
    ObjectEntry,
    RobotEntry,
    SceneDocument,
    SystemEntry,
)
from mrlab_ros.core.scene.restore import (
    AddObjects,
    CreateSystem,
    LoadTrajectory,
    Present,
    SpawnRobots,
    plan_scene,
)
from mrlab_ros.core.scene.undo import UNDO_S, Acts, plan_undo, removed_with

A = RobotEntry("a", "ur5e", "", Pose(), "wave", 0.5)
B = RobotEntry("b", "ur5e", "", Pose(), "wave")
C = RobotEntry("c", "ur5e", "", Pose())
ROD = ObjectEntry("rod", "rod", Pose(), held_by="a")
CELL = SystemEntry("cell", (MemberEntry("b", "kick"), MemberEntry("c", "wave")))
SCENE = SceneDocument((A, B, C), (), (), (CELL,))
SAID = Code("said", "Done.", severity=INFO, meaning="x")()


def test_each_act_can_be_undone_once_in_any_order_until_it_is_too_old():
    acts = Acts()
    assert acts.newest(0.0) is None
    acts.note(SAID, removed_with("a", SCENE), 0.0)
    acts.note(SAID, removed_with("b", SCENE), 1.0)
    first, second = acts.take("1", 2.0), acts.take("", 2.0)
    assert [robot.name for robot in first.lost.robots] == ["a"]
    assert (second.lost.robots, second.lost.systems) == ((B,), (CELL,))
    for id in ("1", "2", "", "cow"):
        with refused(NO_ACT_TO_UNDO, Misuse, limit=UNDO_S):
            acts.take(id, 2.0)
    acts.note(SAID, SCENE, 3.0)
    assert acts.newest(3.0 + UNDO_S) is None


def test_what_could_not_be_undone_can_be_tried_again_until_it_is_too_old():
    acts = Acts()
    acts.note(SAID, removed_with("a", SCENE), 0.0)
    act = acts.take("", 1.0)
    acts.note(SAID, removed_with("b", SCENE), 2.0)
    acts.give_back(act)
    assert [acts.take("", 3.0).id, acts.take("", 3.0).id] == ["2", "1"]
    acts.give_back(act)
    assert acts.newest(UNDO_S) is None


def test_a_scene_that_is_loaded_ends_what_could_be_undone_of_the_one_before():
    acts = Acts()
    acts.note(SAID, SceneDocument((A,)), 0.0)
    acts.note(SAID, SCENE, 1.0, whole=True)
    act = acts.take("", 2.0)
    present = Present(frozenset({"other"}), physics=True)
    assert plan_undo(act, present) == plan_scene(SCENE, present)
    with pytest.raises(Misuse):
        acts.take("", 2.0)
    # Nothing was lost: nothing can come back.
    acts.note(SAID, SceneDocument(), 3.0, whole=True)
    assert acts.newest(3.0) is None


def test_what_was_removed_comes_back_and_what_took_its_name_stays():
    acts = Acts()
    acts.note(SAID, removed_with("b", SCENE), 0.0)
    act = acts.take("", 1.0)
    assert plan_undo(act, Present(frozenset("ac"))) == (SpawnRobots((B,)), CreateSystem(CELL))
    # Another b is there now, and c has gone: the system cannot be.
    assert plan_undo(act, Present(frozenset("ab"))) == ()
    acts.note(SAID, removed_with("a", SCENE), 0.0)
    assert plan_undo(acts.take("", 1.0), Present()) == (SpawnRobots((A,)), LoadTrajectory(A))
    acts.note(SAID, SceneDocument(objects=(ROD,)), 0.0)
    act = acts.take("", 1.0)
    assert plan_undo(act, Present(frozenset("a"), physics=True)) == (AddObjects((ROD,)),)
    (put,) = plan_undo(act, Present(physics=True))
    assert isinstance(put, AddObjects)
    assert put.objects[0].held_by == ""
    assert plan_undo(act, Present()) == ()
