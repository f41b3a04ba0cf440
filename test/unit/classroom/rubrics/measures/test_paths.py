"""Figures of the path."""

from __future__ import annotations

import numpy as np
import pytest
from made_motions import QUINTIC, checked, outcome, reach


@pytest.mark.parametrize(
    "sentence",
    ["smoothness > -9", "path length < 9 m", "tool speed < 1 m/s", "cycle < 9 s",
     "total time < 9 s", "within 100% of limits"],
)  # fmt: skip
def test_a_robot_that_stands_still_earns_nothing(sentence):
    lost = outcome(sentence, checked(reach(joints=(0.0,) * 6)))
    assert (lost.share, lost.found.code) == (0.0, "stands_still")


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
