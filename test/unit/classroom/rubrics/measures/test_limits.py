"""Shares of the limits of joints."""

from __future__ import annotations

import numpy as np
import pytest
from made_motions import MODEL, checked, outcome, reach

from mrlab_ros.core.base.geometry import Pose
from mrlab_ros.core.checking.check_record import Motion
from mrlab_ros.core.checking.joint_limits import StatedLimits
from mrlab_ros.core.checking.motion import CheckedRobot


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
