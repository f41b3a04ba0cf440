"""How a motion begins and ends."""

from __future__ import annotations

import numpy as np
from made_motions import QUINTIC, checked, outcome, reach

TOOL = reach().figures.tool


def test_no_angle_at_all_is_an_angle():
    off = checked(reach(joints=(0.01, 0, 0, 0, 0, 0)))
    assert outcome("ends at home", off).share == 1.0
    assert outcome("ends at home within 0 deg", off).share == 0.0


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
