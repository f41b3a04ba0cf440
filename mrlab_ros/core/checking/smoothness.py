"""How smooth a motion is: the spectral arc length of the tool's speed."""

from __future__ import annotations

import numpy as np

from mrlab_ros.core.base.geometry import Array

# As Balasubramanian et al. recommend.
PADDING = 4
CUT_OFF = 10.0  # Hz
LEAST_AMPLITUDE = 0.05


def spectral_arc_length(speeds: Array, rate: float) -> float | None:
    """Return SPARC of a speed profile, (N,) m/s at `rate` Hz: the nearer to 0 the smoother.

    A single smooth reach has about -1.4 to -1.6; each stop or correction makes it more negative.
    None where nothing moves. The length of the normalised amplitude spectrum up to the last
    frequency, at most 10 Hz, whose amplitude is 0.05 or more (Balasubramanian, Melendez-Calderon,
    Roby-Brami and Burdet, Journal of NeuroEngineering and Rehabilitation 12:112, 2015).
    """
    if len(speeds) < 3 or not float(speeds.max()) > 1e-9:
        return None
    count = 2 ** (int(np.ceil(np.log2(len(speeds)))) + PADDING)
    amplitude = np.abs(np.fft.rfft(speeds, count))
    amplitude /= amplitude.max()
    frequency = np.fft.rfftfreq(count, 1.0 / rate)
    inside = frequency <= CUT_OFF
    frequency, amplitude = frequency[inside], amplitude[inside]
    loud = np.flatnonzero(amplitude >= LEAST_AMPLITUDE)
    frequency, amplitude = frequency[: loud[-1] + 1], amplitude[: loud[-1] + 1]
    span = frequency[-1] - frequency[0]
    if not span > 0:
        return None
    steps = np.hypot(np.diff(frequency) / span, np.diff(amplitude))
    return -float(steps.sum())
