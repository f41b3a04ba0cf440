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


@pytest.mark.parametrize("expect", ["joints within 1 deg", "tool within 5 mm RMS"])
def test_what_of_the_reference_nobody_did_counts(expect):
    whole = reach().trajectory
    for rows in (slice(None, 40), slice(None, 150), slice(120, None)):
        short = checked(reach(progress=QUINTIC[rows]))
        lost = outcome(f"{expect} of the reference", short, checked())
        assert lost.share == 0.0
        assert 0 <= lost.time <= whole.frame_count / whole.frame_rate


def test_a_motion_that_does_more_than_the_reference_is_as_far_from_it():
    first = checked(reach(progress=QUINTIC[:120]))
    more = outcome("joints within 1 deg of the reference", checked(), first).found.value
    less = outcome("joints within 1 deg of the reference", first, checked()).found.value
    assert more == pytest.approx(less, abs=1e-3)
