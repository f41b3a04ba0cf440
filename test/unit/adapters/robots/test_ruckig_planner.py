"""Motions to the start: exact ends, inside the limits, smooth."""

from __future__ import annotations

import numpy as np
from fakes import make_model
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from refusals import refused

from mrlab_ros.adapters.robots.diagnostics import MOTION_SIZE
from mrlab_ros.adapters.robots.ruckig_planner import RuckigPlanner, StagingLimits
from mrlab_ros.core.base.errors import BadInput

LIMITS = StagingLimits(velocity_share=0.5, acceleration=6.0, jerk=30.0)
pose = arrays(np.float64, 6, elements=st.floats(-3, 3))


@given(pose, pose)
def test_a_motion_leads_from_rest_to_rest_inside_the_limits(start, goal):
    model = make_model(6)
    motion = RuckigPlanner(LIMITS).plan(model, start, goal)
    assert np.allclose(motion.at(0.0)[0], start, rtol=0, atol=1e-12)
    assert np.array_equal(motion.at(motion.duration)[0], goal)
    assert not motion.at(-1.0)[1].any()
    assert not motion.at(motion.duration + 1.0)[1].any()
    times = np.linspace(0, motion.duration, 500)
    velocities = np.array([motion.at(t)[1] for t in times])
    assert np.abs(velocities).max() <= 0.5 * 2.0 + 1e-6
    if motion.duration > 0:
        accelerations = np.diff(velocities, axis=0) / (times[1] - times[0])
        assert np.abs(accelerations).max() <= 6.0 + 1e-3


def test_standing_there_already_takes_no_time():
    model = make_model(6)
    assert RuckigPlanner().plan(model, model.home, model.home).duration == 0.0


def test_a_goal_for_another_arm_is_refused():
    with refused(MOTION_SIZE, BadInput, joints=6):
        RuckigPlanner().plan(make_model(6), np.zeros(6), np.zeros(7))
