"""What can be undone, for how long, and what comes back."""

from __future__ import annotations

import pytest
from refusals import refused

from mrlab_ros.core.base.diagnostic import INFO, Code
from mrlab_ros.core.base.errors import Misuse
from mrlab_ros.core.base.geometry import Pose
from mrlab_ros.core.scene.diagnostics import NO_ACT_TO_UNDO, UNDONE
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
    Grip,
    LoadTrajectory,
    Present,
    SpawnRobots,
    plan_scene,
)
from mrlab_ros.core.scene.undo import UNDO_S, Act, Acts, opposite, plan_undo, removed_with

A = RobotEntry("a", "ur5e", "", Pose(), "wave", 0.5)
B = RobotEntry("b", "ur5e", "", Pose(), "wave")
C = RobotEntry("c", "ur5e", "", Pose())
ROD = ObjectEntry("rod", "rod", Pose(), held_by="a")
CELL = SystemEntry("cell", (MemberEntry("b", "kick"), MemberEntry("c", "wave")))
SCENE = SceneDocument((A, B, C), (), (), (CELL,))
SAID = Code("said", "Done.", severity=INFO, meaning="x")()


def acts_of(*noted: tuple[SceneDocument, bool]) -> Acts:
    """Return acts that are a second apart."""
    acts = Acts()
    for i, (lost, whole) in enumerate(noted):
        acts.note(SAID, lost, float(i), whole=whole)
    return acts


def undo(acts: Acts, now: float, id: str = "") -> Act:
    act = acts.find(id, now)
    acts.undone(act, now)
    return act


def test_each_act_can_be_undone_once_in_any_order_until_it_is_too_old():
    acts = Acts()
    assert acts.newest(0.0) is None
    acts.note(SAID, removed_with("a", SCENE, [ROD]), 0.0)
    first = acts.newest(0.5)
    acts.note(SAID, removed_with("b", SCENE, [ROD]), 1.0)
    second = acts.newest(1.5)
    assert undo(acts, 2.0, first.id) == first
    undo(acts, 2.0)
    assert [robot.name for robot in first.lost.robots] == ["a"]
    assert (second.lost.robots, second.lost.systems) == ((B,), (CELL,))
    assert (first.lost.objects, second.lost.objects) == ((ROD,), ())
    for id in (first.id, second.id, "", "cow"):
        with refused(NO_ACT_TO_UNDO, Misuse, limit=UNDO_S):
            acts.find(id, 2.0)
    acts.note(SAID, SCENE, 3.0)
    assert acts.newest(3.0 + UNDO_S) is None
    # Nothing was lost: nothing can come back.
    acts.note(SAID, SceneDocument(), 20.0)
    assert acts.newest(20.0) is None


def test_the_act_before_can_be_undone_as_long_as_a_new_one():
    acts = acts_of((SceneDocument((A,)), False), (SceneDocument((B,)), False))
    undo(acts, UNDO_S - 0.5)
    assert acts.find("", UNDO_S + 5).lost.robots == (A,)


def test_what_could_not_be_undone_can_be_tried_again():
    acts = acts_of((removed_with("a", SCENE), False))
    act = acts.find("", 1.0)
    acts.failed(act, {"a"}, 1.0)
    # The robot came back, but not what it had loaded.
    assert plan_undo(acts.find("", 2.0), Present(frozenset("a"))) == ((LoadTrajectory(A),), ())
    assert acts.newest(1.0 + UNDO_S) is None


def test_acts_come_back_with_the_scene_that_another_replaced_and_so_does_the_other():
    first, second, third = (SceneDocument((robot,)) for robot in (A, B, C))
    acts = acts_of((first, True), (SceneDocument(objects=(ROD,)), False))
    part = acts.newest(2.0)
    acts.note(SAID, second, 2.0, whole=True)
    act = acts.find("", 3.0)
    present = Present(frozenset({"other"}), physics=True)
    assert plan_undo(act, present) == (plan_scene(second, present), ())
    # It is a part of a scene that is gone.
    with pytest.raises(Misuse):
        acts.find(part.id, 3.0)
    acts.undone(act, 3.0, replaced=third)
    assert undo(acts, 4.0).lost.objects == (ROD,)
    act = acts.find("", 5.0)
    acts.undone(act, 5.0, replaced=second)
    assert act.lost == first
    # Who goes on comes round: to what the first undo replaced, and what the second did.
    again = undo(acts, 6.0)
    assert (again.lost, again.said) == (third, UNDONE(act=SAID))
    assert opposite(again.said) == SAID
    assert undo(acts, 6.0).lost == second


def test_what_was_removed_comes_back_and_what_took_its_name_stays():
    act = acts_of((removed_with("b", SCENE), False)).find("", 1.0)
    assert plan_undo(act, Present(frozenset("ac"))) == (
        (SpawnRobots((B,)), CreateSystem(CELL)),
        (),
    )
    alone = (SpawnRobots((B,)), LoadTrajectory(B))
    # c has gone: the system cannot be.
    assert plan_undo(act, Present(frozenset("a"))) == (alone, ("cell",))
    # Another b is there now.
    assert plan_undo(act, Present(frozenset("ab"))) == ((), ("b", "cell"))
    taken = Present(frozenset("ac"), systems=frozenset({"cell"}))
    assert plan_undo(act, taken) == (alone, ("cell",))


def test_what_a_robot_held_comes_back_into_its_hand():
    act = acts_of((removed_with("a", SCENE, [ROD]), False)).find("", 1.0)
    back = (SpawnRobots((A,)), LoadTrajectory(A))
    lies = Present(physics=True, objects={"rod": ""})
    assert plan_undo(act, lies) == ((*back, Grip((ROD,))), ())
    # Physics has not noticed yet that the robot left.
    falls = Present(physics=True, objects={"rod": "a"})
    assert plan_undo(act, falls) == ((*back, Grip((ROD,))), ())
    # Somebody else has it, or it is gone.
    for objects in ({"rod": "b"}, {}):
        assert plan_undo(act, Present(physics=True, objects=objects)) == (back, ("rod",))


def test_objects_that_were_taken_out_come_back():
    act = acts_of((SceneDocument(objects=(ROD,)), False)).find("", 1.0)
    assert plan_undo(act, Present(frozenset("a"), physics=True)) == ((AddObjects((ROD,)),), ())
    (put,), _ = plan_undo(act, Present(physics=True))
    assert isinstance(put, AddObjects)
    assert put.objects[0].held_by == ""
    assert plan_undo(act, Present()) == ((), ("rod",))
    assert plan_undo(act, Present(physics=True, objects={"rod": ""})) == ((), ("rod",))
