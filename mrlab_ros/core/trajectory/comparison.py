"""Two motions of one robot, such as planned and measured: how late one is, and how far off."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.base.geometry import Array
from mrlab_ros.core.trajectory.diagnostics import OF_OTHER_JOINTS
from mrlab_ros.core.trajectory.trajectory import Trajectory

# The finest grid on which motions are compared, Hz.
FINEST = 1000.0
# Share of the greatest energy below which two parts say nothing of each other.
LEAST_ENERGY = 0.05
# Shares of the energy that are as good as each other.
ALIKE = 0.01
ROUNDS = 6


@dataclass(frozen=True, eq=False)
class Comparison:
    """Where a motion is off the planned one, once its delay is taken out.

    delay: s by which it is later, counted from the first frame of each; negative: it is ahead.
    rms, most: (J,) rad or m; times: (J,) s of the planned motion at which it is off the most.
    compared: s of the planned motion during which both are there.
    """

    joint_names: tuple[str, ...]
    delay: float
    rms: Array
    most: Array
    times: Array
    compared: float

    @property
    def worst(self) -> int:
        """The place of the joint that is off the most."""
        return int(self.most.argmax())


def compare(planned: Trajectory, measured: Trajectory) -> Comparison:
    """Compare a motion with the planned one; raise BadInput where their joints are others."""
    if planned.joint_names != measured.joint_names:
        found, expected = measured.joint_names, planned.joint_names
        raise BadInput(OF_OTHER_JOINTS(id=measured.id, found=found, expected=expected))
    delay = delay_between(planned, measured)
    times = np.arange(planned.frame_count) / planned.frame_rate
    both = (times + delay >= 0) & (times + delay <= measured.duration)
    # They overlap by a frame at least, but not always at a frame of the planned one.
    there = times[both] if both.any() else times[:1]
    off = np.abs(_at(measured, there + delay) - _at(planned, there))
    return Comparison(
        planned.joint_names,
        delay,
        np.sqrt((off**2).mean(axis=0)),
        off.max(axis=0),
        there[off.argmax(axis=0)],
        float(there[-1] - there[0]),
    )


def delay_between(planned: Trajectory, measured: Trajectory) -> float:
    """Return by how much a motion is later than the planned one, s; 0 where neither moves.

    The peak of the cross-correlation of their velocities, which a constant error of a joint does
    not change, over the energy of both while both are there; between samples by least squares.
    """
    rate = min(max(planned.frame_rate, measured.frame_rate), FINEST)
    first, second = _velocities(planned, rate), _velocities(measured, rate)
    lags = np.arange(1 - len(first), len(second))
    size = 1 << (len(first) + len(second)).bit_length()
    spectrum = np.conj(np.fft.rfft(first, size, axis=0)) * np.fft.rfft(second, size, axis=0)
    likeness = np.fft.irfft(spectrum.sum(axis=1), size)[lags]
    # Samples of the first, and of the second, at which both are there.
    begin, end = np.maximum(-lags, 0), np.minimum(len(first), len(second) - lags)
    energy = _sums(first, begin, end) + _sums(second, begin + lags, end + lags)
    enough = (2 * (end - begin) >= min(len(first), len(second))) & (
        energy > LEAST_ENERGY * energy.max()
    )
    if not enough.any():
        return 0.0
    share = np.where(enough, 2 * likeness / np.where(enough, energy, 1.0), -1.0)
    # Of the peaks of a motion that repeats itself the one with the most in common.
    beside = np.pad(share, 1, constant_values=-1.0)
    peak = (share >= beside[:-2]) & (share >= beside[2:]) & (share >= share.max() - ALIKE)
    alike = np.where(peak, likeness, -np.inf)
    if share.max() <= 0:
        return 0.0
    return _refined(planned, measured, float(lags[int(alike.argmax())]) / rate, rate)


def _sums(velocities: Array, begin: NDArray[np.intp], end: NDArray[np.intp]) -> Array:
    """Return the sum of squares of the rows from `begin` to before `end`, each (L,)."""
    total = np.concatenate([[0.0], (velocities**2).sum(axis=1).cumsum()])
    found: Array = total[end] - total[begin]
    return found


def _refined(planned: Trajectory, measured: Trajectory, delay: float, rate: float) -> float:
    """Return the delay near `delay` that leaves the least error, but for constants."""
    found, step = delay, 1 / rate
    for _ in range(ROUNDS):
        times = np.arange(0.0, planned.duration, step)
        times = times[(times + found >= 0) & (times + found <= measured.duration)]
        if len(times) < 2:
            break
        speeds = (_at(measured, times + found + step) - _at(measured, times + found - step)) * (
            rate / 2
        )
        off = _at(measured, times + found) - _at(planned, times)
        speeds, off = speeds - speeds.mean(axis=0), off - off.mean(axis=0)
        squares = float((speeds**2).sum())
        if squares == 0:
            break
        found -= float((off * speeds).sum()) / squares
        found = min(max(found, delay - 2 * step), delay + 2 * step)
    return found


def _velocities(trajectory: Trajectory, rate: float) -> Array:
    """Return the velocities between samples at `rate`, (N, J) rad/s."""
    times = np.arange(int(np.ceil(trajectory.duration * rate)) + 1) / rate
    change: Array = np.diff(_at(trajectory, times), axis=0) * rate
    return change


def _at(trajectory: Trajectory, times: Array) -> Array:
    """Return the positions (N, J) at `times`, s; before and after it, those at its ends."""
    known = np.arange(trajectory.frame_count) / trajectory.frame_rate
    return np.stack([np.interp(times, known, each) for each in trajectory.positions.T], axis=1)
