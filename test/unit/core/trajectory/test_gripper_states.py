"""Gripper states are steps: each holds until the next frame."""

from __future__ import annotations

import numpy as np

from mrlab_ros.core.trajectory import gripper_states

STATES = np.array([True, True, False, True])


def test_a_state_holds_from_its_frame():
    assert [gripper_states.state_at(STATES, frame) for frame in range(4)] == STATES.tolist()
    shown = gripper_states.states_at(STATES, np.array([0, 2, 2, 3]))
    assert shown.tolist() == [True, False, False, True]


def test_changes_begin_at_frame_zero_where_the_gripper_is_closed():
    assert gripper_states.changes(STATES) == ((0, True), (2, False), (3, True))
    assert gripper_states.changes(np.array([False, False])) == ()
