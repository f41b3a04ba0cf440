"""What each measure finds: shares, values, and the instant of lost points."""

from __future__ import annotations

import numpy as np
import pytest
from made_motions import MODEL, QUINTIC, ROBOT, checked, outcome, reach, recorded, thing

from mrlab_ros.core.base.geometry import Pose
from mrlab_ros.core.checking.checked import Motion
from mrlab_ros.core.checking.joints import StatedLimits
from mrlab_ros.core.checking.motion import CheckedRobot
from mrlab_ros.core.checking.rehearsed import Collision, Distances
from mrlab_ros.core.physics.engine import Kind, Near
from mrlab_ros.core.rubrics.grasps import STANDS

HELD = [(1.0, "CLOSING", ""), (1.5, "HOLDING", "cube_1"), (3.0, "OPEN", "")]
THINGS = {"cube_1": thing(), "bin_1": thing(0.3, 0.0)}
TOOL = reach().figures.tool


def hit(time, other="pillar_1", kind=Kind.OBJECT, robot="ur5e_1"):
    return Collision(time, robot, "wrist_3_link", kind, other, "", (0, 0, 0), 0.01)


def test_a_collision_counts_where_it_is_meant_and_at_its_first_instant():
    found = checked(record=recorded(collisions=[hit(2.0), hit(1.2, "upper_arm", Kind.SELF)]))
    lost = outcome("no collision", found)
    assert (lost.share, lost.time, lost.found.values["more"]) == (0.0, 1.2, 1)
    assert outcome("no collision with pillar_1", found).time == 2.0
    assert outcome("no collision with itself", found).time == 1.2
    assert outcome("no collision with the floor", found).share == 1.0
    assert outcome("no collision of ur5e_1", found).share == 0.0
    assert outcome("no collision", checked()).share == 1.0


def test_two_robots_that_touch_are_told_of_both():
    found = checked(record=recorded(collisions=[hit(1.0, "ur5e_1", Kind.ROBOT, "kr6_1")]))
    assert outcome("no collision of ur5e_1", found).share == 0.0
    assert outcome("no collision of ur5e_1 with kr6_1", found).share == 0.0
    assert outcome("no collision of ur5e_1 with pillar_1", found).share == 1.0


def test_to_begin_inside_a_surface_is_a_collision():
    found = checked(record=recorded(begins_inside={"ur5e_1": ("floor",)}))
    assert outcome("no collision", found).time == 0.0
    assert outcome("no collision with the floor", found).share == 0.0


def test_the_least_distance_and_when_it_is_first_too_small():
    series = Distances()
    for value in (0.4, 0.09, 0.05, 0.2):
        series.add(Near(value, "wrist_3_link"))
    found = checked(
        record=recorded(
            times=[0.0, 1.0, 2.0, 3.0], distances={("ur5e_1", (Kind.OBJECT, "bin_1")): series}
        )
    )
    assert outcome("distance to bin_1 > 4 cm", found).share == 1.0
    lost = outcome("distance to bin_1 > 10 cm", found)
    assert (lost.share, lost.time, lost.found.value) == (0.0, 1.0, 0.05)
    assert outcome("distance > 10 cm", found, partial="until 0 mm").share == pytest.approx(0.5)
    assert outcome("distance to everything but bin_1 > 10 cm", found).share == 0.0
    assert outcome("distance to cube_1 > 1 cm", found).found.code == "no_distance"


def test_what_is_picked_up_is_left_out_of_the_distance():
    series = Distances()
    for value, held in ((0.4, ""), (0.0, "cube_1"), (0.3, "cube_1"), (0.2, "")):
        series.add(Near(value, "finger_link", held))
    series.arm[1] = Near(0.02, "finger_link")
    series.arm[2] = None
    record = recorded(
        times=[0.0, 1.0, 2.0, 3.0], distances={("ur5e_1", (Kind.SURFACE, "floor")): series}
    )
    found = checked(record=record)
    assert outcome("distance > 1 mm", found).found.value == 0.0
    kept = outcome("distance to everything but cube_1 > 1 mm", found)
    assert (kept.share, kept.found.value) == (1.0, 0.02)
    lost = outcome("distance to everything but cube_1 > 10 cm", found)
    assert (lost.share, lost.time) == (0.0, 1.0)
    at = {"link": "finger_link", "value": 0.02, "kind": "surface", "other": "floor", "time": 1.0}
    assert lost.found.code == "least_distance"
    assert {name: lost.found.values[name] for name in at} == at
    assert outcome("distance to everything but bin_1 > 1 mm", found).share == 0.0


