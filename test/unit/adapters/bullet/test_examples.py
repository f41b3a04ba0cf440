"""The shipped examples in their scenes, in a world of their own: what they promise happens."""

from __future__ import annotations

import numpy as np
import pytest
from physics_stage import HANDOVER, LIBRARY, SCENES, Stage

from mrlab_ros.core.base.clock import SECOND
from mrlab_ros.core.physics.diagnostics import CLOSED_UNSEEN, OPENED_UNSEEN
from mrlab_ros.core.physics.grasp import kinds
from mrlab_ros.core.physics.grasp.states import Grasp
from mrlab_ros.core.physics.world_state import GraspChanged


@pytest.fixture
def stages():
    made: list[Stage] = []

    def make(*args) -> Stage:
        made.append(Stage(*args))
        return made[-1]

    yield make
    for stage in made:
        stage.engine.close()


@pytest.mark.parametrize("scene", SCENES.names())
def test_in_every_shipped_scene_the_robots_stand_free_and_the_objects_rest(stages, scene):
    stage = stages(scene)
    before = {thing.name: stage.place(thing.name) for thing in stage.world.objects}
    stage.stand(1.0)
    assert not stage.hits()
    for name, place in before.items():
        assert np.abs(stage.place(name) - place).max() < 0.003, name


@pytest.mark.slow
def test_a_cube_is_picked_carried_and_put_down_as_the_script_says(stages):
    stage = stages("pick_and_place", {"ur5e_1": "pick_and_place_ur5e"})
    start = stage.place("cube_1")
    stage.play(1.8)
    assert np.abs(stage.place("cube_1") - start).max() < 0.001
    stage.play(4.6)
    assert stage.world.object("cube_1").held_by == "ur5e_1"
    assert stage.place("cube_1")[2] > 0.1
    stage.play(7.6)
    stage.stand()
    assert stage.grasps("ur5e_1") == [Grasp.OPEN, Grasp.CLOSING, Grasp.HOLDING, Grasp.OPEN]
    assert not stage.hits()
    turn = np.radians(60)
    assert stage.place("cube_1") == pytest.approx(
        [0.46 * np.cos(turn), 0.46 * np.sin(turn), 0.025], abs=0.005
    )


@pytest.mark.parametrize("until", [5.6, 7.5, 14.0])
def test_what_was_to_be_released_while_time_was_skipped_lies_where_it_was_released(stages, until):
    stage = stages("pick_and_place", {"ur5e_1": "pick_and_place_ur5e"})
    stage.play(3.0)
    stage.events.clear()
    stage.freeze(until)
    stage.play(max(until, 7.6))
    stage.stand(0.5)
    assert stage.world.object("cube_1").held_by == ""
    assert stage.place("cube_1") == pytest.approx((0.23, 0.3984, 0.025), abs=0.002)
    assert stage.grasps("ur5e_1") == [Grasp.OPEN]
    (said,) = [e.reason for e in stage.events if isinstance(e, GraspChanged)]
    assert said == OPENED_UNSEEN(object="cube_1", robot="ur5e_1")
    assert not stage.hits()


def test_what_was_to_be_taken_while_time_was_skipped_stays_where_it_is(stages):
    stage = stages("pick_and_place", {"ur5e_1": "pick_and_place_ur5e"})
    start = stage.place("cube_1")
    stage.play(0.8)
    stage.freeze(3.8)
    stage.play(5.0)
    assert stage.grasps("ur5e_1") == [Grasp.OPEN, Grasp.CLOSING, Grasp.EMPTY]
    said = [e.reason for e in stage.events if isinstance(e, GraspChanged)]
    assert said[1:] == [CLOSED_UNSEEN(robot="ur5e_1")] * 2
    assert stage.place("cube_1") == pytest.approx(start, abs=0.001)


def test_what_is_still_to_be_held_after_time_was_skipped_stays_in_the_hand(stages):
    stage = stages("pick_and_place", {"ur5e_1": "pick_and_place_ur5e"})
    stage.play(2.6)
    stage.events.clear()
    stage.freeze(5.1)
    stage.play(5.2)
    # Neither a force of the jump nor a remark comes of it.
    assert stage.events == []
    assert stage.world.object("cube_1").held_by == "ur5e_1"
    stage.play(7.6)
    assert stage.place("cube_1") == pytest.approx((0.23, 0.3984, 0.025), abs=0.002)
    assert stage.grasps("ur5e_1") == [Grasp.OPEN]


