"""Which playback states physics takes for a seek."""

from __future__ import annotations

import pytest

from mrlab_ros.core.base.clock import SECOND, PlaybackClock
from mrlab_ros.core.physics.simulated_robot import Playing
from mrlab_ros.core.playback.states import State

START = 100 * SECOND


def playing(state: State, after: float, position: float, rate: float = 0.0, fps: float = 1.0):
    """Return a state of a motion of 60 s that is announced `after` s."""
    clock = PlaybackClock(START + round(after * SECOND), position, rate)
    return Playing(state, "t", clock, 0, round(60 * fps) + 1, fps, 60.0)


@pytest.mark.parametrize("fps", [1.0, 2.0, 100.0])
@pytest.mark.parametrize("rate", [-2.0, 1.0, 4.0])
def test_what_playback_does_undisturbed_is_no_seek(fps: float, rate: float) -> None:
    run = playing(State.PLAYING, 0.0, 30.0, rate, fps)
    line = 30.0 + 5.5 * rate
    assert not run.sought(playing(State.PLAYING, 5.5, line, 0.5, fps))
    # A pause stands at the last joint state, at most one step behind.
    for behind in (0.0, 0.5, 1.0):
        paused = playing(State.PAUSED, 5.5, line - behind * rate / fps, 0.0, fps)
        assert not run.sought(paused)
        assert not paused.sought(playing(State.PLAYING, 9.0, paused.clock.position, 1.0, fps))


@pytest.mark.parametrize("fps", [1.0, 2.0, 100.0])
@pytest.mark.parametrize("way", [-2.0, -1.0, 0.5, 1.0, 2.0])
def test_a_seek_is_one_however_slow_the_motion_is(fps: float, way: float) -> None:
    run = playing(State.PLAYING, 0.0, 30.0, 1.0, fps)
    assert run.sought(playing(State.PLAYING, 5.0, 35.0 + way, 1.0, fps))
    paused = playing(State.PAUSED, 5.0, 35.0, 0.0, fps)
    assert paused.sought(playing(State.PAUSED, 6.0, 35.0 + way, 0.0, fps))
    assert not paused.sought(playing(State.READY, 6.0, 35.0 + way, 0.0, fps))