def test_a_place_of_two_numbers_is_seen_from_above():
    x, y, z = TOOL[100].tolist()
    assert outcome(f"passes within 1 mm of [{x}, {y}]", checked()).share == 1.0
    assert outcome(f"passes within 1 mm of [{x}, {y}, {z + 0.1}]", checked()).share == 0.0
    assert outcome(f"passes within 1 mm of [{x}, {y + 0.5}]", checked()).share == 0.0


def test_the_next_pose_may_come_before_the_tool_is_nearest_to_the_one_before():
    # Half the way and back a little: near all the time to where it ends, nearest at the end.
    way = float(np.linalg.norm(TOOL[-1] - TOOL[0]))
    poses = [TOOL[-1].tolist(), TOOL[100].tolist()]
    loose = outcome(f"passes within {1050 * way} mm of poses, in order", checked(), poses=poses)
    assert loose.share == 1.0
    tight = outcome("passes within 5 mm of poses, in order", checked(), poses=poses)
    assert tight.share == 0.0


@pytest.mark.parametrize(
    "sentence",
    ["ends at home", "cycle < 9 s", "passes within 9 m of [0, 0, 0]", "path length < 9 m",
     "within 100% of limits"],
)  # fmt: skip
def test_a_robot_that_waits_for_ever_has_not_played_its_motion(sentence):
    back = reach(joints=(0.0,) * 6)
    stuck = recorded(stuck={"ur5e_1": "frame 0: after kr6_1.frame 9"})
    assert outcome(sentence, checked(back)).share == 1.0
    lost = outcome(sentence, checked(back, record=stuck))
    assert lost.share == 0.0
    assert lost.found.code == "member_waits_forever"
    assert lost.found.values["wait"] == "frame 0: after kr6_1.frame 9"


def test_no_angle_at_all_is_an_angle():
    off = checked(reach(joints=(0.01, 0, 0, 0, 0, 0)))
    assert outcome("ends at home", off).share == 1.0
    assert outcome("ends at home within 0 deg", off).share == 0.0


def test_poses_are_passed_in_order_or_in_any():
    places = [TOOL[60].tolist(), TOOL[120].tolist()]
    found = checked()
    assert outcome("passes within 1 mm of poses, in order", found, poses=places).share == 1.0
    turned = places[::-1]
    assert outcome("passes within 1 mm of poses in any order", found, poses=turned).share == 1.0
    lost = outcome("passes within 1 mm of poses", found, poses=turned, partial="each")
    assert lost.share == 0.5
    assert (lost.found.code, lost.found.values["number"]) == ("pose_too_early", 2)
    assert lost.time == pytest.approx(1.2, abs=0.02)


def test_a_pose_that_is_missed_says_how_far_and_when():
    away = (TOOL[100] + np.cross(TOOL[101] - TOOL[99], [0, 0, 1])).tolist()
    off = float(np.linalg.norm(np.array(away) - TOOL[100]))
    lost = outcome(f"passes within {off * 500:.6f} mm of poses", checked(), poses=[away])
    assert lost.found.value == pytest.approx(off, rel=0.05)
    assert lost.time == pytest.approx(2.0, abs=0.1)
    assert outcome(f"passes within {off * 1001:.6f} mm of poses", checked(), poses=[away]).share


def test_a_direction_counts_where_it_is_asked_for():
    pose = reach().robot.model.chain.tool0(reach().trajectory.positions[100])
    x, y, z = pose[:3, 3].tolist()
    from mrlab_ros.core.base.geometry import pose_from_transform

    right = {"position": [x, y, z], "orientation": list(pose_from_transform(pose).orientation)}
    wrong = {"position": [x, y, z], "rpy_deg": [0, 0, 0]}
    sentence = "passes within 2 mm and 3 deg of poses"
    assert outcome(sentence, checked(), poses=[right]).share == 1.0
    assert outcome(sentence, checked(), poses=[wrong]).found.code == "pose_turned"
    assert outcome("passes within 2 mm of poses", checked(), poses=[wrong]).share == 1.0


def test_grasps_in_their_time():
    found = checked(record=recorded(HELD))
    assert outcome("grasps cube_1", found).share == 1.0
    assert outcome("grasps cube_1 between 1 and 2 s", found).share == 1.0
    late = outcome("grasps cube_1 before 1 s", found)
    assert (late.share, late.time) == (0.0, 1.5)
    assert (late.found.value, late.found.values["until"]) == (1.5, 1.0)
    early = outcome("grasps cube_1 after 2 s", found)
    assert (early.time, early.found.values["since"]) == (1.5, 2.0)
    assert outcome("grasps cube_2", found).time == 1.5
    assert outcome("grasps cube_1 by kr6_1", found).share == 0.0


