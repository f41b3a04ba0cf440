"""The states of a gripper along a motion: steps, which are never interpolated.

A gripper is open or closed. Each state holds from its frame until the next frame. Joint positions
are interpolated in `Trajectory.at`.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

States = NDArray[np.bool_]


def state_at(states: States, frame: int) -> bool:
    """Return whether the gripper is closed at an instant from `frame` until the next frame."""
    return bool(states[frame])


def states_at(states: States, frames: NDArray[np.intp]) -> States:
    """Return the states at instants, each of which lies in a frame or between it and the next."""
    return states[frames]


def changes(states: States) -> tuple[tuple[int, bool], ...]:
    """Return (frame, closed) for each frame at which the gripper changes its state.

    A gripper that is closed from the first frame on closes at frame 0.
    """
    before = np.concatenate([[False], states[:-1]])
    return tuple((int(frame), bool(states[frame])) for frame in np.flatnonzero(states != before))
