"""Places and poses that the tool passes."""

from __future__ import annotations

import numpy as np
import pytest
from made_motions import checked, outcome, reach

TOOL = reach().figures.tool


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