@pytest.mark.parametrize(
    ("grasps", "time", "code"),
    [
        ((), 0.0, "never_grasped"),
        ([(1.0, "CLOSING", ""), (1.4, "EMPTY", "")], 1.4, "never_grasped_nothing"),
        ([(1.0, "CLOSING", "")], 1.0, "never_grasped_closes"),
        ([(1.5, "HOLDING", "cube_2")], 1.5, "never_grasped_other"),
    ],
)
def test_what_is_never_grasped_names_the_attempt(grasps, time, code):
    lost = outcome("grasps cube_1", checked(record=recorded(grasps)))
    assert (lost.share, lost.time, lost.found.code) == (0.0, time, code)


def test_holds_by_their_span_and_partly():
    found = checked(record=recorded(HELD))
    assert outcome("holds cube_1 until 3 s", found).share == 1.0
    assert outcome("holds cube_1 for 1.5 s", found).share == 1.0
    assert outcome("holds cube_1 for 3 s", found, partial="each").share == pytest.approx(0.5)
    assert outcome("holds cube_1 for 3 s", found).share == 0.0
    assert outcome("holds cube_1 until the end", found).time == pytest.approx(3.0)
    assert outcome("holds cube_1 from 1 to 2 s", found, partial="each").share == 0.5
    assert outcome("holds cube_1 from 1 to 2 s", found).time == pytest.approx(1.0)
    late = outcome("holds cube_1 until 1 s", found)
    assert (late.share, late.found.code, late.time) == (0.0, "grasped_late", 1.5)


def test_the_longest_of_several_holds_counts():
    held = [(t, state, "cube_1" if state == "HOLDING" else "") for t, state in (
        (0.5, "HOLDING"), (1.0, "OPEN"), (1.5, "HOLDING"), (3.0, "OPEN"), (3.5, "HOLDING"),
        (3.75, "OPEN"),
    )]  # fmt: skip
    found = outcome("holds cube_1 for 1.5 s", checked(record=recorded(held)))
    assert (found.share, found.found.value, found.time) == (1.0, 1.5, 3.0)


def test_a_hand_over_is_no_loss():
    from mrlab_ros.core.checking.rehearsed import GraspChange
    from mrlab_ros.core.physics.grasp.states import Grasp

    record = recorded(HELD)
    record.grasps.append(GraspChange(3.0, "kr6_1", Grasp.HOLDING, "cube_1"))
    assert outcome("holds cube_1 until the end", checked(record=record)).share == 1.0


def test_releases_and_places_by_where_the_object_lies_at_rest():
    record = recorded(HELD, {"cube_1": (0.3, 0.1, 0.025), "bin_1": (0.3, 0.13, 0.15)})
    found = checked(record=record, objects=THINGS)
    assert outcome("releases cube_1 within 5 mm of [0.3, 0.1]", found).share == 1.0
    near = outcome("releases cube_1 within 5 mm of [0.31, 0.1]", found, partial="until 15 mm")
    assert near.share == pytest.approx(0.5)
    assert near.time == 3.0
    assert outcome("releases cube_1 within 4 cm of bin_1", found).share == 1.0
    assert outcome("places cube_1 on the floor", found).share == 1.0
    assert outcome("places cube_1 in bin_1", found).share == 1.0
    assert outcome("places cube_1 on bin_1", found).share == 0.0


def test_what_is_still_held_or_rolls_or_left_is_not_released():
    sentence = "places cube_1 on the floor"
    held = recorded(HELD[:2], {"cube_1": (0.3, 0.1, 0.025)})
    for each in (sentence, "releases cube_1 within 5 mm of [0.3, 0.1]"):
        assert outcome(each, checked(record=held)).found.code == "still_held"
    rolls = recorded(HELD, {"cube_1": (0.3, 0.1, 0.025)})
    rolls.objects["cube_1"].values[0] = [0.2, 0.1, 0.025, 0, 0, 0, 1]
    moves = outcome(sentence, checked(record=rolls)).found
    assert (moves.code, moves.value) == ("still_moves", pytest.approx(0.1 / 0.5))
    rolls.objects["cube_1"].values[0] = [0.3 - 0.99 * STANDS * 0.5, 0.1, 0.025, 0, 0, 0, 1]
    assert outcome(sentence, checked(record=rolls, objects=THINGS)).share == 1.0
    gone = recorded(HELD, {"cube_1": (0.3, 0.1, 0.025)}, gone=[(3.5, "cube_1")])
    assert outcome(sentence, checked(record=gone)).found.code == "not_in_the_room"


def test_nothing_is_released_at_an_object_that_is_not_there():
    record = recorded(HELD, {"cube_1": (0.3, 0.1, 0.025)})
    lost = outcome("releases cube_1 within 4 cm of bin_1", checked(record=record, objects=THINGS))
    assert (lost.share, lost.found.code, lost.time) == (0.0, "no_object_checked", 3.0)


