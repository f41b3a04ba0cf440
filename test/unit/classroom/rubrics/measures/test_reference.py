"""A motion beside the reference."""

from __future__ import annotations

import numpy as np
import pytest
from made_motions import QUINTIC, checked, outcome, reach


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