def test_after_a_seek_the_fingers_are_at_what_is_held_and_without_them_it_falls(stages):
    stage = stages("pick_and_place", {"ur5e_1": "pick_and_place_ur5e"})
    stage.play(4.4)
    held_at = stage.world.fingers("ur5e_1")
    place = stage.place("cube_1")
    stage.seek(1.0)
    assert max(stage.world.fingers("ur5e_1").values()) < 1e-3
    stage.seek(4.2)
    assert stage.world.object("cube_1").held_by == "ur5e_1"
    assert stage.world.fingers("ur5e_1") == pytest.approx(held_at, abs=1e-4)
    place = stage.place("cube_1")

    robot = stage.world.robot("ur5e_1")
    assert stage.world.remove_robot("ur5e_1") == "cube_1"
    bare = LIBRARY.description("ur5e", "")
    said = "cube_1 was let go"
    stage.world.add_robot("ur5e_1", bare, robot.joints, robot.pose, kinds.FINGERS, reason=said)
    stage.world.set_program("ur5e_1", robot.program)
    (told,) = [e for e in stage.world.take_events() if isinstance(e, GraspChanged)]
    assert (told.state, told.object, told.reason) == (Grasp.OPEN, "", said)
    # Joint states of an arm that stands come seldom; until then it is nowhere.
    stage.now_ns += SECOND
    stage.world.advance(stage.now_ns)
    stage.events.clear()
    stage.stand(0.5)
    x, y, z = stage.place("cube_1")
    assert (x, y) == pytest.approx(tuple(place[:2]), abs=0.002)
    assert z == pytest.approx(0.025, abs=0.001)
    # A bare flange has nothing to close.
    assert not stage.grasps("ur5e_1")
    stage.seek(4.2)
    assert stage.world.object("cube_1").held_by == ""


@pytest.mark.slow
def test_scrubbing_a_run_puts_the_cube_back_where_it_was(stages):
    stage = stages("pick_and_place", {"ur5e_1": "pick_and_place_ur5e"})
    start = stage.place("cube_1")
    stage.play(7.6)
    stage.stand()
    end = stage.place("cube_1")
    stage.seek(3.5)
    assert stage.world.object("cube_1").held_by == "ur5e_1"
    hand = stage.world.hand("ur5e_1").pose.position
    # The gripper's tool centre point is 154 mm from its base.
    assert np.linalg.norm(stage.place("cube_1") - hand) == pytest.approx(0.154, abs=0.01)
    carried = stage.place("cube_1")
    stage.seek(1.0)
    assert stage.world.object("cube_1").held_by == ""
    assert np.abs(stage.place("cube_1") - start).max() < 0.002
    stage.seek(7.0)
    assert np.abs(stage.place("cube_1") - end).max() < 0.002
    stage.seek(3.5)
    assert np.abs(stage.place("cube_1") - carried).max() < 0.002
    # From there the run goes on, and puts the cube down again.
    stage.play(7.6)
    assert stage.world.object("cube_1").held_by == ""
    assert np.abs(stage.place("cube_1") - end).max() < 0.005
    assert not stage.hits()


@pytest.mark.slow
def test_a_rod_is_handed_from_one_gripper_to_the_other(stages):
    giver, taker = HANDOVER
    stage = stages("handover", HANDOVER)
    start = stage.place("rod_1")
    stage.play(4.1)
    assert stage.world.object("rod_1").held_by == giver
    before = stage.place("rod_1")
    assert before[2] == pytest.approx(0.7, abs=0.005)
    stage.play(4.6)
    assert stage.world.object("rod_1").held_by == taker
    assert np.abs(stage.place("rod_1") - before).max() < 0.002, "no jump at the change of hands"
    stage.play(5.2)
    assert stage.place("rod_1")[0] > before[0] + 0.05
    stage.play(8.0)
    stage.stand()
    open_, closing, holding, empty = Grasp.OPEN, Grasp.CLOSING, Grasp.HOLDING, Grasp.EMPTY
    assert stage.grasps(giver) == [open_, closing, holding, empty, open_]
    assert stage.grasps(taker) == [open_, closing, holding, open_]
    assert not stage.hits()
    end = stage.place("rod_1")
    assert end == pytest.approx([1.2 - 0.5 * np.cos(np.radians(40)), -0.3214, 0.08], abs=0.01)
    # Where both grippers are closed on it, it stays with the one that took it.
    stage.seek(4.6)
    stage.stand()
    assert stage.world.object("rod_1").held_by == taker
    assert stage.world.robot(giver).grasp is Grasp.EMPTY
    # Where the second is just closing it takes the rod, as it did.
    stage.seek(4.3)
    stage.play(8.0)
    stage.stand()
    assert np.abs(stage.place("rod_1") - end).max() < 0.01
    # Scrubbed together, each robot has again what it had then.
    for position, holder, place in ((6.0, taker, None), (3.0, giver, None), (1.0, "", start)):
        stage.seek(position)
        assert stage.world.object("rod_1").held_by == holder
        if place is not None:
            assert np.abs(stage.place("rod_1") - place).max() < 0.002
