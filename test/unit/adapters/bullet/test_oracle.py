"""The same motions in MuJoCo, where friction alone holds: objects go the same ways."""

from __future__ import annotations

import pytest

pytest.importorskip("mujoco")

from physics_oracle import gaps

# m: the most on the way, and at the end.
BOUNDS = {
    "pick": (0.003, 0.002),
    "swing": (0.015, 0.004),
    "throw": (0.03, 0.02),
    "hand-over": (0.006, 0.003),
}


@pytest.mark.slow
@pytest.mark.parametrize("name", list(BOUNDS))
def test_an_object_goes_as_in_mujoco(name):
    gap = gaps(name)
    most, end = BOUNDS[name]
    assert gap.max() < most, gap.max()
    assert gap[-1] < end, gap[-1]