def test_times_are_lost_from_the_limit_on():
    found = checked(record=recorded(duration=6.0))
    cycle = reach().figures.cycle
    assert outcome("cycle < 5 s", found).share == 1.0
    lost = outcome("cycle < 3 s", found, partial="until 5 s")
    assert lost.share == pytest.approx((5 - cycle) / 2)
    assert lost.time == 3.0
    assert outcome("total time < 5 s", found).found.value == 6.0
    assert outcome("total time < 6 s", found).share == 1.0


def test_the_mode_of_a_cell():
    cell = checked(extras={"system": {"mode": "parallel"}})
    assert outcome("parallel mode used", cell).share == 1.0
    assert outcome("sequential mode used", cell).found.code == "other_mode"
    assert outcome("parallel mode used", checked()).found.code == "no_cell"


def test_shares_of_the_limits():
    found = checked()
    fastest = max(j.speed_share for j in reach().figures.joints)
    speeds = outcome("within 1% of speed limits", found)
    assert speeds.found.value == pytest.approx(fastest)
    assert speeds.time == pytest.approx(2.0, abs=0.1)
    assert outcome("within 100% of limits", found).share == 1.0
    middle = checked(reach((0, 0, 0, 0, 0, 2 * np.pi * 0.9)))
    assert outcome("within 80% of ranges", middle).found.value == pytest.approx(0.9)
    assert outcome("within 80% of jerk limits", found).share == 0.0


def test_a_stated_acceleration_is_measured():
    stated = CheckedRobot(
        "ur5e_1", MODEL, "", Pose(), {n: StatedLimits(1.0) for n in MODEL.joint_names}
    )
    from mrlab_ros.core.checking.motion import figures_of

    t = reach().trajectory
    found = checked(Motion(stated, t, figures_of(t, stated)))
    most = max(j.acceleration for j in reach().figures.joints)
    measured = outcome("within 10% of acceleration limits", found).found.value
    assert measured == pytest.approx(most)


def test_figures_of_the_path():
    found = checked()
    length = reach().figures.plain()["path_length"]
    assert outcome(f"path length < {length + 0.001:.6f} m", found).share == 1.0
    lost = outcome(f"path length < {length / 2:.6f} m", found)
    assert lost.time == pytest.approx(2.0, abs=0.2)
    assert outcome("tool speed < 1 mm/s", found).time == pytest.approx(2.0, abs=0.4)
    assert outcome("smoothness > -1.6", found).share == 1.0
    stops = np.concatenate([QUINTIC / 2, 0.5 + QUINTIC / 2])
    assert outcome("smoothness > -1.6", checked(reach(progress=stops))).share == 0.0


def test_how_a_motion_begins_and_ends():
    there = checked()
    back = checked(reach(progress=np.concatenate([QUINTIC, QUINTIC[::-1]])))
    assert outcome("begins at home", there).share == 1.0
    assert outcome("ends at home", there).time == 4.0
    assert outcome("ends at home", there, partial="until 90 deg").share > 0.5
    assert outcome("ends at home", back).share == outcome("ends where it began", back).share == 1.0
    assert outcome("ends at rest", there).share == 1.0
    assert outcome("ends at rest", checked(reach(progress=QUINTIC[:100]))).share == 0.0
    x, y, z = TOOL[-1]
    assert outcome(f"ends within 1 mm of [{x}, {y}, {z}]", there).share == 1.0
    assert outcome(f"begins within 1 mm of [{x}, {y}, {z}]", there).time == 0.0


def test_a_reference_is_compared_after_alignment_in_time():
    slow = checked(reach(progress=np.interp(np.linspace(0, 200, 401), range(201), QUINTIC)))
    waits = checked(reach(progress=np.concatenate([np.zeros(150), QUINTIC, np.ones(60)])))
    other = checked(reach((0.5, -0.3, 0.2, 0.0, 0.1, 0.9)))
    for same in (slow, waits):
        assert outcome("joints within 0.5 deg of the reference", same, checked()).share == 1.0
        assert outcome("tool within 2 mm of the reference", same, checked()).share == 1.0
    lost = outcome("joints within 5 deg of the reference", other, checked())
    assert lost.found.value == pytest.approx(0.5, abs=0.01)
    assert outcome("joints within 5 deg RMS of the reference", other, checked()).found.value < 0.4
    # wrist 3 turns the tool about itself
    assert outcome("tool within 1 mm of the reference", other, checked()).share == 1.0
    assert outcome("tool within 1 mm of the reference", other).found.code == "no_reference_motion"


def test_a_robot_without_a_motion_is_named():
    found = outcome("ends at rest by kr6_1", checked()).found
    assert (found.code, found.robot) == ("no_motion_of", "kr6_1")
    assert found.values["robots"] == ["ur5e_1"]
    assert ROBOT.name == "ur5e_1"
